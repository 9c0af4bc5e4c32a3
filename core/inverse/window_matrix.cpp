// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "relucent/inverse/windows.h"

namespace relucent::inverse {

/// Blocks of single projector pixels, out of the tiles that hold them.
class WindowBlocks {
 public:
  explicit WindowBlocks(const WindowInverse& inverse) : inverse_(inverse) {}

  /// Calls visit(camera pixel, block) for all of a projector pixel's window.
  template <typename Visit>
  void visitRow(std::size_t device, std::size_t local, const Visit& visit) const {
    int side = inverse_.tile_;
    Pixel place = pixelAt(inverse_.projectors_.size(device), local);
    std::size_t tile = inverse_.tiles_.offset(device) +
                       indexOf(inverse_.tiles_.size(device), {place.x / side, place.y / side});
    auto inTile = static_cast<std::size_t>((place.y % side) * side + place.x % side);
    auto pixels = static_cast<std::size_t>(side * side);
    for (std::size_t k = inverse_.tileStart_[tile]; k < inverse_.tileStart_[tile + 1]; ++k) {
      std::size_t camera = inverse_.row_[k];
      transport::ColourBlock block = Eigen::Map<const transport::ColourBlock>(&inverse_.unmix_[9 * camera]);
      for (std::size_t c = 0; c < 3; ++c)
        block.row(static_cast<Eigen::Index>(c)) *=
            inverse_.scale_[3 * tile + c] *
            static_cast<float>(inverse_.weight_[(3 * k + c) * pixels + inTile]);
      visit(camera, block);
    }
  }

 private:
  const WindowInverse& inverse_;
};

transport::BlockSparse WindowInverse::matrix() const {
  WindowBlocks blocks(*this);
  std::vector<float> fullScale(projectors_.count(), 0.0f);
  std::size_t count = 0;
  auto forEachPixel = [&](const auto& visit) {
    for (std::size_t device = 0; device < projectors_.devices(); ++device)
      for (std::size_t local = 0; local < projectors_.size(device).count(); ++local)
        visit(device, local, projectors_.offset(device) + local);
  };
  forEachPixel([&](std::size_t device, std::size_t local, std::size_t row) {
    blocks.visitRow(device, local, [&](std::size_t, const transport::ColourBlock& block) {
      fullScale[row] = std::max(fullScale[row], block.cwiseAbs().maxCoeff());
      ++count;
    });
  });
  transport::BlockSparseWriter writer(cameras_.count(), fullScale, count);
  forEachPixel([&](std::size_t device, std::size_t local, std::size_t row) {
    blocks.visitRow(device, local, [&](std::size_t camera, const transport::ColourBlock& block) {
      writer.add(camera, transport::codeOf(block, fullScale[row] / 32767.0f));
    });
    writer.endRow();
  });
  return writer.build();
}

}  // namespace relucent::inverse
