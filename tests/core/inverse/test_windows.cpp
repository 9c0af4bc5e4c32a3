// SPDX-License-Identifier: MIT
#include "relucent/inverse/windows.h"

#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <QtTest>
#include <cmath>
#include <span>

#include "core/inverse/synthetic_transport.h"
#include "core/transport/expanded.h"
#include "relucent/base/error.h"
#include "relucent/inverse/near_field.h"
#include "relucent/inverse/prepared_windows.h"
#include "relucent/transport/difference.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::inverse;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

// Weights are rounded to 1/32767 of a tile's largest (a few times the identity's), rows of T to 1/32767 of
// their largest: some tens of such errors add up.
constexpr float fixedPoint = 3e-3f;

Progress quiet;

WindowInverse windowsOf(const Scene& scene, const WindowSettings& settings = {}) {
  return computeWindows(scene.transport, scene.usable, settings, quiet);
}

/// A camera that sees every projector pixel by its own, with crosstalk and reflectance of its own.
Scene oneToOne(Size size) {
  NodeLayout layout{Rasters(size)};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
  for (std::size_t i = 0; i < size.count(); ++i) {
    Random random({i, 5});
    ColourBlock block;
    block << 0.8f, 0.1f, 0.02f, 0.1f, 0.7f, 0.1f, 0.02f, 0.1f, 0.9f;
    builder.add(i, i, (static_cast<float>(0.2 + 0.8 * random.uniform()) * block).eval());
  }
  return {TransportMatrix(size, size, builder.build()), CameraStack(3 * size.count(), 0.0f),
          CameraMask(size.count(), 1)};
}

/// T expanded to pixels, one colour channel after unmixing: what a window's G should be made of.
Eigen::MatrixXd unmixedChannel(const TransportMatrix& transport, std::span<const ColourBlock> unmix,
                               Eigen::Index channel) {
  Eigen::MatrixXd t = expanded(transport);
  Eigen::MatrixXd result(t.rows() / 3, t.cols() / 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index j = 0; j < result.cols(); ++j)
      result(i, j) = unmix[static_cast<std::size_t>(i)].row(channel).cast<double>().dot(
          t.block<3, 3>(3 * i, 3 * j).col(channel));
  return result;
}

}  // namespace

class TestWindows : public QObject {
  Q_OBJECT

 private slots:
  void undoesEasyTransport_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("tile");
    QTest::newRow("whole tiles") << 16 << 12 << 4;
    QTest::newRow("tiles cut off at the border") << 17 << 13 << 4;
    QTest::newRow("large tiles") << 19 << 16 << 8;
    QTest::newRow("smaller than a tile") << 3 << 2 << 4;
  }
  void undoesEasyTransport() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(int, tile);
    Scene scene = oneToOne({width, height});
    WindowSettings settings;
    settings.tile = tile;
    settings.rows = 96;
    settings.ridge = 1e-5;
    ProjectorStack p(randomStack(3 * scene.transport.projectors().count(), 3));
    ProjectorStack back = windowsOf(scene, settings).apply(scene.transport.apply(p));
    // The unmixing is regularised with 0.03^2 of the mixing's energy: up to a percent of the value.
    for (std::size_t j = 0; j < p.size(); ++j)
      QVERIFY2(std::abs(back[j] - p[j]) < 0.015f, qPrintable(QString::number(back[j] - p[j])));
  }

  void floodGivesWhite_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<double>("ridge");
    for (int seed = 1; seed <= 3; ++seed)
      for (double ridge : {0.05, 0.4, 2.0}) QTest::addRow("seed %d ridge %g", seed, ridge) << seed << ridge;
  }
  void floodGivesWhite() {
    QFETCH(int, seed);
    QFETCH(double, ridge);
    SceneSettings s;
    s.seed = static_cast<std::uint64_t>(seed);
    Scene scene = makeScene(s);
    WindowSettings settings;
    settings.ridge = ridge;
    ProjectorStack white = windowsOf(scene, settings).apply(scene.transport.floodlight());
    std::size_t seen = 0;
    for (float value : white) {
      QVERIFY2(value == 0.0f || std::abs(value - 1.0f) < fixedPoint, qPrintable(QString::number(value)));
      seen += value != 0.0f;
    }
    QVERIFY(seen > white.size() * 9 / 10);
  }

  void scalingTransportScalesTheInverse() {
    Scene scene = makeScene({});
    Scene brighter = scene;
    std::size_t values = 3 * scene.usable.size();
    brighter.transport = rescaledToFloodlight(scene.transport, [&] {
      CameraStack flood = scene.transport.floodlight();
      for (float& value : flood) value *= 4.0f;  // a power of two: the same codes
      return flood;
    }());
    CameraStack r = randomStack<CameraStack>(values, 4);
    ProjectorStack once = windowsOf(scene).apply(r), quarter = windowsOf(brighter).apply(r);
    for (float& value : quarter) value *= 4.0f;
    QVERIFY2(relativeError(quarter, once) < 1e-3, qPrintable(QString::number(relativeError(quarter, once))));
  }

  void isLinear() {
    Scene scene = makeScene({});
    WindowInverse inverse = windowsOf(scene);
    CameraStack a = randomStack<CameraStack>(3 * scene.usable.size(), 5),
                b = randomStack<CameraStack>(3 * scene.usable.size(), 6), sum = a;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 2.0f * a[i] - 0.5f * b[i];
    ProjectorStack ofA = inverse.apply(a), ofB = inverse.apply(b), ofSum = inverse.apply(sum);
    for (std::size_t j = 0; j < ofA.size(); ++j) ofA[j] = 2.0f * ofA[j] - 0.5f * ofB[j];
    QVERIFY(relativeError(ofSum, ofA) < 1e-5);  // single precision
  }

  void equalsTheDenseInverse_data() {
    QTest::addColumn<int>("coarsest");
    QTest::newRow("pixels only") << 0;
    QTest::newRow("leaves of two levels, nested") << 1;
    QTest::newRow("leaves wider than a tile") << 3;
  }
  /// With a window that holds the whole camera, M must be the dense T^T (T T^T + lambda N)^-1 under an
  /// unknown mean, however T is spread over levels.
  void equalsTheDenseInverse() {
    QFETCH(int, coarsest);
    Size projector{8, 8}, camera{5, 4};
    NodeLayout layout{Rasters(projector)};
    BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 1.0f));
    Random random({9});
    for (std::size_t row = 0; row < camera.count(); ++row) {
      for (int level = 0; level <= coarsest; ++level) {
        Size grid = layout.gridSize(0, level);
        for (std::size_t node = 0; node < grid.count(); ++node) {
          if (random.uniform() < 0.5) continue;
          Pixel place = pixelAt(grid, node);
          // Bright enough per pixel that every leaf belongs to the near field.
          auto value = static_cast<float>((0.1 + random.uniform()) * std::pow(4.0, level) / 100.0);
          builder.add(row, layout.index({0, level, place.x, place.y}), ColourBlock::Identity() * value);
        }
      }
    }
    Scene scene{TransportMatrix(camera, projector, builder.build()), {}, CameraMask(camera.count(), 1)};
    NearField near = nearFieldOf(scene.transport, scene.usable);
    Eigen::MatrixXd t = unmixedChannel(scene.transport, near.unmix, 1);
    WindowSettings settings;
    settings.rows = 96;
    Eigen::MatrixXd g = t * t.transpose();
    Eigen::VectorXd noise(g.rows());
    for (Eigen::Index i = 0; i < noise.size(); ++i)
      noise[i] = static_cast<double>(near.unmix[static_cast<std::size_t>(i)].row(1).squaredNorm());
    g.diagonal() += settings.ridge * g.diagonal().mean() * noise.cwiseInverse().mean() * noise;
    Eigen::VectorXd flood = t.rowwise().sum();
    Eigen::MatrixXd m = t.transpose() * g.inverse();
    Eigen::VectorXd a = g.inverse() * flood;
    m += (Eigen::VectorXd::Ones(m.rows()) - m * flood) * a.transpose() / flood.dot(a);

    CameraStack u = randomStack<CameraStack>(3 * camera.count(), 11), r(u.size());
    for (std::size_t i = 0; i < camera.count(); ++i) {
      Eigen::Vector3f mixed =
          Eigen::Matrix3f(near.unmix[i]).inverse() * Eigen::Map<Eigen::Vector3f>(&u[3 * i]);
      std::copy_n(mixed.data(), 3, &r[3 * i]);
    }
    ProjectorStack p = windowsOf(scene, settings).apply(r);
    Eigen::VectorXd unmixed(camera.count());
    for (std::size_t i = 0; i < camera.count(); ++i) unmixed[static_cast<Eigen::Index>(i)] = u[3 * i + 1];
    Eigen::VectorXd expected = m * unmixed;
    for (Eigen::Index j = 0; j < expected.size(); ++j)
      QVERIFY2(std::abs(p[3 * static_cast<std::size_t>(j) + 1] - expected[j]) <
                   fixedPoint * m.cwiseAbs().maxCoeff(),
               qPrintable(
                   QString("%1 instead of %2").arg(p[3 * static_cast<std::size_t>(j) + 1]).arg(expected[j])));
  }

  /// Law: every value of the near field is that of its leaf, unmixed, to half a step of the row's largest.
  void theNearFieldIsThatOfTheLeaves() {
    const Scene scene = makeScene({});
    const BlockSparse& leaves = scene.transport.ownLeaves();
    const NearField near = nearFieldOf(scene.transport, scene.usable);
    QVERIFY(near.node.size() > leaves.rows());
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      float largest = 0.0f;
      for (std::size_t leaf = near.start[row]; leaf < near.start[row + 1]; ++leaf) {
        const std::span<const std::uint32_t> columns = leaves.columnsOf(row);
        const auto place = std::ranges::lower_bound(columns, near.node[leaf]) - columns.begin();
        const ColourBlock block = leaves.block(row, leaves.rowBegin(row) + static_cast<std::size_t>(place));
        for (int c = 0; c < 3; ++c) {
          const float expected = near.unmix[row].row(c).dot(block.col(c));
          largest = std::max(largest, std::abs(expected));
          QVERIFY(std::abs(near.value(row, leaf)[static_cast<std::size_t>(c)] - expected) <=
                  0.51f * near.step[row]);
        }
      }
      QVERIFY(std::abs(near.step[row] * 32767.0f - largest) <= 1e-6f * largest);
    }
  }

  void unusablePixelsHaveNoSay() {
    Scene scene = makeScene({});
    for (std::size_t i = 0; i < scene.usable.size(); i += 7) scene.usable[i] = 0;
    WindowInverse inverse = windowsOf(scene);
    CameraStack r = randomStack<CameraStack>(3 * scene.usable.size(), 7), other = r;
    for (std::size_t i = 0; i < r.size(); ++i)
      if (!scene.usable[i / 3]) other[i] = 1e6f;
    QVERIFY(inverse.apply(r) == inverse.apply(other));
  }

  void sameBitsForEveryNumberOfThreads() {
    Scene scene = makeScene({});
    CameraStack r = randomStack<CameraStack>(3 * scene.usable.size(), 8);
    WindowInverse many = windowsOf(scene);
    ProjectorStack ofMany = many.apply(r);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    WindowInverse alone = windowsOf(scene);
    QVERIFY(alone == many);
    QVERIFY(alone.apply(r) == ofMany);
  }

  void renewedWindowsAreThoseMadeAnew_data() {
    QTest::addColumn<int>("tile");
    QTest::addColumn<int>("every");  // which camera pixels change
    QTest::addColumn<bool>("usable");
    QTest::newRow("none") << 4 << 1 << true;
    QTest::newRow("a few") << 4 << 37 << true;
    QTest::newRow("many, large tiles") << 8 << 2 << true;
    QTest::newRow("no longer usable") << 4 << 23 << false;
  }
  void renewedWindowsAreThoseMadeAnew() {
    QFETCH(int, tile);
    QFETCH(int, every);
    QFETCH(bool, usable);
    WindowSettings settings;
    settings.tile = tile;
    const Scene then = makeScene({});
    Scene now = then;
    Stack factor(3 * then.usable.size(), 1.0f);
    for (std::size_t row = 1; row < then.usable.size() && every > 1; ++row) {
      if (row % static_cast<std::size_t>(every) != 0) continue;
      if (!usable)
        now.usable[row] = 0;
      else  // of another colour, so that it is unmixed otherwise
        for (std::size_t c = 0; c < 3; ++c) factor[3 * row + c] = 0.9f - 0.3f * static_cast<float>(c);
    }
    now.transport = then.transport.withRowsScaled(factor);
    CameraMask changed = differingRows(now.transport, then.transport);
    for (std::size_t row = 0; row < changed.size(); ++row)
      if (now.usable[row] != then.usable[row]) changed[row] = 1;
    QVERIFY(renewWindows(windowsOf(then, settings), changed, now.transport, now.usable, settings, quiet) ==
            windowsOf(now, settings));
  }
  void whatHasNotChangedIsNotSolvedAgain() {
    const Scene scene = makeScene({});
    WindowSettings firm;
    firm.ridge = 2.0;
    const WindowInverse former = windowsOf(scene, firm);
    const CameraMask none(scene.usable.size(), 0);
    QVERIFY(renewWindows(former, none, scene.transport, scene.usable, {}, quiet) == former);
    WindowSettings large;
    large.tile = 8;
    QVERIFY_THROWS_EXCEPTION(std::logic_error,
                             renewWindows(former, none, scene.transport, scene.usable, large, quiet));
  }

  void twoProjectorsShareTheLight() {
    // Both projectors light every camera pixel alike: each must be asked for the same, and flood be white.
    Size size{8, 8};
    Rasters projectors(std::vector<Size>{size, size});
    NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
    for (std::size_t i = 0; i < size.count(); ++i)
      for (int projector = 0; projector < 2; ++projector)
        builder.add(i, layout.index({projector, 0, pixelAt(size, i).x, pixelAt(size, i).y}),
                    ColourBlock::Identity() * 0.5f);
    Scene scene{TransportMatrix(size, projectors, builder.build()), {}, CameraMask(size.count(), 1)};
    CameraStack r = randomStack<CameraStack>(3 * size.count(), 12);
    ProjectorStack p = windowsOf(scene).apply(r);
    for (std::size_t j = 0; j < 3 * size.count(); ++j) QCOMPARE(p[j], p[3 * size.count() + j]);
  }

  void refusesWhatCannotBeInverted() {
    NodeLayout layout{Rasters(Size{4, 4})};
    // Rows that are all alike make G singular; without a ridge worth the name Cholesky must notice.
    BlockSparseBuilder alike(layout.count(), std::vector<float>(16, 1.0f));
    for (std::size_t i = 0; i < 16; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        alike.add(i, j, ColourBlock::Identity() * (0.3f + 0.1f * static_cast<float>(j)));
    TransportMatrix transport(Size{4, 4}, Size{4, 4}, alike.build());
    WindowSettings settings;
    settings.ridge = 1e-12;
    try {
      computeWindows(transport, CameraMask(16, 1), settings, quiet);
      QFAIL("a singular window was inverted");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::numerics);
    }
  }

  void cancels() {
    Stopped stopped;
    Scene scene = oneToOne({8, 8});
    QVERIFY_EXCEPTION_THROWN(computeWindows(scene.transport, scene.usable, {}, stopped), Cancelled);
  }

  void checksSettings_data() {
    QTest::addColumn<int>("tile");
    QTest::addColumn<int>("rows");
    QTest::addColumn<double>("ridge");
    QTest::newRow("tile") << 3 << 48 << 0.3;
    QTest::newRow("rows") << 4 << 0 << 0.3;
    QTest::newRow("no ridge") << 4 << 48 << 0.0;
    QTest::newRow("ridge not a number") << 4 << 48 << std::nan("");
  }
  void checksSettings() {
    QFETCH(int, tile);
    QFETCH(int, rows);
    QFETCH(double, ridge);
    WindowSettings settings{tile, rows, ridge};
    QCOMPARE(problems(settings).size(), std::size_t{1});
    QVERIFY(problems(WindowSettings{}).empty());
    Scene scene = oneToOne({4, 4});
    QVERIFY_EXCEPTION_THROWN(windowsOf(scene, settings), std::logic_error);
  }
};

QTEST_APPLESS_MAIN(TestWindows)
#include "test_windows.moc"
