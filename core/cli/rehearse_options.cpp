// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"
#include "relucent/platform/child_process.h"

namespace relucent::cli {

std::function<Command()> addRehearseOptions(CLI::App* sub) {
  auto command = std::make_shared<RehearseDays>();
  rehearsal::DaysSettings& settings = command->settings;
  addFolder(sub, settings.calibration, "Folder of a calibration of a simulated venue; it stays as it is");
  sub->add_option("--days", settings.days, "How many days")->type_name("N")->capture_default_str();
  sub->add_option("--day-seconds", settings.daySeconds,
                  "Seconds that a day takes, beside what is waited for in it")
      ->type_name("S")
      ->capture_default_str();
  sub->add_option("--out", settings.out,
                  "New folder for the copy of the calibration and the show's log; default: a temporary one, "
                  "which stays if a bound did not hold")
      ->type_name("DIR");
  settings.program = platform::ownProgram().parent_path() / "relucent";
  sub->add_option("--program", settings.program, "The program that shows; default: relucent beside this one")
      ->type_name("FILE");
  sub->add_flag("--on-screens", settings.onScreens,
                "Show on this desktop, which needs a display of each projector's size; else no display is "
                "needed");
  addCache(sub, settings.cache);
  sub->footer(
      "Starts the show as its service does, and is the venue around it: projectors on the network, a live\n"
      "picture that is lost, power failures, nights. Says what it did day by day, and whether memory, "
      "handles,\n"
      "threads, log and calibration stayed within their bounds.\n"
      "Exit status: 0 all held, 3 one did not; 1, 2 and 130 as usual.");
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
