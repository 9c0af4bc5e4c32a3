// SPDX-License-Identifier: MIT
// Controls in languages that are read from the right.
#include <QApplication>
#include <QSlider>
#include <QtTest>

#include "theme/theme.h"

using namespace relucent::gui;

class TestReadingDirection : public QObject {
  Q_OBJECT

 private slots:
  void aSliderIsFilledFromWhereItsValuesBegin_data() {
    QTest::addColumn<Qt::LayoutDirection>("direction");
    QTest::newRow("from the left") << Qt::LeftToRight;
    QTest::newRow("from the right") << Qt::RightToLeft;
  }
  void aSliderIsFilledFromWhereItsValuesBegin() {
    QFETCH(Qt::LayoutDirection, direction);
    QGuiApplication::setLayoutDirection(direction);
    Theme::instance().apply(Look::dark);
    QSlider slider(Qt::Horizontal);
    slider.setRange(0, 100);
    slider.setValue(70);
    slider.resize(200, 32);
    const QImage seen = slider.grab().toImage();
    const auto colourAt = [&](int left) { return seen.pixelColor(left, seen.height() / 2); };
    const bool isMirrored = direction == Qt::RightToLeft;
    QCOMPARE(colourAt(isMirrored ? 180 : 20), colours().accent);
    QCOMPARE(colourAt(isMirrored ? 20 : 180), colours().border);
  }
};

QTEST_MAIN(TestReadingDirection)
#include "test_reading_direction.moc"
