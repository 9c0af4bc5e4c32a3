// SPDX-License-Identifier: MIT
#include "relucent/compensation/uncorrectable.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Progress quiet;

constexpr Size view{40, 30};

/// A flat white wall, a projector pixel for every camera pixel, and a target of half its light. Tests put
/// what they are about into `blocks`, per camera pixel {node, light}.
struct Wall {
  NodeLayout layout{Rasters(view)};
  std::vector<std::vector<std::pair<Node, float>>> blocks;
  Target target;
  CameraStack black = CameraStack(3 * view.count(), 0.01f);
  CameraMask usable = CameraMask(view.count(), 1);

  Wall() : blocks(view.count()) {
    for (std::size_t i = 0; i < view.count(); ++i) {
      Pixel pixel = pixelAt(view, i);
      blocks[i] = {{{0, 0, pixel.x, pixel.y}, 1.0f}};
    }
    target.wanted.assign(3 * view.count(), 0.5f);
    target.inside.assign(view.count(), 1);
  }

  MeasuredVenue venue() const {
    BlockSparseBuilder builder(layout.count(), std::vector<float>(view.count(), 10.0f));
    for (std::size_t i = 0; i < blocks.size(); ++i)
      for (const auto& [node, light] : blocks[i])
        builder.add(i, layout.index(node), (light * ColourBlock::Identity()).eval());
    TransportMatrix transport(view, view, builder.build());
    CameraStack flood = transport.floodlight();
    return {std::move(transport), black, std::move(flood), usable};
  }
  std::vector<Uncorrectable> map() const { return uncorrectableMap(venue(), target, {}, quiet); }
};

std::size_t at(int x, int y) {
  return indexOf(view, {x, y});
}

std::size_t countOf(const std::vector<Uncorrectable>& map, Uncorrectable reason) {
  return static_cast<std::size_t>(std::count(map.begin(), map.end(), reason));
}

}  // namespace

class TestUncorrectable : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what is reachable, too dark and too bright are the whole content, whatever else is the matter.
  void reachableTooDarkAndTooBrightAreTheWhole() {
    Wall wall;
    wall.target.reachable.assign(view.count(), 1);
    const auto wants = [&wall](std::size_t first, std::size_t count, float light) {
      for (std::size_t i = first; i < first + count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) wall.target.wanted[3 * i + c] = light;
        wall.target.reachable[i] = 0;
      }
    };
    wants(0, 120, 5.0f);   // beyond full light
    wants(300, 60, 0.0f);  // below black
    wall.usable[700] = 0;  // lit by nobody
    wall.target.reachable[700] = 0;
    for (std::size_t i = 1100; i < view.count(); ++i) wall.target.inside[i] = wall.target.reachable[i] = 0;
    const UnreachableShares shares = unreachableShares(wall.venue(), wall.target);
    QCOMPARE(shares.tooDark, 121.0 / 1100.0);
    QCOMPARE(shares.tooBright, 60.0 / 1100.0);
  }

  void aPlainWallCanBeCorrected() { QCOMPARE(countOf(Wall().map(), Uncorrectable::none), view.count()); }

  void everyReasonIsFound() {
    Wall wall;
    wall.target.inside[at(1, 1)] = 0;
    wall.usable[at(3, 3)] = 0;
    wall.blocks[at(6, 6)] = {{{0, 5, 0, 0}, 2.0f}};  // light from 32x32 pixels at once
    for (std::size_t c = 0; c < 3; ++c) {
      wall.target.wanted[3 * at(9, 9) + c] = 1.5f;
      wall.target.wanted[3 * at(12, 12) + c] = 0.005f;
    }
    std::vector<Uncorrectable> map = wall.map();
    QVERIFY(map[at(1, 1)] == Uncorrectable::outside);
    QVERIFY(map[at(3, 3)] == Uncorrectable::unlit);
    QVERIFY(map[at(6, 6)] == Uncorrectable::shadowed);
    QVERIFY(map[at(9, 9)] == Uncorrectable::tooDark);
    QVERIFY(map[at(12, 12)] == Uncorrectable::tooBright);
    QCOMPARE(countOf(map, Uncorrectable::none), view.count() - 5);
    auto shares = sharesOf(map);
    QVERIFY(std::abs(shares[static_cast<std::size_t>(Uncorrectable::tooDark)] - 1.0 / 1199.0) < 1e-12);
    double sum = 0.0;
    for (double share : shares) sum += share;
    QVERIFY(std::abs(sum - 1.0) < 1e-12);
  }

  void secondViews_data() {
    QTest::addColumn<int>("x");
    QTest::addColumn<float>("light");
    QTest::addColumn<bool>("twice");
    QTest::addColumn<bool>("firstToo");
    // At (20, 15) the wall shows projector pixel (20, 15); the camera pixel at x shows it as well.
    QTest::newRow("a mirror's image") << 35 << 0.8f << true << true;
    QTest::newRow("a faint image") << 35 << 0.2f << true << false;
    QTest::newRow("beside it: defocus") << 22 << 0.8f << false << false;
    QTest::newRow("brighter than the wall") << 35 << 2.0f << true << true;
  }
  void secondViews() {
    QFETCH(int, x);
    QFETCH(float, light);
    QFETCH(bool, twice);
    QFETCH(bool, firstToo);
    Wall wall;
    wall.blocks[at(x, 15)] = {{{0, 0, 20, 15}, light}};
    std::fill(wall.target.wanted.begin(), wall.target.wanted.end(), 0.1f);
    std::vector<Uncorrectable> map = wall.map();
    // Whoever shows the pixel more brightly owns it: the other one is seen twice whatever its light.
    bool wallIsFainter = light > 1.0f;
    std::size_t second = wallIsFainter ? at(20, 15) : at(x, 15),
                first = wallIsFainter ? at(x, 15) : at(20, 15);
    QCOMPARE(map[second] == Uncorrectable::seenTwice, twice);
    QCOMPARE(map[first] == Uncorrectable::seenTwice, firstToo);
  }

  void scenesAreMostlyCorrectable() {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SceneSettings s;
      s.seed = seed;
      Scene scene = makeScene(s);
      MeasuredVenue venue{scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
      Target target = fitTarget(Image({40, 30}, 3, 0.5f), venue, {});
      auto shares = sharesOf(uncorrectableMap(venue, target, {}, quiet));
      // A made-up wall without shadows or mirrors.
      QVERIFY(shares[static_cast<std::size_t>(Uncorrectable::seenTwice)] < 0.02);
      QVERIFY(shares[static_cast<std::size_t>(Uncorrectable::shadowed)] < 0.02);
      QVERIFY(shares[static_cast<std::size_t>(Uncorrectable::none)] > 0.7);
    }
  }

  void nothingLitIsUnlit() {
    Wall wall;
    for (auto& blocks : wall.blocks) blocks.clear();
    QCOMPARE(countOf(wall.map(), Uncorrectable::shadowed), view.count());
    wall.usable.assign(view.count(), 0);
    QCOMPARE(countOf(wall.map(), Uncorrectable::unlit), view.count());
    wall.target.inside.assign(view.count(), 0);
    QCOMPARE(sharesOf(wall.map())[0], 0.0);
  }

  void whatIsNoNumberCannotBeShown() {
    Wall wall;
    wall.target.wanted[3 * at(5, 5)] = std::nanf("");
    QVERIFY(wall.map()[at(5, 5)] == Uncorrectable::tooDark);
  }

  void checksSettings() {
    QVERIFY(problems(UncorrectableSettings{}).empty());
    QCOMPARE(problems(UncorrectableSettings{{0.0}, -1.0, 2.0, std::nan("")}).size(), std::size_t{4});
    for (Uncorrectable reason : allReasons) QVERIFY(!nameOf(reason).empty());
  }
};

QTEST_APPLESS_MAIN(TestUncorrectable)
#include "test_uncorrectable.moc"
