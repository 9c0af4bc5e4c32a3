// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/change_options.h"
#include "relucent/cli/device_choices.h"
#include "relucent/cli/options.h"
#include "relucent/cli/projector_options.h"
#include "relucent/pipeline/command_devices.h"

namespace relucent::cli {
namespace {

/// A folder as it is known from everywhere: `resume` may be called elsewhere.
std::string absolutePath(const std::string& folder) {
  return std::filesystem::absolute(folder).string();
}

/// Options of `calibrate` that name devices, and what they set. Kept until the command line has been read.
struct DeviceOptions {
  venue::VenueSettings venue;
  pipeline::CommandRigSettings commands;
  pipeline::ReplayRigSettings replay;
  std::vector<std::string> projectorCommands;
  std::vector<Size> projectors;  // sizes as they were given
  CameraChoices cameras;
  std::uint64_t seed = 1;

  CLI::Option *venueName, *projectorSize, *cameraAddress, *cameraSize;
  CLI::Option *projectorCommand, *cameraCommand, *frameRate, *record, *replayFolder;
  CLI::Option_group* simulated;
};

void addDevices(CLI::App* sub, DeviceOptions& devices) {
  devices.venueName = sub->add_option("--venue", devices.venue.name, "A simulated venue, see `venues`")
                          ->type_name("NAME")
                          ->capture_default_str();
  devices.projectorSize =
      addSizes(
          sub, "--projector", devices.projectors,
          "Size of the projector; of several by commands: once for each, in the commands' order, or once")
          ->default_str("256x192");
  devices.cameraAddress =
      addRepeated(
          sub, "--camera", [&devices](const std::string& text) { devices.cameras.read(text); },
          "A real camera by its address, see `devices`, several times for several; or the size of the camera")
          ->type_name("KIND:PLACE|WxH")
          ->default_str("160x120");
  devices.cameraSize = addSizes(sub, "--camera-size", devices.cameras.sizesOfAddressed,
                                "Size of the photographs, if --camera is an address; likewise");
  sub->add_option("--seed", devices.seed, "Seed of all random numbers: the same seed gives the same bits")
      ->type_name("N")
      ->capture_default_str();
}

void addMeasurement(CLI::App* sub, pipeline::CalibrateSettings& settings) {
  addPixelUse(sub, settings.pixels);
  // Before all that changes single settings: a mode sets all of them.
  addNamed<acquisition::AcquisitionMode>(
      sub, "--acquisition",
      "How the light transport is measured: " + listOfNames<acquisition::AcquisitionMode>(),
      [&settings](acquisition::AcquisitionMode mode) { settings.acquisition = settingsOf(mode); })
      ->type_name("MODE")
      ->default_str("multiplexed");
  addNamed<acquisition::LitColours>(
      sub, "--colour",
      "Colours of the patterns: " + listOfNames<acquisition::LitColours>() + "; fast uses white",
      [&settings](acquisition::LitColours colours) { settings.acquisition.colours = colours; })
      ->type_name("MODE");
  sub->add_flag("--mirrored", settings.acquisition.mayBeMirrored,
                "Pictures appear mirrored on purpose: rear projection, a mirror");
  sub->add_option("--threshold", settings.acquisition.relativeThreshold,
                  "Faintest light to resolve, as a share of the flood image: 0.006 fine, 0.02 fast")
      ->type_name("SHARE")
      ->capture_default_str();
  sub->add_option("--levels", settings.linearization.levels, "Levels measured per projector colour")
      ->type_name("N")
      ->capture_default_str();
}

CLI::Option* addFolderOption(CLI::App* group, const char* name, std::string& folder, const char* what) {
  return group
      ->add_option_function<std::string>(
          name, [&folder](const std::string& given) { folder = absolutePath(given); }, what)
      ->type_name("DIR");
}

void addExternalPrograms(CLI::App* sub, DeviceOptions& devices) {
  CLI::Option_group* real = sub->add_option_group("External programs", "Any projector and camera by script");
  devices.projectorCommand = addRepeated(
      real, "--projector-command",
      [&devices](const std::string& text) { devices.projectorCommands.push_back(text); },
      "Command that shows the file {image} and returns when the picture is lit; several times for several");
  devices.cameraCommand = addRepeated(
      real, "--camera-command",
      [&devices](const std::string& text) { devices.cameras.commands.push_back(text); },
      "Command that photographs {exposure} seconds into the file {output}; several times for several");
  for (CLI::Option* command : {devices.projectorCommand, devices.cameraCommand}) command->type_name("CMD");
  real->add_option("--shortest", devices.commands.shortestExposure, "Shortest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();
  real->add_option("--longest", devices.commands.longestExposure, "Longest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();
  real->add_option("--latency", devices.commands.latency,
                   "Time until a picture is displayed, as measured by `check`")
      ->type_name("SECONDS")
      ->capture_default_str();
  devices.frameRate = real->add_option("--frame-rate", devices.commands.frameRate,
                                       "Frame rate of the projector: exposures become multiples of a frame")
                          ->type_name("HZ");
  devices.record = addFolderOption(real, "--record", devices.commands.record,
                                   "Folder for a recording of all patterns and photographs, for --replay");
  devices.replayFolder = addFolderOption(real, "--replay", devices.replay.folder,
                                         "A recording to use instead of projector and camera");
}

void addSimulatedDevices(CLI::App* sub, DeviceOptions& devices) {
  venue::DeviceModelSettings& model = devices.venue.devices;
  CLI::Option_group* simulated = devices.simulated =
      sub->add_option_group("Simulated devices", "Simulated imperfections");
  auto simulate = [&](const char* name, auto& value, const char* what) {
    simulated->add_option(name, value, what)->capture_default_str();
  };
  simulate("--paths", devices.venue.pathsPerPixel, "Light paths traced for each camera pixel");
  simulate("--projector-bits", model.projectorBits, "Bits of the projector's drive values");
  simulate("--camera-bits", model.cameraBits, "Bits of the camera");
  simulate("--full-well", model.fullWell, "Electrons of the camera at full scale");
  simulate("--contrast", model.contrast, "White of the projector divided by its black");
  simulate("--ambient", model.ambient, "Room light, as a share of the mean flood image");
  simulate("--drift", model.drift, "Relative change of the lamp over 1000 photographs");
  simulate("--flicker", model.flicker, "Relative standard deviation of the lamp between photographs");
  simulate("--camera-gamma", model.cameraGamma, "Response of the camera; 1 is linear");
  addChanges(simulated, devices.venue.changes);
  simulated->add_flag("--white-segment", model.whiteSegment, "White is brighter than red + green + blue");
}

void refuseSimulation(const DeviceOptions& devices) {
  for (const CLI::Option* option : devices.simulated->get_options())
    if (option->count() > 0) throw WrongUsage(option->get_name() + " is for simulated venues only");
  if (devices.venueName->count() > 0) throw WrongUsage("give --venue or external programs, not both");
}

void refuseBesideReplay(const DeviceOptions& devices) {
  for (const CLI::Option* other : {devices.projectorCommand, devices.cameraCommand, devices.cameraAddress,
                                   devices.projectorSize, devices.record, devices.frameRate})
    if (other->count() > 0)
      throw WrongUsage(other->get_name() +
                       " cannot be used with --replay: the recording contains its devices");
  refuseSimulation(devices);
}

/// Whether real devices are named. Throws: WrongUsage if they are named by halves.
bool areExternal(const DeviceOptions& devices) {
  const bool addressed = !devices.cameras.addresses.empty();
  const bool shows = devices.projectorCommand->count() > 0, photographs = devices.cameraCommand->count() > 0;
  const bool isSized = devices.projectorSize->count() > 0;
  if (devices.cameraSize->count() > 0 && !addressed)
    throw WrongUsage("--camera-size is for cameras with an address; write --camera WxH");
  if (addressed && photographs)
    throw WrongUsage(
        "give a camera's address or --camera-command, not both; a command among addresses is --camera "
        "command:CMD");
  if (addressed && (!shows || !isSized))
    throw WrongUsage("a real camera also needs --projector-command and --projector");
  if (!shows && !photographs) {
    for (const CLI::Option* other : {devices.record, devices.frameRate})
      if (other->count() > 0) throw WrongUsage(other->get_name() + " is for real devices");
    return false;
  }
  if (!shows || (!photographs && !addressed) || !isSized)
    throw WrongUsage("external programs need --projector-command, --camera-command and --projector");
  refuseSimulation(devices);
  return true;
}

/// The size of a venue's devices. Throws: WrongUsage if several are given.
Size onlySize(const std::vector<Size>& sizes, const char* option, Size otherwise) {
  if (sizes.size() > 1)
    throw WrongUsage(fmt::format("give {} once: a simulated venue's are all alike", option));
  return sizes.empty() ? otherwise : sizes.front();
}

pipeline::RigSettings rigOf(const DeviceOptions& devices) {
  if (devices.replayFolder->count() > 0) {
    refuseBesideReplay(devices);
    return devices.replay;
  }
  if (areExternal(devices)) {
    std::vector<pipeline::CommandRigSettings::Projector> projectors;
    const std::vector<Size> sizes =
        onePerDevice(devices.projectors, devices.projectorCommands.size(), "--projector");
    for (std::size_t i = 0; i < sizes.size(); ++i)
      projectors.push_back({devices.projectorCommands[i], sizes[i]});
    return withProjectors(withCameras(devices.commands, devices.cameras.chosen()), projectors);
  }
  venue::VenueSettings venue = devices.venue;
  venue.projector = onlySize(devices.projectors, "--projector", {256, 192});
  venue.camera = onlySize(devices.cameras.sizes, "--camera", {160, 120});
  venue.seed = devices.seed;
  return venue;
}

}  // namespace

std::function<Command()> addCalibrateOptions(CLI::App* sub) {
  auto command = std::make_shared<Calibrate>();
  auto devices = std::make_shared<DeviceOptions>();
  addFolder(sub, command->calibration, "Folder of the calibration; created");
  addDevices(sub, *devices);
  addMeasurement(sub, command->settings);
  addNamed(sub, "--keep",
           "Photographs to keep once it is complete: " + listOfNames<pipeline::KeptPhotographs>(),
           command->kept)
      ->type_name("WHICH");
  addFullDisk(sub, command->fullDisk);
  addCache(sub, command->cache);
  auto network = std::make_shared<NetworkOptions>();
  addNetworkOptions(sub, network);
  auto masks = std::make_shared<std::optional<std::vector<compensation::Mask>>>();
  addMasks(sub, *masks, "without either, all is lit");
  addExternalPrograms(sub, *devices);
  addSimulatedDevices(sub, *devices);
  return [command, devices, network, masks] {
    if (*masks) command->settings.content.masks = **masks;
    command->settings.rig = rigOf(*devices);
    network->apply(command->settings.network, command->settings.rig);
    command->settings.linearization.seed = devices->seed;
    command->settings.acquisition.seed = devices->seed;
    return Command(*command);
  };
}

std::function<Command()> addResumeOptions(CLI::App* sub) {
  auto command = std::make_shared<Resume>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  addFullDisk(sub, command->fullDisk);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
