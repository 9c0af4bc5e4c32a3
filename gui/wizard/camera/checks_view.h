// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class CameraPage;

/// What was found out of camera and projector before anything is measured, and what helps against it.
QWidget* checksPart(CameraPage& model);

}  // namespace relucent::gui
