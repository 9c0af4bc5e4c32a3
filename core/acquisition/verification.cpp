// SPDX-License-Identifier: MIT
#include "relucent/acquisition/verification.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/acquisition/mixed_rows.h"
#include "relucent/acquisition/scheme.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/transport/statistics.h"

namespace relucent::acquisition {
namespace {

/// A prediction and the variance that it inherits: a leaf was measured with about the noise of a frame.
struct Prediction {
  std::array<float, 3> light{};
  float leafNoise = 0.0f;  // times a frame's variance
};

Prediction predict(const transport::TransportMatrix& transport, std::size_t row,
                   const transport::NodeStack& means) {
  const transport::LeafRow leaves = transport.row(row);
  Prediction prediction;
  for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
    Eigen::Map<const Eigen::Vector3f> mean(&means[3 * static_cast<std::size_t>(leaves.column(entry))]);
    if (mean.isZero(0.0f)) continue;
    Eigen::Vector3f light = leaves.block(entry) * mean;
    for (std::size_t c = 0; c < 3; ++c) prediction.light[c] += light[static_cast<Eigen::Index>(c)];
    prediction.leafNoise += mean.squaredNorm();
  }
  return prediction;
}

/// The sum of a value of each node over every camera pixel's leaves, its own and those that it shares.
std::vector<float> sumsOverLeaves(const transport::TransportMatrix& transport,
                                  const std::vector<float>& ofNodes) {
  const auto sumOf = [&ofNodes](const transport::BlockSparse& leaves, std::size_t row) {
    float sum = 0.0f;
    for (const std::uint32_t node : leaves.columnsOf(row)) sum += ofNodes[node];
    return sum;
  };
  const transport::LeafGroups& groups = transport.groups();
  std::vector<float> ofGroups(groups.count());
  parallelFor(0, ofGroups.size(), 256,
              [&](std::size_t group) { ofGroups[group] = sumOf(groups.leaves(), group); });
  for (std::size_t group = 0; group < ofGroups.size(); ++group)  // parents come first
    if (const std::uint32_t parent = groups.parent(group); parent != transport::LeafGroups::none)
      ofGroups[group] += ofGroups[parent];
  std::vector<float> sums(transport.cameras().count());
  parallelFor(0, sums.size(), 1024, [&](std::size_t row) {
    sums[row] = sumOf(transport.ownLeaves(), row);
    for (std::size_t projector = 0; !groups.empty() && projector < transport.projectors().devices();
         ++projector)
      if (const std::uint32_t group = groups.groupOf(row, projector); group != transport::LeafGroups::none)
        sums[row] += ofGroups[group];
  });
  return sums;
}

std::vector<Prediction> predictions(const transport::TransportMatrix& transport,
                                    const ProjectorStack& pattern, const std::vector<std::uint8_t>& rows) {
  // Taking rows apart costs as much as a product with ten times as many.
  constexpr std::size_t apart = 10;
  const transport::NodeStack means = transport.layout().means(pattern);
  std::vector<Prediction> predicted(rows.size());
  if (apart * static_cast<std::size_t>(std::count(rows.begin(), rows.end(), 1)) < rows.size()) {
    parallelFor(0, rows.size(), 256, [&](std::size_t row) {
      if (rows[row]) predicted[row] = predict(transport, row, means);
    });
    return predicted;
  }
  std::vector<float> noise(transport.layout().count());
  parallelFor(0, noise.size(), 4096, [&](std::size_t node) {
    noise[node] = Eigen::Map<const Eigen::Vector3f>(&means[3 * node]).squaredNorm();
  });
  const CameraStack light = transport.apply(pattern);
  const std::vector<float> leafNoise = sumsOverLeaves(transport, noise);
  parallelFor(0, rows.size(), 4096, [&](std::size_t row) {
    if (rows[row])
      predicted[row] = {{light[3 * row], light[3 * row + 1], light[3 * row + 2]}, leafNoise[row]};
  });
  return predicted;
}

std::vector<photography::Demand> demandsOf(const Expectation& expected,
                                           const std::vector<Prediction>& predicted,
                                           const std::vector<std::uint8_t>& rows) {
  std::vector<photography::Demand> demands(rows.size());
  parallelFor(0, rows.size(), 4096, [&](std::size_t row) {
    if (!rows[row]) return;
    float brightest = 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
      brightest = std::max(brightest, expected.black[3 * row + c] + predicted[row].light[c]);
    demands[row] = {brightest, brightest, expected.tolerable[row]};
  });
  return demands;
}

/// Adds one pattern's share to the rows' sums, and the squares of the differences to `map`. Returns: the
/// share of all.
Residual compare(const hdr::LampLight& seen, const std::vector<Prediction>& predicted,
                 const std::vector<std::uint8_t>& rows, std::vector<Residual>& sums, Stack& map) {
  std::array<Residual, fixedParts> parts{};
  parallelChunks(0, rows.size(), fixedParts, [&](std::size_t part, std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      if (!rows[row]) continue;
      Residual residual;
      for (std::size_t c = 0; c < 3; ++c) {
        std::size_t at = 3 * row + c;
        if (!seen.valid[at]) continue;
        double light = static_cast<double>(seen.radiance[at]);
        double expected = static_cast<double>(predicted[row].light[c]), difference = light - expected;
        residual.add(
            {difference * difference,
             static_cast<double>(seen.variance[at]) * (1.0 + static_cast<double>(predicted[row].leafNoise)),
             light * light, expected * expected, static_cast<double>(seen.variance[at])});
        map[at] += static_cast<float>(difference * difference);
      }
      sums[row].add(residual);
      parts[part].add(residual);
    }
  });
  Residual all;
  for (const Residual& part : parts) all.add(part);
  return all;
}

}  // namespace

ProjectorStack verificationPattern(const Rasters& projectors, int number, std::uint64_t seed, int least) {
  int side = std::max(least, 1 << (number % verificationSizes));
  ProjectorStack pattern(3 * projectors.count());
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

void Residual::add(const Residual& other) {
  squared += other.squared;
  variance += other.variance;
  light += other.light;
  predicted += other.predicted;
  noise += other.noise;
}

sentinels::Interruptible<Verification> verify(const Expectation& expected, const LightSource& light,
                                              const VerificationTask& task, Progress& progress) {
  const std::vector<std::uint8_t>& rows = task.rows;
  const int wanted = task.settings.verificationPatterns;
  const int finest = transport::finestSide(expected.transport);
  std::size_t count = rows.size();
  Verification verification;
  verification.rows.assign(count, {});
  verification.residual.assign(verificationSizes, CameraStack(3 * count, 0.0f));
  std::array<int, verificationSizes> patterns{};
  bool any = std::any_of(rows.begin(), rows.end(), [](std::uint8_t row) { return row != 0; });
  for (int number = task.first; any && number < task.first + wanted; ++number) {
    ProjectorStack pattern =
        verificationPattern(expected.transport.projectors(), number, task.settings.seed, finest);
    std::vector<Prediction> predicted = predictions(expected.transport, pattern, rows);
    sentinels::Interruptible<SeenLight> seen = light(pattern, demandsOf(expected, predicted, rows));
    if (!seen) return seen.interruption();

    auto size = static_cast<std::size_t>(number % verificationSizes);
    ++patterns[size];
    verification.bySize[size].add(
        compare(**seen, predicted, rows, verification.rows, verification.residual[size]));
    progress.report(static_cast<double>(number - task.first + 1) / wanted);
  }
  for (std::size_t size = 0; size < verificationSizes; ++size)
    parallelFor(0, 3 * count, 16384, [&](std::size_t at) {
      float& value = verification.residual[size][at];
      value = std::sqrt(value / static_cast<float>(std::max(1, patterns[size])));
    });

  verification.flagged.assign(count, 0);
  parallelFor(0, count, 4096, [&](std::size_t row) {
    verification.flagged[row] = isWrong(verification.rows[row], task.settings) ? 1 : 0;
  });
  return verification;
}

sentinels::Interruptible<Verification> verify(const transport::TransportMatrix& transport,
                                              const TreeContext& context, const VerificationTask& task,
                                              Progress& progress) {
  auto light = [&](const ProjectorStack& pattern,
                   const std::vector<photography::Demand>& demands) -> sentinels::Interruptible<SeenLight> {
    auto seen = context.watch.lightOfRandom(pattern, demands, progress);
    if (!seen) return seen.interruption();
    return std::make_shared<const hdr::LampLight>(*std::move(seen));
  };
  return verify({transport, context.watch.black().radiance, context.scheme.tolerable}, light, task, progress);
}

bool isWrong(const Residual& residual, const AcquisitionSettings& settings) {
  double relative = settings.flagRelative * settings.flagRelative;
  double sigmas = settings.flagSigmas * settings.flagSigmas;
  return residual.squared > relative * residual.light && residual.squared > sigmas * residual.variance;
}

double errorOf(const std::vector<Residual>& rows) {
  double squared = 0.0, light = 0.0;
  for (const Residual& row : rows) {
    squared += row.squared;
    light += row.light;
  }
  return light > 0.0 ? std::sqrt(squared / light) : 0.0;
}

void replaceRows(Verification& into, const Verification& from, const CameraMask& chosen) {
  for (std::size_t size = 0; size < into.residual.size(); ++size)
    replaceRows(into.residual[size], from.residual[size], chosen);
  for (std::size_t row = 0; row < chosen.size(); ++row) {
    if (!chosen[row]) continue;
    into.rows[row] = from.rows[row];
    into.flagged[row] = from.flagged[row];
  }
}

}  // namespace relucent::acquisition
