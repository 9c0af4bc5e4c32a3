// SPDX-License-Identifier: MIT
// Controls in languages that are read from the right.
#include <QApplication>
#include <QPushButton>
#include <QSlider>
#include <QtTest>
#include <algorithm>

#include "theme/theme.h"

using namespace relucent::gui;

namespace {

/// Columns of pixels.
struct Span {
  int first = 1 << 20, last = -1;
  bool isEmpty() const { return last < first; }
  void add(int x) {
    first = std::min(first, x);
    last = std::max(last, x);
  }
};

}  // namespace

class TestReadingDirection : public QObject {
  Q_OBJECT

 private slots:
  static void directions() {
    QTest::addColumn<Qt::LayoutDirection>("direction");
    QTest::newRow("from the left") << Qt::LeftToRight;
    QTest::newRow("from the right") << Qt::RightToLeft;
  }
  void anIconStandsBeforeItsWords_data() { directions(); }
  void anIconStandsBeforeItsWords() {
    QFETCH(Qt::LayoutDirection, direction);
    QGuiApplication::setLayoutDirection(direction);
    Theme::instance().apply(Look::dark);
    QPixmap mark(18, 18);
    mark.fill(Qt::red);
    QPushButton button(QIcon(mark), "Words");
    button.setIconSize({18, 18});
    button.resize(400, 40);
    const QImage seen = button.grab().toImage();
    Span icon, words;
    for (int y = 8; y < seen.height() - 8; ++y)
      for (int x = 4; x < seen.width() - 4; ++x) {
        const QColor colour = seen.pixelColor(x, y);
        if (colour == QColor(Qt::red))
          icon.add(x);
        else if (colour.lightness() > 150)
          words.add(x);
      }
    QVERIFY(!icon.isEmpty() && !words.isEmpty());
    const int gap = direction == Qt::LeftToRight ? words.first - icon.last : icon.first - words.last;
    QVERIFY2(gap > 0 && gap <= 12, QByteArray::number(gap));
    const int middle = (std::min(icon.first, words.first) + std::max(icon.last, words.last)) / 2;
    QVERIFY2(std::abs(middle - 200) < 6, QByteArray::number(middle));
  }

  void aSliderIsFilledFromWhereItsValuesBegin_data() { directions(); }
  void aSliderIsFilledFromWhereItsValuesBegin() {
    QFETCH(Qt::LayoutDirection, direction);
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    Theme::instance().apply(Look::dark);
    // The style sheet is not made anew for another language.
    QGuiApplication::setLayoutDirection(direction);
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
