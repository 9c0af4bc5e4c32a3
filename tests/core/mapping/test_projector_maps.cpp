// SPDX-License-Identifier: MIT
#include "relucent/mapping/projector_maps.h"

#include <QtTest>

#include "core/mapping/mapped_scene.h"
#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/compensation/prediction.h"

using namespace relucent;
using namespace relucent::mapping;
using namespace relucent::synthetic;

namespace {

Progress quiet;
constexpr Size canvas{80, 60};

image::Image grey(float value) {
  return image::Image(canvas, 3, value);
}

}  // namespace

class TestProjectorMaps : public QObject {
  Q_OBJECT

 private slots:
  void everyPixelShowsThePlaceThatItLights_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<double>("margin");
    for (int seed : {1, 2, 3})
      for (double margin : {0.05, 0.1}) QTest::addRow("seed %d, margin %g", seed, margin) << seed << margin;
  }
  /// Within half a camera pixel: the camera's pixels are wider than the projector's, and no camera knows
  /// where in its pixels light falls.
  void everyPixelShowsThePlaceThatItLights() {
    QFETCH(int, seed);
    QFETCH(double, margin);
    SceneSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.margin = margin;
    const MappedScene scene(settings);
    const compensation::Compensator compensator(scene.venue, scene.inverse);
    const compensation::Corners corners = compensation::uprightCorners(4.0, 3.0, 32.0, 24.0);
    compensation::TargetSettings target;
    target.corners = corners;
    const ProjectorMaps maps = projectorMaps(compensator, canvas, target, quiet);
    std::size_t within = 0, all = 0;
    for (std::size_t i = 0; i < settings.camera.count(); ++i) {
      const Pixel pixel = pixelAt(settings.camera, i);
      const std::array<double, 2> seen = scene.seenBy(pixel);
      const Pixel at{static_cast<int>(std::floor(seen[0])), static_cast<int>(std::floor(seen[1]))};
      if (at.x < 0 || at.y < 0 || at.x >= settings.projector.width || at.y >= settings.projector.height)
        continue;
      const std::size_t j = indexOf(settings.projector, at);
      if (maps.alpha[3 * j] == 0.0f) continue;
      // Of the middle of the projector's pixel.
      const double x = pixel.x + 0.5 + (at.x + 0.5 - seen[0]) / scene.pitch()[0];
      const double y = pixel.y + 0.5 + (at.y + 0.5 - seen[1]) / scene.pitch()[1];
      ++all;
      within += std::abs(static_cast<double>(maps.place[j][0]) * 32.0 - (x - 4.0)) <= 0.5 &&
                std::abs(static_cast<double>(maps.place[j][1]) * 24.0 - (y - 3.0)) <= 0.5;
    }
    QVERIFY(all > 500);
    // Beside dark joints the light of one projector pixel is seen by fewer camera pixels.
    QVERIFY2(static_cast<double>(within) >= 0.97 * static_cast<double>(all),
             qPrintable(QString("%1 of %2").arg(within).arg(all)));
  }

  /// A place for the whole picture: players interpolate between pixels.
  void everyPixelHasAPlace() {
    const MappedScene scene({});
    const compensation::Compensator compensator(scene.venue, scene.inverse);
    const ProjectorMaps maps = projectorMaps(compensator, canvas, {}, quiet);
    for (const std::array<float, 2>& place : maps.place)
      QVERIFY(std::isfinite(place[0]) && std::isfinite(place[1]));
    for (float alpha : maps.alpha) QVERIFY(alpha >= 0.0f && alpha <= 1.0f);
  }

  /// What the others get is evener than with the best gain for the projector as a whole: less than half of
  /// the squared error.
  void greysAreEven_data() {
    QTest::addColumn<float>("value");
    for (float value : {1.0f, 0.5f, 0.2f}) QTest::addRow("%g", static_cast<double>(value)) << value;
  }
  void greysAreEven() {
    QFETCH(float, value);
    const MappedScene scene({});
    const compensation::Compensator compensator(scene.venue, scene.inverse);
    const ProjectorMaps maps = projectorMaps(compensator, canvas, {}, quiet);
    const compensation::Target target = fitTarget(grey(value), scene.venue, {});
    compensation::Compensation shown, plain;
    shown.projector = shownBy(maps, grey(value));
    plain = compensator.solve(compensation::Method::none, target, quiet);
    const double mapped = predict(scene.venue, target, shown).psnrReachable;
    const double plainly = predict(scene.venue, target, plain).psnrReachable;
    QVERIFY2(mapped > plainly + 3.0, qPrintable(QString("%1 dB, %2 dB").arg(mapped).arg(plainly)));
  }

  /// Content that rises evenly is between its pixels what it is at the place.
  void contentIsInterpolated() {
    ProjectorMaps maps;
    maps.projectors = Rasters(Size{16, 8});
    maps.alpha.assign(3 * maps.projectors.count(), 0.5f);
    Random random{1};
    for (std::size_t j = 0; j < maps.projectors.count(); ++j)
      maps.place.push_back({static_cast<float>(0.1 + 0.8 * random.uniform()),
                            static_cast<float>(0.1 + 0.8 * random.uniform())});
    image::Image content({20, 10}, 3);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 20; ++x)
        for (int c = 0; c < 3; ++c)
          content.at(x, y, c) = 0.02f * (static_cast<float>(x) + 0.5f) +
                                0.01f * static_cast<float>(c + 1) * (static_cast<float>(y) + 0.5f);
    const ProjectorStack shown = shownBy(maps, content);
    for (std::size_t j = 0; j < maps.place.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c) {
        const float expected =
            0.5f * (0.4f * maps.place[j][0] + 0.1f * static_cast<float>(c + 1) * maps.place[j][1]);
        QVERIFY(std::abs(shown[3 * j + c] - expected) < 1e-5f);  // float
      }
  }

  void picturesOfTheirOwnHaveNoOnePlace() {
    const compensation::MeasuredVenue venue = twoViews();
    const inverse::WindowInverse inverse = inverse::computeWindows(venue.transport, venue.usable, {}, quiet);
    const compensation::Compensator compensator(venue, inverse);
    compensation::TargetSettings target;
    target.views.resize(2);
    target.views[1].placement = compensation::ViewPlacement::own;
    QVERIFY_THROWS_EXCEPTION(Error, projectorMaps(compensator, canvas, target, quiet));
    target.views[1].placement = compensation::ViewPlacement::surface;
    QCOMPARE(projectorMaps(compensator, canvas, target, quiet).place.size(), std::size_t{50 * 37});
  }
};

QTEST_APPLESS_MAIN(TestProjectorMaps)
#include "test_projector_maps.moc"
