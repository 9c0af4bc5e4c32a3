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

  void tellsHowLongAViewerWaits() {
    PlayerStatistics now;
    QVERIFY(!overlayLines({now, true, false, std::nullopt}).join('\n').contains("viewer"));
    now.viewerSeconds = 0.0421;
    const QString text = overlayLines({now, true, false, std::nullopt}).join('\n');
    QVERIFY2(text.contains("viewer within 42.1 ms"), qPrintable(text));
  }

  void tellsHowOldALivePictureIs() {
    PlayerStatistics now;
    QVERIFY(!overlayLines({now, true, false, std::nullopt}).join('\n').contains("live"));
    now.liveSeconds = 0.0333;
    const QString text = overlayLines({now, true, false, std::nullopt}).join('\n');
    QVERIFY2(text.contains("live picture within 33.3 ms"), qPrintable(text));
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
    const QImage overlay = overlayPicture(size, overlayLines({}));
    QVERIFY(!overlay.isNull());
    QVERIFY(overlay.width() <= size.width() && overlay.height() <= size.height());
    if (size.height() < 700) return;
    QVERIFY(overlay.height() <= size.height() / 5);
    bool isLegible = false;
    for (int y = 0; y < overlay.height(); ++y)
      for (int x = 0; x < overlay.width(); ++x) isLegible = isLegible || qGray(overlay.pixel(x, y)) > 120;
    QVERIFY(isLegible);
  }
};

QTEST_MAIN(TestOverlay)
#include "test_overlay.moc"
