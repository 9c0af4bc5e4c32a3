// SPDX-License-Identifier: MIT
#include "relucent/devices/shutter_speed.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/lowered.h"

namespace relucent::devices {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// A plain decimal number, with a comma or a point. Signs, exponents and words are none.
std::optional<double> numberFrom(std::string_view text) {
  std::string plain(trimmed(text));
  if (plain.empty() || plain.find_first_not_of("0123456789.,") != std::string::npos) return std::nullopt;
  std::replace(plain.begin(), plain.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc() || end != plain.data() + plain.size()) return std::nullopt;
  return value;
}

/// Typographic marks of seconds as the plain one.
std::string withPlainQuotes(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    std::size_t length = 1;
    for (const std::string_view quote : {"\u2033", "\u201d", "''"})
      if (text.starts_with(quote)) length = quote.size();
    plain += length > 1 ? '"' : text.front();
    text.remove_prefix(length);
  }
  return plain;
}

/// Takes a unit of seconds off the end: s, sec, a quote. A quote inside is a decimal point.
std::string withoutUnit(std::string_view word) {
  std::string text = withPlainQuotes(lowered(trimmed(word)));
  for (const std::string_view unit : {"seconds", "second", "secs", "sec", "s", "\""})
    if (text.ends_with(unit)) {
      text.resize(text.size() - unit.size());
      break;
    }
  std::replace(text.begin(), text.end(), '"', '.');
  return text;
}

}  // namespace

std::optional<double> secondsFromShutter(std::string_view word) {
  const std::string text = withoutUnit(word);
  const std::size_t stroke = text.find('/');
  std::optional<double> seconds;
  if (stroke == std::string::npos) {
    seconds = numberFrom(text);
  } else {
    const std::optional<double> above = numberFrom(std::string_view(text).substr(0, stroke));
    const std::optional<double> below = numberFrom(std::string_view(text).substr(stroke + 1));
    if (above && below && *below > 0.0) seconds = *above / *below;
  }
  if (!seconds || !(*seconds > 0.0) || !std::isfinite(*seconds)) return std::nullopt;
  return seconds;
}

bool isBulb(std::string_view word) {
  // Cameras are asked in English; these are for drivers that translate all the same.
  static constexpr std::array<std::string_view, 5> words{"bulb", "pose", "posa", "langzeit",
                                                         "\u30d0\u30eb\u30d6"};
  const std::string text = lowered(trimmed(word));
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view known) { return text.starts_with(known); });
}

ShutterList::ShutterList(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (isBulb(word)) {
      if (!bulb_) bulb_ = word;
    } else if (const std::optional<double> seconds = secondsFromShutter(word)) {
      speeds_.push_back({word, *seconds});
    }
  }
  std::stable_sort(speeds_.begin(), speeds_.end(),
                   [](const Speed& a, const Speed& b) { return a.seconds < b.seconds; });
}

const ShutterList::Speed& ShutterList::nearest(double seconds) const {
  require(!empty() && seconds > 0.0, "{} s of {} shutter times", seconds, speeds_.size());
  auto distance = [&](const Speed& speed) { return std::abs(std::log(speed.seconds / seconds)); };
  return *std::min_element(speeds_.begin(), speeds_.end(),
                           [&](const Speed& a, const Speed& b) { return distance(a) < distance(b); });
}

bool ShutterList::needsBulb(double seconds) const {
  if (!bulb_) return false;
  if (speeds_.empty()) return true;
  const double last = speeds_.size() > 1 ? longest() / speeds_[speeds_.size() - 2].seconds : 1.0;
  return seconds > longest() * std::sqrt(std::max(last, 1.01));
}

}  // namespace relucent::devices
