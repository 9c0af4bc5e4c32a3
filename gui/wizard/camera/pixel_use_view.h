// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class CameraPage;

/// Which of the camera's pixels are used, with memory, disk and time beside it; hidden where there is nothing
/// to choose.
QWidget* pixelUseView(CameraPage& model);

}  // namespace relucent::gui
