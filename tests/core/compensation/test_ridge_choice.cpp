// SPDX-License-Identifier: MIT
#include "relucent/compensation/ridge_choice.h"

#include <QtTest>
#include <algorithm>

#include "core/inverse/synthetic_transport.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

Progress quiet;

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

}  // namespace

class TestRidgeChoice : public QObject {
  Q_OBJECT

 private slots:
  void theBestOfTheTrialsIsTaken_data() {
    QTest::addColumn<double>("softest");
    QTest::addColumn<double>("start");
    for (double softest : {0.4, 1.5})
      for (double start : {0.02, 0.4, 4.0})
        QTest::addRow("defocus %g, from %g", softest, start) << softest << start;
  }
  void theBestOfTheTrialsIsTaken() {
    QFETCH(double, softest);
    QFETCH(double, start);
    SceneSettings s;
    s.softest = softest;
    Scene scene = makeScene(s);
    WindowSettings settings;
    settings.ridge = start;
    RidgeChoice choice = chooseRidge(venueOf(scene), settings, quiet);

    QVERIFY(choice.curve.size() >= 2);
    auto best = std::max_element(choice.curve.begin(), choice.curve.end(),
                                 [](const auto& a, const auto& b) { return a.psnr < b.psnr; });
    double largest = 0.0;
    for (std::size_t i = 0; i < choice.curve.size(); ++i) {
      if (i > 0) QCOMPARE(choice.curve[i].ridge, 2.0 * choice.curve[i - 1].ridge);
      if (choice.curve[i].psnr >= best->psnr - 0.1) largest = choice.curve[i].ridge;
    }
    QCOMPARE(choice.ridge, largest);
    settings.ridge = choice.ridge;
    QVERIFY(choice.inverse == computeWindows(scene.transport, scene.usable, settings, quiet));
    // The search ends beyond a maximum, or where it may go no further.
    bool above = best + 1 != choice.curve.end() || best->ridge >= 15.9 * start;
    bool below = best != choice.curve.begin() || best->ridge <= start / 15.9;
    QVERIFY2(above || below, qPrintable(QString::number(best->ridge)));
  }

  /// Law: where the ridge is tried in places only, it is as good everywhere as what would have been found
  /// there, within what is taken for equal, and the windows are those of that ridge.
  void triedInPlaces_data() {
    QTest::addColumn<double>("softest");
    QTest::addColumn<quint64>("seed");
    QTest::newRow("sharp") << 0.4 << quint64{1};
    QTest::newRow("defocused") << 1.5 << quint64{2};
  }
  void triedInPlaces() {
    QFETCH(double, softest);
    QFETCH(quint64, seed);
    SceneSettings s;
    s.softest = softest;
    s.seed = seed;
    s.projector = {160, 120};
    s.camera = {208, 156};
    const Scene scene = makeScene(s);
    const RidgeChoice everywhere = chooseRidge(venueOf(scene), {}, quiet),
                      inPlaces = chooseRidge(venueOf(scene), {}, quiet, 300);
    QVERIFY(!(inPlaces.curve == everywhere.curve));
    const auto psnr = [&](double ridge) {
      const auto trial = std::ranges::find(everywhere.curve, ridge, &RidgeTrial::ridge);
      return trial == everywhere.curve.end() ? 0.0 : trial->psnr;
    };
    const double best = std::ranges::max(everywhere.curve, {}, &RidgeTrial::psnr).psnr;
    // Twice of what counts as equal: once for each of the two curves.
    QVERIFY2(psnr(inPlaces.ridge) > best - 0.2,
             qPrintable(QString("%1 dB of %2").arg(psnr(inPlaces.ridge)).arg(best)));
    WindowSettings settings;
    settings.ridge = inPlaces.ridge;
    QVERIFY(inPlaces.inverse == computeWindows(scene.transport, scene.usable, settings, quiet));
  }

  void sameChoiceEveryTime() {
    Scene scene = makeScene({});
    RidgeChoice first = chooseRidge(venueOf(scene), {}, quiet);
    RidgeChoice second = chooseRidge(venueOf(scene), {}, quiet);
    QCOMPARE(first.ridge, second.ridge);
    QVERIFY(first.curve == second.curve && first.inverse == second.inverse);
  }

  void darkVenuesKeepTheRidge() {
    Scene scene = makeScene({});
    std::fill(scene.usable.begin(), scene.usable.end(), std::uint8_t{0});
    WindowSettings settings;
    settings.ridge = 0.7;
    RidgeChoice choice = chooseRidge(venueOf(scene), settings, quiet);
    QCOMPARE(choice.ridge, 0.7);
    QVERIFY(choice.curve.empty());
  }

  void cancels() {
    Stopped stopped;
    Scene scene = makeScene({});
    QVERIFY_EXCEPTION_THROWN(chooseRidge(venueOf(scene), {}, stopped), Cancelled);
  }
};

QTEST_APPLESS_MAIN(TestRidgeChoice)
#include "test_ridge_choice.moc"
