// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/rig/rig.h"

namespace relucent::devices {

/// A recording is a folder that holds what projectors showed and what cameras photographed:
///   recording.json    format, version, and of every device name, size, bits, range of exposures
///   photographs.jsonl a line of JSON a photograph, in the order in which they were taken: camera, shot,
///                     exposure asked for and kept to, bits, file, and the patterns that were out
///   photographs/      OpenEXR, 32-bit float, three channels, nothing lost
///   patterns/         PNG of the projector's bits, one for each different pattern
/// A photograph is listed once its files are on disk; a last line that was cut short is passed over.
namespace recording {
inline constexpr int version = 1;
}

/// The same devices; all that they show and photograph is kept in `folder` too, which is created or, if it
/// holds a recording of devices like these, added to.
/// Throws: Error{input} if it holds anything else; Error{disk}, also from the devices when they are used.
rig::Rig recorded(rig::Rig rig, const std::filesystem::path& folder);

/// Devices that answer out of a recording. A photograph is the one of the same shot if that showed the same
/// patterns with the same exposure, else the one that showed and had these at the nearest number: with the
/// settings of the recording everything is as it was, bit for bit, and with others that is possible as far as
/// they photograph the same.
/// Throws: Error{format} if it is foreign, damaged or of a later version. The cameras throw Error{input} when
/// there is no such photograph.
rig::Rig replayed(const std::filesystem::path& folder);

}  // namespace relucent::devices
