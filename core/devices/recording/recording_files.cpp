// SPDX-License-Identifier: MIT
#include "relucent/devices/recording/recording_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/file_name.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parsed_json.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/platform/files.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* formatName = "relucent recording";
constexpr const char* devicesName = "recording.json";
constexpr const char* photographsName = "photographs.jsonl";

Json toJson(Size size) {
  return Json::array({size.width, size.height});
}
Size sizeFrom(const Json& json) {
  const Size size{json.at(0), json.at(1)};
  if (size.empty() || size.width > 1 << 16 || size.height > 1 << 16)
    throw std::out_of_range("an impossible size");
  return size;
}

[[noreturn]] void failDamaged(const fs::path& file, const std::exception& cause) {
  throw Error(
      ErrorKind::format,
      RELUCENT_ENGLISH_MESSAGE("device.recording-damaged", "the recording is damaged ({})")
          .with(cause.what()),
      RELUCENT_ENGLISH_MESSAGE("device.restore-or-record-again", "restore it from a copy, or record again"),
      file.string());
}

RecordedPhotograph photographFrom(const Json& json) {
  RecordedPhotograph photograph;
  photograph.camera = json.at("camera");
  photograph.shot = {json.at("stage"), json.at("number")};
  photograph.exposure = json.at("exposure");
  photograph.asked = json.at("asked");
  photograph.seconds = json.at("seconds");
  photograph.bits = json.at("bits");
  photograph.file = json.at("file");
  if (!isFileName(photograph.file)) throw std::out_of_range("a photograph that lies elsewhere");
  photograph.patterns = json.at("patterns").get<std::vector<std::string>>();
  return photograph;
}

}  // namespace

RecordedDevices devicesOf(const rig::Rig& rig) {
  RecordedDevices devices;
  for (const auto& projector : rig.projectors)
    devices.projectors.push_back({projector->name(), projector->size(), projector->bits()});
  for (const auto& camera : rig.cameras) {
    const rig::ExposureRange range = camera->exposures();
    devices.cameras.push_back({camera->name(), camera->size(), range.shortest, range.longest});
  }
  return devices;
}

void writeRecordedDevices(const fs::path& folder, const RecordedDevices& devices) {
  Json json = {{"format", formatName}, {"version", recording::version}};
  json["projectors"] = Json::array();
  for (const auto& projector : devices.projectors)
    json["projectors"].push_back(
        {{"name", projector.name}, {"size", toJson(projector.size)}, {"bits", projector.bits}});
  json["cameras"] = Json::array();
  for (const auto& camera : devices.cameras)
    json["cameras"].push_back({{"name", camera.name},
                               {"size", toJson(camera.size)},
                               {"exposures", {camera.shortest, camera.longest}}});
  writeFileAtomically(folder / devicesName, json.dump(2) + "\n");
}

RecordedDevices readRecordedDevices(const fs::path& folder) {
  const fs::path file = folder / devicesName;
  const std::string content = readFile(file);
  try {
    const Json json = parsedJson<Json>(content);
    if (json.at("format") != formatName)
      throw Error(
          ErrorKind::format, RELUCENT_ENGLISH_MESSAGE("device.not-a-recording", "this is not a recording"),
          RELUCENT_ENGLISH_MESSAGE("device.name-recorded-folder", "name the folder that `--record` wrote"),
          file.string());
    if (const int version = json.at("version"); version > recording::version)
      throw Error(
          ErrorKind::format,
          RELUCENT_ENGLISH_MESSAGE("device.recording-of-newer-version", "the recording is of version {}")
              .with(as::label(version)),
          RELUCENT_ENGLISH_MESSAGE("device.update-relucent",
                                   "open it with the version of Relucent that made it, or a later one"),
          file.string());
    RecordedDevices devices;
    for (const Json& projector : json.at("projectors"))
      devices.projectors.push_back(
          {projector.at("name"), sizeFrom(projector.at("size")), projector.at("bits")});
    for (const Json& camera : json.at("cameras"))
      devices.cameras.push_back({camera.at("name"), sizeFrom(camera.at("size")), camera.at("exposures").at(0),
                                 camera.at("exposures").at(1)});
    return devices;
  } catch (const Json::exception& cause) {
    failDamaged(file, cause);
  } catch (const std::out_of_range& cause) {
    failDamaged(file, cause);
  }
}

void appendPhotograph(const fs::path& folder, const RecordedPhotograph& photograph) {
  const Json json = {
      {"camera", photograph.camera},     {"stage", photograph.shot.stage}, {"number", photograph.shot.number},
      {"exposure", photograph.exposure}, {"asked", photograph.asked},      {"seconds", photograph.seconds},
      {"bits", photograph.bits},         {"file", photograph.file},        {"patterns", photograph.patterns}};
  // Begins a new line, in case the last one was cut short.
  const std::string line = fmt::format("\n{}", json.dump());
  const fs::path file = folder / photographsName;
  if (const platform::FileOutcome outcome = platform::appendContent(file, line); outcome.code)
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("device.cannot-write-recording", "the recording cannot be written ({})")
            .with(outcome.code.message()),
        RELUCENT_MESSAGE("device.free-space-or-record-elsewhere", "free some space, or record elsewhere"),
        file.string());
}

std::vector<RecordedPhotograph> readPhotographs(const fs::path& folder) {
  std::vector<RecordedPhotograph> photographs;
  const fs::path file = folder / photographsName;
  std::error_code code;
  if (!fs::exists(file, code)) return photographs;
  std::istringstream lines(readFile(file));
  for (std::string line; std::getline(lines, line);) {
    Json json;
    try {
      json = parsedJson<Json>(line);
    } catch (const Json::parse_error&) {
      continue;  // cut short
    } catch (const Json::exception& cause) {
      failDamaged(file, cause);
    }
    try {
      photographs.push_back(photographFrom(json));
    } catch (const Json::exception& cause) {
      failDamaged(file, cause);
    } catch (const std::out_of_range& cause) {
      failDamaged(file, cause);
    }
  }
  return photographs;
}

std::string patternFingerprint(const image::Image& encodedDrive) {
  return Fingerprint().add(encodedDrive.width()).add(encodedDrive.height()).add(encodedDrive.data()).hex();
}

}  // namespace relucent::devices
