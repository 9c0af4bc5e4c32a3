// SPDX-License-Identifier: MIT
#include "relucent/importing/rows.h"

#include <algorithm>
#include <numeric>

namespace relucent::importing {

transport::TransportMatrix importedTransport(const std::vector<Footprint>& footprints,
                                             const LargeVector<PixelColour>& colours, Size projector,
                                             Size camera) {
  transport::NodeLayout layout{Rasters(projector)};
  std::size_t root = layout.index({0, layout.levels() - 1, 0, 0});
  std::vector<float> fullScale(colours.size());
  std::vector<std::size_t> blocks(colours.size());
  parallelFor(0, colours.size(), 256, [&](std::size_t row) {
    float strongest = 1.0f;
    blocks[row] = 1;
    if (footprints[row].found()) {
      std::vector<NodeShare> shares = sharesOf(footprints[row], projector);
      strongest = 0.0f;
      for (const NodeShare& share : shares) strongest = std::max(strongest, share.share);
      blocks[row] = shares.size() + 1;
    }
    constexpr float leastScale = 1e-9f;  // of rows that hold nothing
    fullScale[row] = std::max(leastScale, strongest * colours[row].block.cwiseAbs().maxCoeff());
    fullScale[row] = std::max(fullScale[row], colours[row].far.cwiseAbs().maxCoeff());
  });
  std::vector<float> scale(fullScale);
  for (float& value : scale) value /= 32767.0f;
  transport::BlockSparseWriter writer(layout.count(), std::move(fullScale),
                                      std::accumulate(blocks.begin(), blocks.end(), std::size_t{0}));
  for (std::size_t row = 0; row < colours.size(); ++row) {
    const transport::ColourBlock& block = colours[row].block;
    if (!footprints[row].found()) {
      writer.add(root, transport::codeOf(block, scale[row]));
    } else {
      for (const NodeShare& share : sharesOf(footprints[row], projector))
        writer.add(layout.index({0, share.level, share.x, share.y}),
                   transport::codeOf(transport::ColourBlock(share.share * block), scale[row]));
      writer.add(root, transport::codeOf(colours[row].far, scale[row]));
    }
    writer.endRow();
  }
  return transport::TransportMatrix(Rasters(camera), Rasters(projector), writer.build());
}

}  // namespace relucent::importing
