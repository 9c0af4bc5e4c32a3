// SPDX-License-Identifier: MIT
#include "relucent/compensation/step_preconditioner.h"

#include <QtTest>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Scene sceneOf(int seed) {
  SceneSettings settings;
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.projector = {32, 24};
  settings.camera = {20, 15};
  return makeScene(settings);
}

/// A dense T whose channels pass `passed` of their light each, from some camera pixels to some projector
/// pixels.
TransportMatrix filtered(const std::array<float, 3>& passed, std::uint64_t seed) {
  const Size projector{3, 2}, camera{4, 3};
  const NodeLayout layout{Rasters(projector)};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 1.0f));
  Random random({seed});
  for (std::size_t row = 0; row < camera.count(); ++row)
    for (std::size_t node = 0; node < projector.count(); ++node) {
      const float light = random.uniformFloat();
      ColourBlock block = ColourBlock::Zero();
      for (int c = 0; c < 3; ++c) block(c, c) = light * passed[static_cast<std::size_t>(c)];
      builder.add(row, node, block);
    }
  return TransportMatrix(camera, projector, builder.build());
}

std::vector<float> randomWeights(const CameraMask& usable, std::uint64_t seed) {
  Random random({seed, 5});
  std::vector<float> weight(usable.size());
  for (std::size_t i = 0; i < weight.size(); ++i)
    weight[i] = usable[i] ? 1.0f + (largestSensitivity - 1.0f) * random.uniformFloat() : 0.0f;
  return weight;
}

/// Largest relative difference.
double apart(const ProjectorStack& a, const ProjectorStack& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j] != b[j])
      most = std::max(most, std::abs(static_cast<double>(a[j]) - static_cast<double>(b[j])) /
                                static_cast<double>(std::max(a[j], b[j])));
  return most;
}

// Sums of some hundred products in single precision.
constexpr double rounding = 1e-5;

}  // namespace

class TestStepPreconditioner : public QObject {
  Q_OBJECT

  void seeds() {
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 4; ++seed) QTest::addRow("%d", seed) << seed;
  }

 private slots:
  void isExactWhereWeightsAreAlike_data() { seeds(); }
  /// Whatever their value, with all projector pixels free.
  void isExactWhereWeightsAreAlike() {
    QFETCH(int, seed);
    const Scene scene = sceneOf(seed);
    const StepPreconditioner made(scene.transport, scene.usable);
    const CameraStack nothing(3 * scene.usable.size());
    for (const float weight : {0.05f, 1.0f, largestSensitivity}) {
      std::vector<float> weights(scene.usable.size());
      for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = scene.usable[i] ? weight : 0.0f;
      const ConstrainedProblem problem{scene.transport, nothing, weights,
                                       ProjectorMask(scene.transport.projectors().count(), 1)};
      const double most = apart(made.of(problem), diagonalPreconditioner(problem));
      QVERIFY2(most < rounding, qPrintable(QString::number(most)));
    }
  }

  void isExactWhereSurfacesAreGrey_data() { seeds(); }
  /// Whatever the weights and the share of light in each channel.
  void isExactWhereSurfacesAreGrey() {
    QFETCH(int, seed);
    const TransportMatrix transport = filtered({0.9f, 0.3f, 0.05f}, static_cast<std::uint64_t>(seed));
    const CameraMask usable(transport.cameras().count(), 1);
    const CameraStack nothing(3 * usable.size());
    ProjectorMask free(transport.projectors().count(), 1);
    const std::vector<float> weights = randomWeights(usable, static_cast<std::uint64_t>(seed));
    const ConstrainedProblem problem{transport, nothing, weights, free};
    const double most =
        apart(StepPreconditioner(transport, usable).of(problem), diagonalPreconditioner(problem));
    // Half a code of 15 bits of the row's largest value, in a channel that passes a twentieth of it.
    QVERIFY2(most < 0x1p-16 / 0.05, qPrintable(QString::number(most)));
  }

  void overshootsNowhereGreenIsMissing_data() { seeds(); }
  /// What green does not show is held for the largest weights that there are.
  void overshootsNowhereGreenIsMissing() {
    QFETCH(int, seed);
    const TransportMatrix transport = filtered({0.9f, 1e-4f, 0.3f}, static_cast<std::uint64_t>(seed));
    const CameraMask usable(transport.cameras().count(), 1);
    const CameraStack nothing(3 * usable.size());
    const std::vector<float> weights = randomWeights(usable, static_cast<std::uint64_t>(seed));
    const ConstrainedProblem problem{transport, nothing, weights,
                                     ProjectorMask(transport.projectors().count(), 1)};
    const ProjectorStack made = StepPreconditioner(transport, usable).of(problem);
    const ProjectorStack exact = diagonalPreconditioner(problem);
    for (std::size_t j = 0; j < made.size(); ++j) {
      if (j % 3 == 1) continue;
      QVERIFY2(made[j] <= exact[j] && made[j] * largestSensitivity >= exact[j],
               qPrintable(QString("%1 for %2").arg(made[j]).arg(exact[j])));
    }
  }

  void leavesAloneWhatIsNotFree() {
    const Scene scene = sceneOf(1);
    ProjectorMask free(scene.transport.projectors().count(), 1);
    for (std::size_t j = 0; j < free.size(); j += 7) free[j] = 0;
    const CameraStack nothing(3 * scene.usable.size());
    const ConstrainedProblem problem{scene.transport, nothing, randomWeights(scene.usable, 2), free};
    const ProjectorStack made = StepPreconditioner(scene.transport, scene.usable).of(problem);
    for (std::size_t j = 0; j < made.size(); ++j) QCOMPARE(made[j] == 0.0f, free[j / 3] == 0);
  }

  void shapesMustAgree() {
    const Scene scene = sceneOf(1);
    QVERIFY_EXCEPTION_THROWN(StepPreconditioner(scene.transport, CameraMask(3)), std::logic_error);
    const CameraStack nothing(3 * scene.usable.size());
    const ConstrainedProblem problem{scene.transport, nothing, std::vector<float>(scene.usable.size()),
                                     ProjectorMask(5)};
    QVERIFY_EXCEPTION_THROWN(StepPreconditioner(scene.transport, scene.usable).of(problem), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestStepPreconditioner)
#include "test_step_preconditioner.moc"
