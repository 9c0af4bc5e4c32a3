// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QRectF>
#include <memory>
#include <optional>

#include "views/colour_map.h"

namespace relucent {

class VtkView;

/// Pictures that lie flat in a VTK scene, one over the other, placed in the view's own pixels: what is panned
/// and zoomed are their corners, so that nothing is lost in single floats however large the plane is.
class PlaneScene {
 public:
  explicit PlaneScene(VtkView& view);
  ~PlaneScene();

  /// Another layer over those before it. Gives its number.
  int addLayer();
  void setPicture(int layer, const QImage& picture);
  const QImage& picture(int layer) const;
  /// Where the picture lies and what of that may be seen, in logical pixels of the view from top left.
  /// `brightness`: 0 to 1. `smooth`: between its pixels.
  void place(int layer, const QRectF& target, const QRectF& frame, double brightness, bool smooth);
  void setShown(bool shown);
  /// VTK's colour bar; an empty place: none.
  void placeBar(const QRectF& bar, const ColourScale& scale);
  /// Follows the view's size.
  void fill(QSize view);

 private:
  struct Layer;
  struct Parts;
  VtkView& view_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent
