// SPDX-License-Identifier: MIT
#pragma once

class QWidget;

namespace relucent::gui {

class ThresholdPage;

/// The surface and, in turn, the projector's picture: a pixel that is picked in one is followed through T
/// into the other.
QWidget* deviceCard(ThresholdPage& model);
/// T, following the cut and the pick.
QWidget* matrixCard(ThresholdPage& model);

}  // namespace relucent::gui
