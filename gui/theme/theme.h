// SPDX-License-Identifier: MIT
#pragma once

#include <QFont>
#include <QObject>
#include <QWidget>

#include "theme/tokens.h"

namespace relucent {

/// The look of the program: one at a time for all windows.
class Theme : public QObject {
  Q_OBJECT

 public:
  static Theme& instance();

  Look look() const { return look_; }
  const Colours& colours() const { return relucent::colours(look_); }
  /// Style sheet, palette and font of the application. Contract: there is a QApplication.
  void apply(Look look);
  bool isDimmed() const { return dimmed_; }
  /// Pictures at half the brightness.
  void setDimmed(bool dimmed);
  double pictureBrightness() const { return dimmed_ ? dimmedPicture : brightestPicture; }

 Q_SIGNALS:
  /// Whatever paints by itself paints again.
  void changed();

 private:
  Theme() = default;
  Look look_ = Look::dark;
  bool dimmed_ = false;
};

inline const Colours& colours() {
  return Theme::instance().colours();
}

/// The program's type at a size in pixels; weights 400, 500, 600.
QFont typeOf(int pixels, int weight = QFont::Normal);

/// The style sheet of a theme: everything that widgets look like, made from the tokens.
QString styleSheetOf(const Colours& colours);

/// What a widget is, for the style sheet: "title", "section", "note", "card", "primary", ...
void setRole(QWidget* widget, const char* role);

}  // namespace relucent
