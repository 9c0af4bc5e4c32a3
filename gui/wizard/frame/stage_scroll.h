// SPDX-License-Identifier: MIT
#pragma once

#include <QScrollArea>

namespace relucent::gui {

/// A page's stage, which fills what room there is, and scrolls where that is less than it can be laid out in.
/// (QScrollArea alone would scroll wherever the room is less than the stage likes best.)
QScrollArea* stageScroll(QWidget* stage);

}  // namespace relucent::gui
