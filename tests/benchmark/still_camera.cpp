// SPDX-License-Identifier: MIT
// A simulated venue before a still camera of 24 megapixels, behind two external commands.
//   relucent-still-camera serve FOLDER VENUE WxH [CACHE]     stays, with the venue in memory
//   relucent-still-camera show FOLDER IMAGE.png
//   relucent-still-camera photograph FOLDER SECONDS OUTPUT
//   relucent-still-camera stop FOLDER
// The venue's own camera of 375x250 pixels is what the middle of the sensor sees, six by six of the
// photograph's pixels each; around it the sensor sees the room, lit a hundredth as brightly. A photograph is
// 3000x2000 pixels of a 6000x4000 sensor with a colour filter (devices/sensor_frame.h), 16-bit TIFF.
#include <fcntl.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>
#include <opencv2/imgcodecs.hpp>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/image/picture_files.h"
#include "relucent/venue/venue.h"

using namespace relucent;
namespace fs = std::filesystem;

namespace {

constexpr Size photograph{3000, 2000}, view{375, 250};
constexpr int each = 6;  // of the photograph's pixels, a pixel of the view, both ways
constexpr Pixel corner{(photograph.width - each * view.width) / 2,
                       (photograph.height - each * view.height) / 2};
constexpr double scattered = 0.01;
constexpr double fullWell = 30000.0, readElectrons = 4.0, codes = 16383.0;  // of one sample

fs::path requests(const fs::path& folder) {
  return folder / "requests";
}
fs::path answers(const fs::path& folder) {
  return folder / "answers";
}

/// One sample of the sensor, 0 to 1.
double sampled(double light, Random& random) {
  const double variance = std::max(0.0, light) / fullWell + std::pow(readElectrons / fullWell, 2.0);
  const double signal = std::clamp(light + std::sqrt(variance) * random.normal(), 0.0, 1.0);
  return std::round(signal * codes) / codes;
}

void expose(const Stack& radiance, double seconds, std::uint64_t number, const fs::path& output) {
  std::array<double, 3> room{};
  for (std::size_t i = 0; i < radiance.size(); ++i)
    room[i % 3] += scattered * static_cast<double>(radiance[i]) / static_cast<double>(view.count());
  cv::Mat picture(photograph.height, photograph.width, CV_16UC3);
  parallelFor(0, static_cast<std::size_t>(photograph.height), 16, [&](std::size_t row) {
    Random random{1, number, row};
    auto* line = picture.ptr<cv::Vec3w>(static_cast<int>(row));
    for (int x = 0; x < photograph.width; ++x) {
      const Pixel at{(x - corner.x) / each, (static_cast<int>(row) - corner.y) / each};
      const bool inside =
          x >= corner.x && static_cast<int>(row) >= corner.y && at.x < view.width && at.y < view.height;
      for (std::size_t c = 0; c < 3; ++c) {
        const double light =
            seconds * (inside ? static_cast<double>(radiance[3 * indexOf(view, at) + c]) : room[c]);
        // Two of four samples of a cell are green.
        const double signal =
            c == 1 ? 0.5 * (sampled(light, random) + sampled(light, random)) : sampled(light, random);
        line[x][2 - static_cast<int>(c)] = static_cast<std::uint16_t>(std::lround(signal * 65535.0));
      }
    }
  });
  cv::imwrite(output.string(), picture, {cv::IMWRITE_TIFF_COMPRESSION, 1});
}

int serve(const fs::path& folder, const std::string& name, Size projector, const fs::path& cache) {
  fs::create_directories(folder);
  for (const fs::path& pipe : {requests(folder), answers(folder)})
    if (!fs::exists(pipe) && mkfifo(pipe.c_str(), 0600) != 0) throw std::runtime_error("no pipe can be made");
  venue::VenueSettings settings;
  settings.name = name;
  settings.projector = projector;
  settings.camera = view;
  settings.pathsPerPixel = 64;
  Progress quiet;
  const venue::SimulatedVenue venue(settings, cache, quiet);
  CameraStack radiance = venue.trueRadiance({image::Image(projector, 3)});
  std::cout << "ready" << std::endl;
  std::uint64_t number = 0;
  while (true) {
    std::ifstream pipe(requests(folder));
    std::string what, first, second;
    std::string answer = "ok";
    if (!(pipe >> what)) continue;
    pipe >> first >> second;
    // Whoever asks next must not find this end still open.
    pipe.close();
    try {
      if (what == "show") {
        radiance = venue.trueRadiance({image::readPicture(first).encoded});
      } else if (what == "photograph") {
        expose(radiance, std::stod(first), ++number, second);
      }
    } catch (const std::exception& failure) {
      answer = failure.what();
    }
    std::ofstream(answers(folder)) << answer << std::endl;
    if (what == "stop") return 0;
  }
}

int ask(const fs::path& folder, const std::string& request) {
  std::ofstream(requests(folder)) << request << std::endl;
  std::ifstream pipe(answers(folder));
  std::string answer;
  std::getline(pipe, answer);
  if (answer != "ok") std::cerr << answer << '\n';
  return answer == "ok" ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() >= 4 && arguments[0] == "serve") {
      int width = 0, height = 0;
      if (std::sscanf(arguments[3].c_str(), "%dx%d", &width, &height) == 2)
        return serve(arguments[1], arguments[2], {width, height}, arguments.size() > 4 ? arguments[4] : "");
    }
    if (arguments.size() == 3 && arguments[0] == "show") return ask(arguments[1], "show " + arguments[2]);
    if (arguments.size() == 4 && arguments[0] == "photograph")
      return ask(arguments[1], "photograph " + arguments[2] + " " + arguments[3]);
    if (arguments.size() == 2 && arguments[0] == "stop") return ask(arguments[1], "stop");
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
    return 1;
  }
  std::cerr << "usage: relucent-still-camera serve FOLDER VENUE WxH [CACHE] | show FOLDER IMAGE | "
               "photograph FOLDER SECONDS OUTPUT | stop FOLDER\n";
  return 2;
}
