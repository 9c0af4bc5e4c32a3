// SPDX-License-Identifier: MIT
#include "relucent/acquisition/renewal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "relucent/acquisition/fitted_transport.h"
#include "relucent/acquisition/mixed_rows.h"
#include "relucent/acquisition/multiplexed.h"
#include "relucent/acquisition/repair.h"
#include "relucent/acquisition/test_photographs.h"
#include "relucent/base/error.h"
#include "relucent/sentinels/black_following.h"
#include "relucent/transport/leaf_sharing.h"

namespace relucent::acquisition {
namespace {

using transport::ColourBlock;

// Shares of the time.
constexpr double referenceShare = 0.2, lookShare = 0.15, adaptShare = 0.1, measureShare = 0.45;

// Squares of a row's differences, beyond so many times what noise makes of them: 24 values or more, whose
// squares are off by a third of their mean at one standard deviation.
constexpr double beyondNoise = 2.5;
// Rows around wrong ones are measured with them, pixels: an edge that moved is wrong by halves beside it.
constexpr int around = 1;

/// The same flags, and those of pixels around.
CameraMask widened(const CameraMask& flags, const Rasters& cameras) {
  CameraMask wide = flags;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t offset = cameras.offset(camera);
    for (std::size_t i = 0; i < size.count(); ++i) {
      if (!flags[offset + i]) continue;
      const Pixel at = pixelAt(size, i);
      for (int y = std::max(0, at.y - around); y <= std::min(size.height - 1, at.y + around); ++y)
        for (int x = std::max(0, at.x - around); x <= std::min(size.width - 1, at.x + around); ++x)
          wide[offset + indexOf(size, {x, y})] = 1;
    }
  }
  return wide;
}

double sumOf(const Stack& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class Renewing {
 public:
  Renewing(const AcquisitionRun& run, const transport::Acquisition& former, const RenewalSettings& settings,
           sentinels::Supervision& supervision)
      : run_(run),
        former_(former),
        settings_(settings),
        supervision_(supervision),
        shotsBefore_(run.shots.shots()),
        exposuresBefore_(run.shots.exposures()),
        photographer_(run.shots, run.linearization) {}

  sentinels::Interruptible<Renewal> renew(Progress& progress) {
    Progress referencePart =
        progress.part(referenceShare, RELUCENT_MESSAGE("stage.black-and-full-light", "black and full light"));
    const photography::References references = photography::measureReferences(
        photographer_, referenceRounds(run_.settings, run_.shots.rig().projectors.size()),
        run_.settings.dimShare, referencePart);
    requireLight(references);
    const Scheme scheme = schemeOf(run_.settings, references);
    sentinels::Watch watch(photographer_, references,
                           {run_.settings.checkInterval, run_.settings.mayBeMirrored}, supervision_);
    if (auto interrupted = watch.begin(referencePart)) return *interrupted;
    const TreeContext context{watch, scheme, supervision_.observer};

    Progress looking = progress.part(lookShare, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
    TestPhotographs tests(context, patternSettings(), 0);
    const CameraMask counted = countedRows(references);
    auto before = tests.compared(former_.transport, counted, looking);
    if (!before) return before.interruption();

    Renewal renewal;
    renewal.errorBefore = errorOf(before->rows);
    renewal.change.wrong = flaggedShareOf(wrongRows(*before), counted);
    Progress adapting = progress.part(
        adaptShare,
        RELUCENT_MESSAGE("stage.adapting-light-transport", "fitting the light transport to what is seen"));
    FittedTransport adapted = fittedTransport(former_, references, tests, renewal.change, adapting);
    unknown_ = std::move(adapted.unknown);
    auto fitted = comparedAgain(*before, renewal.change, adapted, counted, tests, adapting);
    if (!fitted) return fitted.interruption();
    const bool isBetter = renewal.errorBefore > 0.0 && errorOf(fitted->rows) < renewal.errorBefore;
    if (!isBetter && !renewal.change.isOfLight()) {
      // Nothing that was thought of explains what is seen better than the former T does.
      adapted.transport = former_.transport;
      fitted = std::move(before);
      renewal.change.moved.assign(renewal.change.moved.size(), {});
      renewal.change.pictures = renewal.change.moved;
      unknown_.assign(counted.size(), 0);
    }
    renewal.errorAdapted = errorOf(fitted->rows);
    renewal.change.unknown = flaggedShareOf(unknown_, references.usable);

    VerifiedTransport verified{std::move(adapted.transport),
                               former_.leafVariance,
                               former_.flagged,
                               fitted->residual,
                               errorOf(fitted->rows),
                               0};
    Progress measuring = progress.part(
        measureShare,
        RELUCENT_MESSAGE("stage.measuring-what-changed", "measuring what is no longer as it was"));
    const CameraMask wrong = toMeasure(*fitted, references, counted);
    if (auto interrupted =
            measureAgain(renewal, verified, *std::move(fitted), wrong, context, references, measuring))
      return *interrupted;
    if (auto interrupted = watch.check(progress)) return *interrupted;
    renewal.change.ambient =
        sumOf(former_.flood) > 0.0
            ? (sumOf(watch.black().radiance) - sumOf(former_.black)) / sumOf(former_.flood)
            : 0.0;
    renewal.acquisition = finished(std::move(verified), watch);
    progress.report(1.0);
    return renewal;
  }

 private:
  const AcquisitionSettings& patternSettings() {
    patterns_ = run_.settings;
    patterns_.verificationPatterns = std::max(verificationSizes, patterns_.verificationPatterns);
    return patterns_;
  }

  void requireLight(const photography::References& references) const {
    const double then = sumOf(former_.flood), now = sumOf(floodsOf(references).light);
    if (now > settings_.leastLight * then) return;
    throw Error(
        ErrorKind::device,
        RELUCENT_ENGLISH_MESSAGE("renewal.no-light", "the camera sees almost none of the projectors' light"),
        RELUCENT_ENGLISH_MESSAGE("renewal.look-for-light",
                                 "look whether the lens is covered or the projector off, then try again"));
  }

  CameraMask countedRows(const photography::References& references) const {
    CameraMask counted = references.usable;
    for (std::size_t row = 0; row < counted.size(); ++row)
      if (former_.flagged[row]) counted[row] = 0;
    return counted;
  }

  /// The relative error of a row when it was measured: its test patterns show it about half of its light.
  double errorThen(std::size_t row) const {
    double squared = 0.0, light = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto flood = static_cast<double>(former_.flood[3 * row + c]);
      light += 0.25 * flood * flood;
      for (const CameraStack& map : former_.residual)
        squared += std::pow(static_cast<double>(map[3 * row + c]), 2.0) /
                   static_cast<double>(former_.residual.size());
    }
    return light > 0.0 ? std::sqrt(squared / light) : 0.0;
  }

  CameraMask wrongRows(const Verification& verification) const {
    CameraMask wrong(verification.rows.size(), 0);
    for (std::size_t row = 0; row < wrong.size(); ++row) {
      const Residual& found = verification.rows[row];
      const double limit = std::max(settings_.wrongFrom, settings_.timesBefore * errorThen(row));
      wrong[row] = found.squared > beyondNoise * found.noise && found.squared > limit * limit * found.light;
    }
    return wrong;
  }

  /// The share of all rows' squared errors that wrong ones have, beyond noise and what they had when they
  /// were measured: at most that is to be gained by measuring them.
  double errorOfWrong(const Verification& verification, const CameraMask& wrong) const {
    double gained = 0.0, all = 0.0;
    for (std::size_t row = 0; row < wrong.size(); ++row) {
      const Residual& found = verification.rows[row];
      all += found.squared;
      if (wrong[row])
        gained += std::max(0.0, found.squared - found.noise - std::pow(errorThen(row), 2.0) * found.light);
    }
    return all > 0.0 ? gained / all : 0.0;
  }

  /// What test patterns say of the fitted T. Where neither a view nor a lamp has changed, they say of most
  /// rows what they said `before`.
  static sentinels::Interruptible<Verification> comparedAgain(const Verification& before,
                                                              const VenueChange& change,
                                                              const FittedTransport& fitted,
                                                              const CameraMask& counted,
                                                              TestPhotographs& tests, Progress& progress) {
    const auto isMoved = [](const sentinels::Movement& movement) { return movement.explains; };
    const bool isOfSurfaces =
        std::ranges::none_of(change.moved, isMoved) && std::ranges::none_of(change.pictures, isMoved) &&
        std::ranges::all_of(change.light,
                            [](const ColourBlock& left) { return left == ColourBlock::Ones(); });
    if (!isOfSurfaces) return tests.compared(fitted.transport, counted, progress);
    CameraMask rows = counted;
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (!fitted.ofItsOwn[row]) rows[row] = 0;
    auto found = tests.compared(fitted.transport, rows, progress);
    if (!found) return found.interruption();
    Verification all = before;
    replaceRows(all, *found, rows);
    return all;
  }

  /// Which rows are to be measured; none: it is not worth while.
  CameraMask toMeasure(const Verification& fitted, const photography::References& references,
                       const CameraMask& counted) const {
    CameraMask wrong = wrongRows(fitted);
    for (std::size_t row = 0; row < wrong.size(); ++row)
      if (unknown_[row] && references.usable[row]) wrong[row] = 1;
    const double share = flaggedShareOf(wrong, references.usable);
    if (share < settings_.measuredFrom ||
        (flaggedShareOf(unknown_, references.usable) < settings_.measuredFrom &&
         errorOfWrong(fitted, wrong) < settings_.worthMeasuring))
      return CameraMask(wrong.size(), 0);
    if (share > settings_.allFrom) return references.usable;
    wrong = widened(wrong, references.cameras);
    for (std::size_t row = 0; row < wrong.size(); ++row)
      // What was flagged may have become well since.
      wrong[row] = references.usable[row] && (wrong[row] || !counted[row]) ? 1 : 0;
    return wrong;
  }

  /// `found`: what test patterns say of `verified`. Only the rows that are measured again see others.
  std::optional<sentinels::Interruption> measureAgain(Renewal& renewal, VerifiedTransport& verified,
                                                      Verification found, const CameraMask& rows,
                                                      const TreeContext& context,
                                                      const photography::References& all,
                                                      Progress& progress) {
    renewal.errorAfter = renewal.errorAdapted;
    if (std::ranges::count(rows, 1) == 0) return std::nullopt;
    photography::References references = all;
    references.usable = rows;
    MeasuredTransport measured;
    Progress part = progress.part(0.8, RELUCENT_MESSAGE("stage.light-transport", "light transport"));
    if (auto interrupted =
            measureMultiplexed(measured, context, references, photographer_, run_.settings, false, part))
      return interrupted;
    Progress testing = progress.part(0.2, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
    TestPhotographs tests(context, patterns_, patterns_.verificationPatterns);
    auto before = tests.compared(verified.transport, rows, testing);
    if (!before) return before.interruption();
    auto after = tests.compared(measured.transport, rows, testing);
    if (!after) return after.interruption();

    CameraMask better(rows.size(), 0);
    for (std::size_t row = 0; row < rows.size(); ++row)
      better[row] = rows[row] && !measured.unknown[row] &&
                            (unknown_[row] || after->rows[row].relative() < before->rows[row].relative())
                        ? 1
                        : 0;
    renewal.measured = flaggedShareOf(better, all.usable);
    const bool isAll = better == all.usable;
    verified.transport =
        isAll ? std::move(measured.transport) : mixedRows(verified.transport, measured.transport, better);
    if (isAll || verified.transport.groups().empty())
      verified.transport =
          transport::withSharedLeaves(verified.transport, transport::sharingTolerance, testing);
    replaceRows(verified.leafVariance, measured.leafVariance, better);
    measuredRows_ = better;
    measuredFloods_ = std::move(measured.floods);
    replaceRows(found, *before, rows);
    replaceRows(found, *after, better);
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (rows[row]) verified.flagged[row] = found.flagged[row];
    for (std::size_t size = 0; size < verified.residual.size(); ++size)
      replaceRows(verified.residual[size], found.residual[size], better);
    verified.remeasured = static_cast<int>(std::ranges::count(better, 1));
    verified.error = renewal.errorAfter = errorOf(found.rows);
    return std::nullopt;
  }

  /// e as it is now; where it is what it was, the former measurement tells of it too.
  hdr::BlackLevel blackOf(const sentinels::Watch& watch) const {
    hdr::BlackLevel former(hdr::HdrFrame{former_.black, former_.blackVariance,
                                         std::vector<std::uint8_t>(former_.black.size(), 1)});
    hdr::BlackLevel now = watch.black();
    if (!sentinels::hasChanged(now, former)) sentinels::join(now, former);
    return now;
  }

  /// Of the rows that were measured as dense patterns tell; of others what they were, times what became of
  /// their T, of which more is known than their floods say: what has not changed stays the same to the bit.
  Floods floodsNow(const VerifiedTransport& verified, const photography::References& references) const {
    Floods floods = floodsOf(references);
    const CameraStack now = verified.transport.floodlight(), then = former_.transport.floodlight();
    for (std::size_t row = 0; row < verified.flagged.size(); ++row) {
      if (!references.usable[row]) continue;
      const bool isMeasured = !measuredRows_.empty() && measuredRows_[row];
      for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) {
        const float known = then[i] > 0.0f ? former_.flood[i] * (now[i] / then[i]) : now[i];
        floods.light[i] = isMeasured ? measuredFloods_.light[i] : known;
        floods.variance[i] =
            isMeasured ? measuredFloods_.variance[i] : std::min(floods.variance[i], former_.floodVariance[i]);
      }
    }
    return floods;
  }

  transport::Acquisition finished(VerifiedTransport verified, const sentinels::Watch& watch) const {
    const photography::References& references = watch.references();
    Floods floods = floodsNow(verified, references);
    hdr::BlackLevel black = blackOf(watch);
    for (std::size_t row = 0; row < verified.flagged.size(); ++row)
      if (!references.usable[row]) verified.flagged[row] = 1;
    return {.transport = std::move(verified.transport),
            .black = std::move(black.radiance),
            .blackVariance = std::move(black.variance),
            .flood = std::move(floods.light),
            .floodVariance = std::move(floods.variance),
            .flagged = std::move(verified.flagged),
            .residual = std::move(verified.residual),
            .leafVariance = std::move(verified.leafVariance),
            .remeasured = verified.remeasured,
            .unresolvedEnergy = former_.unresolvedEnergy,
            .verificationError = verified.error,
            .patterns = run_.shots.shots() - shotsBefore_,
            .exposures = run_.shots.exposures() - exposuresBefore_,
            .stoppedAt = former_.stoppedAt,
            .expected = former_.expected,
            .findings = former_.findings,  // of how that was measured which stays
            .overexposed = former_.overexposed};
  }

  const AcquisitionRun& run_;
  const transport::Acquisition& former_;
  const RenewalSettings& settings_;
  sentinels::Supervision& supervision_;
  int shotsBefore_, exposuresBefore_;
  photography::Photographer photographer_;
  AcquisitionSettings patterns_;
  CameraMask unknown_;
  CameraMask measuredRows_;  // empty: none
  Floods measuredFloods_;
};

}  // namespace

Renewal renew(const AcquisitionRun& run, const transport::Acquisition& former,
              const RenewalSettings& settings, Progress& progress) {
  sentinels::AcquisitionObserver nobody;
  sentinels::Supervision supervision{run.handler, run.observer ? *run.observer : nobody};
  const int shotsBefore = run.shots.shots();
  while (true) {
    sentinels::Interruptible<Renewal> renewed = Renewing(run, former, settings, supervision).renew(progress);
    if (renewed) return *std::move(renewed);
    run.shots.goBackTo(shotsBefore);
  }
}

}  // namespace relucent::acquisition
