// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>
#include <algorithm>

#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Where a result stands that follows from the measurement: one that was stopped early, fits nothing or has
/// holes is no plain tick.
inline StepState doneOn(const Session& session) {
  if (session.wasEndedEarly()) return StepState::coarse;
  return session.isDoubtful() ? StepState::doubtful : StepState::done;
}

/// Content was accepted with groups by the settings that are kept, which Preview made anew: that nobody has
/// looked at them at Cluster since stands against nothing.
inline bool areClustersFollowed(const Session& session) {
  return session.progress(calibration::Stage::content) == calibration::StageProgress::done;
}

/// Measuring was stopped before blocks of the projector were told apart: no picture can be put anywhere with
/// that, and no show starts.
inline bool isNothingToldApart(const Session& session) {
  const Size projector = session.projectorSize();
  return session.stoppedAt() >= std::min(projector.width, projector.height) && session.stoppedAt() > 0;
}
inline QString nothingToldApart() {
  return QCoreApplication::translate("StoppedEarly", "Measuring was stopped before anything was told apart");
}

/// What stands above the pages that use a measurement which was stopped early, is out of date, fits nothing
/// or has holes; none: it is whole. `toAcquire`: leads to where it can be gone on with, or begun again.
inline std::optional<Banner> onMeasurement(const Session& session, PageCommand* toAcquire) {
  if (const auto change = session.foundChange())
    return Banner{
        Banner::Kind::amber,
        QCoreApplication::translate("StoppedEarly", "Measuring ended because something had changed"),
        fullSentence(change->what) + ' ' +
            QCoreApplication::translate("StoppedEarly",
                                        "What follows is of before. See at Acquire what helps."),
        toAcquire};
  if (isNothingToldApart(session))
    return Banner{
        Banner::Kind::amber, nothingToldApart(),
        session.hasEarlier(calibration::Stage::acquisition)
            ? QCoreApplication::translate(
                  "StoppedEarly",
                  "No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.")
            : QCoreApplication::translate("StoppedEarly",
                                          "No picture can be corrected by it. Go on measuring any time."),
        toAcquire};
  if (session.progress(calibration::Stage::acquisition) == calibration::StageProgress::stale)
    return Banner{
        Banner::Kind::amber,
        session.photographsSince(calibration::Stage::acquisition) > 0
            ? QCoreApplication::translate("StoppedEarly", "Measuring again has not ended")
            : QCoreApplication::translate("StoppedEarly",
                                          "What was measured is out of date: it belongs to earlier settings"),
        QCoreApplication::translate("StoppedEarly",
                                    "It still works, and what you see follows from the earlier measurement, "
                                    "until the new one is ready."),
        toAcquire};
  if (const int blocks = session.stoppedAt(); blocks > 0)
    return Banner{
        Banner::Kind::amber,
        QCoreApplication::translate("StoppedEarly", "Measuring was stopped at blocks of %1 px").arg(blocks),
        QCoreApplication::translate("StoppedEarly",
                                    "All that follows is as coarse. Go on measuring any time."),
        toAcquire};
  if (const auto poor = session.poorQuality())
    return Banner{
        Banner::Kind::amber,
        QCoreApplication::translate("StoppedEarly", "What was measured does not fit together"),
        QCoreApplication::translate("StoppedEarly",
                                    "Corrected pictures are expected at %1: that is no better than "
                                    "uncorrected. Measure again.")
            .arg(isolated(QCoreApplication::translate("StoppedEarly", "%1 dB").arg(decimalText(*poor, 0)))),
        toAcquire};
  if (const auto leftOut = session.leftOut()) {
    const QString share = percentText(*leftOut);
    if (session.isOverexposed())
      return Banner{Banner::Kind::amber,
                    QCoreApplication::translate("StoppedEarly", "%1 of the view is too bright for the camera")
                        .arg(share),
                    QCoreApplication::translate("StoppedEarly",
                                                "Nothing is corrected there. Close the lens a little, check "
                                                "the camera, then measure again."),
                    toAcquire};
    return Banner{
        Banner::Kind::amber,
        QCoreApplication::translate("StoppedEarly", "%1 of the view is left out").arg(share),
        QCoreApplication::translate("StoppedEarly",
                                    "Test patterns looked different there from what was measured, and "
                                    "nothing is corrected. See that all stands still, then measure again."),
        toAcquire};
  }
  return std::nullopt;
}

/// The command's words on those pages: it leads to Acquire, where it begins once all is ready.
inline QString toAcquireText(const Session& session) {
  return session.wasEndedEarly() ? QCoreApplication::translate("StoppedEarly", "Go on at Acquire")
                                 : QCoreApplication::translate("StoppedEarly", "Go to Acquire");
}

}  // namespace relucent::gui
