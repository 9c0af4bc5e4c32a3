// SPDX-License-Identifier: MIT
#include "acquisition/verification.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace relucent {
namespace {

/// A prediction and the variance that it inherits: a leaf was measured with about the noise of a frame.
struct Prediction {
  std::array<float, 3> light{};
  float leafNoise = 0.0f;  // times a frame's variance
};

Prediction predict(const TransportMatrix& transport, std::size_t row, const Stack& means) {
  const BlockSparse& leaves = transport.leaves();
  Prediction prediction;
  for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
    Eigen::Map<const Eigen::Vector3f> mean(&means[3 * static_cast<std::size_t>(leaves.column(entry))]);
    if (mean.isZero(0.0f)) continue;
    Eigen::Vector3f light = leaves.block(row, entry) * mean;
    for (std::size_t c = 0; c < 3; ++c) prediction.light[c] += light[static_cast<Eigen::Index>(c)];
    prediction.leafNoise += mean.squaredNorm();
  }
  return prediction;
}

/// Sums over the patterns, per camera pixel.
struct Residual {
  double squared = 0.0;   // of measured - predicted
  double variance = 0.0;  // expected of that, from noise alone
  double light = 0.0;     // squared, of measured - e
};

}  // namespace

Stack verificationPattern(const Rasters& projectors, int number, std::uint64_t seed) {
  int side = 1 << (number % 4);
  Stack pattern(3 * projectors.count());
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    Size size = projectors.size(projector);
    parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t y) {
      for (int x = 0; x < size.width; ++x) {
        std::size_t at = projectors.offset(projector) + indexOf(size, {x, static_cast<int>(y)});
        Random random{seed,
                      0x7665726966795aULL,
                      static_cast<std::uint64_t>(number),
                      projector,
                      y / static_cast<std::size_t>(side),
                      static_cast<std::uint64_t>(x / side)};
        std::uint64_t bits = random.next();
        for (std::size_t c = 0; c < 3; ++c) pattern[3 * at + c] = static_cast<float>(bits >> (61 + c) & 1);
      }
    });
  }
  return pattern;
}

Verification verify(const TransportMatrix& transport, Photographer& photographer,
                    const References& references, const AcquisitionSettings& settings, Progress& progress) {
  std::size_t rows = references.usable.size();
  auto tolerable = static_cast<float>(settings.relativeThreshold / settings.noiseSigmas);
  std::vector<Residual> residual(rows);
  for (int number = 0; number < settings.verificationPatterns; ++number) {
    Stack pattern = verificationPattern(photographer.projectors(), number, settings.seed);
    Stack means = transport.layout().means(pattern);
    std::vector<Prediction> predicted(rows);
    std::vector<Demand> demands(rows);
    parallelFor(0, rows, 256, [&](std::size_t row) {
      if (!references.usable[row]) return;
      predicted[row] = predict(transport, row, means);
      float brightest = 0.0f;
      for (std::size_t c = 0; c < 3; ++c)
        brightest = std::max(brightest, references.black.radiance[3 * row + c] + predicted[row].light[c]);
      demands[row] = {brightest, brightest, tolerable * references.strongest[row]};
    });

    HdrFrame frame = photographer.take(pattern, demands, progress);
    parallelFor(0, rows, 1024, [&](std::size_t row) {
      if (!references.usable[row]) return;
      for (std::size_t c = 0; c < 3; ++c) {
        std::size_t at = 3 * row + c;
        if (!frame.valid[at]) continue;
        double light =
            static_cast<double>(frame.radiance[at]) - static_cast<double>(references.black.radiance[at]);
        double difference = light - static_cast<double>(predicted[row].light[c]);
        residual[row].squared += difference * difference;
        residual[row].light += light * light;
        residual[row].variance +=
            static_cast<double>(frame.variance[at]) * (1.0 + static_cast<double>(predicted[row].leafNoise)) +
            static_cast<double>(references.black.variance[at]);
      }
    });
    progress.report(static_cast<double>(number + 1) / settings.verificationPatterns);
  }

  Verification verification;
  verification.flagged.assign(rows, 0);
  double squared = 0.0, light = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    const Residual& r = residual[row];
    squared += r.squared;
    light += r.light;
    double relative = settings.flagRelative * settings.flagRelative;
    double sigmas = settings.flagSigmas * settings.flagSigmas;
    verification.flagged[row] = r.squared > relative * r.light && r.squared > sigmas * r.variance;
  }
  verification.error = light > 0.0 ? std::sqrt(squared / light) : 0.0;
  return verification;
}

}  // namespace relucent
