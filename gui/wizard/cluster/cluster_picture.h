// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <cstdint>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::gui {

/// Clusters over the surface in full light: its brightness, the clusters' tints, borders dark. What is in no
/// cluster is dimmed.
/// `map`: per pixel of `surface` a cluster or noCluster; `tints`: per cluster a colour of the palette.
QImage clusterPicture(const std::vector<std::uint32_t>& map, const std::vector<std::uint8_t>& tints,
                      const std::vector<std::uint8_t>& borders, const QImage& surface);

/// The outline of one cluster, to lie over the picture.
QImage clusterOutline(const std::vector<std::uint32_t>& map, Size size, std::uint32_t cluster);

}  // namespace relucent::gui
