// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/change_options.h"
#include "relucent/cli/device_choices.h"
#include "relucent/cli/options.h"
#include "relucent/devices/camera_registry.h"

namespace relucent::cli {

std::function<Command()> addDevicesOptions(CLI::App* sub) {
  sub->footer("A camera's address, KIND:PLACE, is what `calibrate --camera` takes:\n" +
              devices::cameraRegistry().help());
  return [] { return Command(ListDevices{}); };
}

std::function<Command()> addCheckOptions(CLI::App* sub) {
  struct Places {
    pipeline::CommandRigSettings commands;
    venue::VenueSettings venue;
    CameraChoices cameras;
    double frameRate = 60.0;
  };
  auto command = std::make_shared<CheckRig>();
  auto places = std::make_shared<Places>();
  pipeline::CommandRigSettings& commands = places->commands;

  CLI::Option* show = sub->add_option("--projector-command", commands.projectorCommand,
                                      "Command that shows the file {image} and returns")
                          ->type_name("CMD");
  CLI::Option* projector = addSize(sub, "--projector", commands.projector, "Size of the projector");
  CLI::Option* photograph = sub->add_option("--camera-command", commands.cameraCommand,
                                            "Command that photographs {exposure} seconds into {output}")
                                ->type_name("CMD");
  CLI::Option* camera = sub->add_option_function<std::string>(
                               "--camera", [places](const std::string& text) { places->cameras.read(text); },
                               "A camera by its address, see `devices`")
                            ->type_name("KIND:PLACE");
  sub->add_option("--frame-rate", places->frameRate, "Frame rate of the projector")
      ->type_name("HZ")
      ->capture_default_str();
  CLI::Option* venue =
      sub->add_option("--venue", places->venue.name, "A simulated venue, to rehearse")->type_name("NAME");
  addCache(sub, command->cache);

  return [=] {
    if (!(places->frameRate > 0.0)) throw WrongUsage("--frame-rate must be above 0");
    command->settings.latency.frame = 1.0 / places->frameRate;
    const bool real = show->count() + photograph->count() + camera->count() > 0;
    if (real && venue->count() > 0) throw WrongUsage("give --venue or real devices, not both");
    if (!real && venue->count() == 0)
      throw WrongUsage("nothing to check: give --projector-command, --projector and --camera, or --venue");
    if (!real) {
      command->settings.rig = places->venue;
      return Command(*command);
    }
    if (!places->cameras.addresses.empty())
      places->commands.cameraAddress = places->cameras.addresses.front();
    const bool seen = photograph->count() > 0 || !places->commands.cameraAddress.empty();
    if (show->count() == 0 || projector->count() == 0 || !seen)
      throw WrongUsage(
          "real devices need --projector-command, --projector, and --camera or --camera-command");
    command->settings.rig = places->commands;
    return Command(*command);
  };
}

std::function<Command()> addVerifyOptions(CLI::App* sub) {
  auto command = std::make_shared<Verify>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--out", command->settings.out, "Folder for maps of what has changed, OpenEXR; created")
      ->type_name("DIR");
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  sub->footer("Exit status: 0 still good, 3 repair or measure again, 4 start again; 1, 2 and 130 as usual.");
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
