// SPDX-License-Identifier: MIT
#pragma once

#include <QComboBox>

#include "wizard/devices/device_page.h"

namespace relucent::gui {

/// "Projector 2": which of several devices a page shows. Hidden where there is only one.
class DeviceSelector : public QComboBox {
  Q_OBJECT

 public:
  enum class Kind { projector, camera };
  /// Within `parent`: shown without one it would be a window.
  DeviceSelector(Kind kind, DevicePage& page, QWidget* parent);

 private:
  void refresh();

  Kind kind_;
  DevicePage& page_;
};

}  // namespace relucent::gui
