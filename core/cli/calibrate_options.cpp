// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

/// A folder as it is known from everywhere: `resume` may be called elsewhere.
std::string absolutePath(const std::string& folder) {
  return std::filesystem::absolute(folder).string();
}

}  // namespace

std::function<Command()> addCalibrateOptions(CLI::App* sub) {
  struct Places {
    venue::VenueSettings venue;
    pipeline::CommandRigSettings commands;
    pipeline::ReplayRigSettings replay;
    Size projector{256, 192};
    Size camera{160, 120};
    std::uint64_t seed = 1;
  };
  auto command = std::make_shared<Calibrate>();
  auto places = std::make_shared<Places>();
  pipeline::CalibrateSettings& settings = command->settings;

  addFolder(sub, command->calibration, "Folder of the calibration; created");
  CLI::Option* venue = sub->add_option("--venue", places->venue.name, "A simulated venue, see `venues`")
                           ->type_name("NAME")
                           ->capture_default_str();
  CLI::Option* projector =
      addSize(sub, "--projector", places->projector, "Size of the projector")->default_str("256x192");
  CLI::Option* camera = sub->add_option_function<std::string>(
      "--camera", [places](const std::string& text) { readCamera(text, places->commands, places->camera); },
      "A real camera by its address, see `devices`; or the size of the camera");
  camera->type_name("KIND:PLACE|WxH")->default_str("160x120");
  CLI::Option* cameraSize =
      addSize(sub, "--camera-size", places->camera, "Size of the photographs, if --camera is an address");
  sub->add_option("--seed", places->seed, "Seed of all random numbers: the same seed gives the same bits")
      ->type_name("N")
      ->capture_default_str();
  // Before all that changes single settings: a mode sets all of them.
  addNamed<acquisition::AcquisitionMode>(
      sub, "--acquisition",
      "How the light transport is measured: " + listOfNames<acquisition::AcquisitionMode>(),
      [&settings](acquisition::AcquisitionMode mode) { settings.acquisition = settingsOf(mode); })
      ->type_name("MODE")
      ->default_str("adaptive");
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
  addCache(sub, command->cache);

  CLI::Option_group* real = sub->add_option_group("External programs", "Any projector and camera by script");
  CLI::Option* show =
      real->add_option("--projector-command", places->commands.projectorCommand,
                       "Command that shows the file {image} and returns when the picture is lit");
  CLI::Option* photograph =
      real->add_option("--camera-command", places->commands.cameraCommand,
                       "Command that photographs {exposure} seconds into the file {output}");
  show->type_name("CMD");
  photograph->type_name("CMD");
  real->add_option("--shortest", places->commands.shortestExposure, "Shortest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();
  real->add_option("--longest", places->commands.longestExposure, "Longest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();

  real->add_option("--latency", places->commands.latency,
                   "Time until a picture is displayed, as measured by `check`")
      ->type_name("SECONDS")
      ->capture_default_str();
  CLI::Option* frameRate =
      real->add_option("--frame-rate", places->commands.frameRate,
                       "Frame rate of the projector: exposures become multiples of a frame")
          ->type_name("HZ");
  CLI::Option* record =
      real->add_option_function<std::string>(
              "--record",
              [places](const std::string& folder) { places->commands.record = absolutePath(folder); },
              "Folder for a recording of all patterns and photographs, for --replay")
          ->type_name("DIR");
  CLI::Option* replay =
      real->add_option_function<std::string>(
              "--replay",
              [places](const std::string& folder) { places->replay.folder = absolutePath(folder); },
              "A recording to use instead of projector and camera")
          ->type_name("DIR");

  venue::DeviceModelSettings& devices = places->venue.devices;
  CLI::Option_group* simulated = sub->add_option_group("Simulated devices", "Simulated imperfections");
  auto simulate = [&](const char* name, auto& value, const char* what) {
    simulated->add_option(name, value, what)->capture_default_str();
  };
  simulate("--paths", places->venue.pathsPerPixel, "Light paths traced for each camera pixel");
  simulate("--projector-bits", devices.projectorBits, "Bits of the projector's drive values");
  simulate("--camera-bits", devices.cameraBits, "Bits of the camera");
  simulate("--full-well", devices.fullWell, "Electrons of the camera at full scale");
  simulate("--contrast", devices.contrast, "White of the projector divided by its black");
  simulate("--ambient", devices.ambient, "Room light, as a share of the mean flood image");
  simulate("--drift", devices.drift, "Relative change of the lamp over 1000 photographs");
  simulate("--flicker", devices.flicker, "Relative standard deviation of the lamp between photographs");
  simulate("--camera-gamma", devices.cameraGamma, "Response of the camera; 1 is linear");
  simulated->add_flag("--white-segment", devices.whiteSegment, "White is brighter than red + green + blue");

  auto refuseSimulation = [=] {
    for (const CLI::Option* option : simulated->get_options())
      if (option->count() > 0) throw WrongUsage(option->get_name() + " is for simulated venues only");
    if (venue->count() > 0) throw WrongUsage("give --venue or external programs, not both");
  };
  auto refuseBesideReplay = [=] {
    for (const CLI::Option* other : {show, photograph, camera, projector, record, frameRate})
      if (other->count() > 0)
        throw WrongUsage(other->get_name() +
                         " cannot be used with --replay: the recording contains its devices");
    refuseSimulation();
  };
  auto external = [=] {
    const bool addressed = !places->commands.cameraAddress.empty();
    if (cameraSize->count() > 0 && !addressed)
      throw WrongUsage("--camera-size is for cameras with an address; write --camera WxH");
    if (addressed && photograph->count() > 0)
      throw WrongUsage("give a camera's address or --camera-command, not both");
    if (addressed && (show->count() == 0 || projector->count() == 0))
      throw WrongUsage("a real camera also needs --projector-command and --projector");
    if (show->count() + photograph->count() == 0) {
      for (const CLI::Option* other : {record, frameRate})
        if (other->count() > 0) throw WrongUsage(other->get_name() + " is for real devices");
      return false;
    }
    if (show->count() == 0 || (photograph->count() == 0 && !addressed) || projector->count() == 0)
      throw WrongUsage("external programs need --projector-command, --camera-command and --projector");
    refuseSimulation();
    return true;
  };
  return [command, places, external, refuseBesideReplay, camera, cameraSize, replay] {
    if (replay->count() > 0) {
      refuseBesideReplay();
      command->settings.rig = places->replay;
    } else if (external()) {
      places->commands.projector = places->projector;
      const bool addressed = !places->commands.cameraAddress.empty();
      if ((addressed ? cameraSize : camera)->count() > 0) places->commands.camera = places->camera;
      command->settings.rig = places->commands;
    } else {
      places->venue.projector = places->projector;
      places->venue.camera = places->camera;
      places->venue.seed = places->seed;
      command->settings.rig = places->venue;
    }
    command->settings.linearization.seed = places->seed;
    command->settings.acquisition.seed = places->seed;
    return Command(*command);
  };
}

std::function<Command()> addResumeOptions(CLI::App* sub) {
  auto command = std::make_shared<Resume>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
