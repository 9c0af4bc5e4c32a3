// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class CameraPage;

/// The cameras that are there, what each can do and what is wrong with it, to be chosen from.
QWidget* cameraChoice(CameraPage& model);

}  // namespace relucent::gui
