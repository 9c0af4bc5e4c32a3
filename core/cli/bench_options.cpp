// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <memory>
#include <tuple>
#include <utility>

#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

void addAcquisition(CLI::App* sub, Bench& command) {
  pipeline::AcquisitionBenchSettings& settings = command.acquisition;
  CLI::Option_group* group = sub->add_option_group("acquisition", "Options of `acquisition`");
  group->add_option("--venue", settings.venues, "A simulated venue; may be given several times; default: all")
      ->type_name("NAME");
  addSize(group, "--projector", settings.projector, "Size of the projector")->default_str("256x192");
  addSize(group, "--camera", settings.camera, "Size of the camera")->default_str("160x120");
  addNamed(group, "--acquisition", "Only this scheme; may be given several times", settings.modes)
      ->type_name("MODE");
  group->add_option("--threshold", settings.thresholds, "Only at this threshold; may be given several times")
      ->type_name("SHARE");
  group->add_option("--seed", settings.seed, "Of noise and patterns")->type_name("NUMBER");
  group->add_flag("--every-level", settings.everyLevel,
                  "Dense patterns alone, stopped and kept after each level: what was expected, and what came "
                  "out");
  group->add_option("--chart", command.chart, "Draws quality against photographs (SVG)")->type_name("FILE");
}

/// Of "4x1024x768": how many, and their size.
std::pair<int, Size> parseDevices(const std::string& text) {
  const std::size_t cross = text.find('x');
  const int count = std::atoi(text.c_str());
  if (count < 1 || cross == std::string::npos || text.find('x', cross + 1) == std::string::npos)
    throw WrongUsage("'" + text + "' are no devices: write how many and their size, as 4x1024x768");
  return {count, parseSize(text.substr(cross + 1))};
}

void addEngine(CLI::App* sub, Bench& command) {
  CLI::Option_group* group = sub->add_option_group("engine", "Options of `engine`");
  group
      ->add_option_function<std::string>(
          "--devices",
          [&command](const std::string& text) {
            const std::size_t slash = text.find('/');
            if (slash == std::string::npos)
              throw WrongUsage("'" + text + "' are no projectors and cameras: write 4x1024x768/2x640x480");
            engine::EngineBenchSettings& settings = command.engine.emplace();
            std::tie(settings.projectors, settings.projector) = parseDevices(text.substr(0, slash));
            std::tie(settings.cameras, settings.camera) = parseDevices(text.substr(slash + 1));
          },
          "Only these projectors and cameras, in a synthetic venue where they overlap; several cameras: also "
          "a "
          "viewer who walks")
      ->type_name("NxWxH/NxWxH");
  group->add_flag("--one-thread", command.oneThread,
                  "Of --devices on the processor: seconds of one core, for machines that others use too");
}

void addScale(CLI::App* sub, Bench& command) {
  pipeline::ScaleBenchSettings& settings = command.scale;
  CLI::Option_group* group = sub->add_option_group("scale", "Options of `scale`");
  group
      ->add_option_function<std::vector<std::string>>(
          "--sizes",
          [&settings](const std::vector<std::string>& texts) {
            settings.sizes.clear();
            for (const std::string& text : texts) {
              const std::size_t slash = text.find('/');
              if (slash == std::string::npos)
                throw WrongUsage("'" + text + "' is no pair of sizes: write 1920x1080/1600x1200");
              settings.sizes.push_back({parseSize(text.substr(0, slash)), parseSize(text.substr(slash + 1))});
            }
          },
          "Projector and camera; may be given several times")
      ->type_name("WxH/WxH")
      ->default_str("1024x768/640x480 1920x1080/1600x1200 3840x2160/1600x1200");
  group->add_option("--scale-venue", settings.venue, "A simulated venue")
      ->type_name("NAME")
      ->capture_default_str();
  group->add_option("--paths", settings.pathsPerPixel, "Light paths traced for each camera pixel")
      ->capture_default_str();
}

}  // namespace

std::function<Command()> addBenchOptions(CLI::App* sub) {
  auto command = std::make_shared<Bench>();
  sub->add_option(
      "NAME", command->name,
      "Only benchmarks with this in their name; `engine`: frames of a show; `inverse` (minutes): all "
      "inverses "
      "and how well they compensate, beside the paper's figures; `acquisition` (an hour): every scheme, its "
      "cost and its error against the true transport; `scale` (an hour): what every stage takes at full "
      "scale, "
      "Full HD and 4K");
  addNamed(sub, "--backend", "Device of `engine`", command->backend);
  addEngine(sub, *command);
  addAcquisition(sub, *command);
  addScale(sub, *command);
  addCache(sub, command->cache);
  return [command] {
    command->suite = valueNamed<BenchSuite>(command->name).value_or(BenchSuite::parts);
    if (command->engine) {
      command->engine->backend = command->backend;
      command->engine->oneThread = command->oneThread;
    }
    return Command(*command);
  };
}

}  // namespace relucent::cli
