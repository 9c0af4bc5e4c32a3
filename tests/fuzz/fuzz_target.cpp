// SPDX-License-Identifier: MIT
#include "fuzz/fuzz_target.h"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <typeinfo>

#include "fuzz/allocation_watch.h"
#include "fuzz/targets.h"
#include "relucent/base/error.h"
#include "relucent/cli/arguments.h"

namespace relucent::fuzz {
namespace {

constexpr int longestSeconds = 30;

void endHanging(int) {
  constexpr std::string_view sentence = "a reader takes longer than half a minute\n";
  [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, sentence.data(), sentence.size());
  std::abort();
}

/// Of processor time, so that a program that is stopped for a while is not taken for one that hangs.
class Deadline {
 public:
  Deadline() {
    [[maybe_unused]] static const auto before = std::signal(SIGPROF, endHanging);
    set(longestSeconds);
  }
  ~Deadline() { set(0); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

 private:
  static void set(int seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

std::string thrownBy(const FuzzTarget& target, Bytes input) {
  const Deadline deadline;
  try {
    target.read(input);
  } catch (const Error& error) {
    if (english(error.summary()).empty()) return "an error without a sentence";
  } catch (const cli::WrongUsage& error) {
    if (std::string_view(error.what()).empty()) return "a wrong usage without a sentence";
  } catch (const std::exception& error) {
    return fmt::format("{}: {}", typeid(error).name(), error.what());
  } catch (...) {
    return "something is thrown that is no exception";
  }
  return {};
}

}  // namespace

const std::vector<FuzzTarget>& allTargets() {
  static const std::vector<FuzzTarget> all = [] {
    std::vector<FuzzTarget> targets;
    for (const auto part :
         {pictureTargets, measurementTargets, calibrationTargets, wordTargets, networkTargets, showTargets})
      for (FuzzTarget& target : part()) targets.push_back(std::move(target));
    return targets;
  }();
  return all;
}

std::string findingOf(const FuzzTarget& target, Bytes input) {
  forgetAllocations();
  std::string finding = thrownBy(target, input);
  const std::size_t largest = largestAllocation();
  if (finding.empty() && largest > mostAtOnce)
    finding = fmt::format("{} bytes are taken at once for {}", largest, input.size());
  return finding;
}

}  // namespace relucent::fuzz
