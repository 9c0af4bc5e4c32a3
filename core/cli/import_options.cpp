// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {

std::function<Command()> addImportOptions(CLI::App* sub) {
  auto command = std::make_shared<ImportPictures>();
  addFolder(sub, command->calibration, "Folder of the calibration; created");
  sub->add_option("--patterns", command->settings.patterns,
                  "Folder of the projected patterns, in the projector's resolution")
      ->type_name("DIR")
      ->required();
  sub->add_option("--photographs", command->settings.photographs,
                  "Folder of the photographs, linear, paired with the patterns in the order of their names")
      ->type_name("DIR")
      ->required();
  addPixelUse(sub, command->settings.pixels);
  sub->add_option("--hold-out", command->settings.import.holdOutEvery,
                  "Hold out one of every N patterns from the fit and predict it instead")
      ->type_name("N")
      ->capture_default_str();
  return [command] { return Command(*command); };
}

std::function<Command()> addPlanOptions(CLI::App* sub) {
  auto command = std::make_shared<Plan>();
  importing::PatternPlanSettings& settings = command->settings;
  sub->add_option("--export", command->out,
                  "Folder for the pictures, plan.json and instructions.txt; created")
      ->type_name("DIR")
      ->required();
  addSize(sub, "--projector", settings.projector, "Size of the projector")->required();
  sub->add_option("--levels", settings.rampLevels, "Levels of each colour's ramp")
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--random", settings.randomPatterns, "Random patterns, blocks of 1, 2, 4, 8 pixels in turn")
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--seed", settings.seed, "Seed of the random patterns")
      ->type_name("N")
      ->capture_default_str();
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
