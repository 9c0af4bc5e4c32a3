// SPDX-License-Identifier: MIT
// Whose light does not arrive where, by photographs of what plays.
#include "relucent/monitoring/shadow_tracker.h"

#include <QtTest>

#include "core/monitoring/synthetic_watch.h"

using namespace relucent;
using namespace relucent::monitoring;

namespace {

/// An ellipse of a projector's pixels.
struct Shadow {
  std::size_t projector = 0;
  double x = 20, y = 15, halfWidth = 6, halfHeight = 8;
  bool holds(Pixel at) const {
    const double u = (at.x + 0.5 - x) / halfWidth, v = (at.y + 0.5 - y) / halfHeight;
    return u * u + v * v < 1.0;
  }
};
using Shadows = std::vector<Shadow>;

}  // namespace

class TestShadowTracker : public QObject {
  Q_OBJECT

  transport::TransportMatrix transport_;
  WatchedVenue venue_;
  double clock_ = 0.0;
  std::uint64_t photographs_ = 0;

  /// What plays: the picture as far as it may be shown. What others put in its place does not matter here.
  static ProjectorStack shown(ProjectorStack picture, const engine::Availability& available) {
    for (std::size_t j = 0; j < 2; ++j) {
      const std::vector<float> share = engine::sharesOfPixels(available.projectors[j], syntheticSize);
      for (std::size_t i = 0; i < share.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) picture[3 * (j * share.size() + i) + c] *= share[i];
    }
    return picture;
  }
  /// A photograph of it, past whoever stands in the light.
  bool photograph(ShadowTracker& tracker, const ProjectorStack& picture, const Shadows& shadows,
                  const std::function<void(std::vector<float>&)>& before = {}) {
    const ProjectorStack plays = shown(picture, tracker.available());
    ProjectorStack arrives = plays;
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < syntheticSize.count(); ++i)
        if (std::any_of(shadows.begin(), shadows.end(), [&](const Shadow& one) {
              return one.projector == j && one.holds(pixelAt(syntheticSize, i));
            }))
          for (std::size_t c = 0; c < 3; ++c) arrives[3 * (j * syntheticSize.count() + i) + c] = 0.0f;
    std::vector<float> radiance = radianceOf(transport_, venue_, arrives);
    if (before) before(radiance);
    const std::vector<PlayedFrame> frames{{0.0, venue_.transport.meansOf(plays)}};
    KnownLight known;
    known.gains.assign(6, 1.0);
    const Observed seen = observed(radiance, ++photographs_, 0.01);
    return tracker.look(seen, momentOf(seen, frames, 0.02, venue_, known.gains), known, clock_ += 0.1);
  }

  /// Share of a shadow's pixels that are dark in what is to be projected, and of all others.
  static std::array<double, 2> darkened(const ShadowTracker& tracker, const Shadow& shadow) {
    const std::vector<float> share =
        engine::sharesOfPixels(tracker.available().projectors[shadow.projector], syntheticSize);
    std::array<double, 2> dark{}, all{};
    for (std::size_t i = 0; i < share.size(); ++i) {
      const std::size_t outside = shadow.holds(pixelAt(syntheticSize, i)) ? 0 : 1;
      all[outside] += 1.0;
      dark[outside] += 1.0 - static_cast<double>(share[i]);
    }
    return {dark[0] / all[0], dark[1] / all[1]};
  }

 private slots:
  void initTestCase() {
    transport_ = syntheticTransport();
    venue_ = syntheticVenue(transport_);
  }

  void init() { photographs_ = 0; }

  void whoseLightIsMissingIsSeenByTheSecondPhotograph_data() {
    QTest::addColumn<int>("projector");
    QTest::addColumn<int>("seed");
    for (int projector : {0, 1})
      for (int seed : {1, 2, 3})
        QTest::addRow("projector %d, picture %d", projector + 1, seed) << projector << seed;
  }
  void whoseLightIsMissingIsSeenByTheSecondPhotograph() {
    QFETCH(int, projector);
    QFETCH(int, seed);
    ShadowTracker tracker(venue_);
    QVERIFY(tracker.canFill());
    const ProjectorStack picture = syntheticPicture(2.0, static_cast<std::uint64_t>(seed));
    QVERIFY(!photograph(tracker, picture, {}));
    QVERIFY(tracker.available().isComplete());
    const Shadow shadow{static_cast<std::size_t>(projector)};
    for (int n = 0; n < 2 && tracker.available().isComplete(); ++n) photograph(tracker, picture, {shadow});
    const auto [within, outside] = darkened(tracker, shadow);
    QVERIFY2(within > 0.65 && outside < 0.1, qPrintable(QString("%1 %2").arg(within).arg(outside)));
    QVERIFY(tracker.available().projectors[1 - shadow.projector] ==
            engine::completeGrid(syntheticSize, tracker.map().grids()[0].side));
    QCOMPARE(tracker.filled().size(), 1u);
    QVERIFY(std::abs(tracker.filled().front().x - 0.5) < 0.05 &&
            std::abs(tracker.filled().front().y - 0.5) < 0.05);
    // It stays so, and goes when he does.
    for (int n = 0; n < 10; ++n) photograph(tracker, picture, {shadow});
    QVERIFY(darkened(tracker, shadow)[0] > 0.6);
    int photographs = 0;
    while (!tracker.available().isComplete() && photographs < 20) {
      photograph(tracker, picture, {});
      ++photographs;
    }
    // Where the projector is the weaker one, its rim tells nothing and is tried after a second.
    QVERIFY2(photographs <= (projector == 0 ? 3 : 10), qPrintable(QString::number(photographs)));
  }

  void whoMovesTakesHisShadowAlong() {
    ShadowTracker tracker(venue_);
    const ProjectorStack picture = syntheticPicture(2.0, 4);
    for (int n = 0; n < 40; ++n) {
      const Shadow shadow{0, 8.0 + 0.5 * n};
      photograph(tracker, picture, {shadow});
      const auto [within, outside] = darkened(tracker, shadow);
      if (n > 2)
        QVERIFY2(within > 0.5 && outside < 0.2,
                 qPrintable(QString("%1: %2 %3").arg(n).arg(within).arg(outside)));
    }
  }

  /// Ten photographs of nobody and noise: nothing, ever.
  void nobodyIsNoShadow() {
    ShadowTracker tracker(venue_);
    for (int n = 0; n < 20; ++n) QVERIFY(!photograph(tracker, syntheticPicture(3.0 * n, 1 + n % 4), {}));
  }

  /// Who stands before the camera, in nobody's light: at the latest after as many photographs as there is
  /// patience for, all is as before.
  void whoStandsBeforeTheCameraIsNoShadow_data() {
    QTest::addColumn<float>("brightness");
    for (float brightness : {0.0f, 0.3f, 1.0f, 3.0f}) QTest::addRow("%.1f", double(brightness)) << brightness;
  }
  void whoStandsBeforeTheCameraIsNoShadow() {
    QFETCH(float, brightness);
    ShadowTracker tracker(venue_);
    const ProjectorStack picture = syntheticPicture(2.0, 2);
    int filled = 0;
    for (int n = 0; n < 12; ++n) {
      photograph(tracker, picture, {}, [&](std::vector<float>& radiance) {
        for (std::size_t i = 0; i < radiance.size(); ++i) {
          const Pixel at = pixelAt(syntheticSize, i / 3);
          if (at.x >= 15 && at.x < 24 && at.y > 8)
            radiance[i] = brightness * (4.0f + std::sin(0.5f * static_cast<float>(at.y)));
        }
      });
      filled += !tracker.available().isComplete();
    }
    // Black is what a shadow without other light looks like: it takes a try to tell.
    QVERIFY2(filled <= (brightness == 0.0f ? 6 : 3), qPrintable(QString::number(filled)));
    QVERIFY(tracker.available().isComplete());
  }

  /// Where both are blocked nobody can take over, and both go on.
  void bothBlockedIsLeftAsItIs() {
    ShadowTracker tracker(venue_);
    const ProjectorStack picture = syntheticPicture(2.0, 2);
    const Shadows both{{0}, {1}};
    for (int n = 0; n < 6; ++n) photograph(tracker, picture, both);
    QVERIFY(darkened(tracker, both[0])[0] < 0.25 && darkened(tracker, both[1])[0] < 0.25);
    // One goes: now the other's is filled.
    for (int n = 0; n < 4; ++n) photograph(tracker, picture, {both[1]});
    QVERIFY(darkened(tracker, both[1])[0] > 0.6 && darkened(tracker, both[0])[0] < 0.05);
  }

  /// What others hardly reach stays in shadow, and the projector goes on: somebody may be mistaken.
  void whereNoOtherReachesNothingIsFilled() {
    const transport::TransportMatrix alone = syntheticTransport(0.05f);
    const WatchedVenue venue = syntheticVenue(alone);
    ShadowTracker tracker(venue);
    const transport::TransportMatrix both = std::exchange(transport_, alone);
    const WatchedVenue before = std::exchange(venue_, venue);
    for (int n = 0; n < 4; ++n) photograph(tracker, syntheticPicture(2.0, 2), {{0, 12}});
    transport_ = both;
    venue_ = before;
    const double dimmed = darkened(tracker, {0, 12})[0];
    QVERIFY2(dimmed < 0.05, qPrintable(QString::number(dimmed)));
    QVERIFY(std::count(tracker.blocked().begin(), tracker.blocked().end(), 1) > 8);
  }

  /// Both projectors give the same share of one even colour: only trying tells whose light is missing.
  void whatLooksAlikeIsTried_data() {
    QTest::addColumn<int>("projector");
    QTest::newRow("first") << 0;
    QTest::newRow("second") << 1;
  }
  void whatLooksAlikeIsTried() {
    QFETCH(int, projector);
    ShadowTracker tracker(venue_);
    ProjectorStack picture(3 * 2 * syntheticSize.count());
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const std::size_t j = i / (3 * syntheticSize.count());
      const bool isNear =
          (pixelAt(syntheticSize, i / 3 % syntheticSize.count()).x < syntheticSize.width / 2) == (j == 0);
      picture[i] = isNear ? 0.12f : 0.4f;
    }
    const Shadow shadow{static_cast<std::size_t>(projector), 12, 15};
    for (int n = 0; n < 3; ++n) photograph(tracker, picture, {shadow});
    const Shadow other{1 - shadow.projector, 12, 15};
    QVERIFY(darkened(tracker, shadow)[0] > 0.6 && darkened(tracker, other)[0] < 0.1);
  }

  /// In the dark nothing is known, and what was known stays for a while.
  void theDarkTellsNothingOfShadows() {
    ShadowTracker tracker(venue_);
    const ProjectorStack picture = syntheticPicture(2.0, 2), dark(picture.size(), 0.0f);
    const Shadow shadow{0};
    QVERIFY(!photograph(tracker, dark, {shadow}));
    // One photograph may leave a doubt.
    for (int n = 0; n < 2 && tracker.available().isComplete(); ++n) photograph(tracker, picture, {shadow});
    const engine::Availability filled = tracker.available();
    QVERIFY(!filled.isComplete());
    for (int n = 0; n < 5; ++n) photograph(tracker, dark, {shadow});
    QVERIFY(tracker.available() == filled);
    for (int n = 0; n < 60; ++n) photograph(tracker, dark, {shadow});
    QVERIFY(tracker.available().isComplete());
  }
};

QTEST_GUILESS_MAIN(TestShadowTracker)
#include "test_shadow_tracker.moc"
