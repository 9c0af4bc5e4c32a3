// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Where a result stands that follows from the measurement: one that was stopped early is no plain tick.
inline StepState doneOn(const Session& session) {
  return session.stoppedAt() > 0 ? StepState::coarse : StepState::done;
}

/// What stands above the pages that use a measurement which was stopped early; none: it was not.
/// `goOn`: leads to where it can be gone on with.
inline std::optional<Banner> stoppedEarly(const Session& session, PageCommand* goOn) {
  const int blocks = session.stoppedAt();
  if (blocks == 0) return std::nullopt;
  return Banner{
      Banner::Kind::amber,
      QCoreApplication::translate("StoppedEarly", "Measuring was stopped at blocks of %1 px").arg(blocks),
      QCoreApplication::translate("StoppedEarly", "All that follows is as coarse. Go on measuring any time."),
      goOn};
}
/// Its words on those pages: it leads to Acquire, where it begins once all is ready.
inline QString goOnMeasuringText() {
  return QCoreApplication::translate("StoppedEarly", "Go on at Acquire");
}

}  // namespace relucent::gui
