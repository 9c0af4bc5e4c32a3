// SPDX-License-Identifier: MIT
// TBB before Qt: its functions have names that Qt defines as keywords.
#include "relucent/acquisition/lookahead.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <QtTest>
#include <atomic>
#include <future>
#include <stdexcept>

#include "acquisition_run.h"
#include "relucent/base/parallel.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::photography;
using namespace relucent::sentinels;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

// How long a test waits for what should come at once before it calls that a failure.
constexpr std::chrono::seconds patience{20};

struct Numbered {
  std::size_t number = 0;
};

}  // namespace

class TestLookahead : public QObject {
  Q_OBJECT

 private slots:
  /// Law: when exposure k returns, frame k + 1 is prepared and frame k - 1 worked out, however long that
  /// takes: here the shutter stays open until they are.
  void computationOverlapsExposure() {
    if (tbb::this_task_arena::max_concurrency() < 2) QSKIP("nothing overlaps on one core");
    constexpr std::size_t frames = 6;
    std::vector<std::promise<void>> prepared(frames), workedOut(frames);
    Lookahead<Numbered> lookahead(frames, [&](std::size_t number, const Numbered*) {
      prepared[number].set_value();
      return Numbered{number};
    });
    for (std::size_t frame = 0; frame < frames; ++frame) {
      bool inTime = true;
      std::optional<Interruption> interrupted = lookahead.take(
          frame,
          [&](const Numbered&, const Meanwhile& meanwhile) -> Interruptible<std::size_t> {
            return runWithBackground(meanwhile, [&] {
              if (frame + 1 < frames)
                inTime = prepared[frame + 1].get_future().wait_for(patience) == std::future_status::ready;
              if (frame > 0)
                inTime = inTime &&
                         workedOut[frame - 1].get_future().wait_for(patience) == std::future_status::ready;
              return frame;
            });
          },
          [&](const Numbered& of, std::size_t) { workedOut[of.number].set_value(); });
      QVERIFY(!interrupted);
      QVERIFY2(inTime,
               qPrintable(QString("exposure %1 ended before frame %2 was ready").arg(frame).arg(frame + 1)));
    }
    lookahead.finish();
    QVERIFY(workedOut.back().get_future().wait_for(patience) == std::future_status::ready);
  }

  /// Law: every frame is worked out once, in the order of the exposures, from what it showed.
  void everyFrameIsWorkedOutInOrder_data() {
    QTest::addColumn<QList<int>>("order");
    QTest::newRow("none") << QList<int>{};
    QTest::newRow("one") << QList<int>{0};
    QTest::newRow("in order") << QList<int>{0, 1, 2, 3};
    QTest::newRow("a round taken twice") << QList<int>{0, 1, 0, 1, 2, 3};
    QTest::newRow("backwards") << QList<int>{3, 2, 1, 0};
  }
  void everyFrameIsWorkedOutInOrder() {
    QFETCH(QList<int>, order);
    QList<int> done;
    std::atomic<int> wrong = 0;
    Lookahead<Numbered> lookahead(4, [](std::size_t number, const Numbered*) { return Numbered{number}; });
    for (int frame : order) {
      std::optional<Interruption> interrupted = lookahead.take(
          static_cast<std::size_t>(frame),
          [&](const Numbered& of, const Meanwhile& meanwhile) -> Interruptible<std::size_t> {
            return runWithBackground(meanwhile, [&] { return 10 * of.number; });
          },
          [&](const Numbered& of, std::size_t shown) {
            wrong += shown != 10 * of.number;
            done.push_back(static_cast<int>(of.number));
          });
      QVERIFY(!interrupted);
    }
    lookahead.finish();
    lookahead.finish();
    QCOMPARE(done, order);
    QCOMPARE(wrong.load(), 0);
  }

  /// Nothing is left behind, and nothing waits for ever, when the camera fails.
  void aFailingExposureIsThrown() {
    Lookahead<Numbered> lookahead(2, [](std::size_t number, const Numbered*) { return Numbered{number}; });
    auto fails = [&](const Numbered&, const Meanwhile& meanwhile) -> Interruptible<int> {
      return runWithBackground(meanwhile, []() -> int { throw std::runtime_error("unplugged"); });
    };
    QVERIFY_THROWS_EXCEPTION(std::runtime_error,
                             std::ignore = lookahead.take(0, fails, [](const Numbered&, int) {}));
  }

  /// Law: an interruption comes back as it is; its frame is not worked out, the one before it is.
  void anInterruptionIsReturned_data() {
    QTest::addColumn<int>("interruption");
    QTest::newRow("begin again") << static_cast<int>(Interruption::beginAgain);
    QTest::newRow("keep and stop") << static_cast<int>(Interruption::keepAndStop);
  }
  void anInterruptionIsReturned() {
    QFETCH(int, interruption);
    const auto expected = static_cast<Interruption>(interruption);
    QList<std::size_t> done;
    Lookahead<Numbered> lookahead(3, [](std::size_t number, const Numbered*) { return Numbered{number}; });
    auto expose = [&](const Numbered& of, const Meanwhile& meanwhile) -> Interruptible<std::size_t> {
      meanwhile();
      if (of.number == 1) return expected;
      return of.number;
    };
    auto workOut = [&](const Numbered& of, std::size_t) { done.push_back(of.number); };
    QVERIFY(!lookahead.take(0, expose, workOut));
    QVERIFY(lookahead.take(1, expose, workOut) == expected);
    lookahead.finish();
    QCOMPARE(done, QList<std::size_t>{0});
  }

  /// Law: a measurement is the same bits on one core, where nothing overlaps, and on all.
  void overlappingChangesNothing_data() {
    QTest::addColumn<int>("scheme");
    QTest::newRow("adaptive") << static_cast<int>(AcquisitionScheme::adaptive);
    QTest::newRow("sen") << static_cast<int>(AcquisitionScheme::sen);
  }
  void overlappingChangesNothing() {
    QFETCH(int, scheme);
    Venue venue = smallVenue();
    venue.noise = 1e-3;
    venue.drift = 0.02;
    venue.settings.scheme = static_cast<AcquisitionScheme>(scheme);
    auto measured = [&] {
      Run run(venue);
      return run();
    };
    Acquisition many = measured();
    tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    Acquisition one = measured();
    QVERIFY(many.transport == one.transport);
    QVERIFY(many.black == one.black && many.leafVariance == one.leafVariance);
    QCOMPARE(many.exposures, one.exposures);
  }
};

QTEST_GUILESS_MAIN(TestLookahead)
#include "test_lookahead.moc"
