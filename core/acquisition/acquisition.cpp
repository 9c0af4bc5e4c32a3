// SPDX-License-Identifier: MIT
#include "acquisition/acquisition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "acquisition/forecast.h"
#include "acquisition/growth.h"
#include "acquisition/repair.h"
#include "base/error.h"

namespace relucent {
namespace {

// Shares of the time: the tree takes nearly all of it.
constexpr double referenceShare = 0.06;
constexpr double treeShare = 0.88;
constexpr double verificationShare = 0.04;

// What is worth a sentence to the user.
constexpr double driftLimit = 0.02;
constexpr double flaggedLimit = 0.02;
constexpr double unusableLimit = 0.01;

std::size_t countOf(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

void fillReferences(Acquisition& acquisition, const References& references) {
  acquisition.black = references.black.radiance;
  acquisition.blackVariance = references.black.variance;
  std::size_t rows = references.usable.size();
  acquisition.flood.assign(3 * rows, 0.0f);
  acquisition.floodVariance.assign(3 * rows, 0.0f);
  for (std::size_t projector = 0; projector < references.root.size(); ++projector) {
    for (std::size_t row = 0; row < rows; ++row) {
      Eigen::Map<Eigen::Vector3f>(&acquisition.flood[3 * row]) +=
          references.root[projector][row].rowwise().sum();
      Eigen::Map<Eigen::Vector3f>(&acquisition.floodVariance[3 * row]) +=
          references.rootVariance[projector][row].rowwise().sum();
    }
  }
}

double unresolvedEnergy(const TransportMatrix& transport, const Stack& flood) {
  Stack explained = transport.floodlight();
  double all = 0.0, missing = 0.0;
  for (std::size_t i = 0; i < flood.size(); ++i) {
    all += static_cast<double>(flood[i]);
    missing += static_cast<double>(flood[i]) - static_cast<double>(explained[i]);
  }
  return all > 0.0 ? missing / all : 0.0;
}

void addFindings(Acquisition& acquisition, double unusable, double drift) {
  if (std::abs(drift) > driftLimit)
    acquisition.findings.push_back(
        fmt::format("The light changed by {:.1f} % between the first and the last photograph; that was "
                    "followed, but let the "
                    "projector warm up before the next time",
                    100.0 * drift));
  if (unusable > unusableLimit)
    acquisition.findings.push_back(
        fmt::format("{:.1f} % of the camera pixels are overexposed even at the shortest exposure: close the "
                    "camera's aperture or allow shorter exposures, then measure again",
                    100.0 * unusable));
  double flagged =
      static_cast<double>(countOf(acquisition.flagged)) / static_cast<double>(acquisition.flagged.size());
  if (flagged > flaggedLimit)
    acquisition.findings.push_back(fmt::format(
        "{:.1f} % of the camera pixels see something else than predicted in the test patterns: check "
        "that nothing moved or flickered; these pixels are left out of the compensation",
        100.0 * flagged));
}

void addPutUpWith(Acquisition& acquisition, const Decisions& decisions) {
  for (const auto& [shot, what] : decisions.putUpWith)
    acquisition.findings.push_back(fmt::format("put up with before pattern {}: {}", shot + 1, what));
}

/// The parts of a measurement, in order, on shots that may be gone back over.
class Measurement {
 public:
  Measurement(ShotTaker& shots, const Linearization& linearization, const AcquisitionSettings& settings,
              Decisions& decisions, AcquisitionObserver& observer)
      : settings_(settings),
        shots_(shots),
        linearization_(linearization),
        shotsBefore_(shots.shots()),
        observer_(observer),
        photographer_(shots, linearization),
        watch_(photographer_, shots, references_, {settings.checkInterval, settings.mayBeMirrored}, decisions,
               observer) {}

  Acquisition run(Progress& progress) {
    expect(progress, {});
    Progress referencePart = progress.part(referenceShare, "black and full light");
    references_ = measureReferences(photographer_, settings_.references, settings_.dimShare, referencePart);
    bool kept = unlessKept([&] { watch_.begin(referencePart); });

    Progress treePart = progress.part(treeShare, "light transport");
    Tree tree = plantedTree(photographer_.projectors(), references_, references_.usable);
    Scheme scheme = schemeOf(settings_, references_);
    std::vector<int> levels;
    GrowthWatcher watcher;
    watcher.levelBegins = [&](const std::vector<int>& patterns) {
      levels = patterns;
      expect(progress, levels);
      observer_.grew(levels, 0);
    };
    watcher.patternsThrough = [&](int through) { observer_.grew(levels, through); };
    kept = growTree(tree, watch_, references_, scheme, kept, treePart, watcher) || kept;
    Acquisition result;
    result.leafVariance = leafVarianceOf(tree);
    std::vector<std::uint8_t> unknown = tree.unknown;
    result.transport =
        TransportMatrix(photographer_.cameras(), photographer_.projectors(), harvest(tree, references_));

    Progress verificationPart = progress.part(verificationShare, "test patterns");
    result.flagged.assign(references_.usable.size(), 0);
    result.residual.assign(verificationSizes, Stack(3 * references_.usable.size(), 0.0f));
    if (!kept && !progress.stopAndKeep())
      unlessKept([&] {
        watch_.check(verificationPart);
        if (scheme.repairs)
          verifyAndRepair(result, watch_, references_, scheme, settings_, verificationPart);
        else
          verifyOnly(result, watch_, references_, settings_, verificationPart);
        watch_.check(verificationPart);
      });
    else if (!kept)
      unlessKept([&] { verifyOnly(result, watch_, references_, settings_, verificationPart); });

    for (std::size_t row = 0; row < result.flagged.size(); ++row)
      if (!references_.usable[row] || unknown[row]) result.flagged[row] = 1;
    fillReferences(result, references_);
    result.unresolvedEnergy = unresolvedEnergy(result.transport, result.flood);
    double usable =
        static_cast<double>(countOf(references_.usable)) / static_cast<double>(references_.usable.size());
    addFindings(result, 1.0 - usable, watch_.power() - 1.0);
    progress.report(1.0);
    return result;
  }

 private:
  void expect(const Progress& progress, const std::vector<int>& levels) const {
    AcquisitionState state{levels, shots_.shots() - shotsBefore_, shots_.times()};
    progress.expect(forecast(shots_.rig(), linearization_, settings_, linearization_.times, state));
  }

  /// True if the user asked to keep what there is instead.
  template <typename Work>
  static bool unlessKept(const Work& work) {
    try {
      work();
      return false;
    } catch (const KeepAndStop&) {
      return true;
    }
  }

  const AcquisitionSettings& settings_;
  const ShotTaker& shots_;
  const Linearization& linearization_;
  int shotsBefore_;
  AcquisitionObserver& observer_;
  References references_;
  Photographer photographer_;
  Watch watch_;
};

}  // namespace

Acquisition acquire(const AcquisitionRun& run, Progress& progress) {
  std::vector<std::string> wrong = problems(run.settings);
  require(wrong.empty(), "{}", fmt::join(wrong, "; "));
  Linearization used = run.linearization;
  if (run.settings.singleExposure) used.exposures = {used.exposures.back()};
  AcquisitionObserver nobody;
  AcquisitionObserver& observer = run.observer ? *run.observer : nobody;
  int shotsBefore = run.shots.shots(), exposuresBefore = run.shots.exposures();
  Decisions decisions{run.handler, {}};
  while (true) {
    try {
      Acquisition result = Measurement(run.shots, used, run.settings, decisions, observer).run(progress);
      result.patterns = run.shots.shots() - shotsBefore;
      result.exposures = run.shots.exposures() - exposuresBefore;
      addPutUpWith(result, decisions);
      return result;
    } catch (const BeginAgain&) {
      run.shots.goBackTo(shotsBefore);
    }
  }
}

}  // namespace relucent
