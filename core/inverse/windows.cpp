// SPDX-License-Identifier: MIT
#include "inverse/windows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "inverse/near_field.h"

namespace relucent {
namespace {

constexpr float largestCode = 32767.0f;
/// A row whose near field spreads over more tiles than this carries no detail for the rest of them.
constexpr std::size_t mostTilesOfARow = 64;
/// Where positive and negative weights of a projector pixel nearly cancel, scaling them to white would blow
/// up noise; such a pixel follows the mean of the rows that see it instead.
constexpr float leastNetWeight = 0.2f;

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
};

using MatrixF = Eigen::MatrixXf;

/// What solving one window needs, kept between windows so that nothing is allocated for each.
struct Scratch {
  std::vector<WindowLeaf> leaves;
  std::vector<Group> groups;
  std::vector<NearField::Value> gram;  // rows x rows, lower triangle
  MatrixF g;
  std::array<MatrixF, 3> columns;  // T_J^T: rows of the window x pixels of the tile
  MatrixF solution;
};

}  // namespace

std::vector<std::string> problems(const WindowSettings& settings) {
  std::vector<std::string> found;
  if (settings.tile != 4 && settings.tile != 8) found.push_back("the side of a tile must be 4 or 8");
  if (settings.rows < 1 || settings.rows > 1024)
    found.push_back("a window must have 1 to 1024 camera pixels");
  if (!(settings.ridge > 0.0 && settings.ridge <= 100.0))
    found.push_back("the ridge must lie above 0 and at most 100");
  return found;
}

/// Makes a WindowInverse in the steps that windows.h lists.
class WindowBuilder {
 public:
  WindowBuilder(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                const WindowSettings& settings)
      : layout_(transport.layout()),
        settings_(settings),
        tileLevel_(std::countr_zero(static_cast<unsigned>(settings.tile))),
        near_(nearFieldOf(transport, usable)) {
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

  /// Lower triangle of G, per colour channel. Two leaves interact where one's node holds the other's:
  ///   sum over pixels of (v_a / n_a) (v_b / n_b) = v_a v_b / max(n_a, n_b),   else 0.
  void gram(std::size_t rows, Scratch& scratch) const {
    scratch.gram.assign(rows * rows, NearField::Value{});
    auto add = [&](const WindowLeaf& a, const WindowLeaf& b, float share) {
      NearField::Value& sum = scratch.gram[std::max(a.local, b.local) * rows + std::min(a.local, b.local)];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += share * a.value[c] * b.value[c];
    };
    int coarsest = 0;
    for (const Group& group : scratch.groups) coarsest = std::max(coarsest, group.place.level);

    for (const Group& group : scratch.groups) {
      for (std::size_t i = group.begin; i < group.end; ++i)
        for (std::size_t k = group.begin; k <= i; ++k)
          add(scratch.leaves[i], scratch.leaves[k], 1.0f / group.pixels);

      int top = std::min(coarsest, layout_.levels(static_cast<std::size_t>(group.place.projector)) - 1);
      for (Node above = group.place; above.level < top;) {
        above = layout_.parent(above);
        auto node = static_cast<std::uint32_t>(layout_.index(above));
        auto found = std::lower_bound(scratch.groups.begin(), scratch.groups.end(), node,
                                      [](const Group& g, std::uint32_t wanted) { return g.node < wanted; });
        if (found == scratch.groups.end() || found->node != node) continue;
        for (std::size_t i = group.begin; i < group.end; ++i) {
          for (std::size_t k = found->begin; k < found->end; ++k) {
            // A pair of leaves of one row stands twice in the square of that row.
            bool same = scratch.leaves[i].local == scratch.leaves[k].local;
            add(scratch.leaves[i], scratch.leaves[k], (same ? 2.0f : 1.0f) / found->pixels);
          }
        }
      }
    }
  }

  /// T_J^T: what every row of the window sees of every pixel of the tile, from leaves of all levels.
  void columns(const Block& tile, std::size_t projector, std::size_t rows, Scratch& scratch) const {
    for (MatrixF& matrix : scratch.columns)
      matrix.setZero(static_cast<Eigen::Index>(rows), settings_.tile * settings_.tile);
    for (const Group& group : scratch.groups) {
      if (static_cast<std::size_t>(group.place.projector) != projector) continue;
      Block block = layout_.block(group.place);
      for (int y = std::max(tile.y0, block.y0); y < std::min(tile.y1, block.y1); ++y)
        for (int x = std::max(tile.x0, block.x0); x < std::min(tile.x1, block.x1); ++x)
          for (std::size_t i = group.begin; i < group.end; ++i)
            for (std::size_t c = 0; c < 3; ++c)
              scratch.columns[c](scratch.leaves[i].local, (y - tile.y0) * settings_.tile + x - tile.x0) +=
                  scratch.leaves[i].value[c] / group.pixels;
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
    gram(rows, scratch);
    columns(block, projector, rows, scratch);

    auto n = static_cast<Eigen::Index>(rows);
    for (std::size_t c = 0; c < 3; ++c) {
      scratch.g.setZero(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k <= i; ++k)
          scratch.g(i, k) = scratch.gram[static_cast<std::size_t>(i * n + k)][c];
      float diagonal = scratch.g.diagonal().mean();
      if (diagonal == 0.0f) continue;  // a colour that these camera pixels do not see at all
      scratch.g.diagonal().array() += static_cast<float>(settings_.ridge) * diagonal;
      Eigen::LLT<Eigen::Ref<MatrixF>> cholesky(scratch.g);
      if (cholesky.info() != Eigen::Success)
        throw Error(ErrorKind::numerics,
                    "the light transport around a tile of projector pixels cannot be inverted",
                    "raise the ridge of the windows or measure the venue again",
                    fmt::format("window {} of {}", tile, result_.tiles_.count()));
      scratch.solution = scratch.columns[c];
      cholesky.solveInPlace(scratch.solution);
      scaleToFlood(first, c, scratch);
      store(tile, c, scratch.solution);
    }
  }

  /// Scales every projector pixel's weights so that the flood image gives 1.
  void scaleToFlood(std::size_t first, std::size_t channel, Scratch& scratch) const {
    for (Eigen::Index pixel = 0; pixel < scratch.solution.cols(); ++pixel) {
      auto weights = scratch.solution.col(pixel);
      auto white = [&] {
        float sum = 0.0f;
        for (Eigen::Index k = 0; k < weights.size(); ++k)
          sum += weights[k] * near_.flood[result_.row_[first + static_cast<std::size_t>(k)]][channel];
        return sum;
      };
      if (white() < leastNetWeight * weights.cwiseAbs().sum())
        weights = scratch.columns[channel].col(pixel).cwiseMax(0.0f);
      float sum = white();
      if (sum > 0.0f)
        weights /= sum;
      else
        weights.setZero();
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
  WindowInverse result_;
};

WindowInverse computeWindows(const TransportMatrix& transport, const std::vector<std::uint8_t>& usable,
                             const WindowSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "window settings: {}", fmt::join(wrong, "; "));
  return WindowBuilder(transport, usable, settings).build(progress);
}

std::size_t WindowInverse::bytes() const {
  return unmix_.size() * sizeof(float) + tileStart_.size() * sizeof(std::size_t) +
         row_.size() * sizeof(std::uint32_t) + weight_.size() * sizeof(std::int16_t) +
         scale_.size() * sizeof(float);
}

Stack WindowInverse::apply(const Stack& cameraResidual) const {
  require(cameraResidual.size() == 3 * cameras_.count(), "{} values for {} camera pixels",
          cameraResidual.size(), cameras_.count());
  Stack unmixed(cameraResidual.size());
  parallelFor(0, cameras_.count(), 1024, [&](std::size_t row) {
    const float* u = &unmix_[9 * row];
    const float* in = &cameraResidual[3 * row];
    for (std::size_t c = 0; c < 3; ++c)
      unmixed[3 * row + c] = u[3 * c] * in[0] + u[3 * c + 1] * in[1] + u[3 * c + 2] * in[2];
  });

  Stack projector(3 * projectors_.count());
  for (std::size_t device = 0; device < projectors_.devices(); ++device) {
    Size size = projectors_.size(device);
    Size grid = tiles_.size(device);
    parallelFor(0, grid.count(), 16, [&](std::size_t local) {
      constexpr std::size_t lanes = 16;  // pixels at once: a constant that compilers turn into vectors
      std::size_t tile = tiles_.offset(device) + local;
      auto pixels = static_cast<std::size_t>(tile_ * tile_);
      Pixel place = pixelAt(grid, local);
      for (std::size_t part = 0; part < pixels; part += lanes) {
        float sum[3][lanes] = {};
        for (std::size_t k = tileStart_[tile]; k < tileStart_[tile + 1]; ++k) {
          const float* in = &unmixed[3 * static_cast<std::size_t>(row_[k])];
          const std::int16_t* code = &weight_[3 * pixels * k + part];
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes; ++i)
              sum[c][i] += in[c] * static_cast<float>(code[c * pixels + i]);
        }
        for (std::size_t i = 0; i < lanes; ++i) {
          int x = place.x * tile_ + static_cast<int>(part + i) % tile_;
          int y = place.y * tile_ + static_cast<int>(part + i) / tile_;
          if (x >= size.width || y >= size.height) continue;
          float* out = &projector[3 * (projectors_.offset(device) + indexOf(size, {x, y}))];
          for (std::size_t c = 0; c < 3; ++c) out[c] = scale_[3 * tile + c] * sum[c][i];
        }
      }
    });
  }
  return projector;
}

}  // namespace relucent
