// SPDX-License-Identifier: MIT
#include "relucent/pipeline/memory_needed.h"

#include <array>

#include "relucent/acquisition/forecast.h"
#include "relucent/base/error.h"
#include "relucent/importing/memory.h"

namespace relucent::pipeline {
namespace {

// What simulated venues took beyond the forecast, 128x96 / 160x120 to 512x384 / 320x240: 10 to 170 MB.
constexpr double forecastMargin = 1.2;
constexpr double otherBytes = 150e6;
constexpr double mappedInMemory = 0.25;

/// Of what takes so many bytes in all, some of them mapped.
platform::MemoryUse useOf(std::uint64_t bytes, std::uint64_t mapped) {
  const double onDisk = (1.0 - mappedInMemory) * static_cast<double>(mapped);
  return {bytes - static_cast<std::uint64_t>(onDisk), bytes};
}

/// What the forecast says itself.
platform::MemoryUse forecastMemory(const Rasters& cameras, const Rasters& projectors,
                                   const acquisition::AcquisitionSettings& settings) {
  const acquisition::ForecastDevices devices{cameras, projectors, 1, 0.0};
  const WorkLeft work = acquisition::forecast(devices, settings, {}, {});
  return useOf(work.memoryBytes, work.mappedBytes);
}

Argument gigabytes(std::uint64_t bytes) {
  return as::number(static_cast<double>(bytes) / 1e9, as::decimals(2));
}

/// What is needed and what may be taken, of that of the two kinds of memory that is too little.
std::array<Argument, 2> inWords(const platform::MemoryUse& needed, const platform::MemoryUse& memory) {
  if (needed.resident > memory.resident) return {gigabytes(needed.resident), gigabytes(memory.resident)};
  return {gigabytes(needed.addressSpace), gigabytes(memory.addressSpace)};
}

Message fewerPixels() {
  return RELUCENT_MESSAGE("reduction.fewer-camera-pixels",
                          "choose fewer camera pixels: automatic ones are as many as fit");
}

}  // namespace

platform::MemoryUse memoryNeeded(const Rasters& cameras, const Rasters& projectors,
                                 const acquisition::AcquisitionSettings& settings) {
  const platform::MemoryUse forecast = forecastMemory(cameras, projectors, settings);
  auto needed = [](std::uint64_t bytes) {
    return static_cast<std::uint64_t>(forecastMargin * static_cast<double>(bytes) + otherBytes);
  };
  return {needed(forecast.resident), needed(forecast.addressSpace)};
}

platform::MemoryUse memoryOfImport(Size projector, Size camera, int pictures) {
  const importing::ImportMemory forecast = importing::importMemory(projector, camera, pictures);
  return useOf(forecast.bytes, forecast.mapped);
}

void ensureMemory(const platform::MemoryUse& needed, const platform::MemoryUse& memory,
                  const reduction::PixelUse& pixels) {
  if (platform::fits(needed, memory)) return;
  const auto [wanted, left] = inWords(needed, memory);
  throw Error(ErrorKind::memory,
              RELUCENT_MESSAGE("reduction.memory-too-little",
                               "measuring would take {} GB of memory, and {} GB may be taken")
                  .with(wanted, left),
              pixels.kind == reduction::PixelUse::Kind::automatic
                  ? RELUCENT_MESSAGE("reduction.more-memory-or-smaller-projector",
                                     "use a computer or a limit with more memory, or a projector signal of "
                                     "fewer pixels")
                  : fewerPixels());
}

void ensureMemory(const rig::Rig& used, const CalibrateSettings& settings,
                  const platform::MemoryUse& memory) {
  ensureMemory(forecastMemory(used.cameraRasters(), used.projectorRasters(), settings.acquisition), memory,
               settings.pixels);
}

void ensureMemoryForImport(const platform::MemoryUse& needed, const platform::MemoryUse& memory,
                           const reduction::PixelUse& pixels) {
  if (platform::fits(needed, memory)) return;
  const auto [wanted, left] = inWords(needed, memory);
  throw Error(ErrorKind::memory,
              RELUCENT_ENGLISH_MESSAGE("import.memory-too-little",
                                       "the import would take {} GB of memory, and {} GB may be taken")
                  .with(wanted, left),
              pixels.kind == reduction::PixelUse::Kind::automatic
                  ? RELUCENT_ENGLISH_MESSAGE("import.more-memory-or-fewer-pictures",
                                             "use a computer or a limit with more memory, or fewer pictures")
                  : fewerPixels());
}

}  // namespace relucent::pipeline
