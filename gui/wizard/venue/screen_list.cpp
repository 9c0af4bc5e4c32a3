// SPDX-License-Identifier: MIT
#include "wizard/venue/screen_list.h"

#include <QGuiApplication>
#include <QShortcut>
#include <algorithm>

#include "relucent/base/error.h"
#include "theme/action_button.h"
#include "theme/theme.h"
#include "wizard/devices/identify_overlay.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

constexpr QSize largestTile(320, 200);

}  // namespace

std::vector<QSize> drawnToScale(const std::vector<Size>& screens, QSize room, int gap, QSize most) {
  int across = 0, widest = 1, highest = 1;
  for (Size screen : screens) {
    require(screen.width > 0 && screen.height > 0, "a screen of {}x{} pixels", screen.width, screen.height);
    across += screen.width;
    widest = std::max(widest, screen.width);
    highest = std::max(highest, screen.height);
  }
  double free = room.width() - gap * (static_cast<double>(screens.size()) - 1.0);
  double scale =
      std::min({free / std::max(1, across), room.height() / static_cast<double>(highest),
                most.width() / static_cast<double>(widest), most.height() / static_cast<double>(highest)});
  std::vector<QSize> drawn;
  for (Size screen : screens)
    drawn.emplace_back(std::max(1, static_cast<int>(scale * screen.width)),
                       std::max(1, static_cast<int>(scale * screen.height)));
  return drawn;
}

ScreenList::ScreenList(Chosen chosen, Offer offer)
    : tell_(std::move(chosen)), offer_(std::move(offer)), row_(new QHBoxLayout(this)) {
  setObjectName("screens");
  row_->setContentsMargins(0, 0, 0, 0);
  row_->setSpacing(space::gap);
  connect(qApp, &QGuiApplication::screenAdded, this, [this] { fill(); });
  connect(qApp, &QGuiApplication::screenRemoved, this, [this] { fill(); });
  fill();
}

void ScreenList::start(const pipeline::ScreenRigSettings::Display& chosen) {
  chosen_.reset();
  for (const ScreenChoice& choice : offer_())
    if (choice.display == chosen) chosen_ = choice;
  fill();
}

void ScreenList::fill() {
  while (QLayoutItem* item = row_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  tiles_.clear();
  row_->addStretch(1);
  const std::vector<ScreenChoice> choices = offer_();
  for (const ScreenChoice& choice : choices) add(tileOf(choice), choice.size);
  const bool there = std::any_of(choices.begin(), choices.end(), [this](const ScreenChoice& choice) {
    return chosen_ && choice.display == chosen_->display;
  });
  if (chosen_ && !there) {
    auto* gone =
        new Tile(Icon::warning, chosen_->title, VenuePage::tr("Unplugged. Plug it in or choose another."));
    gone->setDashed(true);
    setPossible(gone, VenuePage::tr("Unplugged. Plug it in or choose another."));
    add(gone, chosen_->size);
  }
  row_->addStretch(1);
  draw();
}

void ScreenList::add(Tile* tile, Size screen) {
  row_->addWidget(tile, 0, Qt::AlignVCenter);
  tiles_.emplace_back(tile, screen);
}

void ScreenList::draw() {
  std::erase_if(tiles_, [](const auto& entry) { return entry.first.isNull(); });
  std::vector<Size> screens;
  for (const auto& [tile, screen] : tiles_) screens.push_back(screen);
  std::vector<QSize> drawn = drawnToScale(screens, size(), space::gap, largestTile);
  for (std::size_t i = 0; i < tiles_.size(); ++i) tiles_[i].first->setLargest(drawn[i]);
}

void ScreenList::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  draw();
}

Tile* ScreenList::tileOf(const ScreenChoice& choice) {
  // Why it cannot be chosen is more than what it is.
  auto* tile = new Tile(choice.primary ? Icon::monitor : Icon::projector, choice.title,
                        choice.refusal.isEmpty() ? choice.facts : choice.refusal);
  tile->setObjectName("venue-screen-" + QString::fromStdString(choice.display.connector));
  setPossible(tile, choice.refusal);
  tile->setToolTip(choice.refusal.isEmpty() ? choice.warning : choice.facts);
  tile->setCheckable(true);
  tile->setAutoExclusive(true);
  auto name = [tile, size = choice.size](bool chosen) {
    QString text = chosen ? VenuePage::tr("%1, %2 by %3, chosen") : VenuePage::tr("%1, %2 by %3");
    tile->setAccessibleName(text.arg(tile->text()).arg(size.width).arg(size.height));
  };
  connect(tile, &Tile::toggled, tile, name);
  tile->setChecked(chosen_ && chosen_->display == choice.display);
  name(tile->isChecked());
  connect(tile, &Tile::clicked, this, [this, choice] {
    chosen_ = choice;
    removeAbsent();
    tell_(choice);
  });
  return tile;
}

/// Another was chosen: nobody waits for the one that went.
void ScreenList::removeAbsent() {
  for (Tile* tile : findChildren<Tile*>())
    if (tile->isDashed()) tile->deleteLater();
}

Card* screensCard(QWidget* stage, ScreenList* list) {
  auto* card = new Card(VenuePage::tr("Screens"));
  card->setSubtitle(
      VenuePage::tr("Choose the one that shines on the surface. Its pixels are the projector's."));
  QPushButton* identify = buttonOf(VenuePage::tr("Identify screens"));
  identify->setObjectName("identify");
  identify->setToolTip(VenuePage::tr("I"));
  card->addAction(identify);
  auto* overlay = new IdentifyOverlay(stage);
  QObject::connect(identify, &QPushButton::clicked, overlay, &IdentifyOverlay::show);
  auto* key = new QShortcut(QKeySequence(Qt::Key_I), card);
  key->setContext(Qt::WidgetWithChildrenShortcut);
  QObject::connect(key, &QShortcut::activated, overlay, &IdentifyOverlay::show);
  QObject::connect(new QShortcut(QKeySequence(Qt::Key_Escape), stage), &QShortcut::activated, overlay,
                   &IdentifyOverlay::hide);
  card->body()->addWidget(list);
  return card;
}

}  // namespace relucent::gui
