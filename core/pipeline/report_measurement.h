// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/pipeline/report.h"

/// The sections of a report on what was measured, as HTML; empty where the data has nothing of it.
namespace relucent::pipeline {

/// Floodlight image, reachable light, black level and flagged pixels.
std::string measuredPictures(const ReportData& data);

/// The projectors' response curves, additivity and exposures.
std::string responses(const ReportData& data);

/// T in figures: connections, leaves by block size, damping of the inverse, and errors where the truth is
/// known.
std::string transport(const ReportData& data);

}  // namespace relucent::pipeline
