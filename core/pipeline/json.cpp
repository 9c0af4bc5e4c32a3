// SPDX-License-Identifier: MIT
#include "pipeline/json.h"

#include "base/error.h"

namespace relucent {
namespace {

Json sizeToJson(Size size) {
  return {size.width, size.height};
}

Size sizeFrom(const Json& json) {
  return {json.at(0), json.at(1)};
}

/// Reads a key if it is there; what is missing keeps its default.
template <typename Value>
void read(const Json& json, const char* key, Value& value) {
  if (json.contains(key)) value = json.at(key).get<Value>();
}
void read(const Json& json, const char* key, Size& value) {
  if (json.contains(key)) value = sizeFrom(json.at(key));
}

Json devicesToJson(const DeviceModelSettings& devices) {
  return {{"projector_bits", devices.projectorBits},
          {"camera_bits", devices.cameraBits},
          {"contrast", devices.contrast},
          {"gamma", devices.gamma},
          {"vignetting", devices.vignetting},
          {"full_well", devices.fullWell},
          {"read_electrons", devices.readElectrons},
          {"ambient", devices.ambient},
          {"drift", devices.drift},
          {"white_segment", devices.whiteSegment},
          {"flicker", devices.flicker},
          {"camera_gamma", devices.cameraGamma}};
}

DeviceModelSettings devicesFrom(const Json& json) {
  DeviceModelSettings devices;
  read(json, "projector_bits", devices.projectorBits);
  read(json, "camera_bits", devices.cameraBits);
  read(json, "contrast", devices.contrast);
  read(json, "gamma", devices.gamma);
  read(json, "vignetting", devices.vignetting);
  read(json, "full_well", devices.fullWell);
  read(json, "read_electrons", devices.readElectrons);
  read(json, "ambient", devices.ambient);
  read(json, "drift", devices.drift);
  read(json, "white_segment", devices.whiteSegment);
  read(json, "flicker", devices.flicker);
  read(json, "camera_gamma", devices.cameraGamma);
  return devices;
}

Json venueToJson(const VenueSettings& venue) {
  return {{"kind", "simulated"},
          {"name", venue.name},
          {"projector", sizeToJson(venue.projector)},
          {"camera", sizeToJson(venue.camera)},
          {"seed", venue.seed},
          {"paths_per_pixel", venue.pathsPerPixel},
          {"devices", devicesToJson(venue.devices)}};
}

VenueSettings venueFrom(const Json& json) {
  VenueSettings venue;
  read(json, "name", venue.name);
  read(json, "projector", venue.projector);
  read(json, "camera", venue.camera);
  read(json, "seed", venue.seed);
  read(json, "paths_per_pixel", venue.pathsPerPixel);
  if (json.contains("devices")) venue.devices = devicesFrom(json.at("devices"));
  return venue;
}

Json commandsToJson(const CommandRigSettings& rig) {
  Json json = {{"kind", "commands"},
               {"projector_command", rig.projectorCommand},
               {"camera_command", rig.cameraCommand},
               {"projector", sizeToJson(rig.projector)}};
  if (rig.camera) json["camera"] = sizeToJson(*rig.camera);
  json["shortest_exposure"] = rig.shortestExposure;
  json["longest_exposure"] = rig.longestExposure;
  return json;
}

CommandRigSettings commandsFrom(const Json& json) {
  CommandRigSettings rig;
  read(json, "projector_command", rig.projectorCommand);
  read(json, "camera_command", rig.cameraCommand);
  read(json, "projector", rig.projector);
  if (json.contains("camera")) rig.camera = sizeFrom(json.at("camera"));
  read(json, "shortest_exposure", rig.shortestExposure);
  read(json, "longest_exposure", rig.longestExposure);
  return rig;
}

Json importedToJson(const ImportedRigSettings& rig) {
  return {{"kind", "imported"},
          {"projector", sizeToJson(rig.projector)},
          {"camera", sizeToJson(rig.camera)},
          {"pictures", rig.pictures},
          {"patterns", rig.patterns},
          {"photographs", rig.photographs},
          {"fingerprint", rig.fingerprint}};
}

ImportedRigSettings importedFrom(const Json& json) {
  ImportedRigSettings rig;
  read(json, "projector", rig.projector);
  read(json, "camera", rig.camera);
  read(json, "pictures", rig.pictures);
  read(json, "patterns", rig.patterns);
  read(json, "photographs", rig.photographs);
  read(json, "fingerprint", rig.fingerprint);
  return rig;
}

RigSettings rigFrom(const Json& json) {
  std::string kind = json.at("kind");
  if (kind == "imported") return importedFrom(json);
  if (kind == "simulated") return venueFrom(json);
  if (kind == "commands") return commandsFrom(json);
  throw Error(ErrorKind::format,
              fmt::format("the calibration was made with devices of an unknown kind '{}'", kind),
              "open it with the version of Relucent that made it");
}

LinearizationSettings linearizationFrom(const Json& json) {
  LinearizationSettings settings;
  read(json, "levels", settings.levels);
  read(json, "shadow_power", settings.shadowPower);
  read(json, "noise_pairs", settings.noisePairs);
  read(json, "additivity_limit", settings.additivityLimit);
  read(json, "seed", settings.seed);
  return settings;
}

AcquisitionSettings acquisitionFrom(const Json& json) {
  AcquisitionSettings settings;
  read(json, "relative_threshold", settings.relativeThreshold);
  read(json, "noise_sigmas", settings.noiseSigmas);
  read(json, "references", settings.references);
  read(json, "verification_patterns", settings.verificationPatterns);
  read(json, "seed", settings.seed);
  return settings;
}

WindowSettings windowsFrom(const Json& json) {
  WindowSettings settings;
  read(json, "tile", settings.tile);
  read(json, "rows", settings.rows);
  read(json, "ridge", settings.ridge);
  return settings;
}

Json pathsToJson(const std::vector<std::filesystem::path>& paths) {
  Json json = Json::array();
  for (const std::filesystem::path& path : paths) json.push_back(path.string());
  return json;
}

Json scoreToJson(const ImageScore& image) {
  Json methods = Json::object();
  for (const MethodScore& score : image.methods)
    methods[score.method] = {{"psnr_reachable", score.psnrReachable},
                             {"psnr_all", score.psnrAll},
                             {"ssim", score.ssim},
                             {"delta_e", score.deltaE},
                             {"seconds", score.seconds}};
  return {{"name", image.name}, {"reachable", image.reachable}, {"methods", std::move(methods)}};
}

}  // namespace

Json toJson(const CalibrateResult& result) {
  return {{"patterns", result.patterns},
          {"exposures", result.exposures},
          {"seconds",
           {{"linearization", result.seconds.linearization},
            {"acquisition", result.seconds.acquisition},
            {"inverse", result.seconds.inverse}}},
          {"connections", result.connections},
          {"leaves", result.leaves},
          {"unresolved_energy", result.unresolvedEnergy},
          {"flagged_share", result.flaggedShare},
          {"verification_error", result.verificationError},
          {"peak_memory_bytes", result.peakMemoryBytes},
          {"findings", result.findings}};
}

Json toJson(const CompensateResult& result) {
  return {{"method", result.method},       {"psnr_predicted", result.psnrPredicted},
          {"delta_e", result.deltaE},      {"clipped", result.clipped},
          {"reachable", result.reachable}, {"uncorrectable", result.uncorrectable},
          {"seconds", result.seconds},     {"files", pathsToJson(result.files)}};
}

Json toJson(const EvaluateResult& result) {
  Json images = Json::array();
  for (const ImageScore& image : result.images) images.push_back(scoreToJson(image));
  return {{"venue", result.venue},
          {"projector", sizeToJson(result.projector)},
          {"camera", sizeToJson(result.camera)},
          {"reachable", result.reachable},
          {"transport",
           {{"frobenius", result.transport.frobenius},
            {"row_median", result.transport.rowMedian},
            {"row_p95", result.transport.rowP95},
            {"relight_natural", result.transport.relightNatural},
            {"relight_random", result.transport.relightRandom}}},
          {"images", std::move(images)}};
}

Json toJson(const WrittenFiles& result) {
  return {{"files", pathsToJson(result.files)}, {"notes", result.notes}};
}

Json toJson(const SeparateResult& result) {
  return {{"direct_share", result.directShare}, {"files", pathsToJson(result.files)}};
}

Json toJson(const DifferenceResult& result) {
  return {{"rms", result.rms},
          {"relative", result.relative},
          {"gain", result.gain},
          {"files", pathsToJson(result.files)}};
}

Json toJson(const BenchResult& result) {
  Json benchmarks = Json::array();
  for (const Benchmark& benchmark : result.benchmarks)
    benchmarks.push_back({{"name", benchmark.name},
                          {"seconds", benchmark.seconds},
                          {"bytes", benchmark.bytes},
                          {"share_of_copy", benchmark.shareOfCopy}});
  return {{"machine",
           {{"processor", result.machine.processor},
            {"threads", result.machine.threads},
            {"copy_bytes_per_second", result.machine.copyBytesPerSecond}}},
          {"benchmarks", std::move(benchmarks)}};
}

Json toJson(const ImportResult& result) {
  return {{"patterns", result.patterns},
          {"fitted", result.fitted},
          {"held_out", result.heldOut},
          {"nrmse",
           {{"one_to_one", result.error.oneToOne},
            {"mix", result.error.mix},
            {"transport", result.error.transport}}},
          {"projector", sizeToJson(result.projector)},
          {"camera", sizeToJson(result.camera)},
          {"leaves", result.leaves},
          {"flagged_share", result.flaggedShare},
          {"seconds", result.seconds},
          {"peak_memory_bytes", result.peakMemoryBytes},
          {"findings", result.findings}};
}

Json toJson(const std::vector<VenueDescription>& venues) {
  Json list = Json::array();
  for (const VenueDescription& venue : venues)
    list.push_back({{"name", venue.name}, {"sentence", venue.sentence}, {"projectors", venue.projectors}});
  return {{"venues", std::move(list)}};
}

Json toJson(const RigSettings& settings) {
  if (const auto* venue = std::get_if<VenueSettings>(&settings)) return venueToJson(*venue);
  if (const auto* imported = std::get_if<ImportedRigSettings>(&settings)) return importedToJson(*imported);
  return commandsToJson(std::get<CommandRigSettings>(settings));
}

Json toJson(const LinearizationSettings& settings) {
  return {{"levels", settings.levels},
          {"shadow_power", settings.shadowPower},
          {"noise_pairs", settings.noisePairs},
          {"additivity_limit", settings.additivityLimit},
          {"seed", settings.seed}};
}

Json toJson(const AcquisitionSettings& settings) {
  return {{"relative_threshold", settings.relativeThreshold},
          {"noise_sigmas", settings.noiseSigmas},
          {"references", settings.references},
          {"verification_patterns", settings.verificationPatterns},
          {"seed", settings.seed}};
}

Json toJson(const WindowSettings& settings) {
  return {{"tile", settings.tile}, {"rows", settings.rows}, {"ridge", settings.ridge}};
}

Json toJson(const CalibrateSettings& settings) {
  return {{"rig", toJson(settings.rig)},
          {"linearization", toJson(settings.linearization)},
          {"acquisition", toJson(settings.acquisition)},
          {"windows", toJson(settings.windows)}};
}

CalibrateSettings calibrateSettingsFromJson(const Json& json) {
  try {
    CalibrateSettings settings;
    settings.rig = rigFrom(json.at("rig"));
    if (json.contains("linearization")) settings.linearization = linearizationFrom(json.at("linearization"));
    if (json.contains("acquisition")) settings.acquisition = acquisitionFrom(json.at("acquisition"));
    if (json.contains("windows")) settings.windows = windowsFrom(json.at("windows"));
    return settings;
  } catch (const Json::exception&) {
    throw Error(ErrorKind::format, "the calibration's settings cannot be read",
                "choose another calibration, or copy it again from where it was measured");
  }
}

}  // namespace relucent
