// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class PreviewPage;

/// Beside the preview: the content, how bright it is wanted, and what of it can be reached.
QWidget* previewInspector(PreviewPage& page);

}  // namespace relucent::gui
