// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/day_bounds.h"

#include <algorithm>
#include <functional>

namespace relucent::rehearsal {
namespace {

constexpr std::size_t settling = 2;   // days of a process: caches, the first of everything
constexpr std::size_t leastDays = 3;  // after that, for a growth
constexpr double mostMemoryGrowth = 0.02;
constexpr double mostLogBytes = 5.0 * (1 << 20) + (1 << 16);
constexpr double mostBytesANight = 1024.0;
constexpr double killed = 256.0;  // no exit status

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// First and last third of the days that the last process has settled; none: these are too few.
struct Thirds {
  std::vector<RehearsedDay> first, last;

  double growth(const std::function<double(const RehearsedDay&)>& of) const {
    const auto middle = [&](const std::vector<RehearsedDay>& days) {
      std::vector<double> values;
      for (const RehearsedDay& day : days) values.push_back(of(day));
      return median(std::move(values));
    };
    return middle(last) - middle(first);
  }
};

std::optional<Thirds> thirdsOf(const std::vector<RehearsedDay>& days) {
  std::vector<RehearsedDay> settled;
  for (const RehearsedDay& day : days)
    if (day.process == days.back().process) settled.push_back(day);
  if (settled.size() < settling + leastDays) return std::nullopt;
  settled.erase(settled.begin(), settled.begin() + settling);
  const auto third = static_cast<std::ptrdiff_t>(settled.size() / 3);
  return Thirds{{settled.begin(), settled.begin() + third}, {settled.end() - third, settled.end()}};
}

}  // namespace

std::vector<Bound> boundsOf(const std::vector<RehearsedDay>& days,
                            const std::optional<platform::ProcessEnd>& end) {
  double missed = 0.0, unexpected = 0.0, log = 0.0;
  for (const RehearsedDay& day : days) {
    missed += static_cast<double>(
        std::ranges::count_if(day.happened, [](const Happened& one) { return !one.missed.empty(); }));
    unexpected += static_cast<double>(day.unexpected.size());
    log = std::max(log, static_cast<double>(day.logBytes));
  }
  std::vector<Bound> bounds{{Bounded::happenings, missed, 0.0}, {Bounded::warnings, unexpected, 0.0}};

  Bound memory{Bounded::memory, std::nullopt, mostMemoryGrowth}, handles{Bounded::handles, std::nullopt, 0.0},
      threads{Bounded::threads, std::nullopt, 0.0},
      calibration{Bounded::calibration, std::nullopt, mostBytesANight};
  if (const std::optional<Thirds> thirds = days.empty() ? std::nullopt : thirdsOf(days)) {
    const auto resident = [](const RehearsedDay& day) { return static_cast<double>(day.use.residentBytes); };
    memory.found = thirds->growth(resident) / resident(thirds->first.front());
    handles.found = thirds->growth([](const RehearsedDay& day) { return 1.0 * day.use.handles; });
    threads.found = thirds->growth([](const RehearsedDay& day) { return 1.0 * day.use.threads; });
    const int nights = thirds->last.back().number - thirds->first.front().number;
    calibration.found = (static_cast<double>(thirds->last.back().calibrationBytes) -
                         static_cast<double>(thirds->first.front().calibrationBytes)) /
                        nights;
  }
  bounds.insert(bounds.end(), {memory, handles, threads, {Bounded::log, log, mostLogBytes}, calibration});
  bounds.push_back({Bounded::end, !end || end->killed ? killed : end->status, 0.0});
  return bounds;
}

}  // namespace relucent::rehearsal
