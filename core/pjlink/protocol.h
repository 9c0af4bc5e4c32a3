// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/raster.h"

/// The lines of PJLink as values and back; nothing here touches a network. What comes from one is never
/// trusted: every reader takes any bytes, and gives nothing for what the specification does not know.
namespace relucent::pjlink {

/// Bytes of a line before its carriage return. The specification needs 135; more is no PJLink.
inline constexpr std::size_t longestLine = 512;

/// What a projector says first.
struct Greeting {
  enum class Kind {
    open,      // no password
    password,  // the first command is preceded by digestOf(challenge, password)
    newer,     // an authentication of class 2 that this program does not know
    refused    // wrong password, or too many connections
  };
  Kind kind = Kind::open;
  std::string challenge{};
};
std::optional<Greeting> greetingFrom(std::string_view line);

/// MD5 of challenge and password, 32 lower-case hexadecimal digits.
std::string digestOf(const std::string& challenge, const std::string& password);

/// "%1POWR ?\r". `command`: four letters.
std::string requestOf(int protocolClass, std::string_view command, std::string_view parameter);

/// Why a command was not carried out: ERR1 to ERR4.
enum class Refusal { undefined, outOfParameter, unavailable, failure };

struct Answer {
  std::string value;
  std::optional<Refusal> refusal{};
};
/// Of "%1POWR=1", for the command that was asked, whatever class the line names. None: it answers no such
/// command.
std::optional<Answer> answerFrom(std::string_view line, std::string_view command);
/// Whether the line answers any command.
bool isAnswer(std::string_view line);
/// "PJLINK ERRA": the password is wrong.
bool isWrongPassword(std::string_view line);

enum class Power { off, on, cooling, warming };
inline constexpr EnumName<Power> powerNames[]{
    {Power::off, "standby"}, {Power::on, "on"}, {Power::cooling, "cooling"}, {Power::warming, "warming-up"}};
constexpr EnumNames<Power> namesOf(Power) {
  return {"power state", powerNames};
}
std::optional<Power> powerFrom(std::string_view value);

/// What a mute closes.
struct Shutter {
  bool picture = false, sound = false;
  bool operator==(const Shutter&) const = default;
};
std::optional<Shutter> shutterFrom(std::string_view value);

enum class Part { fan, lamp, temperature, cover, filter, other };
inline constexpr EnumName<Part> partNames[]{
    {Part::fan, "fan"},     {Part::lamp, "lamp"},     {Part::temperature, "temperature"},
    {Part::cover, "cover"}, {Part::filter, "filter"}, {Part::other, "other"}};
constexpr EnumNames<Part> namesOf(Part) {
  return {"part of a projector", partNames};
}
/// A part that is not well.
struct Trouble {
  Part part = Part::other;
  bool isError = false;  // false: a warning
  bool operator==(const Trouble&) const = default;
};
/// Of six digits.
std::optional<std::vector<Trouble>> troublesFrom(std::string_view value);

struct Lamp {
  int hours = 0;
  bool lit = false;
  bool operator==(const Lamp&) const = default;
};
/// One to eight.
std::optional<std::vector<Lamp>> lampsFrom(std::string_view value);

/// "31": the first digital one.
std::optional<std::string> inputFrom(std::string_view value);

/// What is at the input.
struct Signal {
  enum class Kind { none, unknown, size };
  Kind kind = Kind::unknown;
  Size size{};
  bool operator==(const Signal&) const = default;
};
/// "1920x1080", "-" or "*".
std::optional<Signal> signalFrom(std::string_view value);

/// A whole number, 0 to 999999999.
std::optional<int> numberFrom(std::string_view value);

/// Of the library that carries the connections and computes MD5.
std::string glibVersion();

/// Whether this is what a projector of class 2 says unasked when it changes: "%2POWR=0", and ERST, INPT and
/// LKUP.
bool isNotice(std::string_view datagram);

/// The hardware address in "%2ACKN=01:23:45:67:89:ab".
std::optional<std::string> foundFrom(std::string_view datagram);

}  // namespace relucent::pjlink
