// SPDX-License-Identifier: MIT
#include "relucent/compensation/brightness.h"

#include <algorithm>
#include <cmath>

#include "relucent/image/colour.h"

namespace relucent::compensation {
namespace {

constexpr std::size_t columns = BrightnessField::columns, rows = BrightnessField::rows;

// Gains that are tried, in octaves. Measured, see the README.
constexpr float firstOctave = -0.5f, octavesApart = 0.25f;
constexpr std::size_t tried = 11;
constexpr double prior = 2e-3;
constexpr double reach = 0.25, smoothing = 0.175;  // deviations of the Gaussians; 1: the picture's mean side
constexpr std::size_t scaleSteps = 4096;

using Errors = std::array<double, tried>;
template <typename Value>
using Grid = std::array<Value, columns * rows>;

float octaveOf(std::size_t gain) {
  return firstOctave + octavesApart * static_cast<float>(gain);
}

template <std::size_t count>
std::array<float, count> gaussian(double deviation) {
  std::array<float, count> values;
  for (std::size_t i = 0; i < count; ++i)
    values[i] = static_cast<float>(std::exp(-0.5 * std::pow(static_cast<double>(i) / deviation, 2)));
  return values;
}

std::size_t apart(std::size_t a, std::size_t b) {
  return a < b ? b - a : a - b;
}

/// The least of errors plus a prior, between those that were tried by a parabola.
float leastOf(const Errors& errors, double weight, float centre) {
  Errors all;
  for (std::size_t gain = 0; gain < tried; ++gain)
    all[gain] = errors[gain] + prior * weight * std::pow(static_cast<double>(octaveOf(gain) - centre), 2);
  const auto best = static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin());
  if (best == 0 || best + 1 == tried) return octaveOf(best);
  const double before = all[best - 1] - all[best], after = all[best + 1] - all[best];
  const double share = before + after > 0.0 ? 0.5 * (before - after) / (before + after) : 0.0;
  return octaveOf(best) + octavesApart * static_cast<float>(share);
}

/// Sums over columns, then over rows, with weights of the distance.
template <typename Value, typename Add>
Grid<Value> blurred(const Grid<Value>& values, const std::array<float, columns>& across,
                    const std::array<float, rows>& down, const Add& add) {
  Grid<Value> half{}, whole{};
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      for (std::size_t from = 0; from < columns; ++from)
        add(half[y * columns + x], values[y * columns + from], across[apart(x, from)]);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      for (std::size_t from = 0; from < rows; ++from)
        add(whole[y * columns + x], half[from * columns + x], down[apart(y, from)]);
  return whole;
}

struct Sum {
  Errors errors{};
  double weight = 0.0;
};

std::size_t cellAt(float place, std::size_t cells) {
  const float at = place * static_cast<float>(cells);
  return at > 0.0f ? std::min(static_cast<std::size_t>(at), cells - 1) : 0;
}

}  // namespace

float BrightnessField::octavesAt(float u, float v) const {
  const float x = std::clamp(u * static_cast<float>(columns) - 0.5f, 0.0f, static_cast<float>(columns - 1));
  const float y = std::clamp(v * static_cast<float>(rows) - 0.5f, 0.0f, static_cast<float>(rows - 1));
  const std::size_t left = std::min(static_cast<std::size_t>(x), columns - 2);
  const std::size_t top = std::min(static_cast<std::size_t>(y), rows - 2);
  const float right = x - static_cast<float>(left), below = y - static_cast<float>(top);
  const float* at = &octaves[top * columns + left];
  return (1.0f - below) * ((1.0f - right) * at[0] + right * at[1]) +
         below * ((1.0f - right) * at[columns] + right * at[columns + 1]);
}

float BrightnessField::gain(float u, float v) const {
  return std::exp2(octavesAt(u, v));
}

BrightnessFit::BrightnessFit(Brightness way, double aspect) : way_(way) {
  const double cellsAcross = static_cast<double>(columns) / std::sqrt(aspect);
  const double cellsDown = static_cast<double>(rows) * std::sqrt(aspect);
  across_ = gaussian<columns>(reach * cellsAcross);
  down_ = gaussian<rows>(reach * cellsDown);
  acrossNarrow_ = gaussian<columns>(smoothing * cellsAcross);
  downNarrow_ = gaussian<rows>(smoothing * cellsDown);
  for (std::size_t step = 0; step <= scaleSteps; ++step)
    scale_.push_back(
        static_cast<float>(image::srgbEncode(static_cast<double>(step) / static_cast<double>(scaleSteps))));
}

BrightnessField BrightnessFit::fit(std::span<const BrightnessSample> samples) const {
  BrightnessField field;
  if (way_ == Brightness::even || samples.empty()) return field;
  const auto seen = [&](float light) {
    const float at = light > 0.0f ? std::min(light, 1.0f) * static_cast<float>(scaleSteps) : 0.0f;
    const std::size_t below = std::min(static_cast<std::size_t>(at), scaleSteps - 1);
    return scale_[below] + (at - static_cast<float>(below)) * (scale_[below + 1] - scale_[below]);
  };
  std::array<float, tried> gains;
  for (std::size_t gain = 0; gain < tried; ++gain) gains[gain] = std::exp2(octaveOf(gain));

  Grid<Sum> cells{};
  Sum all;
  for (const BrightnessSample& sample : samples) {
    Sum& cell = cells[cellAt(sample.v, rows) * columns + cellAt(sample.u, columns)];
    cell.weight += static_cast<double>(sample.weight);
    for (std::size_t c = 0; c < 3; ++c) {
      const float wanted = seen(sample.wanted[c]);
      for (std::size_t gain = 0; gain < tried; ++gain) {
        const float light = gains[gain] * sample.wanted[c];
        if (light >= sample.least[c] && light <= sample.most[c]) continue;
        const float off =
            seen(std::max(sample.least[c], std::min(light, sample.most[c])) / gains[gain]) - wanted;
        cell.errors[gain] += static_cast<double>(sample.weight * off * off);
      }
    }
  }
  const auto addSum = [](Sum& to, const Sum& from, float share) {
    for (std::size_t gain = 0; gain < tried; ++gain)
      to.errors[gain] += static_cast<double>(share) * from.errors[gain];
    to.weight += static_cast<double>(share) * from.weight;
  };
  for (const Sum& cell : cells) addSum(all, cell, 1.0f);
  const float ofPicture = leastOf(all.errors, all.weight, 0.0f);
  field.octaves.fill(ofPicture);
  if (way_ == Brightness::picture) return field;

  const Grid<Sum> around = blurred(cells, across_, down_, addSum);
  struct Octaves {
    double sum = 0.0, weight = 0.0;
  };
  Grid<Octaves> least;
  for (std::size_t i = 0; i < least.size(); ++i)
    least[i] = {static_cast<double>(leastOf(around[i].errors, around[i].weight, ofPicture)), 1.0};
  const Grid<Octaves> smooth =
      blurred(least, acrossNarrow_, downNarrow_, [](Octaves& to, const Octaves& from, float share) {
        to.sum += static_cast<double>(share) * from.sum;
        to.weight += static_cast<double>(share) * from.weight;
      });
  for (std::size_t i = 0; i < smooth.size(); ++i)
    field.octaves[i] = static_cast<float>(smooth[i].sum / smooth[i].weight);
  return field;
}

}  // namespace relucent::compensation
