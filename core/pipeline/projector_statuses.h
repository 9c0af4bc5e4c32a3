// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pjlink/projector.h"
#include "relucent/pjlink/search.h"

namespace relucent::pipeline {

/// What a projector on the network is told.
enum class ProjectorOrder { on, off, open, close };
inline constexpr EnumName<ProjectorOrder> projectorOrderNames[]{
    {ProjectorOrder::on, "on"},
    {ProjectorOrder::off, "off"},
    {ProjectorOrder::open, "open", "its shutter"},
    {ProjectorOrder::close, "close", "its shutter"}};
constexpr EnumNames<ProjectorOrder> namesOf(ProjectorOrder) {
  return {"order", projectorOrderNames};
}

struct ProjectorStatusSettings {
  std::vector<pjlink::Address> addresses;          // to ask
  std::optional<pjlink::SearchSettings> search{};  // and whoever is found
  std::optional<ProjectorOrder> order{};           // what they are told before they are asked
  pjlink::Patience patience{};
};

struct ProjectorStatus {
  pjlink::Address address;
  std::optional<pjlink::Report> report{};  // none: it does not answer
  Message problem{};                       // why not
  std::vector<Message> remarks{};          // what is wrong with it, or spoils its picture
};

/// Asks projectors one after the other.  Throws: Error{device} if nobody can be searched; Cancelled.
std::vector<ProjectorStatus> projectorStatuses(const ProjectorStatusSettings& settings, Progress& progress);

}  // namespace relucent::pipeline
