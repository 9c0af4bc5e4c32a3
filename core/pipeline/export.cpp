// SPDX-License-Identifier: MIT
#include "relucent/pipeline/export.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/image/stack_files.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/transport/files.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

void writeMaps(const fs::path& folder, const MeasuredCalibration& measured, WrittenFiles& written) {
  createFolder(folder);
  const compensation::MeasuredVenue& venue = measured.venue;
  const Rasters& cameras = venue.transport.cameras();
  Stack brightest = venue.flood;
  for (std::size_t i = 0; i < brightest.size(); ++i) brightest[i] += venue.black[i];
  Stack noise(venue.flood.size());
  std::transform(measured.acquisition.floodVariance.begin(), measured.acquisition.floodVariance.end(),
                 noise.begin(), [](float variance) { return std::sqrt(variance); });
  const char* radiance = "camera signal per second";
  auto write = [&](const std::string& name, const Stack& stack, const std::string& units) {
    for (fs::path& file : image::writeStack(folder, name, stack, cameras, units))
      written.files.push_back(std::move(file));
  };
  write("black", venue.black, radiance);
  write("flood", venue.flood, radiance);
  write("flood-noise", noise, radiance);
  write("reachable-brightest", brightest, radiance);
  write("usable", image::stackFromFlags(venue.usable), "1 where compensation relies on it");
  write("flagged", image::stackFromFlags(measured.acquisition.flagged), "1 where verification failed");
}

}  // namespace

WrittenFiles exportCalibration(const fs::path& path, const ExportSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("calibration.name-something-to-export",
                                         "name at least one thing to export"));
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  Progress loading =
      progress.part(0.4, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading);

  WrittenFiles written;
  Progress writing = progress.part(0.6, RELUCENT_MESSAGE("stage.writing", "Writing"));
  if (!settings.transport.empty()) {
    transport::PixelExpansion expansion =
        transport::expandedToPixels(measured.venue.transport, {.bytes = settings.mostBytes});
    writing.report(0.3);
    transport::saveExpanded(settings.transport, expansion);
    written.files.push_back(settings.transport);
    written.notes.push_back(expansion.summary());
  }
  if (!settings.leaves.empty()) {
    transport::saveTransport(settings.leaves, measured.venue.transport);
    written.files.push_back(settings.leaves);
  }
  writing.report(0.6);
  if (!settings.inverse.empty()) {
    transport::saveBlocks(settings.inverse, measured.inverse.matrix());
    written.files.push_back(settings.inverse);
  }
  if (!settings.maps.empty()) writeMaps(settings.maps, measured, written);
  progress.report(1.0);
  return written;
}

}  // namespace relucent::pipeline
