// SPDX-License-Identifier: MIT
#include "wizard/frame/banner_bar.h"

#include "theme/theme.h"

namespace relucent::gui {

BannerBar::BannerBar(Wizard& wizard, QWidget* parent) : QWidget(parent), wizard_(wizard) {
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 12);
  frame_ = new QFrame;
  all->addWidget(frame_);
  auto* row = new QHBoxLayout(frame_);
  row->setContentsMargins(16, 12, 12, 12);
  row->setSpacing(12);
  row->addWidget(icon_ = new IconLabel(Icon::information, informationColour), 0, Qt::AlignTop);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  texts->addWidget(sentence_ = labelOf({}, "strong"));
  texts->addWidget(more_ = labelOf({}, "note"));
  row->addLayout(texts, 1);
  row->addWidget(primary_ = buttonOf({}, "primary"));
  primary_->setObjectName("banner-primary");
  connect(primary_, &QPushButton::clicked, this, [this] {
    if (auto banner = wizard_.currentPage().banner(); banner && banner->primary != nullptr)
      banner->primary->trigger();
  });
  connect(&wizard_, &Wizard::statusChanged, this, &BannerBar::refresh);
  connect(&wizard_, &Wizard::moved, this, &BannerBar::refresh);
  connect(&Theme::instance(), &Theme::changed, this, &BannerBar::refresh);
  refresh();
}

void BannerBar::refresh() {
  std::optional<Banner> banner = wizard_.currentPage().banner();
  setVisible(banner.has_value());
  if (!banner) return;
  bool amber = banner->kind == Banner::Kind::amber;
  if (frame_->property("role").toString() != (amber ? "note-amber" : "note-information"))
    setRole(frame_, amber ? "note-amber" : "note-information");
  icon_->setIcon(amber ? Icon::stale : Icon::information, amber ? amberColour : informationColour);
  sentence_->setText(banner->sentence);
  more_->setText(banner->more);
  primary_->setVisible(banner->primary != nullptr);
  if (banner->primary == nullptr) return;
  primary_->setText(banner->primary->text());
  primary_->setIcon(iconOf(banner->primary->glyph(), colours().onAccent));
}

}  // namespace relucent::gui
