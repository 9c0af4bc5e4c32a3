// SPDX-License-Identifier: MIT
#include "views/cut_histogram.h"

#include <QtTest>

using namespace relucent::gui;

class TestCutHistogram : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the cut's text is whole wherever the cut is and however narrow the chart, as long as it has room at
  /// all; with room beside the cut it leaves the cut in sight.
  void theCutsTextIsWhole_data() {
    QTest::addColumn<int>("width");
    for (int width : {240, 330, 380, 700, 1300}) QTest::addRow("%d px", width) << width;
  }
  void theCutsTextIsWhole() {
    QFETCH(int, width);
    CutHistogram histogram({1e-8, 100.0, true, {}}, "Verbindungen");
    histogram.setBars({{1e-8, 1e-4, 10.0, {}}, {1e-4, 100.0, 20.0, {}}});
    histogram.setCutText("Schnitt bei 3,2, hält 98 %");
    histogram.resize(width, 180);
    for (double cut : {1e-8, 1e-6, 3e-4, 1e-2, 1.0, 100.0}) {
      histogram.setCut(cut);
      histogram.grab();
      const QRectF tag = histogram.cutTag();
      QVERIFY2(tag.left() >= 0.0 && tag.right() <= width,
               qPrintable(QString("%1: %2 to %3").arg(cut).arg(tag.left()).arg(tag.right())));
    }
  }
};

QTEST_MAIN(TestCutHistogram)
#include "test_cut_histogram.moc"
