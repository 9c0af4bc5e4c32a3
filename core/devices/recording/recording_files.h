// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/rig/rig.h"

namespace relucent::devices {

/// What devices a recording is of.
struct RecordedDevices {
  struct Projector {
    std::string name;
    Size size;
    int bits = 8;
    bool operator==(const Projector&) const = default;
  };
  struct Camera {
    std::string name;
    Size size;
    double shortest = 0.0, longest = 0.0;  // exposures, seconds
    bool operator==(const Camera&) const = default;
  };
  std::vector<Projector> projectors;
  std::vector<Camera> cameras;
  bool operator==(const RecordedDevices&) const = default;
};
RecordedDevices devicesOf(const rig::Rig& rig);

/// A photograph in a recording.
struct RecordedPhotograph {
  std::size_t camera = 0;
  rig::ShotId shot;
  int exposure = 0;
  double asked = 0.0, seconds = 0.0;
  int bits = 0;
  std::string file;                   // within photographs/
  std::vector<std::string> patterns;  // fingerprint a projector
};

/// recording.json and photographs.jsonl, see recording.h.  Throws: Error{disk, format}.
void writeRecordedDevices(const std::filesystem::path& folder, const RecordedDevices& devices);
RecordedDevices readRecordedDevices(const std::filesystem::path& folder);
void appendPhotograph(const std::filesystem::path& folder, const RecordedPhotograph& photograph);
std::vector<RecordedPhotograph> readPhotographs(const std::filesystem::path& folder);

std::string patternFingerprint(const image::Image& encodedDrive);

}  // namespace relucent::devices
