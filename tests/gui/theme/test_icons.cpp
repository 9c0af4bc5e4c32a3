// SPDX-License-Identifier: MIT
#include "theme/icons.h"

#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

QImage drawn(Icon icon, const QColor& colour) {
  return pixmapOf(icon, colour, 24, 1.0).toImage().convertToFormat(QImage::Format_ARGB32);
}

double inkOf(const QImage& image) {
  double ink = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) ink += qAlpha(image.pixel(x, y)) / 255.0;
  return ink;
}

}  // namespace

class TestIcons : public QObject {
  Q_OBJECT

 private slots:
  /// Law: strokes of the colour asked for, on nothing, as much as a line of 1.6 that is as long as the box at
  /// least (12 * 1.6) and no more than half of the box (288).
  void everyIconIsALineDrawing() {
    for (int i = 0; i <= static_cast<int>(Icon::drift); ++i) {
      const QImage image = drawn(static_cast<Icon>(i), Qt::red);
      const double ink = inkOf(image);
      QVERIFY2(ink > 19.2 && ink < 288.0, qPrintable(QString("icon %1: %2").arg(i).arg(ink)));
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
          if (qAlpha(image.pixel(x, y)) > 128)
            QVERIFY(qRed(image.pixel(x, y)) > 250 && qGreen(image.pixel(x, y)) < 5);
    }
  }

  void aTransparentColourStaysSo() {
    QColor faint(Qt::red);
    faint.setAlphaF(0.5F);
    QVERIFY(qAbs(inkOf(drawn(Icon::power, faint)) / inkOf(drawn(Icon::power, Qt::red)) - 0.5) < 0.02);
  }

  void backPointsBackInBothDirections() {
    const QImage back = drawn(Icon::back, Qt::black), next = drawn(Icon::next, Qt::black);
    QVERIFY(back != next);
    const QImage mirrored = back.mirrored(true, false);
    QVERIFY(qAbs(inkOf(mirrored) - inkOf(next)) < 0.5);
  }
};

QTEST_MAIN(TestIcons)
#include "test_icons.moc"
