// SPDX-License-Identifier: MIT
#include "relucent/compensation/target.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

std::vector<std::uint8_t> maskWith(Size size, int x0, int y0, int x1, int y1) {
  std::vector<std::uint8_t> mask(size.count(), 0);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) mask[indexOf(size, {x, y})] = 1;
  return mask;
}

}  // namespace

class TestTarget : public QObject {
  Q_OBJECT

 private slots:
  void largestUprightFillsTheUsablePart_data() {
    QTest::addColumn<double>("aspect");
    QTest::newRow("the part's own shape") << 4.0 / 3.0;
    QTest::newRow("wide") << 3.0;
    QTest::newRow("tall") << 0.5;
  }
  void largestUprightFillsTheUsablePart() {
    QFETCH(double, aspect);
    Size size{100, 80};
    CameraMask usable(maskWith(size, 20, 10, 84, 58));
    for (std::size_t i = 0; i < usable.size(); i += 37) usable[i] = 0;  // small holes
    std::optional<Corners> found = largestUpright(usable, size, aspect);
    QVERIFY(found.has_value());
    double width = (*found)[2][0] - (*found)[0][0], height = (*found)[2][1] - (*found)[0][1];
    QVERIFY(std::abs(width / height / aspect - 1.0) < 0.05);  // whole pixels
    // It may hang over by what the usable shares of its sides allow: less than a strip of a sixteenth.
    double fits = std::min(64.0 / aspect, 48.0);
    QVERIFY2(height >= fits - 1.0 && height <= fits * 1.13 + 1.0, qPrintable(QString::number(height)));
  }
  /// Around a projection in a dome everything glows, and yet nothing can be shown there.
  void contentStaysWhereTheProjectionItselfIsSeen() {
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    Size view = scene.transport.cameras().size(0);
    std::fill(venue.usable.begin(), venue.usable.end(), std::uint8_t{1});
    Image content({40, 30}, 3, 0.5f);
    Corners everywhere = fitTarget(content, venue, {}).corners;
    QCOMPARE(everywhere[2][0] - everywhere[0][0], static_cast<double>(view.width));
    venue.direct = CameraMask(maskWith(view, 5, 4, 33, 25));
    Corners placed = fitTarget(content, venue, {}).corners;
    // A strip along each side may be a tenth without: 21 rows and not two more.
    QVERIFY(placed[0][0] >= 4 && placed[0][1] >= 3 && placed[2][0] <= 34 && placed[2][1] <= 26);
    QVERIFY(placed[2][1] - placed[0][1] >= 20);
    QVERIFY(placeable(venue) == venue.direct);
  }
  void nothingLitHoldsNoPicture() { QVERIFY(!largestUpright(CameraMask(100, 0), {10, 10}, 1.0)); }

  void cornersMapToTheUnitSquare() {
    Corners corners{{{3, 4}, {40, 7}, {35, 30}, {1, 26}}};
    Eigen::Matrix3d map = unitSquareFrom(corners);
    double expected[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
      Eigen::Vector3d p = map * Eigen::Vector3d(corners[i][0], corners[i][1], 1.0);
      QVERIFY(std::abs(p[0] / p[2] - expected[i][0]) < 1e-9);
      QVERIFY(std::abs(p[1] / p[2] - expected[i][1]) < 1e-9);
    }
  }

  void placingKeepsConstantsAndMeans_data() {
    QTest::addColumn<int>("content");
    QTest::newRow("magnified") << 7;
    QTest::newRow("one to one") << 24;
    QTest::newRow("reduced") << 150;
    QTest::newRow("much reduced") << 700;
  }
  void placingKeepsConstantsAndMeans() {
    QFETCH(int, content);
    Image picture({content, content}, 3);
    double mean = 0.0;
    for (int y = 0; y < content; ++y)
      for (int x = 0; x < content; ++x)
        for (int c = 0; c < 3; ++c) {
          picture.at(x, y, c) =
              c == 0 ? 0.25f : static_cast<float>((x * 7 + y * 3) % content) / static_cast<float>(content);
          if (c == 1) mean += picture.at(x, y, c) / (content * content);
        }
    Placed placed = place(picture, {uprightCorners(4, 4, 24, 24), {}}, {32, 32});
    double placedMean = 0.0;
    int inside = 0;
    for (std::size_t i = 0; i < placed.inside.size(); ++i) {
      if (!placed.inside[i]) {
        QCOMPARE(placed.image.pixel(i)[0], 0.0f);
        continue;
      }
      ++inside;
      QVERIFY(std::abs(placed.image.pixel(i)[0] - 0.25f) < 1e-5f);
      placedMean += placed.image.pixel(i)[1];
    }
    QCOMPARE(inside, 24 * 24);
    // Area averages keep the mean; magnified content loses some to the continued edges.
    QVERIFY2(std::abs(placedMean / inside - mean) < 0.02,
             qPrintable(QString("%1 %2").arg(placedMean / inside).arg(mean)));
  }

  /// A ramp's mean over any area is its value in the middle, so each pixel must show its own place.
  void everythingIsInItsPlace() {
    Image ramp({240, 240}, 3);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 240; ++x) {
        ramp.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / 240.0f;
        ramp.at(x, y, 1) = (static_cast<float>(y) + 0.5f) / 240.0f;
      }
    Placed placed = place(ramp, {uprightCorners(4, 6, 24, 20), {}}, {32, 32});
    for (int y = 7; y < 25; ++y)
      for (int x = 5; x < 27; ++x) {
        QVERIFY(std::abs(placed.image.at(x, y, 0) - (static_cast<float>(x) - 3.5f) / 24.0f) < 1e-4f);
        QVERIFY(std::abs(placed.image.at(x, y, 1) - (static_cast<float>(y) - 5.5f) / 20.0f) < 1e-4f);
      }
  }

  void fittingKeepsTheShape_data() {
    QTest::addColumn<double>("aspect");
    for (double aspect : {0.3, 0.8, 1.0, 2.0, 5.0}) QTest::addRow("%g", aspect) << aspect;
  }
  /// In an upright rectangle a circle stays one, all of it inside (fit) or all of the rectangle covered.
  void fittingKeepsTheShape() {
    QFETCH(double, aspect);
    Corners rectangle = uprightCorners(5, 7, 40, 30);
    auto sides = [](const Corners& c) {
      return std::array{c[1][0] - c[0][0], c[3][1] - c[0][1], 0.5 * (c[0][0] + c[2][0]),
                        0.5 * (c[0][1] + c[2][1])};
    };
    Placement fill = fitted(rectangle, aspect, Fit::fill);
    QVERIFY(fill.corners == rectangle);
    Placement fit = fitted(rectangle, aspect, Fit::fit);
    auto [width, height, x, y] = sides(fit.corners);
    QVERIFY(std::abs(width / height / aspect - 1.0) < 1e-9);
    QVERIFY(std::abs(x - 25.0) < 1e-9 && std::abs(y - 22.0) < 1e-9);
    QVERIFY(std::abs(std::max(width / 40.0, height / 30.0) - 1.0) < 1e-9);
    Placement cover = fitted(rectangle, aspect, Fit::cover);
    QVERIFY(cover.corners == rectangle);
    double shown = (cover.part.x1 - cover.part.x0) / (cover.part.y1 - cover.part.y0) * aspect;
    QVERIFY(std::abs(shown / (40.0 / 30.0) - 1.0) < 1e-9);
    QVERIFY(cover.part.x0 >= 0.0 && cover.part.y0 >= 0.0);
    QVERIFY(std::abs(std::max(cover.part.x1 - cover.part.x0, cover.part.y1 - cover.part.y0) - 1.0) < 1e-9);
  }

  /// Bars lie along the lines that meet in the quadrilateral's vanishing points.
  void barsFollowThePerspective() {
    Corners quadrilateral{{{3, 4}, {40, 7}, {35, 30}, {1, 26}}};
    Placement fit = fitted(quadrilateral, 3.0, Fit::fit);
    QVERIFY(isConvex(fit.corners));
    Eigen::Matrix3d map = unitSquareFrom(quadrilateral);
    for (const auto& corner : fit.corners) {
      Eigen::Vector3d p = map * Eigen::Vector3d(corner[0], corner[1], 1.0);
      double u = p[0] / p[2], v = p[1] / p[2];
      QVERIFY(std::abs(u * (1.0 - u)) < 1e-9);  // on the left or right edge
      QVERIFY(v > 0.05 && v < 0.95);
    }
  }

  void coverShowsTheMiddle() {
    // A ramp three times as wide as high in a square: the middle third of it.
    Image ramp({300, 100}, 3);
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 300; ++x) ramp.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / 300.0f;
    Placed placed = place(ramp, fitted(uprightCorners(0, 0, 30, 30), 3.0, Fit::cover), {30, 30});
    for (int x = 0; x < 30; ++x) {
      float expected = 1.0f / 3.0f + (static_cast<float>(x) + 0.5f) / 90.0f;
      QVERIFY2(std::abs(placed.image.at(x, 15, 0) - expected) < 1e-3f,
               qPrintable(QString::number(placed.image.at(x, 15, 0))));
    }
  }

  void barsAreNotContent() {
    Scene scene = makeScene({});
    TargetSettings settings;
    settings.corners = uprightCorners(8, 6, 24, 18);
    settings.fit = Fit::fit;
    Target wide = fitTarget(Image({40, 10}, 3, 0.5f), venueOf(scene), settings);
    std::size_t inside = 0;
    for (std::uint8_t flag : wide.inside) inside += flag;
    // 24 pixels wide and a quarter of that high.
    QCOMPARE(inside, std::size_t{24 * 6});
    settings.fit = Fit::cover;
    Target covered = fitTarget(Image({40, 10}, 3, 0.5f), venueOf(scene), settings);
    inside = 0;
    for (std::uint8_t flag : covered.inside) inside += flag;
    QCOMPARE(inside, std::size_t{24 * 18});
  }

  void saysWhatIsWrongWithCorners_data() {
    QTest::addColumn<QList<double>>("corners");
    QTest::addColumn<QString>("says");
    using List = QList<double>;
    QTest::newRow("larger than the view") << List{-5, -5, 60, -5, 60, 40, -5, 40} << "upper left corner";
    QTest::newRow("one outside") << List{2, 2, 30, 2, 30, 99, 2, 20} << "lower right corner";
    QTest::newRow("beside the view") << List{100, 2, 130, 2, 130, 20, 100, 20} << "upper left corner";
    QTest::newRow("on a line") << List{2, 2, 10, 10, 20, 20, 30, 30} << "convex";
    QTest::newRow("a point") << List{5, 5, 5, 5, 5, 5, 5, 5} << "convex";
    QTest::newRow("crossed") << List{2, 2, 30, 20, 30, 2, 2, 20} << "convex";
    QTest::newRow("dented") << List{2, 2, 30, 2, 10, 6, 2, 20} << "convex";
    QTest::newRow("the other way round") << List{2, 2, 2, 20, 30, 20, 30, 2} << "counter-clockwise";
    double nan = std::nan(""), infinite = HUGE_VAL;
    QTest::newRow("no number") << List{nan, 2, 30, 2, 30, 20, 2, 20} << "finite";
    QTest::newRow("infinite") << List{2, 2, infinite, 2, infinite, 20, 2, 20} << "finite";
  }
  void saysWhatIsWrongWithCorners() {
    QFETCH(QList<double>, corners);
    QFETCH(QString, says);
    TargetSettings settings;
    settings.corners.emplace();
    for (int i = 0; i < 8; ++i)
      (*settings.corners)[static_cast<std::size_t>(i / 2)][static_cast<std::size_t>(i % 2)] = corners[i];
    QString sentence;
    for (const Message& problem : problems(settings)) sentence = QString::fromStdString(english(problem));
    if (sentence.isEmpty()) {
      try {
        fitTarget(Image({4, 3}, 3, 1.0f), venueOf(makeScene({})), settings);
      } catch (const Error& error) {
        sentence = error.what();
      }
    }
    QVERIFY2(sentence.contains(says), qPrintable(sentence));
  }

  void fitsHaveNames() {
    for (Fit fit : {Fit::fill, Fit::fit, Fit::cover}) QVERIFY(valueNamed<Fit>(nameOf(fit)) == fit);
    QVERIFY(!valueNamed<Fit>("stretch"));
  }

  void greyStaysGreyAndWhiteIsReachable_data() {
    QTest::addColumn<double>("percentile");
    QTest::addColumn<Objective>("objective");
    for (double percentile : {0.0, 15.0, 50.0})
      for (Objective objective : allValues<Objective>())
        QTest::addRow("%g, %s", percentile, std::string(nameOf(objective)).c_str())
            << percentile << objective;
  }
  void greyStaysGreyAndWhiteIsReachable() {
    QFETCH(double, percentile);
    QFETCH(Objective, objective);
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    TargetSettings settings;
    settings.reachablePercentile = percentile;
    settings.objective = objective;
    Target target = fitTarget(Image({40, 30}, 3, 1.0f), venue, settings);
    double dark = 0.0, inside = 0.0;
    for (std::size_t i = 0; i < target.inside.size(); ++i) {
      if (!target.inside[i]) continue;
      for (std::size_t c = 0; c < 3; ++c)
        QVERIFY(std::abs(target.wanted[3 * i + c] / target.white[c] - 1.0f) < 1e-4f);
      if (!venue.usable[i]) {
        QCOMPARE(target.weight[i], 0.0f);
        continue;
      }
      inside += 1.0;
      dark += target.reachable[i] ? 0.0 : 1.0;
      const float unreachable = objective == Objective::light ? 0.1f : 0.5f;
      QCOMPARE(target.windowsWeight[i], target.reachable[i] ? 1.0f : unreachable);
    }
    QVERIFY2(std::abs(100.0 * dark / inside - percentile) < 1.0,
             qPrintable(QString::number(100.0 * dark / inside)));
  }

  void sensitivityIsTheSlopeOfTheScale() {
    // (d/dY sqrt(Y + a))^2, relative to white; what is brighter than white is as white.
    for (float y : {0.0f, 0.01f, 0.2f, 0.7f}) {
      const auto slope = [](double at) {
        constexpr double step = 1e-4, a = sensitivityOffset;
        return (std::sqrt(at + step + a) - std::sqrt(at - step + a)) / (2.0 * step);
      };
      const double expected = std::pow(slope(static_cast<double>(y)) / slope(1.0), 2);
      QVERIFY(std::abs(static_cast<double>(sensitivity(y)) / expected - 1.0) < 1e-4);
    }
    QCOMPARE(sensitivity(1.0f), 1.0f);
    QCOMPARE(sensitivity(7.0f), 1.0f);
  }

  /// Nobody asks for what cannot be had, and the dark counts more than the bright.
  void objectivesAskForWhatTheySay() {
    const MeasuredVenue venue = venueOf(makeScene({}));
    Image content = makeContent(Content::natural, {40, 30}, 4);
    for (std::size_t i = 0; i < content.data().size(); i += 7) content.data()[i] = 0.0f;
    TargetSettings settings;
    settings.reachablePercentile = 40.0;
    const Target seen = fitTarget(content, venue, settings);
    settings.objective = Objective::light;
    const Target light = fitTarget(content, venue, settings);
    QVERIFY(seen.wanted == light.wanted && seen.reachable == light.reachable);
    QVERIFY(light.weight == light.windowsWeight);
    std::size_t held = 0;
    for (std::size_t i = 0; i < seen.asked.size(); ++i) {
      if (!seen.inside[i / 3]) continue;
      QCOMPARE(light.asked[i], light.wanted[i] - venue.black[i]);
      QVERIFY(seen.asked[i] >= 0.0f && seen.asked[i] <= venue.flood[i]);
      if (seen.reachable[i / 3])
        QCOMPARE(seen.asked[i], light.asked[i]);
      else
        held += seen.asked[i] != light.asked[i];
    }
    QVERIFY(held > 0);
    for (std::size_t i = 0; i < seen.weight.size(); ++i) {
      if (!(seen.windowsWeight[i] > 0.0f)) {
        QCOMPARE(seen.weight[i], 0.0f);
        continue;
      }
      float luminance = 0.0f;
      for (std::size_t c = 0; c < 3; ++c)
        luminance +=
            image::luminanceWeights[c] * (seen.asked[3 * i + c] + venue.black[3 * i + c]) / seen.white[c];
      QVERIFY(std::abs(seen.weight[i] / (seen.windowsWeight[i] * sensitivity(luminance)) - 1.0f) < 1e-5f);
    }
  }

  void colourIsHeldAsSaid_data() {
    QTest::addColumn<Clipping>("clipping");
    for (Clipping clipping : allValues<Clipping>())
      QTest::newRow(std::string(nameOf(clipping)).c_str()) << clipping;
  }
  /// What can be had stays as it is; of what cannot, the brightest channel that clips is as bright as can be
  /// by every way, and by hue all are in the proportion that is wanted.
  void colourIsHeldAsSaid() {
    QFETCH(Clipping, clipping);
    const MeasuredVenue venue = venueOf(makeScene({}));
    TargetSettings settings;
    settings.reachablePercentile = 60.0;
    settings.clipping = clipping;
    const Target target = fitTarget(makeContent(Content::saturated, {40, 30}, 4), venue, settings);
    int beyond = 0;
    for (std::size_t i = 0; i < target.inside.size(); ++i) {
      if (!target.inside[i] || !venue.usable[i]) continue;
      float kept = 1.0f;
      std::array<float, 3> light{};
      for (std::size_t c = 0; c < 3; ++c) {
        light[c] = std::max(0.0f, target.wanted[3 * i + c] - venue.black[3 * i + c]);
        if (light[c] > venue.flood[3 * i + c]) kept = std::min(kept, venue.flood[3 * i + c] / light[c]);
      }
      beyond += kept < 1.0f ? 1 : 0;
      const float share = clipping == Clipping::channels ? 1.0f
                          : clipping == Clipping::half   ? (1.0f + kept) / 2.0f
                                                         : kept;
      for (std::size_t c = 0; c < 3; ++c) {
        const float expected = std::min(share * light[c], venue.flood[3 * i + c]);
        QVERIFY(std::abs(target.asked[3 * i + c] - expected) <= 1e-5f * (1.0f + expected));
      }
    }
    QVERIFY(beyond > 50);
  }

  void blackIsLifted() {
    Scene scene = makeScene({});
    TargetSettings settings;
    settings.blackLift = 0.1;
    Target target = fitTarget(Image({40, 30}, 3, 0.0f), venueOf(scene), settings);
    for (std::size_t i = 0; i < target.inside.size(); ++i) {
      if (target.inside[i]) QVERIFY(std::abs(target.wanted[3 * i] - 0.1f * target.white[0]) < 1e-5f);
    }
  }

  void coloursKeepTheProjectorsHue() {
    // K times a pure colour is what the venue makes of that colour on average.
    Scene scene = makeScene({});
    ColourBlock k = meanColourMixing(venueOf(scene));
    for (int c = 0; c < 3; ++c) {
      QVERIFY(std::abs(k.row(c).sum() - 1.0f) < 1e-5f);
      QVERIFY(k(c, c) > 0.6f && k(c, c) < 1.0f);
    }
  }

  void refusesAViewWithoutLight() {
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    std::fill(venue.usable.begin(), venue.usable.end(), std::uint8_t{0});
    QVERIFY_EXCEPTION_THROWN(fitTarget(Image({4, 3}, 3, 1.0f), venue, {}), Error);
    TargetSettings settings;
    settings.corners = uprightCorners(5, 5, 20, 15);
    QVERIFY_EXCEPTION_THROWN(fitTarget(Image({4, 3}, 3, 1.0f), venue, settings), Error);
  }

  void checksSettings() {
    QVERIFY(problems(TargetSettings{}).empty());
    TargetSettings wrong;
    wrong.corners = Corners{{{0, 0}, {0, 10}, {10, 10}, {10, 0}}};  // counter-clockwise
    wrong.reachablePercentile = 101.0;
    wrong.blackLift = 1.0;
    wrong.unreachableWeight = -0.1;
    QCOMPARE(problems(wrong).size(), std::size_t{4});
  }
};

QTEST_APPLESS_MAIN(TestTarget)
#include "test_target.moc"
