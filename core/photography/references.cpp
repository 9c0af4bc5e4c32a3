// SPDX-License-Identifier: MIT
#include "relucent/photography/references.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "relucent/base/parallel.h"

namespace relucent::photography {
namespace {

// Room for noise above the brightest value that a row can hold, so that no code saturates.
constexpr float headroom = 1.25f;
constexpr float headroomSigmas = 16.0f;

ProjectorStack floodPattern(const Rasters& projectors, std::size_t projector, std::size_t channel) {
  ProjectorStack pattern(3 * projectors.count(), 0.0f);
  std::size_t begin = projectors.offset(projector);
  for (std::size_t i = begin; i < begin + projectors.size(projector).count(); ++i)
    pattern[3 * i + channel] = 1.0f;
  return pattern;
}

void addFlood(References& references, std::size_t projector, std::size_t channel,
              const hdr::HdrFrame& flood) {
  parallelFor(0, references.usable.size(), 4096, [&](std::size_t row) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::size_t at = 3 * row + c;
      auto place = static_cast<Eigen::Index>(c);
      auto column = static_cast<Eigen::Index>(channel);
      references.root[projector][row](place, column) = flood.radiance[at] - references.black.radiance[at];
      references.rootVariance[projector][row](place, column) =
          flood.variance[at] + references.black.variance[at];
      if (!flood.valid[at]) references.usable[row] = 0;
    }
  });
}

/// One round's floods, summed.
hdr::ProjectedLight sumOf(const std::vector<std::vector<hdr::HdrFrame>>& frames, std::size_t round,
                          const hdr::BlackLevel& black) {
  hdr::ProjectedLight sum(frames[1][round], black);
  for (std::size_t i = 2; i < frames.size(); ++i) {
    const hdr::ProjectedLight flood(frames[i][round], black);
    parallelFor(0, sum.radiance.size(), 4096, [&](std::size_t value) {
      sum.radiance[value] += flood.radiance[value];
      sum.variance[value] += flood.variance[value];
      if (!flood.valid[value]) sum.valid[value] = 0;
    });
  }
  return sum;
}

/// Standard deviation of the floods' total light from round to round about a straight line, relative.
double flickerIn(const std::vector<std::vector<hdr::HdrFrame>>& floods) {
  double squares = 0.0;
  std::size_t freedom = 0;
  for (const std::vector<hdr::HdrFrame>& rounds : floods) {
    if (rounds.size() < 3) continue;
    std::vector<double> total;
    for (const hdr::HdrFrame& frame : rounds)
      total.push_back(std::accumulate(frame.radiance.begin(), frame.radiance.end(), 0.0));
    auto n = static_cast<double>(total.size());
    double mean = std::accumulate(total.begin(), total.end(), 0.0) / n, slope = 0.0, spread = 0.0;
    for (std::size_t i = 0; i < total.size(); ++i) {
      double at = static_cast<double>(i) - 0.5 * (n - 1.0);
      slope += at * total[i];
      spread += at * at;
    }
    for (std::size_t i = 0; i < total.size(); ++i) {
      double line = mean + slope / spread * (static_cast<double>(i) - 0.5 * (n - 1.0));
      if (mean > 0.0) squares += std::pow(total[i] / mean - line / mean, 2.0);
    }
    freedom += total.size() - 2;
  }
  return freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
}

/// The brightness above which half of all light lies: it does not ask how much of the camera's view is
/// dark, nor what a few highlights hold.
float typicalOf(std::vector<float> brightness) {
  std::sort(brightness.begin(), brightness.end());
  double half = 0.5 * std::accumulate(brightness.begin(), brightness.end(), 0.0);
  double sum = 0.0;
  for (float value : brightness) {
    sum += static_cast<double>(value);
    if (sum >= half) return value;
  }
  return 0.0f;
}

void findScales(References& references, double dimShare) {
  std::size_t rows = references.usable.size();
  references.strongest.resize(rows);
  references.fullScale.resize(rows);
  parallelFor(0, rows, 4096, [&](std::size_t row) {
    transport::ColourBlock sum = transport::ColourBlock::Zero(), variance = transport::ColourBlock::Zero();
    for (std::size_t projector = 0; projector < references.root.size(); ++projector) {
      sum += references.root[projector][row];
      variance += references.rootVariance[projector][row];
    }
    references.strongest[row] = std::max(0.0f, sum.maxCoeff());
    references.fullScale[row] = std::max(headroom * sum.cwiseAbs().maxCoeff(),
                                         headroomSigmas * std::sqrt(std::max(0.0f, variance.maxCoeff())));
  });
  references.typical = typicalOf(references.strongest);
  auto dimmest = static_cast<float>(dimShare) * references.typical;
  for (float& strongest : references.strongest) strongest = std::max(strongest, dimmest);
}

}  // namespace

References measureReferences(Photographer& photographer, const ReferenceRounds& rounds, double dimShare,
                             Progress& progress) {
  const Rasters& projectors = photographer.projectors();
  std::size_t rows = photographer.cameras().count();
  std::size_t floods = 3 * projectors.devices();

  std::vector<std::vector<hdr::HdrFrame>> frames(1 + floods);
  const std::size_t total =
      static_cast<std::size_t>(rounds.black) + static_cast<std::size_t>(rounds.floods) * floods;
  std::size_t done = 0;
  for (int round = 0; round < rounds.black; ++round) {
    const std::size_t shown = round < rounds.floods ? frames.size() : 1;
    for (std::size_t i = 0; i < shown; ++i) {
      ProjectorStack pattern = i == 0 ? ProjectorStack(3 * projectors.count(), 0.0f)
                                      : floodPattern(projectors, (i - 1) / 3, (i - 1) % 3);
      frames[i].push_back(photographer.takeAll(pattern, progress));
      progress.report(static_cast<double>(++done) / static_cast<double>(total));
    }
  }

  References references;
  references.cameras = photographer.cameras();
  references.projectors = projectors;
  references.black = hdr::BlackLevel(hdr::meanOf(frames[0]));
  references.usable.assign(rows, 1);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < 3; ++c)
      if (!references.black.valid[3 * row + c]) references.usable[row] = 0;
  references.root.assign(projectors.devices(), std::vector<transport::ColourBlock>(rows));
  references.rootVariance = references.root;
  for (std::size_t i = 0; i < floods; ++i) addFlood(references, i / 3, i % 3, hdr::meanOf(frames[1 + i]));
  references.firstRound = sumOf(frames, 0, references.black);
  references.floodRounds = rounds.floods;
  findScales(references, dimShare);
  references.flicker = flickerIn({frames.begin() + 1, frames.end()});
  return references;
}

}  // namespace relucent::photography
