// SPDX-License-Identifier: MIT
#include "relucent/inverse/prepared_windows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/matrix_size.h"
#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/inverse/window_rows.h"
#include "relucent/inverse/window_system.h"

namespace relucent::inverse {
namespace {

/// Vectors and matrices of one window, kept between windows so that nothing is allocated for each.
struct Scratch {
  WindowSystem system;
  Eigen::MatrixXf weights;  // M_J^T: rows of the window x pixels of the tile
  Eigen::VectorXf flood, white;
};

}  // namespace

/// Fills in the weights of a WindowInverse.
class WindowBuilder {
 public:
  WindowBuilder(const NearField& near, const transport::NodeLayout& layout, double ridge,
                WindowInverse& result)
      : near_(near), layout_(layout), ridge_(static_cast<float>(ridge)), result_(result) {}

  /// All but the weights, see PreparedWindows.
  static WindowInverse without(const transport::TransportMatrix& transport, const NearField& near,
                               const WindowSettings& settings) {
    WindowInverse result;
    result.cameras_ = transport.cameras();
    result.projectors_ = transport.projectors();
    result.tile_ = settings.tile;
    result.tiles_ = WindowInverse::gridOf(transport.projectors(), settings.tile);
    for (const transport::ColourBlock& unmix : near.unmix)
      result.unmix_.insert(result.unmix_.end(), unmix.data(), unmix.data() + 9);
    WindowRows rows = chooseWindowRows(near, transport.layout(), result.tiles_, settings);
    result.tileStart_ = std::move(rows.start);
    result.row_ = std::move(rows.row);
    return result;
  }

  void makeRoom() {
    result_.weight_.assign(result_.row_.size() * 3 * pixelsOfTile(), 0);
    result_.scale_.assign(3 * result_.tiles_.count(), 0.0f);
  }

  /// The weights of a tile whose window is the same in `former`. Returns: whether it is.
  bool takeOver(const WindowInverse& former, const CameraMask& changed, std::size_t tile) {
    const std::span<const std::uint32_t> rows = rowsOf(result_, tile), rowsThen = rowsOf(former, tile);
    if (!std::ranges::equal(rows, rowsThen) ||
        std::ranges::any_of(rows, [&](std::uint32_t row) { return changed[row] != 0; }))
      return false;
    const std::size_t codes = 3 * pixelsOfTile();
    std::copy_n(former.scale_.begin() + static_cast<std::ptrdiff_t>(3 * tile), 3,
                result_.scale_.begin() + static_cast<std::ptrdiff_t>(3 * tile));
    std::copy_n(former.weight_.begin() + static_cast<std::ptrdiff_t>(former.tileStart_[tile] * codes),
                rows.size() * codes,
                result_.weight_.begin() + static_cast<std::ptrdiff_t>(result_.tileStart_[tile] * codes));
    return true;
  }

  void build(std::span<const std::uint32_t> tiles, Progress& progress) {
    constexpr std::size_t batch = 2048;
    for (std::size_t begin = 0; begin < tiles.size(); begin += batch) {
      std::size_t end = std::min(tiles.size(), begin + batch);
      parallelChunks(begin, end, 32, [&](std::size_t, std::size_t first, std::size_t last) {
        Scratch scratch{WindowSystem(near_, layout_), {}, {}, {}};
        for (std::size_t i = first; i < last; ++i) {
          clear(tiles[i]);
          solve(tiles[i], scratch);
        }
      });
      progress.report(static_cast<double>(end) / static_cast<double>(tiles.size()));
    }
  }

 private:
  std::size_t pixelsOfTile() const { return static_cast<std::size_t>(result_.tile_ * result_.tile_); }

  void clear(std::size_t tile) {
    const std::size_t codes = 3 * pixelsOfTile();
    std::fill_n(result_.scale_.begin() + static_cast<std::ptrdiff_t>(3 * tile), 3, 0.0f);
    std::fill(result_.weight_.begin() + static_cast<std::ptrdiff_t>(result_.tileStart_[tile] * codes),
              result_.weight_.begin() + static_cast<std::ptrdiff_t>(result_.tileStart_[tile + 1] * codes),
              std::int16_t{0});
  }

  static std::span<const std::uint32_t> rowsOf(const WindowInverse& windows, std::size_t tile) {
    return {windows.row_.data() + windows.tileStart_[tile],
            windows.tileStart_[tile + 1] - windows.tileStart_[tile]};
  }

  /// Pixels [x0, x1) x [y0, y1) of a tile on its projector.
  transport::Block blockOfTile(std::size_t projector, Pixel tile) const {
    Size size = layout_.projectors().size(projector);
    int side = result_.tile_;
    return {tile.x * side, tile.y * side, std::min((tile.x + 1) * side, size.width),
            std::min((tile.y + 1) * side, size.height)};
  }

  void solve(std::size_t tile, Scratch& scratch) {
    std::span<const std::uint32_t> rows = rowsOf(result_, tile);
    if (rows.empty()) return;
    std::size_t projector = 0;
    while (projector + 1 < result_.tiles_.devices() && tile >= result_.tiles_.offset(projector + 1))
      ++projector;
    Pixel place = pixelAt(result_.tiles_.size(projector), tile - result_.tiles_.offset(projector));
    scratch.system.gather(blockOfTile(projector, place), result_.tile_, static_cast<int>(projector), rows);

    for (std::size_t channel = 0; channel < 3; ++channel) {
      scratch.system.correlate(channel);
      Eigen::MatrixXf& gram = scratch.system.gram();
      float diagonal = gram.diagonal().mean();
      if (!(diagonal > 0.0f)) continue;  // a colour that these camera pixels do not see at all
      gram.diagonal() += noise(rows, channel, ridge_ * diagonal);
      Eigen::LLT<Eigen::Ref<Eigen::MatrixXf>> cholesky(gram);
      if (cholesky.info() != Eigen::Success)
        throw Error(ErrorKind::numerics,
                    RELUCENT_ENGLISH_MESSAGE(
                        "inverse.tile-singular",
                        "the light transport around a tile of projector pixels cannot be inverted"),
                    RELUCENT_ENGLISH_MESSAGE("inverse.raise-ridge-or-remeasure",
                                             "raise the ridge of the windows or measure the venue again"),
                    fmt::format("window {} of {}", tile, result_.tiles_.count()));
      solveChannel(rows, channel, cholesky, scratch);
      store(tile, channel, scratch.weights);
    }
  }

  /// lambda N: camera noise is alike in all pixels; unmixing blows it up by |u| of the colour's row of U,
  /// most where the surface is dark. The pixels are trusted accordingly; `ridge` is that of a window of
  /// equals.
  Eigen::VectorXf noise(std::span<const std::uint32_t> rows, std::size_t channel, float ridge) const {
    Eigen::VectorXf noise(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k)
      noise[static_cast<Eigen::Index>(k)] =
          near_.unmix[rows[k]].row(static_cast<Eigen::Index>(channel)).squaredNorm();
    return ridge * noise.cwiseInverse().mean() * noise;
  }

  /// The weights of one channel: M_J^T = (G + lambda N)^-1 T_J, then what it takes to turn the flood image f
  /// white, along the direction that the ridge charges least for:
  ///   m_j <- m_j + (1 - f^T m_j) a / (f^T a),   a = (G + lambda N)^-1 f.
  template <typename Cholesky>
  void solveChannel(std::span<const std::uint32_t> rows, std::size_t channel, const Cholesky& cholesky,
                    Scratch& scratch) const {
    const Eigen::MatrixXf& columns = scratch.system.columns();
    sizeTo(scratch.flood, columns.rows());
    for (std::size_t k = 0; k < rows.size(); ++k)
      scratch.flood[static_cast<Eigen::Index>(k)] = near_.flood[rows[k]][channel];
    sizeTo(scratch.weights, columns.rows(), columns.cols());
    scratch.weights = columns;
    cholesky.solveInPlace(scratch.weights);
    sizeTo(scratch.white, columns.rows());
    scratch.white = scratch.flood;
    cholesky.solveInPlace(scratch.white);
    float white = scratch.flood.dot(scratch.white);
    for (Eigen::Index pixel = 0; pixel < columns.cols(); ++pixel) {
      auto weights = scratch.weights.col(pixel);
      if (white > 0.0f && !columns.col(pixel).isZero(0.0f))
        weights += (1.0f - scratch.flood.dot(weights)) / white * scratch.white;
      else
        weights.setZero();  // outside the projector, or beyond all that the window sees
    }
  }

  void store(std::size_t tile, std::size_t channel, const Eigen::MatrixXf& weights) {
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

  const NearField& near_;
  const transport::NodeLayout& layout_;
  float ridge_;
  WindowInverse& result_;
};

PreparedWindows::PreparedWindows(const transport::TransportMatrix& transport, const CameraMask& usable,
                                 const WindowSettings& settings, Progress& progress)
    : layout_(transport.layout()) {
  auto wrong = problems(settings);
  require(wrong.empty(), "window settings: {}", fmt::join(wrong, "; "));
  near_ = nearFieldOf(transport, usable);
  progress.report(0.5);
  without_ = WindowBuilder::without(transport, near_, settings);
  progress.report(1.0);
}

WindowInverse PreparedWindows::inverse(double ridge, Progress& progress) const {
  WindowInverse windows = without_;
  WindowBuilder builder(near_, layout_, ridge, windows);
  builder.makeRoom();
  builder.build(allTiles(), progress);
  return windows;
}

WindowInverse PreparedWindows::inverse(double ridge, const WindowInverse& former, const CameraMask& changed,
                                       Progress& progress) const {
  require(former.tiles_ == without_.tiles_ && former.tile_ == without_.tile_ &&
              changed.size() == without_.cameras_.count(),
          "windows of other tiles or camera pixels are renewed");
  WindowInverse windows = without_;
  WindowBuilder builder(near_, layout_, ridge, windows);
  builder.makeRoom();
  std::vector<std::uint32_t> others;
  for (std::uint32_t tile : allTiles())
    if (!builder.takeOver(former, changed, tile)) others.push_back(tile);
  builder.build(others, progress);
  return windows;
}

void PreparedWindows::renew(WindowInverse& windows, double ridge, std::span<const std::uint32_t> tiles,
                            Progress& progress) const {
  require(windows.tiles_ == without_.tiles_ && windows.row_.size() == without_.row_.size(),
          "windows of another light transport are renewed");
  WindowBuilder(near_, layout_, ridge, windows).build(tiles, progress);
}

std::vector<std::uint32_t> PreparedWindows::allTiles() const {
  std::vector<std::uint32_t> tiles(without_.tiles_.count());
  std::iota(tiles.begin(), tiles.end(), 0u);
  return tiles;
}

WindowInverse computeWindows(const transport::TransportMatrix& transport, const CameraMask& usable,
                             const WindowSettings& settings, Progress& progress) {
  Progress preparing = progress.part(0.4, progress.stage());
  PreparedWindows prepared(transport, usable, settings, preparing);
  Progress solving = progress.part(0.6, progress.stage());
  return prepared.inverse(settings.ridge, solving);
}

WindowInverse renewWindows(const WindowInverse& former, const CameraMask& changed,
                           const transport::TransportMatrix& transport, const CameraMask& usable,
                           const WindowSettings& settings, Progress& progress) {
  Progress preparing = progress.part(0.6, progress.stage());
  PreparedWindows prepared(transport, usable, settings, preparing);
  Progress solving = progress.part(0.4, progress.stage());
  return prepared.inverse(settings.ridge, former, changed, solving);
}

}  // namespace relucent::inverse
