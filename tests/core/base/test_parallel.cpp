// SPDX-License-Identifier: MIT
// TBB before Qt: its functions have names that Qt defines as keywords.
#include "relucent/base/parallel.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <atomic>
#include <chrono>
#include <numeric>
#include <semaphore>
#include <stdexcept>
#include <vector>

#include "relucent/base/random.h"

using namespace relucent;

namespace {

/// A sum of floats whose last bits depend on the order of adding.
float chunkedSum(const std::vector<float>& values) {
  std::vector<float> parts(7);
  parallelChunks(0, values.size(), parts.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) parts[chunk] += values[i];
  });
  return std::accumulate(parts.begin(), parts.end(), 0.0f);
}

}  // namespace

class TestParallel : public QObject {
  Q_OBJECT

 private slots:
  void everyItemIsVisitedOnce_data() {
    QTest::addColumn<int>("begin");
    QTest::addColumn<int>("end");
    QTest::newRow("none") << 5 << 5;
    QTest::newRow("one") << 5 << 6;
    QTest::newRow("many") << 0 << 10007;
  }
  void everyItemIsVisitedOnce() {
    QFETCH(int, begin);
    QFETCH(int, end);
    const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(end);
    std::vector<std::atomic<int>> visits(last + 1), chunkVisits(last + 1);
    parallelFor(first, last, 16, [&](std::size_t i) { ++visits[i]; });
    parallelChunks(first, last, 13, [&](std::size_t, std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) ++chunkVisits[i];
    });
    for (std::size_t i = 0; i <= last; ++i) {
      QCOMPARE(visits[i].load(), i >= first && i < last ? 1 : 0);
      QCOMPARE(chunkVisits[i].load(), visits[i].load());
    }
  }

  void sumsAreTheSameBitsForEveryNumberOfThreads() {
    Random random{1};
    std::vector<float> values(20000);
    for (float& value : values) value = random.uniformFloat();
    const float reference = chunkedSum(values);
    for (std::size_t threads : {1, 2, 5}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      QCOMPARE(chunkedSum(values), reference);
    }
  }

  /// Each waits for the other, so that neither is done before the other has begun.
  void devicesAreWaitedForWhileAllCoresCompute() {
    std::binary_semaphore computing{0}, waiting{0};
    std::atomic<int> done = 0;
    const bool met = computeWhile(
        [&] {
          computing.release();
          if (waiting.try_acquire_for(std::chrono::seconds(60)))
            parallelFor(0, 1000, 1, [&](std::size_t) { ++done; });
        },
        [&] {
          waiting.release();
          return computing.try_acquire_for(std::chrono::seconds(60));
        });
    QVERIFY(met);
    QCOMPARE(done.load(), 1000);
  }
  void oneThreadIsEnoughToComputeWhileWaiting() {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    int computed = 0;
    QCOMPARE(computeWhile([&] { computed = 1; }, [] { return 2; }), 2);
    QCOMPARE(computed, 1);
  }
  void exceptionsEndWhatIsComputedMeanwhile() {
    QVERIFY_THROWS_EXCEPTION(std::runtime_error,
                             computeWhile([] { throw std::runtime_error("no disk"); }, [] { return 1; }));
    std::binary_semaphore computing{0};
    std::atomic<bool> ended = false;
    auto computeWithoutEnd = [&](std::size_t item) {
      if (item == 0) computing.release();
      const auto most = std::chrono::steady_clock::now() + std::chrono::seconds(60);
      while (!tbb::is_current_task_group_canceling() && std::chrono::steady_clock::now() < most) {
      }
      if (tbb::is_current_task_group_canceling()) ended = true;
    };
    auto fail = [&]() -> int {
      computing.acquire();
      throw std::logic_error("no camera");
    };
    QVERIFY_THROWS_EXCEPTION(std::logic_error,
                             computeWhile([&] { parallelFor(0, 1000, 1, computeWithoutEnd); }, fail));
    QVERIFY(ended);
  }

  void anExceptionComesThrough() {
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, parallelFor(0, 1000, 1, [](std::size_t i) {
                               if (i == 500) throw std::runtime_error("item 500");
                             }));
  }
};

QTEST_APPLESS_MAIN(TestParallel)
#include "test_parallel.moc"
