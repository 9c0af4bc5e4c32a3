// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/report/page_data.h"
#include "relucent/report/report_data.h"

namespace relucent::report {

/// What was photographed to prove the venue, and what that says.
PageData verificationSection(const ReportData& data);

/// Sentences that everybody reads first: what is not as it should be, in warnings; what is proved, in
/// assurances. `warnings` and `assurances` are lists.
void addVerdicts(const ReportData& data, PageData& warnings, PageData& assurances);

}  // namespace relucent::report
