// SPDX-License-Identifier: MIT
#include <QtTest>

#include "acquisition_run.h"
#include "relucent/acquisition/scheme.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

Venue venueFor(const QString& mode) {
  Venue venue = smallVenue();
  std::uint64_t seed = venue.settings.seed;
  venue.settings = settingsOf(parsedName<AcquisitionMode>(mode.toStdString(), ErrorKind::usage));
  venue.settings.seed = seed;
  return venue;
}

}  // namespace

class TestSchemes : public QObject {
  Q_OBJECT

 private slots:
  void everySchemeRecoversANoiselessTransport_data() {
    QTest::addColumn<QString>("mode");
    QTest::addColumn<bool>("white");
    for (const std::string& mode : allNames<AcquisitionMode>())
      for (bool white : {false, true}) {
        if (white && mode == nameOf(AcquisitionMode::multiplexed)) continue;  // its colours are by chance
        QTest::addRow("%s %s", mode.c_str(), white ? "white" : "rgb")
            << QString::fromStdString(mode) << white;
      }
  }
  void densePatternsAreNotWhite() {
    AcquisitionSettings settings = settingsOf(AcquisitionMode::multiplexed);
    QVERIFY(problems(settings).empty());
    settings.colours = LitColours::white;
    QCOMPARE(problems(settings).size(), std::size_t{1});
  }
  /// Without far field or noise all of them end with what their threshold leaves: as for adaptive, 160 times
  /// it. Sen's threshold is the same for all pixels, so dim rows lose more; where rows hold a fifth of the
  /// typical light, five times as much.
  void everySchemeRecoversANoiselessTransport() {
    QFETCH(QString, mode);
    QFETCH(bool, white);
    Venue venue = venueFor(mode);
    venue.synthetic.interreflection = 0.0;
    venue.settings.relativeThreshold = 1e-4;
    venue.settings.colours = white ? LitColours::white : LitColours::rgb;
    Run run(venue);
    Acquisition a = run();
    QVERIFY2(difference(a.transport, run.truth).frobenius < 5 * 160 * 1e-4, qPrintable(shown(a, run.truth)));
  }

  void senAddsWhatLeavesSend() {
    Acquisition sen = Run(venueFor("sen"))(), adaptive = Run(venueFor("adaptive"))();
    Run run(venueFor("sen"));
    // The energy of stored leaves is counted again in every frame that lights them.
    QVERIFY2(energyOf(sen.transport) > 1.01 * energyOf(adaptive.transport),
             qPrintable(shown(sen, run.truth)));
    QVERIFY2(sen.unresolvedEnergy < -0.01, qPrintable(shown(sen, run.truth)));
    // All exposures, every time, but for verification.
    QVERIFY(sen.exposures >= 2 * (sen.patterns - AcquisitionSettings().verificationPatterns));
  }

  void fastIsCheapAndStillClose() {
    Venue venue = venueFor("fast");
    venue.noise = 1e-3;
    Run run(venue);
    Acquisition fast = run();
    Venue fine = smallVenue();
    fine.noise = 1e-3;
    Acquisition adaptive = Run(fine)();
    QVERIFY2(3 * fast.exposures < 2 * adaptive.exposures, qPrintable(shown(fast, run.truth)));
    QCOMPARE(fast.exposures, fast.patterns);
    ProjectorStack pattern(naturalPattern(run.truth.projectors()));
    QVERIFY2(relativeError(fast.transport.apply(pattern), run.truth.apply(pattern)) < 0.05,
             qPrintable(shown(fast, run.truth)));
  }

  void whiteIsSharedAsTheFloodSays() {
    ColourBlock flood, variance = ColourBlock::Constant(1e-6f);
    flood << 6, 3, 1, 1, 8, 1, 0, 0, 0;
    ColourBlock shares = channelShares({true, true, true}, flood, variance);
    QCOMPARE(shares(0, 0), 0.6f);
    QCOMPARE(shares(1, 1), 0.8f);
    for (int c = 0; c < 3; ++c) QVERIFY(std::abs(shares.row(c).sum() - 1.0f) < 1e-6f);
    QCOMPARE(shares(2, 0), 1.0f / 3.0f);  // nothing known
    ColourBlock green = channelShares({false, true, false}, flood, variance);
    QCOMPARE(green(0, 1), 1.0f);
    QCOMPARE(green(0, 0), 0.0f);
  }

  /// Lamps that warm up and blacks that change are followed: the error stays what it is without.
  void driftIsFollowed_data() {
    QTest::addColumn<double>("drift");
    QTest::newRow("fading") << -0.2;
    QTest::newRow("warming up") << 0.2;
  }
  void driftIsFollowed() {
    QFETCH(double, drift);
    Venue steady = smallVenue(), drifting = smallVenue();
    steady.noise = drifting.noise = 2e-4;
    drifting.drift = drift;
    Run first(steady), second(drifting);
    Acquisition a = first(), b = second();
    double before = difference(a.transport, first.truth).frobenius;
    double after = difference(b.transport, second.truth).frobenius;
    qInfo("error %.4f, with drift %.4f, %d patterns", before, after, b.patterns);
    // The floods come from the first 16 shots, on average at shot 8: that much stays.
    QVERIFY2(after < before + std::abs(drift) * 0.02, qPrintable(shown(b, second.truth)));
  }

  void theNoiseOfLeavesIsReported() {
    Venue quiet = smallVenue(), noisy = smallVenue();
    quiet.noise = 5e-4;
    noisy.noise = 4e-3;
    Acquisition a = Run(quiet)(), b = Run(noisy)();
    double before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < a.leafVariance.size(); ++i) {
      QVERIFY(a.leafVariance[i] >= 0.0f);
      before += static_cast<double>(a.leafVariance[i]);
      after += static_cast<double>(b.leafVariance[i]);
    }
    // Unevenness of lit leaves, the same in both, is part of it.
    QVERIFY2(after > 2.0 * before, qPrintable(QString("%1 and %2").arg(before).arg(after)));
  }

  void residualMapsAreKeptForEveryBlockSize() {
    Venue venue = smallVenue();
    venue.noise = 1e-3;
    Acquisition a = Run(venue)();
    QCOMPARE(a.residual.size(), std::size_t{4});
    for (const Stack& map : a.residual) {
      QCOMPARE(map.size(), a.flood.size());
      QVERIFY(*std::max_element(map.begin(), map.end()) > 0.0f);
    }
  }
};

QTEST_APPLESS_MAIN(TestSchemes)
#include "test_schemes.moc"
