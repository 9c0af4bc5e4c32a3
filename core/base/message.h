// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent {

class Message;

/// What a quantity is measured in. A pattern names the unit behind the gap: "{} s", "{} %".
enum class Unit { none, seconds, milliseconds, share, pixels, degrees, bytes, megabytes, decibels };
std::string_view toString(Unit unit);
/// None: there is no such unit.
std::optional<Unit> unitNamed(std::string_view name);

/// How many digits a quantity is written with.
struct Digits {
  enum class Kind { asNeeded, decimals, significant };
  Kind kind = Kind::asNeeded;
  int count = 0;
  bool operator==(const Digits&) const = default;
};

/// What fills a gap of a message, typed by what it is: a language writes a number by its locale and leaves a
/// name as it is.
class Argument {
 public:
  /// How many there are.
  struct Count {
    std::int64_t value = 0;
    bool operator==(const Count&) const = default;
  };
  /// A number by which a thing is told apart: the same in every language.
  struct Label {
    std::int64_t value = 0;
    bool operator==(const Label&) const = default;
  };
  struct Quantity {
    double value = 0.0;  // s, share of 1, pixels, degrees, bytes, dB
    Unit unit = Unit::none;
    Digits digits{};
    bool operator==(const Quantity&) const = default;
    /// The value in the unit that is written: milliseconds, per cent, megabytes (2^20 bytes, whole ones).
    double shown() const;
  };
  struct Text {
    std::string value;  // UTF-8
    bool operator==(const Text&) const = default;
  };
  struct File {
    std::string path;  // UTF-8
    bool operator==(const File&) const = default;
  };
  /// A message of its own, which never changes.
  struct Sentence {
    std::shared_ptr<const Message> message;
    bool operator==(const Sentence& other) const;
  };
  using Value = std::variant<Count, Label, Quantity, Size, Text, File, Sentence>;

  Argument(Value value) : value_(std::move(value)) {}                                      // NOLINT
  Argument(std::integral auto count) : value_(Count{static_cast<std::int64_t>(count)}) {}  // NOLINT
  Argument(std::floating_point auto number)                                                // NOLINT
      : value_(Quantity{static_cast<double>(number)}) {}
  Argument(std::string text) : value_(Text{std::move(text)}) {}         // NOLINT
  Argument(std::string_view text) : value_(Text{std::string(text)}) {}  // NOLINT
  Argument(const char* text) : value_(Text{text}) {}                    // NOLINT
  Argument(Message message);                                            // NOLINT

  const Value& value() const { return value_; }
  bool operator==(const Argument&) const;

 private:
  Value value_;
};

/// A text for people as data: which one, and what fills its gaps. Core makes it; the command line writes it
/// in English, the desktop program in the user's language, a manifest keeps it.
///
///     RELUCENT_MESSAGE("disk.cannot-open", "cannot open ({})").with(reason)
///
/// The id is the text's stable name, for machines and for the files of translations/, where it is the
/// context. The pattern is the English text with "{}" where an argument goes; a translation may have them in
/// another order, {1} before {0}. Where a count decides over the number of a word there is a singular too.
class Message {
 public:
  /// No message.
  Message() = default;
  /// Contract: the pattern has as many gaps as there are arguments.
  Message(std::string id, std::string pattern, std::string singular, std::vector<Argument> arguments);

  /// A text that is in no language but its own: a device's name, what the system says, words of the user's.
  static Message plain(std::string text);

  bool empty() const { return id_.empty() && arguments_.empty(); }
  /// Empty for a plain text.
  const std::string& id() const { return id_; }
  const std::string& pattern() const { return pattern_; }
  /// Of the pattern, where it has one.
  const std::string& singular() const { return singular_; }
  const std::vector<Argument>& arguments() const { return arguments_; }
  /// The first count among the arguments of a message with a singular: it decides.
  std::optional<std::int64_t> number() const;

  bool operator==(const Message&) const = default;

 private:
  std::string id_, pattern_, singular_;
  std::vector<Argument> arguments_;
};

/// In English, for the command line, logs and reports.
std::string english(const Message& message);
std::string english(const Argument& argument);
/// As a sentence that ends: with a full stop unless it has one.
std::string englishSentence(const Message& message);

/// A pattern with its gaps filled: "{}" from left to right, "{0}", "{1}", ... by their number. What else
/// stands in braces stays. Parts may hold braces of their own.
std::string fillGaps(std::string_view pattern, std::span<const std::string> parts);

/// Arguments by what they are: as::seconds(0.25, as::digits(3)).
namespace as {

constexpr Digits decimals(int count) {
  return {Digits::Kind::decimals, count};
}
/// Significant ones.
constexpr Digits digits(int count) {
  return {Digits::Kind::significant, count};
}

inline Argument count(std::integral auto number) {
  return number;
}
inline Argument label(std::integral auto number) {
  return Argument(Argument::Label{static_cast<std::int64_t>(number)});
}
inline Argument quantity(double value, Unit unit, Digits digits) {
  return Argument(Argument::Quantity{value, unit, digits});
}
inline Argument number(double value, Digits digits = {}) {
  return quantity(value, Unit::none, digits);
}
inline Argument seconds(double value, Digits digits = {}) {
  return quantity(value, Unit::seconds, digits);
}
/// Given in seconds.
inline Argument milliseconds(double seconds, Digits digits = {}) {
  return quantity(seconds, Unit::milliseconds, digits);
}
/// A share of 1 in per cent.
inline Argument share(double share, Digits digits = {}) {
  return quantity(share, Unit::share, digits);
}
inline Argument pixels(double value, Digits digits = {}) {
  return quantity(value, Unit::pixels, digits);
}
inline Argument degrees(double value, Digits digits = {}) {
  return quantity(value, Unit::degrees, digits);
}
inline Argument decibels(double value, Digits digits = {}) {
  return quantity(value, Unit::decibels, digits);
}
inline Argument bytes(std::integral auto number) {
  return quantity(static_cast<double>(number), Unit::bytes, decimals(0));
}
/// Given in bytes.
inline Argument megabytes(std::integral auto bytes) {
  return quantity(static_cast<double>(bytes), Unit::megabytes, decimals(0));
}
/// "1024x768".
inline Argument size(Size size) {
  return Argument(Argument::Value(size));
}
inline Argument size(int width, int height) {
  return size(Size{width, height});
}
inline Argument file(const std::filesystem::path& path) {
  return Argument(Argument::File{path.string()});
}

}  // namespace as

namespace detail {

constexpr std::size_t gapsOf(std::string_view pattern) {
  std::size_t gaps = 0;
  for (std::size_t at = pattern.find("{}"); at != std::string_view::npos; at = pattern.find("{}", at + 2))
    ++gaps;
  return gaps;
}

/// Lower-case words, joined by hyphens, in at least two parts with a dot between: "disk.cannot-open".
constexpr bool isMessageId(std::string_view id) {
  bool dotted = false, inWord = false;
  for (char letter : id) {
    const bool joint = letter == '.' || letter == '-';
    if (joint ? !inWord : !((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')))
      return false;
    dotted = dotted || letter == '.';
    inWord = !joint;
  }
  return dotted && inWord;
}

/// A message before its gaps are filled.
template <std::size_t gaps>
class MessagePattern {
 public:
  consteval MessagePattern(const char* id, const char* pattern, const char* singular = "")
      : id_(id), pattern_(pattern), singular_(singular) {
    if (!isMessageId(id)) throw "an id is lower-case words with hyphens and dots";
    if (*singular != '\0' && gapsOf(singular) != gaps) throw "the singular has other gaps than the plural";
  }

  template <typename... Arguments>
  Message with(Arguments&&... arguments) const {
    static_assert(sizeof...(arguments) == gaps, "as many arguments as the pattern has gaps");
    return Message(id_, pattern_, singular_, {Argument(std::forward<Arguments>(arguments))...});
  }
  operator Message() const  // NOLINT
    requires(gaps == 0)
  {
    return Message(id_, pattern_, singular_, {});
  }

 private:
  const char *id_, *pattern_, *singular_;
};

}  // namespace detail
}  // namespace relucent

namespace fmt {
/// A message in English.
template <>
struct formatter<relucent::Message> : formatter<std::string> {
  template <typename Context>
  auto format(const relucent::Message& message, Context& context) const {
    return formatter<std::string>::format(relucent::english(message), context);
  }
};
}  // namespace fmt

/// A message of that id and English pattern; lupdate sees both (target `update_translations`) and wants them
/// in every language. Checked when compiled: the id's form, and that with() has as many arguments as the
/// pattern gaps.
#define RELUCENT_MESSAGE(id, pattern) \
  ::relucent::detail::MessagePattern<::relucent::detail::gapsOf(pattern)>(id, pattern)
/// One whose words depend on the first count among its arguments: RELUCENT_PLURAL_MESSAGE("tree.patterns",
/// "{} patterns", "{} pattern").
#define RELUCENT_PLURAL_MESSAGE(id, pattern, singular) \
  ::relucent::detail::MessagePattern<::relucent::detail::gapsOf(pattern)>(id, pattern, singular)
/// The same for what is said in English alone: only the command line and whoever builds on core can meet it.
#define RELUCENT_ENGLISH_MESSAGE(id, pattern) \
  ::relucent::detail::MessagePattern<::relucent::detail::gapsOf(pattern)>(id, pattern)
#define RELUCENT_ENGLISH_PLURAL_MESSAGE(id, pattern, singular) \
  ::relucent::detail::MessagePattern<::relucent::detail::gapsOf(pattern)>(id, pattern, singular)
