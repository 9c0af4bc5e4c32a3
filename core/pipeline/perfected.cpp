// SPDX-License-Identifier: MIT
#include "relucent/pipeline/perfected.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/file_name.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/image/exr.h"
#include "relucent/pipeline/picture_error_json.h"
#include "relucent/pipeline/proof_record.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr const char* recordName = "perfected.json";
constexpr int recordVersion = 1;

fs::path recordOf(const fs::path& calibration, const std::string& key) {
  return perfectedFolder(calibration) / key / recordName;
}

/// A file's name and nothing that leads elsewhere.
std::string plainName(const std::string& name) {
  if (isFileName(name)) return name;
  throw Error(
      ErrorKind::format,
      RELUCENT_ENGLISH_MESSAGE("perfect.file-elsewhere", "'{}' is no name of a file of it").with(name),
      RELUCENT_ENGLISH_MESSAGE("perfect.again", "perfect the picture again"));
}

PerfectedPicture recordFrom(const fs::path& calibration, const std::string& key) {
  const fs::path file = recordOf(calibration, key);
  try {
    const calibration::Json json = parsedJson<calibration::Json>(readFile(file));
    if (json.value("version", recordVersion) > recordVersion)
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("perfect.of-newer-version",
                                           "a newer Relucent perfected this picture, for shows of its own"),
                  RELUCENT_ENGLISH_MESSAGE("perfect.again", "perfect the picture again"), file.string());
    PerfectedPicture picture;
    picture.key = key;
    picture.folder = calibration;
    picture.picture = json.at("picture").get<std::string>();
    picture.perfected = json.at("perfected").get<std::string>();
    picture.figures = {json.at("before").get<std::vector<PictureError>>(),
                       json.at("after").get<std::vector<PictureError>>(), json.at("photographs").get<int>()};
    picture.shownFrom = json.value("shown_from", std::string());
    if (json.contains("canvas")) {
      const calibration::Json& canvas = json.at("canvas");
      picture.canvas = {{canvas.at("width").get<int>(), canvas.at("height").get<int>()},
                        canvas.at("fit").get<compensation::Fit>()};
    }
    for (const calibration::Json& name : json.at("files"))
      picture.files.push_back(plainName(name.get<std::string>()));
    return picture;
  } catch (const calibration::Json::exception& cause) {
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("perfect.record-unreadable",
                                         "the record of a perfected picture cannot be read ({})")
                    .with(cause.what()),
                RELUCENT_ENGLISH_MESSAGE("perfect.again", "perfect the picture again"), file.string());
  }
}

/// What no record names: of one that was replaced, or of a program that was killed while it wrote.
void removeOthers(const fs::path& folder, const std::vector<std::string>& files) {
  std::error_code ignored;  // what stays takes room and nothing else
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        name != recordName && std::ranges::count(files, name) == 0)
      fs::remove(entry.path(), ignored);
}

}  // namespace

fs::path perfectedFolder(const fs::path& calibration) {
  return calibration / "perfected";
}

std::string perfectedKey(const std::string& shownFrom, const std::string& content) {
  return Fingerprint().add(shownFrom).add(content).hex();
}

std::string perfectedKeyOf(const calibration::CalibrationFolder& folder, const fs::path& file, Size picture,
                           const compensation::ContentCanvas& canvas) {
  return perfectedKey(fingerprintOfShown(folder), contentIdentity(readFile(file), picture, canvas));
}

std::vector<fs::path> savePerfected(PerfectedPicture picture, const ProjectorStack& projector,
                                    const Rasters& projectors) {
  const fs::path folder = perfectedFolder(picture.folder) / picture.key;
  createFolder(folder);
  picture.files.clear();
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    const image::Image drive = image::imageFromStack(projector, projectors, device);
    // Named by what they hold: files that a record names already are never written to.
    const std::string name = fmt::format("projector-{}-{:.8}.exr", device + 1,
                                         Fingerprint().add(picture.perfected).add(drive.data()).hex());
    image::writeExr(folder / name, drive, image::ExrType::half,
                    {{image::exr_attribute::units, std::string("linear projector drive")}});
    picture.files.push_back(name);
  }
  calibration::Json record{{"version", recordVersion},       {"picture", picture.picture},
                           {"perfected", picture.perfected}, {"before", picture.figures.before},
                           {"after", picture.figures.after}, {"photographs", picture.figures.photographs},
                           {"files", picture.files},         {"shown_from", picture.shownFrom}};
  if (picture.canvas)
    record["canvas"] = {{"width", picture.canvas->size.width},
                        {"height", picture.canvas->size.height},
                        {"fit", picture.canvas->fit}};
  writeFileAtomically(folder / recordName, record.dump(2));
  removeOthers(folder, picture.files);
  std::vector<fs::path> files{folder / recordName};
  for (const std::string& name : picture.files) files.push_back(folder / name);
  return files;
}

std::optional<PerfectedPicture> findPerfected(const fs::path& calibration, const std::string& key) {
  if (!fs::exists(recordOf(calibration, key))) return std::nullopt;
  return recordFrom(calibration, key);
}

ProjectorStack driveOf(const PerfectedPicture& picture, const Rasters& projectors) {
  std::vector<image::Image> drive;
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    if (picture.files.size() != projectors.devices())
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("perfect.other-projectors",
                                           "a perfected picture is of {} projectors, and there are {}")
                      .with(picture.files.size(), projectors.devices()),
                  RELUCENT_ENGLISH_MESSAGE("perfect.again", "perfect the picture again"));
    drive.push_back(image::readRgbExr(perfectedFolder(picture.folder) / picture.key / picture.files[device],
                                      projectors.size(device)));
  }
  return ProjectorStack(image::stackFromImages(drive, projectors));
}

std::vector<PerfectedPicture> allPerfected(const fs::path& calibration) {
  std::vector<PerfectedPicture> all;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(perfectedFolder(calibration), missing)) {
    const std::string key = entry.path().filename().string();
    if (!fs::exists(recordOf(calibration, key))) continue;
    try {
      all.push_back(recordFrom(calibration, key));
    } catch (const Error&) {  // one that is damaged hides no others
    }
  }
  std::ranges::sort(all, {}, &PerfectedPicture::key);
  return all;
}

std::string perfectedState(const fs::path& calibration) {
  std::vector<std::string> records;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(perfectedFolder(calibration), missing)) {
    const std::string key = entry.path().filename().string();
    std::error_code none;
    const fs::file_time_type written = fs::last_write_time(recordOf(calibration, key), none);
    if (!none) records.push_back(fmt::format("{} {}", key, written.time_since_epoch().count()));
  }
  std::ranges::sort(records);
  Fingerprint fingerprint;
  for (const std::string& record : records) fingerprint.add(record);
  return fingerprint.hex();
}

void removePerfected(const PerfectedPicture& picture) {
  const fs::path folder = perfectedFolder(picture.folder) / picture.key;
  std::error_code failed;
  fs::remove(folder / recordName, failed);  // first: without it the others are nothing
  if (failed)
    throw Error(ErrorKind::disk,
                RELUCENT_ENGLISH_MESSAGE("disk.cannot-remove", "cannot remove ({})").with(failed.message()),
                RELUCENT_MESSAGE("disk.check-path-and-disk", "check the path and the disk"), folder.string());
  fs::remove_all(folder, failed);
}

}  // namespace relucent::pipeline
