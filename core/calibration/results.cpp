// SPDX-License-Identifier: MIT
#include "relucent/calibration/results.h"

#include <algorithm>
#include <map>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/message_json.h"
#include "relucent/calibration/results_json.h"
#include "relucent/image/exr.h"
#include "relucent/image/stack_files.h"
#include "relucent/transport/files.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

/// A loop over what is no list would find nothing and say nothing.
const Json& listIn(const Json& values, const char* key) {
  const Json& list = values.at(key);
  return list.is_array() ? list : list.at(0);  // throws what readingJson() translates
}

Json toJson(const hdr::ResponseCurve& curve) {
  return Json{{"x", curve.x()}, {"y", curve.y()}};
}

hdr::ResponseCurve curveFrom(const Json& json) {
  try {
    return hdr::ResponseCurve(json.at("x").get<std::vector<double>>(),
                              json.at("y").get<std::vector<double>>());
  } catch (const Error& cause) {
    throw Error(ErrorKind::format, cause.summary(), damagedAdvice);
  }
}

Json toJson(const std::array<hdr::ResponseCurve, 3>& curves) {
  Json json = Json::array();
  for (const hdr::ResponseCurve& curve : curves) json.push_back(toJson(curve));
  return json;
}

std::array<hdr::ResponseCurve, 3> curvesFrom(const Json& json) {
  return {curveFrom(json.at(0)), curveFrom(json.at(1)), curveFrom(json.at(2))};
}

Json toJson(const hdr::CameraModel& camera) {
  Json times = Json::array();
  for (const hdr::ExposureTime& time : camera.times)
    times.push_back({{"reported", time.reported}, {"scale", time.scale}});
  return Json{{"response", toJson(camera.response)},
              {"read_noise", camera.readNoise},
              {"gain", camera.gain},
              {"saturation", camera.saturation},
              {"times", times}};
}

hdr::CameraModel cameraFrom(const Json& json) {
  hdr::CameraModel camera;
  camera.response = curvesFrom(json.at("response"));
  camera.readNoise = json.at("read_noise");
  camera.gain = json.at("gain");
  camera.saturation = json.at("saturation");
  for (const Json& time : json.at("times")) camera.times.push_back({time.at("reported"), time.at("scale")});
  return camera;
}

Json toJson(const Rasters& rasters) {
  Json json = Json::array();
  for (const Size& size : rasters.sizes()) json.push_back({size.width, size.height});
  return json;
}

Rasters rastersFrom(const Json& json) {
  std::vector<Size> sizes = sizesFrom(json);
  for (const Size& size : sizes)
    if (size.empty())
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("calibration.device-without-pixels",
                                           "the calibration tells of a device of {} pixels")
                      .with(as::size(size)),
                  damagedAdvice);
  return Rasters(std::move(sizes));
}

std::vector<image::Image> readImages(const StageResult& result, const std::string& map,
                                     const Rasters& cameras) {
  std::vector<image::Image> images;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    fs::path path = fileOf(result, image::stackFileName(map, camera));
    images.push_back(image::readRgbExr(path, cameras.size(camera)));
    image::checkFinite(images.back(), path);
  }
  return images;
}

CameraStack readMaps(const StageResult& result, const std::string& map, const Rasters& cameras) {
  return CameraStack(image::stackFromImages(readImages(result, map, cameras), cameras));
}

/// Calibrations of earlier versions lack some.
bool hasMap(const StageResult& result, const std::string& map) {
  return std::any_of(result.files.begin(), result.files.end(),
                     [&](const ResultFile& file) { return file.name == image::stackFileName(map, 0); });
}

/// Verification's residuals by the blocks of its patterns: 1, 2, 4, 8 pixels.
std::string residualName(std::size_t size) {
  return fmt::format("residual-{}", std::size_t{1} << size);
}

std::vector<std::uint8_t> flagsFrom(const Stack& stack) {
  std::vector<std::uint8_t> flags(stack.size() / 3);
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = stack[3 * i] > 0.5f ? 1 : 0;
  return flags;
}

constexpr const char* radianceUnits = "camera signal per second";
constexpr const char* varianceUnits = "(camera signal per second)^2";

using Residuals = std::array<std::vector<linearization::LevelResidual>, 3>;

/// Per channel, [drive, light] of every level.
Json toJson(const Residuals& residuals) {
  Json channels = Json::array();
  for (const std::vector<linearization::LevelResidual>& channel : residuals) {
    Json levels = Json::array();
    for (const auto [drive, light] : channel) levels.push_back({drive, light});
    channels.push_back(levels);
  }
  return channels;
}

Residuals residualsFrom(const Json& json) {
  Residuals residuals;
  for (std::size_t c = 0; c < residuals.size(); ++c)
    for (const Json& level : json.at(c)) residuals[c].push_back({level.at(0), level.at(1)});
  return residuals;
}

Json timesToJson(const rig::ShotTimes& times) {
  return {{"shots", times.shots},
          {"exposures", times.exposures},
          {"showing", times.showing},
          {"capturing", times.capturing},
          {"keeping", times.keeping},
          {"between", times.between},
          {"asked", times.asked},
          {"asked_squared", times.askedSquared},
          {"asked_capturing", times.askedCapturing},
          {"bytes", times.bytes}};
}

/// A calibration of an older version has none.
rig::ShotTimes timesFrom(const Json& json) {
  rig::ShotTimes times;
  times.shots = json.value("shots", 0);
  times.exposures = json.value("exposures", 0);
  times.showing = json.value("showing", 0.0);
  times.capturing = json.value("capturing", 0.0);
  times.keeping = json.value("keeping", 0.0);
  times.between = json.value("between", 0.0);
  times.asked = json.value("asked", 0.0);
  times.askedSquared = json.value("asked_squared", 0.0);
  times.askedCapturing = json.value("asked_capturing", 0.0);
  times.bytes = json.value("bytes", std::uint64_t{0});
  return times;
}

}  // namespace

StageResult storeLinearization(CalibrationFolder& folder, const std::string& inputs,
                               const linearization::Linearization& linearization, const StageCost& cost) {
  Json projectors = Json::array();
  for (const linearization::ProjectorResponse& projector : linearization.projectors)
    projectors.push_back(toJson(projector.channels));
  Json residuals = Json::array();
  for (const linearization::ProjectorResponse& projector : linearization.projectors)
    residuals.push_back(toJson(projector.residuals));
  Json cameras = Json::array();
  for (const hdr::CameraModel& camera : linearization.cameras) cameras.push_back(toJson(camera));
  return folder.store(Stage::linearization, inputs,
                      Json{{"projectors", projectors},
                           {"cameras", cameras},
                           {"exposures", linearization.exposures},
                           {"additivity_error", linearization.additivityError},
                           {"findings", linearization.findings},
                           {"residuals", residuals},
                           {"black_share", linearization.blackShare.value_or(-1.0)},
                           {"times", timesToJson(linearization.times)},
                           {"cost", toJson(cost)}});
}

linearization::Linearization loadLinearization(const StageResult& result) {
  return readingJson(result, [](const Json& values) {
    linearization::Linearization linearization;
    for (const Json& projector : listIn(values, "projectors"))
      linearization.projectors.push_back({curvesFrom(projector)});
    // A calibration of an older version has neither of these.
    const Json residuals = values.value("residuals", Json::array());
    for (std::size_t p = 0; p < std::min(residuals.size(), linearization.projectors.size()); ++p)
      linearization.projectors[p].residuals = residualsFrom(residuals[p]);
    if (const double share = values.value("black_share", -1.0); share >= 0.0)
      linearization.blackShare = share;
    for (const Json& camera : listIn(values, "cameras")) linearization.cameras.push_back(cameraFrom(camera));
    linearization.exposures = values.at("exposures").get<std::vector<double>>();
    linearization.additivityError = values.at("additivity_error").get<std::vector<double>>();
    linearization.findings = values.at("findings").get<std::vector<Message>>();
    linearization.times = timesFrom(values.value("times", Json::object()));
    return linearization;
  });
}

namespace {

/// The settings with some sections replaced; none: there is nothing to replace.
std::optional<Json> settingsWith(const CalibrationFolder& folder, const std::string& sections) {
  if (sections.empty()) return std::nullopt;
  Json settings = folder.settings();
  settings.update(Json::parse(sections));
  return settings;
}

/// Whether these sections of the settings are so now.
bool isInSettings(const CalibrationFolder& folder, const std::string& sections) {
  const std::optional<Json> settings = settingsWith(folder, sections);
  return settings && *settings == folder.settings();
}

}  // namespace

void setRepairAside(CalibrationFolder& folder, const RepairNote& repair) {
  const std::optional<Json> settings =
      isInSettings(folder, repair.contentAfter) ? settingsWith(folder, repair.contentBefore) : std::nullopt;
  folder.setLatestAside(Stage::acquisition, settings ? &*settings : nullptr);
}

namespace {

void writeAcquisition(const fs::path& path, const transport::Acquisition& acquisition) {
  const Rasters& cameras = acquisition.transport.cameras();
  transport::saveTransport(path / "transport.npz", acquisition.transport, transport::StoredValues::codes);
  const auto measured = [&](const std::string& name, const CameraStack& stack, const char* units) {
    image::writeStack(path, name, stack, cameras, units, image::ExrPacking::none);
  };
  measured("black", acquisition.black, radianceUnits);
  measured("black-variance", acquisition.blackVariance, varianceUnits);
  measured("flood", acquisition.flood, radianceUnits);
  measured("flood-variance", acquisition.floodVariance, varianceUnits);
  if (!acquisition.leafVariance.empty()) measured("leaf-variance", acquisition.leafVariance, varianceUnits);
  for (std::size_t size = 0; size < acquisition.residual.size(); ++size)
    measured(residualName(size), acquisition.residual[size], radianceUnits);
  image::writeStack(path, "flagged", image::stackFromFlags(acquisition.flagged), cameras,
                    "1 where verification failed");
}

}  // namespace

void prepareAcquisition(const PreparedFiles& files, const transport::Acquisition& acquisition) {
  writeAcquisition(files.folder(), acquisition);
  syncFilesIn(files.folder());
}

StageResult storeAcquisition(CalibrationFolder& folder, const std::string& inputs,
                             const transport::Acquisition& acquisition, const StageCost& cost,
                             const std::optional<RepairNote>& repair, const PreparedFiles* prepared) {
  const Rasters& cameras = acquisition.transport.cameras();
  Json values{{"cameras", toJson(cameras)},
              {"projectors", toJson(acquisition.transport.projectors())},
              {"unresolved_energy", acquisition.unresolvedEnergy},
              {"verification_error", acquisition.verificationError},
              {"remeasured", acquisition.remeasured},
              {"patterns", acquisition.patterns},
              {"exposures", acquisition.exposures},
              {"stopped_at", acquisition.stoppedAt},
              {"findings", acquisition.findings},
              {"left_out", transport::leftOut(acquisition)},
              {"overexposed", acquisition.overexposed},
              {"cost", toJson(cost)}};
  if (acquisition.expected) values["expected_quality"] = toJson(*acquisition.expected);
  if (repair) values["repair"] = toJson(*repair);
  if (acquisition.changed) values["changed"] = toJson(*acquisition.changed);
  const std::optional<Json> settings = repair ? settingsWith(folder, repair->contentAfter) : std::nullopt;
  const auto writeFiles = [&](const fs::path& path) {
    if (prepared != nullptr)
      prepared->moveTo(path);
    else
      writeAcquisition(path, acquisition);
  };
  return folder.store(Stage::acquisition, inputs, values, writeFiles, settings ? &*settings : nullptr);
}

transport::Acquisition loadAcquisition(const StageResult& result) {
  return readingJson(result, [&](const Json& values) {
    transport::Acquisition acquisition;
    Rasters cameras = rastersFrom(values.at("cameras"));
    Rasters projectors = rastersFrom(values.at("projectors"));
    fs::path transport = fileOf(result, "transport.npz");
    acquisition.transport = transport::loadTransport(transport);
    if (acquisition.transport.cameras() != cameras || acquisition.transport.projectors() != projectors)
      throw Error(
          ErrorKind::format,
          RELUCENT_ENGLISH_MESSAGE("calibration.transport-of-other-devices",
                                   "the light transport belongs to other devices than the manifest says"),
          damagedAdvice, transport.string());
    acquisition.black = readMaps(result, "black", cameras);
    acquisition.blackVariance = readMaps(result, "black-variance", cameras);
    acquisition.flood = readMaps(result, "flood", cameras);
    acquisition.floodVariance = readMaps(result, "flood-variance", cameras);
    acquisition.remeasured = values.value("remeasured", 0);
    if (hasMap(result, "leaf-variance"))
      acquisition.leafVariance = readMaps(result, "leaf-variance", cameras);
    for (std::size_t size = 0; hasMap(result, residualName(size)); ++size)
      acquisition.residual.push_back(readMaps(result, residualName(size), cameras));
    acquisition.flagged = CameraMask(flagsFrom(readMaps(result, "flagged", cameras)));
    acquisition.unresolvedEnergy = values.at("unresolved_energy");
    acquisition.verificationError = values.at("verification_error");
    acquisition.patterns = values.at("patterns");
    acquisition.exposures = values.at("exposures");
    acquisition.stoppedAt = values.value("stopped_at", 0);
    acquisition.overexposed = values.value("overexposed", 0.0);
    acquisition.expected = expectedFrom(values);
    acquisition.findings = values.at("findings").get<std::vector<Message>>();
    acquisition.changed = changedFrom(values);
    return acquisition;
  });
}

std::vector<image::Image> loadFlood(const StageResult& result) {
  return readingJson(result, [&](const Json& values) {
    return readImages(result, "flood", rastersFrom(values.at("cameras")));
  });
}

}  // namespace relucent::calibration
