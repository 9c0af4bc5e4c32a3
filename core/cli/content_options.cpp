// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <sstream>

#include "relucent/cli/change_options.h"
#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

constexpr int mostCameras = 64;

compensation::ViewSettings& viewOf(compensation::TargetSettings& target, std::size_t camera) {
  if (target.views.size() <= camera) target.views.resize(camera + 1);
  return target.views[camera];
}

/// "2:auto" or "2:x,y,x,y,x,y,x,y". Throws: WrongUsage.
void readOwnPlace(const std::string& text, compensation::TargetSettings& target) {
  std::istringstream input(text);
  int camera = 0;
  char colon = 0;
  std::array<double, 8> v{};
  bool isRead = input >> camera >> colon && colon == ':' && camera >= 1 && camera <= mostCameras;
  const bool isAutomatic = isRead && text.substr(text.find(':') + 1) == "auto";
  for (std::size_t i = 0; isRead && !isAutomatic && i < v.size(); ++i) {
    char comma = ',';
    isRead = (i == 0 || input >> comma) && comma == ',' && input >> v[i];
  }
  if (!isRead || (!isAutomatic && !(input >> std::ws).eof()))
    throw WrongUsage(
        fmt::format("'{}' is no place of content in a view: write CAMERA:auto or CAMERA:x,y,x,y,x,y,x,y with "
                    "the corners clockwise from top left, in pixels of that camera",
                    text));
  compensation::ViewSettings& view = viewOf(target, static_cast<std::size_t>(camera - 1));
  view.placement = compensation::ViewPlacement::own;
  view.corners.reset();
  if (!isAutomatic) view.corners = {{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}}};
}

/// "x,y" or "x,y,z" from where the input stands to its end.
std::optional<compensation::Position> readPosition(std::istream& input) {
  compensation::Position position{};
  char comma = ',';
  if (!(input >> position[0] >> comma >> position[1]) || comma != ',') return std::nullopt;
  if ((input >> std::ws).eof()) return position;
  if (!(input >> comma >> position[2]) || comma != ',' || !(input >> std::ws).eof()) return std::nullopt;
  return position;
}

/// "2:x,y,z". Throws: WrongUsage.
void readCameraPosition(const std::string& text, compensation::TargetSettings& target) {
  std::istringstream input(text);
  int camera = 0;
  char colon = 0;
  std::optional<compensation::Position> position;
  if (input >> camera >> colon && colon == ':' && camera >= 1 && camera <= mostCameras)
    position = readPosition(input);
  if (!position)
    throw WrongUsage(fmt::format(
        "'{}' is no camera's position: write CAMERA:x,y or CAMERA:x,y,z, in metres or as a plan has "
        "it",
        text));
  viewOf(target, static_cast<std::size_t>(camera - 1)).position = position;
}

void readViewer(const std::string& text, compensation::TargetSettings& target) {
  std::istringstream input(text);
  target.viewer = readPosition(input);
  if (!target.viewer)
    throw WrongUsage(
        fmt::format("'{}' is no viewer's position: write x,y or x,y,z as the cameras have it", text));
}

/// Of venues that several cameras look at.
void addViews(CLI::App* sub, compensation::TargetSettings& target) {
  sub->add_option_function<std::vector<double>>(
         "--view-weights",
         [&target](const std::vector<double>& weights) {
           for (std::size_t camera = 0; camera < weights.size(); ++camera)
             viewOf(target, camera).weight = weights[camera];
         },
         "Weights of the cameras' views, from the first on: those left out have 1; 0: asks for nothing")
      ->expected(1, mostCameras)
      ->type_name("WEIGHT ...");
  sub->add_option_function<std::vector<std::string>>(
         "--view-corners",
         [&target](const std::vector<std::string>& places) {
           for (const std::string& place : places) readOwnPlace(place, target);
         },
         "A picture of its own in the view of a camera beyond the first, upright from there: auto finds the "
         "place; may be given several times. Without it the picture lies on the surface")
      ->type_name("CAMERA:auto|CAMERA:X,Y,...");
  sub->add_option_function<std::vector<std::string>>(
         "--camera-position",
         [&target](const std::vector<std::string>& positions) {
           for (const std::string& position : positions) readCameraPosition(position, target);
         },
         "Where a camera stands, metres or as a plan has it; once for each, for --viewer")
      ->type_name("CAMERA:X,Y,Z");
  sub->add_option_function<std::string>(
         "--viewer", [&target](const std::string& position) { readViewer(position, target); },
         "Where a viewer stands: the views count as they are near, by the cameras' positions")
      ->type_name("X,Y,Z");
}

/// "auto" or a number; its range is for problems() to judge. Throws: WrongUsage.
std::optional<double> readBlackLift(const std::string& text) {
  if (text == "auto") return std::nullopt;
  std::istringstream input(text);
  double share = 0.0;
  if (!(input >> share) || !(input >> std::ws).eof())
    throw WrongUsage(
        fmt::format("'{}' is no black lift: write auto, or a share of white such as 0.01", text));
  return share;
}

void addTarget(CLI::App* sub, compensation::TargetSettings& target, std::string& set) {
  const std::vector<CLI::Option*> before = sub->get_options();
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
  sub->add_option_function<std::string>(
         "--black-lift", [&target](const std::string& text) { target.blackLift = readBlackLift(text); },
         "Share of white added to black; auto: the least that hides where the black of several projectors "
         "ends")
      ->type_name("SHARE|auto")
      ->default_str("auto");
  addNamed(sub, "--brightness", "How bright white is where: " + listOfNames<compensation::Brightness>(),
           target.brightness)
      ->type_name("BRIGHTNESS");
  addNamed(sub, "--objective", "Which errors count: " + listOfNames<compensation::Objective>(),
           target.objective)
      ->type_name("OBJECTIVE");
  addNamed(sub, "--clipping",
           "Colours of which a place cannot show one channel: " + listOfNames<compensation::Clipping>(),
           target.clipping)
      ->type_name("CLIPPING");
  addViews(sub, target);
  addMasks(sub, target.masks, "without either, those of the calibration");
  std::vector<CLI::Option*> own;
  for (CLI::Option* option : sub->get_options())
    if (std::ranges::count(before, option) == 0) own.push_back(option);
  addSet(sub, set, "All of this as a set of the calibration has it, see the sets command", own);
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
  addTarget(sub, settings.target, settings.set);
  return [command] { return Command(*command); };
}

std::function<Command()> addProveOptions(CLI::App* sub) {
  auto command = std::make_shared<Prove>();
  pipeline::ProveSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  addImageAndMethod(sub, settings.image, settings.method);
  sub->add_option("--shown", settings.shown,
                  "Verify these instead, one picture per projector: the pixels of its display, or linear "
                  "drive (EXR)")
      ->type_name("FILE");
  sub->add_option("--out", settings.out, "Folder for the photographs, before and after, and comparison.png")
      ->type_name("DIR")
      ->required();
  addTarget(sub, settings.target, settings.set);
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

std::function<Command()> addPerfectOptions(CLI::App* sub) {
  auto command = std::make_shared<Perfect>();
  pipeline::PerfectSettings& settings = command->settings;
  addFolder(sub, command->calibration, "Folder of the calibration");
  CLI::Option* content =
      addStills(sub, command->content, settings.canvas, settings.photographs, "are perfected");
  addSet(sub, settings.set, "Shown as this set of the calibration has it; default: the one in use");
  sub->add_flag("--forget", command->forget,
                "Show these pictures as before; without --content all of them. Takes no photographs");
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  sub->footer(
      "Stop the show first: the camera must see the pictures that are perfected.\n"
      "Exit status: 0 all were perfected or could not be better, 1 not all; 2 and 130 as usual.");
  return [command, content] {
    if (!command->forget && content->count() == 0) throw WrongUsage("name pictures with --content");
    return Command(*command);
  };
}

std::function<Command()> addEvaluateOptions(CLI::App* sub) {
  auto command = std::make_shared<Evaluate>();
  addFolder(sub, command->calibration, "Folder of the calibration of a simulated venue");
  sub->add_option("--image", command->settings.images, "Content; may be given several times")
      ->type_name("FILE");
  addNamed(sub, "--method", "Only these methods; may be given several times", command->settings.methods)
      ->type_name("METHOD");
  addNamed(sub, "--rival",
           "What others do, besides; may be given several times: " + listOfNames<compensation::Rival>(),
           command->settings.rivals)
      ->type_name("RIVAL");
  sub->add_flag(
      "--blended", command->settings.blended,
      "Of several projectors: compare with each solved on its own, blended by cosine ramps, and alone");
  sub->add_option("--perfected", command->settings.perfected,
                  "Correct every picture by so many photographs of itself, and tell what each of them gained")
      ->type_name("COUNT");
  sub->add_option(
         "--walk", command->settings.walk.frames,
         "A viewer walks past all cameras in so many frames, of the first picture, as a show follows him; "
         "needs every --camera-position")
      ->type_name("FRAMES");
  sub->add_option("--film", command->settings.walk.film,
                  "Folder for what all views see meanwhile, side by side, as numbered pictures")
      ->type_name("DIR");
  addTarget(sub, command->settings.target, command->settings.set);
  addChanges(sub, command->changes);
  addCache(sub, command->cache);
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
