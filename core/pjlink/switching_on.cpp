// SPDX-License-Identifier: MIT
#include "relucent/pjlink/switching_on.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::pjlink {
namespace {

[[noreturn]] void failOff(const Named& projector, const std::optional<Power>& power,
                          const std::chrono::seconds& after) {
  const bool isUnderWay = power == Power::warming || power == Power::cooling;
  const auto seconds = static_cast<double>(after.count());
  throw Error(ErrorKind::device,
              isUnderWay ? RELUCENT_MESSAGE("pjlink.still-warming",
                                            "projector {} is still warming up or cooling down after {} s")
                               .with(projector.label, as::seconds(seconds, as::decimals(0)))
                         : RELUCENT_MESSAGE("pjlink.not-on",
                                            "projector {} was told to switch on and is not on after {} s")
                               .with(projector.label, as::seconds(seconds, as::decimals(0))),
              RELUCENT_MESSAGE("pjlink.switch-on-by-hand",
                               "look at its lamps and its menu, switch it on by hand, and start again"),
              toString(projector.address));
}

[[noreturn]] void failShutter(const Named& projector) {
  throw Error(ErrorKind::device,
              RELUCENT_MESSAGE("pjlink.shutter-stays-closed", "the shutter of projector {} does not open")
                  .with(projector.label),
              RELUCENT_MESSAGE("pjlink.open-shutter-by-hand", "open it at the projector, and start again"),
              toString(projector.address));
}

/// One projector on its way.
class Starting {
 public:
  Starting(const Named& projector, const SwitchingOnSettings& settings)
      : projector_(projector), settings_(settings) {}

  bool isDone() const { return isDone_; }
  const std::vector<Message>& remarks() const { return remarks_; }

  void goOn(const Progress& progress) {
    try {
      Session session(projector_.address, settings_.patience, progress);
      const Report report = look(session);
      power_ = report.power;
      isShut_ = report.shutter && report.shutter->picture;
      misses_ = 0;
      if (power_ == Power::off) switchPower(session, true);
      if (power_ != Power::on) return;
      if (isShut_) {
        closeShutter(session, false);  // the next look tells whether it is open
        return;
      }
      isDone_ = true;
      remarks_ = harmfulSettings(report, projector_.label, std::nullopt);
    } catch (const Error&) {
      if (++misses_ >= settings_.mostMisses) throw;
    }
  }

  [[noreturn]] void fail() const {
    if (power_ == Power::on && isShut_) failShutter(projector_);
    failOff(projector_, power_, settings_.longest);
  }

 private:
  const Named& projector_;
  const SwitchingOnSettings& settings_;
  std::optional<Power> power_;
  bool isShut_ = false, isDone_ = false;
  int misses_ = 0;
  std::vector<Message> remarks_;
};

}  // namespace

std::vector<Message> switchOn(const std::vector<Named>& projectors, const SwitchingOnSettings& settings,
                              const Waiting& waiting, Progress& progress) {
  std::vector<Starting> starting;
  for (const Named& projector : projectors) starting.emplace_back(projector, settings);
  const Waiting::Time begin = waiting.now();
  for (;;) {
    for (Starting& one : starting)
      if (!one.isDone()) one.goOn(progress);
    const auto waits = std::ranges::find_if(starting, [](const Starting& one) { return !one.isDone(); });
    if (waits == starting.end()) break;
    const std::chrono::duration<double> passed = waiting.now() - begin;
    if (passed >= settings.longest) waits->fail();
    progress.report(passed / settings.longest);
    waiting.pause(settings.interval, progress);
  }
  progress.report(1.0);
  std::vector<Message> remarks;
  for (const Starting& one : starting)
    remarks.insert(remarks.end(), one.remarks().begin(), one.remarks().end());
  return remarks;
}

}  // namespace relucent::pjlink
