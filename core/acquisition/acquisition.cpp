// SPDX-License-Identifier: MIT
#include "relucent/acquisition/acquisition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "relucent/acquisition/forecast.h"
#include "relucent/acquisition/growth.h"
#include "relucent/acquisition/multiplexed.h"
#include "relucent/acquisition/repair.h"
#include "relucent/base/error.h"
#include "relucent/transport/leaf_sharing.h"
#include "relucent/transport/statistics.h"

namespace relucent::acquisition {
namespace {

// Shares of the time: the tree takes nearly all of it.
constexpr double referenceShare = 0.06;
constexpr double treeShare = 0.87;
constexpr double sharingShare = 0.01;
constexpr double verificationShare = 0.04;

// What is worth a sentence to the user.
constexpr double driftLimit = 0.02;
constexpr double flaggedLimit = 0.02;
constexpr double unusableLimit = 0.01;

double shareOf(const std::vector<std::uint8_t>& flags) {
  return static_cast<double>(std::count(flags.begin(), flags.end(), 1)) / static_cast<double>(flags.size());
}

double unresolvedEnergy(const transport::TransportMatrix& transport, const CameraStack& flood) {
  Stack explained = transport.floodlight();
  double all = 0.0, missing = 0.0;
  for (std::size_t i = 0; i < flood.size(); ++i) {
    all += static_cast<double>(flood[i]);
    missing += static_cast<double>(flood[i]) - static_cast<double>(explained[i]);
  }
  return all > 0.0 ? missing / all : 0.0;
}

/// What the user should know of a measurement.
std::vector<Message> findingsOf(double drift, double unusable, double flagged,
                                const sentinels::Supervision& supervision) {
  std::vector<Message> findings;
  if (std::abs(drift) > driftLimit)
    findings.push_back(
        RELUCENT_MESSAGE("acquisition.light-drifted",
                         "The light changed by {} % between the first and the last photograph; this was "
                         "compensated for, but let the projector warm up before the next time")
            .with(as::share(drift, as::decimals(1))));
  if (unusable > unusableLimit)
    findings.push_back(
        RELUCENT_MESSAGE("acquisition.overexposed",
                         "{} % of the camera pixels are overexposed even at the shortest exposure: close the "
                         "camera's aperture a little, then measure again")
            .with(as::share(unusable, as::decimals(1))));
  if (flagged > flaggedLimit)
    findings.push_back(
        RELUCENT_MESSAGE(
            "acquisition.pixels-flagged",
            "{} % of the camera pixels do not see what was predicted for the test patterns: check that "
            "nothing moved or flickered; these pixels are left out of the compensation")
            .with(as::share(flagged, as::decimals(1))));
  for (const auto& [what, first, patterns] : supervision.again)
    findings.push_back(RELUCENT_PLURAL_MESSAGE("acquisition.taken-again",
                                               "{}: {} patterns from No. {} on were photographed again",
                                               "{}: {} pattern from No. {} on was photographed again")
                           .with(what, as::count(patterns), as::label(first + 1)));
  if (supervision.endedBy)
    findings.push_back(
        RELUCENT_MESSAGE("acquisition.ended-by-change",
                         "measuring ended with a change: {}; photographs from No. {} on are left out")
            .with(supervision.endedBy->what, as::label(supervision.endedBy->first + 1)));
  for (const auto& [asked, what] : supervision.accepted)
    findings.push_back(RELUCENT_MESSAGE("acquisition.alarm-skipped", "accepted before pattern {}: {}")
                           .with(as::label(asked.first + 1), what));
  return findings;
}

std::optional<transport::FoundChange> changeOf(const std::optional<sentinels::Alarm>& alarm) {
  if (!alarm) return std::nullopt;
  return transport::FoundChange{alarm->what, alarm->kind == sentinels::AlarmKind::moved || alarm->isGone};
}

/// Tells of the tree's progress, and from every level on what there is still to do.
class TreeObserver : public sentinels::AcquisitionObserver {
 public:
  using LevelBegins = std::function<void(const std::vector<int>& levels)>;

  TreeObserver(sentinels::AcquisitionObserver& other, LevelBegins levelBegins)
      : other_(other), levelBegins_(std::move(levelBegins)) {}

  void checked(const sentinels::Reading& reading) override { other_.checked(reading); }
  void takenAgain(const sentinels::Retake& retake) override { other_.takenAgain(retake); }
  void grew(const std::vector<int>& levels, int through) override {
    if (through == 0) levelBegins_(levels);
    other_.grew(levels, through);
  }
  bool wantsDrafts() const override { return other_.wantsDrafts(); }
  void drafted(const transport::Draft& draft) override { other_.drafted(draft); }

 private:
  sentinels::AcquisitionObserver& other_;
  LevelBegins levelBegins_;
};

/// The parts of a measurement, in order, on shots that may be gone back over.
class Measurement {
 public:
  Measurement(const AcquisitionRun& run, sentinels::Supervision& supervision)
      : run_(run),
        supervision_(supervision),
        shotsBefore_(run.shots.shots()),
        exposuresBefore_(run.shots.exposures()),
        photographer_(run.shots, run.linearization) {}

  /// Returns: no other interruption than beginAgain.
  sentinels::Interruptible<transport::Acquisition> measure(Progress& progress) {
    expect(progress, {});
    Progress referencePart =
        progress.part(referenceShare, RELUCENT_MESSAGE("stage.black-and-full-light", "black and full light"));
    const photography::References references = photography::measureReferences(
        photographer_, referenceRounds(run_.settings, run_.shots.rig().projectors.size()),
        run_.settings.dimShare, referencePart);
    const Scheme scheme = schemeOf(run_.settings, references);
    sentinels::Watch watch(photographer_, references,
                           {run_.settings.checkInterval, run_.settings.mayBeMirrored}, supervision_);
    std::optional<sentinels::Interruption> interrupted = watch.begin(referencePart);
    if (interrupted == sentinels::Interruption::beginAgain) return *interrupted;

    Progress treePart =
        progress.part(treeShare, RELUCENT_MESSAGE("stage.light-transport", "light transport"));
    TreeObserver observer(supervision_.observer,
                          [&](const std::vector<int>& levels) { expect(progress, levels); });
    const TreeContext context{watch, scheme, observer};
    MeasuredTransport measured;
    std::optional<sentinels::Interruption> dropped =
        run_.settings.scheme == AcquisitionScheme::multiplexed
            ? measureMultiplexed(measured, context, references, photographer_, run_.settings,
                                 interrupted.has_value(), treePart)
            : measureTree(measured, context, interrupted.has_value(), treePart);
    if (dropped == sentinels::Interruption::beginAgain) return *dropped;

    if (measured.transport.ownLeaves().sharedColours()) {
      Progress sharing = progress.part(
          sharingShare, RELUCENT_MESSAGE("stage.sharing-leaves", "light that neighbouring pixels share"));
      measured.transport =
          transport::withSharedLeaves(measured.transport, transport::sharingTolerance, sharing);
    }
    Progress verificationPart =
        progress.part(verificationShare, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
    const CameraMask unknown = std::move(measured.unknown);
    Floods floods = std::move(measured.floods);
    const bool isUnfinished = measured.isStopped;
    VerifiedTransport verified = unverified(std::move(measured), references);
    if (!interrupted && !dropped) {
      interrupted = verify(verified, context, verificationPart);
      if (interrupted == sentinels::Interruption::beginAgain) return *interrupted;
    }
    for (std::size_t row = 0; row < verified.flagged.size(); ++row)
      if (!references.usable[row] || unknown[row]) verified.flagged[row] = 1;
    const bool stopped = interrupted || dropped || progress.stopAndKeep();
    const int blocks = transport::finestSide(verified.transport);
    const int stoppedAt = isUnfinished || (stopped && blocks > 1) ? blocks : 0;
    transport::Acquisition acquisition = finished(std::move(verified), std::move(floods), stoppedAt, watch);
    progress.report(1.0);
    return acquisition;
  }

 private:
  void expect(const Progress& progress, const std::vector<int>& levels) const {
    AcquisitionState state{levels, run_.shots.shots() - shotsBefore_, run_.shots.times()};
    progress.expect(forecast(forecastDevices(run_.shots.rig(), run_.linearization.exposures), run_.settings,
                             run_.linearization.times, state));
  }

  static std::optional<sentinels::Interruption> measureTree(MeasuredTransport& measured,
                                                            const TreeContext& context, bool rootsOnly,
                                                            Progress& progress) {
    const photography::References& references = context.references();
    Tree tree = emptyTree(references, references.usable);
    std::optional<sentinels::Interruption> dropped = growTree(tree, context, rootsOnly, progress);
    if (dropped == sentinels::Interruption::beginAgain) return dropped;
    measured.leafVariance = leafVarianceOf(tree);
    measured.unknown = std::move(tree.unknown);
    measured.transport =
        transport::TransportMatrix(references.cameras, references.projectors, takeLeaves(tree, references));
    return dropped;
  }

  static VerifiedTransport unverified(MeasuredTransport measured, const photography::References& references) {
    std::size_t rows = references.usable.size();
    return {std::move(measured.transport), std::move(measured.leafVariance), CameraMask(rows, 0),
            std::vector<CameraStack>(verificationSizes, CameraStack(3 * rows, 0.0f))};
  }

  static void forgetVerification(VerifiedTransport& verified) {
    std::ranges::fill(verified.flagged, 0);
    for (CameraStack& residual : verified.residual) std::ranges::fill(residual, 0.0f);
    verified.error = 0.0;
  }

  /// Whoever asked to stop and keep waits for the test patterns alone.
  std::optional<sentinels::Interruption> verify(VerifiedTransport& verified, const TreeContext& context,
                                                Progress& progress) const {
    const AcquisitionSettings& settings = run_.settings;
    if (progress.stopAndKeep()) return verifyOnly(verified, context, settings, progress);
    if (auto interrupted = context.watch.check(progress)) return interrupted;
    const int confirmed = context.watch.confirmed();
    std::optional<sentinels::Interruption> interrupted =
        verifyAndRepair(verified, context, settings, progress);
    if (!interrupted) interrupted = context.watch.check(progress);
    // Test patterns that no look has confirmed say nothing of T.
    if (interrupted && context.watch.confirmed() == confirmed) forgetVerification(verified);
    return interrupted;
  }

  transport::Acquisition finished(VerifiedTransport verified, Floods better, int stoppedAt,
                                  const sentinels::Watch& watch) const {
    const photography::References& references = watch.references();
    Floods floods = floodsOf(references);
    double unresolved = unresolvedEnergy(verified.transport, floods.light);
    if (!better.light.empty()) floods = std::move(better);
    const double flagged = shareOf(verified.flagged), overexposed = 1.0 - shareOf(references.usable);
    return {.transport = std::move(verified.transport),
            .black = watch.black().radiance,
            .blackVariance = watch.black().variance,
            .flood = std::move(floods.light),
            .floodVariance = std::move(floods.variance),
            .flagged = std::move(verified.flagged),
            .residual = std::move(verified.residual),
            .leafVariance = std::move(verified.leafVariance),
            .remeasured = verified.remeasured,
            .unresolvedEnergy = unresolved,
            .verificationError = verified.error,
            .patterns = run_.shots.shots() - shotsBefore_,
            .exposures = run_.shots.exposures() - exposuresBefore_,
            .stoppedAt = stoppedAt,
            .findings = findingsOf(watch.power() - 1.0, overexposed, flagged, supervision_),
            .changed = changeOf(supervision_.endedBy),
            .overexposed = overexposed};
  }

  const AcquisitionRun& run_;
  sentinels::Supervision& supervision_;
  int shotsBefore_, exposuresBefore_;
  photography::Photographer photographer_;
};

}  // namespace

transport::Acquisition acquire(const AcquisitionRun& run, Progress& progress) {
  std::vector<Message> wrong = problems(run.settings);
  require(wrong.empty(), "{}", fmt::join(wrong, "; "));
  linearization::Linearization used = run.linearization;
  if (run.settings.singleExposure) used.exposures = {used.exposures.back()};
  sentinels::AcquisitionObserver nobody;
  sentinels::Supervision supervision{run.handler, run.observer ? *run.observer : nobody};
  supervision.isEnding = [&progress] { return progress.stopAndKeep(); };
  const AcquisitionRun adapted{run.shots, used, run.settings};
  const int shotsBefore = run.shots.shots();
  while (true) {
    sentinels::Interruptible<transport::Acquisition> measured =
        Measurement(adapted, supervision).measure(progress);
    if (measured) return *std::move(measured);
    run.shots.goBackTo(shotsBefore);
  }
}

}  // namespace relucent::acquisition
