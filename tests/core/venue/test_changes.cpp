// SPDX-License-Identifier: MIT
#include "relucent/venue/changes.h"

#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/sentinels/movement.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::venue;

namespace {

VenueSettings venueWith(const std::string& name, const Changes& changes) {
  VenueSettings settings;
  settings.name = name;
  settings.projector = {64, 48};
  settings.camera = {56, 42};
  settings.pathsPerPixel = 32;
  settings.changes = changes;
  return settings;
}

SimulatedVenue traced(const std::string& name, const Changes& changes = {}) {
  Progress quiet;
  return SimulatedVenue(venueWith(name, changes), {}, quiet);
}

image::Image pictureOf(const CameraStack& light, Size size) {
  image::Image picture(size, 1);
  for (std::size_t i = 0; i < size.count(); ++i)
    picture.data()[i] = light[3 * i] + light[3 * i + 1] + light[3 * i + 2];
  return picture;
}

/// Share of camera pixels whose flood differs by more than a twentieth.
double changedShare(const CameraStack& before, const CameraStack& after) {
  double changed = 0.0;
  for (std::size_t i = 0; i < before.size(); i += 3) {
    const float then = before[i] + before[i + 1] + before[i + 2],
                now = after[i] + after[i + 1] + after[i + 2];
    changed += std::abs(now - then) > 0.05f * std::max(then, 1.0f) ? 1.0 : 0.0;
  }
  return 3.0 * changed / static_cast<double>(before.size());
}

}  // namespace

class TestChanges : public QObject {
  Q_OBJECT

 private slots:
  void whatHasNotChangedIsTheSameBits() {
    Changes nowhere;
    nowhere.painted.push_back({{0.5, 0.5}, 0.0});  // of no size
    const SimulatedVenue before = traced("corner"), after = traced("corner", nowhere);
    // Its units are found anew, from one line.
    const CameraStack then = before.trueTransport().floodlight(), now = after.trueTransport().floodlight();
    for (std::size_t i = 0; i < then.size(); ++i)
      QVERIFY(std::abs(now[i] - then[i]) <= 1e-3f * then[i] + 1e-3f);
    QCOMPARE(changedShare(before.trueBlack(), after.trueBlack()), 0.0);
  }

  void aTurnedCameraSeesItsPictureMove_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("degrees");
    QTest::newRow("right and down") << 2.0 << 1.0 << 0.0;
    QTest::newRow("left and up") << -1.5 << -2.5 << 0.0;
    QTest::newRow("turned") << 0.5 << 0.0 << 2.0;
  }
  /// As far as the perspective of the view allows, and as phase correlation finds it: half a pixel.
  void aTurnedCameraSeesItsPictureMove() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    Changes changes;
    changes.cameras.push_back({0, x, y, degrees});
    const Size size = venueWith("corner", {}).camera;
    const sentinels::Movement found = sentinels::movementBetween(
        {{pictureOf(traced("corner").trueTransport().floodlight(), size),
          pictureOf(traced("corner", changes).trueTransport().floodlight(), size)}});
    QVERIFY2(
        std::abs(found.x - x) < 0.5 && std::abs(found.y - y) < 0.5 && std::abs(found.degrees - degrees) < 0.5,
        qPrintable(QString("%1, %2, %3").arg(found.x).arg(found.y).arg(found.degrees)));
  }

  /// A lamp's and a filter's colours, as the camera's channels see them: each within what neighbouring bands
  /// let through of one another.
  void lightFades_data() {
    QTest::addColumn<bool>("lamps");
    QTest::newRow("lamps") << true;
    QTest::newRow("filter") << false;
  }
  void lightFades() {
    QFETCH(bool, lamps);
    Changes changes;
    (lamps ? changes.lamps : changes.filter) = {1.0, 0.8, 0.5};
    const CameraStack before = traced("plain").trueTransport().floodlight(),
                      after = traced("plain", changes).trueTransport().floodlight();
    std::array<double, 3> then{}, now{};
    for (std::size_t i = 0; i < before.size(); ++i) {
      then[i % 3] += static_cast<double>(before[i]);
      now[i % 3] += static_cast<double>(after[i]);
    }
    const std::array<double, 3> left{now[0] / then[0], now[1] / then[1], now[2] / then[2]};
    QVERIFY2(std::abs(left[0] - 1.0) < 0.1 && std::abs(left[1] - 0.8) < 0.1 && std::abs(left[2] - 0.5) < 0.1,
             qPrintable(QString("%1 %2 %3").arg(left[0]).arg(left[1]).arg(left[2])));
  }

  void whatChangesInOnePlaceChangesThere_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("painted") << 0;
    QTest::newRow("moved") << 1;
    QTest::newRow("added") << 2;
  }
  void whatChangesInOnePlaceChangesThere() {
    QFETCH(int, kind);
    Changes changes;
    const SeenPlace place{0.45, 0.5};
    if (kind == 0) changes.painted.push_back({place, 0.1});
    if (kind == 1) changes.moved.push_back({place, 0.05});
    if (kind == 2) changes.added.push_back({place, 0.15});
    const double share = changedShare(traced("depth").trueTransport().floodlight(),
                                      traced("depth", changes).trueTransport().floodlight());
    QVERIFY2(share > 0.005 && share < 0.5, qPrintable(QString::number(share)));
  }

  void dustTakesLightAndGivesNone() {
    Changes changes;
    changes.dust = 0.3;
    const CameraStack before = traced("plain").trueTransport().floodlight(),
                      after = traced("plain", changes).trueTransport().floodlight();
    double lost = 0.0, all = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      QVERIFY(after[i] <= 1.01f * before[i] + 1e-3f && after[i] >= 0.65f * before[i]);
      lost += static_cast<double>(before[i] - after[i]);
      all += static_cast<double>(before[i]);
    }
    QVERIFY(lost > 0.01 * all && lost < 0.3 * all);
  }

  void roomLightIsAsAskedFor() {
    Changes changes;
    changes.ambient = 0.02;
    const SimulatedVenue before = traced("plain"), after = traced("plain", changes);
    QVERIFY(after.trueTransport() == before.trueTransport());
    for (std::size_t i = 0; i < before.trueBlack().size(); ++i)
      QVERIFY(after.trueBlack()[i] >= before.trueBlack()[i]);
    QVERIFY(after.trueBlack() != before.trueBlack());
  }

  void impossibleChangesAreNamed_data() {
    QTest::addColumn<int>("which");
    for (int which = 0; which < 6; ++which) QTest::addRow("%d", which) << which;
  }
  void impossibleChangesAreNamed() {
    QFETCH(int, which);
    Changes changes;
    if (which == 0) changes.cameras.push_back({1, 1.0, 0.0, 0.0});  // corner has one
    if (which == 1) changes.projectors.push_back({7, 1.0, 0.0, 0.0});
    if (which == 2) changes.lamps[1] = -0.1;
    if (which == 3) changes.painted.push_back({{1.5, 0.5}, 0.1});
    if (which == 4) changes.dust = std::nan("");
    if (which == 5) changes.added.push_back({{0.5, 0.5}, 0.0});
    QVERIFY(!problems(venueWith("corner", changes)).empty());
    QVERIFY_THROWS_EXCEPTION(Error, traced("corner", changes));
  }
};

QTEST_GUILESS_MAIN(TestChanges)
#include "test_changes.moc"
