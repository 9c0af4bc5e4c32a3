// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/platform/child_process.h"

namespace relucent::rehearsal {

/// What happens to a venue on a day.
enum class Happening {
  opening,
  disobedientProjector,
  inputLost,
  stillGone,
  powerFailure,
  projectorGone,
  closing,
  night,
  powerFailureAtNight,
  unreadableStill,
};
inline constexpr EnumName<Happening> happeningNames[]{
    {Happening::opening, "opening", "projectors on, content plays"},
    {Happening::disobedientProjector, "disobedient-projector",
     "a projector says that it switches on and does not"},
    {Happening::inputLost, "input-lost", "the live picture is lost and comes back"},
    {Happening::stillGone, "still-gone", "the still's file is gone and comes back"},
    {Happening::powerFailure, "power-failure", "the show is killed and started again"},
    {Happening::projectorGone, "projector-gone", "a projector leaves the network and comes back"},
    {Happening::closing, "closing", "black, projectors off"},
    {Happening::night, "night", "the calibration is tended"},
    {Happening::powerFailureAtNight, "power-failure-at-night",
     "the show is killed in the middle of its night"},
    {Happening::unreadableStill, "unreadable-still", "a night cannot read the still, and raises an alarm"}};
constexpr EnumNames<Happening> namesOf(Happening) {
  return {"happening", happeningNames};
}

/// One of them, and whether the show did what it should.
struct Happened {
  Happening what = Happening::opening;
  std::string missed;    // what it did not do; empty: nothing
  double seconds = 0.0;  // real ones, until it had
};

struct RehearsedDay {
  int number = 0;  // from 1
  std::vector<Happened> happened;
  std::vector<std::string> unexpected;  // warnings of its log that nothing explains
  std::string night;                    // what came of it, a sentence; empty: nothing was to be done
  platform::ProcessUse use;             // at 10:00
  int process = 0;                      // of the show, by how often it was started before
  std::uint64_t logBytes = 0, calibrationBytes = 0;  // at the end of the day
};

/// What must not be exceeded.
enum class Bounded { happenings, warnings, memory, handles, threads, log, calibration, end };
inline constexpr EnumName<Bounded> boundedNames[]{
    {Bounded::happenings, "happenings", "what a show did not do, or not tell, where it should have"},
    {Bounded::warnings, "warnings", "of the log that nothing explains"},
    {Bounded::memory, "memory",
     "growth of what is resident, median of the last third of one process's days over that of the first, its "
     "first two left out: 2 %, as tests/system/soak.py has it"},
    {Bounded::handles, "handles", "growth of open handles at the same hour, likewise: none"},
    {Bounded::threads, "threads", "growth of threads at the same hour, likewise: none"},
    {Bounded::log, "log", "bytes of the log's folder: five files of a megabyte and a health file"},
    {Bounded::calibration, "calibration",
     "bytes that the calibration's folder grows by a night, likewise: a line of its history"},
    {Bounded::end, "end", "exit status of the show when it was asked to end"}};
constexpr EnumNames<Bounded> namesOf(Bounded) {
  return {"bound", boundedNames};
}

struct Bound {
  Bounded what = Bounded::happenings;
  std::optional<double> found;  // none: there were too few days to tell
  double most = 0.0;

  bool isHeld() const { return !found || *found <= most; }
};

/// By what the days came to. `end`: none: the show ended by itself before it was asked.
std::vector<Bound> boundsOf(const std::vector<RehearsedDay>& days,
                            const std::optional<platform::ProcessEnd>& end);

}  // namespace relucent::rehearsal
