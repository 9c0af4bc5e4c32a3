// SPDX-License-Identifier: MIT
// Parts of a view that are not to be lit.
#include "relucent/compensation/mask.h"

#include <QtTest>
#include <cmath>
#include <limits>

#include "core/compensation/stacked_views.h"
#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/methods.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;
using namespace relucent::transport;

namespace {

Progress quiet;

using Points = std::vector<std::array<double, 2>>;

Mask door(double feather = 0.05) {
  return {0, Outline::lines, {{0.4, 0.3}, {0.6, 0.3}, {0.6, 0.7}, {0.4, 0.7}}, feather};
}

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

ProjectorStack whiteOf(const MeasuredVenue& venue) {
  return ProjectorStack(3 * venue.transport.projectors().count(), 1.0f);
}

/// Sum over the masked pixels.
double lightOnMask(const CameraStack& seen, const std::vector<float>& masked) {
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (masked[i / 3] >= fullyMasked) sum += static_cast<double>(seen[i]);
  return sum;
}

TargetSettings with(std::vector<Mask> masks) {
  TargetSettings settings;
  settings.masks = std::move(masks);
  return settings;
}

}  // namespace

class TestMasks : public QObject {
  Q_OBJECT

 private slots:
  void outlinesThatAreNoneAreNamed_data() {
    QTest::addColumn<Points>("points");
    QTest::addColumn<Outline>("outline");
    QTest::addColumn<double>("feather");
    QTest::addColumn<QString>("sentence");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto row = [](const char* name, Points points, Outline outline, double feather,
                        const char* sentence) {
      QTest::newRow(name) << std::move(points) << outline << feather << sentence;
    };
    row("sound", door().points, Outline::lines, 0.0, "");
    row("sound curve", door().points, Outline::curve, 0.5, "");
    row("triangle", {{0, 0}, {1, 0}, {0, 1}}, Outline::lines, 0.1, "");
    row("none", {}, Outline::lines, 0.1, "mask 1: its outline needs three points at least");
    row("two", {{0.1, 0.1}, {0.2, 0.2}}, Outline::curve, 0.1,
        "mask 1: its outline needs three points at least");
    row("not a number", {{0.1, nan}, {0.2, 0.2}, {0.1, 0.2}}, Outline::lines, 0.1,
        "mask 1: its points must be finite numbers");
    row("outside", {{0.1, 1.2}, {0.2, 0.2}, {0.1, 0.2}}, Outline::lines, 0.1,
        "mask 1: its points must lie within the view, from 0 to 1 along both sides");
    row("a bow", {{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.8}}, Outline::lines, 0.1,
        "mask 1: its outline crosses itself");
    row("a bow as a curve", {{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.8}}, Outline::curve, 0.1,
        "mask 1: its outline crosses itself");
    row("back over itself", {{0.2, 0.2}, {0.8, 0.2}, {0.4, 0.2}, {0.4, 0.8}}, Outline::lines, 0.1,
        "mask 1: its outline crosses itself");
    row("on a line", {{0.2, 0.2}, {0.4, 0.4}, {0.8, 0.8}}, Outline::lines, 0.1,
        "mask 1: its outline encloses nothing");
    row("the same twice", {{0.2, 0.2}, {0.2, 0.2}, {0.4, 0.8}}, Outline::curve, 0.1,
        "mask 1: two points of its outline are the same");
    row("feather", door().points, Outline::lines, nan,
        "mask 1: its feather must lie between 0 and half of the view's larger side");
    row("too many", Points(mostMaskPoints + 1, {0.5, 0.5}), Outline::lines, 0.1,
        "mask 1: its outline may have 200 points at most");
  }
  void outlinesThatAreNoneAreNamed() {
    QFETCH(Points, points);
    QFETCH(Outline, outline);
    QFETCH(double, feather);
    QFETCH(QString, sentence);
    const std::vector<Message> found = problems(std::vector<Mask>{{0, outline, points, feather}});
    QCOMPARE(static_cast<int>(found.size()), sentence.isEmpty() ? 0 : 1);
    if (!found.empty()) QCOMPARE(QString::fromStdString(english(found.front())), sentence);
  }

  /// Inside 1, beyond the feather 0, in between by the distance; the area is the polygon's.
  void sharesFollowTheOutline_data() {
    QTest::addColumn<Size>("view");
    QTest::newRow("small") << Size{40, 30};
    QTest::newRow("odd") << Size{101, 67};
    QTest::newRow("large") << Size{2300, 31};
  }
  void sharesFollowTheOutline() {
    QFETCH(Size, view);
    const Mask mask = door(0.1), sharp = door(0.0);
    const std::vector<float> soft = sharesOf(mask, view), hard = sharesOf(sharp, view);
    const double feather = 0.1 * std::max(view.width, view.height);
    double area = 0.0;
    for (std::size_t i = 0; i < soft.size(); ++i) {
      const Pixel at = pixelAt(view, i);
      const double x = at.x + 0.5, y = at.y + 0.5;
      const double beyondX = std::max({0.4 * view.width - x, x - 0.6 * view.width, 0.0}),
                   beyondY = std::max({0.3 * view.height - y, y - 0.7 * view.height, 0.0});
      const double d = std::hypot(beyondX, beyondY), t = std::min(1.0, d / feather);
      QVERIFY(soft[i] >= 0.0f && soft[i] <= 1.0f && soft[i] + 1e-6f >= hard[i]);
      // A pixel holds means; a slope of 3/2 over the feather, and its own half beside the outline.
      QVERIFY(std::abs(static_cast<double>(soft[i]) - (1.0 - t * t * (3.0 - 2.0 * t))) <
              1.5 / feather + 0.05);
      area += static_cast<double>(hard[i]);
    }
    // Half of a fine pixel more on every side is within.
    QVERIFY2(std::abs(area / static_cast<double>(view.count()) - 0.08) < 0.01 + 0.5 / view.height,
             qPrintable(QString::number(area)));
  }

  /// Through its points, closed, and the same whichever of them is the first.
  void curvesGoThroughTheirPoints() {
    Mask mask = door();
    mask.outline = Outline::curve;
    const Points outline = outlineOf(mask);
    for (const auto& point : mask.points)
      QVERIFY(std::ranges::any_of(
          outline, [&](const auto& on) { return std::hypot(on[0] - point[0], on[1] - point[1]) < 1e-9; }));
    Mask turned = mask;
    std::ranges::rotate(turned.points, turned.points.begin() + 1);
    const std::vector<float> a = sharesOf(mask, {80, 60}), b = sharesOf(turned, {80, 60});
    for (std::size_t i = 0; i < a.size(); ++i) QVERIFY(std::abs(a[i] - b[i]) < 0.02f);
    const std::vector<float> straight = sharesOf(door(), {80, 60});
    QVERIFY(std::accumulate(a.begin(), a.end(), 0.0f) >
            std::accumulate(straight.begin(), straight.end(), 0.0f));
  }

  /// With full projection of what is left, next to nothing direct falls on a mask, and elsewhere all does.
  void noDirectLightFallsOnAMask() {
    const Scene scene = makeScene({{64, 48}, {40, 30}, 3});
    const MeasuredVenue venue = venueOf(scene);
    const MaskedLight light = maskedLight(venue, {door()});
    const TransportMatrix direct = directPart(venue.transport, {}, quiet);
    ProjectorStack left = whiteOf(venue);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = light.available[i / 3];
    const CameraStack before = direct.apply(whiteOf(venue)), after = direct.apply(left);
    const double share = lightOnMask(after, light.masked) / lightOnMask(before, light.masked);
    QVERIFY2(share < 0.03, qPrintable(QString::number(share)));
    // The feather is two camera pixels wide and the spots of projector pixels another two.
    std::size_t untouched = 0;
    const std::vector<float> wide = sharesOf(door(0.05 + 3.0 / 40.0), {40, 30});
    for (std::size_t i = 0; i < light.masked.size(); ++i) {
      if (wide[i] > 0.0f || !(before[3 * i] > 0.0f)) continue;
      QVERIFY(after[3 * i] > 0.97f * before[3 * i]);
      ++untouched;
    }
    QVERIFY(untouched > 500);
    QVERIFY(maskedLight(venue, {}).empty());
  }

  void everyMethodKeepsBelowWhatMasksLeave_data() {
    QTest::addColumn<Method>("method");
    for (Method method : allValues<Method>())
      QTest::addRow("%s", std::string(nameOf(method)).c_str()) << method;
  }
  void everyMethodKeepsBelowWhatMasksLeave() {
    QFETCH(Method, method);
    const Scene scene = makeScene({{48, 36}, {32, 24}, 4});
    const MeasuredVenue venue = venueOf(scene);
    const WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
    const Compensator compensator(venue, inverse);
    const Image picture = makeContent(Content::natural, {64, 48}, 2);
    const Target open = fitTarget(picture, venue, {}), none = fitTarget(picture, venue, with({})),
                 masked = fitTarget(picture, venue, with({door()}));
    const ProjectorStack free = compensator.solve(method, open, quiet).projector;
    QVERIFY(compensator.solve(method, none, quiet).projector == free);
    const ProjectorStack p = compensator.solve(method, masked, quiet).projector;
    for (std::size_t i = 0; i < p.size(); ++i) QVERIFY(p[i] >= 0.0f && p[i] <= masked.available[i / 3]);
    // What comes round corners stays: a tenth of what there was is direct and indirect light together.
    const double before = lightOnMask(venue.transport.apply(free), masked.masked),
                 after = lightOnMask(venue.transport.apply(p), masked.masked);
    const TransportMatrix direct = directPart(venue.transport, {}, quiet);
    QVERIFY(lightOnMask(direct.apply(p), masked.masked) <
            0.1 * lightOnMask(direct.apply(free), masked.masked));
    QVERIFY(after < 0.45 * before);
  }

  /// The windows, the steps and the optimum leave the picture elsewhere as near to what is wanted as it was.
  void thePictureElsewhereStays_data() {
    QTest::addColumn<Method>("method");
    for (Method method : {Method::windows, Method::refined, Method::optimum})
      QTest::addRow("%s", std::string(nameOf(method)).c_str()) << method;
  }
  void thePictureElsewhereStays() {
    QFETCH(Method, method);
    const Scene scene = makeScene({{64, 48}, {40, 30}, 5});
    const MeasuredVenue venue = venueOf(scene);
    const WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
    const Compensator compensator(venue, inverse);
    const Image picture = makeContent(Content::natural, {80, 60}, 2);
    const Target open = fitTarget(picture, venue, {}), masked = fitTarget(picture, venue, with({door()}));
    const std::vector<float> wide = sharesOf(door(0.05 + 3.0 / 40.0), {40, 30});
    const auto error = [&](const Target& target) {
      const CameraStack seen = venue.transport.apply(compensator.solve(method, target, quiet).projector);
      double sum = 0.0, count = 0.0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        // Where both can be reached: with a mask less light comes round corners.
        if (wide[i / 3] > 0.0f || !open.reachable[i / 3] || !masked.reachable[i / 3]) continue;
        sum += std::pow((seen[i] + venue.black[i] - target.wanted[i]) / target.white[0], 2);
        count += 1.0;
      }
      return 10.0 * std::log10(sum / count);
    };
    const double before = -error(open), after = -error(masked);
    qInfo("%.2f dB, with a mask %.2f dB", before, after);
    QVERIFY2(after > before - 1.0, qPrintable(QString("%1, %2 dB").arg(before).arg(after)));
  }

  /// Two projectors light two camera pixels: the first one's only pixel both of them, the second one's each
  /// its own. A mask on one of them takes the first projector's light from the other, which the second then
  /// gives.
  void lightIsFetchedFromTheOtherProjector() {
    const Rasters cameras(Size{8, 8}), projectors({{4, 8}, {8, 8}});
    const NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 0.5f));
    for (std::size_t i = 0; i < cameras.count(); ++i) {
      const Pixel at = pixelAt(cameras.size(0), i);
      const auto wide = layout.index({0, 0, at.x / 2, at.y}), own = layout.index({1, 0, at.x, at.y});
      builder.add(i, wide, 0.5f * ColourBlock::Identity());
      builder.add(i, own, 0.5f * ColourBlock::Identity());
    }
    MeasuredVenue venue;
    venue.transport = TransportMatrix(cameras, projectors, builder.build());
    venue.black.assign(3 * cameras.count(), 0.0f);
    venue.flood = venue.transport.floodlight();
    venue.usable.assign(cameras.count(), 1);
    const WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
    const Compensator compensator(venue, inverse);

    // The left one of a pair, columns 2 and 3, with no feather.
    const Mask mask{0, Outline::lines, {{0.25, 0.2}, {0.375, 0.2}, {0.375, 0.8}, {0.25, 0.8}}, 0.0};
    TargetSettings settings = with({mask});
    settings.corners = {{{0, 0}, {8, 0}, {8, 8}, {0, 8}}};
    settings.reachablePercentile = 0.0;
    const Image grey(Size{8, 8}, 3, 0.4f);
    const Target target = fitTarget(grey, venue, settings);
    const ProjectorStack p = compensator.solve(Method::optimum, target, quiet).projector;
    const CameraStack seen = venue.transport.apply(p);
    const std::size_t masked = indexOf(cameras.size(0), {2, 4}), beside = indexOf(cameras.size(0), {3, 4});
    QVERIFY(target.masked[masked] >= fullyMasked && target.inside[masked] == 0 &&
            target.weight[masked] == 0.0f);
    QCOMPARE(seen[3 * masked], 0.0f);
    const std::size_t first = 4 * 4 + 1, second = 4 * 8 + indexOf({8, 8}, {3, 4});
    QCOMPARE(p[3 * first], 0.0f);
    QVERIFY(std::abs(p[3 * second] * 0.5f - target.wanted[3 * beside]) < 1e-3f);
    QVERIFY(std::abs(seen[3 * beside] - target.wanted[3 * beside]) < 1e-3f);
  }

  /// A place that a mask of the first view darkens asks for nothing in the second one's either.
  void otherViewsKnowOfIt() {
    const MeasuredVenue venue = twoViews();
    const MaskedLight light = maskedLight(venue, {door()});
    const std::size_t second = venue.transport.cameras().offset(1);
    const auto masked = std::count_if(light.masked.begin() + static_cast<std::ptrdiff_t>(second),
                                      light.masked.end(), [](float share) { return share >= fullyMasked; });
    QVERIFY2(masked > 30, qPrintable(QString::number(masked)));
    QVERIFY(std::all_of(light.masked.begin() + static_cast<std::ptrdiff_t>(second), light.masked.end(),
                        [](float share) { return share == 0.0f || share == 1.0f; }));
    Mask third = door();
    third.camera = 2;
    QVERIFY_THROWS_EXCEPTION(Error, maskedLight(venue, {third}));
  }

  void aMaskOverEverythingIsSaid() {
    const Scene scene = makeScene({{32, 24}, {24, 18}, 2});
    const Mask all{0, Outline::lines, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.0};
    try {
      fitTarget(makeContent(Content::natural, {40, 30}, 2), venueOf(scene), with({all}));
      QFAIL("nothing was said");
    } catch (const Error& error) {
      QCOMPARE(QString::fromStdString(english(error.summary())),
               QString("the masks cover the whole picture"));
    }
  }
};

QTEST_GUILESS_MAIN(TestMasks)
#include "test_masks.moc"
