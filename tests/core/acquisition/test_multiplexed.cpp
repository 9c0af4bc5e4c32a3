// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <QtTest>
#include <optional>

#include "acquisition_run.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

Venue denseVenue() {
  Venue venue = smallVenue();
  std::uint64_t seed = venue.settings.seed;
  venue.settings = settingsOf(AcquisitionMode::multiplexed);
  venue.settings.seed = seed;
  venue.settings.checkInterval = 10;
  venue.noise = 1e-3;
  return venue;
}

Venue largerVenue() {
  Venue venue = denseVenue();
  venue.synthetic.projectors = {{61, 45}};
  return venue;
}

}  // namespace

class TestMultiplexed : public QObject {
  Q_OBJECT

 private slots:
  void fewPhotographsAreEnough_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<int>("cameras");
    QTest::addColumn<double>("drift");
    QTest::addColumn<double>("black");
    QTest::addColumn<double>("shareSeen");
    QTest::newRow("one projector") << 1 << 1 << 0.0 << 1e-3 << 0.9;
    QTest::newRow("two projectors, lit together") << 2 << 1 << 0.0 << 1e-3 << 0.9;
    QTest::newRow("two cameras") << 1 << 2 << 0.0 << 1e-3 << 0.9;
    QTest::newRow("a lamp that fades") << 1 << 1 << -0.03 << 1e-3 << 0.9;
    QTest::newRow("black that leaks light") << 1 << 1 << 0.0 << 0.05 << 0.9;
    QTest::newRow("half of the camera sees no light") << 1 << 1 << 0.0 << 1e-3 << 0.5;
  }
  /// Sizes are no multiples of the blocks.
  void fewPhotographsAreEnough() {
    QFETCH(int, projectors);
    QFETCH(int, cameras);
    QFETCH(double, drift);
    QFETCH(double, black);
    QFETCH(double, shareSeen);
    Venue venue = denseVenue();
    venue.black = black;
    venue.synthetic.shareSeen = shareSeen;
    if (shareSeen < 0.9) venue.synthetic.interreflection = 0.0;
    if (projectors == 2) venue.synthetic.projectors.push_back({13, 11});
    if (cameras == 2) venue.synthetic.cameras.push_back({9, 7});
    venue.drift = drift;
    Run run(venue);
    Acquisition a = run();
    ProjectorStack pattern(naturalPattern(run.truth.projectors()));
    QVERIFY2(relativeError(a.transport.apply(pattern), run.truth.apply(pattern)) < 0.02,
             qPrintable(shown(a, run.truth)));
    QVERIFY2(difference(a.transport, run.truth).frobenius < 0.15, qPrintable(shown(a, run.truth)));
    QVERIFY2(a.exposures < 300, qPrintable(shown(a, run.truth)));
    // T 1 is the flood, which all photographs together know better than its own.
    QVERIFY(relativeError(a.transport.floodlight(), a.flood) < 1e-3);
    QVERIFY2(relativeError(a.flood, run.truth.floodlight()) < 0.01, qPrintable(shown(a, run.truth)));
    QVERIFY(std::ranges::all_of(a.leafVariance, [](float value) { return std::isfinite(value); }));
    QVERIFY(std::ranges::all_of(a.floodVariance, [](float value) { return std::isfinite(value); }));
    QVERIFY2(flaggedIn(a) == 0, qPrintable(shown(a, run.truth)));
  }

  void resumedWithTheSameBits_data() {
    QTest::addColumn<int>("shot");
    for (int shot : {20, 3, 60}) {
      QTest::addRow("killed at %d", shot) << shot;
      if (isSanitized) break;
    }
  }
  void resumedWithTheSameBits() {
    QFETCH(int, shot);
    Venue venue = denseVenue();
    const Acquisition& whole = undisturbed();

    struct Sink : ProgressSink {
      void progressed(double, const Message&) override {}
    } sink;
    StopRequest stop;
    Venue killed = venue;
    killed.beforeCapture = [&](const rig::CaptureRequest& request) {
      if (request.shot.number == shot) stop.ask(StopRequest::Kind::cancel);
    };
    MemoryLog log;
    Run first(killed);
    QVERIFY_EXCEPTION_THROWN(first(log, Progress(sink, stop)), Cancelled);
    Acquisition again = Run(venue)(log);
    QVERIFY(again.transport == whole.transport);
    QVERIFY(again.flood == whole.flood && again.floodVariance == whole.floodVariance);
    QVERIFY(again.leafVariance == whole.leafVariance && again.flagged == whole.flagged);
    QCOMPARE(again.exposures, whole.exposures);
  }

  void resultsAreTheSameForEveryNumberOfThreads() {
    Venue venue = denseVenue();
    const Acquisition& many = undisturbed();
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Acquisition one = Run(venue)();
    QVERIFY(one.transport == many.transport);
    QVERIFY(one.flood == many.flood && one.floodVariance == many.floodVariance);
  }

  void stopAndKeepIsAValidCoarserTransport_data() {
    QTest::addColumn<QString>("stage");
    QTest::newRow("before the patterns") << "black";
    QTest::newRow("in blocks of 8") << "patterns in blocks of 8";
  }
  void stopAndKeepIsAValidCoarserTransport() {
    QFETCH(QString, stage);
    Venue venue = largerVenue();
    Run run(venue);
    const Acquisition& whole = undisturbedLarger();
    struct Sink : ProgressSink {
      void progressed(double, const Message& name) override {
        if (QString::fromStdString(english(name)).startsWith(stage)) stop->ask(StopRequest::Kind::keep);
      }
      QString stage;
      StopRequest* stop = nullptr;
    } sink;
    StopRequest stop;
    sink.stage = stage;
    sink.stop = &stop;
    rig::NoShotLog log;
    Acquisition kept = run(log, Progress(sink, stop));
    QVERIFY(kept.patterns < whole.patterns);
    QCOMPARE(whole.stoppedAt, 0);
    QCOMPARE(kept.stoppedAt, 1 << finestLevel(kept.transport));
    QVERIFY(finestLevel(kept.transport) > finestLevel(whole.transport));
    QVERIFY2(std::abs(kept.unresolvedEnergy) < 0.01, qPrintable(shown(kept, run.truth)));
    QVERIFY(difference(kept.transport, run.truth).frobenius >
            difference(whole.transport, run.truth).frobenius);
  }

  /// Law: stopping costs nothing but the test patterns that were taken for it.
  void goingOnEndsAsIfItHadNotStopped_data() {
    QTest::addColumn<int>("shot");
    for (int shot : {60, 12}) {
      QTest::addRow("stopped at %d", shot) << shot;
      if (isSanitized) break;
    }
  }
  void goingOnEndsAsIfItHadNotStopped() {
    QFETCH(int, shot);
    Venue venue = largerVenue();
    const Acquisition& whole = undisturbedLarger();
    struct Sink : ProgressSink {
      void progressed(double, const Message&) override {}
    } sink;
    StopRequest stop;
    Venue stopped = venue;
    stopped.beforeCapture = [&](const rig::CaptureRequest& request) {
      if (request.shot.number == shot) stop.ask(StopRequest::Kind::keep);
    };
    MemoryLog log;
    Run first(stopped);
    Acquisition kept = first(log, Progress(sink, stop));
    QVERIFY(kept.stoppedAt > 0 && kept.patterns < whole.patterns);
    Acquisition again = Run(venue)(log);
    QVERIFY(again.transport == whole.transport);
    QVERIFY(again.flood == whole.flood);
    QCOMPARE(again.stoppedAt, 0);
  }

  /// What looks on is told T as it is so far, finer and finer, and in the end nearly what is measured.
  void draftsGrowFiner() {
    struct Looking : sentinels::AcquisitionObserver {
      bool wantsDrafts() const override { return true; }
      void drafted(const Draft& draft) override { drafts.push_back(draft); }
      std::vector<Draft> drafts;
    } looking;
    Venue venue = largerVenue();
    Run run(venue);
    rig::NoShotLog log;
    const Acquisition whole = run(log, {}, &looking);
    QVERIFY(whole.transport == undisturbedLarger().transport);
    QVERIFY(looking.drafts.size() >= 4);
    double before = 1.0;
    int level = 100;
    for (const Draft& draft : looking.drafts) {
      QCOMPARE(draft.coarsening, 0);
      QVERIFY(draft.level <= level);
      const double error = difference(draft.acquisition.transport, run.truth).frobenius;
      if (draft.level < level) QVERIFY2(error < before, qPrintable(QString::number(error)));
      level = draft.level;
      before = error;
      QVERIFY(relativeError(draft.acquisition.flood, run.truth.floodlight()) < 0.01);
    }
    QCOMPARE(level, 0);
    QVERIFY(looking.drafts.back().error > 0.0);
    // The draft leaves out what single leaves have of colours of their own.
    const ProjectorStack pattern(naturalPattern(run.truth.projectors()));
    const double left = relativeError(looking.drafts.back().acquisition.transport.apply(pattern),
                                      whole.transport.apply(pattern));
    QVERIFY2(left < 0.02, qPrintable(QString::number(left)));
  }

  /// The next level's patterns are photographed while the rows of a level are solved.
  void devicesDoNotWaitForWhatIsSolved() {
    struct Looking : sentinels::AcquisitionObserver {
      bool wantsDrafts() const override { return true; }
      void grew(const std::vector<int>& levels, int through) override {
        if (through == 0 && levels.size() > 1) wanted.push_back(levels.back());
        last = {levels.back(), through};
        told = captures;
      }
      void drafted(const Draft& draft) override {
        incomplete += last.first != last.second ? 1 : 0;
        if (draft.level > 0) ahead.push_back(captures - told);
      }
      int captures = 0, told = 0, incomplete = 0;
      std::pair<int, int> last;        // of how many patterns how many are through
      std::vector<int> ahead, wanted;  // while a level was solved, of the next one
    } looking;
    Venue venue = largerVenue();
    venue.beforeCapture = [&](const rig::CaptureRequest&) { ++looking.captures; };
    rig::NoShotLog log;
    Run run(venue);
    const Acquisition whole = run(log, {}, &looking);
    QVERIFY(looking.ahead.size() >= 3);
    // A level is told to be through although nothing of it was left to photograph.
    QCOMPARE(looking.incomplete, 0);
    QCOMPARE(looking.ahead.size(), looking.wanted.size());
    for (std::size_t level = 0; level < looking.ahead.size(); ++level)
      QVERIFY(looking.ahead[level] >= looking.wanted[level]);
  }

  /// Blocks cannot show what is inside them: that is no reason to leave a camera pixel out.
  void whatIsCoarseIsNotFlagged() {
    Venue venue = largerVenue();
    venue.beforeCapture = [&](const rig::CaptureRequest& request) {
      if (request.shot.number == 40) stop_.ask(StopRequest::Kind::keep);
    };
    struct Sink : ProgressSink {
      void progressed(double, const Message&) override {}
    } sink;
    rig::NoShotLog log;
    const Acquisition kept = Run(venue)(log, Progress(sink, stop_));
    QVERIFY2(kept.stoppedAt > 1, qPrintable(QString::number(kept.stoppedAt)));
    QVERIFY2(flaggedIn(kept) < kept.flagged.size() / 20, qPrintable(QString::number(flaggedIn(kept))));
  }

  /// Patterns of single pixels were shown, but not as many as it takes.
  void stoppedAtTheFinestIsNotComplete() {
    struct Looking : sentinels::AcquisitionObserver {
      bool wantsDrafts() const override { return true; }
      void drafted(const Draft& draft) override {
        if (draft.level == 0) stop.ask(StopRequest::Kind::keep);
      }
      StopRequest stop;
    } looking;
    struct Sink : ProgressSink {
      void progressed(double, const Message&) override {}
    } sink;
    Venue venue = largerVenue();
    venue.settings.relativeThreshold = 1e-3;
    rig::NoShotLog log;
    const Acquisition kept = Run(venue)(log, Progress(sink, looking.stop), &looking);
    QCOMPARE(kept.stoppedAt, 1);
  }

  void whatIsOverexposedIsFlaggedAndNeverStored() {
    Venue venue = denseVenue();
    venue.exposures = {0.2};
    Run run(venue);
    Acquisition a = run();
    std::size_t empty = 0;
    for (std::size_t row = 0; row < a.flagged.size(); ++row) {
      if (a.transport.row(row).size() > 0) continue;
      ++empty;
      QVERIFY(a.flagged[row]);
    }
    QVERIFY(empty > 0 && empty < a.flagged.size());
  }

  /// What is asked to be finer takes more photographs, and is.
  /// What counts as wrong is set so low that many camera pixels are.
  void manyFlaggedRowsAreMeasuredAgain() {
    QCOMPARE(undisturbed().remeasured, 0);
    Venue venue = denseVenue();
    venue.settings.flagRelative = 0.02;
    venue.settings.flagSigmas = 0.1;
    Run run(venue);
    const Acquisition a = run();
    QVERIFY2(a.remeasured > 0 && a.patterns > undisturbed().patterns, qPrintable(shown(a, run.truth)));
    QVERIFY2(
        a.verificationError < 0.99 * undisturbed().verificationError,
        qPrintable(QString("%1, %2 before").arg(a.verificationError).arg(undisturbed().verificationError)));
  }

  /// Where nearly everything is wrong, as after a bump that somebody put up with, it is not measured again
  /// pixel by pixel: that took twenty times the photographs that had been expected.
  void whatIsWrongAsAWholeIsLeft() {
    Venue venue = denseVenue();
    venue.settings.flagRelative = 1e-6;
    venue.settings.flagSigmas = 1e-6;
    const Acquisition a = Run(venue)();
    QVERIFY(flaggedIn(a) > a.flagged.size() / 5);
    QCOMPARE(a.remeasured, 0);
    QCOMPARE(a.patterns, undisturbed().patterns);
  }

  void finenessDecidesPhotographs() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    Venue venue = denseVenue();
    venue.noise = 1e-4;
    venue.settings.relativeThreshold = 0.05;
    Run run(venue);
    Acquisition coarse = run();
    venue.settings.relativeThreshold = 0.003;
    Acquisition fine = Run(venue)();
    QVERIFY2(coarse.exposures < fine.exposures, qPrintable(shown(coarse, run.truth)));
    QVERIFY2(
        difference(fine.transport, run.truth).frobenius < difference(coarse.transport, run.truth).frobenius,
        qPrintable(shown(fine, run.truth)));
  }

 private:
  /// Measured once, for all that is compared with them.
  const Acquisition& undisturbed() {
    if (!undisturbed_) undisturbed_ = Run(denseVenue())();
    return *undisturbed_;
  }
  const Acquisition& undisturbedLarger() {
    if (!undisturbedLarger_) undisturbedLarger_ = Run(largerVenue())();
    return *undisturbedLarger_;
  }

  StopRequest stop_;
  std::optional<Acquisition> undisturbed_, undisturbedLarger_;
};

QTEST_MAIN(TestMultiplexed)
#include "test_multiplexed.moc"
