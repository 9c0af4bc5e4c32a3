// SPDX-License-Identifier: MIT
#include "relucent/report/support_bundle.h"

#include <fmt/format.h>
#include <zip.h>

#include <map>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/versions.h"
#include "relucent/platform/system_description.h"

namespace relucent::report {
namespace fs = std::filesystem;
namespace {

using Entries = std::map<std::string, std::string>;  // names within the archive, contents

bool isPictureOfTheVenue(const fs::path& file) {
  std::string name = file.filename().string();
  return name.rfind("flood", 0) == 0 || name.rfind("black", 0) == 0;
}

/// Regular files below a folder that `wanted` says yes to, by their path within the calibration.
template <typename Wanted>
void addFolder(Entries& entries, const fs::path& calibration, const char* name, const Wanted& wanted) {
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(calibration / name, missing))
    if (entry.is_regular_file() && wanted(entry.path()))
      entries[fs::relative(entry.path(), calibration).generic_string()] = readFile(entry.path());
}

Error cannotWrite(const fs::path& path, const std::string& reason) {
  return {ErrorKind::disk, RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(reason),
          RELUCENT_ENGLISH_MESSAGE("disk.check-space-and-permission",
                                   "check that the disk has room and that you may write there"),
          path.string()};
}

void writeZip(const fs::path& path, const Entries& entries) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    int code = 0;
    zip_t* archive = zip_open(temporary.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (archive == nullptr) throw cannotWrite(path, fmt::format("libzip says {}", code));
    auto giveUp = [&] {
      Error failure = cannotWrite(path, zip_strerror(archive));
      zip_discard(archive);
      throw failure;
    };
    for (const auto& [name, content] : entries) {
      zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
      if (source == nullptr) giveUp();
      zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
      if (index < 0) {
        zip_source_free(source);
        giveUp();
      }
      // The first of January 1980, as in the light transport's files.
      if (zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 0x21, 0) != 0) giveUp();
    }
    if (zip_close(archive) != 0) giveUp();
  });
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
  Entries entries;
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
