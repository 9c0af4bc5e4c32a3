// SPDX-License-Identifier: MIT
// A venue behind two external commands, as a technician's own scripts would be: one process for every picture
// and every photograph, nothing shared but files.
//   command-venue show FOLDER IMAGE.png
//   command-venue photograph FOLDER SECONDS OUTPUT SHOT
// OUTPUT is OpenEXR, or plain 32-bit floats if its name ends in .f32.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "base/fingerprint.h"
#include "image/exr.h"
#include "image/picture_files.h"
#include "system/command_venue.h"

using namespace relucent;
namespace fs = std::filesystem;

namespace {

int show(const fs::path& folder, const fs::path& image) {
  fs::copy_file(image, folder / "shown.png", fs::copy_options::overwrite_existing);
  return 0;
}

int photograph(const fs::path& folder, double seconds, const fs::path& output, const std::string& shot) {
  Rig rig = test::commandVenue().rig();
  // Nothing has been shown yet when the camera is asked for its size.
  fs::path shown = folder / "shown.png";
  rig.projectors[0]->show(fs::exists(shown) ? readPicture(shown).encoded : Image(test::commandProjector, 3));
  // The name of the shot keys the noise: photographs of different shots differ, the same one repeats.
  CaptureRequest request{{shot, 0}, 0, seconds};
  Image signal = rig.cameras[0]->capture(request).signal;
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
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
    return 1;
  }
  std::cerr << "usage: command-venue show FOLDER IMAGE | photograph FOLDER SECONDS OUTPUT SHOT\n";
  return 2;
}
