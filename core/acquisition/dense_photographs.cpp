// SPDX-License-Identifier: MIT
#include "relucent/acquisition/dense_photographs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/matrix_size.h"
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
// The photographs of a part that lie together on the disk.
constexpr std::size_t photographsTogether = 64;
// A part of one photograph: light, then its deviation, infinite where it was saturated.
constexpr std::size_t valuesOfPart = DensePhotographs::rowsTogether * 3 * 2;

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
  used_.assign(parts(), 0);
  for (std::size_t row = 0; row < rows; ++row)
    if (references.usable[row]) used_[row / rowsTogether] = 1;
}

std::vector<float> DensePhotographs::floodShares(std::size_t row) const {
  std::vector<float> shares;
  float all = 0.0f;
  for (const std::vector<transport::ColourBlock>& root : references_.root)
    all += shares.emplace_back(std::max(root[row].sum(), std::numeric_limits<float>::min()));
  for (float& share : shares) share /= all;
  return shares;
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

DensePhotographs::Stored DensePhotographs::store(const hdr::LampLight& seen) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  parallelFor(0, parts(), 1, [&](std::size_t part) {
    if (!isUsed(part)) return;
    std::vector<Eigen::half> values(valuesOfPart);
    std::size_t begin = 3 * part * rowsTogether, count = std::min(3 * rowsTogether, flood_.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      float flood = flood_[begin + i], light = seen.radiance[begin + i] / flood;
      bool known = seen.valid[begin + i] && std::abs(light) < mostLight;
      float deviation = known ? std::sqrt(std::max(0.0f, seen.variance[begin + i])) / flood : infinity;
      values[i] = static_cast<Eigen::half>(known ? light : 0.0f);
      values[valuesOfPart / 2 + i] = static_cast<Eigen::half>(deviation);
    }
    file_.write(placeOf(stored_, part), std::span<const Eigen::half>(values));
  });
  return stored_++;
}

void DensePhotographs::keep(std::size_t count) {
  photographs_.resize(std::min(count, size()));
  std::erase_if(rejected_, [&](const auto& rejection) { return rejection.second >= size(); });
}

void DensePhotographs::reject(const Rejections& unseen) {
  rejected_.insert(rejected_.end(), unseen.begin(), unseen.end());
  std::ranges::sort(rejected_);
}

void DensePhotographs::forgetJudgements() {
  rejected_.clear();
  for (Photograph& photograph : photographs_) photograph.scale = 1.0f;
}

std::uint64_t DensePhotographs::placeOf(Stored photograph, std::size_t part) const {
  std::size_t together = photograph / photographsTogether * parts() + part;
  return sizeof(Eigen::half) * valuesOfPart *
         (together * photographsTogether + photograph % photographsTogether);
}

DensePhotographs::Rows::Rows(const DensePhotographs& photographs, std::size_t part)
    : photographs_(photographs),
      begin_(part * rowsTogether),
      end_(std::min(begin_ + rowsTogether, photographs.references_.usable.size())) {
  Stored stored = 0;
  for (const Photograph& photograph : photographs.photographs_)
    stored = std::max(stored, photograph.stored + 1);
  values_.resize(stored * valuesOfPart);
  for (Stored first = 0; first < stored; first += photographsTogether) {
    std::size_t count = std::min(photographsTogether, stored - first);
    photographs.file_.read(photographs.placeOf(first, part),
                           std::span(&values_[first * valuesOfPart], count * valuesOfPart));
  }
  const Rejections& rejected = photographs.rejected_;
  auto rejection = std::ranges::lower_bound(rejected, std::pair(begin_, std::uint32_t{0}));
  for (; rejection != rejected.end() && rejection->first < end_; ++rejection)
    std::fill_n(&values_[photographs.photographs_[rejection->second].stored * valuesOfPart +
                         valuesOfPart / 2 + 3 * (rejection->first - begin_)],
                3, std::numeric_limits<Eigen::half>::infinity());
}

std::pair<Eigen::Array3f, Eigen::Array3f> DensePhotographs::Rows::shown(std::size_t photograph,
                                                                        std::size_t row) const {
  using Halves = Eigen::Map<const Eigen::Array<Eigen::half, 3, 1>>;
  auto [stored, scale] = photographs_.photographs_[photograph];
  const Eigen::half* light = &values_[stored * valuesOfPart + 3 * (row - begin_)];
  return {scale * Halves(light).cast<float>(),
          (scale * Halves(light + valuesOfPart / 2).cast<float>()).square()};
}

void DensePhotographs::Rows::read(std::size_t row, std::size_t heldOut, multiplexing::RowLight& seen) const {
  const photography::References& references = photographs_.references_;
  auto equations = static_cast<Eigen::Index>(3 * references.root.size() + photographs_.size());
  sizeTo(seen.light, equations, 3);
  sizeTo(seen.variance, equations, 3);
  Eigen::Array3f unit = 1.0f / photographs_.flood(row);
  // What e is off by is the same in all of them; their own noise is the rest.
  Eigen::Array3f black =
      Eigen::Map<const Eigen::Array3f>(&references.black.variance[3 * row]) * unit.square();
  seen.offset = black.sqrt();
  Eigen::Index n = 0;
  auto put = [&](const Eigen::Array3f& light, const Eigen::Array3f& variance) {
    seen.light.row(n) = light;
    seen.variance.row(n++) = (variance - black).max(ownNoise * variance);
  };
  for (std::size_t projector = 0; projector < references.root.size(); ++projector)
    for (Eigen::Index k = 0; k < 3; ++k)
      put(references.root[projector][row].col(k).array() * unit,
          references.rootVariance[projector][row].col(k).array() * unit.square());
  for (std::size_t number = 0; number < photographs_.size(); ++number) {
    auto [light, variance] = shown(number, row);
    if (number + heldOut >= photographs_.size()) variance.setConstant(std::numeric_limits<float>::infinity());
    put(light, variance);
  }
}

bool DensePhotographs::Rows::hardlySeen(std::size_t row) const {
  std::size_t seen = 0;
  for (std::size_t number = 0; number < photographs_.size(); ++number)
    seen += static_cast<std::size_t>(shown(number, row).second.isFinite().count());
  return static_cast<double>(seen) < leastSeen * 3.0 * static_cast<double>(photographs_.size());
}

}  // namespace relucent::acquisition
