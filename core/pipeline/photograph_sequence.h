// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::pipeline {

/// A photograph of a folder, and when its camera says that it was taken: whole seconds; none: it does not
/// say.
struct TakenPhotograph {
  std::filesystem::path path;
  std::optional<std::time_t> taken{};
};

/// Photographs in the order in which they were taken, for pairing with patterns.
struct PhotographSequence {
  std::vector<TakenPhotograph> photographs;
  Message finding{};  // a sentence if that is not the order of their names
};

/// The order of names, unless every photograph has a time and the names go back in time: cameras count from
/// 9999 to 0001 and begin new folders. Photographs of the same second keep the order of their names.
PhotographSequence inOrder(std::vector<TakenPhotograph> photographs);

/// One sentence on a number of photographs that is not that of the patterns, without a full stop, and one
/// that says what to do. Where times tell it, names the photograph after which one is missing (the interval
/// there is a multiple of the usual one) or those that came too soon after the one before.
struct CountProblem {
  Message what, advice;
};
CountProblem countProblem(const std::vector<TakenPhotograph>& photographs, std::size_t patterns);

}  // namespace relucent::pipeline
