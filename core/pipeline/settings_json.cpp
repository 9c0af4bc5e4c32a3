// SPDX-License-Identifier: MIT
#include "relucent/pipeline/settings_json.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "relucent/base/error.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/pipeline/masks_file.h"

// Each in its type's namespace, as the library looks for them there.
namespace relucent {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Size, width, height)
}  // namespace relucent

namespace relucent::linearization {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(LinearizationSettings, levels, shadowPower, noisePairs,
                                                additivityLimit, seed)
}  // namespace relucent::linearization

namespace relucent::acquisition {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(AcquisitionSettings, scheme, colours, singleExposure,
                                                relativeThreshold, absoluteThreshold, dimShare, noiseSigmas,
                                                references, checkInterval, mayBeMirrored,
                                                verificationPatterns, flagRelative, flagSigmas, seed)
}  // namespace relucent::acquisition

namespace relucent::transport {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ThresholdSettings, absolute, shareOfRowMax, energyKept)
}  // namespace relucent::transport

namespace relucent::inverse {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WindowSettings, tile, rows, ridge)
}  // namespace relucent::inverse

namespace relucent::clustering {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ClusteringSettings, leastLuminance, leastShare, patchRadius,
                                                patchCut, rescaling, cap, mostUnknowns)
}  // namespace relucent::clustering

namespace relucent::pipeline {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ContentSettings, picture, method, reachablePercentile,
                                                objective, fit)
}  // namespace relucent::pipeline

namespace relucent::venue {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(DeviceModelSettings, projectorBits, cameraBits, contrast,
                                                gamma, vignetting, fullWell, readElectrons, ambient, drift,
                                                whiteSegment, flicker, cameraGamma)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(VenueSettings, name, projector, camera, seed, pathsPerPixel,
                                                devices)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Turned, device, x, y, degrees)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(SeenPlace, x, y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Painted, place, radius, colour)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Moved, place, distance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Added, place, diameter)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Changes, cameras, projectors, lamps, filter, dust, painted,
                                                moved, added)
}  // namespace relucent::venue

namespace relucent::pipeline {
namespace {

/// What a manifest's rig is made of.
enum class RigKind { simulated, commands, devices, severalDevices, screen, replay, imported };
constexpr EnumName<RigKind> rigKindNames[]{
    {RigKind::simulated, "simulated"}, {RigKind::commands, "commands"},
    {RigKind::devices, "devices"},     {RigKind::severalDevices, "several-devices"},
    {RigKind::screen, "screen"},       {RigKind::replay, "replay"},
    {RigKind::imported, "imported"}};
constexpr EnumNames<RigKind> namesOf(RigKind) {
  return {"kind of devices", rigKindNames};
}

// The macros above speak the library's own sorted kind of JSON.
using Sorted = nlohmann::json;

[[noreturn]] void failForeign(const std::exception& cause) {
  throw Error(ErrorKind::format,
              RELUCENT_ENGLISH_MESSAGE("calibration.settings-unreadable",
                                       "the manifest's settings cannot be read ({})")
                  .with(cause.what()),
              RELUCENT_ENGLISH_MESSAGE("calibration.restore-manifest-or-recalibrate",
                                       "restore calibration.relucent from a copy, or calibrate again"));
}

Sorted viewToJson(const compensation::ViewSettings& view) {
  Sorted json{{"weight", view.weight}, {"placement", view.placement}};
  if (view.corners) json["corners"] = *view.corners;
  if (view.position) json["position"] = *view.position;
  return json;
}

/// Of content that somebody gave weights or places in several views.
std::vector<compensation::ViewSettings> viewsFromJson(const Sorted& settings) {
  std::vector<compensation::ViewSettings> views;
  auto content = settings.find("content");
  if (content == settings.end()) return views;
  for (const Sorted& json : content->value("views", Sorted::array())) {
    compensation::ViewSettings& view = views.emplace_back();
    view.weight = json.value("weight", view.weight);
    view.placement = json.value("placement", view.placement);
    if (json.contains("corners")) view.corners = json.at("corners").get<compensation::Corners>();
    if (json.contains("position")) view.position = json.at("position").get<compensation::Position>();
  }
  return views;
}

/// What content need not say; none: it does not.
template <typename Value>
std::optional<Value> ofContent(const Sorted& settings, const char* key) {
  const auto content = settings.find("content");
  if (content == settings.end() || !content->contains(key)) return std::nullopt;
  return content->at(key).get<Value>();
}

/// A calibration of a version that knew no other has all of them.
reduction::PixelUse pixelsFromJson(const Sorted& settings) {
  const std::string text = settings.value("camera_pixels", "all");
  if (const std::optional<reduction::PixelUse> use = reduction::pixelUseFrom(text)) return *use;
  throw Error(ErrorKind::format,
              RELUCENT_ENGLISH_MESSAGE("calibration.camera-pixels-unknown",
                                       "'{}' is no choice of camera pixels that this version knows")
                  .with(text),
              RELUCENT_ENGLISH_MESSAGE("calibration.open-with-newer-version",
                                       "open it with the version that made it"));
}

using reduction::Reduction;

Sorted reductionToJson(const Reduction& reduction) {
  Sorted responses = Sorted::array();
  for (const hdr::ResponseCurve& curve : reduction.response)
    if (!curve.isIdentity()) responses.push_back({{"signal", curve.x()}, {"linear", curve.y()}});
  Sorted json{{"camera", {reduction.camera.width, reduction.camera.height}},
              {"begin", {reduction.begin.x, reduction.begin.y}},
              {"part", {reduction.part.width, reduction.part.height}},
              {"bin", reduction.bin},
              {"clip", reduction.clip},
              {"response", std::move(responses)},
              {"defective", reduction.defective}};
  if (reduction.savesMemory) json["saves_memory"] = true;
  return json;
}

Reduction reductionFromJson(const Sorted& json) {
  auto pair = [&json](const char* name) { return json.at(name).get<std::array<int, 2>>(); };
  Reduction reduction;
  reduction.camera = {pair("camera")[0], pair("camera")[1]};
  reduction.begin = {pair("begin")[0], pair("begin")[1]};
  reduction.part = {pair("part")[0], pair("part")[1]};
  reduction.bin = json.at("bin");
  reduction.clip = json.at("clip");
  const Sorted& responses = json.at("response");
  for (std::size_t c = 0; c < responses.size() && c < 3; ++c)
    reduction.response[c] = hdr::ResponseCurve(responses[c].at("signal").get<std::vector<double>>(),
                                               responses[c].at("linear").get<std::vector<double>>());
  reduction.defective = json.at("defective").get<std::vector<std::uint32_t>>();
  reduction.savesMemory = json.value("saves_memory", false);
  return reduction;
}

/// Whether it is one that reductionTo() makes.
bool isSound(const Reduction& reduction) {
  auto along = [&reduction](int begin, int length, int all) {
    return begin >= 0 && length >= reduction.bin && length % reduction.bin == 0 && length <= all - begin;
  };
  return reduction.bin >= 1 && reduction.clip > 0.0 && reduction.clip <= 1.0 &&
         along(reduction.begin.x, reduction.part.width, reduction.camera.width) &&
         along(reduction.begin.y, reduction.part.height, reduction.camera.height) &&
         std::ranges::all_of(reduction.defective,
                             [&](std::uint32_t value) { return value < 3 * reduction.camera.count(); });
}

Sorted commandRigToJson(const CommandRigSettings& settings) {
  Sorted json{{"projector_command", settings.projectorCommand},
              {"camera_command", settings.cameraCommand},
              {"projector", settings.projector},
              {"shortest_exposure", settings.shortestExposure},
              {"longest_exposure", settings.longestExposure}};
  if (settings.camera) json["camera"] = *settings.camera;
  if (!settings.cameraAddress.empty()) json["camera_address"] = settings.cameraAddress;
  if (settings.latency > 0.0) json["latency"] = settings.latency;
  if (!settings.record.empty()) json["record"] = settings.record;
  if (settings.frameRate > 0.0) json["frame_rate"] = settings.frameRate;
  for (const CommandRigSettings::Projector& projector : settings.moreProjectors)
    json["more_projectors"].push_back({{"command", projector.command}, {"size", projector.size}});
  for (const CommandRigSettings::Camera& camera : settings.moreCameras) {
    Sorted& more =
        json["more_cameras"].emplace_back(Sorted{{"command", camera.command}, {"address", camera.address}});
    if (camera.size) more["size"] = *camera.size;
  }
  return json;
}

/// Versions that know fewer devices, or commands only, say so instead of opening some of them.
RigKind kindOf(const CommandRigSettings& settings) {
  if (!settings.moreProjectors.empty() || !settings.moreCameras.empty()) return RigKind::severalDevices;
  return settings.cameraAddress.empty() ? RigKind::commands : RigKind::devices;
}

CommandRigSettings commandRigFromJson(const Sorted& json) {
  CommandRigSettings settings;
  settings.projectorCommand = json.at("projector_command");
  settings.cameraCommand = json.at("camera_command");
  settings.projector = json.at("projector");
  settings.shortestExposure = json.value("shortest_exposure", settings.shortestExposure);
  settings.longestExposure = json.value("longest_exposure", settings.longestExposure);
  if (json.contains("camera")) settings.camera = json.at("camera").get<Size>();
  settings.cameraAddress = json.value("camera_address", settings.cameraAddress);
  settings.latency = json.value("latency", settings.latency);
  settings.record = json.value("record", settings.record);
  settings.frameRate = json.value("frame_rate", settings.frameRate);
  for (const Sorted& projector : json.value("more_projectors", Sorted::array()))
    settings.moreProjectors.push_back({projector.at("command"), projector.at("size").get<Size>()});
  for (const Sorted& camera : json.value("more_cameras", Sorted::array())) {
    CommandRigSettings::Camera& more = settings.moreCameras.emplace_back();
    more.command = camera.at("command");
    more.address = camera.at("address");
    if (camera.contains("size")) more.size = camera.at("size").get<Size>();
  }
  return settings;
}

Sorted displayToJson(const ScreenRigSettings::Display& display) {
  return {{"connector", display.connector},
          {"manufacturer", display.manufacturer},
          {"model", display.model},
          {"serial_number", display.serialNumber}};
}

ScreenRigSettings::Display displayFromJson(const Sorted& json) {
  return {json.value("connector", ""), json.value("manufacturer", ""), json.value("model", ""),
          json.value("serial_number", "")};
}

Sorted screenRigToJson(const ScreenRigSettings& settings) {
  Sorted json{{"display", displayToJson(settings.display)},
              {"projector", settings.projector},
              {"frame_rate", settings.frameRate},
              {"camera_address", settings.cameraAddress},
              {"shortest_exposure", settings.shortestExposure},
              {"longest_exposure", settings.longestExposure},
              {"latency", settings.latency}};
  if (settings.camera) json["camera"] = *settings.camera;
  // Fingerprints of rigs without any are those of versions that knew none.
  if (!settings.name.empty()) json["name"] = settings.name;
  if (!settings.cameraName.empty()) json["camera_name"] = settings.cameraName;
  for (const ScreenRigSettings::Screen& screen : settings.moreScreens)
    json["more_screens"].push_back({{"display", displayToJson(screen.display)},
                                    {"projector", screen.projector},
                                    {"frame_rate", screen.frameRate},
                                    {"name", screen.name}});
  for (const ScreenRigSettings::Camera& camera : settings.moreCameras) {
    Sorted& more =
        json["more_cameras"].emplace_back(Sorted{{"address", camera.address}, {"name", camera.name}});
    if (camera.size) more["size"] = *camera.size;
  }
  return json;
}

ScreenRigSettings screenRigFromJson(const Sorted& json) {
  ScreenRigSettings settings;
  settings.display = displayFromJson(json.at("display"));
  settings.projector = json.at("projector");
  settings.frameRate = json.value("frame_rate", settings.frameRate);
  settings.cameraAddress = json.at("camera_address");
  settings.shortestExposure = json.value("shortest_exposure", settings.shortestExposure);
  settings.longestExposure = json.value("longest_exposure", settings.longestExposure);
  settings.latency = json.value("latency", settings.latency);
  if (json.contains("camera")) settings.camera = json.at("camera").get<Size>();
  settings.name = json.value("name", settings.name);
  settings.cameraName = json.value("camera_name", settings.cameraName);
  for (const Sorted& screen : json.value("more_screens", Sorted::array()))
    settings.moreScreens.push_back({displayFromJson(screen.at("display")), screen.at("projector").get<Size>(),
                                    screen.at("frame_rate").get<double>(), screen.value("name", "")});
  for (const Sorted& camera : json.value("more_cameras", Sorted::array())) {
    ScreenRigSettings::Camera& more = settings.moreCameras.emplace_back();
    more.address = camera.at("address");
    more.name = camera.value("name", "");
    if (camera.contains("size")) more.size = camera.at("size").get<Size>();
  }
  return settings;
}

/// Where an earlier version kept a recording that stands for devices: among the commands.
std::string replayAmongCommands(const Sorted& commands) {
  return commands.value("replay", std::string());
}

Sorted importedRigToJson(const ImportedRigSettings& settings) {
  return {{"projector", settings.projector},     {"camera", settings.camera},
          {"pictures", settings.pictures},       {"patterns", settings.patterns},
          {"photographs", settings.photographs}, {"fingerprint", settings.fingerprint}};
}

ImportedRigSettings importedRigFromJson(const Sorted& json) {
  ImportedRigSettings settings;
  settings.projector = json.at("projector");
  settings.camera = json.at("camera");
  settings.pictures = json.value("pictures", settings.pictures);
  settings.patterns = json.value("patterns", settings.patterns);
  settings.photographs = json.value("photographs", settings.photographs);
  settings.fingerprint = json.value("fingerprint", settings.fingerprint);
  return settings;
}

venue::VenueSettings venueFromJson(const Sorted& rig) {
  auto venue = rig.at("venue").get<venue::VenueSettings>();
  const auto changes = rig.find("changes");
  if (changes == rig.end()) return venue;
  venue.changes = changes->get<venue::Changes>();
  if (changes->contains("ambient")) venue.changes.ambient = changes->at("ambient").get<double>();
  return venue;
}

}  // namespace

calibration::Json rigToJson(const RigSettings& settings) {
  struct Writer {
    Sorted operator()(const venue::VenueSettings& venue) const {
      Sorted json{{"kind", RigKind::simulated}, {"venue", venue}};
      // Venues that have not changed are written as before there were changes, so that fingerprints stay.
      if (venue.changes.any()) json["changes"] = venue.changes;
      if (venue.changes.ambient) json["changes"]["ambient"] = *venue.changes.ambient;
      return json;
    }
    Sorted operator()(const ImportedRigSettings& imported) const {
      return {{"kind", RigKind::imported}, {"imported", importedRigToJson(imported)}};
    }
    Sorted operator()(const ReplayRigSettings& replay) const {
      return {{"kind", RigKind::replay}, {"folder", replay.folder}};
    }
    Sorted operator()(const ScreenRigSettings& screen) const {
      return {{"kind", RigKind::screen}, {"screen", screenRigToJson(screen)}};
    }
    Sorted operator()(const CommandRigSettings& commands) const {
      return {{"kind", kindOf(commands)}, {"commands", commandRigToJson(commands)}};
    }
  };
  return calibration::Json(std::visit(Writer{}, settings));
}

RigSettings rigFromJson(const calibration::Json& json) {
  try {
    Sorted sorted(json);
    switch (sorted.at("kind").get<RigKind>()) {
      case RigKind::simulated:
        return venueFromJson(sorted);
      case RigKind::replay:
        return ReplayRigSettings{sorted.at("folder")};
      case RigKind::screen:
        return screenRigFromJson(sorted.at("screen"));
      case RigKind::imported:
        return importedRigFromJson(sorted.at("imported"));
      case RigKind::commands:
      case RigKind::devices:
      case RigKind::severalDevices:
        break;
    }
    const Sorted& commands = sorted.at("commands");
    if (std::string folder = replayAmongCommands(commands); !folder.empty())
      return ReplayRigSettings{std::move(folder)};
    return commandRigFromJson(commands);
  } catch (const Sorted::exception& cause) {
    failForeign(cause);
  }
}

calibration::Json screenToJson(const ScreenRigSettings::Screen& screen) {
  return calibration::Json(
      Sorted{{"display", displayToJson(screen.display)}, {"frame_rate", screen.frameRate}});
}

void screenFromJson(const calibration::Json& json, ScreenRigSettings::Screen& screen) {
  try {
    Sorted sorted(json);
    screen.display = displayFromJson(sorted.at("display"));
    screen.frameRate = sorted.value("frame_rate", screen.frameRate);
  } catch (const Sorted::exception& cause) {
    failForeign(cause);
  }
}

calibration::Json commandsToJson(const std::vector<std::string>& commands) {
  return calibration::Json(commands);
}

std::vector<std::string> commandsFromJson(const calibration::Json& json) {
  std::vector<std::string> commands;
  try {
    for (const Sorted& command : Sorted(json)) commands.push_back(command.get<std::string>());
  } catch (const Sorted::exception& cause) {
    failForeign(cause);
  }
  return commands;
}

calibration::Json reductionsToJson(const std::vector<Reduction>& reductions) {
  Sorted all = Sorted::array();
  for (const Reduction& reduction : reductions) all.push_back(reductionToJson(reduction));
  return calibration::Json(all);
}

std::vector<Reduction> reductionsFromJson(const calibration::Json& json) {
  std::vector<Reduction> reductions;
  try {
    for (const Sorted& camera : Sorted(json)) reductions.push_back(reductionFromJson(camera));
  } catch (const Sorted::exception& cause) {
    failForeign(cause);
  }
  if (!std::ranges::all_of(reductions, isSound)) failForeign(std::runtime_error("reduction"));
  return reductions;
}

calibration::Json stagesToJson(const CalibrateSettings& settings) {
  Sorted content = settings.content;
  if (settings.content.corners) content["corners"] = *settings.content.corners;
  if (settings.content.blackLift) content["blackLift"] = *settings.content.blackLift;
  // Left out where it is what versions did that knew no other, so that their fingerprints stay.
  if (settings.content.brightness != compensation::Brightness::even)
    content["brightness"] = settings.content.brightness;
  if (settings.content.clipping != compensation::Clipping::channels)
    content["clipping"] = settings.content.clipping;
  for (const compensation::ViewSettings& view : settings.content.views)
    content["views"].push_back(viewToJson(view));
  if (settings.content.viewer) content["viewer"] = *settings.content.viewer;
  if (!settings.content.masks.empty()) content["masks"] = masksToJson(settings.content.masks);
  Sorted linearization = settings.linearization;
  // Calibrations from before there was such a choice keep their fingerprints.
  if (settings.linearization.exposureUnit > 0.0)
    linearization["exposureUnit"] = settings.linearization.exposureUnit;
  return calibration::Json(Sorted{{"camera_pixels", reduction::toString(settings.pixels)},
                                  {"linearization", std::move(linearization)},
                                  {"acquisition", settings.acquisition},
                                  {"threshold", settings.threshold},
                                  {"windows", settings.windows},
                                  {"choose_ridge", settings.chooseRidge},
                                  {"clustering", settings.clustering},
                                  {"content", std::move(content)}});
}

void stagesFromJson(const calibration::Json& json, CalibrateSettings& settings) {
  try {
    Sorted sorted(json);
    settings.pixels = pixelsFromJson(sorted);
    settings.linearization = sorted.value("linearization", settings.linearization);
    settings.linearization.exposureUnit =
        sorted.value("linearization", Sorted::object()).value("exposureUnit", 0.0);
    settings.acquisition = sorted.value("acquisition", settings.acquisition);
    settings.threshold = sorted.value("threshold", settings.threshold);
    settings.windows = sorted.value("windows", settings.windows);
    settings.chooseRidge = sorted.value("choose_ridge", settings.chooseRidge);
    settings.clustering = sorted.value("clustering", settings.clustering);
    settings.content = sorted.value("content", settings.content);
    settings.content.corners = ofContent<compensation::Corners>(sorted, "corners");
    // Versions that did not find it by themselves always wrote it.
    settings.content.blackLift = ofContent<double>(sorted, "blackLift");
    settings.content.views = viewsFromJson(sorted);
    settings.content.viewer = ofContent<compensation::Position>(sorted, "viewer");
    const std::optional<calibration::Json> masks = ofContent<calibration::Json>(sorted, "masks");
    settings.content.masks = masks ? masksFromJson(*masks) : std::vector<compensation::Mask>();
    settings.content.brightness =
        ofContent<compensation::Brightness>(sorted, "brightness").value_or(compensation::Brightness::even);
    settings.content.clipping =
        ofContent<compensation::Clipping>(sorted, "clipping").value_or(compensation::Clipping::channels);
  } catch (const Sorted::exception& cause) {
    failForeign(cause);
  }
}

calibration::Json contentToJson(const ContentSettings& content) {
  CalibrateSettings settings;
  settings.content = content;
  return stagesToJson(settings).at("content");
}

ContentSettings contentFromJson(const calibration::Json& json) {
  CalibrateSettings settings;
  stagesFromJson({{"content", json}}, settings);
  return settings.content;
}

}  // namespace relucent::pipeline
