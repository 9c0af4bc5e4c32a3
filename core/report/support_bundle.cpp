// SPDX-License-Identifier: MIT
#include "relucent/report/support_bundle.h"

#include <fmt/format.h>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/zip_file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/versions.h"
#include "relucent/platform/system_description.h"

namespace relucent::report {
namespace fs = std::filesystem;
namespace {

bool isPictureOfTheVenue(const fs::path& file) {
  std::string name = file.filename().string();
  return name.rfind("flood", 0) == 0 || name.rfind("black", 0) == 0;
}

/// Regular files below a folder that `wanted` says yes to, by their path within the calibration.
template <typename Wanted>
void addFolder(ZipEntries& entries, const fs::path& calibration, const char* name, const Wanted& wanted) {
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(calibration / name, missing))
    if (entry.is_regular_file() && wanted(entry.path()))
      entries[fs::relative(entry.path(), calibration).generic_string()] = readFile(entry.path());
}

}  // namespace

ReportData withoutPhotographs(ReportData data) {
  data.flood = image::Image();
  data.black = image::Image();
  data.flagged.clear();
  data.comparisons.clear();
  data.verification.reset();
  return data;
}

void writeSupportBundle(const fs::path& calibration, const ReportData& data, const ReportSettings& settings) {
  ZipEntries entries;
  entries["calibration.relucent"] = readFile(calibration / calibration::CalibrationFolder::manifestName);
  entries["report.html"] = reportHtml(settings.photographs ? data : withoutPhotographs(data));
  entries["versions.txt"] = pipeline::versionText("Relucent", data.libraries);
  entries["computer.txt"] = platform::systemDescription();
  if (settings.photographs) {
    addFolder(entries, calibration, "verification", [](const fs::path&) { return true; });
    addFolder(entries, calibration, "results", isPictureOfTheVenue);
  }
  std::error_code ignored;
  for (const fs::path& file : settings.attachments)
    if (fs::is_regular_file(file, ignored)) entries["attached/" + file.filename().string()] = readFile(file);
  writeZip(settings.bundle, entries);
}

}  // namespace relucent::report
