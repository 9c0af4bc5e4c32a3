// SPDX-License-Identifier: MIT
// Where content stands once a camera's view has moved.
#include "relucent/pipeline/moved_content.h"

#include <QtTest>
#include <cmath>

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::pipeline;
using sentinels::Movement;

namespace {

constexpr Size view{40, 30}, second{64, 48};

/// Of two cameras that see nothing: what was placed by hand needs no more.
MeasuredVenue dark() {
  MeasuredVenue venue;
  const Rasters cameras({view, second});
  const Rasters projectors({Size{8, 6}});
  transport::BlockSparseBuilder builder(transport::NodeLayout(projectors).count(),
                                        std::vector<float>(cameras.count(), 1.0f));
  venue.transport = transport::TransportMatrix(cameras, projectors, builder.build());
  venue.usable.assign(cameras.count(), 0);
  return venue;
}

double apart(const Corners& a, const Corners& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]));
  return most;
}

const Corners placed{{{8, 7}, {30, 6}, {31, 22}, {7, 23}}};

}  // namespace

class TestMovedContent : public QObject {
  Q_OBJECT

 private slots:
  void cornersMove_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("degrees");
    QTest::newRow("not at all") << 0.0 << 0.0 << 0.0;
    QTest::newRow("sideways") << 3.5 << 0.0 << 0.0;
    QTest::newRow("up") << 0.0 << -2.25 << 0.0;
    QTest::newRow("turned") << 0.0 << 0.0 << 2.0;
    QTest::newRow("all of it") << -1.5 << 0.75 << -1.0;
  }
  void cornersMove() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    const Movement moved{x, y, degrees};
    const Corners there = movedCorners(placed, moved, view);
    // A rigid movement: distances stay, and the view's centre goes by x and y.
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < i; ++k)
        QVERIFY(std::abs(std::hypot(there[i][0] - there[k][0], there[i][1] - there[k][1]) -
                         std::hypot(placed[i][0] - placed[k][0], placed[i][1] - placed[k][1])) < 1e-9);
    const Corners centre{{{20, 15}, {20, 15}, {20, 15}, {20, 15}}};
    QVERIFY(apart(movedCorners(centre, moved, view),
                  {{{20 + x, 15 + y}, {20 + x, 15 + y}, {20 + x, 15 + y}, {20 + x, 15 + y}}}) < 1e-9);
    if (degrees > 0.0) {  // from x to y
      const Corners right{{{30, 15}, {30, 15}, {30, 15}, {30, 15}}};
      QVERIFY(movedCorners(right, moved, view)[0][1] > 15 + y);
    }
  }

  void whatWasPlacedByHandGoesWithItsView() {
    ContentSettings content;
    content.corners = placed;
    content.views.resize(2);
    content.views[1].placement = ViewPlacement::own;
    content.views[1].corners = placed;
    content.masks = {{0, Outline::lines, {{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.75}}},
                     {1, Outline::lines, {{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.75}}}};
    const std::vector<Movement> moved{{2.0, -1.0, 0.0}, {-3.2, 0.0, 0.0}};
    const ContentSettings there = movedContent(content, 4.0 / 3.0, dark(), dark(), moved);
    QVERIFY(apart(*there.corners, movedCorners(placed, moved[0], view)) < 1e-9);
    QVERIFY(apart(*there.views[1].corners, movedCorners(placed, moved[1], second)) < 1e-9);
    QCOMPARE(there.masks[0].points[0], (std::array{0.25 + 2.0 / 40, 0.5 - 1.0 / 30}));
    QCOMPARE(there.masks[1].points[2], (std::array{0.5 - 3.2 / 64, 0.75}));
    const std::vector<Movement> back{{-2.0, 1.0, 0.0}, {3.2, 0.0, 0.0}}, none(2);
    QVERIFY(apart(*movedContent(there, 1.0, dark(), dark(), back).corners, placed) < 1e-9);
    QVERIFY(movedContent(content, 1.0, dark(), dark(), none) == content);
  }

  void itIsHeldWithinTheView() {
    ContentSettings content;
    content.corners = placed;
    content.masks = {{0, Outline::lines, {{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.75}}}};
    for (const double x : {-12.0, 12.0}) {
      const ContentSettings there = movedContent(content, 1.0, dark(), dark(), {{x, 0.0, 0.0}, {}});
      QVERIFY(there.corners.has_value());
      for (const auto& [cornerX, cornerY] : *there.corners) QVERIFY(cornerX >= 0.0 && cornerX <= view.width);
      QVERIFY(problems(there).empty());
    }
    // Nothing of it is left: nobody knows where it would stand, and nothing that was dark is lit.
    const ContentSettings gone = movedContent(content, 1.0, dark(), dark(), {{60.0, 0.0, 0.0}, {}});
    QVERIFY(!gone.corners);
    QVERIFY(gone.masks == content.masks);
  }
};

QTEST_GUILESS_MAIN(TestMovedContent)
#include "test_moved_content.moc"
