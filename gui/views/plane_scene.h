// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRectF>
#include <memory>
#include <optional>

#include "views/colour_map.h"

namespace relucent::gui {

class VtkView;

/// Flat pictures in a VTK scene, one above the other, in the view's pixels: pan and zoom change their
/// corners, so that single precision suffices however large the plane is.
class PlaneScene {
 public:
  explicit PlaneScene(VtkView& view);
  ~PlaneScene();

  /// Adds a layer above the others. Returns its number.
  int addLayer();
  void setPicture(int layer, const QImage& picture);
  const QImage& picture(int layer) const;
  /// Position and clipping of the picture, in logical pixels of the view from top left. `brightness`: 0 to 1.
  /// `smooth`: interpolate between pixels.
  void place(int layer, const QRectF& target, const QRectF& frame, double brightness, bool smooth);
  void setShown(bool shown);
  /// VTK's colour bar; an empty rectangle: none.
  void placeBar(const QRectF& bar, const ColourScale& scale);
  /// Follows the view's size.
  void fill(QSize view);

 private:
  struct Layer;
  struct Parts;
  VtkView& view_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent::gui
