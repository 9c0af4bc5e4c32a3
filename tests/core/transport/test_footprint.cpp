// SPDX-License-Identifier: MIT
#include "relucent/transport/footprint.h"

#include <QtTest>

#include "core/transport/expanded.h"
#include "core/transport/random_blocks.h"

using namespace relucent;
using namespace relucent::transport;

class TestFootprint : public QObject {
  Q_OBJECT

 private slots:
  void itIsTheRowOfT_data() {
    QTest::addColumn<double>("density");
    QTest::newRow("dense") << 0.5;
    QTest::newRow("sparse") << 0.05;
    QTest::newRow("empty") << 0.0;
  }
  void itIsTheRowOfT() {
    QFETCH(double, density);
    Rasters projectors = std::vector<Size>{{11, 6}, {3, 2}};
    NodeLayout layout(projectors);
    TransportMatrix transport(Size{7, 4}, projectors,
                              randomBlocks(28, layout.count(), density, 17, 0.0f).sparse);
    Eigen::MatrixXd dense = expanded(transport);
    Eigen::RowVector3d weights(0.2126, 0.7152, 0.0722);
    for (std::size_t row = 0; row < 28; ++row) {
      PixelFootprint footprint = footprintOf(transport, row, 1e9);
      auto first = static_cast<Eigen::Index>(3 * row);
      double brightest = 0.0;
      for (std::size_t i = 0; i < projectors.count(); ++i) {
        double expectedValue = (weights * dense.block<3, 3>(first, static_cast<Eigen::Index>(3 * i))).sum();
        brightest = std::max(brightest, expectedValue);
        // Single floats, summed over a pyramid of a few levels.
        QVERIFY(std::abs(static_cast<double>(footprint.luminance[i]) - expectedValue) < 1e-5);
      }
      QVERIFY(std::abs(static_cast<double>(footprint.luminance[footprint.strongest]) - brightest) < 1e-5);
      QCOMPARE(footprint.pixels == 0, brightest == 0.0);
    }
  }

  void nearLightIsAShareOfItsOwnProjector() {
    Rasters projectors = std::vector<Size>{{4, 1}, {4, 1}};
    NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), {4.0f});
    builder.add(0, 1, 3.0f * ColourBlock::Identity());
    builder.add(0, 2, ColourBlock::Identity());
    builder.add(0, 5, 4.0f / 2.0f * ColourBlock::Identity());
    TransportMatrix transport(Size{1, 1}, projectors, builder.build());
    PixelFootprint footprint = footprintOf(transport, 0, 1.0);
    QCOMPARE(footprint.strongest, std::size_t{1});
    QCOMPARE(footprint.pixels, std::size_t{3});
    QVERIFY(std::abs(footprint.nearShare - 4.0 / 6.0) < 1e-3);  // 16-bit codes
    QVERIFY(std::abs(footprintOf(transport, 0, 0.0).nearShare - 3.0 / 6.0) < 1e-3);
  }

  void theStrongestPixelIsThatOfOneProjector() {
    const Rasters projectors = std::vector<Size>{{3, 1}, {2, 2}, {2, 1}};
    PixelFootprint footprint;
    footprint.luminance = {0.1f, 0.5f, 0.2f, 0.0f, 0.0f, 0.0f, 0.9f, 0.0f, 0.0f};
    QCOMPARE(strongestPixel(footprint, projectors, 0), std::optional<std::size_t>(1));
    QCOMPARE(strongestPixel(footprint, projectors, 1), std::optional<std::size_t>(3));
    QVERIFY(!strongestPixel(footprint, projectors, 2));  // it does not light the camera's pixel
  }

  void everyPixelIsOfTheDeviceThatItIsCountedIn() {
    const Rasters rasters = std::vector<Size>{{3, 1}, {2, 2}, {2, 1}};
    for (std::size_t device = 0; device < rasters.devices(); ++device)
      for (std::size_t i = 0; i < rasters.size(device).count(); ++i)
        QCOMPARE(deviceOfPixel(rasters, rasters.offset(device) + i), device);
    QVERIFY_EXCEPTION_THROWN(deviceOfPixel(rasters, rasters.count()), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestFootprint)
#include "test_footprint.moc"
