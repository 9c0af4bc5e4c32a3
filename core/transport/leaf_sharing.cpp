// SPDX-License-Identifier: MIT
#include "relucent/transport/leaf_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/transport/row_light.h"
#include "relucent/transport/shared_colours.h"
#include "relucent/transport/shared_light.h"

namespace relucent::transport {
namespace {

constexpr int side = SharedLight::side;
// Of shares, which sum to one where they are not noise: less than this says nothing of their scale.
constexpr float enough = 0.2f;
constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

/// Shares as codes in steps of `step`; what rounding leaves over is handed on to the next, so that sums stay.
class ShareCodes {
 public:
  explicit ShareCodes(const Channels& step) : step_(step) {}

  std::array<std::int16_t, 3> next(const Channels& share) {
    std::array<std::int16_t, 3> code{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(step_[c] > 0.0f)) continue;
      const float wanted = share[c] / step_[c] + rest_[c];
      const float rounded = std::clamp(std::round(wanted), -largestCode, largestCode);
      rest_[c] = wanted - rounded;
      code[c] = static_cast<std::int16_t>(rounded);
      sum_[c] += rounded;
    }
    return code;
  }
  const Channels& sum() const { return sum_; }

 private:
  Channels step_, rest_{}, sum_{};
};

void append(const std::vector<NodeShare>& leaves, ShareCodes& codes, SharedColourRow& row) {
  for (const NodeShare& leaf : leaves) {
    const std::array<std::int16_t, 3> code = codes.next(leaf.share);
    if (code == std::array<std::int16_t, 3>{}) continue;
    row.column.push_back(leaf.node);
    row.factor.push_back(code);
  }
}

/// The mixing of codes with the light of `shares` in `mixing`, unless hardly anything is left of them.
ColourBlock mixingOfCodes(const ColourBlock& mixing, const Channels& shares, const Channels& codes,
                          const Channels& step) {
  ColourBlock result = mixing;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool holds = std::abs(codes[c]) * step[c] > enough && std::abs(shares[c]) > enough;
    result.col(static_cast<Eigen::Index>(c)) *= holds ? shares[c] / codes[c] : step[c];
  }
  return result;
}

/// A pixel's own shares on the scale of its groups'. Shares are of all the pixel's far light, of which one
/// may have a bright leaf that its neighbours have not: theirs of all else are larger then. So that colours
/// which fit the groups' shares fit its own as well, those are divided by
///   (all - own) / groups.
std::vector<NodeShare> besideGroups(std::vector<NodeShare> own, const Channels& all, const Channels& codes,
                                    const Channels& step) {
  const Channels sum = sumOf(own);
  for (std::size_t c = 0; c < 3; ++c) {
    const float left = all[c] - sum[c], groups = codes[c] * step[c];
    if (!(left > enough && groups > enough)) continue;
    for (NodeShare& leaf : own) leaf.share[c] *= groups / left;
  }
  return own;
}

/// Whether a pixel's far light is dark or noise, whose sum shares of its groups might not keep.
bool isOfItsOwn(const LightPart& far, const std::vector<NodeShare>& own, const Channels& codes,
                const Channels& step) {
  const Channels all = sumOf(far.leaves), sum = sumOf(own);
  for (std::size_t c = 0; c < 3; ++c)
    if (!(std::abs(all[c]) > enough && std::abs(sum[c] + codes[c] * step[c]) > enough)) return true;
  return false;
}

/// A square of camera pixels and what its leaves in one projector have become.
struct SquareOfProjector {
  std::vector<SharedColourRow> groups;  // parents first; mixings are not filled
  std::vector<std::uint32_t> parent;    // within the square, or none
  std::array<std::uint32_t, SharedLight::pixels> groupOf{};
};

struct Square {
  std::array<SharedColourRow, SharedLight::pixels> rows;
  std::vector<SquareOfProjector> projectors;
};

class Sharer {
 public:
  Sharer(const TransportMatrix& transport, float tolerance) : transport_(transport), tolerance_(tolerance) {}

  /// `pixel`: of each place, nobody where there is none.
  Square square(const std::array<std::size_t, SharedLight::pixels>& pixel) const {
    Square result;
    const std::size_t projectors = transport_.projectors().devices();
    for (SharedColourRow& row : result.rows) row.mixing.assign(2 * projectors, ColourBlock::Zero());
    std::array<std::vector<RowLight>, SharedLight::pixels> light;
    for (std::size_t i = 0; i < pixel.size(); ++i)
      if (pixel[i] != nobody) light[i] = rowLights(transport_, pixel[i], tolerance_);
    for (std::size_t projector = 0; projector < projectors; ++projector)
      result.projectors.push_back(share(light, projector, result.rows));
    for (SharedColourRow& row : result.rows) sort(row);
    return result;
  }

 private:
  using Lights = std::array<std::vector<RowLight>, SharedLight::pixels>;

  SquareOfProjector share(const Lights& light, std::size_t projector,
                          std::array<SharedColourRow, SharedLight::pixels>& rows) const {
    std::vector<std::vector<NodeShare>> far(SharedLight::pixels);
    std::vector<Channels> weight(SharedLight::pixels, Channels{});
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (light[i].empty()) continue;
      far[i] = light[i][projector].far.leaves;
      weight[i] = light[i][projector].farWeight;
    }
    const SharedLight shared = shareLight(transport_.layout(), far, weight, tolerance_);

    SquareOfProjector result;
    result.groupOf = shared.groupOf;
    // One scale for the far shares of all camera pixels, since groups are of several.
    constexpr Channels step{LeafGroups::shareStep, LeafGroups::shareStep, LeafGroups::shareStep};
    std::vector<Channels> codesOf;  // sums of each group and those around it
    for (const LightGroup& group : shared.groups) {
      SharedColourRow& row = result.groups.emplace_back();
      ShareCodes codes(step);
      append(group.leaves, codes, row);
      sort(row);
      result.parent.push_back(group.parent);
      codesOf.push_back(codes.sum());
      if (group.parent != LightGroup::none)
        for (std::size_t c = 0; c < 3; ++c) codesOf.back()[c] += codesOf[group.parent][c];
    }
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (light[i].empty()) {
        result.groupOf[i] = LightGroup::none;
        continue;
      }
      const RowLight& of = light[i][projector];
      addNear(of.near, projector, rows[i]);
      Channels ofGroups = shared.groupOf[i] == LightGroup::none ? Channels{} : codesOf[shared.groupOf[i]];
      ShareCodes codes(step);
      if (isOfItsOwn(of.far, shared.own[i], ofGroups, step)) {
        result.groupOf[i] = LightGroup::none;
        ofGroups = {};
        append(of.far.leaves, codes, rows[i]);
      } else {
        append(besideGroups(shared.own[i], sumOf(of.far.leaves), ofGroups, step), codes, rows[i]);
      }
      Channels sum = codes.sum();
      for (std::size_t c = 0; c < 3; ++c) sum[c] += ofGroups[c];
      rows[i].mixing[farKind(projector)] = mixingOfCodes(of.far.mixing, sumOf(of.far.leaves), sum, step);
    }
    dropUnused(result);
    return result;
  }

  /// Groups that no pixel is in any more hold nothing.
  static void dropUnused(SquareOfProjector& square) {
    std::vector<std::uint8_t> used(square.groups.size(), 0);
    for (std::uint32_t group : square.groupOf)
      for (; group != LightGroup::none && !used[group]; group = square.parent[group]) used[group] = 1;
    for (std::size_t group = 0; group < used.size(); ++group)
      if (!used[group]) square.groups[group] = {};
  }

  static void addNear(const LightPart& near, std::size_t projector, SharedColourRow& row) {
    Channels step{};
    for (const NodeShare& leaf : near.leaves)
      for (std::size_t c = 0; c < 3; ++c) step[c] = std::max(step[c], std::abs(leaf.share[c]) / largestCode);
    ShareCodes codes(step);
    append(near.leaves, codes, row);
    row.mixing[nearKind(projector)] = mixingOfCodes(near.mixing, sumOf(near.leaves), codes.sum(), step);
  }

  static void sort(SharedColourRow& row) {
    std::vector<std::pair<std::uint32_t, std::array<std::int16_t, 3>>> leaves;
    for (std::size_t j = 0; j < row.column.size(); ++j) leaves.emplace_back(row.column[j], row.factor[j]);
    std::ranges::sort(leaves);
    for (std::size_t j = 0; j < leaves.size(); ++j)
      std::tie(row.column[j], row.factor[j]) = std::tie(leaves[j].first, leaves[j].second);
  }

  const TransportMatrix& transport_;
  float tolerance_;
};

/// Puts squares into rows of camera pixels and of groups, stripe by stripe.
class SharedMatrix {
 public:
  explicit SharedMatrix(const TransportMatrix& transport)
      : transport_(transport),
        projectors_(transport.projectors().devices()),
        own_(transport.layout().count(), transport.cameras().count(), *transport.ownLeaves().sharedColours(),
             transport.storedLeaves() / 3),
        groupOf_(transport.cameras().count() * projectors_, LeafGroups::none) {}

  void addGroups(Square& square, const std::array<std::size_t, SharedLight::pixels>& pixel) {
    for (std::size_t projector = 0; projector < projectors_; ++projector) {
      SquareOfProjector& of = square.projectors[projector];
      const auto first = static_cast<std::uint32_t>(parent_.size());
      for (std::size_t group = 0; group < of.groups.size(); ++group) {
        groups_.push_back(std::move(of.groups[group]));
        parent_.push_back(of.parent[group] == LightGroup::none ? LeafGroups::none : first + of.parent[group]);
      }
      for (std::size_t i = 0; i < pixel.size(); ++i)
        if (pixel[i] != nobody && of.groupOf[i] != LightGroup::none)
          groupOf_[pixel[i] * projectors_ + projector] = first + of.groupOf[i];
    }
  }
  void addRow(const SharedColourRow& row) { own_.add(row); }

  TransportMatrix build() {
    std::size_t leaves = 0;
    for (const SharedColourRow& group : groups_) leaves += group.column.size();
    const std::size_t columns = transport_.layout().count();
    SharedColourWriter writer(columns, groups_.size(), LeafGroups::withoutColours(columns), leaves);
    for (SharedColourRow& group : groups_) {
      group.mixing = {ColourBlock::Identity()};
      writer.add(group);
      group = {};
    }
    return {transport_.cameras(), transport_.projectors(), own_.build(),
            LeafGroups(projectors_, writer.build(), std::move(parent_), std::move(groupOf_))};
  }

 private:
  const TransportMatrix& transport_;
  std::size_t projectors_;
  SharedColourWriter own_;
  std::vector<SharedColourRow> groups_;
  std::vector<std::uint32_t> parent_, groupOf_;
};

}  // namespace

TransportMatrix withSharedLeaves(const TransportMatrix& transport, float tolerance, Progress& progress) {
  if (!transport.ownLeaves().sharedColours() || !transport.groups().empty()) return transport;
  const Sharer sharer(transport, tolerance);
  SharedMatrix shared(transport);
  const Rasters& cameras = transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const auto across = static_cast<std::size_t>((size.width + side - 1) / side);
    std::vector<Square> stripe(across);
    std::vector<std::array<std::size_t, SharedLight::pixels>> pixels(across);
    for (int top = 0; top < size.height; top += side) {
      parallelFor(0, across, 1, [&](std::size_t x) {
        const int left = static_cast<int>(x) * side;
        pixels[x].fill(nobody);
        for (int dy = 0; dy < side && top + dy < size.height; ++dy)
          for (int dx = 0; dx < side && left + dx < size.width; ++dx)
            pixels[x][SharedLight::placeOf(dx, dy)] =
                cameras.offset(camera) + indexOf(size, {left + dx, top + dy});
        stripe[x] = sharer.square(pixels[x]);
      });
      for (std::size_t x = 0; x < across; ++x) shared.addGroups(stripe[x], pixels[x]);
      for (int dy = 0; dy < side && top + dy < size.height; ++dy)
        for (int x = 0; x < size.width; ++x)
          shared.addRow(stripe[static_cast<std::size_t>(x / side)].rows[SharedLight::placeOf(x % side, dy)]);
      progress.report((static_cast<double>(camera) +
                       static_cast<double>(std::min(top + side, size.height)) / size.height) /
                      static_cast<double>(cameras.devices()));
    }
  }
  return shared.build();
}

}  // namespace relucent::transport
