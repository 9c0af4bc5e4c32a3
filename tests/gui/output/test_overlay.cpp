// SPDX-License-Identifier: MIT
#include <QtTest>

#include "output/overlay.h"

using namespace relucent;
using namespace relucent::gui;

class TestOverlay : public QObject {
  Q_OBJECT

 private slots:
  void tellsRateTimeAndWhatIsOutOfReach() {
    QString text = overlayLines({{29.97, 0.0123, 0.045, 2, 4000, 3}, true, false, std::nullopt}).join('\n');
    for (const char* part :
         {"30.0 frames a second", "12.3 ms", "3 of 4000 late", "4.5 % out of reach", "2 step"})
      QVERIFY2(text.contains(part), qPrintable(text));
    QVERIFY(!text.contains("frozen") && !text.contains("chart"));
  }

  void aStillPictureHasNoRate() {
    QString text = overlayLines({{0.0, 0.0123, 0.045, 2, 7, 0}, true, false, std::nullopt}).join('\n');
    QVERIFY2(text.contains("still picture") && !text.contains("a second"), qPrintable(text));
    QVERIFY2(text.contains("4.5 % out of reach"), qPrintable(text));
  }

  void tellsWhatWasSwitched() {
    QString text = overlayLines({{}, false, true, TestChart::ramps}).join('\n');
    QVERIFY(text.contains("not compensated") && text.contains("frozen") && text.contains("ramps"));
  }

  /// It hides as little as it can of the picture, on every projector.
  void staysInItsCorner_data() {
    QTest::addColumn<QSize>("size");
    for (QSize size : {QSize(16, 12), QSize(128, 96), QSize(1024, 768), QSize(3840, 2160)})
      QTest::addRow("%dx%d", size.width(), size.height()) << size;
  }
  void staysInItsCorner() {
    QFETCH(QSize, size);
    QImage picture(size, QImage::Format_RGBX8888);
    picture.fill(qRgb(10, 200, 30));
    QImage before = picture;
    drawOverlay(picture, overlayLines({}));
    QVERIFY(picture != before);
    if (size.height() < 700) return;
    QRect lower(0, size.height() / 5, size.width(), size.height() - size.height() / 5);
    QVERIFY(picture.copy(lower) == before.copy(lower));
  }
};

QTEST_MAIN(TestOverlay)
#include "test_overlay.moc"
