// SPDX-License-Identifier: MIT
#include "wizard/frame/banner_bar.h"

#include "theme/action_button.h"
#include "theme/theme.h"

namespace relucent::gui {

BannerBar::BannerBar(Wizard& wizard, QWidget* parent) : QWidget(parent), wizard_(wizard) {
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 12);
  frame_ = new QFrame;
  frame_->setObjectName("banner");
  all->addWidget(frame_);
  auto* row = new QHBoxLayout(frame_);
  row->setContentsMargins(16, 12, 12, 12);
  row->setSpacing(12);
  row->addWidget(icon_ = new IconLabel(Icon::information, informationColour), 0, Qt::AlignTop);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  texts->addWidget(sentence_ = labelOf({}, "strong"));
  texts->addWidget(more_ = labelOf({}, "note"));
  sentence_->setObjectName("banner-sentence");
  more_->setObjectName("banner-more");
  row->addLayout(texts, 1);
  // The page has one primary command, in the action bar.
  row->addWidget(button_ = buttonOf({}));
  button_->setObjectName("banner-primary");
  connect(button_, &QPushButton::clicked, this, [this] {
    if (auto banner = wizard_.banner(); banner && banner->command != nullptr) banner->command->trigger();
  });
  connect(&wizard_, &Wizard::statusChanged, this, &BannerBar::refresh);
  connect(&wizard_, &Wizard::moved, this, &BannerBar::refresh);
  connect(&Theme::instance(), &Theme::changed, this, &BannerBar::refresh);
  refresh();
}

void BannerBar::refresh() {
  std::optional<Banner> banner = wizard_.banner();
  setVisible(banner.has_value());
  if (!banner) return;
  bool amber = banner->kind == Banner::Kind::amber;
  if (frame_->property("role").toString() != (amber ? "note-amber" : "note-information"))
    setRole(frame_, amber ? "note-amber" : "note-information");
  icon_->setIcon(amber ? Icon::stale : Icon::information, amber ? amberColour : informationColour);
  sentence_->setText(banner->sentence);
  more_->setText(banner->more);
  button_->setVisible(banner->command != nullptr);
  if (banner->command == nullptr) return;
  button_->setText(banner->command->text());
  button_->setIcon(
      iconOf(banner->command->glyph(), banner->command->isEnabled() ? colours().text : colours().disabled));
  // The action bar says it too.
  const QString& whyNot = banner->command->whyNot();
  setPossible(button_, banner->command->isEnabled(),
              whyNot.isEmpty() ? wizard_.currentPage().hint() : whyNot);
  button_->setToolTip(banner->command->toolTip());
}

}  // namespace relucent::gui
