// SPDX-License-Identifier: MIT
#include <memory>

#include "cli/options.h"

namespace relucent {
namespace {

void addTarget(CLI::App* sub, TargetSettings& target) {
  sub->add_option_function<std::vector<double>>(
         "--corners",
         [&target](const std::vector<double>& v) {
           target.corners = {{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}}};
         },
         "Corners of the content in the camera's view, pixels: x y, clockwise from top left")
      ->expected(8)
      ->type_name("X Y ...");
  sub->add_option_function<std::string>(
         "--fit", [&target](const std::string& name) { target.fit = fitFromName(name).value(); },
         "Content in corners of another shape: fill stretches, fit leaves bars, cover cuts off")
      ->check(CLI::IsMember({"fill", "fit", "cover"}))
      ->type_name("FIT")
      ->default_str("fill");
  sub->add_option("--dark-share", target.reachablePercentile,
                  "Percent of the pixels that may be too dark to show white: more is brighter")
      ->type_name("PERCENT")
      ->capture_default_str();
  sub->add_option("--black-lift", target.blackLift, "Share of white added to black")
      ->type_name("SHARE")
      ->capture_default_str();
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const MethodDescription& method : methodDescriptions) names.emplace_back(method.name);
  return names;
}

void addImageAndMethod(CLI::App* sub, std::filesystem::path& image, std::string& method) {
  sub->add_option("--image", image, "Content: PNG, JPEG or TIFF (sRGB), or EXR (linear)")
      ->type_name("FILE")
      ->required();
  sub->add_option("--method", method, "How to compensate")
      ->check(CLI::IsMember(methodNames()))
      ->type_name("METHOD")
      ->capture_default_str();
}

}  // namespace

std::function<Command()> addCompensateOptions(CLI::App* sub) {
  auto command = std::make_shared<Compensate>();
  CompensateSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  addImageAndMethod(sub, settings.image, settings.method);
  sub->add_option(
         "--solver", settings.solver,
         "How optimum is found: fista, spectral (Barzilai-Borwein), descent (the paper's five steps), "
         "dense (small scale)")
      ->check(CLI::IsMember({"fista", "spectral", "descent", "dense"}))
      ->type_name("SOLVER")
      ->capture_default_str();
  sub->add_option("--out", settings.out, "Folder for pattern.png, pattern.exr, target.exr, predicted.exr")
      ->type_name("DIR")
      ->required();
  addTarget(sub, settings.target);
  return [command] { return Command(*command); };
}

std::function<Command()> addProveOptions(CLI::App* sub) {
  auto command = std::make_shared<Prove>();
  ProveSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  addImageAndMethod(sub, settings.image, settings.method);
  sub->add_option("--shown", settings.shown,
                  "Prove this instead, one picture a projector: what stands on its display, pixel by pixel")
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
  sub->add_option("--method", command->settings.methods, "Only these methods; may be given several times")
      ->check(CLI::IsMember(methodNames()))
      ->type_name("METHOD");
  addTarget(sub, command->settings.target);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent
