// SPDX-License-Identifier: MIT
#pragma once

#include <QAction>

#include "theme/icons.h"

namespace relucent::gui {

/// Something that the user can do on a page, which owns it. Its icon is one of the theme, so that each place
/// draws it in the colour that it has there. Where it is not possible, it says why.
class PageCommand : public QAction {
 public:
  PageCommand(Icon glyph, QObject* parent) : QAction(parent), glyph_(glyph) {}

  Icon glyph() const { return glyph_; }
  void setGlyph(Icon glyph) { glyph_ = glyph; }
  /// As things are now.
  void show(const QString& text, bool possible = true) {
    setText(text);
    setEnabled(possible);
    whyNot_.clear();
  }
  /// The same; `whyNot`, a sentence: it is not possible. Empty: it is.
  void showUnless(const QString& whyNot, const QString& text) {
    show(text, whyNot.isEmpty());
    whyNot_ = whyNot;
  }
  /// Why it is not possible, where the page's hint does not say it anyway.
  const QString& whyNot() const { return whyNot_; }

 private:
  Icon glyph_;
  QString whyNot_;
};

}  // namespace relucent::gui
