// SPDX-License-Identifier: MIT
#include "relucent/engine/packed_transport.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/engine/camera_rectangle.h"
#include "relucent/transport/row_light.h"

namespace relucent::engine {
namespace {

// Of the columns that 16 bits number one is for what fills up rows.
constexpr std::size_t mostColumnsOfAPatch = 65535;
using transport::Channels;
using transport::ColourBlock;
using transport::LightGroup;
using transport::LightPart;
using transport::NodeShare;
using transport::RowLight;
using transport::SharedLight;
constexpr int squareSide = SharedLight::side;
using transport::TransportMatrix;

/// Leaves with nodes of the layout, before patches renumber them.
struct Run {
  std::vector<std::uint32_t> node;
  std::vector<std::array<std::int16_t, 3>> code;
};

struct Row {
  Run leaves;
  ColourBlock own = ColourBlock::Zero(), shared = ColourBlock::Zero();  // `own` of the leaves' codes
  PackedRow packed;                                                     // its group: in its square
};

struct Group {
  Run leaves;
  PackedGroup packed;  // its parent and its rows: in its square
};

/// Camera pixels that share leaves, all of them in one patch.
struct Square {
  std::vector<Group> groups;
  std::vector<Row> rows;
};

/// Codes of shares on one scale for each channel; what rounds to nothing is left out.
Run runOf(const std::vector<NodeShare>& shares, const Channels& scale) {
  Run run;
  for (const NodeShare& share : shares) {
    std::array<std::int16_t, 3> code{};
    for (std::size_t c = 0; c < 3; ++c)
      if (scale[c] > 0.0f) code[c] = static_cast<std::int16_t>(std::lround(share.share[c] / scale[c]));
    if (code == std::array<std::int16_t, 3>{}) continue;
    run.node.push_back(share.node);
    run.code.push_back(code);
  }
  return run;
}

Channels scalesOf(const std::vector<NodeShare>& shares) {
  Channels scale{};
  for (const NodeShare& share : shares)
    for (std::size_t c = 0; c < 3; ++c) scale[c] = std::max(scale[c], std::abs(share.share[c]) / largestCode);
  return scale;
}

float scaleOf(const std::vector<NodeShare>& shares) {
  const Channels scale = scalesOf(shares);
  return *std::max_element(scale.begin(), scale.end());
}

ColourBlock scaledColumns(const ColourBlock& block, const Channels& factor) {
  return block * Eigen::Vector3f(factor[0], factor[1], factor[2]).asDiagonal();
}

/// Mixings with which a row's shares have the row's sum:  own ownShares + shared groupShares = sum. That of
/// the own leaves is changed, since there is most light, or the other one where they hardly have any.
void keepSum(const ColourBlock& sum, const Channels& ownShares, const Channels& groupShares, ColourBlock& own,
             ColourBlock& shared) {
  constexpr float enough = 0.2f;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const float ofOwn = ownShares[static_cast<std::size_t>(k)],
                ofGroup = groupShares[static_cast<std::size_t>(k)];
    if (ofOwn > enough)
      own.col(k) = (sum.col(k) - ofGroup * shared.col(k)) / ofOwn;
    else if (ofGroup > enough)
      shared.col(k) = (sum.col(k) - ofOwn * own.col(k)) / ofGroup;
  }
}

/// Leaves of one mixing as leaves of another, by least squares.
std::vector<NodeShare> mixedAs(const std::vector<NodeShare>& leaves, const ColourBlock& from,
                               const ColourBlock& to) {
  Channels factor{};
  for (Eigen::Index k = 0; k < 3; ++k)
    if (const float square = to.col(k).squaredNorm(); square > 0.0f)
      factor[static_cast<std::size_t>(k)] = to.col(k).dot(from.col(k)) / square;
  std::vector<NodeShare> mixed = leaves;
  for (NodeShare& leaf : mixed)
    for (std::size_t c = 0; c < 3; ++c) leaf.share[c] *= factor[c];
  return mixed;
}

/// Only the brightest leaves if a patch could not number them all.
void keepBrightest(RowLight& light) {
  if (light.near.leaves.size() + light.far.leaves.size() <= mostColumnsOfAPatch) return;
  std::vector<float> strengths;
  auto strengthOf = [](const LightPart& part, const NodeShare& leaf) {
    float strength = 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
      strength += std::abs(leaf.share[c]) * part.mixing.col(static_cast<Eigen::Index>(c)).norm();
    return strength;
  };
  for (const LightPart* part : {&light.near, &light.far})
    for (const NodeShare& leaf : part->leaves) strengths.push_back(strengthOf(*part, leaf));
  const auto last = strengths.begin() + mostColumnsOfAPatch - 1;
  std::nth_element(strengths.begin(), last, strengths.end(), std::greater<>());
  const float least = *last;
  const auto above = static_cast<std::size_t>(
      std::count_if(strengths.begin(), strengths.end(), [&](float strength) { return strength > least; }));
  std::size_t equal = mostColumnsOfAPatch - above;  // the first ones of those at the limit
  for (LightPart* part : {&light.near, &light.far})
    std::erase_if(part->leaves, [&](const NodeShare& leaf) {
      const float strength = strengthOf(*part, leaf);
      if (strength != least) return strength < least;
      if (equal == 0) return true;
      --equal;
      return false;
    });
}

/// `far`: the leaves of far light that no group holds; `groupShares`: the sum of those that groups hold.
Row packedRow(const RowLight& light, const std::vector<NodeShare>& far, const Channels& groupShares,
              const ColourBlock& sum) {
  // Nothing may be near, or it may be noise.
  const bool isNear = light.near.mixing.norm() > 0.0f;
  ColourBlock own = isNear ? light.near.mixing : light.far.mixing, shared = light.far.mixing;
  std::vector<NodeShare> leaves = light.near.leaves;
  std::ranges::move(mixedAs(far, light.far.mixing, own), std::back_inserter(leaves));
  keepSum(sum, sumOf(leaves), groupShares, own, shared);
  const Channels scale = scalesOf(leaves);
  Row row;
  row.leaves = runOf(leaves, scale);
  row.own = scaledColumns(own, scale);
  row.shared = shared;
  return row;
}

class SquarePacker {
 public:
  SquarePacker(const TransportMatrix& transport, float tolerance)
      : transport_(transport),
        tolerance_(tolerance),
        // Nothing may be off: T's own groups are what there is. With several projectors it shares for each,
        // rows here for all together.
        asMeasured_(tolerance == 0.0f && !transport.groups().empty() &&
                    transport.projectors().devices() == 1) {}

  /// The place's camera pixels with leaves that they share; or, where so many nodes fit in no patch, each
  /// alone.
  std::vector<Square> squares(const CameraRectangle& place) const {
    std::array<std::size_t, SharedLight::pixels> pixel;
    pixel.fill(nobody);
    std::array<RowLight, SharedLight::pixels> light;
    const Size size = transport_.cameras().size(place.camera);
    for (int y = place.from.y; y < place.to.y; ++y)
      for (int x = place.from.x; x < place.to.x; ++x) {
        const std::size_t i = SharedLight::placeOf(x - place.from.x, y - place.from.y);
        pixel[i] = transport_.cameras().offset(place.camera) + indexOf(size, {x, y});
        light[i] = asMeasured_ ? transport::rowLightAsShared(transport_, pixel[i])
                               : transport::rowLight(transport_, pixel[i], tolerance_);
        keepBrightest(light[i]);
      }
    if (nodesOf(light) <= mostColumnsOfAPatch) return {shared(pixel, light)};
    std::vector<Square> alone;
    for (std::size_t i = 0; i < pixel.size(); ++i) {
      if (pixel[i] == nobody) continue;
      alone.emplace_back();
      alone.back().rows.push_back(rowOf(pixel[i], light[i], light[i].far.leaves, {}));
    }
    return alone;
  }

 private:
  static constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
  using Pixels = std::array<std::size_t, SharedLight::pixels>;
  using Lights = std::array<RowLight, SharedLight::pixels>;

  static std::size_t nodesOf(const Lights& lights) {
    std::vector<std::uint32_t> nodes;
    for (const RowLight& light : lights)
      for (const LightPart* part : {&light.near, &light.far})
        for (const NodeShare& leaf : part->leaves) nodes.push_back(leaf.node);
    if (nodes.size() <= mostColumnsOfAPatch) return nodes.size();
    std::sort(nodes.begin(), nodes.end());
    return static_cast<std::size_t>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  }

  Row rowOf(std::size_t pixel, const RowLight& light, const std::vector<NodeShare>& own,
            const Channels& farShares) const {
    ColourBlock sum = ColourBlock::Zero();
    const transport::LeafRow leaves = transport_.row(pixel);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) sum += leaves.block(entry);
    Row row = packedRow(light, own, farShares, sum);
    row.packed.pixel = static_cast<std::uint32_t>(pixel);
    return row;
  }

  Square shared(const Pixels& pixel, const Lights& light) const {
    std::vector<std::vector<NodeShare>> far;
    std::vector<Channels> weight;
    for (const RowLight& of : light) {
      far.push_back(of.far.leaves);
      weight.push_back(of.farWeight);
    }
    const SharedLight shared =
        transport::shareLight(transport_.layout(), far, weight, asMeasured_ ? 0.0f : tolerance_);

    Square square;
    std::vector<Channels> sums;  // of each group with its parents
    for (const LightGroup& group : shared.groups) {
      sums.push_back(sumOf(group.leaves));
      if (group.parent != LightGroup::none)
        for (std::size_t c = 0; c < 3; ++c) sums.back()[c] += sums[group.parent][c];
      const float scale = scaleOf(group.leaves);
      auto rowsBefore = [&](std::size_t place) {
        return static_cast<std::uint32_t>(std::count_if(pixel.begin(),
                                                        pixel.begin() + static_cast<std::ptrdiff_t>(place),
                                                        [](std::size_t one) { return one != nobody; }));
      };
      square.groups.push_back({runOf(group.leaves, {scale, scale, scale}),
                               {group.parent, scale, rowsBefore(group.begin), rowsBefore(group.end)}});
    }
    for (std::size_t i = 0; i < pixel.size(); ++i) {
      if (pixel[i] == nobody) continue;
      const std::uint32_t group = shared.groupOf[i];
      square.rows.push_back(
          rowOf(pixel[i], light[i], shared.own[i], group == LightGroup::none ? Channels{} : sums[group]));
      square.rows.back().packed.group = group;
    }
    return square;
  }

  const TransportMatrix& transport_;
  float tolerance_;
  bool asMeasured_;
};

std::vector<CameraRectangle> placesOf(const Rasters& cameras, int side) {
  std::vector<CameraRectangle> places;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    for (int y = 0; y < size.height; y += side)
      for (int x = 0; x < size.width; x += side)
        places.push_back({camera, {x, y}, {std::min(x + side, size.width), std::min(y + side, size.height)}});
  }
  return places;
}

std::vector<std::uint32_t> nodesOf(const std::vector<Square>& squares) {
  std::vector<std::uint32_t> nodes;
  auto add = [&](const Run& run) { nodes.insert(nodes.end(), run.node.begin(), run.node.end()); };
  for (const Square& square : squares) {
    for (const Group& group : square.groups) add(group.leaves);
    for (const Row& row : square.rows) add(row.leaves);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void PackedMixings::set(std::size_t row, const ColourBlock& mixing) {
  scale[row] = mixing.cwiseAbs().maxCoeff() / largestCode;
  if (!(scale[row] > 0.0f)) return;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      code[k][row][c] = static_cast<std::int16_t>(
          std::lround(mixing(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) / scale[row]));
}

ColourBlock PackedMixings::operator[](std::size_t row) const {
  ColourBlock mixing;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      mixing(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) = scale[row] * code[k][row][c];
  return mixing;
}

namespace {

/// A patch on its way: its squares and the nodes that they touch.
struct PatchToPack {
  std::vector<Square> squares;
  std::vector<std::uint32_t> nodes;
};

/// Halves squares until their nodes can be numbered by 16 bits.
void split(std::vector<Square> squares, std::vector<PatchToPack>& done) {
  std::vector<std::uint32_t> nodes = nodesOf(squares);
  if (nodes.size() <= mostColumnsOfAPatch) {
    done.push_back({std::move(squares), std::move(nodes)});
    return;
  }
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::vector<Square> second(std::make_move_iterator(middle), std::make_move_iterator(squares.end()));
  squares.erase(middle, squares.end());
  split(std::move(squares), done);
  split(std::move(second), done);
}

}  // namespace

/// Puts the squares of one patch side by side into slices.
class PackedTransport::PatchAppender {
 public:
  PatchAppender(PackedTransport& to, const PatchToPack& patch) : to_(to), nodes_(patch.nodes) {
    TransportPatch appended;
    appended.squareBegin = end(to_.square_);
    appended.groupBegin = end(to_.group_);
    appended.rowBegin = end(to_.row_);
    appended.columnBegin = end(to_.node_);
    to_.node_.insert(to_.node_.end(), patch.nodes.begin(), patch.nodes.end());
    for (const Square& square : patch.squares) append(square);
    appended.squareEnd = end(to_.square_);
    appended.groupEnd = end(to_.group_);
    appended.rowEnd = end(to_.row_);
    appended.columnEnd = end(to_.node_);
    to_.patches_.push_back(appended);
  }

 private:
  template <typename List>
  static std::uint32_t end(const List& list) {
    return static_cast<std::uint32_t>(list.size());
  }

  void append(const Square& square) {
    PackedSquare packed;
    packed.groupSliceBegin = end(to_.groupSlice_);
    packed.rowSliceBegin = end(to_.rowSlice_);
    appendGroups(square.groups);
    appendRows(square);
    packed.groupSliceEnd = end(to_.groupSlice_);
    packed.rowSliceEnd = end(to_.rowSlice_);
    to_.square_.push_back(packed);
  }

  /// Parents first, since a slice's groups may be no parents of each other.
  void appendGroups(const std::vector<Group>& groups) {
    const std::uint32_t firstGroup = end(to_.group_);
    std::vector<std::size_t> depth;
    for (const Group& group : groups) {
      depth.push_back(group.packed.parent == PackedGroup::none ? 0 : depth[group.packed.parent] + 1);
      PackedGroup packed = group.packed;
      if (packed.parent != PackedGroup::none) packed.parent += firstGroup;
      packed.rowBegin += end(to_.row_);
      packed.rowEnd += end(to_.row_);
      to_.group_.push_back(packed);
    }
    for (std::size_t level = 0;; ++level) {
      std::vector<std::size_t> order;
      for (std::size_t i = 0; i < groups.size(); ++i)
        if (depth[i] == level) order.push_back(i);
      if (order.empty()) return;
      longestFirst(order, groups);
      for (std::size_t first = 0; first < order.size(); first += rowsTogether) {
        const std::span<const std::size_t> lanes = lanesFrom(order, first);
        GroupSlice slice;
        slice.place.fill(GroupSlice::nobody);
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
          const PackedGroup& group = groups[lanes[lane]].packed;
          slice.scale[lane] = group.scale;
          slice.place[lane] = placeOf(lanes[lane]);
          slice.parent[lane] = group.parent == PackedGroup::none ? std::uint8_t{0} : placeOf(group.parent);
          to_.group_[firstGroup + lanes[lane]].slot =
              static_cast<std::uint32_t>(rowsTogether * to_.groupSlice_.size() + lane);
        }
        appendLeaves(lanes, groups, slice);
        to_.groupSlice_.push_back(slice);
      }
    }
  }

  void appendRows(const Square& square) {
    const std::uint32_t firstRow = end(to_.row_);
    const auto firstGroup = static_cast<std::uint32_t>(to_.group_.size() - square.groups.size());
    std::vector<std::size_t> order;
    for (const Row& row : square.rows) {
      order.push_back(order.size());
      PackedRow packed = row.packed;
      if (packed.group != PackedGroup::none) packed.group += firstGroup;
      to_.row_.push_back(packed);
    }
    longestFirst(order, square.rows);
    for (std::size_t first = 0; first < order.size(); first += rowsTogether) {
      const std::span<const std::size_t> lanes = lanesFrom(order, first);
      RowSlice slice;
      slice.pixel.fill(square.rows[lanes[0]].packed.pixel);
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        const Row& row = square.rows[lanes[lane]];
        slice.pixel[lane] = row.packed.pixel;
        slice.own.set(lane, row.own);
        slice.shared.set(lane, row.shared);
        if (row.packed.group != PackedGroup::none) slice.group[lane] = placeOf(row.packed.group);
        to_.row_[firstRow + lanes[lane]].slot =
            static_cast<std::uint32_t>(rowsTogether * to_.rowSlice_.size() + lane);
      }
      appendLeaves(lanes, square.rows, slice);
      to_.rowSlice_.push_back(slice);
    }
  }

  template <typename Owners>
  static void longestFirst(std::vector<std::size_t>& order, const Owners& owners) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return owners[a].leaves.node.size() > owners[b].leaves.node.size();
    });
  }
  static std::span<const std::size_t> lanesFrom(const std::vector<std::size_t>& order, std::size_t first) {
    return std::span(order).subspan(first, std::min(rowsTogether, order.size() - first));
  }
  static std::uint8_t placeOf(std::size_t group) { return static_cast<std::uint8_t>(group + 1); }

  template <typename Owners, typename Slice>
  void appendLeaves(std::span<const std::size_t> lanes, const Owners& owners, Slice& slice) {
    const auto filling = static_cast<std::uint16_t>(nodes_.size());
    slice.leafBegin = end(to_.leaf_);
    slice.length = end(owners[lanes[0]].leaves.node);
    for (std::size_t k = 0; k < slice.length; ++k) {
      LeavesAbreast leaves;
      for (std::size_t lane = 0; lane < rowsTogether; ++lane) {
        leaves.of[lane] = {{}, filling};
        if (lane >= lanes.size()) continue;
        const Run& run = owners[lanes[lane]].leaves;
        if (k < run.node.size()) leaves.of[lane] = {run.code[k], columnOf(run.node[k])};
      }
      to_.leaf_.push_back(leaves);
    }
  }

  std::uint16_t columnOf(std::uint32_t node) const {
    const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    return static_cast<std::uint16_t>(place - nodes_.begin());
  }

  PackedTransport& to_;
  const std::vector<std::uint32_t>& nodes_;  // of the patch
};

namespace {

template <typename Slice>
std::vector<PackedLeaf> leavesAt(const std::vector<LeavesAbreast>& leaves, const std::vector<Slice>& slices,
                                 std::uint32_t slot) {
  const Slice& slice = slices[slot / rowsTogether];
  std::vector<PackedLeaf> found;
  for (std::uint32_t k = 0; k < slice.length; ++k)
    found.push_back(leaves[slice.leafBegin + k].of[slot % rowsTogether]);
  return found;
}

}  // namespace

std::vector<PackedLeaf> PackedTransport::leavesOf(const PackedRow& row) const {
  return leavesAt(leaf_, rowSlice_, row.slot);
}

std::vector<PackedLeaf> PackedTransport::leavesOf(const PackedGroup& group) const {
  return leavesAt(leaf_, groupSlice_, group.slot);
}

ColourBlock PackedTransport::ownMixing(const PackedRow& row) const {
  return rowSlice_[row.slot / rowsTogether].own[row.slot % rowsTogether];
}

ColourBlock PackedTransport::sharedMixing(const PackedRow& row) const {
  return rowSlice_[row.slot / rowsTogether].shared[row.slot % rowsTogether];
}

PackedTransport::PackedTransport(const TransportMatrix& transport, const PackingSettings& settings) {
  require(settings.patchSide > 0, "patches of {} pixels", settings.patchSide);
  require(transport.storedLeaves() <= std::numeric_limits<std::uint32_t>::max(),
          "{} leaves are more than 32-bit indices hold", transport.storedLeaves());
  const SquarePacker packer(transport, settings.tolerance);
  const std::vector<CameraRectangle> places = placesOf(transport.cameras(), settings.patchSide);
  // A few patches at a time: rows on their way take several times the memory of packed ones.
  constexpr std::size_t batch = 16;
  for (std::size_t begin = 0; begin < places.size(); begin += batch) {
    std::vector<std::vector<PatchToPack>> patches(std::min(batch, places.size() - begin));
    parallelFor(0, patches.size(), 1, [&](std::size_t i) {
      const CameraRectangle& place = places[begin + i];
      std::vector<Square> squares;
      for (int y = place.from.y; y < place.to.y; y += squareSide)
        for (int x = place.from.x; x < place.to.x; x += squareSide)
          std::ranges::move(
              packer.squares({place.camera,
                              {x, y},
                              {std::min(x + squareSide, place.to.x), std::min(y + squareSide, place.to.y)}}),
              std::back_inserter(squares));
      split(std::move(squares), patches[i]);
    });
    for (const std::vector<PatchToPack>& ofPlace : patches)
      for (const PatchToPack& patch : ofPlace) PatchAppender(*this, patch);
  }
}

std::size_t PackedTransport::bytes() const {
  return leaf_.size() * sizeof(LeavesAbreast) + rowSlice_.size() * sizeof(RowSlice) +
         groupSlice_.size() * sizeof(GroupSlice) + square_.size() * sizeof(PackedSquare) +
         node_.size() * sizeof(std::uint32_t);
}

std::size_t PackedTransport::mostColumns() const {
  std::size_t most = 0;
  for (const TransportPatch& patch : patches_)
    most = std::max<std::size_t>(most, patch.columnEnd - patch.columnBegin);
  return most;
}

}  // namespace relucent::engine
