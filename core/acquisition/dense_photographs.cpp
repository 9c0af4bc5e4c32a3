// SPDX-License-Identifier: MIT
#include "relucent/acquisition/dense_photographs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/parallel.h"

namespace relucent::acquisition {
namespace {

// Floods below this share of their median count as that: nothing is known relative to no light.
constexpr float dimmestFlood = 1e-3f;
// A projector that gives a channel less than this share of its light has no mixing of its own there.
constexpr float leastLight = 1e-3f;
// A photograph's noise is at least this share of its variance, the rest is that of e, which all have in
// common.
constexpr float ownNoise = 0.3f;
constexpr double leastSeen = 0.3;
// No pattern shows more light than all projectors do; much more is a fault, and beyond half precision.
constexpr float mostLight = 1000.0f;

}  // namespace

DensePhotographs::DensePhotographs(const photography::References& references)
    : references_(references), flood_(3 * references.usable.size(), 0.0f) {
  std::size_t rows = references.usable.size();
  for (const std::vector<transport::ColourBlock>& root : references.root)
    for (std::size_t row = 0; row < rows; ++row)
      Eigen::Map<Eigen::Vector3f>(&flood_[3 * row]) += root[row].rowwise().sum();
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> channel(rows);
    for (std::size_t row = 0; row < rows; ++row) channel[row] = flood_[3 * row + c];
    auto middle = channel.begin() + static_cast<std::ptrdiff_t>(rows / 2);
    std::nth_element(channel.begin(), middle, channel.end());
    float least = std::max(dimmestFlood * *middle, std::numeric_limits<float>::min());
    for (std::size_t row = 0; row < rows; ++row) flood_[3 * row + c] = std::max(flood_[3 * row + c], least);
  }
}

std::vector<transport::ColourBlock> DensePhotographs::floodMixing(std::size_t row) const {
  std::vector<transport::ColourBlock> mixings;
  for (const std::vector<transport::ColourBlock>& root : references_.root) {
    transport::ColourBlock mixing = root[row].cwiseMax(0.0f);
    for (Eigen::Index c = 0; c < 3; ++c) {
      float sum = mixing.row(c).sum();
      if (sum > leastLight * flood(row)[c])
        mixing.row(c) /= sum;
      else
        mixing.row(c).setConstant(1.0f / 3.0f);
    }
    mixings.push_back(mixing);
  }
  return mixings;
}

void DensePhotographs::add(const hdr::LampLight& seen) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Photograph photograph{std::vector<Eigen::half>(flood_.size()), std::vector<Eigen::half>(flood_.size())};
  parallelFor(0, flood_.size(), 4096, [&](std::size_t i) {
    float light = seen.radiance[i] / flood_[i];
    bool known = seen.valid[i] && std::abs(light) < mostLight;
    float deviation = known ? std::sqrt(std::max(0.0f, seen.variance[i])) / flood_[i] : infinity;
    photograph.light[i] = static_cast<Eigen::half>(known ? light : 0.0f);
    photograph.deviation[i] = static_cast<Eigen::half>(deviation);
  });
  photographs_.push_back(std::move(photograph));
}

void DensePhotographs::reject(std::size_t photograph, std::size_t row) {
  for (std::size_t c = 0; c < 3; ++c)
    photographs_[photograph].deviation[3 * row + c] = std::numeric_limits<Eigen::half>::infinity();
}

std::pair<Eigen::Array3f, Eigen::Array3f> DensePhotographs::shown(std::size_t photograph,
                                                                  std::size_t row) const {
  const Photograph& of = photographs_[photograph];
  using Halves = Eigen::Map<const Eigen::Array<Eigen::half, 3, 1>>;
  return {of.scale * Halves(&of.light[3 * row]).cast<float>(),
          (of.scale * Halves(&of.deviation[3 * row]).cast<float>()).square()};
}

void DensePhotographs::read(std::size_t row, std::size_t heldOut, multiplexing::RowLight& seen) const {
  auto equations = static_cast<Eigen::Index>(3 * references_.root.size() + photographs_.size());
  seen.light.resize(equations, 3);
  seen.variance.resize(equations, 3);
  Eigen::Array3f unit = 1.0f / flood(row);
  // What e is off by is the same in all of them; their own noise is the rest.
  Eigen::Array3f black =
      Eigen::Map<const Eigen::Array3f>(&references_.black.variance[3 * row]) * unit.square();
  seen.offset = black.sqrt();
  Eigen::Index n = 0;
  auto put = [&](const Eigen::Array3f& light, const Eigen::Array3f& variance) {
    seen.light.row(n) = light;
    seen.variance.row(n++) = (variance - black).max(ownNoise * variance);
  };
  for (std::size_t projector = 0; projector < references_.root.size(); ++projector)
    for (Eigen::Index k = 0; k < 3; ++k)
      put(references_.root[projector][row].col(k).array() * unit,
          references_.rootVariance[projector][row].col(k).array() * unit.square());
  for (std::size_t number = 0; number < photographs_.size(); ++number) {
    auto [light, variance] = shown(number, row);
    if (number + heldOut >= photographs_.size()) variance.setConstant(std::numeric_limits<float>::infinity());
    put(light, variance);
  }
}

bool DensePhotographs::hardlySeen(std::size_t row) const {
  std::size_t seen = 0;
  for (std::size_t number = 0; number < photographs_.size(); ++number)
    seen += static_cast<std::size_t>(shown(number, row).second.isFinite().count());
  return static_cast<double>(seen) < leastSeen * 3.0 * static_cast<double>(photographs_.size());
}

}  // namespace relucent::acquisition
