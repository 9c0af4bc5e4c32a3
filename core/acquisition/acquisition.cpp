// SPDX-License-Identifier: MIT
#include "acquisition/acquisition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "acquisition/refinement.h"
#include "acquisition/verification.h"
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

Tree measureTree(Photographer& photographer, const References& references,
                 const AcquisitionSettings& settings, Progress& progress) {
  NodeLayout layout(photographer.projectors());
  Scheme scheme = schemeOf(settings, references);
  Tree tree = emptyTree(layout, references);
  int last = layout.levels() - 1;
  for (int level = last; level >= 0; --level) {
    plantRoots(tree, level, references, scheme);
    if (level == 0 || tree.active.blocks() == 0) continue;
    if (progress.stopAndKeep()) {
      stopDividing(tree);
      continue;
    }
    std::size_t nodes = 0, firstNode = 0;
    for (std::size_t projector = layout.projectors().devices(); projector-- > 0;) {
      if (level >= layout.levels(projector)) continue;
      firstNode = layout.index({static_cast<int>(projector), level, 0, 0});
      nodes += layout.gridSize(projector, level).count();
    }
    Schedule plan = schedule(tree.active, firstNode, nodes);
    Progress part = progress.part(1.0 / last, fmt::format("level {} of {}: {} patterns", last - level + 1,
                                                          last, patternsOf(plan, scheme, layout, level)));
    divide(tree, level, plan, photographer, references, scheme, part);
  }
  return tree;
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
    acquisition.findings.push_back(fmt::format(
        "The light changed by {:.1f} % between the first and the last photograph: let the projector "
        "warm up, keep other light out, then measure again",
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

}  // namespace

Acquisition acquire(ShotTaker& shots, const Linearization& linearization, const AcquisitionSettings& settings,
                    Progress& progress) {
  std::vector<std::string> wrong = problems(settings);
  require(wrong.empty(), "{}", fmt::join(wrong, "; "));
  int shotsBefore = shots.shots(), exposuresBefore = shots.exposures();
  Linearization used = linearization;
  if (settings.singleExposure) used.exposures = {used.exposures.back()};
  Photographer photographer(shots, used);

  Progress referencePart = progress.part(referenceShare, "black and full light");
  References references =
      measureReferences(photographer, settings.references, settings.dimShare, referencePart);
  Progress treePart = progress.part(treeShare, "light transport");
  Tree tree = measureTree(photographer, references, settings, treePart);

  Acquisition result;
  fillReferences(result, references);
  result.transport =
      TransportMatrix(photographer.cameras(), photographer.projectors(), harvest(tree, references));
  result.unresolvedEnergy = unresolvedEnergy(result.transport, result.flood);

  Progress verificationPart = progress.part(verificationShare, "test patterns");
  Verification verification = verify(result.transport, photographer, references, settings, verificationPart);
  result.verificationError = verification.error;
  result.flagged = std::move(verification.flagged);
  for (std::size_t row = 0; row < result.flagged.size(); ++row)
    if (!references.usable[row] || tree.unknown[row]) result.flagged[row] = 1;

  Progress driftPart = progress.part(1.0, "black and full light again");
  double drift = driftBetween(references, measureReferences(photographer, 1, settings.dimShare, driftPart));
  auto rows = static_cast<double>(references.usable.size());
  addFindings(result, 1.0 - static_cast<double>(countOf(references.usable)) / rows, drift);
  result.patterns = shots.shots() - shotsBefore;
  result.exposures = shots.exposures() - exposuresBefore;
  return result;
}

}  // namespace relucent
