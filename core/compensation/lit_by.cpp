// SPDX-License-Identifier: MIT
#include "relucent/compensation/lit_by.h"

namespace relucent::compensation {

std::vector<LitBy> litBy(const transport::TransportMatrix& transport, const DirectLeaves& direct,
                         std::size_t row) {
  std::vector<LitBy> lit(transport.projectors().devices());
  const transport::LeafRow leaves = transport.row(row);
  direct.eachDirect(leaves, [&](std::size_t entry, const transport::Block& block) {
    const auto light = static_cast<double>(leaves.block(entry).sum());
    if (!(light > 0.0)) return;
    LitBy& by = lit[static_cast<std::size_t>(transport.layout().node(leaves.column(entry)).projector)];
    by.x += 0.5 * light * (block.x0 + block.x1);
    by.y += 0.5 * light * (block.y0 + block.y1);
    by.light += light;
  });
  for (LitBy& by : lit)
    if (by.light > 0.0) {
      by.x /= by.light;
      by.y /= by.light;
    }
  return lit;
}

}  // namespace relucent::compensation
