// SPDX-License-Identifier: MIT
#include "relucent/pipeline/rehearsed_content.h"

#include <algorithm>

namespace relucent::pipeline {
namespace {

constexpr Size canvas = RehearsedContent::canvas;
constexpr std::int64_t sceneFrames = 60, slideFrames = 200, fadeFrames = 12;

/// A part of an image, brought to the canvas: what a camera that pans sees.
image::Image panned(const image::Image& from, double share, float brightness) {
  image::Image picture(canvas, 3);
  const double zoom = 0.7, left = share * (1.0 - zoom) * (from.width() - 1),
               top = (1.0 - share) * (1.0 - zoom) * (from.height() - 1);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      const double u = left + zoom * x * (from.width() - 1) / (canvas.width - 1);
      const double v = top + zoom * y * (from.height() - 1) / (canvas.height - 1);
      const int u0 = std::min(static_cast<int>(u), from.width() - 2);
      const int v0 = std::min(static_cast<int>(v), from.height() - 2);
      const auto fu = static_cast<float>(u - u0), fv = static_cast<float>(v - v0);
      for (int c = 0; c < 3; ++c)
        picture.at(x, y, c) =
            brightness * ((1 - fv) * ((1 - fu) * from.at(u0, v0, c) + fu * from.at(u0 + 1, v0, c)) +
                          fv * ((1 - fu) * from.at(u0, v0 + 1, c) + fu * from.at(u0 + 1, v0 + 1, c)));
    }
  return picture;
}

}  // namespace

std::int64_t RehearsedContent::keyOf(ShownContent content, std::int64_t frame) const {
  switch (content) {
    case ShownContent::still:
      return 0;
    case ShownContent::film:
    case ShownContent::dark:
      return frame % (4 * sceneFrames);
    case ShownContent::slides: {
      const auto count = static_cast<std::int64_t>(images_.size());
      const std::int64_t slide = frame / slideFrames % count, within = frame % slideFrames;
      return slideFrames * slide + (within < slideFrames - fadeFrames ? 0 : within);
    }
  }
  return 0;
}

image::Image RehearsedContent::at(ShownContent content, std::int64_t key) const {
  const auto picture = [&](std::int64_t index) -> const image::Image& {
    return images_[static_cast<std::size_t>(index) % images_.size()].linear;
  };
  const std::int64_t scene = key / sceneFrames, within = key % sceneFrames;
  const double share = static_cast<double>(within) / (sceneFrames - 1);
  switch (content) {
    case ShownContent::still:
      return images_[seed_ % 3].linear;
    case ShownContent::film: {
      // Every other scene ends by fading to black.
      const double left = static_cast<double>(sceneFrames - 1 - within) / fadeFrames;
      const double brightness = scene % 2 == 1 ? std::min(1.0, left) : 1.0;
      return panned(picture(static_cast<std::int64_t>(seed_) + scene), scene % 2 == 0 ? share : 1.0 - share,
                    static_cast<float>(brightness));
    }
    case ShownContent::dark:
      return panned(scene % 2 == 0 ? images_.back().linear : images_[4].linear, share, 0.4f);
    case ShownContent::slides: {
      const std::int64_t slide = key / slideFrames, within8 = key % slideFrames;
      const float mix = within8 == 0 ? 0.0f
                                     : static_cast<float>(within8 - (slideFrames - fadeFrames) + 1) /
                                           static_cast<float>(fadeFrames + 1);
      image::Image mixed = picture(slide);
      for (std::size_t i = 0; i < mixed.data().size(); ++i)
        mixed.data()[i] = (1.0f - mix) * mixed.data()[i] + mix * picture(slide + 1).data()[i];
      return mixed;
    }
  }
  return {};
}

}  // namespace relucent::pipeline
