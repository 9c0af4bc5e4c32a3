// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {

std::function<Command()> addTidyOptions(CLI::App* sub) {
  auto command = std::make_shared<Tidy>();
  sub->add_option("CALIBRATION", command->calibrations, "Folders of calibrations")->required();
  addNamed<pipeline::KeptPhotographs>(
      sub, "--keep",
      "Photographs to keep of a complete calibration: " + listOfNames<pipeline::KeptPhotographs>() +
          "; default: what it was begun with",
      [command](pipeline::KeptPhotographs kept) { command->settings.kept = kept; })
      ->type_name("WHICH");
  sub->add_flag("--dry-run", command->settings.dryRun, "Only say what would be freed");
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
