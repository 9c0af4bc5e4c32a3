// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "desktop/exact_crop.h"
#include "desktop/platform_choice.h"

using namespace relucent::gui;

class TestExactCrop : public QObject {
  Q_OBJECT

 private slots:
  void theScaleOfAnOutputIsFound_data() {
    QTest::addColumn<QSize>("mode");
    QTest::addColumn<double>("scale");
    for (QSize mode :
         {QSize(1024, 768), QSize(1366, 768), QSize(1920, 1080), QSize(1920, 1200), QSize(3840, 2160)})
      for (double scale : {1.0, 1.25, 1.5, 1.75, 1.6, 2.0, 2.25, 2.5, 3.0})
        QTest::addRow("%dx%d at %g", mode.width(), mode.height(), scale) << mode << scale;
  }
  /// However the desktop rounds.
  void theScaleOfAnOutputIsFound() {
    QFETCH(QSize, mode);
    QFETCH(double, scale);
    const QSizeF whole = QSizeF(mode) / scale;
    const QSize down(static_cast<int>(whole.width()), static_cast<int>(whole.height()));
    const QSize up(static_cast<int>(std::ceil(whole.width())), static_cast<int>(std::ceil(whole.height())));
    for (QSize logical : {down, whole.toSize(), up}) {
      QVERIFY(scaleOf(mode, logical).has_value());
      QCOMPARE(*scaleOf(mode, logical), scale);
    }
  }

  void aCropCoversTheOutputAndIsOfWholePixels_data() { theScaleOfAnOutputIsFound_data(); }
  void aCropCoversTheOutputAndIsOfWholePixels() {
    QFETCH(QSize, mode);
    QFETCH(double, scale);
    const QSize logical = (QSizeF(mode) / scale).toSize();
    const QSize drawn = logical * static_cast<int>(std::ceil(scale));
    const std::optional<ExactCrop> crop = exactCrop(mode, logical, drawn);
    if (!crop) {
      // Only where as many as fit are less than the output has: whole scales that do not divide it.
      QVERIFY(drawn.width() < mode.width() + scale || drawn.height() < mode.height() + scale);
      return;
    }
    for (bool upright : {false, true}) {
      auto length = [&](QSize size) { return upright ? size.height() : size.width(); };
      QVERIFY(length(crop->pixels) >= length(mode) && length(crop->pixels) <= length(drawn));
      QVERIFY(length(crop->pixels) < length(mode) + scale + 1.0);
      QCOMPARE(length(crop->pixels), static_cast<int>(std::lround(length(crop->place) * scale)));
    }
  }

  void lengthsThatNoScaleExplainsHaveNone() {
    QVERIFY(!scaleOf({1024, 768}, {1024, 400}));
    QVERIFY(!exactCrop({1024, 768}, {1024, 400}, {1024, 400}));
    QVERIFY(!scaleOf({}, {1024, 768}));
    QVERIFY(!scaleOf({1024, 768}, {}));
  }

  /// Half a pixel would be missing.
  void lessThanTheOutputIsNoCrop() { QVERIFY(!exactCrop({1279, 719}, {639, 359}, {1278, 718})); }

  void waylandIsTakenWhereThereIsOne() {
    QCOMPARE(platformChoice("", "wayland-0"), QByteArray("wayland;xcb"));
    QCOMPARE(platformChoice("", ""), QByteArray());
    QCOMPARE(platformChoice("xcb", "wayland-0"), QByteArray("xcb"));
    QCOMPARE(platformChoice("offscreen", ""), QByteArray("offscreen"));
  }
};

QTEST_MAIN(TestExactCrop)
#include "test_exact_crop.moc"
