// SPDX-License-Identifier: MIT
#include "theme/controls.h"

#include <QComboBox>

#include <QEvent>
#include <QGuiApplication>
#include <QPainter>
#include <QResizeEvent>
#include <QStyle>
#include <algorithm>

#include "theme/accessible_role.h"
#include "theme/enter_button.h"
#include "theme/theme.h"

namespace relucent::gui {

const QColor& textColour() {
  return colours().text;
}
const QColor& secondaryColour() {
  return colours().secondary;
}
const QColor& goodColour() {
  return colours().good;
}
const QColor& amberColour() {
  return colours().amber;
}
const QColor& errorColour() {
  return colours().error;
}
const QColor& informationColour() {
  return colours().information;
}
const QColor& accentColour() {
  return colours().accent;
}

IconLabel::IconLabel(Icon icon, Role colour, int side, QWidget* parent)
    : QWidget(parent), icon_(icon), colour_(colour) {
  setFixedSize(side, side);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void IconLabel::setIcon(Icon icon, Role colour) {
  icon_ = icon;
  colour_ = colour;
  update();
}

void IconLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  drawIcon(painter, icon_, rect(), colour_());
}

QString plainToolTip(const QString& text) {
  return Qt::mightBeRichText(text) ? text.toHtmlEscaped().prepend("<span>").append("</span>") : text;
}

namespace {

/// Where reading begins, in whatever letters: a name in another script would stand at the other side.
void alignAsRead(QLabel* label) {
  const Qt::AlignmentFlag side = QGuiApplication::isRightToLeft() ? Qt::AlignRight : Qt::AlignLeft;
  label->setAlignment(side | Qt::AlignAbsolute | Qt::AlignVCenter);
}

}  // namespace

QLabel* labelOf(const QString& text, const char* role, QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setTextFormat(Qt::PlainText);
  alignAsRead(label);
  label->setText(text);
  label->setWordWrap(true);
  setRole(label, role);
  return label;
}

QFrame* lineOf() {
  auto* line = new QFrame;
  setRole(line, "line");
  return line;
}

ElidedLabel::ElidedLabel(QWidget* parent) : QLabel(parent) {
  setTextFormat(Qt::PlainText);
  alignAsRead(this);
}

void ElidedLabel::setWhole(const QString& text) {
  whole_ = text;
  setToolTip(plainToolTip(text));
  setAccessibleName(text);
  elide();
}

void ElidedLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  elide();
}

void ElidedLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) elide();
}

void ElidedLabel::elide() {
  const QString shown = fontMetrics().elidedText(whole_, Qt::ElideRight, contentsRect().width());
  setText(shown != whole_ && shown.size() <= leastLetters_ ? QString() : shown);
}

ElidedLabel* elidedLabel(const char* role) {
  auto* label = new ElidedLabel;
  setRole(label, role);
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  return label;
}

Card::Card(const QString& title, QWidget* parent) : QFrame(parent) {
  setRole(this, "card");
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(space::card, 12, space::card, space::card);
  all->setSpacing(space::small);
  if (!title.isEmpty()) {
    header_ = new QHBoxLayout;
    header_->setSpacing(space::small);
    title_ = labelOf(title, "section");
    title_->setWordWrap(false);
    header_->addWidget(title_);
    header_->addWidget(subtitle_ = elidedLabel("note"), 1);
    constexpr int leastLetters = 9;
    subtitle_->setLeastLetters(leastLetters);
    all->addLayout(header_);
  }
  body_ = new QVBoxLayout;
  body_->setSpacing(space::small);
  all->addLayout(body_, 1);
}

void Card::setSubtitle(const QString& text) {
  subtitle_->setWhole(text);
}

void Card::addAction(QWidget* action) {
  header_->addWidget(action);
}

ValueRow::ValueRow(const QString& name, QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 2, 0, 2);
  row->addWidget(labelOf(name, "secondary"), 1);
  value_ = labelOf({}, "strong");
  value_->setWordWrap(false);
  value_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  row->addWidget(value_);
}

void ValueRow::setValue(const QString& value, const char* role) {
  value_->setText(value);
  setRole(value_, role);
}

Remark::Remark(QWidget* parent)
    : QWidget(parent),
      icon_(new IconLabel(Icon::information, secondaryColour)),
      sentence_(labelOf({}, "strong")),
      meaning_(labelOf({}, "note")) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 2, 0, 2);
  row->setSpacing(space::small);
  row->addWidget(icon_, 0, Qt::AlignTop);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(0);
  texts->addWidget(sentence_);
  texts->addWidget(meaning_);
  texts->addStretch(1);
  row->addLayout(texts, 1);
}

void Remark::resizeEvent(QResizeEvent* event) {
  if (event->size().width() != event->oldSize().width()) setMinimumHeight(0);
  QWidget::resizeEvent(event);
}

void Remark::show(Kind kind, const QString& sentence, const QString& meaning) {
  // Not by its height, which is anything before it is laid out.
  if (keepsRoom_ && isVisible()) setMinimumHeight(std::max(minimumHeight(), heightForWidth(width())));
  switch (kind) {
    case Kind::good:
      icon_->setIcon(Icon::tick, goodColour);
      break;
    case Kind::watch:
      icon_->setIcon(Icon::clock, informationColour);
      break;
    case Kind::warning:
      icon_->setIcon(Icon::warning, amberColour);
      break;
    case Kind::failed:
      icon_->setIcon(Icon::failed, errorColour);
      break;
  }
  sentence_->setText(sentence);
  meaning_->setText(meaning);
  meaning_->setVisible(!meaning.isEmpty());
}

Note::Note(Kind kind, QWidget* parent)
    : QFrame(parent), sentence_(labelOf({}, "strong")), more_(labelOf({}, "")) {
  static constexpr const char* roles[] = {"note-information", "note-amber", "note-error"};
  setRole(this, roles[static_cast<int>(kind)]);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 10, 12, 10);
  row->setSpacing(12);
  row->addWidget(new IconLabel(kind == Kind::information ? Icon::information
                               : kind == Kind::amber     ? Icon::warning
                                                         : Icon::failed,
                               kind == Kind::information ? informationColour
                               : kind == Kind::amber     ? amberColour
                                                         : errorColour),
                 0, Qt::AlignTop);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  texts->addWidget(sentence_);
  texts->addWidget(more_);
  row->addLayout(texts, 1);
}

void Note::setText(const QString& sentence, const QString& more) {
  sentence_->setText(sentence);
  more_->setText(more);
  more_->setVisible(!more.isEmpty());
}

Segmented::Segmented(const QStringList& texts, QWidget* parent) : QWidget(parent) {
  setAccessibleRole(this, QAccessible::Grouping);
  for (qsizetype i = 0; i < texts.size(); ++i) {
    QPushButton* button = buttonOf(texts[i], "segment", this);
    button->setCheckable(true);
    group_.addButton(button, static_cast<int>(i));
  }
  group_.button(0)->setChecked(true);
  connect(&group_, &QButtonGroup::idClicked, this, &Segmented::chosen);
}

QList<QAbstractButton*> Segmented::offered() const {
  QList<QAbstractButton*> buttons;
  for (QAbstractButton* button : group_.buttons())
    if (!withheld_.contains(group_.id(button))) buttons.append(button);
  return buttons;
}

void Segmented::setOffered(int index, bool offered) {
  if (group_.button(index) == nullptr || withheld_.contains(index) != offered) return;
  if (offered)
    withheld_.remove(index);
  else
    withheld_.insert(index);
  updateGeometry();
  arrange();
}

void Segmented::foldIntoList(const QString& name) {
  list_ = new QComboBox(this);
  list_->setAccessibleName(name);
  list_->hide();
  connect(list_, &QComboBox::activated, this,
          [this](int row) { group_.button(list_->itemData(row).toInt())->click(); });
  connect(&group_, &QButtonGroup::idToggled, this, &Segmented::fillList);
  updateGeometry();
  arrange();
}

void Segmented::fillList() {
  if (list_ == nullptr) return;
  list_->clear();
  for (QAbstractButton* button : offered()) list_->addItem(button->text(), group_.id(button));
  list_->setCurrentIndex(list_->findData(current()));
}

QSize Segmented::sizeHint() const {
  QSize all(-space::tight, 0);
  for (const QAbstractButton* button : offered()) {
    QSize one = button->sizeHint();
    all = {all.width() + space::tight + one.width(), std::max(all.height(), one.height())};
  }
  return all;
}

QSize Segmented::minimumSizeHint() const {
  QSize least = list_ != nullptr ? list_->minimumSizeHint() : QSize();
  for (const QAbstractButton* button : offered()) least = least.expandedTo(button->sizeHint());
  return least;
}

int Segmented::heightForWidth(int width) const {
  int one = sizeHint().height(), count = static_cast<int>(offered().size());
  if (width >= sizeHint().width()) return one;
  return list_ != nullptr ? list_->sizeHint().height() : count * one + (count - 1) * space::tight;
}

/// By hand: of a widget with a layout, layouts ask that one how high it is.
void Segmented::resizeEvent(QResizeEvent*) {
  arrange();
}

void Segmented::arrange() {
  const QList<QAbstractButton*> buttons = offered();
  const auto count = static_cast<int>(buttons.size());
  const QSize row = sizeHint();
  bool inARow = width() >= row.width();
  const bool isList = list_ != nullptr && !inARow;
  for (QAbstractButton* button : group_.buttons()) button->setVisible(!isList && buttons.contains(button));
  if (list_ != nullptr) list_->setVisible(isList);
  if (isList) {
    fillList();
    // At the end, where the row ends too.
    const QSize size = list_->sizeHint().boundedTo({width(), QWIDGETSIZE_MAX});
    const QRect place(QPoint(width() - size.width(), (height() - size.height()) / 2), size);
    return list_->setGeometry(QStyle::visualRect(layoutDirection(), rect(), place));
  }
  int spare = width() - row.width(), left = 0, top = (height() - heightForWidth(width())) / 2;
  for (int i = 0; i < count; ++i) {
    int wide = buttons[i]->sizeHint().width() + (i + 1) * spare / count - i * spare / count;
    QRect place(left, top, inARow ? wide : width(), row.height());
    buttons[i]->setGeometry(QStyle::visualRect(layoutDirection(), rect(), place));
    if (inARow)
      left += wide + space::tight;
    else
      top += row.height() + space::tight;
  }
}

void Segmented::setCurrent(int index) {
  if (QAbstractButton* button = group_.button(index)) button->setChecked(true);
}

Choice::Choice(const QString& name, const QString& sentence, QWidget* parent) : QPushButton(parent) {
  setRole(this, "choice");
  setCheckable(true);
  setAccessibleName(name);
  setAccessibleDescription(sentence);
  setMinimumHeight(52);
  // Buttons are no higher than one line; this one is as high as its sentence is long.
  setSizePolicy(QSizePolicy::Minimum, QSizePolicy::Minimum);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 6, 12, 6);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(0);
  texts->addWidget(labelOf(name, "strong"));
  sentence_ = labelOf(sentence, "note");
  texts->addWidget(sentence_);
  row->addLayout(texts, 1);
  remark_ = labelOf({}, "secondary");
  remark_->setWordWrap(false);
  remark_->setAlignment(Qt::AlignTrailing | Qt::AlignVCenter);
  row->addWidget(remark_);
  for (QLabel* label : findChildren<QLabel*>()) label->setAttribute(Qt::WA_TransparentForMouseEvents);
}

void Choice::setSentence(const QString& text) {
  sentence_->setText(text);
  setAccessibleDescription(text);
}

void Choice::setRemark(const QString& text) {
  remark_->setText(text);
}

QToolButton* toolOf(Icon icon, const QString& name, QWidget* parent) {
  auto* button = new QToolButton(parent);
  auto paint = [button, icon] { button->setIcon(iconOf(icon, colours().text)); };
  QObject::connect(&Theme::instance(), &Theme::changed, button, paint);
  paint();
  button->setAccessibleName(name);
  button->setToolTip(name);
  return button;
}

QPushButton* buttonOf(const QString& text, const char* role, QWidget* parent) {
  auto* button = new EnterButton(text, parent);
  setRole(button, role);
  button->setIconSize({18, 18});
  button->setAutoDefault(false);
  return button;
}

}  // namespace relucent::gui
