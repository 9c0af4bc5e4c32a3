// SPDX-License-Identifier: MIT
#include "relucent/pipeline/night_alarm.h"

#include <algorithm>
#include <ranges>

#include "relucent/base/error.h"
#include "relucent/devices/command/shell_command.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds longestTelling{60'000};

bool isFigure(const Argument& argument) {
  return std::holds_alternative<Argument::Quantity>(argument.value()) ||
         std::holds_alternative<Argument::Count>(argument.value());
}

bool saysTheSame(const Argument& a, const Argument& b) {
  if (isFigure(a) && isFigure(b)) return true;
  const auto *one = std::get_if<Argument::Sentence>(&a.value()),
             *other = std::get_if<Argument::Sentence>(&b.value());
  if (one == nullptr || other == nullptr) return a == b;
  return relucent::pipeline::saysTheSame(*one->message, *other->message);
}

/// Whether the last night that was one told of the same.
bool wasTold(const fs::path& calibration, const Message& alarm) {
  try {
    const std::vector<NightRecord> nights = nightsOf(calibration);
    for (const NightRecord& night : nights | std::views::reverse)
      if (night.skipped.empty()) return night.told && saysTheSame(night.alarm, alarm);
  } catch (const Error&) {  // nobody knows: better twice than never
  }
  return false;
}

}  // namespace

bool saysTheSame(const Message& a, const Message& b) {
  return a.id() == b.id() &&
         std::ranges::equal(a.arguments(), b.arguments(),
                            [](const Argument& x, const Argument& y) { return saysTheSame(x, y); });
}

void closeNight(const fs::path& calibration, NightRecord& night, const std::string& command) {
  if (isAlarm(night) && !command.empty()) {
    night.told = wasTold(calibration, night.alarm);
    if (!night.told) {
      try {
        devices::runShellCommand(devices::substituted(command, {{"sentence", englishSentence(night.alarm)},
                                                                {"calibration", calibration.string()}}),
                                 longestTelling, "alarm command");
        night.told = true;
      } catch (const Error& error) {
        night.untold = error.sentence();
      }
    }
  }
  addNight(calibration, night);
}

}  // namespace relucent::pipeline
