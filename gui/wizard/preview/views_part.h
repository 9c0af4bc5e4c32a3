// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class PreviewPage;

/// How good each camera's view is, what the shown one asks for, and for whom the picture is; hidden where
/// there is one camera.
QWidget* viewsPart(PreviewPage& page);

}  // namespace relucent::gui
