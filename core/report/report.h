// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/written_files.h"
#include "relucent/report/report_data.h"

namespace relucent::report {

/// The report as one HTML page: styles, pictures and charts inside, nothing fetched from anywhere.
/// All texts are escaped. Throws: std::logic_error if images of a comparison differ in size.
std::string reportHtml(const ReportData& data);

/// Writes reportHtml() atomically. Throws: Error{disk}.
void writeReport(const std::filesystem::path& path, const ReportData& data);

struct ReportSettings {
  std::filesystem::path out;                  // the HTML file; empty: report.html in the calibration folder
  std::vector<std::filesystem::path> images;  // content shown before and after; none: the product's own
  bool evaluate = true;          // simulated venues: a table of methods through the true transport
  std::filesystem::path bundle;  // a .zip for whoever helps, support_bundle.h; empty: none
  bool photographs = false;      // also what shows the venue is in that
  std::vector<std::filesystem::path> attachments;   // files put into that, where they exist: logs
  std::vector<pipeline::LibraryVersion> libraries;  // named in the report; none: core's
};

/// One self-contained HTML file about a calibration, of pictures shown as its own content is.
pipeline::WrittenFiles makeReport(const std::filesystem::path& folder, const ReportSettings& settings,
                                  const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::report
