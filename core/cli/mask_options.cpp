// SPDX-License-Identifier: MIT
#include <memory>
#include <sstream>

#include "relucent/cli/options.h"
#include "relucent/pipeline/masks_file.h"

namespace relucent::cli {
namespace {

constexpr int mostCameras = 64;

/// "[CAMERA:]x,y,x,y,x,y...". Throws: WrongUsage.
compensation::Mask maskFrom(const std::string& text) {
  compensation::Mask mask;
  std::string list = text;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    std::istringstream number(text.substr(0, colon));
    int camera = 0;
    if (number >> camera && number.eof() && camera >= 1 && camera <= mostCameras) {
      mask.camera = static_cast<std::size_t>(camera - 1);
      list = text.substr(colon + 1);
    }
  }
  std::istringstream input(list);
  bool isRead = true;
  do {
    std::array<double, 2> point{};
    char comma = 0;
    isRead = input >> point[0] >> comma >> point[1] && comma == ',';
    if (isRead) mask.points.push_back(point);
    if (isRead && (input >> std::ws).eof()) return mask;
  } while (isRead && input.get() == ',');
  throw WrongUsage(fmt::format(
      "'{}' is no mask: write [CAMERA:]x,y,x,y,x,y,... with the points of its outline as shares of the "
      "view, 0 to 1",
      text));
}

}  // namespace

void addMasks(CLI::App* sub, std::optional<std::vector<compensation::Mask>>& masks, const char* otherwise) {
  CLI::Option* file =
      sub->add_option_function<std::string>(
             "--masks",
             [&masks](const std::string& name) {
               masks = name == "none" ? std::vector<compensation::Mask>() : pipeline::readMasks(name);
             },
             std::string("Parts of the views that are not to be lit, as the masks command writes them; "
                         "none: all is lit; ") +
                 otherwise)
          ->type_name("FILE|none");
  addRepeated(
      sub, "--mask",
      [&masks](const std::string& text) {
        if (!masks) masks.emplace();
        masks->push_back(maskFrom(text));
      },
      "One such part, by the points of its outline, as shares of the view from its upper left corner; may be "
      "given "
      "several times")
      ->type_name("[CAMERA:]X,Y,...")
      ->excludes(file);
}

std::function<Command()> addMasksOptions(CLI::App* sub) {
  auto command = std::make_shared<Masks>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  addMasks(sub, command->masks, "without either, they stay");
  sub->add_option("--export", command->exported, "File to write the masks to, JSON, for --masks")
      ->type_name("FILE");
  return [command] { return Command(*command); };
}

}  // namespace relucent::cli
