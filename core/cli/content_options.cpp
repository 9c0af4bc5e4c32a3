// SPDX-License-Identifier: MIT
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

void addTarget(CLI::App* sub, compensation::TargetSettings& target) {
  sub->add_option_function<std::vector<double>>(
         "--corners",
         [&target](const std::vector<double>& v) {
           target.corners = {{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}}};
         },
         "Corners of the content in the camera's view, pixels: x y, clockwise from top left")
      ->expected(8)
      ->type_name("X Y ...");
  addNamed(sub, "--fit", "Content of another aspect ratio: " + listOfNames<compensation::Fit>(), target.fit)
      ->type_name("FIT");
  sub->add_option("--dark-share", target.reachablePercentile,
                  "Percent of the pixels that may be too dark to show white: more makes the picture brighter")
      ->type_name("PERCENT")
      ->capture_default_str();
  sub->add_option("--black-lift", target.blackLift, "Share of white added to black")
      ->type_name("SHARE")
      ->capture_default_str();
}

void addImageAndMethod(CLI::App* sub, std::filesystem::path& image, compensation::Method& method) {
  sub->add_option("--image", image, "Content: PNG, JPEG or TIFF (sRGB), or EXR (linear)")
      ->type_name("FILE")
      ->required();
  addNamed(sub, "--method", "Method of compensation", method)->type_name("METHOD");
}

}  // namespace

std::function<Command()> addCompensateOptions(CLI::App* sub) {
  auto command = std::make_shared<Compensate>();
  pipeline::CompensateSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  addImageAndMethod(sub, settings.image, settings.method);
  addNamed(sub, "--solver", "Algorithm of optimum: " + listOfNames<compensation::SolverSettings::Algorithm>(),
           settings.solver)
      ->type_name("SOLVER");
  sub->add_option("--out", settings.out, "Folder for pattern.png, pattern.exr, target.exr, predicted.exr")
      ->type_name("DIR")
      ->required();
  addTarget(sub, settings.target);
  return [command] { return Command(*command); };
}

std::function<Command()> addProveOptions(CLI::App* sub) {
  auto command = std::make_shared<Prove>();
  pipeline::ProveSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  addImageAndMethod(sub, settings.image, settings.method);
  sub->add_option("--shown", settings.shown,
                  "Verify these instead, one picture per projector: the pixels of its display")
      ->type_name("FILE");
  sub->add_option("--out", settings.out, "Folder for the photographs, before and after, and comparison.png")
      ->type_name("DIR")
      ->required();
  addTarget(sub, settings.target);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

std::function<Command()> addEvaluateOptions(CLI::App* sub) {
  auto command = std::make_shared<Evaluate>();
  addFolder(sub, command->calibration, "Folder of the calibration of a simulated venue");
  sub->add_option("--image", command->settings.images, "Content; may be given several times")
      ->type_name("FILE");
  addNamed(sub, "--method", "Only these methods; may be given several times", command->settings.methods)
      ->type_name("METHOD");
  addTarget(sub, command->settings.target);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
