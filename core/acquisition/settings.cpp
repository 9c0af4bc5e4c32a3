// SPDX-License-Identifier: MIT
#include "relucent/acquisition/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::acquisition {

std::vector<Message> problems(const AcquisitionSettings& settings) {
  std::vector<Message> found;
  if (!(settings.relativeThreshold > 0.0 && settings.relativeThreshold < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.relative-threshold-out-of-range",
                                             "the relative threshold must lie between 0 and 1, not at {}")
                        .with(settings.relativeThreshold));
  if (!(settings.absoluteThreshold >= 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.absolute-threshold-negative",
                                             "the absolute threshold cannot be below 0, as {} is")
                        .with(settings.absoluteThreshold));
  if (!(settings.noiseSigmas > 0.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("acquisition.noise-threshold-not-positive",
                                 "the noise threshold must be above 0 standard deviations, not {}")
            .with(settings.noiseSigmas));
  if (!(settings.dimShare >= 0.0 && settings.dimShare <= 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.dim-share-out-of-range",
                                             "the share for dim pixels must lie between 0 and 1, not at {}")
                        .with(settings.dimShare));
  if (settings.scheme == AcquisitionScheme::multiplexed && settings.colours == LitColours::white)
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "acquisition.dense-patterns-not-white",
        "dense patterns have colours by chance: leave out white, or measure in the mode adaptive or sen"));
  if (settings.references < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.no-reference-shots",
                                             "at least one reference shot is needed, not {}")
                        .with(settings.references));
  if (settings.checkInterval < 1)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("acquisition.check-interval-not-positive", "checks cannot be {} shots apart")
            .with(settings.checkInterval));
  if (settings.verificationPatterns < 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.verification-patterns-negative",
                                             "the number of verification patterns cannot be {}")
                        .with(settings.verificationPatterns));
  if (!(settings.flagRelative > 0.0 && settings.flagSigmas > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("acquisition.flag-limits-not-positive",
                                             "the limits for flagging must be above 0, not {} and {}")
                        .with(settings.flagRelative, settings.flagSigmas));
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
    case AcquisitionMode::multiplexed:
      settings.scheme = AcquisitionScheme::multiplexed;
      settings.relativeThreshold = 0.012;
      settings.references = 2;
      settings.verificationPatterns = 8;
      break;
  }
  return settings;
}

photography::ReferenceRounds referenceRounds(const AcquisitionSettings& settings, std::size_t projectors) {
  const bool dense = settings.scheme == AcquisitionScheme::multiplexed;
  const int shared =
      std::max(1, settings.references / static_cast<int>(std::max<std::size_t>(1, projectors)));
  return {settings.references, dense ? shared : settings.references};
}

}  // namespace relucent::acquisition
