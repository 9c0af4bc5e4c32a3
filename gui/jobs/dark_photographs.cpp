// SPDX-License-Identifier: MIT
#include "jobs/dark_photographs.h"

#include <algorithm>

#include "relucent/base/median.h"
#include "relucent/image/colour.h"

namespace relucent::gui {
namespace {

constexpr double leastShown = 0.01;  // of full light
constexpr float mostCovered = 0.5f;  // of the range
constexpr float cutOff = 0.98f;      // of the range: the mean says less than there was
constexpr double darkShare = 0.05;   // of what is usual: projectors' curves differ from sRGB's by a few times
constexpr std::size_t enough = 3;    // photographs, to know what is usual
constexpr std::size_t remembered = 32;    // of those
constexpr int lasting = 2;                // photographs
constexpr std::size_t fewSamples = 9000;  // of an image that are enough

/// The mean over some of an image's samples of what `value` makes of them.
template <typename Value>
double meanOf(const image::Image& image, Value value) {
  const std::vector<float>& all = image.data();
  // No multiple of three: all channels have their turn.
  std::size_t step = all.size() / fewSamples + 1;
  if (step % 3 == 0) ++step;
  double sum = 0.0, count = 0.0;
  for (std::size_t at = 0; at < all.size(); at += step) {
    sum += value(all[at]);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

void DarkPhotographs::add(std::size_t camera, const std::vector<image::Image>& encodedPatterns,
                          const rig::RawFrame& frame) {
  if (frame.signal.empty() || !(frame.seconds > 0.0)) return;
  double light = 0.0;
  std::vector<bool> lit;
  for (const image::Image& pattern : encodedPatterns) {
    const double shown =
        meanOf(pattern, [](float drive) { return image::srgbDecode(static_cast<double>(drive)); });
    light += shown;
    lit.push_back(shown > 0.0);
  }
  if (light < leastShown) return;
  float brightest = 0.0f;
  const double signal = meanOf(frame.signal, [&](float value) {
    brightest = std::max(brightest, value);
    return static_cast<double>(value);
  });
  std::vector<double>& usual = usual_[{camera, lit}];
  const double ratio = signal / (frame.seconds * light);
  if (brightest < mostCovered && usual.size() >= enough && ratio < darkShare * medianOf(usual)) {
    ++dark_[camera];
    return;
  }
  dark_[camera] = 0;
  if (brightest >= cutOff) return;
  usual.push_back(ratio);
  if (usual.size() > remembered) usual.erase(usual.begin());
}

bool DarkPhotographs::last() const {
  return std::ranges::any_of(dark_, [](const auto& camera) { return camera.second >= lasting; });
}

}  // namespace relucent::gui
