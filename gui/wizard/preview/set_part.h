// SPDX-License-Identifier: MIT
#pragma once

class QWidget;

namespace relucent::gui {

class PreviewPage;

/// The sets of the calibration: which one is in use, and what is done with it. The page must outlive it.
QWidget* setPart(PreviewPage& page);

}  // namespace relucent::gui
