// SPDX-License-Identifier: MIT
#include "relucent/transport/leaf_sharing.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/transport/expanded.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/transport/difference.h"
#include "relucent/transport/files.h"
#include "relucent/transport/row_light.h"
#include "relucent/transport/shared_colours.h"
#include "relucent/transport/statistics.h"

#include <tbb/global_control.h>

using namespace relucent;
using namespace relucent::transport;

namespace {

struct Scene {
  const char* name;
  Rasters cameras, projectors;
  float unlike;          // how much neighbours differ, of a leaf
  bool isNoise = false;  // far light cancels
};

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all{
      {"alike", Rasters(Size{24, 16}), Rasters(Size{32, 32}), 0.0f},
      {"nearly alike", Rasters(Size{24, 16}), Rasters(Size{32, 32}), 0.03f},
      {"unlike", Rasters(Size{16, 16}), Rasters(Size{32, 32}), 1.0f},
      {"odd sizes", Rasters(Size{19, 13}), Rasters(Size{37, 21}), 0.02f},
      {"narrower than a square", Rasters(Size{3, 2}), Rasters(Size{16, 16}), 0.02f},
      {"two projectors", Rasters(Size{16, 8}), Rasters({{32, 16}, {13, 7}}), 0.02f},
      {"two cameras", Rasters({{16, 9}, {8, 8}}), Rasters({{16, 16}, {16, 16}}), 0.02f},
      {"noise", Rasters(Size{16, 8}), Rasters(Size{32, 32}), 0.3f, true}};
  return all;
}

/// Every pixel sees two projector pixels and, of each projector, all of the nodes of one level.
TransportMatrix made(const Scene& scene, std::uint64_t seed = 5) {
  const NodeLayout layout(scene.projectors);
  const ColumnKinds kinds = nearAndFar(layout, 2);
  SharedColourEncoder encoder(kinds);
  SharedColourWriter writer(layout.count(), scene.cameras.count(), kinds, 0);
  SharedColourRow encoded;
  for (std::size_t row = 0; row < scene.cameras.count(); ++row) {
    Random own{seed, row};
    std::map<std::uint32_t, ColourBlock> leaves;
    const ColourBlock surface = Eigen::Vector3f(0.5f + 0.5f * own.uniformFloat(), 0.7f, 0.4f).asDiagonal() *
                                (ColourBlock::Identity() + 0.1f * ColourBlock::Ones());
    for (std::size_t projector = 0; projector < scene.projectors.devices(); ++projector) {
      const auto device = static_cast<int>(projector);
      const std::size_t pixels = scene.projectors.size(projector).count();
      for (int i = 0; i < 2; ++i)
        leaves[static_cast<std::uint32_t>(scene.projectors.offset(projector) + own.below(pixels))] =
            20.0f * surface;
      const Size grid = layout.gridSize(projector, 2);
      for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
          Random place{seed, 99, projector, indexOf(grid, {x, y})};  // the same for all camera pixels
          float light = 0.2f + place.uniformFloat();
          light *= 1.0f + scene.unlike * (own.uniformFloat() - 0.5f);
          if (scene.isNoise) light = own.uniformFloat() - 0.5f;
          leaves[static_cast<std::uint32_t>(layout.index({device, 2, x, y}))] = light * surface;
        }
    }
    std::vector<std::uint32_t> columns;
    std::vector<ColourBlock> blocks;
    for (const auto& [column, block] : leaves) {
      columns.push_back(column);
      blocks.push_back(block);
    }
    encoder.encode(columns, blocks, encoded);
    writer.add(encoded);
  }
  return {scene.cameras, scene.projectors, writer.build()};
}

TransportMatrix shared(const TransportMatrix& flat, float tolerance = sharingTolerance) {
  Progress quiet;
  return withSharedLeaves(flat, tolerance, quiet);
}

Stack randomStack(std::size_t values, std::uint64_t seed) {
  Random random{seed};
  Stack stack(values);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

float largestOf(const Stack& stack) {
  float largest = 0.0f;
  for (float value : stack) largest = std::max(largest, std::abs(value));
  return largest;
}

float mostApart(const Stack& a, const Stack& b) {
  float most = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

void addScenes() {
  QTest::addColumn<int>("scene");
  for (std::size_t i = 0; i < scenes().size(); ++i)
    QTest::addRow("%s", scenes()[i].name) << static_cast<int>(i);
}

constexpr float rounding = 2e-5f;  // of sums of a few hundred floats and codes

}  // namespace

class TestLeafSharing : public QObject {
  Q_OBJECT

 private slots:
  void productsAreOfTheWholeRows_data() { addScenes(); }
  /// T p, its adjoint, T 1 and the sums of rows are those of the same T without groups.
  void productsAreOfTheWholeRows() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    const TransportMatrix flat = t.flattened();
    QVERIFY(flat.groups().empty());
    const ProjectorStack p(randomStack(3 * t.projectors().count(), 1));
    const CameraStack c(randomStack(3 * t.cameras().count(), 2));
    const CameraStack light = flat.apply(p);
    QVERIFY(mostApart(t.apply(p), light) <= rounding * largestOf(light));
    const ProjectorStack adjoint = flat.applyTransposed(c);
    QVERIFY(mostApart(t.applyTransposed(c), adjoint) <= rounding * largestOf(adjoint));
    QVERIFY(mostApart(t.floodlight(), flat.floodlight()) <= rounding * largestOf(flat.floodlight()));
    const std::vector<ColourBlock> sums = t.rowSums(), ofFlat = flat.rowSums();
    for (std::size_t row = 0; row < sums.size(); ++row)
      QVERIFY((sums[row] - ofFlat[row]).cwiseAbs().maxCoeff() <=
              rounding * ofFlat[row].cwiseAbs().maxCoeff());
    const std::vector<std::vector<ColourBlock>> ofProjectors = t.rowSumsOfProjectors();
    for (std::size_t projector = 0; projector < t.projectors().devices(); ++projector)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        ProjectorStack lit(3 * t.projectors().count(), 0.0f);
        for (std::size_t pixel = 0; pixel < t.projectors().size(projector).count(); ++pixel)
          lit[3 * (t.projectors().offset(projector) + pixel) + channel] = 1.0f;
        const CameraStack seen = t.apply(lit);
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const float sum = ofProjectors[projector][i / 3](static_cast<Eigen::Index>(i % 3),
                                                           static_cast<Eigen::Index>(channel));
          QVERIFY(std::abs(sum - seen[i]) <= static_cast<float>(rounding * largestOf(seen)));
        }
      }
    QCOMPARE(statisticsOf(t).leaves, static_cast<std::uint64_t>(flat.storedLeaves()));
    QCOMPARE(statisticsOf(t).bytes, static_cast<std::uint64_t>(t.bytes()));
  }

  void adjoint_data() { addScenes(); }
  /// <T p, c> = <p, T^T c>.
  void adjoint() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    const ProjectorStack p(randomStack(3 * t.projectors().count(), 3));
    const CameraStack c(randomStack(3 * t.cameras().count(), 4));
    double left = 0.0, right = 0.0;
    const CameraStack light = t.apply(p);
    const ProjectorStack back = t.applyTransposed(c);
    for (std::size_t i = 0; i < c.size(); ++i) left += static_cast<double>(light[i]) * c[i];
    for (std::size_t i = 0; i < p.size(); ++i) right += static_cast<double>(back[i]) * p[i];
    QVERIFY2(std::abs(left - right) <= 1e-4 * std::abs(left) + 1e-6,
             qPrintable(QString::number(left - right)));
  }

  void withinTheTolerance_data() { addScenes(); }
  /// The light of every node that T had a leaf at is within the tolerance, of the channels together of a
  /// row's light; sums of rows, where they are no noise, are kept.
  void withinTheTolerance() {
    QFETCH(int, scene);
    const Scene& of = scenes()[static_cast<std::size_t>(scene)];
    const TransportMatrix flat = made(of), t = shared(flat);
    const Eigen::MatrixXd before = expanded(flat), after = expanded(t);
    const NodeLayout& layout = flat.layout();
    const std::vector<ColourBlock> sums = flat.rowSums(), kept = t.rowSums();
    for (std::size_t row = 0; row < sums.size(); ++row) {
      const float light = sums[row].colwise().sum().maxCoeff();
      const LeafRow leaves = flat.row(row);
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        const Node node = layout.node(leaves.column(entry));
        const Block block = layout.block(node);
        const auto device = static_cast<std::size_t>(node.projector);
        Eigen::Vector3d apart = Eigen::Vector3d::Zero();
        for (int y = block.y0; y < block.y1; ++y)
          for (int x = block.x0; x < block.x1; ++x) {
            const auto column = static_cast<Eigen::Index>(
                3 * (of.projectors.offset(device) + indexOf(of.projectors.size(device), {x, y})));
            const auto line = static_cast<Eigen::Index>(3 * row);
            apart += (after - before).block<3, 3>(line, column).colwise().sum();
          }
        // Joined near leaves may be off once, far ones another time, and a twentieth for rescaling and codes.
        QVERIFY2(apart.cwiseAbs().maxCoeff() <= 2.05 * sharingTolerance * std::abs(light) || of.isNoise,
                 qPrintable(QString("%1 of %2").arg(apart.cwiseAbs().maxCoeff()).arg(light)));
      }
      if (!of.isNoise)
        QVERIFY((kept[row] - sums[row]).cwiseAbs().maxCoeff() <= 1e-4f * sums[row].cwiseAbs().maxCoeff());
    }
    QVERIFY(t.storedLeaves() <= flat.storedLeaves());
  }

  /// What is alike is held once for 64 camera pixels.
  void whatIsAlikeIsHeldOnce() {
    const TransportMatrix flat = made(scenes()[0]), t = shared(flat);
    const std::size_t far = 64;  // leaves of level 2 of 32x32 pixels
    const std::size_t squares = 3 * 2, pixels = flat.cameras().count();
    QVERIFY(flat.storedLeaves() >= pixels * far);
    QVERIFY(t.storedLeaves() <= squares * far + 3 * pixels);
    QVERIFY(t.groups().count() == squares);
    QVERIFY(3 * t.bytes() < flat.bytes());
  }

  /// Where neighbours differ, leaves stay single.
  void whatDiffersStaysSingle() {
    const TransportMatrix flat = made(scenes()[2]), t = shared(flat, 1e-4f);
    QVERIFY(t.ownLeaves().blocks() > 9 * flat.storedLeaves() / 10);
    QVERIFY(difference(t, flat).frobenius < 1e-3);
  }

  void whatHasColoursOfItsOwnStays() {
    const NodeLayout layout{Rasters(Size{8, 8})};
    BlockSparseBuilder builder(layout.count(), std::vector<float>(64, 1.0f));
    for (std::size_t row = 0; row < 64; ++row) builder.add(row, row, ColourBlock::Identity());
    const TransportMatrix own(Rasters(Size{8, 8}), Rasters(Size{8, 8}), builder.build());
    QVERIFY(shared(own) == own);
    const TransportMatrix once = shared(made(scenes()[1]));
    QVERIFY(shared(once) == once);
  }

  void sameBitsForEveryNumberOfThreads() {
    const TransportMatrix flat = made(scenes()[6]), many = shared(flat);
    const CameraStack c(randomStack(3 * many.cameras().count(), 7));
    const ProjectorStack back = many.applyTransposed(c);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    QVERIFY(shared(flat) == many);
    QVERIFY(many.applyTransposed(c) == back);
  }

  void filteredRowByRow_data() { addScenes(); }
  /// Of every row what is kept of all that it sees, in the same bits.
  void filteredRowByRow() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    auto stays = [](std::size_t row, std::uint32_t column) { return (row + column) % 3 != 0; };
    const TransportMatrix few =
        t.filtered([&](std::size_t row, const LeafRow& leaves, std::vector<std::uint8_t>& keep) {
          for (std::size_t i = 0; i < leaves.size(); ++i) keep[i] = stays(row, leaves.column(i));
        });
    for (std::size_t row = 0; row < t.cameras().count(); ++row) {
      const LeafRow all = t.row(row), left = few.row(row);
      std::size_t next = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!stays(row, all.column(i))) continue;
        QVERIFY(next < left.size() && left.column(next) == all.column(i));
        QVERIFY(left.block(next) == all.block(i));
        ++next;
      }
      QCOMPARE(next, left.size());
    }
  }

  /// A threshold that cuts nothing leaves groups as they are; one that cuts keeps what is bright.
  void thresholds() {
    const TransportMatrix t = shared(made(scenes()[1]));
    QVERIFY(!thresholded(t, {}, t.floodlight()).groups().empty());
    ThresholdSettings cut;
    cut.shareOfRowMax = 0.5f;
    const TransportMatrix bright = thresholded(t, cut, t.floodlight());
    QVERIFY(bright.groups().empty());
    QCOMPARE(statisticsOf(t, cut).leaves, static_cast<std::uint64_t>(bright.storedLeaves()));
    QVERIFY(mostApart(bright.floodlight(), t.floodlight()) <= 1e-4f * largestOf(t.floodlight()));
  }

  /// Law: a cut that drops nothing takes no more memory; what is left of others takes no more than if nothing
  /// had been shared, and what is announced of memory is what it takes.
  void whatIsCutStaysShared_data() { addScenes(); }
  void whatIsCutStaysShared() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    const auto bytesOf = [&](const TransportMatrix& of, const ThresholdSettings& cut) {
      return thresholded(of, cut, t.floodlight()).bytes();
    };
    ThresholdSettings nothing, some;
    nothing.absolute = std::numeric_limits<float>::min();
    QCOMPARE(bytesOf(t, nothing), t.bytes());
    for (const double energyKept : {0.999, 0.99, 0.9, 0.5}) {
      some.energyKept = energyKept;
      QCOMPARE(static_cast<std::uint64_t>(bytesOf(t, some)), statisticsOf(t, some).bytes);
      const std::size_t groups =
          t.groups().bytes() - t.groups().leaves().blocks() * t.groups().leaves().bytesOfBlock();
      QVERIFY(bytesOf(t, some) <= bytesOf(t.flattened(), some) + groups);
    }
  }

  /// What sees nothing is not given its neighbours' leaves, and noise keeps its sum.
  void whatIsDarkStaysDark() {
    const TransportMatrix bright = made(scenes()[1]);
    const TransportMatrix flat =
        bright.filtered([](std::size_t row, const LeafRow&, std::vector<std::uint8_t>& keep) {
          keep.assign(keep.size(), row % 5 != 0);
        });
    const TransportMatrix t = shared(flat);
    for (std::size_t row = 0; row < t.cameras().count(); ++row)
      QCOMPARE(t.row(row).size() == 0, row % 5 == 0);
    const TransportMatrix noise = made(scenes()[7]);
    const CameraStack before = noise.floodlight(), after = shared(noise).floodlight();
    QVERIFY(mostApart(before, after) <= 1e-3f * largestOf(before));
  }

  /// Pixels that leave their groups see what they have for themselves alone.
  void pixelsLeaveGroups() {
    const TransportMatrix t = shared(made(scenes()[0]));
    CameraMask out(t.cameras().count(), 0);
    out[3] = 1;
    const TransportMatrix without(t.cameras(), t.projectors(), t.ownLeaves(), t.groups().without(out));
    QCOMPARE(without.row(3).size(), t.ownLeaves().columnsOf(3).size());
    QCOMPARE(without.row(4).size(), t.row(4).size());
    QVERIFY(t.row(3).size() > without.row(3).size());
  }

  /// Law: a row's leaves are its few colours times their factors; its sum is that of its leaves.
  void blocksAreColoursTimesFactors_data() { addScenes(); }
  void blocksAreColoursTimesFactors() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    for (const TransportMatrix& matrix : {t, t.flattened()}) {
      const std::vector<ColourBlock> sums = matrix.rowSums();
      for (std::size_t row = 0; row < sums.size(); ++row) {
        const LeafRow leaves = matrix.row(row);
        std::size_t visited = 0;
        ColourBlock sum = ColourBlock::Zero();
        float magnitudes = 0.0f;
        leaves.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
          QCOMPARE(entry, visited++);
          QVERIFY(leaves.colours(k) * factor.matrix().asDiagonal() == leaves.block(entry));
          sum += leaves.block(entry);
          magnitudes += leaves.block(entry).cwiseAbs().maxCoeff();
        });
        QCOMPARE(visited, leaves.size());
        QVERIFY((sums[row] - sum).cwiseAbs().maxCoeff() <= 1e-5f * magnitudes);  // single precision
      }
    }
  }

  /// Law: rows differ by what they are, however they are held.
  void rowsDifferHoweverTheyAreHeld_data() { addScenes(); }
  void rowsDifferHoweverTheyAreHeld() {
    QFETCH(int, scene);
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    const CameraMask none(t.cameras().count(), 0);
    QVERIFY(differingRows(t, t) == none);
    CameraMask one = none, expected = none;
    one[2] = 1;
    const TransportMatrix without(t.cameras(), t.projectors(), t.ownLeaves(), t.groups().without(one));
    expected[2] = without.row(2).size() == t.row(2).size() ? 0 : 1;
    QVERIFY(differingRows(without, t) == expected);
    Stack factor(3 * none.size(), 1.0f);
    factor[3 * 5 + 1] = 0.99f;
    expected = none;
    expected[5] = t.rowSums()[5].isZero(0.0f) ? 0 : 1;
    const TransportMatrix scaled(t.cameras(), t.projectors(), t.ownLeaves().withRowsScaled(factor),
                                 t.groups());
    QVERIFY(differingRows(scaled, t) == expected);
  }

  void files_data() { addScenes(); }
  /// To the same bits as codes; as numbers every row is whole, for programs that know no groups.
  void files() {
    QFETCH(int, scene);
    QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("t.npz").toStdString();
    const TransportMatrix t = shared(made(scenes()[static_cast<std::size_t>(scene)]));
    saveTransport(path, t, StoredValues::codes);
    QVERIFY(loadTransport(path) == t);
    saveTransport(path, t);
    const TransportMatrix whole = loadTransport(path);
    QVERIFY(whole.groups().empty());
    QVERIFY(difference(whole, t).frobenius < 1e-4);
  }

  /// A T of one projector is read in its own shares, alike to the bit within a group.
  void rowsInTheirOwnShares() {
    const TransportMatrix t = shared(made(scenes()[1]));
    const std::vector<ColourBlock> sums = t.rowSums();
    for (std::size_t row = 0; row < t.cameras().count(); ++row) {
      const RowLight light = rowLightAsShared(t, row);
      ColourBlock sum = ColourBlock::Zero();
      for (const LightPart* part : {&light.near, &light.far})
        for (const NodeShare& leaf : part->leaves)
          sum += part->mixing * Eigen::Vector3f(leaf.share[0], leaf.share[1], leaf.share[2]).asDiagonal();
      QVERIFY((sum - sums[row]).cwiseAbs().maxCoeff() <= 1e-4f * sums[row].cwiseAbs().maxCoeff());
    }
  }
};

QTEST_GUILESS_MAIN(TestLeafSharing)
#include "test_leaf_sharing.moc"
