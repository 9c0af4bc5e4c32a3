// SPDX-License-Identifier: MIT
#include "relucent/pipeline/reductions.h"

#include <algorithm>
#include <numeric>

#include "relucent/acquisition/forecast.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/memory_needed.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/platform/memory_limits.h"
#include "relucent/reduction/choice.h"
#include "relucent/reduction/reduced_rig.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using reduction::Reduction;

bool hasPhotographs(const calibration::CalibrationFolder& folder, calibration::Stage stage) {
  const std::string begin = fmt::format("{}-", nameOf(stage));
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.shotFolder(), code))
    if (entry.is_regular_file(code) && entry.path().filename().string().starts_with(begin)) return true;
  return false;
}

/// No choice leaves fewer pixels.
Rasters smallestOf(const Rasters& cameras) {
  std::vector<Size> sizes;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    sizes.push_back(
        {std::min(size.width, reduction::leastSide), std::min(size.height, reduction::leastSide)});
  }
  return Rasters(std::move(sizes));
}

}  // namespace

void chooseReductions(calibration::CalibrationFolder& folder, rig::Rig& rig,
                      const platform::MemoryUse& memory, Progress& progress) {
  if (hasReductions(folder) || hasPhotographs(folder, calibration::Stage::linearization)) return;
  const CalibrateSettings settings = settingsOf(folder);
  const Rasters projectors = rig.projectorRasters();
  const reduction::Fits fits = [&](const Rasters& cameras) {
    return platform::fits(memoryNeeded(cameras, projectors, settings.acquisition), memory);
  };
  auto ensureRoom = [&](const Rasters& cameras) {
    ensureMemory(memoryNeeded(cameras, projectors, settings.acquisition), memory, settings.pixels);
  };
  const bool usesAll = settings.pixels.kind == reduction::PixelUse::Kind::all;
  ensureRoom(usesAll ? rig.cameraRasters() : smallestOf(rig.cameraRasters()));
  const std::vector<Reduction> chosen =
      reduction::chooseReductions(rig, settings.pixels, settings.linearization.seed, fits, progress);
  ensureRoom(chosen.empty() ? rig.cameraRasters() : reduction::reducedRasters(chosen));
  // Where there was nothing to choose, the manifest is what it would be without any of this.
  keepReductions(folder, chosen);
}

void chooseReductions(calibration::CalibrationFolder& folder, rig::Rig& rig, Progress& progress) {
  chooseReductions(folder, rig, platform::memoryLeft(), progress);
}

void changePixels(calibration::CalibrationFolder& folder, const reduction::PixelUse& use) {
  CalibrateSettings settings = settingsOf(folder);
  if (settings.pixels == use) return;
  setShotsAside(folder, calibration::Stage::linearization);
  setShotsAside(folder, calibration::Stage::acquisition);
  settings.pixels = use;
  changeSettings(folder, settings);
  if (use.kind == reduction::PixelUse::Kind::all)
    keepReductions(folder, {});
  else
    forgetReductions(folder);
}

rig::Rig reducedRig(const calibration::CalibrationFolder& folder, rig::Rig& rig) {
  return reduction::reduced(rig, reductionsOf(folder));
}

std::vector<PixelForecast> pixelForecasts(const rig::Rig& rig, const linearization::ExposureChoice& exposures,
                                          const rig::ShotTimes& took,
                                          const acquisition::AcquisitionSettings& settings,
                                          const platform::MemoryUse& memory) {
  using Kind = reduction::PixelUse::Kind;
  const Size camera = rig.cameras.front()->size();
  const Rasters projectors = rig.projectorRasters();
  if (!reduction::needsLook(camera, projectors.count(), {})) return {};
  const int stride = reduction::strideFor(camera, reduction::mostLookedAt);
  const image::Image light = reduction::lightOf(exposures, 0, {}, stride);
  constexpr double bytesOfASample = 2.0;  // whole codes of more than eight bits
  std::vector<PixelForecast> forecasts;
  for (const reduction::PixelUse& use :
       {reduction::PixelUse{}, reduction::PixelUse{Kind::all}, reduction::PixelUse{Kind::binned, 2},
        reduction::PixelUse{Kind::binned, 3}, reduction::PixelUse{Kind::binned, 4}}) {
    Size used = camera;
    if (use.kind != Kind::all) {
      Reduction reduction = reduction::reductionFor(camera, projectors.count(), use, light, stride);
      while (use.kind == Kind::automatic &&
             !platform::fits(memoryNeeded(Rasters(reduction.size()), projectors, settings), memory)) {
        const auto larger = reduction::withLargerBins(reduction, projectors.count(), light, stride);
        if (!larger) break;
        reduction = *larger;
      }
      used = reduction.size();
    }
    rig::ShotTimes benchmark = took;
    if (!(used == camera))
      benchmark.bytes = static_cast<std::uint64_t>(bytesOfASample * 3.0 * static_cast<double>(used.count()) *
                                                   benchmark.exposures);
    const double mean = std::accumulate(exposures.seconds.begin(), exposures.seconds.end(), 0.0) /
                        static_cast<double>(exposures.seconds.size());
    const acquisition::ForecastDevices devices{Rasters(used), projectors, exposures.seconds.size(), mean};
    forecasts.push_back({use, camera, used, acquisition::forecast(devices, settings, benchmark, {})});
  }
  return forecasts;
}

std::vector<Message> findingsOf(const std::vector<Reduction>& reductions) {
  std::vector<Message> findings;
  for (const Reduction& reduction : reductions) {
    if (reduction.isNothing()) continue;
    if (reduction.savesMemory) {
      findings.push_back(
          RELUCENT_MESSAGE("reduction.binned-for-memory",
                           "of the camera's {} pixels, {} are made: every {} become one, as there is memory "
                           "for no more")
              .with(as::size(reduction.camera), as::size(reduction.size()),
                    as::size({reduction.bin, reduction.bin})));
      continue;
    }
    findings.push_back(reduction.bin == 1
                           ? RELUCENT_MESSAGE("reduction.cropped",
                                              "of the camera's {} pixels, the {} around what is lit are used")
                                 .with(as::size(reduction.camera), as::size(reduction.size()))
                           : RELUCENT_MESSAGE("reduction.binned",
                                              "of the camera's {} pixels, {} are made: of the part around "
                                              "what is lit, every {} become one")
                                 .with(as::size(reduction.camera), as::size(reduction.size()),
                                       as::size({reduction.bin, reduction.bin})));
  }
  return findings;
}

}  // namespace relucent::pipeline
