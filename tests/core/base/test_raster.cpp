// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/raster.h"

using namespace relucent;

class TestRaster : public QObject {
  Q_OBJECT

 private slots:
  void indexAndPlaceAreInverse() {
    const Size size{7, 5};
    std::size_t expected = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x, ++expected) {
        QCOMPARE(indexOf(size, {x, y}), expected);
        QCOMPARE(pixelAt(size, expected), (Pixel{x, y}));
      }
    QCOMPARE(size.count(), expected);
  }

  void countsDoNotOverflow() { QCOMPARE((Size{100000, 100000}).count(), std::size_t{10000000000}); }

  void emptySizes_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<bool>("empty");
    QTest::newRow("some") << 1 << 1 << false;
    QTest::newRow("no width") << 0 << 3 << true;
    QTest::newRow("negative") << 3 << -1 << true;
  }
  void emptySizes() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(bool, empty);
    const Size size{width, height};
    QCOMPARE(size.empty(), empty);
    if (empty) QVERIFY_THROWS_EXCEPTION(std::logic_error, Rasters{size});
  }

  void devicesFollowEachOther() {
    const Rasters rasters({{4, 3}, {2, 2}, {5, 1}});
    QCOMPARE(rasters.devices(), std::size_t{3});
    QCOMPARE(rasters.offset(0), std::size_t{0});
    for (std::size_t device = 1; device < 3; ++device)
      QCOMPARE(rasters.offset(device), rasters.offset(device - 1) + rasters.size(device - 1).count());
    QCOMPARE(rasters.count(), rasters.offset(2) + rasters.size(2).count());
    QCOMPARE(rasters.size(1), (Size{2, 2}));
    QVERIFY_THROWS_EXCEPTION(std::out_of_range, rasters.size(3));
  }

  void oneDeviceIsARasterOfItsOwn() {
    QCOMPARE(Rasters(Size{4, 3}), Rasters(std::vector<Size>{{4, 3}}));
    QVERIFY(!(Rasters(Size{4, 3}) == Rasters(Size{3, 4})));
    QCOMPARE(Rasters(Size{4, 3}).count(), std::size_t{12});
    QCOMPARE(Rasters().count(), std::size_t{0});
    QCOMPARE(Rasters().devices(), std::size_t{0});
  }
};

QTEST_APPLESS_MAIN(TestRaster)
#include "test_raster.moc"
