// SPDX-License-Identifier: MIT
#include "relucent/engine/packed_transport.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/row_light.h"

namespace relucent::engine {
namespace {

// Of the columns that 16 bits number some are for what fills up runs.
constexpr std::size_t mostColumnsOfAPatch = 65536 - leavesTogether;
constexpr float largestCode = 32767.0f;
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
  PackedRow packed;  // its group: in its square
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
  Eigen::Map<ColourBlock>(row.packed.own.data()) = scaledColumns(own, scale);
  Eigen::Map<ColourBlock>(row.packed.shared.data()) = shared;
  return row;
}

/// A rectangle of camera pixels of at most 8x8.
struct Place {
  std::size_t camera;
  Pixel from, to;
};

class SquarePacker {
 public:
  SquarePacker(const TransportMatrix& transport, float tolerance)
      : transport_(transport),
        tolerance_(tolerance),
        // What T shares is within its own tolerance already. With several projectors it shares for each,
        // rows here for all together.
        asMeasured_(!transport.groups().empty() && transport.projectors().devices() == 1) {}

  /// The place's camera pixels with leaves that they share; or, where so many nodes fit in no patch, each
  /// alone.
  std::vector<Square> squares(const Place& place) const {
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
                               {0, 0, group.parent, scale, rowsBefore(group.begin), rowsBefore(group.end)}});
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

std::vector<Place> placesOf(const Rasters& cameras, int side) {
  std::vector<Place> places;
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

/// A patch on its way: its squares and the nodes that they touch.
struct PackedTransport::Patch {
  std::vector<Square> squares;
  std::vector<std::uint32_t> nodes;
};

namespace {

/// Halves squares until their nodes can be numbered by 16 bits.
template <typename Patch>
void split(std::vector<Square> squares, std::vector<Patch>& done) {
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

PackedTransport::PackedTransport(const TransportMatrix& transport, const PackingSettings& settings) {
  require(settings.patchSide > 0, "patches of {} pixels", settings.patchSide);
  require(transport.storedLeaves() <= std::numeric_limits<std::uint32_t>::max(),
          "{} leaves are more than 32-bit indices hold", transport.storedLeaves());
  const SquarePacker packer(transport, settings.tolerance);
  const std::vector<Place> places = placesOf(transport.cameras(), settings.patchSide);
  // A few patches at a time: rows on their way take several times the memory of packed ones.
  constexpr std::size_t batch = 16;
  for (std::size_t begin = 0; begin < places.size(); begin += batch) {
    std::vector<std::vector<Patch>> patches(std::min(batch, places.size() - begin));
    parallelFor(0, patches.size(), 1, [&](std::size_t i) {
      const Place& place = places[begin + i];
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
    for (const std::vector<Patch>& ofPlace : patches)
      for (const Patch& patch : ofPlace) append(patch);
  }
}

void PackedTransport::append(const Patch& patch) {
  auto end = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  TransportPatch appended;
  appended.squareBegin = end(square_);
  appended.groupBegin = end(group_);
  appended.rowBegin = end(row_);
  appended.columnBegin = end(node_);
  auto addLeaves = [&](const Run& run) {
    for (std::size_t i = 0; i < run.node.size(); ++i) {
      const auto place = std::lower_bound(patch.nodes.begin(), patch.nodes.end(), run.node[i]);
      leaf_.push_back({run.code[i], static_cast<std::uint16_t>(place - patch.nodes.begin())});
    }
    for (std::size_t filling = patch.nodes.size(); leaf_.size() % leavesTogether != 0; ++filling)
      leaf_.push_back({{}, static_cast<std::uint16_t>(filling)});
    return end(leaf_);
  };
  node_.insert(node_.end(), patch.nodes.begin(), patch.nodes.end());
  for (const Square& square : patch.squares) {
    const std::uint32_t firstGroup = end(group_), firstRow = end(row_);
    for (const Group& group : square.groups) {
      PackedGroup packed = group.packed;
      packed.leafBegin = end(leaf_);
      packed.leafEnd = addLeaves(group.leaves);
      if (packed.parent != PackedGroup::none) packed.parent += firstGroup;
      packed.rowBegin += firstRow;
      packed.rowEnd += firstRow;
      group_.push_back(packed);
    }
    for (const Row& row : square.rows) {
      PackedRow packed = row.packed;
      packed.leafBegin = end(leaf_);
      packed.leafEnd = addLeaves(row.leaves);
      if (packed.group != PackedGroup::none) packed.group += firstGroup;
      row_.push_back(packed);
    }
    square_.push_back({firstGroup, end(group_), firstRow, end(row_)});
  }
  appended.squareEnd = end(square_);
  appended.groupEnd = end(group_);
  appended.rowEnd = end(row_);
  appended.columnEnd = end(node_);
  patches_.push_back(appended);
}

std::size_t PackedTransport::bytes() const {
  return leaf_.size() * sizeof(PackedLeaf) + row_.size() * sizeof(PackedRow) +
         group_.size() * sizeof(PackedGroup) + square_.size() * sizeof(PackedSquare) +
         node_.size() * sizeof(std::uint32_t);
}

std::size_t PackedTransport::mostColumns() const {
  std::size_t most = 0;
  for (const TransportPatch& patch : patches_)
    most = std::max<std::size_t>(most, patch.columnEnd - patch.columnBegin);
  return most;
}

}  // namespace relucent::engine
