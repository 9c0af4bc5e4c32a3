// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <vector>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/random.h"
#include "relucent/clustering/clustering.h"

namespace relucent {

inline Progress quiet;

/// Single floats, sums of some hundred terms, and 16-bit values: of a row's norm.
inline constexpr double rounding = 3e-4;

inline transport::TransportMatrix pixelTransport(Rasters cameras, Rasters projectors, double density,
                                                 std::uint64_t seed, bool ties) {
  transport::NodeLayout layout(projectors);
  Random random{seed, 3};
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 4.0f));
  for (std::size_t row = 0; row < cameras.count(); ++row)
    for (std::size_t pixel = 0; pixel < projectors.count(); ++pixel) {
      if (random.uniform() >= density) continue;
      // Few different values: ties within rows and columns are what transcriptions get wrong.
      float value = ties ? 1.0f + static_cast<float>(random.below(3)) : 0.1f + 3.0f * random.uniformFloat();
      transport::ColourBlock block = transport::ColourBlock::Constant(value);
      if (!ties)
        for (int i = 0; i < 9; ++i) block.data()[i] *= random.uniformFloat();
      builder.add(row, pixel, block);
    }
  return {cameras, projectors, builder.build()};
}

inline CameraMask all(const transport::TransportMatrix& transport) {
  return CameraMask(transport.cameras().count(), 1);
}

inline clustering::ConnectionGraph everything(const transport::TransportMatrix& transport) {
  return clustering::ConnectionGraph(transport, all(transport), {0.0, 30}, quiet);
}

inline clustering::ClusteringSettings asPrinted(double radius, double cut) {
  clustering::ClusteringSettings settings;
  settings.patchRadius = radius;
  settings.patchCut = cut;
  settings.cap = clustering::SizeCap::never;
  return settings;
}

/// The laws that every clustering obeys.
inline void verifyPartition(const clustering::Clustering& clustering) {
  std::vector<clustering::ClusterSize> counted(clustering.sizes.size());
  for (std::uint32_t cluster : clustering.projectorCluster)
    if (cluster != clustering::noCluster) ++counted.at(cluster).unknowns;
  for (std::uint32_t cluster : clustering.cameraCluster)
    if (cluster != clustering::noCluster) ++counted.at(cluster).rows;
  const transport::BlockSparse& leaves = clustering.transport.ownLeaves();
  for (std::size_t i = 0; i < leaves.rows(); ++i)
    for (std::size_t e = leaves.rowBegin(i); e < leaves.rowBegin(i + 1); ++e) {
      QCOMPARE(clustering.projectorCluster.at(leaves.column(e)), clustering.cameraCluster[i]);
      ++counted.at(clustering.cameraCluster[i]).connections;
    }
  QVERIFY(counted == clustering.sizes);
}

inline synthetic::Scene scene(double softest, std::uint64_t seed = 1) {
  synthetic::SceneSettings settings;
  settings.seed = seed;
  settings.softest = softest;
  return synthetic::makeScene(settings);
}

}  // namespace relucent
