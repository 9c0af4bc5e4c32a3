// SPDX-License-Identifier: MIT
#include "relucent/pipeline/export.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/image/stack_files.h"
#include "relucent/mapping/cube_lut.h"
#include "relucent/mapping/mpcdi.h"
#include "relucent/pipeline/content_settings.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"
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
  std::transform(measured.acquisition.variance.flood.begin(), measured.acquisition.variance.flood.end(),
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

/// What a media server with these maps loses against this program, by T, on the usual pictures.
Message lossOf(const mapping::ProjectorMaps& maps, const compensation::Compensator& compensator, Size canvas,
               const compensation::TargetSettings& settings, Progress& progress) {
  constexpr int longerSide = 480;
  const double scale = static_cast<double>(longerSide) / std::max(canvas.width, canvas.height);
  const Size size{std::max(1, static_cast<int>(std::lround(scale * canvas.width))),
                  std::max(1, static_cast<int>(std::lround(scale * canvas.height)))};
  const std::vector<NamedImage> pictures = standardImages(size);
  double player = 0.0, native = 0.0;
  for (const NamedImage& picture : pictures) {
    Progress one = progress.part(1.0 / static_cast<double>(pictures.size()), {});
    const compensation::Target target = fitTarget(picture.linear, compensator.venue(), settings);
    compensation::Compensation shown;
    shown.projector = mapping::shownBy(maps, picture.linear);
    player += predict(compensator.venue(), target, shown).psnrReachable;
    native +=
        predict(compensator.venue(), target, compensator.solve(compensation::Method::refined, target, one))
            .psnrReachable;
  }
  const auto count = static_cast<double>(pictures.size());
  return RELUCENT_ENGLISH_MESSAGE("export.loss",
                                  "by what was measured, players that use these maps show the usual pictures "
                                  "with {} dB, Relucent with {} dB")
      .with(as::decibels(player / count, as::decimals(1)), as::decibels(native / count, as::decimals(1)));
}

void writePlayerMaps(const fs::path& folder, const mapping::ProjectorMaps& maps,
                     const linearization::Linearization& linearization, WrittenFiles& written) {
  createFolder(folder);
  constexpr int maskBits = 16;
  for (std::size_t projector = 0; projector < maps.projectors.devices(); ++projector) {
    const auto file = [&](const char* stem, const char* extension) {
      return written.files.emplace_back(folder / fmt::format("{}-{}.{}", stem, projector + 1, extension));
    };
    const std::array<float, 2>* place = maps.place.data() + maps.projectors.offset(projector);
    image::Image stMap(maps.projectors.size(projector), 3);
    for (std::size_t j = 0; j < stMap.pixels(); ++j) {
      stMap.pixel(j)[0] = place[j][0];
      stMap.pixel(j)[1] = 1.0f - place[j][1];
    }
    image::writeExr(file("st", "exr"), stMap, image::ExrType::floatType,
                    {{image::exr_attribute::units, std::string("share of the content, from lower left")}});
    image::writePng(file("mask", "png"), image::imageFromStack(maps.alpha, maps.projectors, projector),
                    maskBits);
    writeFileAtomically(file("response", "cube"),
                        mapping::cubeLut(linearization.projectors[projector],
                                         fmt::format("Response of projector {}", projector + 1)));
  }
}

/// For media servers. The content's place, its white and its views are those of the calibration.
void exportForPlayers(const calibration::CalibrationFolder& folder, const ExportSettings& settings,
                      const MeasuredCalibration& measured, WrittenFiles& written, Progress& progress) {
  const compensation::TargetSettings target = targetOf(settingsOf(folder).content);
  const compensation::Compensator compensator(measured.venue, measured.inverse);
  Progress mapping = progress.part(0.3, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
  const mapping::ProjectorMaps maps = mapping::projectorMaps(compensator, settings.canvas, target, mapping);
  if (!settings.mpcdi.empty()) {
    const std::time_t now = std::time(nullptr);
    mapping::writeMpcdi(settings.mpcdi, maps, settings.canvas,
                        fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(now)));
    written.files.push_back(settings.mpcdi);
  }
  if (!settings.playerMaps.empty())
    writePlayerMaps(settings.playerMaps, maps, measured.linearization, written);
  Progress judging = progress.part(
      0.7, RELUCENT_ENGLISH_MESSAGE("stage.judging-maps", "Comparing with what Relucent itself shows"));
  written.notes.push_back(lossOf(maps, compensator, settings.canvas, target, judging));
}

}  // namespace

WrittenFiles exportCalibration(const fs::path& path, const ExportSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("calibration.name-something-to-export",
                                         "name at least one thing to export"));
  const calibration::CalibrationFolder folder = openWithSet(path, settings.set);
  Progress loading =
      progress.part(0.4, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading, Held::allMeasured);

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
  if (!settings.mpcdi.empty() || !settings.playerMaps.empty())
    exportForPlayers(folder, settings, measured, written, writing);
  progress.report(1.0);
  return written;
}

}  // namespace relucent::pipeline
