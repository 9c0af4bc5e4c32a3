// SPDX-License-Identifier: MIT
#include "relucent/pipeline/stopped_early.h"

#include "relucent/base/time_left.h"

namespace relucent::pipeline {

Message stoppedEarly(int blocks, const std::optional<transport::ExpectedQuality>& expected) {
  // Where more would not help, there is no forecast of it.
  if (!expected || expected->photographs == 0)
    return RELUCENT_MESSAGE(
               "acquisition.stopped-early",
               "Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are "
               "compensated less sharply; go on measuring any time as long as nothing has moved")
        .with(as::label(blocks));
  return RELUCENT_PLURAL_MESSAGE(
             "acquisition.stopped-with-forecast",
             "Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on "
             "measuring any time as long as nothing has moved",
             "Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on "
             "measuring any time as long as nothing has moved")
      .with(as::label(blocks), as::decibels(expected->now, as::decimals(0)),
            as::decibels(expected->whole, as::decimals(0)), as::count(expected->photographs),
            expectedDuration(expected->seconds));
}

std::optional<Message> poorQuality(const std::optional<transport::ExpectedQuality>& expected) {
  if (!expected || !isPoor(*expected)) return std::nullopt;
  return RELUCENT_MESSAGE(
             "acquisition.poor-quality",
             "What was measured does not fit together: corrected pictures are expected at {} dB, no better "
             "than uncorrected; see that projector, camera and surface stand still and that no other light "
             "changes, then measure again")
      .with(as::decibels(expected->whole, as::decimals(0)));
}

}  // namespace relucent::pipeline
