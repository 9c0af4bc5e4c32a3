// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>

#include "content/playlist.h"
#include "content/test_chart.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

class TestCharts : public QObject {
  Q_OBJECT

 private slots:
  void everyChartFillsEverySize_data() {
    QTest::addColumn<QSize>("size");
    for (QSize size :
         {QSize(1, 1), QSize(8, 8), QSize(37, 23), QSize(23, 37), QSize(640, 1), QSize(1920, 1080)})
      QTest::addRow("%dx%d", size.width(), size.height()) << size;
  }
  void everyChartFillsEverySize() {
    QFETCH(QSize, size);
    for (TestChart chart : allTestCharts) {
      QImage picture = drawn(chart, size);
      QCOMPARE(picture.size(), size);
      QCOMPARE(picture.format(), QImage::Format_RGBX8888);
      for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x) QCOMPARE(picture.constScanLine(y)[4 * x + 3], uchar{255});
    }
  }

  void namesNameOne() {
    for (TestChart chart : allTestCharts) QVERIFY(testChartFromName(testChartName(chart)) == chart);
    QVERIFY(!testChartFromName("") && !testChartFromName("Grid"));
  }

  /// What an installer reads from it: the edge of the picture, and that squares are square.
  void gridShowsBorderAndSquares() {
    QImage grid = drawn(TestChart::grid, {320, 180});
    for (int x = 0; x < 320; ++x) QVERIFY(qRed(grid.pixel(x, 0)) == 255 && qRed(grid.pixel(x, 179)) == 255);
    for (int y = 0; y < 180; ++y) QVERIFY(qRed(grid.pixel(0, y)) == 255 && qRed(grid.pixel(319, y)) == 255);
    for (int x = 0; x < 320; x += 20) QCOMPARE(qRed(grid.pixel(x, 50)), 255);
    for (int y = 0; y < 180; y += 20) QCOMPARE(qRed(grid.pixel(30, y)), 255);
    QCOMPARE(qRed(grid.pixel(30, 50)), 0);
    for (int x = 1; x < 160; ++x)  // the circle and the diagonals, which both mirror
      if (x % 20 != 0 && (319 - x) % 20 != 0) QCOMPARE(grid.pixel(x, 30), grid.pixel(319 - x, 30));
  }

  void rampsHoldEveryCodeInOrder() {
    QImage ramps = drawn(TestChart::ramps, {256, 50});
    for (int x = 0; x < 256; ++x) {
      QCOMPARE(ramps.pixel(x, 5) & 0xffffff, qRgb(x, x, x) & 0xffffff);
      QCOMPARE(ramps.pixel(x, 15) & 0xffffff, qRgb(x, 0, 0) & 0xffffff);
      QCOMPARE(ramps.pixel(x, 25) & 0xffffff, qRgb(0, x, 0) & 0xffffff);
      QCOMPARE(ramps.pixel(x, 35) & 0xffffff, qRgb(0, 0, x) & 0xffffff);
      QCOMPARE(qRed(ramps.pixel(x, 45)), 17 * (x / 16));
    }
  }

  void resolutionHalvesItsLight() {
    QImage lines = drawn(TestChart::resolution, {256, 64});
    for (int field = 0; field < 4; ++field) {
      int lit = 0, changes = 0;
      for (int x = 0; x < 64; ++x) {
        lit += qRed(lines.pixel(64 * field + x, 0)) == 255;
        changes += x > 0 && lines.pixel(64 * field + x, 0) != lines.pixel(64 * field + x - 1, 0);
      }
      QCOMPARE(lit, 32);
      QCOMPARE(changes, (64 >> field) - 1);
    }
  }

  void checkerIsHalfWhiteAndWhiteIsWhite() {
    QImage checker = drawn(TestChart::checker, {320, 160}), white = drawn(TestChart::white, {320, 160});
    int lit = 0;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 320; ++x) {
        lit += qRed(checker.pixel(x, y)) == 255;
        QCOMPARE(white.pixel(x, y) & 0xffffff, 0xffffffu);
      }
    QCOMPARE(lit, 320 * 160 / 2);
  }

  void patchesDiffer() {
    QImage patches = drawn(TestChart::patches, {60, 40});
    QSet<QRgb> colours;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 6; ++column) colours.insert(patches.pixel(10 * column + 5, 10 * row + 5));
    QCOMPARE(colours.size(), 24);
  }

  void playlistsNameThem() {
    QTemporaryDir folder;
    PlaylistSettings settings;
    settings.items.append({"chart:ramps", 5.0});
    savePlaylist(folder.filePath("a.playlist"), settings);
    QVERIFY(readPlaylist(folder.filePath("a.playlist")) == settings);
    Canvas canvas{{32, 20}, Fit::fill};
    ContentPicture shown = openContent(settings.items[0], canvas)->at({});
    QVERIFY(shown.image == drawn(TestChart::ramps, canvas.size) && shown.number > 0);
    QVERIFY(
        mentions(sentenceOf([&] { openContent({"chart:gird"}, canvas); }, ErrorKind::input), "grid, ramps"));
  }
};

QTEST_GUILESS_MAIN(TestCharts)
#include "test_charts.moc"
