// SPDX-License-Identifier: MIT
#pragma once

#include <QHBoxLayout>
#include <QPointer>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "theme/controls.h"
#include "wizard/devices/screen_choice.h"

namespace relucent::gui {

class Tile;

/// Screens as a person would draw them side by side: to scale with each other, all within the room, none
/// larger than `most`.  Contract: no screen is empty.
std::vector<QSize> drawnToScale(const std::vector<Size>& screens, QSize room, int gap, QSize most);

/// A button for each screen of the desktop in its shape; follows them as they come and go.
class ScreenList : public QWidget {
 public:
  using Chosen = std::function<void(const ScreenChoice&)>;
  /// What is offered, asked for whenever a screen comes or goes.
  using Offer = std::function<std::vector<ScreenChoice>()>;
  explicit ScreenList(Chosen chosen, Offer offer = screenChoices);
  /// Offers again, with that screen chosen if it is there.
  void start(const pipeline::ScreenRigSettings::Display& chosen);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  void add(Tile* tile, Size screen);
  void draw();
  Tile* tileOf(const ScreenChoice& choice);
  void removeAbsent();

  Chosen tell_;
  Offer offer_;
  QHBoxLayout* row_;
  std::vector<std::pair<QPointer<Tile>, Size>> tiles_;
  std::optional<ScreenChoice> chosen_;
};

/// A list on a card with the button that shows a number on each screen.
Card* screensCard(QWidget* stage, ScreenList* list);

}  // namespace relucent::gui
