// SPDX-License-Identifier: MIT
#include "wizard/frame/action_bar.h"

#include <QEvent>

#include "theme/theme.h"

namespace relucent::gui {

ActionBar::ActionBar(Wizard& wizard, QWidget* parent) : QFrame(parent), wizard_(wizard) {
  setRole(this, "bar");
  setFixedHeight(space::actionBar + 4);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress of the measurement"));
  all->addWidget(progress_);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(space::page, 0, space::page, 0);
  row->setSpacing(12);
  back_ = buttonOf(tr("Back"), "flat");
  back_->setObjectName("back");
  hint_ = labelOf({}, "secondary");
  hint_->setObjectName("hint");
  hint_->installEventFilter(this);
  secondary_ = new QHBoxLayout;
  secondary_->setSpacing(12);
  primary_ = buttonOf({}, "primary");
  primary_->setObjectName("primary");
  primary_->setMinimumWidth(160);
  row->addWidget(back_);
  row->addWidget(new IconLabel(Icon::information, secondaryColour, 18));
  row->addWidget(hint_, 1);
  row->addLayout(secondary_);
  row->addWidget(primary_);
  all->addLayout(row, 1);
  connect(back_, &QPushButton::clicked, &wizard_, &Wizard::back);
  connect(primary_, &QPushButton::clicked, this, &ActionBar::runPrimary);
  connect(&wizard_, &Wizard::statusChanged, this, &ActionBar::refresh);
  connect(&wizard_, &Wizard::progressChanged, this, &ActionBar::refresh);
  connect(&wizard_, &Wizard::moved, this, &ActionBar::refresh);
  connect(&Theme::instance(), &Theme::changed, this, &ActionBar::refresh);
  refresh();
}

QWidget* ActionBar::firstFocus() const {
  return primary_->isEnabled() && !primary_->isHidden() ? primary_ : back_;
}

bool ActionBar::eventFilter(QObject* watched, QEvent* event) {
  if (watched == hint_ && event->type() == QEvent::MouseButtonRelease)
    if (PageModel& page = wizard_.currentPage(); page.hasRemedy()) Q_EMIT page.remedyWanted();
  return QFrame::eventFilter(watched, event);
}

void ActionBar::runPrimary() {
  if (PageCommand* command = wizard_.currentPage().primary()) command->trigger();
}

void ActionBar::refresh() {
  const PageModel& page = wizard_.currentPage();
  const PageCommand* primary = page.primary();
  primary_->setVisible(primary != nullptr);
  if (primary != nullptr) {
    primary_->setText(primary->text());
    primary_->setIcon(
        iconOf(primary->glyph(), primary->isEnabled() ? colours().onAccent : colours().disabled));
    // What leads on has its arrow behind its words.
    Qt::LayoutDirection reading = layoutDirection();
    Qt::LayoutDirection against = reading == Qt::LeftToRight ? Qt::RightToLeft : Qt::LeftToRight;
    primary_->setLayoutDirection(primary->glyph() == Icon::next ? against : reading);
  }
  primary_->setEnabled(primary != nullptr && primary->isEnabled());
  back_->setVisible(wizard_.canGoBack());
  back_->setIcon(iconOf(Icon::back, colours().text));
  hint_->setText(page.hint());
  if (page.hasRemedy())
    hint_->setCursor(Qt::PointingHandCursor);
  else
    hint_->unsetCursor();
  std::optional<double> fraction = page.progress();
  progress_->setValue(static_cast<int>(1000.0 * fraction.value_or(0.0)));
  // The bar keeps its place, so that nothing moves when a measurement begins.
  progress_->setStyleSheet(fraction ? QString() : QString("QProgressBar { background: transparent; }"));
  refreshSecondary(page.secondary());
}

void ActionBar::refreshSecondary(const std::vector<PageCommand*>& commands) {
  commands_.assign(commands.begin(), commands.end());
  while (buttons_.size() < commands.size()) {
    std::size_t index = buttons_.size();
    QPushButton* button = buttonOf({});
    button->setObjectName(QString("secondary-%1").arg(index));
    connect(button, &QPushButton::clicked, this, [this, index] {
      if (index < commands_.size() && commands_[index]) commands_[index]->trigger();
    });
    secondary_->addWidget(button);
    buttons_.push_back(button);
  }
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    buttons_[i]->setVisible(i < commands.size());
    if (i >= commands.size()) continue;
    const PageCommand& command = *commands[i];
    buttons_[i]->setText(command.text());
    buttons_[i]->setIcon(iconOf(command.glyph(), command.isEnabled() ? colours().text : colours().disabled));
    buttons_[i]->setEnabled(command.isEnabled());
    if (buttons_[i]->shortcut() != command.shortcut()) buttons_[i]->setShortcut(command.shortcut());
  }
}

}  // namespace relucent::gui
