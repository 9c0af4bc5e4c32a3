// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/change_options.h"
#include "relucent/cli/options.h"

namespace relucent::cli {

std::function<Command()> addRepairOptions(CLI::App* sub) {
  auto command = std::make_shared<Repair>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  CLI::Option* image =
      sub->add_option("--image", command->settings.image,
                      "Picture by which it is proved; default: the content's, else a standard one")
          ->type_name("FILE");
  sub->add_flag("--undo", command->undo, "Use the measurement from before the last repair again")
      ->excludes(image);
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  sub->footer(
      "Stop the show first: the camera must see the test patterns. A repair is kept only if a photograph\n"
      "of a picture is better by it; the former measurement stays, and --undo goes back to it.\n"
      "Exit status: 0 repaired, or nothing to do, 3 not repaired: measure the venue again; 1, 2 and 130 as "
      "usual.");
  return [command] { return Command(*command); };
}

std::function<Command()> addNightOptions(CLI::App* sub) {
  auto command = std::make_shared<TendNight>();
  pipeline::NightSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  CLI::Option* content =
      addStills(sub, command->content, settings.canvas, settings.photographs, "are perfected");
  addSet(sub, settings.set, "Shown as this set of the calibration has it; default: the one in use");
  CLI::Option* alarm =
      sub->add_option("--alarm", settings.alarmCommand,
                      "Command that tells somebody when there is an alarm, once for each: {sentence} becomes "
                      "why, {calibration} the folder")
          ->type_name("COMMAND");
  sub->add_flag("--history", command->history, "Print what the nights so far came to. Takes no photographs")
      ->excludes(content)
      ->excludes(alarm);
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  sub->footer(
      "Stop the show first: the camera must see the pictures. To be started by a timer of the system; a\n"
      "show does the same by itself: relucent show --night.\n"
      "Exit status: 0 all is well, 3 somebody has to look, and the last line says why; 1, 2 and 130 as "
      "usual.");
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
