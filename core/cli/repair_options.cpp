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

}  // namespace relucent::cli
