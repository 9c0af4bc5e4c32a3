// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/base/error.h"

namespace relucent::pipeline {

/// Of a calibration without the measurement that is needed.
inline Error notFinished(const std::filesystem::path& calibration) {
  return {ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("calibration.not-finished", "the calibration is not finished"),
          RELUCENT_ENGLISH_MESSAGE("calibration.resume-first", "finish it first: relucent-cli resume {}")
              .with(calibration.string()),
          calibration.string()};
}

}  // namespace relucent::pipeline
