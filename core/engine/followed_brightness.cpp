// SPDX-License-Identifier: MIT
#include "relucent/engine/followed_brightness.h"

#include <algorithm>
#include <cmath>

namespace relucent::engine {
namespace {

constexpr double timeConstant = 1.0;  // seconds
constexpr float newScene = 0.4f;      // share of the pixels whose brightness changes
// What is left of a way when it counts as gone, in octaves: less than one code of a projector's 8 bits.
constexpr float near = 0.003f;

double aspectOf(const EngineContent& content) {
  const Size size = content.warp.content();
  return static_cast<double>(size.width) / size.height;
}

}  // namespace

FollowedBrightness::FollowedBrightness(const EngineVenue& engine, const EngineContent& content,
                                       compensation::Brightness way)
    : look_(engine, content), fit_(way, aspectOf(content)) {
  const compensation::MeasuredVenue& venue = engine.venue;
  for (const std::size_t i : look_.cameraPixels()) {
    compensation::BrightnessSample sample;
    sample.u = content.place[i][0];
    sample.v = content.place[i][1];
    sample.weight = content.weight[i];
    for (std::size_t c = 0; c < 3; ++c) {
      sample.least[c] = venue.black[3 * i + c] / content.white;
      sample.most[c] = sample.least[c] + std::max(0.0f, venue.flood[3 * i + c]) / content.white;
    }
    samples_.push_back(sample);
  }
}

const compensation::BrightnessField& FollowedBrightness::follow(const ContentFrame& frame,
                                                                std::chrono::duration<double> elapsed) {
  look_.look(frame);
  for (std::size_t sample = 0; sample < samples_.size(); ++sample)
    samples_[sample].wanted = look_.mixed()[sample];
  const compensation::BrightnessField goal = fit_.fit(samples_);
  const auto left = static_cast<float>(std::exp(-std::max(0.0, elapsed.count()) / timeConstant));
  settled_ = !begun_ || look_.changed() > newScene;
  begun_ = true;
  if (!settled_) {
    float most = 0.0f;
    for (std::size_t cell = 0; cell < goal.octaves.size(); ++cell) {
      const float apart = left * (now_.octaves[cell] - goal.octaves[cell]);
      now_.octaves[cell] = goal.octaves[cell] + apart;
      most = std::max(most, std::abs(apart));
    }
    settled_ = most < near;
  }
  if (settled_) now_ = goal;
  return now_;
}

}  // namespace relucent::engine
