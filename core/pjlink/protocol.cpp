// SPDX-License-Identifier: MIT
#include "relucent/pjlink/protocol.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <memory>
#include <string>

namespace relucent::pjlink {
namespace {

constexpr std::size_t headLength = 7;  // "%1POWR="
constexpr std::size_t mostLamps = 8;
constexpr std::string_view greets = "PJLINK ";

bool isSame(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

bool isHexadecimal(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char digit) { return std::isxdigit(digit) != 0; });
}

/// "01:23:45:67:89:ab"
bool isHardwareAddress(std::string_view text) {
  constexpr std::size_t length = 17;  // six pairs of digits with colons between
  if (text.size() != length) return false;
  for (std::size_t i = 0; i < length; ++i)
    if (i % 3 == 2 ? text[i] != ':' : !isHexadecimal(text.substr(i, 1))) return false;
  return true;
}

std::string_view withoutEnd(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    if (space != 0) words.push_back(text.substr(0, space));
    if (space == std::string_view::npos) break;
    text.remove_prefix(space + 1);
  }
  return words;
}

}  // namespace

std::optional<Greeting> greetingFrom(std::string_view line) {
  if (line.size() < greets.size() || !isSame(line.substr(0, greets.size()), greets)) return std::nullopt;
  const std::vector<std::string_view> words = wordsOf(line.substr(greets.size()));
  if (words.empty()) return std::nullopt;
  if (isSame(words[0], "ERRA")) return Greeting{Greeting::Kind::refused};
  if (words.size() == 1 && words[0] == "0") return Greeting{Greeting::Kind::open};
  if (words.size() == 2 && words[0] == "1" && isHexadecimal(words[1]))
    return Greeting{Greeting::Kind::password, std::string(words[1])};
  if (words[0] == "2") return Greeting{Greeting::Kind::newer};
  return std::nullopt;
}

std::string digestOf(const std::string& challenge, const std::string& password) {
  const std::string both = challenge + password;
  const std::unique_ptr<char, decltype(&g_free)> digest(
      g_compute_checksum_for_data(G_CHECKSUM_MD5, reinterpret_cast<const guchar*>(both.data()), both.size()),
      &g_free);
  return digest.get();
}

std::string requestOf(int protocolClass, std::string_view command, std::string_view parameter) {
  return fmt::format("%{}{} {}\r", protocolClass, command, parameter);
}

bool isAnswer(std::string_view line) {
  return line.size() >= headLength && line[0] == '%' && line[headLength - 1] == '=' &&
         std::isdigit(static_cast<unsigned char>(line[1])) != 0;
}

bool isWrongPassword(std::string_view line) {
  return isSame(line, "PJLINK ERRA");
}

std::optional<Answer> answerFrom(std::string_view line, std::string_view command) {
  if (!isAnswer(line) || !isSame(line.substr(2, 4), command)) return std::nullopt;
  Answer answer{std::string(line.substr(headLength))};
  constexpr std::array refusals{Refusal::undefined, Refusal::outOfParameter, Refusal::unavailable,
                                Refusal::failure};
  for (std::size_t i = 0; i < refusals.size(); ++i)
    if (isSame(answer.value, fmt::format("ERR{}", i + 1))) answer.refusal = refusals[i];
  return answer;
}

std::optional<Power> powerFrom(std::string_view value) {
  constexpr std::array powers{Power::off, Power::on, Power::cooling, Power::warming};
  if (value.size() != 1 || value[0] < '0' || value[0] > '3') return std::nullopt;
  return powers[static_cast<std::size_t>(value[0] - '0')];
}

std::optional<Shutter> shutterFrom(std::string_view value) {
  if (value.size() != 2 || value[0] < '1' || value[0] > '3' || value[1] < '0' || value[1] > '1')
    return std::nullopt;
  if (value[1] == '0') return Shutter{};
  return Shutter{value[0] != '2', value[0] != '1'};
}

std::optional<std::vector<Trouble>> troublesFrom(std::string_view value) {
  static const std::vector<Part> parts = allValues<Part>();
  if (value.size() != parts.size()) return std::nullopt;
  std::vector<Trouble> troubles;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (value[i] < '0' || value[i] > '2') return std::nullopt;
    if (value[i] != '0') troubles.push_back({parts[i], value[i] == '2'});
  }
  return troubles;
}

std::optional<int> numberFrom(std::string_view value) {
  int number = 0;
  const char* end = value.data() + value.size();
  const auto [after, error] = std::from_chars(value.data(), end, number);
  if (error != std::errc() || after != end || number < 0 || number > 999'999'999) return std::nullopt;
  return number;
}

std::optional<std::vector<Lamp>> lampsFrom(std::string_view value) {
  const std::vector<std::string_view> words = wordsOf(value);
  if (words.empty() || words.size() % 2 != 0 || words.size() > 2 * mostLamps) return std::nullopt;
  std::vector<Lamp> lamps;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::optional<int> hours = numberFrom(words[i]);
    if (!hours || (words[i + 1] != "0" && words[i + 1] != "1")) return std::nullopt;
    lamps.push_back({*hours, words[i + 1] == "1"});
  }
  return lamps;
}

std::optional<std::string> inputFrom(std::string_view value) {
  const auto isOther = [](unsigned char c) { return std::isdigit(c) != 0 || (c >= 'A' && c <= 'Z'); };
  if (value.size() != 2 || value[0] < '1' || value[0] > '6' || value[1] == '0' || !isOther(value[1]))
    return std::nullopt;
  return std::string(value);
}

std::optional<Signal> signalFrom(std::string_view value) {
  if (value == "-") return Signal{Signal::Kind::none};
  if (value == "*") return Signal{Signal::Kind::unknown};
  const std::size_t cross = value.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  const std::optional<int> width = numberFrom(value.substr(0, cross)),
                           height = numberFrom(value.substr(cross + 1));
  constexpr int largest = 1 << 16;
  if (!width || !height || *width < 1 || *height < 1 || *width > largest || *height > largest)
    return std::nullopt;
  return Signal{Signal::Kind::size, {*width, *height}};
}

std::string glibVersion() {
  return fmt::format("{}.{}.{}", glib_major_version, glib_minor_version, glib_micro_version);
}

bool isNotice(std::string_view datagram) {
  const std::string_view line = withoutEnd(datagram);
  const auto says = [&](std::string_view command, auto reads) {
    const std::optional<Answer> value = answerFrom(line, command);
    return value && reads(value->value);
  };
  return line.substr(0, 2) == "%2" &&
         (says("POWR", [](std::string_view value) { return powerFrom(value).has_value(); }) ||
          says("ERST", [](std::string_view value) { return troublesFrom(value).has_value(); }) ||
          says("INPT", [](std::string_view value) { return inputFrom(value).has_value(); }) ||
          says("LKUP", isHardwareAddress));
}

std::optional<std::string> foundFrom(std::string_view datagram) {
  const std::optional<Answer> answer = answerFrom(withoutEnd(datagram), "ACKN");
  if (!answer || !isHardwareAddress(answer->value)) return std::nullopt;
  return answer->value;
}

}  // namespace relucent::pjlink
