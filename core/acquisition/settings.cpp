// SPDX-License-Identifier: MIT
#include "acquisition/settings.h"

#include <fmt/format.h>

#include "base/error.h"

namespace relucent {

std::vector<std::string> problems(const AcquisitionSettings& settings) {
  std::vector<std::string> found;
  if (!(settings.relativeThreshold > 0.0 && settings.relativeThreshold < 1.0))
    found.push_back(fmt::format("the relative threshold must lie between 0 and 1, not at {}",
                                settings.relativeThreshold));
  if (!(settings.absoluteThreshold >= 0.0))
    found.push_back(
        fmt::format("the absolute threshold cannot be below 0, as {} is", settings.absoluteThreshold));
  if (!(settings.noiseSigmas > 0.0))
    found.push_back(
        fmt::format("the noise threshold must be above 0 standard deviations, not {}", settings.noiseSigmas));
  if (!(settings.dimShare >= 0.0 && settings.dimShare <= 1.0))
    found.push_back(
        fmt::format("the share for dim pixels must lie between 0 and 1, not at {}", settings.dimShare));
  if (settings.references < 1)
    found.push_back(fmt::format("at least one reference shot is needed, not {}", settings.references));
  if (settings.checkInterval < 1)
    found.push_back(fmt::format("checks cannot be {} shots apart", settings.checkInterval));
  if (settings.verificationPatterns < 0)
    found.push_back(
        fmt::format("the number of verification patterns cannot be {}", settings.verificationPatterns));
  if (!(settings.flagRelative > 0.0 && settings.flagSigmas > 0.0))
    found.push_back(fmt::format("the limits for flagging must be above 0, not {} and {}",
                                settings.flagRelative, settings.flagSigmas));
  return found;
}

AcquisitionSettings settingsOf(AcquisitionMode mode) {
  AcquisitionSettings settings;
  switch (mode) {
    case AcquisitionMode::adaptive:
      break;
    case AcquisitionMode::sen:
      settings.scheme = AcquisitionScheme::sen;
      break;
    case AcquisitionMode::fast:
      settings.colours = LitColours::white;
      settings.singleExposure = true;
      settings.relativeThreshold = 0.02;
      settings.references = 2;
      settings.verificationPatterns = 4;
      break;
  }
  return settings;
}

}  // namespace relucent
