// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class VenuePage;

/// The projectors of a new venue, a row each: its name, its screen, and a button that removes it; below them
/// one that adds another. The row that has the focus is the one that screens are chosen for.
QWidget* projectorList(VenuePage& model);
/// The cameras, which are added from the list on the stage.
QWidget* cameraList(VenuePage& model);

}  // namespace relucent::gui
