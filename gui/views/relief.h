// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <memory>

#include "image/image.h"
#include "views/colour_map.h"

namespace relucent {

class VtkView;

/// A map as a landscape: its values are heights, its picture lies on it. Dragging turns it, the wheel comes
/// nearer. Where there is no value there is no ground.
class Relief {
 public:
  explicit Relief(VtkView& view);
  ~Relief();

  /// Contract: the map has one channel, and the picture covers it.
  void set(const Image& map, const ColourScale& scale, const QImage& picture);
  /// `beside`: share of the view's width at its right that something else takes.
  void setShown(bool shown, double beside = 0.0);
  /// By degrees.
  void turn(double right, double up);
  void approach(double factor);
  /// As one looks at it first.
  void reset();

 private:
  struct Parts;
  VtkView& view_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent
