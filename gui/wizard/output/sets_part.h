// SPDX-License-Identifier: MIT
#pragma once

class QWidget;

namespace relucent::gui {

class OutputPage;

/// Which set of the calibration plays, and when the installed show changes them; hidden where there is none.
/// The page must outlive it.
QWidget* setsPart(OutputPage& page);

}  // namespace relucent::gui
