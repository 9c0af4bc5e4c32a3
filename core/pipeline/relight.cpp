// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/error.h"
#include "image/color.h"
#include "image/exr.h"
#include "image/picture_files.h"
#include "image/resample.h"
#include "pipeline/measured_venue.h"
#include "pipeline/pipeline.h"
#include "pipeline/projection.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

/// The value that a picture for people shows as white: all but the brightest half percent stay below it.
float displayWhite(const Image& linear) {
  std::vector<float> values = linear.data();
  auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 995 / 1000);
  std::nth_element(values.begin(), place, values.end());
  return std::max(*place, 1e-9f);
}

void writePicture(const fs::path& path, const Image& linear, const std::string& units) {
  std::string extension = path.extension().string();
  if (extension == ".exr") {
    writeExr(path, linear, ExrType::floatType, {{exr_attribute::units, units}});
    return;
  }
  if (extension != ".png")
    throw Error(ErrorKind::input, fmt::format("pictures are not written as \"{}\"", extension),
                "choose a name that ends in .exr (linear values) or .png (to look at)", path.string());
  float white = displayWhite(linear);
  writePng(path, viewed(linear, {white, white, white}), 8);
}

/// One picture per device; the second and later ones are numbered.
WrittenFiles writeAll(const fs::path& out, const Stack& stack, const Rasters& rasters,
                      const std::string& units) {
  WrittenFiles written;
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    fs::path path = out;
    if (device > 0)
      path.replace_filename(
          fmt::format("{}-{}{}", out.stem().string(), device + 1, out.extension().string()));
    writePicture(path, imageFromStack(stack, rasters, device), units);
    written.files.push_back(path);
  }
  return written;
}

/// What relighting starts from, whichever way the light goes.
struct Opened {
  std::optional<Image> content;  // none: all white
  MeasuredVenue venue;
};

Opened opened(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  if (std::vector<std::string> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(), "name the file to write");
  Opened result;
  if (!settings.image.empty()) result.content = readLinearContent(settings.image);
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  result.venue = loadMeasuredVenue(folder, progress);
  return result;
}

}  // namespace

WrittenFiles relight(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  auto [content, venue] = opened(path, settings, progress);

  const Rasters& projectors = venue.transport.projectors();
  Stack pattern(projectors.count() * 3, 1.0f);
  if (content) pattern = patternFrom(*content, projectors);
  for (float& value : pattern) value = std::clamp(value, 0.0f, 1.0f);
  Stack relit = venue.transport.apply(pattern);
  for (std::size_t i = 0; i < relit.size(); ++i) relit[i] += venue.black[i];
  return writeAll(settings.out, relit, venue.transport.cameras(), "camera signal per second");
}

WrittenFiles dual(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  auto [content, venue] = opened(path, settings, progress);

  const Rasters& cameras = venue.transport.cameras();
  Stack light(cameras.count() * 3, 1.0f);
  if (content) light = patternFrom(*content, cameras);
  return writeAll(settings.out, venue.transport.applyTransposed(light), venue.transport.projectors(),
                  "camera signal per second and linear projector drive");
}

}  // namespace relucent
