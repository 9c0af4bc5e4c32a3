// SPDX-License-Identifier: MIT
#include "pipeline/devices.h"

namespace relucent {
namespace {

OpenedRig opened(const VenueSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  OpenedRig result;
  result.venue.emplace(settings, cache, progress);
  result.rig = result.venue->rig();
  return result;
}

}  // namespace

OpenedRig openRig(const RigSettings& settings, const std::filesystem::path& cache, Progress& progress) {
  return std::visit([&](const auto& rig) { return opened(rig, cache, progress); }, settings);
}

}  // namespace relucent
