// SPDX-License-Identifier: MIT
#pragma once

#include <QAction>

#include "theme/icons.h"

namespace relucent::gui {

/// Something that the user can do on a page, which owns it. Its icon is one of the theme, so that each place
/// draws it in the colour that it has there. Where it is not possible, its tool tip says why.
class PageCommand : public QAction {
 public:
  PageCommand(Icon glyph, QObject* parent) : QAction(parent), glyph_(glyph) {}

  Icon glyph() const { return glyph_; }
  void setGlyph(Icon glyph) { glyph_ = glyph; }
  /// As things are now.
  void show(const QString& text, bool possible = true) {
    setText(text);
    setEnabled(possible);
  }

 private:
  Icon glyph_;
};

}  // namespace relucent::gui
