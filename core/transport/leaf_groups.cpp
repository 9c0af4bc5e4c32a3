// SPDX-License-Identifier: MIT
#include "relucent/transport/leaf_groups.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::transport {
namespace {

constexpr std::size_t pixelsTogether = 4096;  // worth a task

}  // namespace

ColumnKinds LeafGroups::withoutColours(std::size_t columns) {
  return {{{static_cast<std::uint32_t>(columns), 0}}, 1};
}

bool LeafGroups::areSound(const std::vector<std::uint32_t>& parent,
                          const std::vector<std::uint32_t>& groupOf) {
  for (std::size_t group = 0; group < parent.size(); ++group)
    if (parent[group] != none && parent[group] >= group) return false;
  return std::ranges::all_of(groupOf,
                             [&](std::uint32_t group) { return group == none || group < parent.size(); });
}

LeafGroups::LeafGroups(std::size_t projectors, BlockSparse leaves, std::vector<std::uint32_t> parent,
                       std::vector<std::uint32_t> groupOf)
    : projectors_(projectors),
      leaves_(std::move(leaves)),
      parent_(std::move(parent)),
      groupOf_(std::move(groupOf)) {
  require(leaves_.rows() == parent_.size() && projectors > 0 && groupOf_.size() % projectors == 0,
          "{} rows of leaves and {} memberships for {} groups of {} projectors", leaves_.rows(),
          groupOf_.size(), parent_.size(), projectors);
  require(areSound(parent_, groupOf_), "groups that come before their parents, or that there are not");
}

std::size_t LeafGroups::bytes() const {
  return empty() ? 0 : leaves_.bytes() + (parent_.size() + groupOf_.size()) * sizeof(std::uint32_t);
}

void LeafGroups::addLight(const BlockSparse& own, const Stack& x, Stack& y) const {
  if (empty()) return;
  Stack light = leaves_.multiply(x);
  for (std::size_t group = 0; group < count(); ++group)
    if (parent_[group] != none)
      for (std::size_t c = 0; c < 3; ++c) light[3 * group + c] += light[3 * parent_[group] + c];
  parallelFor(0, own.rows(), pixelsTogether, [&](std::size_t pixel) {
    Eigen::Map<Eigen::Vector3f> sum(&y[3 * pixel]);
    for (std::size_t projector = 0; projector < projectors_; ++projector)
      if (const std::uint32_t group = groupOf(pixel, projector); group != none)
        sum += own.mixing(pixel, farKind(projector)) * Eigen::Map<const Eigen::Vector3f>(&light[3 * group]);
  });
}

void LeafGroups::addAdjoint(const BlockSparse& own, const Stack& y, Stack& x) const {
  if (empty()) return;
  Stack light(3 * count(), 0.0f);
  for (std::size_t pixel = 0; pixel < own.rows(); ++pixel) {
    const Eigen::Map<const Eigen::Vector3f> in(&y[3 * pixel]);
    if (in.isZero(0.0f)) continue;
    for (std::size_t projector = 0; projector < projectors_; ++projector)
      if (const std::uint32_t group = groupOf(pixel, projector); group != none)
        Eigen::Map<Eigen::Vector3f>(&light[3 * group]) +=
            own.mixing(pixel, farKind(projector)).transpose() * in;
  }
  for (std::size_t group = count(); group-- > 0;)
    if (parent_[group] != none)
      for (std::size_t c = 0; c < 3; ++c) light[3 * parent_[group] + c] += light[3 * group + c];
  const Stack far = leaves_.multiplyTransposed(light);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += far[i];
}

std::vector<std::array<float, 3>> LeafGroups::sums() const {
  std::vector<std::array<float, 3>> sums(count());
  for (std::size_t group = 0; group < count(); ++group) {
    if (parent_[group] != none) sums[group] = sums[parent_[group]];
    for (std::size_t entry = leaves_.rowBegin(group); entry < leaves_.rowBegin(group + 1); ++entry)
      for (std::size_t c = 0; c < 3; ++c) sums[group][c] += static_cast<float>(leaves_.factor(entry)[c]);
  }
  return sums;
}

LeafGroups LeafGroups::without(const std::vector<std::uint8_t>& pixels) const {
  if (empty()) return {};
  require(pixels.size() * projectors_ == groupOf_.size(), "{} marks for {} memberships", pixels.size(),
          groupOf_.size());
  LeafGroups result = *this;
  for (std::size_t i = 0; i < groupOf_.size(); ++i)
    if (pixels[i / projectors_]) result.groupOf_[i] = none;
  return result;
}

LeafGroups LeafGroups::filtered(const std::vector<std::uint8_t>& keep) const {
  return {projectors_, leaves_.filtered(keep), parent_, groupOf_};
}

std::size_t LeafGroups::seen(const std::vector<std::uint8_t>& marked) const {
  std::vector<std::size_t> within(count());  // of a group and those around it, which come first
  for (std::size_t group = 0; group < count(); ++group) {
    for (std::size_t leaf = leaves_.rowBegin(group); leaf < leaves_.rowBegin(group + 1); ++leaf)
      within[group] += marked[leaf] != 0 ? 1 : 0;
    if (parent_[group] != none) within[group] += within[parent_[group]];
  }
  std::size_t sum = 0;
  for (const std::uint32_t group : groupOf_)
    if (group != none) sum += within[group];
  return sum;
}

}  // namespace relucent::transport
