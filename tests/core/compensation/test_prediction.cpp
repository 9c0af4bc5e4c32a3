// SPDX-License-Identifier: MIT
#include "relucent/compensation/prediction.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::synthetic;

namespace {

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

}  // namespace

class TestPrediction : public QObject {
  Q_OBJECT

 private slots:
  /// What is predicted exactly has no error.
  void whatIsWantedHasNoError() {
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    Target target = fitTarget(Image({40, 30}, 3, 0.5f), venue, {});
    Compensation all{ProjectorStack(3 * scene.transport.projectors().count(), 0.3f), 0.25, 1};
    target.wanted = predict(venue, target, all).camera;
    Prediction again = predict(venue, target, all);
    QCOMPARE(again.meanDeltaE, 0.0);
    QVERIFY(std::isinf(again.psnrReachable));
    QCOMPARE(again.clipped, 0.25);
    QVERIFY(again.reachable > 0.5 && again.reachable <= 1.0);
  }

  void blackProjectsBlack() {
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    Target target = fitTarget(Image({40, 30}, 3, 1.0f), venue, {});
    Compensation dark{ProjectorStack(3 * scene.transport.projectors().count(), 0.0f), 0.0, 0};
    Prediction prediction = predict(venue, target, dark);
    QVERIFY(prediction.camera == venue.black);
    for (std::size_t i = 0; i < target.inside.size(); ++i) {
      QCOMPARE(std::isnan(prediction.deltaE.data()[i]), target.inside[i] == 0);
      // White against next to nothing: a lightness difference of nearly a hundred.
      if (target.inside[i]) QVERIFY(prediction.deltaE.data()[i] > 80.0f);
    }
    QVERIFY(prediction.meanDeltaE > 80.0 && prediction.meanDeltaE <= 100.0);
  }

  void noContentHasNoFigures() {
    Scene scene = makeScene({});
    MeasuredVenue venue = venueOf(scene);
    Target target = fitTarget(Image({40, 30}, 3, 1.0f), venue, {});
    std::fill(target.inside.begin(), target.inside.end(), std::uint8_t{0});
    std::fill(target.reachable.begin(), target.reachable.end(), std::uint8_t{0});
    Compensation dark{ProjectorStack(3 * scene.transport.projectors().count(), 0.0f), 0.0, 0};
    Prediction prediction = predict(venue, target, dark);
    QCOMPARE(prediction.meanDeltaE, 0.0);
    QCOMPARE(prediction.reachable, 0.0);
    QVERIFY(std::isnan(prediction.psnrReachable));
  }
};

QTEST_APPLESS_MAIN(TestPrediction)
#include "test_prediction.moc"
