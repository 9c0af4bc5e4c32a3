// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "relucent/image/image.h"
#include "views/image_view.h"

namespace relucent::gui {

class PlaneScene;
class Relief;

/// A map drawn by VTK: flat, as an ImageView is, or as a landscape to turn. Where there is no OpenGL it is an
/// ImageView.
/// In relief, drag and arrows turn it, wheel, + and - come nearer, double-click or 0 resets.
class MapView : public ImageView {
  Q_OBJECT

 public:
  explicit MapView(QWidget* parent = nullptr);
  ~MapView() override;

  /// The values of the map, used as heights of the relief. None: an empty image.
  /// Contract: one channel, of the picture's size.
  void setValues(image::Image values);
  const image::Image& values() const { return values_; }

  bool canRise() const { return vtk() != nullptr && !values_.empty() && scale().has_value(); }
  bool isRelief() const { return relief_; }
  void setRelief(bool relief);

 protected:
  void arrange() override;
  bool isFlat() const override { return !relief_; }
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::unique_ptr<PlaneScene> plane_;
  std::unique_ptr<Relief> landscape_;
  image::Image values_;
  bool relief_ = false, risen_ = false;
};

}  // namespace relucent::gui
