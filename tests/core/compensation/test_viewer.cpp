// SPDX-License-Identifier: MIT
#include "relucent/compensation/viewer.h"

#include <QtTest>
#include <cmath>

#include "relucent/base/random.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using Time = MovingViewer::Time;

namespace {

/// Three round a statue, metres: from the front, from the left and from the right.
const std::vector<Position> round3{{0.0, 0.1, 2.4}, {-1.77, 0.1, 1.67}, {1.77, 0.1, 1.67}};

Position between(const Position& a, const Position& b, double share) {
  Position p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = (1.0 - share) * a[k] + share * b[k];
  return p;
}

void areClose(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  QCOMPARE(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    QVERIFY2(std::abs(a[i] - b[i]) <= tolerance, qPrintable(QString("%1: %2 %3").arg(i).arg(a[i]).arg(b[i])));
}

std::vector<Position> scattered(std::size_t count, std::uint64_t seed, bool flat) {
  Random random{seed};
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i)
    positions.push_back(
        {6.0 * random.uniform() - 3.0, 6.0 * random.uniform() - 3.0, flat ? 0.0 : 2.0 * random.uniform()});
  return positions;
}

}  // namespace

class TestViewer : public QObject {
  Q_OBJECT

 private slots:
  /// Law: where a camera stands, it alone counts.
  void atACameraItAloneCounts() {
    for (std::size_t count : {2u, 3u, 7u})
      for (bool flat : {true, false}) {
        const std::vector<Position> cameras = scattered(count, count, flat);
        for (std::size_t c = 0; c < count; ++c) {
          std::vector<double> expected(count, 0.0);
          expected[c] = 1.0;
          QVERIFY(viewerWeights(cameras, cameras[c]) == expected);
        }
      }
  }

  /// Law: on the way from one camera to its neighbour these two count, by the way that is gone.
  void betweenTwoTheyCountByTheWay() {
    for (double share : {0.1, 0.25, 0.5, 0.8}) {
      areClose(viewerWeights(round3, between(round3[0], round3[1], share)), {1.0 - share, share, 0.0}, 2e-3);
      const std::vector<Position> row{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
      areClose(viewerWeights(row, {share, 0, 0}), {1.0 - share, share, 0.0}, 2e-3);
    }
  }

  /// Law: within the cameras' hull the weights reproduce the viewer's place; outside, the hull's nearest one.
  void weightsReproduceThePlace() {
    Random random{5};
    for (bool flat : {true, false}) {
      const std::vector<Position> cameras = scattered(8, 3, flat);
      for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> mixture(cameras.size());
        double sum = 0.0;
        for (double& each : mixture) sum += each = random.uniform();
        Position within{};
        for (std::size_t c = 0; c < cameras.size(); ++c)
          for (std::size_t k = 0; k < 3; ++k) within[k] += mixture[c] / sum * cameras[c][k];
        const std::vector<double> weights = viewerWeights(cameras, within);
        Position made{};
        double all = 0.0;
        for (std::size_t c = 0; c < cameras.size(); ++c) {
          QVERIFY(weights[c] >= 0.0);
          all += weights[c];
          for (std::size_t k = 0; k < 3; ++k) made[k] += weights[c] * cameras[c][k];
        }
        QVERIFY(std::abs(all - 1.0) < 1e-9);
        // The lift draws it by a thousandth of the cameras' distance at the most.
        for (std::size_t k = 0; k < 3; ++k) QVERIFY(std::abs(made[k] - within[k]) < 0.01);
      }
    }
    // Opposite to the statue, beyond, and far beyond the row of cameras.
    areClose(viewerWeights(round3, {0.0, 0.1, 9.0}), {1.0, 0.0, 0.0}, 1e-3);
    areClose(viewerWeights(round3, {-5.0, 0.1, 1.0}), {0.0, 1.0, 0.0}, 1e-3);
    areClose(viewerWeights(round3, {1e4, 0.1, -1e3}), {0.0, 0.0, 1.0}, 1e-3);
  }

  /// Law: metres or millimetres, whichever axes and origin: the weights are the same.
  void unitsAndAxesDoNotMatter() {
    const Position viewer{-0.7, 0.3, 2.0};
    const std::vector<double> expected = viewerWeights(round3, viewer);
    const auto changed = [](const Position& p) {
      return Position{1000.0 * p[2] + 4e3, -1000.0 * p[0], 1000.0 * p[1] - 2e3};
    };
    std::vector<Position> cameras;
    for (const Position& camera : round3) cameras.push_back(changed(camera));
    areClose(viewerWeights(cameras, changed(viewer)), expected, 1e-6);
  }

  /// Law: a small step changes little.
  void weightsAreContinuous() {
    for (bool flat : {true, false}) {
      const std::vector<Position> cameras = scattered(7, 9, flat);
      std::vector<double> before;
      double most = 0.0;
      for (int step = 0; step <= 4000; ++step) {
        const double angle = step * 1.571e-3;
        const std::vector<double> weights =
            viewerWeights(cameras, {3.5 * std::cos(angle), 2.0 * std::sin(3.0 * angle), flat ? 0.0 : 1.0});
        for (std::size_t c = 0; c < before.size(); ++c)
          most = std::max(most, std::abs(weights[c] - before[c]));
        before = weights;
      }
      qInfo("%.4f at the most in a step of 1 cm", most);
      QVERIFY(most < 0.1);
    }
  }

  void camerasAtOnePlaceShare() {
    areClose(viewerWeights(std::vector<Position>(2, {1, 2, 3}), {5, 6, 7}), {0.5, 0.5}, 0.0);
    areClose(viewerWeights(std::vector<Position>(1, {1, 2, 3}), {5, 6, 7}), {1.0}, 0.0);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, viewerWeights({}, {0, 0, 0}));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, viewerWeights(round3, {std::nan(""), 0, 0}));
  }

  /// Law: a position holds from the moment when it is told until nobody spoke for two seconds; then it glides
  /// to the sweet spot without a jump, and another word is heard at once.
  void aSilentViewerGoesHome() {
    const Position home{0.0, 0.0, 2.0}, there{3.0, -1.0, 2.5};
    MovingViewer viewer(home);
    QVERIFY(viewer.at(Time(100.0)) == home);
    QVERIFY(viewer.moveTo(there, Time(10.0)));
    for (double now : {10.0, 11.0, 12.0}) QVERIFY(viewer.at(Time(now)) == there);
    double before = 1.0;
    for (double now = 12.0; now < 20.0; now += 0.01) {
      const Position at = viewer.at(Time(now));
      const double left = at[0] / 3.0;
      QVERIFY(left <= before && before - left < 0.0101);
      QVERIFY(std::abs(at[1] + left) < 1e-9 && std::abs(at[2] - 2.0 - 0.5 * left) < 1e-9);
      before = left;
    }
    QVERIFY(before < 1e-3);
    QVERIFY(std::abs(viewer.at(Time(13.0))[0] - 3.0 * std::exp(-1.0)) < 1e-9);
    QVERIFY(viewer.moveTo({1.0, 1.0, 1.0}, Time(13.0)));
    QVERIFY((viewer.at(Time(13.0)) == Position{1.0, 1.0, 1.0}));
    QVERIFY(!viewer.moveTo({1.0, std::nan(""), 1.0}, Time(13.1)));
    QVERIFY((viewer.at(Time(13.2)) == Position{1.0, 1.0, 1.0}));
  }

  /// Law: how much the last position holds is 1, falls without a jump that anybody sees, and is 0 in the end.
  void presenceOfAViewer() {
    MovingViewer viewer;
    QVERIFY(viewer.presence(Time(5.0)) == 0.0 && !viewer.last());
    viewer.moveTo({1.0, 2.0, 3.0}, Time(10.0));
    QVERIFY(viewer.presence(Time(12.0)) == 1.0 && viewer.last() == Position({1.0, 2.0, 3.0}));
    QVERIFY(std::abs(viewer.presence(Time(13.0)) - std::exp(-1.0)) < 1e-12);
    QVERIFY(viewer.presence(Time(18.9)) >= 1e-3 && viewer.presence(Time(18.92)) == 0.0);
    viewer.moveTo({1.0, 2.0, 3.0}, Time(20.0));
    QVERIFY(viewer.presence(Time(20.0)) == 1.0);
    viewer.leave();
    QVERIFY(viewer.presence(Time(20.0)) == 0.0);
  }

  /// Law: whoever stands among the cameras, or as far from them as they from each other, is meant; who stands
  /// where other units would have him is not. The same in every unit.
  void viewersFarFromAllCamerasAreTold() {
    for (const double unit : {1.0, 1e-3, 1e6}) {
      const std::vector<Position> cameras{{0, 0, 0}, {3 * unit, 0, 0}, {0, 2 * unit, 0}};
      QVERIFY(farFromCameras(cameras, {unit, unit, 0}).empty());
      QVERIFY(farFromCameras(cameras, {-3.6 * unit, 0, 0}).empty());
      QVERIFY(farFromCameras(cameras, {0, 0, 7.2 * unit}).empty());
      QVERIFY(mentions(english(farFromCameras(cameras, {0, 0, 7.3 * unit})), "from the nearest camera"));
    }
    QVERIFY(mentions(
        english(farFromCameras(std::vector<Position>{{0, 0, 0}, {3, 0, 0}}, {-150, 0, 0})),
        "the viewer stands 150 from the nearest camera, and no two cameras stand further apart than 3"));
    QVERIFY(farFromCameras(std::vector<Position>(2, {1, 2, 3}), {100, 0, 0}).empty());
  }

  void motionThatCannotBe() {
    QVERIFY(problems(ViewerMotionSettings()).empty());
    const std::vector<Message> found = problems(ViewerMotionSettings{Time(-1.0), Time(0.0)});
    QCOMPARE(found.size(), std::size_t{2});
    QVERIFY(mentions(english(found[0]), "0 s or more") && mentions(english(found[1]), "more than 0 s"));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, MovingViewer({0, 0, 0}, {Time(-1.0), Time(1.0)}));
  }
};

QTEST_APPLESS_MAIN(TestViewer)
#include "test_viewer.moc"
