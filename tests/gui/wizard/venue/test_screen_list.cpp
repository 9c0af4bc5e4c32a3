// SPDX-License-Identifier: MIT
// Screens are drawn as they stand beside each other, not as the page has room.
#include "wizard/venue/screen_list.h"

#include <QtTest>

#include "wizard/venue/tile.h"

using namespace relucent;
using namespace relucent::gui;

class TestScreenList : public QObject {
  Q_OBJECT

 private slots:
  void screensAreDrawnToScale_data() {
    QTest::addColumn<std::vector<Size>>("screens");
    QTest::addColumn<QSize>("room");
    QTest::newRow("one") << std::vector<Size>{{1024, 768}} << QSize(700, 400);
    QTest::newRow("laptop and projector") << std::vector<Size>{{1366, 768}, {1024, 768}} << QSize(700, 400);
    QTest::newRow("much room") << std::vector<Size>{{1920, 1080}, {1280, 800}} << QSize(3000, 2000);
    QTest::newRow("three in little room")
        << std::vector<Size>{{3840, 2160}, {1024, 768}, {1080, 1920}} << QSize(400, 300);
    QTest::newRow("low") << std::vector<Size>{{1366, 768}, {1024, 768}} << QSize(700, 90);
  }
  void screensAreDrawnToScale() {
    QFETCH(std::vector<Size>, screens);
    QFETCH(QSize, room);
    constexpr int gap = 16;
    constexpr QSize most(320, 200);
    std::vector<QSize> drawn = drawnToScale(screens, room, gap, most);
    QCOMPARE(drawn.size(), screens.size());
    int across = gap * (static_cast<int>(screens.size()) - 1);
    bool touches = false;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      QVERIFY(drawn[i].height() <= room.height());
      QVERIFY(drawn[i].width() <= most.width() && drawn[i].height() <= most.height());
      across += drawn[i].width();
      touches = touches || drawn[i].width() == most.width() || drawn[i].height() == most.height() ||
                drawn[i].height() == room.height();
      // Sides are rounded down to whole pixels.
      double scale = static_cast<double>(drawn[0].width()) / screens[0].width;
      QVERIFY(std::abs(drawn[i].width() - scale * screens[i].width) <= 2.0);
      QVERIFY(std::abs(drawn[i].height() - scale * screens[i].height) <= 2.0);
    }
    QVERIFY(across <= room.width());
    QVERIFY(touches || room.width() - across <= static_cast<int>(drawn.size()));
  }

  void theListDoesNotStretchThem() {
    ScreenList list([](const ScreenChoice&) {});
    list.resize(900, 600);
    list.show();
    QVERIFY(QTest::qWaitForWindowExposed(&list));
    QList<Tile*> tiles = list.findChildren<Tile*>();
    QVERIFY(!tiles.isEmpty());
    for (const Tile* tile : tiles) {
      QVERIFY2(tile->height() <= 200 && tile->width() <= 320,
               qPrintable(QString("%1 x %2").arg(tile->width()).arg(tile->height())));
      QVERIFY(tile->height() >= tile->heightForWidth(tile->width()));
      QVERIFY(list.rect().contains(tile->geometry()));
    }
  }
};

QTEST_MAIN(TestScreenList)
#include "test_screen_list.moc"
