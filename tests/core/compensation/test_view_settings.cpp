// SPDX-License-Identifier: MIT
// What several views ask for: weights, pictures of their own, and where they contradict each other.
#include <QtTest>
#include <cmath>

#include "core/compensation/stacked_views.h"
#include "relucent/base/error.h"
#include "relucent/compensation/contradiction.h"
#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/prediction.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

/// Two views and their windows.
struct Prepared {
  explicit Prepared(MeasuredVenue made) : venue(std::move(made)) {
    Progress silent;
    inverse = computeWindows(venue.transport, venue.usable, {}, silent);
  }
  Compensation solved(Method method, const Target& target, CompensatorSettings settings = {}) const {
    Progress silent;
    return Compensator(venue, inverse, std::move(settings)).solve(method, target, silent);
  }
  MeasuredVenue venue;
  WindowInverse inverse;
};

const Prepared& two() {
  static const Prepared prepared(twoViews());
  return prepared;
}

TargetSettings weighing(const std::vector<double>& weights) {
  TargetSettings settings;
  for (double weight : weights) settings.views.push_back({weight, ViewPlacement::surface, {}, {}});
  return settings;
}

/// The second view has a picture of its own: where the first one has it, turned upside down.
TargetSettings upsideDown(double weight = 1.0) {
  TargetSettings settings = weighing({1.0, weight});
  settings.corners = uprightCorners(8, 6, 24, 18);
  settings.views[1].placement = ViewPlacement::own;
  settings.views[1].corners = Corners{{{26.0, 21.0}, {7.0, 21.0}, {7.0, 6.0}, {26.0, 6.0}}};
  return settings;
}

/// Sum of squares over a camera's usable pixels of the content.
double squaresIn(const Target& target, const ProjectorStack& p, std::size_t camera) {
  const MeasuredVenue& venue = two().venue;
  const CameraStack seen = venue.transport.apply(p);
  const std::size_t begin = venue.transport.cameras().offset(camera),
                    end = begin + venue.transport.cameras().size(camera).count();
  double sum = 0.0;
  for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
    if (!(target.weight[i / 3] > 0.0f)) continue;
    const double share = target.reachable[i / 3] != 0 ? 1.0 : 0.1;
    sum += share * std::pow(static_cast<double>(seen[i] + venue.black[i] - target.wanted[i]), 2);
  }
  return sum;
}

bool sameTargets(const Target& a, const Target& b) {
  return a.wanted == b.wanted && a.content == b.content && a.inside == b.inside && a.weight == b.weight &&
         a.reachable == b.reachable && a.white == b.white;
}

Image picture() {
  Image content({40, 30}, 3);
  Random random{4};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c)
        content.at(x, y, c) =
            0.1f + 0.7f * static_cast<float>(cloud(4 * x, 4 * y, 11 + static_cast<std::uint64_t>(c)));
  return content;
}

}  // namespace

class TestViewSettings : public QObject {
  Q_OBJECT

 private slots:
  void equalWeightsChangeNothing_data() {
    QTest::addColumn<QList<double>>("weights");
    QTest::newRow("one each") << QList<double>{1.0, 1.0};
    QTest::newRow("three each") << QList<double>{3.0, 3.0};
    QTest::newRow("the first alone is named") << QList<double>{1.0};
  }
  /// Law: weights are relative, and equal ones give the bits of none.
  void equalWeightsChangeNothing() {
    QFETCH(QList<double>, weights);
    const Image content = picture();
    const Target plain = fitTarget(content, two().venue, {});
    const Target same = fitTarget(content, two().venue, weighing({weights.begin(), weights.end()}));
    QVERIFY(sameTargets(plain, same));
    QVERIFY(two().solved(Method::refined, plain).projector == two().solved(Method::refined, same).projector);
  }

  /// Law: only their ratio counts.
  void weightsAreRelative() {
    const Image content = picture();
    QVERIFY(sameTargets(fitTarget(content, two().venue, weighing({0.5, 0.125})),
                        fitTarget(content, two().venue, weighing({4.0, 1.0}))));
    const Target target = fitTarget(content, two().venue, weighing({0.5, 0.125}));
    QVERIFY(target.viewWeight == (std::vector<float>{1.0f, 0.25f}));
  }

  /// Law of weighted least squares: the more a view weighs, the nearer it comes to what it wants, and the
  /// further the other one is from that.
  void aViewGetsWhatItWeighs() {
    const Image content = picture();
    CompensatorSettings exact;
    exact.optimum.mostIterations = 3000;
    exact.optimum.tolerance = 1e-6;
    std::vector<double> first, second;
    // The white is that of the weights; here it is held so that all solve one problem.
    const Target fitted = fitTarget(content, two().venue, upsideDown());
    for (float weight : {0.0625f, 0.25f, 1.0f, 4.0f, 16.0f}) {
      Target target = fitted;
      for (std::size_t i = two().venue.transport.cameras().offset(1); i < target.weight.size(); ++i)
        target.weight[i] *= weight;
      const ProjectorStack p = two().solved(Method::optimum, target, exact).projector;
      first.push_back(squaresIn(fitted, p, 0));
      second.push_back(squaresIn(fitted, p, 1));
    }
    for (std::size_t i = 1; i < first.size(); ++i) {
      QVERIFY2(first[i] >= first[i - 1],
               qPrintable(QString("%1: %2 %3").arg(i).arg(first[i - 1]).arg(first[i])));
      QVERIFY2(second[i] <= second[i - 1],
               qPrintable(QString("%1: %2 %3").arg(i).arg(second[i - 1]).arg(second[i])));
    }
    QVERIFY(second.front() > 4.0 * second.back() && first.back() > 4.0 * first.front());
  }

  /// The method for video comes near what the weights ask for as well, although its windows know none.
  void refinedFollowsTheWeights() {
    const Image content = picture();
    for (double weight : {0.0, 0.25, 1.0}) {
      const Target target = fitTarget(content, two().venue, upsideDown(weight));
      const auto objective = [&](Method method) {
        const ProjectorStack p = two().solved(method, target).projector;
        return squaresIn(target, p, 0) + weight * squaresIn(target, p, 1);
      };
      const double best = objective(Method::optimum), video = objective(Method::refined),
                   windows = objective(Method::windows);
      qInfo("weight %g: windows %.3g, refined %.3g, optimum %.3g", weight, windows, video, best);
      QVERIFY(best <= 1.001 * video && video < windows);
    }
  }

  /// A view that asks for nothing decides over nothing: neither over white nor over which pixels shine.
  void aViewWithoutWeightIsNotAsked() {
    const MeasuredVenue& venue = two().venue;
    const Image content = picture();
    const Target target = fitTarget(content, venue, weighing({1.0, 0.0}));
    const MeasuredVenue first = stackedViews({makeScene({{50, 37}, {41, 29}, 2, 0.5, 1.2})});
    TargetSettings place;
    place.corners = target.corners;
    const Target alone = fitTarget(content, first, place);
    QCOMPARE(target.white[0], alone.white[0]);
    for (std::size_t i = 0; i < target.weight.size(); ++i)
      QCOMPARE(target.weight[i] > 0.0f, i < alone.weight.size() && alone.weight[i] > 0.0f);
    const auto brightestOf = [](const MeasuredVenue& of) {
      return brightestCorrespondence(of.transport, seesProjection(of), {});
    };
    const auto shines =
        contentCorrespondence(venue.transport, seesProjection(venue), target, brightestOf(venue), {});
    const auto expected =
        contentCorrespondence(first.transport, seesProjection(first), alone, brightestOf(first), {});
    QVERIFY(shines.free == expected.free);
    QVERIFY(shines.brightest == expected.brightest);
    QVERIFY(std::ranges::count(shines.free, 1) > 100);
  }

  /// Law: cameras that see a place which the first one does not have the same there, however it goes on.
  void placesBeyondTheFirstViewAreShared() {
    const Size projector{50, 37};
    std::vector<Scene> scenes;
    for (std::uint64_t seed : {2, 5, 6}) scenes.push_back(makeScene({projector, {41, 29}, seed, 0.5, 1.2}));
    MeasuredVenue venue = stackedViews(scenes);
    const std::size_t first = 41 * 29;
    for (std::size_t i = 0; i < first; ++i)
      if (pixelAt({41, 29}, i).x > 20) venue.usable[i] = 0;
    const ViewMap map = viewMap(venue.transport, venue.usable);
    Progress silent;
    const std::vector<DirectLook> looks = directLooks(venue.transport, {}, silent);
    // Where the second camera has what each projector pixel lights.
    std::vector<std::array<float, 2>> place(projector.count(), {std::nanf(""), 0.0f});
    for (std::size_t i = first; i < 2 * first; ++i)
      if (venue.usable[i] && looks[i].projectorPixel >= 0)
        place[static_cast<std::size_t>(looks[i].projectorPixel)] = map[i];
    std::vector<double> apart;
    for (std::size_t i = 2 * first; i < 3 * first; ++i) {
      if (!venue.usable[i] || looks[i].projectorPixel < 0) continue;
      const auto j = static_cast<std::size_t>(looks[i].projectorPixel);
      if (pixelAt(projector, j).x < 30 || std::isnan(place[j][0]) || std::isnan(map[i][0])) continue;
      apart.push_back(std::hypot(map[i][0] - place[j][0], map[i][1] - place[j][1]));
    }
    QVERIFY(apart.size() > 100);
    std::sort(apart.begin(), apart.end());
    qInfo("%zu places, median %.2f, 95 %% within %.2f pixels", apart.size(), apart[apart.size() / 2],
          apart[apart.size() * 95 / 100]);
    QVERIFY(apart[apart.size() * 95 / 100] < 1.0);  // half a pixel of each
  }

  void aPictureOfItsOwn_data() {
    QTest::addColumn<bool>("automatic");
    QTest::newRow("in corners") << false;
    QTest::newRow("where there is room") << true;
  }
  /// Law: in a view with a picture of its own lies what a calibration of that camera alone would place there.
  void aPictureOfItsOwn() {
    QFETCH(bool, automatic);
    const Image content = picture();
    TargetSettings settings = upsideDown(), alone;
    settings.fit = alone.fit = Fit::fit;
    if (automatic) settings.views[1].corners.reset();
    alone.corners = settings.views[1].corners;
    const Target target = fitTarget(content, two().venue, settings);
    const MeasuredVenue second = stackedViews({makeScene({{50, 37}, {33, 27}, 5, 0.5, 1.2})});
    const Target expected = fitTarget(content, second, alone);
    const std::size_t first = two().venue.transport.cameras().offset(1);
    QVERIFY(std::ranges::equal(expected.inside, std::span(target.inside).subspan(first)));
    QVERIFY(std::ranges::equal(expected.content, std::span(target.content).subspan(3 * first)));
    QVERIFY(target.placements[1]->corners == expected.corners);
    QVERIFY(std::ranges::count(expected.inside, 1) > 100);
  }

  /// A projector pixel shines if any view has it in its picture, and answers to the one that it lights most.
  void whatLiesInAnyPictureShines() {
    const MeasuredVenue& venue = two().venue;
    TargetSettings settings = weighing({1.0, 1.0});
    settings.corners = uprightCorners(2, 2, 16, 12);
    settings.views[1].placement = ViewPlacement::own;
    settings.views[1].corners = uprightCorners(18, 14, 12, 9);
    const Target target = fitTarget(picture(), venue, settings);
    const CameraMask sees = seesProjection(venue);
    const auto shines = contentCorrespondence(venue.transport, sees, target,
                                              brightestCorrespondence(venue.transport, sees, {}), {});
    std::array<int, 2> answers{};
    for (std::size_t j = 0; j < shines.free.size(); ++j) {
      if (shines.free[j] == 0) continue;
      const auto i = static_cast<std::size_t>(shines.brightest[j]);
      QVERIFY(target.inside[i]);
      ++answers[i >= venue.transport.cameras().offset(1)];
    }
    QVERIFY2(answers[0] > 50 && answers[1] > 50,
             qPrintable(QString("%1 %2").arg(answers[0]).arg(answers[1])));
  }

  /// Law: for whoever stands at a camera it is as if nearly that one alone asked, the others for a
  /// thousandth, and between two by the way; his weights are times those of the views.
  void aViewerWeighsTheViews() {
    TargetSettings settings = weighing({1.0, 0.5});
    settings.views[0].position = Position{0, 0, 0};
    settings.views[1].position = Position{2, 0, 0};
    const Image content = picture();
    settings.viewer = Position{0, 0, 0};
    QVERIFY(sameTargets(fitTarget(content, two().venue, settings),
                        fitTarget(content, two().venue, weighing({1.0, 1e-3 * 0.5 / 1.5}))));
    settings.viewer = Position{1, 0, 0};
    const std::vector<float> half = fitTarget(content, two().venue, settings).viewWeight;
    QVERIFY(half[0] == 1.0f && std::abs(half[1] - 0.5f) < 2e-3f);
    settings.viewer.reset();
    QVERIFY(sameTargets(fitTarget(content, two().venue, settings),
                        fitTarget(content, two().venue, weighing({1.0, 0.5}))));
  }

  void saysWhatIsWrong_data() {
    QTest::addColumn<int>("what");
    QTest::addColumn<QString>("says");
    QTest::newRow("a weight below 0") << 0 << "the weight of camera 2's view must be 0 or more";
    QTest::newRow("a weight that is no number") << 1 << "the weight of camera 1's view must be 0 or more";
    QTest::newRow("no weight at all") << 2 << "every view has the weight 0";
    QTest::newRow("a camera too many") << 3 << "the view of camera 3 is set, but there are 2 cameras";
    QTest::newRow("outside the view") << 4 << "lower right corner of camera 2's content at (99, 20)";
    QTest::newRow("crossed") << 5 << "camera 2: the corners of the content do not span a convex";
    QTest::newRow("of the first") << 6 << "the first camera's quadrilateral is that of the content";
    QTest::newRow("a viewer among unknown cameras") << 8 << "where camera 2 stands is not known";
    QTest::newRow("a viewer nowhere") << 9 << "the viewer's position must be finite numbers";
    QTest::newRow("a camera nowhere") << 10 << "the position of camera 1 must be finite numbers";
    QTest::newRow("an unlit view") << 7 << "no part of camera 2's view is lit well enough";
  }
  void saysWhatIsWrong() {
    QFETCH(int, what);
    QFETCH(QString, says);
    MeasuredVenue venue = two().venue;
    TargetSettings settings = weighing({1.0, 1.0});
    ViewSettings& second = settings.views[1];
    if (what == 0) second.weight = -0.5;
    if (what == 1) settings.views[0].weight = std::nan("");
    if (what == 2) settings = weighing({0.0, 0.0});
    if (what == 3) settings = weighing({1.0, 1.0, 1.0});
    if (what >= 8) settings.views[0].position = Position{0, 0, what == 10 ? HUGE_VAL : 0.0};
    if (what >= 8) settings.viewer = Position{0, what == 9 ? std::nan("") : 0.0, 0};
    if (what >= 4 && what < 8) second.placement = ViewPlacement::own;
    if (what == 4) second.corners = Corners{{{2, 2}, {30, 2}, {99, 20}, {2, 20}}};
    if (what == 5) second.corners = Corners{{{2, 2}, {30, 20}, {30, 2}, {2, 20}}};
    if (what == 6) settings.views[0].placement = ViewPlacement::own;
    if (what == 7)
      std::fill(venue.usable.begin() + static_cast<std::ptrdiff_t>(venue.transport.cameras().offset(1)),
                venue.usable.end(), std::uint8_t{0});
    std::string sentence;
    for (const Message& problem : problems(settings)) sentence += english(problem);
    if (sentence.empty())
      sentence = sentenceOf([&] { fitTarget(picture(), venue, settings); }, ErrorKind::input);
    QVERIFY(mentions(sentence, says.toStdString()));
  }

  /// Law: views that want the same of the same places do not contradict each other; one view never does.
  void agreeingViewsDoNotContradict() {
    const Scene scene = makeScene({{50, 37}, {41, 29}, 2, 0.5, 1.2});
    const Prepared twins(stackedViews({scene, scene})), one(stackedViews({scene}));
    Progress silent;
    for (const Prepared* prepared : {&twins, &one}) {
      TargetSettings settings;
      settings.corners = uprightCorners(8, 6, 24, 18);
      if (prepared == &twins) {
        settings.views.resize(2);
        settings.views[1] = {1.0, ViewPlacement::own, settings.corners, {}};
      }
      const Target target = fitTarget(picture(), prepared->venue, settings);
      const Compensator compensator(prepared->venue, prepared->inverse);
      const Contradiction found =
          contradictionOf(compensator, target, compensator.solve(Method::refined, target, silent), silent);
      QCOMPARE(found.share, 0.0);
      QCOMPARE(found.worse.size(), prepared->venue.transport.cameras().devices());
      for (const Image& view : found.worse)
        for (float value : view.data()) {
          QVERIFY(!(std::abs(value) > 0.01f));  // differences of roundings, as colours
          QVERIFY(prepared == &twins || std::isnan(value));
        }
      QVERIFY(viewNotes(prepared->venue, target, found).empty());
    }
  }

  /// Turned upside down the pictures contradict each other; whoever weighs more notices less of it.
  void contradictingViewsSaySo() {
    Progress silent;
    const Compensator compensator(two().venue, two().inverse);
    std::vector<Contradiction> found;
    for (double weight : {1.0, 8.0}) {
      const Target target = fitTarget(picture(), two().venue, upsideDown(weight));
      found.push_back(
          contradictionOf(compensator, target, compensator.solve(Method::refined, target, silent), silent));
      qInfo("weight %g: %.0f %% and %.0f %%", weight, 100 * found.back().shares[0],
            100 * found.back().shares[1]);
      const std::vector<Message> notes = viewNotes(two().venue, target, found.back());
      QCOMPARE(notes.size(), std::size_t{1});
      QVERIFY(mentions(english(notes[0]), "the views contradict each other"));
    }
    QVERIFY(found[0].share > 0.3);
    QVERIFY(found[1].shares[1] < found[0].shares[1] - 0.1 && found[1].shares[0] >= found[0].shares[0]);
    // As the map has it.
    std::size_t worse = 0, all = 0;
    for (const Image& view : found[0].worse)
      for (float value : view.data()) {
        all += !std::isnan(value);
        worse += value > visibleContradiction;
      }
    QCOMPARE(found[0].share, static_cast<double>(worse) / static_cast<double>(all));
    // A view that asks for nothing contradicts nobody.
    const Target silentView = fitTarget(picture(), two().venue, upsideDown(0.0));
    QCOMPARE(contradictionOf(compensator, silentView, compensator.solve(Method::refined, silentView, silent),
                             silent)
                 .share,
             0.0);
  }

  /// A camera that shares no lit place with the first sees no picture, and somebody is told.
  void aViewWithoutContentIsTold() {
    Prepared apart(two().venue);
    const Rasters& cameras = apart.venue.transport.cameras();
    QVERIFY(camerasApart(apart.venue.views, cameras).empty() && camerasApart({}, cameras).empty());
    // Half of the projector each.
    CameraMask halves = apart.venue.usable;
    for (std::size_t i = 0; i < halves.size(); ++i) {
      const std::size_t camera = i >= cameras.offset(1);
      const Pixel at = pixelAt(cameras.size(camera), i - cameras.offset(camera));
      const bool isLeft = 2 * at.x < cameras.size(camera).width;
      if (isLeft != (camera == 0) || std::abs(2 * at.x - cameras.size(camera).width) < 8) halves[i] = 0;
    }
    QCOMPARE(camerasApart(viewMap(apart.venue.transport, halves), cameras), std::vector<std::size_t>{1});
    apart.venue.views.assign(apart.venue.views.size(), {std::nanf(""), std::nanf("")});
    Progress silent;
    const Compensator compensator(apart.venue, apart.inverse);
    for (double weight : {1.0, 0.0}) {
      const Target target = fitTarget(picture(), apart.venue, weighing({1.0, weight}));
      const Contradiction found =
          contradictionOf(compensator, target, compensator.solve(Method::windows, target, silent), silent);
      const std::vector<Message> notes = viewNotes(apart.venue, target, found);
      QCOMPARE(notes.size(), weight > 0.0 ? std::size_t{1} : std::size_t{0});
      if (weight > 0.0) QVERIFY(mentions(english(notes[0]), "camera 2 sees none of the places"));
    }
  }
};

QTEST_GUILESS_MAIN(TestViewSettings)
#include "test_view_settings.moc"
