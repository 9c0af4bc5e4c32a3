// SPDX-License-Identifier: MIT
#include "inverse/windows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "inverse/near_field.h"
#include "inverse/smooth_prior.h"

namespace relucent {
namespace {

constexpr float largestCode = 32767.0f;
/// A row whose near field spreads over more tiles than this carries no detail for the rest of them.
constexpr std::size_t mostTilesOfARow = 64;
/// Pixels that a window tells apart on either side of its tile: the camera pixels of a window lie within
/// about as many, and what is further off matters by its mean.
constexpr int farthest = 8;
/// Beyond, areas of 8 x 8 pixels or more.
constexpr int beyondLevel = 3;

/// A camera pixel that sees a tile, and how strongly.
struct Candidate {
  std::uint32_t row;
  float strength;
};

/// Tiles' candidates in one array: those of tile t are [start[t], start[t + 1]).
struct Candidates {
  std::vector<std::size_t> start;
  std::vector<Candidate> list;
};

float brightness(const NearField::Value& value) {
  return std::abs(value[0] + value[1] + value[2]);
}

/// A leaf of one row of a window.
struct WindowLeaf {
  std::uint32_t node;
  std::uint32_t local;  // row within the window
  NearField::Value value;
};

/// All leaves of a window that share a node.
struct Group {
  std::uint32_t node;
  Node place;
  float pixels;
  std::size_t begin, end;
  Eigen::Index beyond = -1;  // of the areas beyond all regions, the one that it lies in
};

using MatrixF = Eigen::MatrixXf;

/// The part of a projector whose pixels a window tells apart.
struct Region {
  int projector;
  Block block;
  Size size() const { return {block.x1 - block.x0, block.y1 - block.y0}; }
};

/// What solving one window needs, kept between windows so that nothing is allocated for each.
struct Scratch {
  std::vector<WindowLeaf> leaves;
  std::vector<Group> groups;
  std::vector<Region> regions;
  std::vector<float> beyondSpread;  // of the areas beyond all regions: root of their mean's variance
  MatrixF beyond;                   // T_W over those areas: rows of the window x areas
  MatrixF seen;                     // T_W over a region, then T_W L: rows of the window x pixels
  MatrixF gram;                     // T_W C T_W^T, lower triangle
  MatrixF columns;                  // T_W C_J: rows of the window x pixels of the tile
  MatrixF solution;
  Eigen::VectorXf flood, white;
};

}  // namespace

/// Makes a WindowInverse in the steps that windows.h lists.
class WindowBuilder {
 public:
  WindowBuilder(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                const WindowSettings& settings)
      : layout_(transport.layout()),
        settings_(settings),
        tileLevel_(std::countr_zero(static_cast<unsigned>(settings.tile))),
        near_(nearFieldOf(transport, usable)),
        prior_(settings.smoothness) {
    result_.cameras_ = transport.cameras();
    result_.projectors_ = transport.projectors();
    result_.tile_ = settings.tile;
    std::vector<Size> tiles;
    for (Size size : transport.projectors().sizes())
      tiles.push_back({(size.width + settings.tile - 1) / settings.tile,
                       (size.height + settings.tile - 1) / settings.tile});
    result_.tiles_ = Rasters(tiles);
    for (const ColourBlock& unmix : near_.unmix)
      result_.unmix_.insert(result_.unmix_.end(), unmix.data(), unmix.data() + 9);
  }

  WindowInverse build(Progress& progress) {
    chooseRows(candidates());
    progress.report(0.2);

    std::size_t tiles = result_.tiles_.count();
    result_.weight_.assign(result_.row_.size() * 3 * pixelsOfTile(), 0);
    result_.scale_.assign(3 * tiles, 0.0f);
    constexpr std::size_t batch = 2048;
    for (std::size_t begin = 0; begin < tiles; begin += batch) {
      std::size_t end = std::min(tiles, begin + batch);
      parallelChunks(begin, end, 32, [&](std::size_t, std::size_t first, std::size_t last) {
        Scratch scratch;
        for (std::size_t tile = first; tile < last; ++tile) solve(tile, scratch);
      });
      progress.report(0.2 + 0.8 * static_cast<double>(end) / static_cast<double>(tiles));
    }
    return std::move(result_);
  }

 private:
  std::size_t pixelsOfTile() const { return static_cast<std::size_t>(settings_.tile * settings_.tile); }

  /// Pixels [x0, x1) x [y0, y1) of a tile on its projector.
  Block blockOfTile(std::size_t projector, Pixel tile) const {
    Size size = layout_.projectors().size(projector);
    int side = settings_.tile;
    return {tile.x * side, tile.y * side, std::min((tile.x + 1) * side, size.width),
            std::min((tile.y + 1) * side, size.height)};
  }

  /// How strongly one row's near field reaches each tile, strongest first.
  std::vector<std::pair<std::uint32_t, float>> reach(std::size_t row) const {
    std::vector<std::pair<std::uint32_t, float>> tiles;
    for (std::size_t leaf = near_.start[row]; leaf < near_.start[row + 1]; ++leaf) {
      Node node = layout_.node(near_.node[leaf]);
      const NearField::Value& value = near_.value[leaf];
      float light = value[0] + value[1] + value[2];
      auto projector = static_cast<std::size_t>(node.projector);
      Size grid = result_.tiles_.size(projector);
      int finer = std::max(0, node.level - tileLevel_), coarser = std::max(0, tileLevel_ - node.level);
      light /= static_cast<float>(std::size_t{1} << (2 * finer));
      for (int y = (node.y << finer) >> coarser; y <= (((node.y + 1) << finer) - 1) >> coarser; ++y)
        for (int x = (node.x << finer) >> coarser; x <= (((node.x + 1) << finer) - 1) >> coarser; ++x)
          if (x < grid.width && y < grid.height)
            tiles.emplace_back(
                static_cast<std::uint32_t>(result_.tiles_.offset(projector) + indexOf(grid, {x, y})), light);
    }
    std::sort(tiles.begin(), tiles.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      if (kept > 0 && tiles[kept - 1].first == tiles[i].first)
        tiles[kept - 1].second += tiles[i].second;
      else
        tiles[kept++] = tiles[i];
    }
    tiles.resize(kept);
    std::erase_if(tiles, [](const auto& tile) { return !(tile.second > 0.0f); });
    std::sort(tiles.begin(), tiles.end(), [](const auto& a, const auto& b) {
      return a.second != b.second ? a.second > b.second : a.first < b.first;
    });
    if (tiles.size() > mostTilesOfARow) tiles.resize(mostTilesOfARow);
    return tiles;
  }

  /// The view by columns: for every tile the rows that reach it.
  Candidates candidates() const {
    std::size_t rows = near_.unmix.size();
    std::vector<std::vector<std::pair<std::uint32_t, float>>> reached(rows);
    parallelFor(0, rows, 256, [&](std::size_t row) { reached[row] = reach(row); });

    Candidates result;
    result.start.assign(result_.tiles_.count() + 1, 0);
    for (const auto& tiles : reached)
      for (const auto& tile : tiles) ++result.start[tile.first + 1];
    for (std::size_t tile = 0; tile + 1 < result.start.size(); ++tile)
      result.start[tile + 1] += result.start[tile];
    result.list.resize(result.start.back());
    std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
    for (std::size_t row = 0; row < rows; ++row)
      for (const auto& tile : reached[row])
        result.list[next[tile.first]++] = {static_cast<std::uint32_t>(row), tile.second};
    return result;
  }

  /// Keeps every tile's strongest candidates, in the order of their pixels: neighbours in memory when
  /// applied.
  void chooseRows(Candidates candidates) {
    std::size_t tiles = result_.tiles_.count();
    auto most = static_cast<std::size_t>(settings_.rows);
    result_.tileStart_.assign(tiles + 1, 0);
    for (std::size_t tile = 0; tile < tiles; ++tile)
      result_.tileStart_[tile + 1] =
          result_.tileStart_[tile] + std::min(most, candidates.start[tile + 1] - candidates.start[tile]);
    result_.row_.resize(result_.tileStart_.back());
    parallelFor(0, tiles, 64, [&](std::size_t tile) {
      auto first = candidates.list.begin() + static_cast<std::ptrdiff_t>(candidates.start[tile]);
      auto last = candidates.list.begin() + static_cast<std::ptrdiff_t>(candidates.start[tile + 1]);
      std::size_t count = result_.tileStart_[tile + 1] - result_.tileStart_[tile];
      auto chosen = first + static_cast<std::ptrdiff_t>(count);
      std::nth_element(first, chosen, last, [](const Candidate& a, const Candidate& b) {
        return a.strength != b.strength ? a.strength > b.strength : a.row < b.row;
      });
      std::uint32_t* row = result_.row_.data() + result_.tileStart_[tile];
      for (auto candidate = first; candidate != chosen; ++candidate) *row++ = candidate->row;
      std::sort(row - count, row);
    });
  }

  /// The leaves of all rows of a window, grouped by node.
  void gatherLeaves(std::size_t tile, Scratch& scratch) const {
    scratch.leaves.clear();
    std::size_t first = result_.tileStart_[tile];
    for (std::size_t k = first; k < result_.tileStart_[tile + 1]; ++k) {
      std::size_t row = result_.row_[k];
      for (std::size_t leaf = near_.start[row]; leaf < near_.start[row + 1]; ++leaf)
        scratch.leaves.push_back(
            {near_.node[leaf], static_cast<std::uint32_t>(k - first), near_.value[leaf]});
    }
    std::sort(scratch.leaves.begin(), scratch.leaves.end(), [](const WindowLeaf& a, const WindowLeaf& b) {
      return a.node != b.node ? a.node < b.node : a.local < b.local;
    });
    scratch.groups.clear();
    for (std::size_t i = 0; i < scratch.leaves.size(); ++i) {
      if (i == 0 || scratch.leaves[i].node != scratch.leaves[i - 1].node) {
        Node place = layout_.node(scratch.leaves[i].node);
        scratch.groups.push_back(
            {scratch.leaves[i].node, place, static_cast<float>(layout_.block(place).count()), i, i});
      }
      scratch.groups.back().end = i + 1;
    }
  }

  /// The box round all that the window's camera pixels see of a projector, no further than `farthest` from
  /// the tile, or from the centre of the light on a projector that is not the tile's.
  void chooseRegions(const Block& tile, int projector, Scratch& scratch) const {
    scratch.regions.clear();
    for (int device = 0; device < static_cast<int>(layout_.projectors().devices()); ++device) {
      Block box{INT_MAX, INT_MAX, 0, 0};
      double x = 0.0, y = 0.0, light = 0.0;
      for (const Group& group : scratch.groups) {
        if (group.place.projector != device) continue;
        Block block = layout_.block(group.place);
        box = {std::min(box.x0, block.x0), std::min(box.y0, block.y0), std::max(box.x1, block.x1),
               std::max(box.y1, block.y1)};
        double sum = 0.0;
        for (std::size_t i = group.begin; i < group.end; ++i)
          sum += static_cast<double>(brightness(scratch.leaves[i].value));
        x += sum * 0.5 * (block.x0 + block.x1);
        y += sum * 0.5 * (block.y0 + block.y1);
        light += sum;
      }
      if (!(light > 0.0)) continue;
      Block centre = tile;
      if (device != projector) {
        int left = static_cast<int>(x / light) - settings_.tile / 2;
        int top = static_cast<int>(y / light) - settings_.tile / 2;
        centre = {left, top, left + settings_.tile, top + settings_.tile};
      }
      box = {std::max(box.x0, centre.x0 - farthest), std::max(box.y0, centre.y0 - farthest),
             std::min(box.x1, centre.x1 + farthest), std::min(box.y1, centre.y1 + farthest)};
      if (box.x0 < box.x1 && box.y0 < box.y1) scratch.regions.push_back({device, box});
    }
  }

  /// Gathers what lies beyond all regions in areas of at least beyondLevel's blocks: its detail is of no use
  /// to the tile, but must not pass for the tile's light either.
  void gatherBeyond(Scratch& scratch) const {
    scratch.beyondSpread.clear();
    std::vector<std::pair<std::size_t, Eigen::Index>> areas;
    for (Group& group : scratch.groups) {
      Block block = layout_.block(group.place);
      group.beyond = -1;
      if (std::any_of(scratch.regions.begin(), scratch.regions.end(), [&](const Region& region) {
            return region.projector == group.place.projector && block.x0 < region.block.x1 &&
                   region.block.x0 < block.x1 && block.y0 < region.block.y1 && region.block.y0 < block.y1;
          }))
        continue;
      Node area = group.place;
      int top = layout_.levels(static_cast<std::size_t>(area.projector)) - 1;
      while (area.level < std::min(beyondLevel, top)) area = layout_.parent(area);
      std::size_t key = layout_.index(area);
      auto found = std::find_if(areas.begin(), areas.end(), [&](const auto& a) { return a.first == key; });
      if (found == areas.end()) {
        found = areas.insert(areas.end(), {key, static_cast<Eigen::Index>(areas.size())});
        scratch.beyondSpread.push_back(prior_.spreadOfMean(1 << area.level));
      }
      group.beyond = found->second;
    }
  }

  /// T_W over the areas beyond all regions, times the root of their covariance.
  void expandBeyond(std::size_t rows, std::size_t channel, Scratch& scratch) const {
    scratch.beyond.setZero(static_cast<Eigen::Index>(rows),
                           static_cast<Eigen::Index>(scratch.beyondSpread.size()));
    for (const Group& group : scratch.groups) {
      if (group.beyond < 0) continue;
      float spread = scratch.beyondSpread[static_cast<std::size_t>(group.beyond)];
      for (std::size_t i = group.begin; i < group.end; ++i)
        scratch.beyond(scratch.leaves[i].local, group.beyond) += spread * scratch.leaves[i].value[channel];
    }
  }

  /// T_W over the pixels of a region, one channel, from leaves of all levels.
  void expand(const Region& region, std::size_t rows, std::size_t channel, Scratch& scratch) const {
    Size size = region.size();
    scratch.seen.setZero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(size.count()));
    for (const Group& group : scratch.groups) {
      if (group.place.projector != region.projector) continue;
      Block block = layout_.block(group.place);
      for (int y = std::max(region.block.y0, block.y0); y < std::min(region.block.y1, block.y1); ++y)
        for (int x = std::max(region.block.x0, block.x0); x < std::min(region.block.x1, block.x1); ++x) {
          float* column = scratch.seen.col((y - region.block.y0) * size.width + x - region.block.x0).data();
          for (std::size_t i = group.begin; i < group.end; ++i)
            column[scratch.leaves[i].local] += scratch.leaves[i].value[channel] / group.pixels;
        }
    }
  }

  void solve(std::size_t tile, Scratch& scratch) {
    std::size_t first = result_.tileStart_[tile];
    std::size_t rows = result_.tileStart_[tile + 1] - first;
    if (rows == 0) return;
    std::size_t projector = 0;
    while (projector + 1 < result_.tiles_.devices() && tile >= result_.tiles_.offset(projector + 1))
      ++projector;
    Block block = blockOfTile(
        projector, pixelAt(result_.tiles_.size(projector), tile - result_.tiles_.offset(projector)));
    gatherLeaves(tile, scratch);
    chooseRegions(block, static_cast<int>(projector), scratch);
    gatherBeyond(scratch);

    for (std::size_t c = 0; c < 3; ++c) {
      correlate(block, static_cast<int>(projector), rows, c, scratch);
      float diagonal = scratch.gram.diagonal().mean();
      if (!(diagonal > 0.0f)) continue;  // a colour that these camera pixels do not see at all
      addRidge(first, c, static_cast<float>(settings_.ridge) * diagonal, scratch);
      Eigen::LLT<Eigen::Ref<MatrixF>> cholesky(scratch.gram);
      if (cholesky.info() != Eigen::Success)
        throw Error(ErrorKind::numerics,
                    "the light transport around a tile of projector pixels cannot be inverted",
                    "raise the ridge of the windows or measure the venue again",
                    fmt::format("window {} of {}", tile, result_.tiles_.count()));
      solveChannel(first, c, cholesky, scratch);
      store(tile, c, scratch.solution);
    }
  }

  /// Camera noise is alike in all pixels; unmixing blows it up by |u| of the colour's row of U, most where
  /// the surface is dark. The pixels are trusted accordingly; `ridge` is that of a window of equals.
  void addRidge(std::size_t first, std::size_t channel, float ridge, Scratch& scratch) const {
    Eigen::VectorXf noise(scratch.gram.rows());
    for (Eigen::Index k = 0; k < noise.size(); ++k)
      noise[k] = near_.unmix[result_.row_[first + static_cast<std::size_t>(k)]]
                     .row(static_cast<Eigen::Index>(channel))
                     .squaredNorm();
    scratch.gram.diagonal() += ridge * noise.cwiseInverse().mean() * noise;
  }

  /// T_W C T_W^T and T_W C_J of one channel.
  void correlate(const Block& tile, int projector, std::size_t rows, std::size_t channel,
                 Scratch& scratch) const {
    auto n = static_cast<Eigen::Index>(rows);
    scratch.gram.setZero(n, n);
    expandBeyond(rows, channel, scratch);
    if (scratch.beyond.cols() > 0) scratch.gram.selfadjointView<Eigen::Lower>().rankUpdate(scratch.beyond);
    scratch.columns.setZero(n, settings_.tile * settings_.tile);
    for (const Region& region : scratch.regions) {
      expand(region, rows, channel, scratch);
      prior_.timesRoot(scratch.seen, region.size());
      scratch.gram.selfadjointView<Eigen::Lower>().rankUpdate(scratch.seen);
      if (region.projector != projector) continue;
      prior_.timesRootTransposed(scratch.seen, region.size());
      for (int y = std::max(tile.y0, region.block.y0); y < std::min(tile.y1, region.block.y1); ++y)
        for (int x = std::max(tile.x0, region.block.x0); x < std::min(tile.x1, region.block.x1); ++x)
          scratch.columns.col((y - tile.y0) * settings_.tile + x - tile.x0) =
              scratch.seen.col((y - region.block.y0) * region.size().width + x - region.block.x0);
    }
  }

  /// The weights of one channel: M^T = (G + lambda I)^-1 T C_J, then what it takes to turn the flood image f
  /// white, along the direction that the ridge charges least for:
  ///   m_j <- m_j + (1 - f^T m_j) a / (f^T a),   a = (G + lambda I)^-1 f.
  template <typename Cholesky>
  void solveChannel(std::size_t first, std::size_t channel, const Cholesky& cholesky,
                    Scratch& scratch) const {
    scratch.flood.resize(scratch.columns.rows());
    for (Eigen::Index k = 0; k < scratch.flood.size(); ++k)
      scratch.flood[k] = near_.flood[result_.row_[first + static_cast<std::size_t>(k)]][channel];
    scratch.solution = scratch.columns;
    cholesky.solveInPlace(scratch.solution);
    scratch.white = scratch.flood;
    cholesky.solveInPlace(scratch.white);
    float white = scratch.flood.dot(scratch.white);
    for (Eigen::Index pixel = 0; pixel < scratch.columns.cols(); ++pixel) {
      auto weights = scratch.solution.col(pixel);
      if (white > 0.0f && !scratch.columns.col(pixel).isZero(0.0f))
        weights += (1.0f - scratch.flood.dot(weights)) / white * scratch.white;
      else
        weights.setZero();  // outside the projector, or beyond all that the window sees
    }
  }

  void store(std::size_t tile, std::size_t channel, const MatrixF& weights) {
    float largest = weights.cwiseAbs().maxCoeff();
    if (!(largest > 0.0f)) return;
    result_.scale_[3 * tile + channel] = largest / largestCode;
    for (Eigen::Index k = 0; k < weights.rows(); ++k) {
      std::int16_t* code =
          &result_.weight_[((result_.tileStart_[tile] + static_cast<std::size_t>(k)) * 3 + channel) *
                           pixelsOfTile()];
      for (Eigen::Index pixel = 0; pixel < weights.cols(); ++pixel)
        code[pixel] = static_cast<std::int16_t>(std::lround(weights(k, pixel) / largest * largestCode));
    }
  }

  const NodeLayout& layout_;
  WindowSettings settings_;
  int tileLevel_;
  NearField near_;
  SmoothPrior prior_;
  WindowInverse result_;
};

WindowInverse computeWindows(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                             const WindowSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "window settings: {}", fmt::join(wrong, "; "));
  return WindowBuilder(transport, usable, settings).build(progress);
}

}  // namespace relucent
