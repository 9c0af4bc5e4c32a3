// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/report/report.h"

namespace relucent::report {

/// The same report without anything that shows the venue: no pictures, no maps.
ReportData withoutPhotographs(ReportData data);

/// One archive for whoever helps from afar: the calibration's manifest (devices, settings, results), the
/// report, versions, the computer, and settings.attachments. What shows the venue is in it only with
/// settings.photographs: the report's pictures, those of the verification, floods and blacks. Never the
/// thousands of photographs of the measurement. Equal content makes equal bytes.
/// Throws: Error{disk}.
void writeSupportBundle(const std::filesystem::path& calibration, const ReportData& data,
                        const ReportSettings& settings);

}  // namespace relucent::report
