// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "relucent/base/message.h"
#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

void addPicture(CLI::App* sub, std::filesystem::path& out) {
  sub->add_option("--out", out, "Result: .exr (linear) or .png")->type_name("FILE")->required();
}

/// "auto" is nothing.
std::optional<double> parseGain(const std::string& text) {
  if (text == "auto") return std::nullopt;
  char* end = nullptr;
  double gain = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0')
    throw WrongUsage(fmt::format("'{}' is no gain: write auto or a number, like 1.75", text));
  return gain;
}

}  // namespace

std::function<Command()> addExportOptions(CLI::App* sub) {
  auto command = std::make_shared<Export>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--transport", command->settings.transport,
                  "T for scipy.sparse.load_npz: BSR, 3x3 blocks, rows = camera pixels")
      ->type_name("FILE.npz");
  sub->add_option("--leaves", command->settings.leaves,
                  "T as stored: a column for every node of the projector's mean pyramid")
      ->type_name("FILE.npz");
  sub->add_option("--inverse", command->settings.inverse, "The inverse of T, in the same format")
      ->type_name("FILE.npz");
  sub->add_option("--maps", command->settings.maps, "Black level, flood image and masks as OpenEXR")
      ->type_name("DIR");
  sub->add_option("--mpcdi", command->settings.mpcdi,
                  "Warp and blend for media servers: VESA MPCDI, profile 2d, a region for each projector")
      ->type_name("FILE.mpcdi");
  sub->add_option("--player-maps", command->settings.playerMaps,
                  "The same as ST maps (EXR), masks (PNG) and responses (.cube), one of each a projector")
      ->type_name("DIR");
  addSize(sub, "--canvas", command->settings.canvas, "Pixels of the content that a media server plays")
      ->default_str("1920x1080");
  addSet(sub, command->settings.set,
         "The maps of media servers as this set of the calibration has it; default: the one in use");
  return [command] {
    for (const Message& problem : problems(command->settings))
      throw WrongUsage(english(problem) +
                       ": give --transport, --leaves, --inverse, --maps, --mpcdi or --player-maps");
    return Command(*command);
  };
}

std::function<Command()> addRelightOptions(CLI::App* sub) {
  auto command = std::make_shared<Relight>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--image", command->settings.image, "The pattern")->type_name("FILE")->required();
  addPicture(sub, command->settings.out);
  return [command] { return Command(*command); };
}

std::function<Command()> addDualOptions(CLI::App* sub) {
  auto command = std::make_shared<Relight>();
  command->dual = true;
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--image", command->settings.image, "Light from the camera; default: white")
      ->type_name("FILE");
  addPicture(sub, command->settings.out);
  return [command] { return Command(*command); };
}

std::function<Command()> addSeparateOptions(CLI::App* sub) {
  auto command = std::make_shared<Separate>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option("--image", command->settings.image, "The pattern; default: white")->type_name("FILE");
  sub->add_option("--reach", command->settings.direct.reach,
                  "Reach of direct light, as a share of the projector's larger side")
      ->type_name("SHARE")
      ->capture_default_str();
  sub->add_option("--out", command->settings.out, "Folder for direct and indirect, .exr and .png")
      ->type_name("DIR")
      ->required();
  return [command] { return Command(*command); };
}

std::function<Command()> addDifferenceOptions(CLI::App* sub) {
  auto command = std::make_shared<Difference>();
  pipeline::DifferenceSettings& settings = command->settings;
  sub->add_option("A", settings.first, "A picture: PNG, JPEG or TIFF (sRGB), or EXR (linear)")->required();
  sub->add_option("B", settings.second, "The picture to subtract, of the same size")->required();
  sub->add_option_function<std::string>(
         "--gain", [&settings](const std::string& text) { settings.gain = parseGain(text); },
         "Factor of the difference; auto uses the whole contrast of a .png")
      ->type_name("auto|N")
      ->default_str("auto");
  sub->add_option("--out", settings.out, "Result: .exr (gain * (A - B)) or .png (the same around mid-grey)")
      ->type_name("FILE")
      ->required();
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
