// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/pjlink/address.h"

namespace relucent::pipeline {

/// What is waited for before devices measure.
enum class WarmUp { steady, power, none };
inline constexpr EnumName<WarmUp> warmUpNames[]{
    {WarmUp::steady, "steady", "switch them on and wait until their light no longer drifts"},
    {WarmUp::power, "power", "switch them on and wait until they say that they are"},
    {WarmUp::none, "none", "neither"}};
constexpr EnumNames<WarmUp> namesOf(WarmUp) {
  return {"warm-up", warmUpNames};
}

/// Which projectors of a rig are on the network. No result depends on it: addresses may change at any time.
struct NetworkProjectors {
  std::map<std::size_t, pjlink::Address> addresses;  // by the projectors' numbers in T, from 0
  WarmUp warmUp = WarmUp::steady;

  bool operator==(const NetworkProjectors&) const = default;
};

/// What people call the projectors of a rig: their names, else their numbers, from 1. Empty: how many there
/// are is not known before it is opened.
std::vector<std::string> projectorLabels(const RigSettings& rig);

/// The projector that a text names, by its label or its number, from 1. None: there is no such projector.
std::optional<std::size_t> projectorNamed(const RigSettings& rig, std::string_view text);

/// "HOST[:PORT]" of the only projector, or "NAME=HOST[:PORT]", added to those that there are.
/// Throws: Error{usage}.
void addAddress(NetworkProjectors& projectors, const RigSettings& rig, const std::string& text);

/// Sentences about what cannot be: projectors that the rig does not have, one address for two.
std::vector<Message> problems(const NetworkProjectors& projectors, const RigSettings& rig);

/// Those that a calibration keeps. Addresses are in its manifest, in a section of their own with a version;
/// passwords in a file beside it that only its owner can read, which no support bundle takes.
/// Throws: Error{format, disk}.
NetworkProjectors networkProjectorsOf(const calibration::CalibrationFolder& folder);
/// Throws: Error{disk}.
void keepNetworkProjectors(calibration::CalibrationFolder& folder, const NetworkProjectors& projectors);

/// Of its folder.
inline constexpr const char* passwordFile = "projector-passwords.json";

/// The first line of a file.  Throws: Error{disk}; Error{input} if it is empty.
std::string passwordFrom(const std::filesystem::path& file);

}  // namespace relucent::pipeline
