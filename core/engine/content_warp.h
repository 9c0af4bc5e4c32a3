// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/compensation/placement.h"
#include "relucent/compensation/views.h"

namespace relucent::engine {

/// The perspective warp of content of one size into the cameras' views as a sparse operator: for every camera
/// pixel a small rectangle of content pixels with weights, the same means as place() takes. 16 bits a weight.
class ContentWarp {
 public:
  /// A camera pixel's rectangle of the content, and the position of its weights, row by row.
  struct Footprint {
    std::int32_t x = 0, y = 0;
    std::uint16_t width = 0, height = 0;  // 0: the content does not reach the pixel
    std::uint32_t weight = 0;
    float scale = 0.0f;  // weight = code * scale; they sum to one
  };

  ContentWarp() = default;
  /// `views`: of the other cameras, whose pixels follow the first one's; there the content lies where
  /// fitTarget() has it. Throws: std::logic_error if `content` is empty or the placement is not convex.
  ContentWarp(Size content, const compensation::Placement& placement, Size view,
              const compensation::ViewMap& views = {});

  Size content() const { return content_; }
  const std::vector<Footprint>& footprints() const { return footprint_; }
  const std::vector<std::uint16_t>& weights() const { return weight_; }
  /// Per camera pixel: its centre lies within the content.
  bool inside(std::size_t pixel) const { return footprint_[pixel].width > 0; }

 private:
  void lieInOtherViews(Size view, const compensation::ViewMap& views);

  Size content_;
  std::vector<Footprint> footprint_;
  std::vector<std::uint16_t> weight_;
};

}  // namespace relucent::engine
