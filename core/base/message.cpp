// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "relucent/base/require.h"

namespace relucent {
namespace {

constexpr std::array<std::pair<Unit, std::string_view>, 9> units{{{Unit::none, "none"},
                                                                  {Unit::seconds, "seconds"},
                                                                  {Unit::milliseconds, "milliseconds"},
                                                                  {Unit::share, "share"},
                                                                  {Unit::pixels, "pixels"},
                                                                  {Unit::degrees, "degrees"},
                                                                  {Unit::bytes, "bytes"},
                                                                  {Unit::megabytes, "megabytes"},
                                                                  {Unit::decibels, "decibels"}}};

/// What an argument is in English.
struct English {
  std::string operator()(const Argument::Count& count) const { return fmt::format("{}", count.value); }
  std::string operator()(const Argument::Label& label) const { return fmt::format("{}", label.value); }
  std::string operator()(const Argument::Quantity& quantity) const {
    switch (quantity.digits.kind) {
      case Digits::Kind::decimals:
        return fmt::format("{:.{}f}", quantity.shown(), quantity.digits.count);
      case Digits::Kind::significant:
        return fmt::format("{:.{}g}", quantity.shown(), quantity.digits.count);
      case Digits::Kind::asNeeded:
        break;
    }
    return fmt::format("{}", quantity.shown());
  }
  std::string operator()(const Size& size) const { return fmt::format("{}x{}", size.width, size.height); }
  std::string operator()(const Argument::Text& text) const { return text.value; }
  std::string operator()(const Argument::File& file) const { return file.path; }
  std::string operator()(const Argument::Sentence& message) const { return english(*message.message); }
};

/// The number of a gap that begins at `at`, "{}" being `next`; none: it is no gap. `end` is behind it.
std::optional<std::size_t> gapAt(std::string_view pattern, std::size_t at, std::size_t& next,
                                 std::size_t& end) {
  const std::size_t close = pattern.find('}', at);
  if (close == std::string_view::npos) return std::nullopt;
  const std::string_view inside = pattern.substr(at + 1, close - at - 1);
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(inside.data(), inside.data() + inside.size(), number);
  if (!inside.empty() && (error != std::errc() || stop != inside.data() + inside.size())) return std::nullopt;
  end = close + 1;
  return inside.empty() ? next++ : number;
}

}  // namespace

std::string_view toString(Unit unit) {
  for (const auto& [each, name] : units)
    if (each == unit) return name;
  return "none";
}

std::optional<Unit> unitNamed(std::string_view name) {
  for (const auto& [unit, each] : units)
    if (each == name) return unit;
  return std::nullopt;
}

double Argument::Quantity::shown() const {
  switch (unit) {
    case Unit::milliseconds:
      return 1000.0 * value;
    case Unit::share:
      return 100.0 * value;
    case Unit::megabytes:
      return std::floor(std::ldexp(value, -20));
    default:
      return value;
  }
}

bool Argument::Sentence::operator==(const Sentence& other) const {
  return *message == *other.message;
}

Argument::Argument(Message message) : value_(Sentence{std::make_shared<const Message>(std::move(message))}) {}

bool Argument::operator==(const Argument&) const = default;

Message::Message(std::string id, std::string pattern, std::string singular, std::vector<Argument> arguments)
    : id_(std::move(id)),
      pattern_(std::move(pattern)),
      singular_(std::move(singular)),
      arguments_(std::move(arguments)) {
  require(detail::gapsOf(pattern_) == arguments_.size(), "\"{}\" has {} gaps, not {}", pattern_,
          detail::gapsOf(pattern_), arguments_.size());
}

Message Message::plain(std::string text) {
  return text.empty() ? Message() : Message({}, "{}", {}, {Argument(std::move(text))});
}

std::optional<std::int64_t> Message::number() const {
  if (singular_.empty()) return std::nullopt;
  for (const Argument& argument : arguments_)
    if (const auto* count = std::get_if<Argument::Count>(&argument.value())) return count->value;
  return std::nullopt;
}

std::string english(const Argument& argument) {
  return std::visit(English(), argument.value());
}

std::string english(const Message& message) {
  std::vector<std::string> parts;
  for (const Argument& argument : message.arguments()) parts.push_back(english(argument));
  return fillGaps(message.number() == 1 ? message.singular() : message.pattern(), parts);
}

std::string englishSentence(const Message& message) {
  std::string text = english(message);
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string fillGaps(std::string_view pattern, std::span<const std::string> parts) {
  std::string text;
  std::size_t next = 0;
  for (std::size_t at = 0; at < pattern.size();) {
    std::size_t end = at + 1;
    const std::optional<std::size_t> gap =
        pattern[at] == '{' ? gapAt(pattern, at, next, end) : std::optional<std::size_t>();
    text += gap && *gap < parts.size() ? std::string_view(parts[*gap]) : pattern.substr(at, end - at);
    at = end;
  }
  return text;
}

}  // namespace relucent
