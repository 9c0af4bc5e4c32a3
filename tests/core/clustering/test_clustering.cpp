// SPDX-License-Identifier: MIT
#include "clustering/clustering.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "core/inverse/synthetic_transport.h"
#include "core/transport/random_blocks.h"

using namespace relucent;

namespace {

Progress quiet;

/// Single floats, sums of some hundred terms, and 16-bit values: of a row's norm.
constexpr double rounding = 3e-4;

TransportMatrix pixelTransport(Rasters cameras, Rasters projectors, double density, std::uint64_t seed,
                               bool ties) {
  NodeLayout layout(projectors);
  Random random{seed, 3};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 4.0f));
  for (std::size_t row = 0; row < cameras.count(); ++row)
    for (std::size_t pixel = 0; pixel < projectors.count(); ++pixel) {
      if (random.uniform() >= density) continue;
      // Few different values: ties within rows and columns are what transcriptions get wrong.
      float value = ties ? 1.0f + static_cast<float>(random.below(3)) : 0.1f + 3.0f * random.uniformFloat();
      ColourBlock block = ColourBlock::Constant(value);
      if (!ties)
        for (int i = 0; i < 9; ++i) block.data()[i] *= random.uniformFloat();
      builder.add(row, pixel, block);
    }
  return {cameras, projectors, builder.build()};
}

std::vector<std::uint8_t> all(const TransportMatrix& transport) {
  return std::vector<std::uint8_t>(transport.cameras().count(), 1);
}

ConnectionGraph everything(const TransportMatrix& transport) {
  return ConnectionGraph(transport, all(transport), {0.0, 30}, quiet);
}

ClusteringSettings asPrinted(double radius, double cut) {
  ClusteringSettings settings;
  settings.patchRadius = radius;
  settings.patchCut = cut;
  settings.cap = SizeCap::never;
  return settings;
}

/// Algorithm 1, transcribed line by line on a dense table, as slow as it reads.
class AsPrinted {
 public:
  AsPrinted(const TransportMatrix& transport, double thresh1, double thresh2)
      : projectors_(transport.projectors()),
        rows_(transport.cameras().count()),
        columns_(projectors_.count()),
        luminance_(rows_ * columns_, 0.0f),
        connected_(rows_ * columns_, false) {
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t e = transport.leaves().rowBegin(i); e < transport.leaves().rowBegin(i + 1); ++e) {
        ColourBlock b = transport.leaves().block(i, e);
        std::array<int, 3> sum{};
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t p = 0; p < 3; ++p) sum[c] += transport.leaves().code(e)[3 * c + p];
        at(i, transport.leaves().column(e)) =
            transport.leaves().scale(i) *
            luminanceOf(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
        connected_[i * columns_ + transport.leaves().column(e)] = b.sum() > 0;
      }
    std::vector<bool> original = connected_;
    for (std::size_t ci = 0; ci < rows_; ++ci) {  // line 1
      std::vector<bool> labelled(columns_, false);
      std::vector<std::vector<std::size_t>> patches;
      while (!allLabelled(ci, labelled)) {                           // line 2
        std::size_t centre = findBrightestUnlabelled(ci, labelled);  // line 3
        labelled[centre] = true;                                     // line 4
        patches.push_back({centre});
        for (std::size_t pj = 0; pj < columns_; ++pj) {  // line 5
          if (!connected(ci, pj) || labelled[pj]) continue;
          if (distance(centre, pj) <= thresh1) {  // line 6
            patches.back().push_back(pj);         // line 7
            labelled[pj] = true;                  // line 8
          }
        }
      }
      for (const auto& patch : patches) {  // line 12
        double highest = at(ci, patch.front());
        for (std::size_t pk : patch)                                                    // line 13
          if (at(ci, pk) <= thresh2 * highest) connected_[ci * columns_ + pk] = false;  // lines 14, 15
      }
    }
    for (std::size_t pj = 0; pj < columns_; ++pj) {  // line 20
      std::size_t most = rows_;
      bool cutOff = true;
      for (std::size_t ci = 0; ci < rows_; ++ci) {
        if (connected(ci, pj)) cutOff = false;
        if (original[ci * columns_ + pj] && (most == rows_ || at(ci, pj) > at(most, pj))) most = ci;
      }
      if (cutOff && most < rows_) connected_[most * columns_ + pj] = true;
    }
  }

  bool connected(std::size_t i, std::size_t j) const { return connected_[i * columns_ + j]; }

  /// Components by flooding.
  std::vector<std::uint32_t> projectorClusters() const {
    std::vector<std::uint32_t> cluster(columns_, noCluster);
    std::uint32_t next = 0;
    for (std::size_t start = 0; start < columns_; ++start) {
      if (cluster[start] != noCluster || !anyRow(start)) continue;
      std::vector<std::size_t> front{start};
      cluster[start] = next;
      while (!front.empty()) {
        std::size_t j = front.back();
        front.pop_back();
        for (std::size_t i = 0; i < rows_; ++i)
          for (std::size_t k = 0; k < columns_ && connected(i, j); ++k)
            if (connected(i, k) && cluster[k] == noCluster) {
              cluster[k] = next;
              front.push_back(k);
            }
      }
      ++next;
    }
    return cluster;
  }

 private:
  float& at(std::size_t i, std::size_t j) { return luminance_[i * columns_ + j]; }
  bool anyRow(std::size_t j) const {
    for (std::size_t i = 0; i < rows_; ++i)
      if (connected(i, j)) return true;
    return false;
  }
  bool allLabelled(std::size_t i, const std::vector<bool>& labelled) const {
    for (std::size_t j = 0; j < columns_; ++j)
      if (connected(i, j) && !labelled[j]) return false;
    return true;
  }
  std::size_t findBrightestUnlabelled(std::size_t i, const std::vector<bool>& labelled) {
    std::size_t best = columns_;
    for (std::size_t j = 0; j < columns_; ++j)
      if (connected(i, j) && !labelled[j] && (best == columns_ || at(i, j) > at(i, best))) best = j;
    return best;
  }
  double distance(std::size_t a, std::size_t b) const {
    std::size_t device = 0;
    auto deviceOf = [&](std::size_t pixel) {
      device = 0;
      while (device + 1 < projectors_.devices() && pixel >= projectors_.offset(device + 1)) ++device;
      return device;
    };
    std::size_t da = deviceOf(a), db = deviceOf(b);
    if (da != db) return std::numeric_limits<double>::infinity();
    Pixel p = pixelAt(projectors_.size(da), a - projectors_.offset(da));
    Pixel q = pixelAt(projectors_.size(da), b - projectors_.offset(da));
    return std::hypot(p.x - q.x, p.y - q.y);
  }

  Rasters projectors_;
  std::size_t rows_, columns_;
  std::vector<float> luminance_;
  std::vector<bool> connected_;
};

/// Every row of T expanded to single projector pixels.
Eigen::MatrixXd expanded(const TransportMatrix& transport) {
  const NodeLayout& layout = transport.layout();
  const Rasters& projectors = layout.projectors();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(transport.cameras().count()),
                                                3 * static_cast<Eigen::Index>(projectors.count()));
  for (std::size_t i = 0; i < transport.leaves().rows(); ++i)
    for (std::size_t e = transport.leaves().rowBegin(i); e < transport.leaves().rowBegin(i + 1); ++e) {
      Node node = layout.node(transport.leaves().column(e));
      Block block = layout.block(node);
      auto device = static_cast<std::size_t>(node.projector);
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
          auto j =
              static_cast<Eigen::Index>(projectors.offset(device) + indexOf(projectors.size(device), {x, y}));
          dense.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * j) +=
              transport.leaves().block(i, e).cast<double>() / block.count();
        }
    }
  return dense;
}

/// The laws that every clustering obeys.
void verifyPartition(const Clustering& clustering) {
  std::vector<ClusterSize> counted(clustering.sizes.size());
  for (std::uint32_t cluster : clustering.projectorCluster)
    if (cluster != noCluster) ++counted.at(cluster).unknowns;
  for (std::uint32_t cluster : clustering.cameraCluster)
    if (cluster != noCluster) ++counted.at(cluster).rows;
  const BlockSparse& leaves = clustering.transport.leaves();
  for (std::size_t i = 0; i < leaves.rows(); ++i)
    for (std::size_t e = leaves.rowBegin(i); e < leaves.rowBegin(i + 1); ++e) {
      QCOMPARE(clustering.projectorCluster.at(leaves.column(e)), clustering.cameraCluster[i]);
      ++counted.at(clustering.cameraCluster[i]).connections;
    }
  QVERIFY(counted == clustering.sizes);
}

synthetic::Scene scene(double softest, std::uint64_t seed = 1) {
  synthetic::SceneSettings settings;
  settings.seed = seed;
  settings.softest = softest;
  return synthetic::makeScene(settings);
}

}  // namespace

class TestClustering : public QObject {
  Q_OBJECT

 private slots:
  void isAlgorithmOneAsPrinted_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<double>("density");
    QTest::addColumn<double>("radius");
    QTest::addColumn<double>("cut");
    QTest::addColumn<bool>("ties");
    QTest::newRow("the paper's") << 1 << 0.2 << 5.0 << 0.5 << false;
    QTest::newRow("weak cut") << 1 << 0.2 << 2.0 << 0.3 << false;
    QTest::newRow("strong cut") << 1 << 0.3 << 3.0 << 0.7 << false;
    QTest::newRow("sparse") << 1 << 0.04 << 2.5 << 0.5 << false;
    QTest::newRow("dense") << 1 << 0.9 << 4.0 << 0.6 << false;
    QTest::newRow("equals") << 1 << 0.3 << 2.0 << 0.5 << true;
    QTest::newRow("equals at the limit") << 1 << 0.5 << 3.0 << 1.0 / 3.0 << true;
    QTest::newRow("nothing cut") << 1 << 0.1 << 3.0 << 0.0 << true;
    QTest::newRow("every pixel a patch") << 1 << 0.1 << 0.0 << 0.5 << false;
    QTest::newRow("two projectors") << 2 << 0.2 << 100.0 << 0.5 << true;
    QTest::newRow("empty") << 1 << 0.0 << 5.0 << 0.5 << false;
  }
  void isAlgorithmOneAsPrinted() {
    QFETCH(int, projectors);
    QFETCH(double, density);
    QFETCH(double, radius);
    QFETCH(double, cut);
    QFETCH(bool, ties);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      std::vector<Size> sizes{{9 - static_cast<int>(seed % 4), 4}};
      if (projectors > 1) sizes.push_back({3, 5});
      TransportMatrix transport =
          pixelTransport(Size{5, 1 + static_cast<int>(seed % 5)}, sizes, density, seed, ties);
      AsPrinted printed(transport, radius, cut);
      Clustering ours = clustered(everything(transport), asPrinted(radius, cut), quiet);
      const BlockSparse& kept = ours.transport.leaves();
      for (std::size_t i = 0; i < kept.rows(); ++i) {
        std::set<std::size_t> here;
        for (std::size_t e = kept.rowBegin(i); e < kept.rowBegin(i + 1); ++e) here.insert(kept.column(e));
        for (std::size_t j = 0; j < transport.projectors().count(); ++j)
          QVERIFY2(printed.connected(i, j) == here.contains(j),
                   qPrintable(QString("seed %1, connection (%2, %3)").arg(seed).arg(i).arg(j)));
      }
      QVERIFY(ours.projectorCluster == printed.projectorClusters());
      verifyPartition(ours);
    }
  }

  void rowsAreScaledToTheFloodlight_data() {
    QTest::addColumn<bool>("patches");
    QTest::addColumn<double>("cut");
    QTest::newRow("patches") << true << 0.5;
    QTest::newRow("patches, strong cut") << true << 0.9;
    QTest::newRow("rows") << false << 0.5;
  }
  void rowsAreScaledToTheFloodlight() {
    QFETCH(bool, patches);
    QFETCH(double, cut);
    synthetic::Scene made = scene(1.0);
    ClusteringSettings settings = asPrinted(4.0, cut);
    settings.rescaling = patches ? Rescaling::patches : Rescaling::rows;
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    Clustering clustering = clustered(graph, settings, quiet);
    Stack flood = made.transport.floodlight(), sums = clustering.transport.floodlight();
    for (std::size_t i = 0; i < flood.size(); ++i) {
      if (!made.usable[i / 3]) continue;
      QVERIFY2(std::abs(sums[i] - flood[i]) <= rounding * flood[i], qPrintable(QString::number(i)));
    }
  }

  /// A row of two patches, of which the wider loses more to the cut: each gets its own light back.
  void patchesKeepTheirShareOfTheLight() {
    NodeLayout layout{Rasters(Size{20, 1})};
    BlockSparseBuilder builder(layout.count(), {1.0f});
    ColourBlock one = ColourBlock::Identity();
    for (std::size_t j : {0, 1, 2})
      builder.add(0, j, (j == 1 ? 0.8f : 0.3f) * one);  // 1.4, of which 0.8 stays
    builder.add(0, 15, 0.6f * one);
    TransportMatrix transport(Size{1, 1}, Size{20, 1}, builder.build());
    // The cut-off pixels come back, as nobody else sees them: a second row that does.
    BlockSparseBuilder two(layout.count(), {1.0f, 1.0f});
    for (std::size_t j : {0, 1, 2}) two.add(0, j, (j == 1 ? 0.8f : 0.3f) * one);
    two.add(0, 15, 0.6f * one);
    for (std::size_t j : {0, 2}) two.add(1, j, 0.9f * one);
    TransportMatrix seen(Size{2, 1}, Size{20, 1}, two.build());
    ConnectionGraph graph = everything(seen);
    for (Rescaling rescaling : {Rescaling::patches, Rescaling::rows}) {
      ClusteringSettings settings = asPrinted(3.0, 0.5);
      settings.rescaling = rescaling;
      BlockSparse kept = clustered(graph, settings, quiet).transport.leaves();
      QCOMPARE(kept.rowBegin(1), std::size_t{2});
      double wide = rescaling == Rescaling::patches ? 1.4 : 2.0 * 0.8 / 1.4;
      QVERIFY(std::abs(kept.block(0, 0)(0, 0) - wide) < rounding);
      QVERIFY(std::abs(kept.block(0, 1)(1, 1) - (2.0 - wide)) < rounding);
    }
  }

  /// |T_i - T~_i| / |T_i| on T expanded to all its pixels, far field included.
  void errorMapIsThePapersByBruteForce_data() {
    QTest::addColumn<double>("density");
    QTest::addColumn<bool>("capped");
    QTest::addColumn<int>("level");
    QTest::newRow("nested leaves of every level") << 0.3 << false << 30;
    QTest::newRow("sparse") << 0.03 << false << 30;
    QTest::newRow("far field on wide leaves") << 0.3 << false << 1;
    QTest::newRow("capped") << 0.2 << true << 2;
  }
  void errorMapIsThePapersByBruteForce() {
    QFETCH(double, density);
    QFETCH(bool, capped);
    QFETCH(int, level);
    Rasters projectors = std::vector<Size>{{11, 6}, {3, 2}};
    NodeLayout layout(projectors);
    TransportMatrix transport(Size{7, 4}, projectors,
                              randomBlocks(28, layout.count(), density, 31, -0.1f).sparse);
    ClusteringSettings settings = asPrinted(2.0, 0.4);
    if (capped) settings.cap = SizeCap::always;
    settings.mostUnknowns = 7;
    ConnectionGraph graph(transport, all(transport), {0.05, level}, quiet);
    Clustering clustering = clustered(graph, settings, quiet);
    verifyPartition(clustering);
    Eigen::MatrixXd whole = expanded(transport), apart = whole - expanded(clustering.transport);
    for (Eigen::Index i = 0; i < 28; ++i) {
      double norm = whole.middleRows<3>(3 * i).norm();
      double expected = norm > 0.0 ? apart.middleRows<3>(3 * i).norm() / norm : 0.0;
      double error = static_cast<double>(clustering.error[static_cast<std::size_t>(i)]);
      QVERIFY2(std::abs(error - expected) < rounding * (1.0 + expected),
               qPrintable(QString("%1: %2, %3").arg(i).arg(error).arg(expected)));
    }
  }

  void nothingCutIsNoError() {
    TransportMatrix transport = pixelTransport(Size{6, 5}, Size{9, 4}, 0.2, 3, false);
    Clustering clustering = clustered(everything(transport), asPrinted(5.0, 0.0), quiet);
    QVERIFY((expanded(transport) - expanded(clustering.transport)).norm() <
            rounding * expanded(transport).norm());
    QCOMPARE(clustering.statistics.kept, clustering.statistics.connections);
    QVERIFY(std::abs(clustering.statistics.keptLight - 1.0) < 1e-5);
  }

  void capHolds_data() {
    QTest::addColumn<int>("most");
    QTest::addColumn<double>("cut");
    QTest::addColumn<double>("softest");
    QTest::newRow("one") << 1 << 0.5 << 1.0;
    QTest::newRow("seven") << 7 << 0.5 << 1.5;
    QTest::newRow("usual") << 128 << 0.3 << 2.0;
    QTest::newRow("nothing cut before") << 64 << 0.0 << 1.5;
    QTest::newRow("larger than everything") << 4096 << 0.5 << 0.5;
  }
  void capHolds() {
    QFETCH(int, most);
    QFETCH(double, cut);
    QFETCH(double, softest);
    synthetic::Scene made = scene(softest);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(6.0, cut);
    settings.cap = SizeCap::always;
    settings.mostUnknowns = most;
    Clustering clustering = clustered(graph, settings, quiet);
    verifyPartition(clustering);
    for (const ClusterSize& size : clustering.sizes)
      QVERIFY(size.unknowns <= static_cast<std::uint32_t>(most));
    // A camera pixel sees less than 64 projector pixels best, so only tiny caps leave one without.
    if (most >= 64) QCOMPARE(clustering.statistics.singledOut, std::size_t{0});
    const ClusteringStatistics& s = clustering.statistics;
    QVERIFY(s.keptLight > 0 && s.cutByPatches >= 0 && s.cutByCap >= 0);
    QVERIFY(std::abs(s.keptLight + s.cutByPatches + s.cutByCap + s.farLight - 1.0) < 1e-9);
    if (cut == 0.0) QCOMPARE(s.cutByPatches, 0.0);
  }

  /// A cap that is never reached changes nothing.
  void capBeyondTheLargestClusterIsNoCap() {
    TransportMatrix transport = pixelTransport(Size{6, 5}, Size{9, 4}, 0.08, 5, false);
    ClusteringSettings settings = asPrinted(2.0, 0.5);
    Clustering free = clustered(everything(transport), settings, quiet);
    settings.cap = SizeCap::always;
    Clustering capped = clustered(everything(transport), settings, quiet);
    QVERIFY(capped.projectorCluster == free.projectorCluster && capped.cameraCluster == free.cameraCluster);
    QVERIFY(capped.transport.leaves() == free.transport.leaves());
  }

  void percolationIsSaidAndCapped() {
    synthetic::Scene made = scene(3.0);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(8.0, 0.3);
    Clustering printed = clustered(graph, settings, quiet);
    QVERIFY(printed.statistics.percolated && !printed.statistics.capped);
    QVERIFY(QString::fromStdString(printed.statistics.finding).contains("allow a cap"));
    settings.cap = SizeCap::whenPercolated;
    Clustering capped = clustered(graph, settings, quiet);
    QVERIFY(capped.statistics.capped && capped.statistics.largest <= 256);
    QVERIFY(QString::fromStdString(capped.statistics.finding).contains("held to 256"));
    QCOMPARE(capped.statistics.largestBeforeCap, printed.statistics.largest);
  }

  void strongerThresholdsKeepLess() {
    synthetic::Scene made = scene(1.5);
    ConnectionGraph graph(made.transport, made.usable, {}, quiet);
    ClusteringSettings settings = asPrinted(6.0, 0.3);
    std::size_t before = graph.connections();
    for (double share : {0.0, 0.05, 0.3}) {
      settings.leastShare = share;
      Clustering clustering = clustered(graph, settings, quiet);
      verifyPartition(clustering);
      QVERIFY(clustering.statistics.kept <= before);
      before = clustering.statistics.kept;
    }
    settings.leastLuminance = 1e9f;  // the brightest of every row stays
    Clustering brightest = clustered(graph, settings, quiet);
    QCOMPARE(brightest.statistics.kept, brightest.statistics.litCameraPixels);
  }

  void sameForEveryNumberOfThreads() {
    synthetic::Scene made = scene(2.0, 7);
    auto run = [&](std::size_t threads, SizeCap cap) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      ConnectionGraph graph(made.transport, made.usable, {}, quiet);
      ClusteringSettings settings = asPrinted(6.0, 0.4);
      settings.cap = cap;
      settings.mostUnknowns = 40;
      return clustered(graph, settings, quiet);
    };
    for (SizeCap cap : {SizeCap::never, SizeCap::always}) {
      Clustering one = run(1, cap), two = run(2, cap);
      QVERIFY(one.cameraCluster == two.cameraCluster && one.projectorCluster == two.projectorCluster);
      QVERIFY(one.transport.leaves() == two.transport.leaves() && one.error == two.error);
      QCOMPARE(one.statistics.keptLight, two.statistics.keptLight);
    }
  }

  void extremesHaveDefinedResults_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"black", "unusable", "single pixels", "negative", "not a number", "saturated"})
      QTest::newRow(kind) << kind;
  }
  void extremesHaveDefinedResults() {
    QFETCH(QString, kind);
    Size size = kind == "single pixels" ? Size{1, 1} : Size{4, 3};
    NodeLayout layout{Rasters(size)};
    float full = kind == "not a number" ? std::numeric_limits<float>::quiet_NaN() : 1.0f;
    BlockSparseWriter writer(layout.count(), std::vector<float>(size.count(), full), 0);
    for (std::size_t i = 0; i < size.count(); ++i) {
      BlockSparseWriter::Code code{};
      code.fill(kind == "negative" ? -1000 : 32767);
      if (kind != "black")
        for (std::size_t j = 0; j < size.count(); ++j) writer.add(j, code);
      writer.endRow();
    }
    TransportMatrix transport(size, size, writer.build());
    std::vector<std::uint8_t> usable(size.count(), kind == "unusable" ? 0 : 1);
    Clustering clustering = clustered(ConnectionGraph(transport, usable, {}, quiet), {}, quiet);
    verifyPartition(clustering);
    bool lit = kind == "single pixels" || kind == "saturated";
    QCOMPARE(clustering.sizes.size(), std::size_t{lit ? 1u : 0u});
    for (float error : clustering.error) QCOMPARE(error, kind == "black" || lit ? 0.0f : 1.0f);
  }

  /// Light of nothing but wide leaves makes no connections; it is all far light.
  void wideLeavesCarryNone() {
    NodeLayout layout{Rasters(Size{64, 64})};
    BlockSparseBuilder builder(layout.count(), {1.0f, 1.0f});
    for (std::size_t row : {0, 1}) builder.add(row, layout.index({0, 4, 1, 1}), ColourBlock::Identity());
    TransportMatrix transport(Size{2, 1}, Size{64, 64}, builder.build());
    Clustering clustering = clustered(ConnectionGraph(transport, {1, 1}, {}, quiet), {}, quiet);
    QCOMPARE(clustering.sizes.size(), std::size_t{0});
    QCOMPARE(clustering.statistics.farLight, 1.0);
    QCOMPARE(clustering.error[0], 1.0f);
    ConnectionGraphSettings wide;
    wide.coarsestLevel = 4;
    QCOMPARE(ConnectionGraph(transport, {1, 1}, wide, quiet).connections(), std::size_t{512});
  }

  void wrongSettingsAreRefused() {
    TransportMatrix transport = pixelTransport(Size{2, 1}, Size{2, 1}, 1.0, 1, false);
    ConnectionGraph graph = everything(transport);
    double nan = std::numeric_limits<double>::quiet_NaN();
    for (double cut : {1.0, -0.1, nan})
      QVERIFY_EXCEPTION_THROWN(clustered(graph, asPrinted(5.0, cut), quiet), Error);
    for (double radius : {-1.0, nan})
      QVERIFY_EXCEPTION_THROWN(clustered(graph, asPrinted(radius, 0.5), quiet), Error);
    ClusteringSettings settings;
    settings.mostUnknowns = 0;
    QVERIFY_EXCEPTION_THROWN(clustered(graph, settings, quiet), Error);
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1, 1}, {2.0, 3}, quiet), Error);
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1}, {}, quiet), std::logic_error);
  }

  void canBeCancelled() {
    TransportMatrix transport = pixelTransport(Size{2, 1}, Size{2, 1}, 1.0, 1, false);
    struct Sink : ProgressSink {
      void progressed(double, std::string_view) override {}
    } sink;
    StopRequest stop;
    stop.ask(StopRequest::Kind::cancel);
    Progress progress(sink, stop);
    QVERIFY_EXCEPTION_THROWN(ConnectionGraph(transport, {1, 1}, {}, progress), Cancelled);
    ConnectionGraph graph = everything(transport);
    QVERIFY_EXCEPTION_THROWN(clustered(graph, {}, progress), Cancelled);
  }
};

QTEST_GUILESS_MAIN(TestClustering)
#include "test_clustering.moc"
