// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class PreviewPage;

/// The places that are not to be lit: the masks, one to be drawn, and how the chosen one is joined and
/// feathered.
QWidget* maskPart(PreviewPage& page);

}  // namespace relucent::gui
