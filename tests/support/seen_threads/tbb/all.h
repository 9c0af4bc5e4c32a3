// SPDX-License-Identifier: MIT
#pragma once

// What core uses of TBB, done by threads that the thread sanitizer sees: it knows nothing of what the
// packaged library does to keep its tasks apart, and takes every one of them for a race. For that sanitizer
// only.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {
namespace seen {

inline constexpr std::size_t threads = 3;  // of a loop, that of its caller among them
inline thread_local bool isWithinLoop = false;
/// Of the group whose task this thread does.
inline thread_local const std::atomic<bool>* isCancelled = nullptr;

/// The first exception of several threads.
class Failure {
 public:
  template <typename Work>
  void guard(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(guard_);
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() {
    if (const std::exception_ptr first = std::exchange(first_, nullptr)) std::rethrow_exception(first);
  }

 private:
  std::mutex guard_;
  std::exception_ptr first_;
};

/// part(i) for i in [0, parts), each by any thread. Within another loop by its thread alone; likewise most of
/// the times where the same loop is run thousands of times: threads take long to begin.
template <typename Part>
void inParts(std::size_t parts, const Part& part) {
  constexpr int often = 200, seldom = 100;
  static std::atomic<int> times{0};
  const int time = times.fetch_add(1, std::memory_order_relaxed);
  if (isWithinLoop || parts < 2 || (time > often && time % seldom != 0)) {
    for (std::size_t i = 0; i < parts; ++i) part(i);
    return;
  }
  Failure failure;
  // Each has its part of them, however late it begins: else the first would have done all of a short loop.
  const auto work = [&, cancelled = isCancelled](std::size_t first) {
    isWithinLoop = true;
    isCancelled = cancelled;
    failure.guard([&] {
      for (std::size_t i = first; i < parts; i += threads)
        if (!cancelled || !*cancelled) part(i);
    });
    isWithinLoop = false;
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < threads; ++k) others.emplace_back(work, k);
  work(0);
  for (std::thread& other : others) other.join();
  failure.rethrow();
}

}  // namespace seen

template <typename Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t grain = 1)
      : begin_(begin), end_(end), grain_(std::max<std::size_t>(grain, 1)) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }
  std::size_t grainsize() const { return grain_; }

 private:
  Value begin_, end_;
  std::size_t grain_;
};

struct simple_partitioner {};

template <typename Value, typename Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  if (!(range.begin() < range.end())) return;
  const auto length = static_cast<std::size_t>(range.end() - range.begin());
  // As many pieces as make races likely, none below the grain.
  const std::size_t pieces = std::clamp<std::size_t>(length / range.grainsize(), 1, 16);
  seen::inParts(pieces, [&](std::size_t k) {
    body(blocked_range<Value>(range.begin() + static_cast<Value>(length * k / pieces),
                              range.begin() + static_cast<Value>(length * (k + 1) / pieces)));
  });
}

template <typename Index, typename Body>
void parallel_for(Index begin, Index end, const Body& body, simple_partitioner = {}) {
  if (begin < end)
    seen::inParts(static_cast<std::size_t>(end - begin),
                  [&](std::size_t k) { body(static_cast<Index>(begin + static_cast<Index>(k))); });
}

template <typename... Works>
void parallel_invoke(const Works&... works) {
  const std::array<std::function<void()>, sizeof...(works)> all{works...};
  seen::Failure failure;
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < all.size(); ++k) others.emplace_back([&, k] { failure.guard(all[k]); });
  failure.guard(all[0]);
  for (std::thread& other : others) other.join();
  failure.rethrow();
}

template <typename Iterator, typename Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
  std::sort(begin, end, less);
}

class task_group {
 public:
  ~task_group() { join(); }
  template <typename Work>
  void run(const Work& work) {
    const std::lock_guard lock(guard_);
    threads_.emplace_back([this, work] {
      seen::isCancelled = &isCancelled_;
      failure_.guard(work);
    });
  }
  void wait() {
    join();
    failure_.rethrow();
  }
  void cancel() { isCancelled_ = true; }  // loops begin no other part

 private:
  void join() {
    while (true) {
      std::list<std::thread> begun;
      {
        const std::lock_guard lock(guard_);
        begun.swap(threads_);
      }
      if (begun.empty()) return;
      for (std::thread& thread : begun) thread.join();
    }
  }
  std::mutex guard_;
  std::list<std::thread> threads_;
  std::atomic<bool> isCancelled_{false};
  seen::Failure failure_;
};

inline bool is_current_task_group_canceling() {
  return seen::isCancelled && *seen::isCancelled;
}

class task_arena {
 public:
  enum class priority { low, normal, high };
  static constexpr int automatic = -1;
  explicit task_arena(int = automatic, unsigned = 1, priority = priority::normal) {}
  template <typename Work>
  auto execute(const Work& work) {
    return work();
  }
};

namespace this_task_arena {
inline int max_concurrency() {
  return static_cast<int>(seen::threads);
}
}  // namespace this_task_arena

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
  static std::size_t active_value(parameter) { return seen::threads; }
};

template <typename Value>
class enumerable_thread_specific {
 public:
  Value& local() {
    const std::lock_guard lock(guard_);
    return values_[std::this_thread::get_id()];
  }

 private:
  std::mutex guard_;
  std::map<std::thread::id, Value> values_;
};

}  // namespace tbb
