// SPDX-License-Identifier: MIT
#pragma once

#include <QFont>
#include <QObject>
#include <QWidget>

#include "theme/tokens.h"

namespace relucent::gui {

/// The look of the program, one for all windows.
class Theme : public QObject {
  Q_OBJECT

 public:
  static Theme& instance();

  Look look() const { return look_; }
  const Colours& colours() const { return gui::colours(look_); }
  /// Style sheet, palette and font of the application. Contract: there is a QApplication.
  void apply(Look look);
  bool isDimmed() const { return dimmed_; }
  /// Shows pictures at half the brightness.
  void setDimmed(bool dimmed);
  double pictureBrightness() const { return dimmed_ ? dimmedPicture : brightestPicture; }

 Q_SIGNALS:
  /// Widgets that paint themselves must repaint.
  void changed();

 private:
  Theme() = default;
  Look look_ = Look::dark;
  bool dimmed_ = false;
};

inline const Colours& colours() {
  return Theme::instance().colours();
}

/// The program's font at a size in pixels; weights 400, 500, 600.
QFont typeOf(int pixels, int weight = QFont::Normal);

/// The style sheet of a theme: the appearance of all widgets, made from the tokens.
QString styleSheetOf(const Colours& colours);

/// Sets the role of a widget in the style sheet: "title", "section", "note", "card", "primary", ...
void setRole(QWidget* widget, const char* role);

}  // namespace relucent::gui
