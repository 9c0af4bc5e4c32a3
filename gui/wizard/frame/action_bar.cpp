// SPDX-License-Identifier: MIT
#include "wizard/frame/action_bar.h"

#include <QEvent>
#include <QGuiApplication>
#include <QStyleHints>
#include <algorithm>
#include <utility>

#include "theme/action_button.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

constexpr int rowHeight = space::actionBar + 4, spacing = 12, leastPrimary = 160;

}  // namespace

ActionBar::ActionBar(Wizard& wizard, QWidget* parent) : QFrame(parent), wizard_(wizard) {
  setRole(this, "bar");
  setFixedHeight(rowHeight);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress of the measurement"));
  all->addWidget(progress_);
  grid_ = new QGridLayout;
  grid_->setContentsMargins(space::page, 0, space::page, 0);
  grid_->setHorizontalSpacing(spacing);
  grid_->setVerticalSpacing(0);
  grid_->setColumnStretch(1, 1);
  back_ = buttonOf(tr("Back"), "flat");
  back_->setObjectName("back");
  reason_ = new QWidget;
  auto* sentence = new QHBoxLayout(reason_);
  sentence->setContentsMargins(0, 0, 0, 0);
  sentence->setSpacing(spacing);
  sentence->addWidget(new IconLabel(Icon::information, secondaryColour, 18));
  sentence->addWidget(hint_ = labelOf({}, "secondary"), 1);
  hint_->setObjectName("hint");
  sentence->addWidget(remedy_ = buttonOf(tr("Show where"), "flat"));
  remedy_->setObjectName("remedy");
  connect(remedy_, &QPushButton::clicked, this, [this] { Q_EMIT wizard_.currentPage().remedyWanted(); });
  hint_->installEventFilter(this);
  secondary_ = new QWidget;
  auto* others = new QHBoxLayout(secondary_);
  others->setContentsMargins(0, 0, 0, 0);
  others->setSpacing(spacing);
  primary_ = buttonOf({}, "primary");
  primary_->setObjectName("primary");
  primary_->setMinimumWidth(leastPrimary);
  grid_->addWidget(back_, 1, 0);
  grid_->addWidget(reason_, 1, 1);
  grid_->addWidget(secondary_, 1, 2);
  grid_->addWidget(primary_, 1, 3);
  all->addLayout(grid_, 1);
  connect(back_, &QPushButton::clicked, &wizard_, &Wizard::back);
  primary_->installEventFilter(this);
  back_->installEventFilter(this);
  connect(primary_, &QPushButton::clicked, this, &ActionBar::runPrimary);
  connect(&wizard_, &Wizard::statusChanged, this, &ActionBar::refresh);
  connect(&wizard_, &Wizard::progressChanged, this, &ActionBar::refresh);
  connect(&wizard_, &Wizard::moved, this, &ActionBar::refresh);
  connect(&Theme::instance(), &Theme::changed, this, &ActionBar::refresh);
  refresh();
}

bool ActionBar::eventFilter(QObject* watched, QEvent* event) {
  if (watched == hint_ && event->type() == QEvent::MouseButtonRelease)
    if (PageModel& page = wizard_.currentPage(); page.hasRemedy()) Q_EMIT page.remedyWanted();
  const bool isPress =
      event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick;
  if (const auto* button = qobject_cast<QPushButton*>(watched); button != nullptr && isPress)
    return isMeantForAnother(*button, *static_cast<QMouseEvent*>(event));
  return QFrame::eventFilter(watched, event);
}

bool ActionBar::isMeantForAnother(const QPushButton& button, const QMouseEvent& press) {
  const auto interval = static_cast<quint64>(QGuiApplication::styleHints()->mouseDoubleClickInterval());
  const QPoint where = press.globalPosition().toPoint();
  const bool isSecond =
      press_ && press.timestamp() - press_->when < interval && press_->where.contains(where);
  const bool isAnother = isSecond && press_->words != button.text();
  if (isAnother)
    press_->when = press.timestamp();  // nor is a third one
  else
    press_ = Press{press.timestamp(), QRect(button.mapToGlobal(QPoint(0, 0)), button.size()), button.text()};
  return isAnother;
}

void ActionBar::keepWidth(QPushButton& button, const PageCommand& command) {
  int& widest = widths_[&command];
  widest = std::max(widest, button.sizeHint().width());
  button.setMinimumWidth(widest);
}

void ActionBar::runPrimary() {
  if (PageCommand* command = wizard_.currentPage().primary()) command->trigger();
}

bool ActionBar::focusPrimary() {
  if (!primary_->isVisible() || !primary_->isEnabled()) return false;
  primary_->setFocus(Qt::OtherFocusReason);
  return true;
}

void ActionBar::refresh() {
  const QWidget* focused = window()->focusWidget();
  const bool hadFocus = focused != nullptr && isAncestorOf(focused);
  const PageModel& page = wizard_.currentPage();
  if (std::exchange(shown_, &page) != &page) {
    widths_.clear();
    primary_->setMinimumWidth(leastPrimary);
  }
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
    primary_->setMinimumWidth(std::max(primary_->minimumWidth(), primary_->sizeHint().width()));
  }
  const QString hint = hintText(page);
  setPossible(primary_, primary != nullptr && primary->isEnabled(), hint);
  back_->setVisible(wizard_.canGoBack());
  back_->setIcon(iconOf(Icon::back, colours().text));
  hint_->setText(hint);
  remedy_->setVisible(page.hasRemedy());
  if (page.hasRemedy())
    hint_->setCursor(Qt::PointingHandCursor);
  else
    hint_->unsetCursor();
  std::optional<double> fraction = page.progress();
  progress_->setValue(static_cast<int>(1000.0 * fraction.value_or(0.0)));
  // The bar keeps its place, so that nothing moves when a measurement begins.
  const QString sheet = fraction ? QString() : QString("QProgressBar { background: transparent; }");
  // The same once more would style it again, several times a second while somebody measures.
  if (progress_->styleSheet() != sheet) progress_->setStyleSheet(sheet);
  refreshSecondary(page.secondary());
  arrange();
  // A command that goes once it is given leaves who gave it by keys where they were.
  focused = window()->focusWidget();
  if (hadFocus && (focused == nullptr || !isAncestorOf(focused) || !focused->isVisible())) focusPrimary();
}

/// What the page says, and why secondary actions are not possible where that is something else.
QString ActionBar::hintText(const PageModel& page) const {
  QStringList lines{page.hint()};
  for (const PageCommand* command : page.secondary())
    if (!command->isEnabled() && !command->whyNot().isEmpty() && !lines.contains(command->whyNot()))
      lines << command->whyNot();
  lines.removeAll(QString());
  return lines.join('\n');
}

void ActionBar::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  arrange();
}

/// In one row where the hint has room beside the buttons.
void ActionBar::arrange() {
  int buttons = 0;
  for (QWidget* widget : {static_cast<QWidget*>(back_), secondary_, static_cast<QWidget*>(primary_)})
    if (!widget->isHidden())
      buttons += spacing + std::max(widget->sizeHint().width(), widget->minimumWidth());
  const int icon = 18 + spacing, remedy = remedy_->isHidden() ? 0 : remedy_->sizeHint().width() + spacing;
  const int whole = width() - 2 * space::page - icon - remedy;
  const int beside = whole - buttons;
  const int free = rowHeight - std::max(progress_->sizeHint().height(), +space::small);
  const bool isOneRow = beside >= hint_->minimumSizeHint().width() && hint_->heightForWidth(beside) <= free;
  grid_->removeWidget(reason_);
  if (isOneRow)
    grid_->addWidget(reason_, 1, 1);
  else
    grid_->addWidget(reason_, 0, 0, 1, 4);
  // Of two rows neither touches what is above or below.
  constexpr int above = 10, below = 14;
  grid_->setContentsMargins(space::page, isOneRow ? 0 : above, space::page, isOneRow ? 0 : below);
  grid_->setVerticalSpacing(isOneRow ? 0 : +space::small);
  const int reason = std::max(hint_->heightForWidth(std::max(1, whole)),
                              remedy_->isHidden() ? 0 : remedy_->sizeHint().height());
  setFixedHeight(isOneRow ? rowHeight : rowHeight + space::small + reason);
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
    button->installEventFilter(this);
    secondary_->layout()->addWidget(button);
    buttons_.push_back(button);
  }
  secondary_->setVisible(!commands.empty());
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    buttons_[i]->setVisible(i < commands.size());
    if (i >= commands.size()) continue;
    const PageCommand& command = *commands[i];
    buttons_[i]->setText(command.text());
    buttons_[i]->setIcon(iconOf(command.glyph(), command.isEnabled() ? colours().text : colours().disabled));
    setPossible(buttons_[i], command.isEnabled(),
                command.whyNot().isEmpty() ? hint_->text() : command.whyNot());
    if (buttons_[i]->shortcut() != command.shortcut()) buttons_[i]->setShortcut(command.shortcut());
    keepWidth(*buttons_[i], command);
  }
}

}  // namespace relucent::gui
