// SPDX-License-Identifier: MIT
#pragma once

#include <kainjow/mustache.hpp>

#include "relucent/report/report_data.h"

namespace relucent::report {

/// What the template page.html asks for, by the names there. Texts are escaped when it is rendered; charts
/// are SVG already, style sheet and pictures are taken as they are.
/// Throws: std::logic_error if images of a comparison differ in size.
kainjow::mustache::data pageOf(const ReportData& data);

}  // namespace relucent::report
