// SPDX-License-Identifier: MIT
#include "relucent/pipeline/difference.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/pictures.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

/// Any picture as linear values; those of floating-point files as they are, negative ones too.
image::Image readLinear(const fs::path& path) {
  if (valueNamed<PictureFormat>(path.extension().string()) != PictureFormat::exr)
    return image::readLinearContent(path);
  image::Image image = image::readRgbExr(path);
  image::checkFinite(image, path);
  return image;
}

/// The gain that shows all but the largest half percent of the differences.
double fullContrast(const image::Image& difference) {
  std::vector<float> sizes;
  for (float value : difference.data()) sizes.push_back(std::abs(value));
  auto place = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 995 / 1000);
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place > 0.0f ? 0.5 / static_cast<double>(*place) : 1.0;
}

/// Grey where the two are equal; brighter where the first is. Signal values, not light: nothing to encode.
image::Image centredOnGrey(const image::Image& difference, double gain) {
  image::Image picture = difference;
  for (float& value : picture.data())
    value = static_cast<float>(std::clamp(0.5 + gain * static_cast<double>(value), 0.0, 1.0));
  return picture;
}

}  // namespace

std::vector<Message> problems(const DifferenceSettings& settings) {
  std::vector<Message> found;
  if (settings.first.empty() || settings.second.empty())
    found.emplace_back(RELUCENT_ENGLISH_MESSAGE("difference.two-pictures-needed", "two pictures are needed"));
  if (settings.out.empty())
    found.emplace_back(
        RELUCENT_ENGLISH_MESSAGE("settings.no-output-file", "no file for the result is given"));
  if (settings.gain && !(*settings.gain > 0.0 && std::isfinite(*settings.gain)))
    found.emplace_back(RELUCENT_ENGLISH_MESSAGE("difference.gain-not-positive", "the gain must be above 0"));
  return found;
}

DifferenceResult pictureDifference(const DifferenceSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  const PictureFormat format = pictureFormatOf(settings.out);
  image::Image first = readLinear(settings.first);
  progress.report(0.3);
  image::Image second = readLinear(settings.second);
  progress.report(0.6);
  if (first.size() != second.size())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("difference.sizes-differ", "pictures of {} and {} pixels cannot be compared")
            .with(as::size(first.width(), first.height()), as::size(second.width(), second.height())),
        RELUCENT_ENGLISH_MESSAGE("difference.choose-pictures-of-one-camera",
                                 "choose two pictures of one camera"));

  DifferenceResult result;
  image::Image difference = first;
  double apart = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < difference.data().size(); ++i) {
    auto b = static_cast<double>(second.data()[i]);
    double d = static_cast<double>(first.data()[i]) - b;
    difference.data()[i] = static_cast<float>(d);
    apart += d * d;
    whole += b * b;
  }
  result.rms = std::sqrt(apart / static_cast<double>(difference.data().size()));
  result.relative = whole > 0.0 ? std::sqrt(apart / whole) : 0.0;
  result.gain = settings.gain ? *settings.gain : fullContrast(difference);
  if (format == PictureFormat::exr) {
    for (float& value : difference.data())
      value = static_cast<float>(settings.gain.value_or(1.0) * static_cast<double>(value));
    if (!settings.gain) result.gain = 1.0;
    writePicture(settings.out, difference, "difference of linear values, times the gain", 1.0f);
  } else {
    image::writePng(settings.out, centredOnGrey(difference, result.gain), 8);
  }
  result.files = {settings.out};
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
