// SPDX-License-Identifier: MIT
#include "relucent/pipeline/kept_windows.h"

#include "relucent/base/disk_full.h"
#include "relucent/base/fingerprint.h"
#include "relucent/inverse/window_file.h"
#include "relucent/transport/files.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr const char* fileName = "windows.npz";

fs::path fileIn(const calibration::CalibrationFolder& folder) {
  return folder.path() / "results" / fileName;
}

/// Of all that windows follow from.
std::string keyOf(const compensation::MeasuredVenue& venue, const inverse::WindowSettings& settings) {
  constexpr int version = 1;  // of how they are made
  Fingerprint fingerprint;
  fingerprint.add(version).add(settings.tile).add(settings.rows).add(settings.ridge);
  fingerprint.addBytes(venue.usable.data(), venue.usable.size());
  transport::addTo(fingerprint, venue.transport);
  return fingerprint.hex();
}

}  // namespace

void keepWindows(const calibration::CalibrationFolder& folder, const compensation::MeasuredVenue& venue,
                 const inverse::WindowSettings& settings, const inverse::WindowInverse& windows) {
  try {
    inverse::saveWindows(fileIn(folder), windows, keyOf(venue, settings));
  } catch (const DiskFull&) {
    std::error_code isOld;  // as good as none: it has another key
    fs::remove(fileIn(folder), isOld);
  }
}

void prepareWindows(const calibration::PreparedFiles& files, const compensation::MeasuredVenue& venue,
                    const inverse::WindowSettings& settings, const inverse::WindowInverse& windows) {
  try {
    inverse::saveWindows(files.folder() / fileName, windows, keyOf(venue, settings));
  } catch (const DiskFull&) {  // NOLINT(bugprone-empty-catch): there is no file then, which says so
  }
}

void keepWindows(const calibration::CalibrationFolder& folder, const calibration::PreparedFiles& files) {
  files.moveTo(folder.path() / "results");
}

std::optional<inverse::WindowInverse> keptWindows(const calibration::CalibrationFolder& folder,
                                                  const compensation::MeasuredVenue& venue,
                                                  const inverse::WindowSettings& settings) {
  std::error_code code;
  if (!fs::exists(fileIn(folder), code)) return std::nullopt;
  try {
    return inverse::loadWindows(fileIn(folder), keyOf(venue, settings));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::format && error.kind() != ErrorKind::disk) throw;
    return std::nullopt;  // can be made again, with the same bits
  }
}

}  // namespace relucent::pipeline
