// SPDX-License-Identifier: MIT
// Venues to rehearse in: as many beside each other as have room.
#include <QScrollBar>
#include <QtTest>
#include <algorithm>
#include <set>

#include "gui/wizard/simulated_session.h"
#include "wizard/frame/stage_scroll.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"
#include "wizard/venue/venue_view.h"

using namespace relucent;
using namespace relucent::gui;

class TestRehearseView : public QObject {
  Q_OBJECT

 private slots:
  /// Law: nobody scrolls across, whatever the width; no tile is cut, and none covers another.
  void nobodyScrollsAcross_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("across");
    QTest::newRow("half of Full HD") << 508 << 2;
    QTest::newRow("a laptop's") << 758 << 3;
    QTest::newRow("Full HD") << 1240 << 4;
    QTest::newRow("hardly more than a name") << 240 << 1;
  }
  void nobodyScrollsAcross() {
    QFETCH(int, width);
    QFETCH(int, across);
    SimulatedSession own;
    VenuePage page(own.session, RecentVenues(own.settings));
    page.setMode(VenuePage::Mode::rehearse);
    // Beside the page's other stages, which may be wider.
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> inspector(view.inspector);
    const std::unique_ptr<QScrollArea> scroll(stageScroll(view.stage));
    scroll->resize(width, 560);
    scroll->show();
    QList<Tile*> tiles;
    for (const RehearsalVenue& venue : page.venues())
      tiles << scroll->findChild<Tile*>("venue-" + QString::fromStdString(venue.id));
    QCOMPARE(static_cast<std::size_t>(tiles.size()), page.venues().size());
    const auto columns = [&tiles] {
      std::set<int> lefts;
      for (const Tile* tile : tiles) lefts.insert(tile->x());
      return static_cast<int>(lefts.size());
    };
    QTRY_VERIFY(scroll->horizontalScrollBar()->maximum() == 0 && columns() == across);
    QTRY_VERIFY(std::ranges::all_of(tiles, [](const Tile* tile) {
      return tile->width() >= tile->minimumSizeHint().width() &&
             tile->height() >= tile->heightForWidth(tile->width());
    }));
    // Equally wide, as far as whole pixels go.
    const auto [narrowest, widest] = std::ranges::minmax(tiles, {}, &QWidget::width);
    QVERIFY(widest->width() - narrowest->width() <= 1);
    for (const Tile* tile : tiles)
      for (const Tile* other : tiles)
        QVERIFY(tile == other || !tile->geometry().intersects(other->geometry()));
  }
};

QTEST_MAIN(TestRehearseView)
#include "test_rehearse_view.moc"
