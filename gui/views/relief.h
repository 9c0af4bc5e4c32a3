// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <memory>

#include "relucent/image/image.h"
#include "views/colour_map.h"

namespace relucent::gui {

class VtkView;

/// A map as a relief: its values are heights, textured with its picture. Dragging rotates it, the wheel
/// zooms. Pixels without a value are left out.
class Relief {
 public:
  explicit Relief(VtkView& view);
  ~Relief();

  /// Contract: the map has one channel, and the picture covers it.
  void set(const image::Image& map, const ColourScale& scale, const QImage& picture);
  /// `beside`: share of the view's width that is occupied at its right.
  void setShown(bool shown, double beside = 0.0);
  /// Rotates by degrees.
  void turn(double right, double up);
  void approach(double factor);
  /// Resets the viewpoint.
  void reset();

 private:
  struct Parts;
  VtkView& view_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent::gui
