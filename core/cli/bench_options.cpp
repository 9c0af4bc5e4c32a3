// SPDX-License-Identifier: MIT
#include <memory>

#include "cli/options.h"
#include "engine/fallback_backend.h"

namespace relucent {
namespace {

void addAcquisition(CLI::App* sub, AcquisitionBenchSettings& settings) {
  CLI::Option_group* group = sub->add_option_group("acquisition", "What `acquisition` measures");
  group->add_option("--venue", settings.venues, "A simulated venue; may be given several times; all")
      ->type_name("NAME");
  addSize(group, "--projector", settings.projector, "Size of the projector")->default_str("256x192");
  addSize(group, "--camera", settings.camera, "Size of the camera")->default_str("160x120");
  group->add_option("--acquisition", settings.modes, "Only this way to measure; may be given several times")
      ->type_name("MODE");
  group->add_option("--threshold", settings.thresholds, "Only at this threshold; may be given several times")
      ->type_name("SHARE");
}

}  // namespace

std::function<Command()> addBenchOptions(CLI::App* sub) {
  auto command = std::make_shared<Bench>();
  sub->add_option(
      "NAME", command->name,
      "Only benchmarks with this in their name; `engine`: frames of a show; `inverse` (minutes): all ways to "
      "invert, and how well each compensates, beside the paper's figures; `acquisition` (an hour): every "
      "way to measure, what it costs and how near it comes to the truth");
  sub->add_option("--backend", command->backend, "What `engine` runs on")
      ->transform(CLI::CheckedTransformer(backendChoices()));
  addAcquisition(sub, command->acquisition);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent
