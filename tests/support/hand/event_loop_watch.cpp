// SPDX-License-Identifier: MIT
#include "support/hand/event_loop_watch.h"

#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>

#include <QThread>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>

namespace relucent::test {
namespace {

constexpr int mostFrames = 48;
constexpr std::chrono::milliseconds interval{5}, aMoment{200};

void* frames[mostFrames];
std::atomic<int> frameCount = -1;
pthread_t loop;

void noteFrames(int) {
  frameCount = ::backtrace(frames, mostFrames);
}

void tellCrash(int signal) {
  void* own[mostFrames];
  const int count = ::backtrace(own, mostFrames);
  constexpr char words[] = "CRASHED\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words, sizeof words - 1);
  ::backtrace_symbols_fd(own, count, STDERR_FILENO);
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

/// Of the loop's thread, now.
std::vector<QString> whereTheLoopIs() {
  frameCount = -1;
  ::pthread_kill(loop, SIGUSR2);
  const auto end = EventLoopWatch::Clock::now() + aMoment;
  while (frameCount < 0 && EventLoopWatch::Clock::now() < end) std::this_thread::sleep_for(interval);
  if (frameCount <= 0) return {};
  const std::unique_ptr<char*, decltype(&std::free)> names(::backtrace_symbols(frames, frameCount),
                                                           &std::free);
  std::vector<QString> where;
  for (int i = 0; i < frameCount; ++i) where.push_back(QString::fromLocal8Bit(names.get()[i]));
  return where;
}

/// How long the loop's thread could have run and another program did, milliseconds.
double elsewhere() {
  std::ifstream file("/proc/self/task/" + std::to_string(::getpid()) + "/schedstat");
  double own = 0.0, waited = 0.0;
  file >> own >> waited;
  return 1e-6 * waited;
}

}  // namespace

EventLoopWatch::EventLoopWatch() {
  loop = ::pthread_self();
  ::backtrace(frames, 1);  // loads what it needs, which a signal's handler must not
  std::signal(SIGUSR2, noteFrames);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, tellCrash);
  thread_ = std::thread([this] { watch(); });
}

EventLoopWatch::~EventLoopWatch() {
  ends_ = true;
  thread_.join();
}

double EventLoopWatch::waitedMilliseconds(Clock::time_point now) const {
  const double since = std::chrono::duration<double, std::milli>(now - sent_).count();
  return std::max(0.0, since - (elsewhere() - elsewhere_));
}

void EventLoopWatch::watch() {
  for (; !ends_; std::this_thread::sleep_for(interval)) {
    std::unique_lock guard(lock_);
    if (!isOnItsWay_) {
      isOnItsWay_ = true;
      where_.clear();
      sent_ = Clock::now();
      elsewhere_ = elsewhere();
      guard.unlock();
      QMetaObject::invokeMethod(this, [this] { received(); }, Qt::QueuedConnection);
      continue;
    }
    const double waited = waitedMilliseconds(Clock::now());
    const bool isHung = waited > static_cast<double>(hung.count());
    if (!isHung && (isFirst_ || !where_.empty() || waited < 0.5 * static_cast<double>(tooLong.count())))
      continue;
    const auto sent = sent_;
    guard.unlock();
    const std::vector<QString> where = whereTheLoopIs();
    guard.lock();
    if (isOnItsWay_ && sent == sent_) where_ = where;
    if (!isHung) continue;
    std::fprintf(stderr, "HUNG for %.0f ms\n", waited);
    for (const QString& line : where) std::fprintf(stderr, "%s\n", qPrintable(line));
    std::abort();
  }
}

void EventLoopWatch::received() {
  std::lock_guard guard(lock_);
  const double waited = waitedMilliseconds(Clock::now());
  isOnItsWay_ = false;
  // The first one waits until the program has been made and its loop begins.
  if (std::exchange(isFirst_, QThread::currentThread()->loopLevel() == 0)) return;
  longest_ = std::max(longest_, waited);
  const auto part = std::ranges::lower_bound(parts, waited) - parts.begin();
  ++waits_[static_cast<std::size_t>(part)];
  if (waited <= static_cast<double>(tooLong.count())) return;
  QJsonArray where;
  for (const QString& line : where_) where.append(line);
  blocks_.append(QJsonObject{{"ms", waited}, {"where", where}});
}

QJsonObject EventLoopWatch::report() {
  std::lock_guard guard(lock_);
  QJsonArray waits;
  for (int count : std::exchange(waits_, {})) waits.append(count);
  return {
      {"waits", waits}, {"longest", std::exchange(longest_, 0.0)}, {"blocks", std::exchange(blocks_, {})}};
}

}  // namespace relucent::test
