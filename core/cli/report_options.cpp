// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {

std::function<Command()> addReportOptions(CLI::App* sub) {
  auto command = std::make_shared<Report>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--out", command->settings.out, "The file; default: report.html in the calibration")
      ->type_name("FILE");
  sub->add_option("--image", command->settings.images, "Content to show; may be given several times")
      ->type_name("FILE");
  sub->add_flag("!--no-evaluate", command->settings.evaluate, "Leave out the comparison of methods");
  CLI::Option* bundle =
      sub->add_option(
             "--bundle", command->settings.bundle,
             "Also write this .zip for support: report, settings, versions; no pictures of the venue")
          ->type_name("FILE");
  sub->add_flag("--photographs", command->settings.photographs, "Include pictures of the venue in the bundle")
      ->needs(bundle);
  sub->add_option("--attach", command->settings.attachments, "A file to add to the bundle, such as a log")
      ->type_name("FILE")
      ->needs(bundle);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
