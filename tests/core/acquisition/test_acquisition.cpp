// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <QtTest>

#include "acquisition_run.h"
#include "relucent/base/message.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

class TestAcquisition : public QObject {
  Q_OBJECT

 private slots:
  void noiselessRecoveryIsExact_data() {
    QTest::addColumn<QList<QSize>>("projectors");
    QTest::addColumn<QList<QSize>>("cameras");
    QTest::addColumn<double>("interreflection");
    QTest::newRow("powers of two") << QList<QSize>{{32, 32}} << QList<QSize>{{16, 16}} << 0.0;
    QTest::newRow("odd sizes, far field") << QList<QSize>{{29, 19}} << QList<QSize>{{20, 15}} << 0.3;
    QTest::newRow("a row of pixels") << QList<QSize>{{17, 2}} << QList<QSize>{{9, 3}} << 0.0;
    QTest::newRow("two projectors, two cameras")
        << QList<QSize>{{24, 16}, {9, 13}} << QList<QSize>{{12, 9}, {7, 10}} << 0.2;
  }
  /// What stays is the threshold: a leaf above pixels holds at most tau, which its block may hold unevenly.
  /// With at most some dozen such leaves a row (three a level), each wrong by tau at most, and a row's
  /// norm about F over its footprint: 40 * tau / (F / 4) = 160 times the relative threshold.
  void noiselessRecoveryIsExact() {
    QFETCH(QList<QSize>, projectors);
    QFETCH(QList<QSize>, cameras);
    QFETCH(double, interreflection);
    Venue venue;
    venue.synthetic.projectors.clear();
    venue.synthetic.cameras.clear();
    for (QSize size : projectors) venue.synthetic.projectors.push_back({size.width(), size.height()});
    for (QSize size : cameras) venue.synthetic.cameras.push_back({size.width(), size.height()});
    venue.synthetic.interreflection = interreflection;
    venue.settings.relativeThreshold = 1e-4;
    venue.settings.references = 1;
    Run run(venue);
    Acquisition a = run();
    QVERIFY2(difference(a.transport, run.truth).frobenius < 160 * 1e-4, qPrintable(shown(a, run.truth)));
    QVERIFY2(a.verificationError < 160 * 1e-4, qPrintable(shown(a, run.truth)));
    QVERIFY2(std::abs(a.unresolvedEnergy) < 1e-3, qPrintable(shown(a, run.truth)));
    QVERIFY(relativeError(a.flood, run.truth.floodlight()) < 1e-4);
    QCOMPARE(flaggedIn(a), std::size_t{0});
    QVERIFY(a.findings.empty());
  }

  void noiseAndThresholdBoundTheError_data() {
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("interreflection");
    QTest::newRow("quiet") << 2e-4 << 0.0;
    QTest::newRow("quiet, far field") << 2e-4 << 0.3;
    QTest::newRow("noisy, far field") << 2e-3 << 0.3;
  }
  /// Per value the noise of a frame against its light: sigma / (t F), the bright pixels' F t being about 0.3;
  /// a row sums some dozen values. To that comes the threshold, a few times 0.008.
  void noiseAndThresholdBoundTheError() {
    QFETCH(double, noise);
    QFETCH(double, interreflection);
    Venue venue = smallVenue();
    venue.noise = noise;
    venue.synthetic.interreflection = interreflection;
    Run run(venue);
    Acquisition a = run();
    double bound = 0.03 + 30.0 * noise;
    QVERIFY2(difference(a.transport, run.truth).frobenius < bound, qPrintable(shown(a, run.truth)));
    QVERIFY2(a.verificationError < bound, qPrintable(shown(a, run.truth)));
    for (const ProjectorStack& pattern :
         {naturalPattern(run.truth.projectors()), randomPattern(run.truth.projectors())}) {
      double error = relativeError(a.transport.apply(pattern), run.truth.apply(pattern));
      QVERIFY2(error < bound, qPrintable(QString("relighting %1; ").arg(error) + shown(a, run.truth)));
    }
  }

  void energyIsUnbiased_data() {
    QTest::addColumn<double>("interreflection");
    QTest::addColumn<double>("threshold");
    QTest::newRow("no far field") << 0.0 << 0.008;
    QTest::newRow("far field") << 0.3 << 0.008;
    QTest::newRow("strong far field") << 1.5 << 0.008;
    QTest::newRow("strong far field, coarse") << 1.5 << 0.03;
  }
  /// 300 pixels with a noise of some per cent each: the mean is known to a few tenths of a per cent.
  void energyIsUnbiased() {
    QFETCH(double, interreflection);
    QFETCH(double, threshold);
    Venue venue = smallVenue();
    venue.noise = 1e-3;
    venue.synthetic.interreflection = interreflection;
    venue.settings.relativeThreshold = threshold;
    Run run(venue);
    Acquisition a = run();
    QVERIFY2(std::abs(energyOf(a.transport) / energyOf(run.truth) - 1.0) < 0.01,
             qPrintable(shown(a, run.truth)));
    QVERIFY2(std::abs(a.unresolvedEnergy) < 0.01, qPrintable(shown(a, run.truth)));
  }

  void killedAtAnyShotAndResumedIsIdentical_data() {
    QTest::addColumn<int>("shot");
    for (int shot : {0, 5, 40, 100}) QTest::addRow("shot %d", shot) << shot;
  }
  void killedAtAnyShotAndResumedIsIdentical() {
    QFETCH(int, shot);
    Venue venue = smallVenue();
    venue.noise = 1e-3;
    Acquisition whole = Run(venue)();

    SilentSink sink;
    StopRequest stop;
    MemoryLog log;
    Venue killed = venue;
    killed.beforeCapture = [&](const CaptureRequest& request) {
      if (request.shot.number == shot) stop.ask(StopRequest::Kind::cancel);
    };
    Run first(killed);
    QVERIFY_EXCEPTION_THROWN(first(log, Progress(sink, stop)), Cancelled);
    QVERIFY(static_cast<int>(log.shots.size()) <= shot + 1);

    int taken = 0;
    Venue resumed = venue;
    resumed.beforeCapture = [&](const CaptureRequest& request) { taken += request.exposure == 0; };
    Acquisition again = Run(resumed)(log);
    QVERIFY(again.transport == whole.transport);
    QVERIFY(again.black == whole.black && again.flood == whole.flood && again.flagged == whole.flagged);
    QCOMPARE(again.patterns, whole.patterns);
    QCOMPARE(again.exposures, whole.exposures);
    QVERIFY(taken >= whole.patterns - shot - 1 && taken <= whole.patterns);
  }

  void stopAndKeepIsAValidCoarserTransport_data() {
    QTest::addColumn<QString>("stage");
    QTest::newRow("before the tree") << "black";
    QTest::newRow("in level 1") << "level 1";
    QTest::newRow("in level 3") << "level 3";
  }
  void stopAndKeepIsAValidCoarserTransport() {
    QFETCH(QString, stage);
    Venue venue = smallVenue();
    venue.synthetic.projectors.push_back({5, 3});  // its tree begins later
    Run run(venue);
    Acquisition whole = run();

    struct Sink : ProgressSink {
      void progressed(double fraction, const Message& name) override {
        if (QString::fromStdString(english(name)).startsWith(stage)) stop->ask(StopRequest::Kind::keep);
        ordered = ordered && fraction >= last;
        last = fraction;
      }
      QString stage;
      StopRequest* stop = nullptr;
      double last = 0.0;
      bool ordered = true;
    } sink;
    StopRequest stop;
    sink.stage = stage;
    sink.stop = &stop;
    NoShotLog log;
    Acquisition kept = run(log, Progress(sink, stop));
    QVERIFY(kept.patterns < whole.patterns);
    QVERIFY(finestLevel(kept.transport) > finestLevel(whole.transport));
    QVERIFY2(std::abs(kept.unresolvedEnergy) < 0.01, qPrintable(shown(kept, run.truth)));
    QVERIFY(difference(kept.transport, run.truth).frobenius >
            difference(whole.transport, run.truth).frobenius);
    QVERIFY(sink.ordered);
    QVERIFY(sink.last > 0.999);
  }

  void resultsAreTheSameForEveryNumberOfThreads() {
    Venue venue = smallVenue();
    venue.noise = 1e-3;
    Acquisition many = Run(venue)();
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Acquisition one = Run(venue)();
    QVERIFY(one.transport == many.transport);
    QVERIFY(one.flagged == many.flagged);
  }

  void whatIsOverexposedIsFlaggedAndNeverStored() {
    Venue venue = smallVenue();
    venue.exposures = {0.2};
    Run run(venue);
    Acquisition a = run();
    std::size_t empty = 0;
    for (std::size_t row = 0; row < a.flagged.size(); ++row) {
      if (a.transport.ownLeaves().rowBegin(row) != a.transport.ownLeaves().rowBegin(row + 1)) continue;
      ++empty;
      QVERIFY(a.flagged[row]);
    }
    QVERIFY(empty > 0 && empty < a.flagged.size());
    QVERIFY(!a.findings.empty());
    QVERIFY(QString::fromStdString(english(a.findings.front())).contains("overexposed"));
  }

  void driftIsFound() {
    Venue venue = smallVenue();
    venue.drift = -0.3;
    Acquisition a = Run(venue)();
    QVERIFY(!a.findings.empty());
    QVERIFY2(QString::fromStdString(english(a.findings.front())).contains("light changed"),
             english(a.findings.front()).c_str());
  }

  void settingsAreChecked() {
    QVERIFY(problems(AcquisitionSettings{}).empty());
    AcquisitionSettings wrong;
    wrong.relativeThreshold = 0.0;
    wrong.noiseSigmas = -1.0;
    wrong.references = 0;
    wrong.verificationPatterns = -1;
    wrong.dimShare = 2.0;
    wrong.flagSigmas = 0.0;
    wrong.absoluteThreshold = -1.0;
    wrong.checkInterval = 0;
    QCOMPARE(problems(wrong).size(), std::size_t{8});
    for (AcquisitionMode mode : allValues<AcquisitionMode>()) QVERIFY(problems(settingsOf(mode)).empty());
    QVERIFY_EXCEPTION_THROWN(parsedName<AcquisitionMode>("slow", ErrorKind::usage), Error);
    Venue venue = smallVenue();
    venue.settings = wrong;
    Run run(venue);
    QVERIFY_EXCEPTION_THROWN(run(), std::logic_error);
  }
};

QTEST_APPLESS_MAIN(TestAcquisition)
#include "test_acquisition.moc"
