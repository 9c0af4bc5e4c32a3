// SPDX-License-Identifier: MIT
#include "pipeline/export.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "pipeline/measured_venue.h"
#include "transport/files.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

void writeMap(const fs::path& folder, const std::string& name, const Stack& stack, const Rasters& rasters,
              const std::string& units, WrittenFiles& written) {
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    fs::path path = folder / fmt::format("{}-{}.exr", name, device + 1);
    writeExr(path, imageFromStack(stack, rasters, device), ExrType::floatType,
             {{exr_attribute::units, units}});
    written.files.push_back(path);
  }
}

Stack threeChannels(const std::vector<std::uint8_t>& mask) {
  Stack stack(3 * mask.size());
  for (std::size_t i = 0; i < stack.size(); ++i) stack[i] = mask[i / 3] != 0 ? 1.0f : 0.0f;
  return stack;
}

void writeMaps(const fs::path& folder, const MeasuredCalibration& measured, WrittenFiles& written) {
  createFolder(folder);
  const MeasuredVenue& venue = measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  Stack brightest = venue.flood;
  for (std::size_t i = 0; i < brightest.size(); ++i) brightest[i] += venue.black[i];
  Stack noise(venue.flood.size());
  std::transform(measured.acquisition.floodVariance.begin(), measured.acquisition.floodVariance.end(),
                 noise.begin(), [](float variance) { return std::sqrt(variance); });
  const char* radiance = "camera signal per second";
  writeMap(folder, "black", venue.black, cameras, radiance, written);
  writeMap(folder, "flood", venue.flood, cameras, radiance, written);
  writeMap(folder, "flood-noise", noise, cameras, radiance, written);
  writeMap(folder, "reachable-brightest", brightest, cameras, radiance, written);
  writeMap(folder, "usable", threeChannels(venue.usable), cameras, "1 where compensation relies on it",
           written);
  writeMap(folder, "flagged", threeChannels(measured.acquisition.flagged), cameras,
           "1 where verification failed", written);
}

}  // namespace

WrittenFiles exportCalibration(const fs::path& path, const ExportSettings& settings, Progress& progress) {
  if (std::vector<std::string> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(), "name at least one thing to export");
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  Progress loading = progress.part(0.4, "Reading the calibration");
  MeasuredCalibration measured = loadCalibration(folder, loading);

  WrittenFiles written;
  Progress writing = progress.part(0.6, "Writing");
  if (!settings.transport.empty()) {
    PixelExpansion expansion = expandedToPixels(measured.venue.transport, {.bytes = settings.mostBytes});
    writing.report(0.3);
    saveExpanded(settings.transport, expansion);
    written.files.push_back(settings.transport);
    written.notes.push_back(expansion.summary());
  }
  if (!settings.leaves.empty()) {
    saveTransport(settings.leaves, measured.venue.transport);
    written.files.push_back(settings.leaves);
  }
  writing.report(0.6);
  if (!settings.inverse.empty()) {
    saveBlocks(settings.inverse, measured.inverse.matrix());
    written.files.push_back(settings.inverse);
  }
  if (!settings.maps.empty()) writeMaps(settings.maps, measured, written);
  progress.report(1.0);
  return written;
}

}  // namespace relucent
