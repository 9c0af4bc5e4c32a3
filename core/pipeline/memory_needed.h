// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/acquisition/settings.h"
#include "relucent/base/raster.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/platform/memory_limits.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/rig/rig.h"

/// Whether there is memory for what is about to begin. Forecasts are of what it takes on top of what the
/// program has already. Of what may lie on the disk a quarter is counted as resident: less, and the work
/// would wait for the disk.
namespace relucent::pipeline {

/// What measuring the light transport takes by its forecast (acquisition/forecast.h), which may be a fifth
/// too low, and what the rest of a calibration takes.
platform::MemoryUse memoryNeeded(const Rasters& cameras, const Rasters& projectors,
                                 const acquisition::AcquisitionSettings& settings);
/// What an import takes by its forecast (importing/memory.h).
platform::MemoryUse memoryOfImport(Size projector, Size camera, int pictures);

/// Before a measurement begins. Throws: Error{memory} if `needed` does not fit.
void ensureMemory(const platform::MemoryUse& needed, const platform::MemoryUse& memory,
                  const reduction::PixelUse& pixels);
/// Before devices that were chosen earlier measure: there may be less memory than there was then.
/// Throws: Error{memory} if it is less than the forecast itself, without anything to spare.
void ensureMemory(const rig::Rig& used, const CalibrateSettings& settings, const platform::MemoryUse& memory);
/// Before an import. Throws: Error{memory} if `needed` does not fit.
void ensureMemoryForImport(const platform::MemoryUse& needed, const platform::MemoryUse& memory,
                           const reduction::PixelUse& pixels);

}  // namespace relucent::pipeline
