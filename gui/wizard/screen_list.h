// SPDX-License-Identifier: MIT
#pragma once

#include <QHBoxLayout>
#include <QWidget>
#include <functional>
#include <optional>

#include "theme/controls.h"
#include "wizard/screen_choice.h"

namespace relucent {

class Tile;

/// A button for each screen of the desktop, with its size; follows them as they come and go.
class ScreenList : public QWidget {
 public:
  using Chosen = std::function<void(const ScreenChoice&)>;
  explicit ScreenList(Chosen chosen);

 private:
  void fill();
  Tile* tileOf(const ScreenChoice& choice);
  void dropGone();

  Chosen tell_;
  QHBoxLayout* row_;
  std::optional<ScreenChoice> chosen_;
};

/// The list on a card with the button that shows a number on each screen.
Card* screensCard(QWidget* stage, ScreenList::Chosen chosen);

}  // namespace relucent
