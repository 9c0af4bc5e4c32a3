// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class AcquirePage;

/// Before and after measuring: the surface in full light.
QWidget* floodlightCard(AcquirePage& model);
/// Before and after: what to measure with, whether all is ready, and what was measured.
QWidget* planOf(AcquirePage& model);

}  // namespace relucent::gui
