// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <QtTest>
#include <limits>

#include "relucent/base/random.h"
#include "relucent/multiplexing/learning.h"
#include "relucent/multiplexing/pattern.h"
#include "relucent/multiplexing/regression.h"

using namespace relucent;
using namespace relucent::multiplexing;
using namespace relucent::transport;

namespace {

/// A camera pixel that sees a few nodes of two projectors, each with colours of its own.
struct Scene {
  NodeLayout layout{Rasters({{16, 11}, {7, 5}})};
  PatternMeans means{layout};
  std::vector<ProjectorStack> patterns;
  Row row;
  std::vector<ColourBlock> truth;  // of the leaves, relative to F_c
  ColourBlock mixing;

  explicit Scene(int count, float ownColours = 0.0f) {
    mixing << 0.7f, 0.2f, 0.1f, 0.1f, 0.8f, 0.1f, 0.05f, 0.15f, 0.8f;
    for (int number = 0; number < count; ++number)
      patterns.push_back(blockPattern(layout.projectors(), number % 3, number, 5));
    means.add(0, patterns);
    row.leaves = startingLeaves(layout, 2, 0.2f);
    row.mixing.assign(4, mixing);
    row.excess = 4e-6f;
    Random random{3};
    Eigen::Array3f sums = Eigen::Array3f::Zero();
    for (std::size_t j = 0; j < row.leaves.size(); ++j) {
      float light = j % 3 == 0 ? 0.02f + random.uniformFloat() : 0.0f;
      ColourBlock block = light * mixing;
      for (int i = 0; i < 9; ++i)
        block.data()[i] *= 1.0f + ownColours * (2.0f * random.uniformFloat() - 1.0f);
      truth.push_back(block);
      sums += block.rowwise().sum().array();
    }
    for (ColourBlock& block : truth) block.array().colwise() /= sums;
  }

  Eigen::Array3f under(const NodeStack& values) const {
    Eigen::Vector3f light = Eigen::Vector3f::Zero();
    for (std::size_t j = 0; j < truth.size(); ++j)
      light += truth[j] * Eigen::Map<const Eigen::Vector3f>(&values[3 * row.leaves[j].node]);
    return light.array();
  }

  /// Photographs with that much noise, and an e that is off.
  RowLight seen(float noise, float offset = 0.0f) const {
    Random random{11};
    RowLight seen;
    auto equations = static_cast<Eigen::Index>(6 + patterns.size());
    seen.light.resize(equations, 3);
    seen.variance = Eigen::ArrayX3f::Constant(equations, 3, std::max(1e-8f, noise * noise));
    seen.offset.setConstant(std::max(1e-4f, offset));
    for (Eigen::Index n = 0; n < equations; ++n) {
      ProjectorStack pattern(3 * layout.projectors().count(), 0.0f);
      auto projector = static_cast<std::size_t>(n / 3);
      if (n < 6)
        for (std::size_t i = 0; i < layout.projectors().size(projector).count(); ++i)
          pattern[3 * (layout.projectors().offset(projector) + i) + static_cast<std::size_t>(n % 3)] = 1.0f;
      else
        pattern = patterns[static_cast<std::size_t>(n - 6)];
      seen.light.row(n) = under(layout.means(pattern)) + offset;
      for (Eigen::Index c = 0; c < 3; ++c) seen.light(n, c) += noise * static_cast<float>(random.normal());
    }
    return seen;
  }

  double errorOf(const RowFit& fit) const {
    double apart = 0.0, whole = 0.0;
    for (std::size_t j = 0; j < truth.size(); ++j) {
      apart += static_cast<double>((fit.blocks[j] - truth[j]).squaredNorm());
      whole += static_cast<double>(truth[j].squaredNorm());
    }
    return std::sqrt(apart / whole);
  }
};

const std::vector<ColourBlock>& bothFloods(const Scene& scene) {
  static std::vector<ColourBlock> mixings;
  mixings.assign(2, scene.mixing);
  return mixings;
}

}  // namespace

class TestRegression : public QObject {
  Q_OBJECT

 private slots:
  void noiselessLightIsExact_data() {
    QTest::addColumn<int>("patterns");
    QTest::addColumn<float>("ownColours");
    QTest::newRow("one mixing") << 20 << 0.0f;
    QTest::newRow("colours of each leaf") << 60 << 0.2f;
  }
  /// More equations than unknowns, no noise: what is left is the priors' weight against an excess of 0.002.
  void noiselessLightIsExact() {
    QFETCH(int, patterns);
    QFETCH(float, ownColours);
    Scene scene(patterns, ownColours);
    RowRegression regression(scene.means, {});
    const RowFit* fit = &regression.solve(scene.row, scene.seen(0.0f));
    learn(scene.row, *fit, bothFloods(scene), {});
    fit = &regression.solve(scene.row, scene.seen(0.0f));
    QVERIFY2(scene.errorOf(*fit) < 0.02, qPrintable(QString::number(scene.errorOf(*fit))));
  }

  /// Noise gives an error that its deviations foretell, and fewer of it with more patterns.
  void noiseGivesABoundedError() {
    double last = std::numeric_limits<double>::infinity();
    for (int patterns : {20, 60, 180}) {
      Scene scene(patterns);
      RowRegression regression(scene.means, {});
      const RowFit& fit = regression.solve(scene.row, scene.seen(0.01f));
      double error = scene.errorOf(fit), foretold = 0.0, whole = 0.0;
      for (std::size_t j = 0; j < scene.truth.size(); ++j) {
        foretold += std::pow(static_cast<double>(scene.row.leaves[j].deviation), 2) *
                    static_cast<double>(scene.mixing.squaredNorm());
        whole += static_cast<double>(scene.truth[j].squaredNorm());
      }
      QVERIFY2(error < 2.0 * std::sqrt(foretold / whole), qPrintable(QString::number(error)));
      QVERIFY2(error < 0.8 * last, qPrintable(QString::number(error)));
      last = error;
    }
  }

  /// The flood is known better than any of its photographs, and e does not pass for light.
  void floodsGainFromAllPhotographs() {
    Scene scene(60);
    RowRegression regression(scene.means, {});
    const RowFit& fit = regression.solve(scene.row, scene.seen(0.01f, 0.01f));
    const Eigen::Array3f variance = regression.floodVariance(scene.row);
    for (Eigen::Index c = 0; c < 3; ++c) {
      double deviation = std::sqrt(static_cast<double>(variance[c]));
      QVERIFY2(deviation < 0.7 * 0.01 * std::sqrt(6.0), qPrintable(QString::number(deviation)));
      QVERIFY2(std::abs(static_cast<double>(fit.flood[c]) - 1.0) < 4.0 * deviation,
               qPrintable(QString("%1 +- %2").arg(static_cast<double>(fit.flood[c])).arg(deviation)));
    }
  }

  void whatWasNotSeenDoesNotMatter() {
    Scene scene(30);
    RowLight seen = scene.seen(0.005f), spoilt = seen;
    for (Eigen::Index n : {7, 20, 21}) {
      seen.variance.row(n).setConstant(std::numeric_limits<float>::infinity());
      spoilt.variance.row(n) = seen.variance.row(n);
      spoilt.light.row(n).setConstant(3.0f);  // as a saturated value's lower bound
    }
    RowRegression regression(scene.means, {});
    Row row = scene.row;
    std::vector<ColourBlock> blocks = regression.solve(row, seen).blocks;
    const RowFit& fit = regression.solve(scene.row, spoilt);
    for (std::size_t j = 0; j < blocks.size(); ++j) QVERIFY(blocks[j] == fit.blocks[j]);
  }

  /// Law: a pixel that was dark in the floods and sees much light later, since the camera was moved, comes to
  /// numbers, however little they fit.
  void whatContradictsTheFloodsStaysFinite_data() {
    QTest::addColumn<float>("brighter");
    QTest::addColumn<float>("deviation");
    for (float brighter : {3.0f, 30.0f, 300.0f, 1000.0f})
      for (float deviation : {1e-4f, 1e-2f, 1.0f})
        QTest::addRow("%g times, known to %g", static_cast<double>(brighter), static_cast<double>(deviation))
            << brighter << deviation;
  }
  void whatContradictsTheFloodsStaysFinite() {
    QFETCH(float, brighter);
    QFETCH(float, deviation);
    Scene scene(60);
    RowLight seen = scene.seen(0.01f);
    Random random{7};
    for (Eigen::Index n = 6; n < seen.light.rows(); ++n)
      for (Eigen::Index c = 0; c < 3; ++c) seen.light(n, c) = brighter * random.uniformFloat();
    seen.variance.bottomRows(seen.light.rows() - 6) = deviation * deviation;
    RowRegression regression(scene.means, {});
    for (int times = 0; times < 12; ++times) {
      const RowFit& fit = regression.solve(scene.row, seen);
      QVERIFY2(std::isfinite(fit.misfit) && fit.flood.isFinite().all(), qPrintable(QString::number(times)));
      QVERIFY(regression.floodVariance(scene.row).isFinite().all());
      for (const ColourBlock& block : fit.blocks) QVERIFY(block.allFinite());
      for (const Leaf& leaf : scene.row.leaves)
        QVERIFY(std::isfinite(static_cast<float>(leaf.light)) &&
                std::isfinite(static_cast<float>(leaf.deviation)));
      learn(scene.row, fit, bothFloods(scene), {});
    }
  }

  void predictionsAreThoseOfTheFit() {
    Scene scene(60);
    RowRegression regression(scene.means, {});
    RowLight seen = scene.seen(0.0f);
    RowLight without = seen;
    without.variance.bottomRows(4).setConstant(std::numeric_limits<float>::infinity());
    regression.solve(scene.row, without);
    for (std::size_t pattern = 56; pattern < 60; ++pattern) {
      Eigen::Array3f light = seen.light.row(static_cast<Eigen::Index>(6 + pattern)).transpose();
      QVERIFY((regression.predict().row(static_cast<Eigen::Index>(pattern)).transpose() - light)
                  .abs()
                  .maxCoeff() < 0.02f);
    }
  }

  /// Single precision, and wide registers, change little of what narrower ones find.
  void kernelsAgree() {
    Scene scene(60, 0.1f);
    RowLight seen = scene.seen(0.005f);
    std::vector<std::vector<ColourBlock>> found;
    for (const SystemKernels& kernels : systemKernels()) {
      Row row = scene.row;
      found.push_back(RowRegression(scene.means, {}, kernels).solve(row, seen).blocks);
    }
    for (std::size_t j = 0; j < found[0].size(); ++j)
      QVERIFY((found[0][j] - found.back()[j]).cwiseAbs().maxCoeff() < 1e-4f);
  }

  /// A fit that leaves more than noise teaches an excess.
  void excessFollowsTheMisfit() {
    Scene scene(60);
    RowLight seen = scene.seen(0.02f);
    seen.variance.setConstant(1e-6f);  // claims to be better than it is
    RowRegression regression(scene.means, {});
    for (int round = 0; round < 4; ++round) {
      const RowFit& fit = regression.solve(scene.row, seen);
      learn(scene.row, fit, bothFloods(scene), {});
    }
    double excess = std::sqrt(static_cast<double>(scene.row.excess));
    QVERIFY2(excess > 0.01 && excess < 0.04, qPrintable(QString::number(excess)));
  }
};

QTEST_MAIN(TestRegression)
#include "test_regression.moc"
