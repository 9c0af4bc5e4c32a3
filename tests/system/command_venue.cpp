// SPDX-License-Identifier: MIT
// A venue behind two external commands, as a technician's own scripts would be: one process for every picture
// and every photograph, nothing shared but files.
//   command-venue show FOLDER IMAGE.png
//   command-venue photograph FOLDER SECONDS OUTPUT SHOT
//   command-venue photograph-several FOLDER SECONDS OUTPUT SHOT CAMERA
// What is shown is FOLDER/shown.png; of several projectors shown-0.png, shown-1.png.
// OUTPUT is OpenEXR, or plain 32-bit floats if its name ends in .f32.
#include <png.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/fingerprint.h"
#include "relucent/image/exr.h"
#include "system/command_venue.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;
namespace fs = std::filesystem;

namespace {

/// Drive values as a PNG of 8 bits holds them. By libpng, not by the program's own way of reading pictures:
/// that would load OpenCV for every photograph, and agree with itself about any mistake.
Image shownPicture(const fs::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  std::vector<png_byte> codes;
  bool read = png_image_begin_read_from_file(&header, path.c_str()) != 0;
  if (read && (header.format & PNG_FORMAT_FLAG_LINEAR) == 0) {
    header.format = PNG_FORMAT_RGB;
    codes.resize(PNG_IMAGE_SIZE(header));
    read = png_image_finish_read(&header, nullptr, codes.data(), 0, nullptr) != 0;
  }
  if (!read || codes.empty())
    throw Error(ErrorKind::format, Message::plain("this is no PNG of 8 bits"),
                Message::plain("copy the file that was to be shown"), path.string());
  Image image({static_cast<int>(header.width), static_cast<int>(header.height)}, 3);
  for (std::size_t i = 0; i < codes.size(); ++i) image.data()[i] = static_cast<float>(codes[i]) / 255.0f;
  return image;
}

int show(const fs::path& folder, const fs::path& image) {
  fs::copy_file(image, folder / "shown.png", fs::copy_options::overwrite_existing);
  return 0;
}

int photograph(const fs::path& folder, double seconds, const fs::path& output, const std::string& shot,
               std::optional<std::size_t> ofSeveral = std::nullopt) {
  Rig rig = test::commandVenue(ofSeveral.has_value()).rig();
  for (std::size_t i = 0; i < rig.projectors.size(); ++i) {
    const fs::path shown = folder / (ofSeveral ? "shown-" + std::to_string(i) + ".png" : "shown.png");
    // Nothing has been shown yet when the camera is asked for its size.
    rig.projectors[i]->show(fs::exists(shown) ? shownPicture(shown) : Image(rig.projectors[i]->size(), 3));
  }
  // The name of the shot keys the noise: photographs of different shots differ, the same one repeats.
  CaptureRequest request{{shot, 0}, 0, seconds};
  Image signal = rig.cameras.at(ofSeveral.value_or(0))->capture(request).signal;
  if (output.extension() != ".f32") {
    writeExr(output, signal, ExrType::floatType);
    return 0;
  }
  std::ofstream file(output, std::ios::binary);
  file.write(reinterpret_cast<const char*>(signal.data().data()),
             static_cast<std::streamsize>(signal.data().size() * sizeof(float)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() == 3 && arguments[0] == "show") return show(arguments[1], arguments[2]);
    if (arguments.size() == 5 && arguments[0] == "photograph")
      return photograph(arguments[1], std::stod(arguments[2]), arguments[3], arguments[4]);
    if (arguments.size() == 6 && arguments[0] == "photograph-several")
      return photograph(arguments[1], std::stod(arguments[2]), arguments[3], arguments[4],
                        std::stoul(arguments[5]));
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
    return 1;
  }
  std::cerr << "usage: command-venue show FOLDER IMAGE | photograph FOLDER SECONDS OUTPUT SHOT | "
               "photograph-several FOLDER SECONDS OUTPUT SHOT CAMERA\n";
  return 2;
}
