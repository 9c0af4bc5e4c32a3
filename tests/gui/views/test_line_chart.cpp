// SPDX-License-Identifier: MIT
#include <QtTest>

#include "theme/theme.h"
#include "views/chart_drawing.h"
#include "views/line_chart.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Pixels that are unlike those of another picture of the same size.
int difference(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  return count;
}

QImage drawn(LineChart& chart) {
  chart.resize(400, 200);
  return chart.grab().toImage();
}

}  // namespace

class TestLineChart : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { Theme::instance().apply(Look::dark); }

  /// Letters of the program's font, whose size is in pixels: dozens of pixels each.
  void textIsLegible() {
    LineChart chart(axisOf(0.0, 255.0, {}), axisOf(0.0, 100.0, {}));
    charts::Curve curve{"", "red", charts::Marker::none, {{0.0, 0.0}, {255.0, 100.0}}};
    chart.setCurves({curve});
    QImage without = drawn(chart);
    curve.name = "Red";
    chart.setCurves({curve});
    int legend = difference(drawn(chart), without);
    QVERIFY2(legend > 60, QByteArray::number(legend));
    chart.setCurves({});
    without = drawn(chart);
    chart.setAxes(axisOf(0.0, 255.0, {}), axisOf(0.0, 77.0, {}));
    QVERIFY(difference(drawn(chart), without) > 60);
  }

  void curvesAreDrawnInTheColoursOfTheTheme() {
    LineChart chart(axisOf(0.0, 1.0, {}), axisOf(0.0, 1.0, {}));
    for (const char* style : {"red", "green", "blue", "accent", "amber", "information"}) {
      chart.setCurves({{"", style, charts::Marker::none, {{0.0, 0.45}, {1.0, 0.45}}}});
      QImage picture = drawn(chart);
      int coloured = 0;
      for (int y = 0; y < picture.height(); ++y)
        coloured += picture.pixelColor(200, y).hslSaturation() > 60 ? 1 : 0;
      QVERIFY2(coloured >= 1 && coloured <= 4, style);
    }
  }

  void aTitleMakesRoom() {
    LineChart narrow(axisOf(0.0, 1.0, {}), axisOf(0.0, 1.0, {}));
    LineChart wide(axisOf(0.0, 1.0, QString(80, QChar('m'))), axisOf(0.0, 1.0, {}));
    QVERIFY(wide.minimumSizeHint().width() > 2 * narrow.minimumSizeHint().width());
  }

  void numbersFollowTheLocale() {
    QLocale before;
    QLocale::setDefault(QLocale(QLocale::German));
    QCOMPARE(tickTextOf({}, {0.25, 2}), QString("0,25"));
    QLocale::setDefault(before);
  }
};

QTEST_MAIN(TestLineChart)
#include "test_line_chart.moc"
