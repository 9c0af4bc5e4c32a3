// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
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
  /// Into one view. Throws: std::logic_error if `content` is empty or the placement is not convex.
  ContentWarp(Size content, const compensation::Placement& placement, Size view)
      : ContentWarp(content, {placement}, Rasters(view), {}) {}
  /// Into several, where fitTarget() has it (Target::placements): in that of the first camera, in others by a
  /// placement of their own or on the surface, by `views` or, if that is empty, nowhere.
  ContentWarp(Size content, const std::vector<std::optional<compensation::Placement>>& placements,
              const Rasters& cameras, const compensation::ViewMap& views);

  Size content() const { return content_; }
  const std::vector<Footprint>& footprints() const { return footprint_; }
  const std::vector<std::uint16_t>& weights() const { return weight_; }
  /// Per camera pixel: its centre lies within the content.
  bool inside(std::size_t pixel) const { return footprint_[pixel].width > 0; }

 private:
  /// Into the view of the camera whose first pixel this is.
  void placeInView(const compensation::Placement& placement, Size view, std::size_t first);
  /// Into other pixels, from `begin` to `end`, of which `covered` of the first view's.
  void lieOnSurface(const compensation::ViewMap& views, Size view, const CameraMask& covered,
                    std::size_t begin, std::size_t end);

  Size content_;
  std::vector<Footprint> footprint_;
  std::vector<std::uint16_t> weight_;
};

}  // namespace relucent::engine
