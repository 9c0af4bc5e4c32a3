// SPDX-License-Identifier: MIT
#include "relucent/acquisition/reverification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "relucent/acquisition/verification.h"
#include "relucent/base/error.h"
#include "relucent/photography/photographer.h"

namespace relucent::acquisition {
namespace {

// Of the lamp: less is a covered lens or a projector that is off.
constexpr double leastLight = 0.1;
// The sentinels' limits (README): what would have paused the measurement is worth measuring again.
constexpr double lampLimit = 0.1;
constexpr double ambientLimit = 0.004;
// The share of wrong pixels that is worth a sentence when T is measured.
constexpr double changedLimit = 0.02;
constexpr double mostlyChanged = 0.5;
// A good T's error is threshold and noise; neither doubles from one day to the next. What is beyond that is
// a change too small for any single pixel.
constexpr double errorLimit = 2.0;
constexpr double errorFloor = 0.01;

double meanOf(const Stack& stack) {
  double sum = std::accumulate(stack.begin(), stack.end(), 0.0);
  return stack.empty() ? 0.0 : sum / static_cast<double>(stack.size());
}

/// What noise may hide in a frame: as much as while T was measured, a share of the flood image of each pixel,
/// or of the mean where that is dark.
std::vector<float> tolerableNoise(const CameraStack& flood, const AcquisitionSettings& settings) {
  std::vector<float> tolerable(flood.size() / 3);
  auto dimmest = static_cast<float>(settings.dimShare * meanOf(flood));
  auto share = static_cast<float>(settings.relativeThreshold / settings.noiseSigmas);
  for (std::size_t row = 0; row < tolerable.size(); ++row)
    tolerable[row] = share * std::max({dimmest, flood[3 * row], flood[3 * row + 1], flood[3 * row + 2]});
  return tolerable;
}

Residual sumOf(const std::array<Residual, verificationSizes>& bySize) {
  Residual sum;
  for (const Residual& residual : bySize) sum.add(residual);
  return sum;
}

void findChanged(Reverification& found, const Verification& verification,
                 const std::vector<std::uint8_t>& counted, const AcquisitionSettings& settings) {
  std::size_t changed = 0, all = 0;
  found.changed.assign(counted.size(), 0);
  for (std::size_t row = 0; row < counted.size(); ++row) {
    if (!counted[row]) continue;
    Residual residual = verification.rows[row];
    residual.squared = residual.squaredAt(found.lamp);
    found.changed[row] = isWrong(residual, settings) ? 1 : 0;
    changed += found.changed[row];
    ++all;
  }
  found.changedShare = all > 0 ? static_cast<double>(changed) / static_cast<double>(all) : 0.0;
}

}  // namespace

Reverification verifyAgain(const AcquisitionRun& run, const transport::Acquisition& acquisition,
                           Progress& progress) {
  photography::Photographer photographer(run.shots, run.linearization);
  const transport::TransportMatrix& transport = acquisition.transport;
  require(photographer.cameras().count() == transport.cameras().count() &&
              photographer.projectors().count() == transport.projectors().count(),
          "{} camera and {} projector pixels for a T of {} and {}", photographer.cameras().count(),
          photographer.projectors().count(), transport.cameras().count(), transport.projectors().count());

  const hdr::BlackLevel black(
      photographer.takeAll(ProjectorStack(3 * transport.projectors().count(), 0.0f), progress));
  std::vector<std::uint8_t> counted(acquisition.flagged.size());
  for (std::size_t row = 0; row < counted.size(); ++row) counted[row] = acquisition.flagged[row] == 0 ? 1 : 0;
  std::vector<float> tolerable = tolerableNoise(acquisition.flood, run.settings);
  // As if the lamp were as strong as then: how strong it is follows from these very photographs.
  auto light = [&](const ProjectorStack& pattern,
                   const std::vector<photography::Demand>& demands) -> sentinels::Interruptible<SeenLight> {
    return std::make_shared<const hdr::LampLight>(
        hdr::ProjectedLight(photographer.take(pattern, demands, progress), black), 1.0);
  };
  AcquisitionSettings patterns = run.settings;
  patterns.verificationPatterns = std::max(verificationSizes, run.settings.verificationPatterns);
  const Verification verification =
      *verify({transport, black.radiance, tolerable}, light, {patterns, counted}, progress);

  Reverification found;
  Residual all = sumOf(verification.bySize);
  found.error = all.relative();
  for (std::size_t size = 0; size < verificationSizes; ++size)
    found.errorOf[size] = verification.bySize[size].relative();
  found.lamp = all.predicted > 0.0 ? std::max(0.0, all.cross() / all.predicted) : 0.0;
  found.adapted = all.light > 0.0 ? std::sqrt(all.squaredAt(found.lamp) / all.light) : 0.0;
  double flood = meanOf(acquisition.flood);
  found.ambient = flood > 0.0 ? (meanOf(black.radiance) - meanOf(acquisition.black)) / flood : 0.0;
  findChanged(found, verification, counted, run.settings);
  found.residual = verification.residual;
  found.patterns = run.shots.shots();
  found.exposures = run.shots.exposures();
  progress.report(1.0);
  return found;
}

std::string_view toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::stillGood:
      return "still_good";
    case Verdict::remeasure:
      return "remeasure";
    case Verdict::startAgain:
      return "start_again";
  }
  return "";
}

namespace {

Message roomChange(double ambient) {
  const Argument share = as::share(std::abs(ambient), as::decimals(1));
  return ambient > 0.0
             ? RELUCENT_ENGLISH_MESSAGE(
                   "verify.room-brighter",
                   "Repair: the room is brighter by {} % of the projector's full light than it was; "
                   "restore the light and verify once more, or repair the calibration.")
                   .with(share)
             : RELUCENT_ENGLISH_MESSAGE(
                   "verify.room-darker",
                   "Repair: the room is darker by {} % of the projector's full light than it was; "
                   "restore the light and verify once more, or repair the calibration.")
                   .with(share);
}

}  // namespace

bool isLightSeen(double lamp) {
  return lamp > leastLight;
}

bool isRoomChanged(double ambient) {
  return std::abs(ambient) > ambientLimit;
}

Judgement judge(const Reverification& found, double errorThen) {
  if (!isLightSeen(found.lamp))
    return {
        Verdict::startAgain,
        RELUCENT_ENGLISH_MESSAGE("verify.no-light",
                                 "Start again: the camera sees almost none of the projector's light; look "
                                 "whether the lens is covered, the projector off or another screen "
                                 "chosen, and verify once more before you measure everything again.")};
  if (found.changedShare > mostlyChanged)
    return {Verdict::startAgain,
            RELUCENT_ENGLISH_MESSAGE(
                "verify.moved",
                "Start again: {} % of the camera's pixels do not see what was "
                "predicted, as when the camera, the projector or its zoom has moved; "
                "put them back and verify once more, repair the calibration, or measure everything "
                "again.")
                .with(as::share(found.changedShare, as::decimals(0)))};
  if (isRoomChanged(found.ambient)) return {Verdict::remeasure, roomChange(found.ambient)};
  if (found.changedShare > changedLimit)
    return {Verdict::remeasure,
            RELUCENT_ENGLISH_MESSAGE("verify.view-changed",
                                     "Repair: {} % of the camera's pixels do not see what was predicted; "
                                     "the map of changes shows where something was moved. Put it back and "
                                     "verify once more, or repair the calibration.")
                .with(as::share(found.changedShare, as::decimals(1)))};
  if (std::abs(found.lamp - 1.0) > lampLimit)
    return {Verdict::remeasure,
            RELUCENT_ENGLISH_MESSAGE(
                "verify.lamp-changed",
                "Repair: the projector gives {} % of the light that it gave; let it warm up, restore its "
                "settings and verify once more, or repair the calibration.")
                .with(as::share(found.lamp, as::decimals(0)))};
  if (found.adapted > errorLimit * errorThen + errorFloor)
    return {Verdict::remeasure,
            RELUCENT_ENGLISH_MESSAGE(
                "verify.prediction-worse",
                "Repair: T predicts photographs to {} % where it was {} %, though no place stands out; the "
                "focus or the picture settings may have changed. Repair the calibration.")
                .with(as::share(found.adapted, as::decimals(1)), as::share(errorThen, as::decimals(1)))};
  return {Verdict::stillGood,
          RELUCENT_ENGLISH_MESSAGE("verify.still-good",
                                   "Still good: T predicts photographs that it was not made from to {} %, {} "
                                   "% when it was measured; {} % of the camera's pixels changed.")
              .with(as::share(found.error, as::decimals(1)), as::share(errorThen, as::decimals(1)),
                    as::share(found.changedShare, as::decimals(1)))};
}

}  // namespace relucent::acquisition
