// SPDX-License-Identifier: MIT
#include "relucent/compensation/row_trust.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/stacks.h"
#include "relucent/transport/transport_matrix.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::synthetic;

namespace {

MeasuredVenue venueOf(const Scene& scene) {
  return {scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
}

TransportVariance varianceOf(const MeasuredVenue& venue, float black, float flood, float leaf) {
  const std::size_t values = venue.flood.size();
  return {CameraStack(values, black), CameraStack(values, flood), CameraStack(values, leaf)};
}

constexpr float least = 0.35f;

double meanOf(const std::vector<float>& values) {
  return std::reduce(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

class TestRowTrust : public QObject {
  Q_OBJECT

 private slots:
  /// Blocks of several pixels leave what is in them unresolved, single pixels without noise nothing.
  void whatIsKnownExactlyIsTrusted() {
    SceneSettings settings;
    settings.farField = 0.0;
    const MeasuredVenue venue = venueOf(makeScene(settings));
    for (float trust : trustIn(venue, varianceOf(venue, 0.0f, 0.0f, 0.0f))) QCOMPARE(trust, 1.0f);
  }

  void noiseCostsTrust_data() {
    QTest::addColumn<float>("black");
    QTest::addColumn<float>("flood");
    QTest::addColumn<float>("leaf");
    QTest::newRow("of black") << 1e-5f << 0.0f << 0.0f;
    QTest::newRow("of the flood") << 0.0f << 1e-4f << 0.0f;
    QTest::newRow("of leaves") << 0.0f << 0.0f << 1e-3f;
    QTest::newRow("of all") << 1e-5f << 1e-4f << 1e-3f;
  }
  void noiseCostsTrust() {
    QFETCH(float, black);
    QFETCH(float, flood);
    QFETCH(float, leaf);
    const MeasuredVenue venue = venueOf(makeScene({}));
    const std::vector<float> known = trustIn(venue, varianceOf(venue, 0.0f, 0.0f, 0.0f)),
                             noisy = trustIn(venue, varianceOf(venue, black, flood, leaf)),
                             noisier = trustIn(venue, varianceOf(venue, 4 * black, 4 * flood, 4 * leaf));
    for (std::size_t i = 0; i < noisy.size(); ++i) {
      QVERIFY(noisier[i] >= least && noisier[i] <= noisy[i] && noisy[i] <= known[i] && known[i] <= 1.0f);
      QVERIFY(venue.usable[i] == 0 || noisier[i] < noisy[i] || noisier[i] == least);
    }
    QVERIFY(meanOf(noisier) < meanOf(noisy) && meanOf(noisy) < meanOf(known));
  }

  /// Law: where all is doubtful, all counts alike.
  void nothingDecidesAloneWhereAllIsDoubtful() {
    const MeasuredVenue venue = venueOf(makeScene({}));
    for (float trust : trustIn(venue, varianceOf(venue, 1.0f, 1.0f, 1.0f))) QCOMPARE(trust, least);
  }

  /// Another exposure's units are no other doubts.
  void unitsOfLightDoNotCount() {
    const Scene scene = makeScene({});
    const MeasuredVenue venue = venueOf(scene);
    constexpr float unit = 8.0f;
    MeasuredVenue brighter = venue;
    brighter.transport = transport::rescaledToFloodlight(
        scene.transport, compensation::stackOf<CameraStack>(
                             venue.flood.size(), [&](std::size_t i) { return unit * venue.flood[i]; }));
    for (float& value : brighter.black) value *= unit;
    for (float& value : brighter.flood) value *= unit;
    const std::vector<float> one = trustIn(venue, varianceOf(venue, 1e-5f, 1e-4f, 1e-3f)),
                             other = trustIn(brighter, varianceOf(venue, unit * unit * 1e-5f,
                                                                  unit * unit * 1e-4f, unit * unit * 1e-3f));
    for (std::size_t i = 0; i < one.size(); ++i)  // T is rescaled in single precision
      QVERIFY2(std::abs(one[i] - other[i]) < 1e-3f, qPrintable(QString("%1, %2").arg(one[i]).arg(other[i])));
  }

  void nothingIsSaidOfWhatIsNotKnown() {
    MeasuredVenue venue = venueOf(makeScene({}));
    TransportVariance imported = varianceOf(venue, 1e-5f, 1e-4f, 0.0f);
    imported.leaf.clear();
    QVERIFY(trustIn(venue, imported).empty());
    std::ranges::fill(venue.usable, 0);
    QVERIFY(trustIn(venue, varianceOf(venue, 1e-5f, 1e-4f, 1e-3f)).empty());
  }

  /// In the windows and in the steps, whatever is asked for.
  void weightsOfATargetGoWithTrust_data() {
    QTest::addColumn<Objective>("objective");
    QTest::newRow("as seen") << Objective::seen;
    QTest::newRow("of light") << Objective::light;
  }
  void weightsOfATargetGoWithTrust() {
    QFETCH(Objective, objective);
    MeasuredVenue venue = venueOf(makeScene({}));
    TargetSettings settings;
    settings.objective = objective;
    const image::Image content({40, 30}, 3, 0.5f);
    const Target believed = fitTarget(content, venue, settings);
    for (std::size_t i = 0; i < venue.usable.size(); ++i)
      venue.trust.push_back(0.25f * static_cast<float>(1 + i % 4));
    const Target doubted = fitTarget(content, venue, settings);
    for (std::size_t i = 0; i < venue.usable.size(); ++i) {
      QCOMPARE(doubted.weight[i], venue.trust[i] * believed.weight[i]);
      QCOMPARE(doubted.windowsWeight[i], venue.trust[i] * believed.windowsWeight[i]);
      QCOMPARE(doubted.wanted[3 * i], believed.wanted[3 * i]);
    }
  }
};

QTEST_APPLESS_MAIN(TestRowTrust)
#include "test_row_trust.moc"
