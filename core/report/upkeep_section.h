// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/report/page_data.h"
#include "relucent/report/report_data.h"

namespace relucent::report {

/// Pictures that were corrected by photographs of themselves, and what the last nights came to.
/// Contract: there are some.
PageData upkeepSection(const ReportData& data);

/// The alarm of the last night, if it had one, among what everybody reads first. `warnings` is a list.
void addAlarm(const ReportData& data, PageData& warnings);

}  // namespace relucent::report
