// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/pipeline/acquisition_bench.h"

namespace relucent::report {

/// What photographs buy: for every mode a curve through its thresholds, exposures (geometric mean of the
/// venues, linearization included, logarithmic) against the PSNR of *refined* (mean of the venues, dB). Modes
/// that were not tried in every venue are left out. A picture that stands alone, SVG.
std::string acquisitionChart(const pipeline::AcquisitionBenchResult& result);

}  // namespace relucent::report
