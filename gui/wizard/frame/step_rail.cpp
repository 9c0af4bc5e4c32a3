// SPDX-License-Identifier: MIT
#include "wizard/frame/step_rail.h"

#include <QKeyEvent>
#include <QPainter>
#include <QVBoxLayout>
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

constexpr double nameLeft = 52.0, nameRight = 12.0, lockRoom = 34.0;
constexpr double badge = 24.0, badgeLeft = 15.0;
constexpr QSize usualStep(208, 50), narrowStep(48, 40);

/// The program's mark: a lens and its light.
class Mark : public QWidget {
 public:
  Mark() { setFixedSize(26, 26); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(colours().accent, 1.8, Qt::SolidLine, Qt::RoundCap));
    painter.drawEllipse(QPointF(8, 13), 5, 5);
    for (auto [from, to] :
         {std::pair(QPointF(16, 13), QPointF(23, 13)), std::pair(QPointF(15, 9), QPointF(21, 5)),
          std::pair(QPointF(15, 17), QPointF(21, 21))})
      painter.drawLine(from, to);
  }
};

QString stateText(const StepStatus& status, bool current, bool locked) {
  if (locked) return StepRail::tr("locked");
  switch (status.state) {
    case StepState::done:
      return StepRail::tr("done");
    case StepState::outOfDate:
      return StepRail::tr("out of date");
    case StepState::coarse:
      return StepRail::tr("stopped early");
    case StepState::doubtful:
      return StepRail::tr("doubtful");
    case StepState::failed:
      return StepRail::tr("failed");
    case StepState::busy:
      return StepRail::tr("under way");
    case StepState::open:
      break;
  }
  return current ? StepRail::tr("current") : StepRail::tr("open");
}

}  // namespace

StepButton::StepButton(int number, QWidget* parent) : QAbstractButton(parent), number_(number) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setFocusPolicy(Qt::StrongFocus);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void StepButton::show(const QString& name, const StepStatus& status, bool current, const QString& whyLocked) {
  const bool locked = !whyLocked.isEmpty();
  setText(name);
  status_ = status;
  current_ = current;
  locked_ = locked;
  QString state = stateText(status, current, locked);
  setAccessibleName(StepRail::tr("Step %1, %2, %3").arg(number_).arg(name, state));
  const QString& said = locked ? whyLocked : status.result;
  setAccessibleDescription(said);
  setEnabled(!locked);
  setToolTip(!narrow_ ? said : said.isEmpty() ? name : QString("%1: %2").arg(name, said));
  update();
}

void StepButton::setNarrow(bool narrow) {
  narrow_ = narrow;
  updateGeometry();
  update();
}

QSize StepButton::sizeHint() const {
  return narrow_ ? narrowStep : usualStep;
}

QSize StepButton::minimumSizeHint() const {
  if (narrow_) return narrowStep;
  double name = QFontMetricsF(typeOf(type::section, QFont::DemiBold)).horizontalAdvance(text());
  return {static_cast<int>(std::ceil(nameLeft + name + (locked_ ? lockRoom : nameRight))),
          sizeHint().height()};
}

/// What is disabled gets no press of its own.
bool StepButton::event(QEvent* event) {
  if (!locked_ || event->type() != QEvent::MouseButtonPress) return QAbstractButton::event(event);
  Q_EMIT lockedPressed();
  return true;
}

void StepButton::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
  QAbstractButton::keyPressEvent(event);
}

void StepButton::paintBadge(QPainter& painter, QRectF circle) const {
  const Colours& c = colours();
  bool coarse = status_.state == StepState::coarse;
  bool held = status_.isHeldUp || status_.state == StepState::doubtful;
  bool stale = status_.state == StepState::outOfDate, failed = status_.state == StepState::failed;
  bool done = status_.state == StepState::done && !locked_;
  QColor colour = stale || coarse || held ? c.amber
                  : failed                ? c.error
                  : current_              ? c.accent
                  : done                  ? c.good
                                          : c.border;
  bool filled = current_;
  painter.setPen(QPen(colour, 1.6));
  painter.setBrush(filled ? QBrush(colour) : Qt::NoBrush);
  painter.drawEllipse(circle);
  QColor inside = filled ? c.onAccent : locked_ ? c.disabled : colour;
  QRectF icon = circle.adjusted(5, 5, -5, -5);
  if (stale && !locked_)
    drawIcon(painter, Icon::stale, icon, inside);
  else if (failed && !locked_)
    drawIcon(painter, Icon::failed, icon, inside);
  else if (held && !locked_)
    drawIcon(painter, Icon::warning, icon, inside);
  else if (coarse && !locked_)
    drawIcon(painter, Icon::pause, icon, inside);
  else if (done && !current_)
    drawIcon(painter, Icon::tick, icon, inside);
  else {
    painter.setFont(typeOf(type::note, QFont::DemiBold));
    painter.setPen(inside);
    painter.drawText(circle, Qt::AlignCenter, QString::number(number_));
  }
}

void StepButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colours& c = colours();
  QRectF box = QRectF(rect()).adjusted(1, 0, -1, 0);
  // In right-to-left languages the rail is mirrored.
  auto place = [this](QRectF area) {
    return isRightToLeft() ? QRectF(width() - area.right(), area.top(), area.width(), area.height()) : area;
  };
  if (current_) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.accentGround);
    painter.drawRoundedRect(box, 6, 6);
    painter.setBrush(c.accent);
    painter.drawRoundedRect(place(QRectF(box.left(), box.top() + 8, 3, box.height() - 16)), 1.5, 1.5);
  }
  if (hasFocus()) {
    painter.setPen(QPen(c.text, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(box.adjusted(1, 1, -1, -1), 6, 6);
  }
  // Mirrored with the rail.
  constexpr int side = Qt::AlignLeft | Qt::AlignVCenter;
  const double left = narrow_ ? (width() - badge) / 2.0 : badgeLeft;
  paintBadge(painter, place(QRectF(left, (height() - badge) / 2.0, badge, badge)));
  if (narrow_) return;
  bool two = !locked_ && !status_.result.isEmpty();
  double textWidth = width() - nameLeft - (locked_ ? lockRoom : nameRight);
  QFont nameFont = typeOf(type::section, QFont::DemiBold);
  painter.setFont(nameFont);
  painter.setPen(locked_ ? c.disabled : c.text);
  double top = two ? 6.0 : 14.0;
  painter.drawText(place(QRectF(nameLeft, top, textWidth, 22)), side,
                   QFontMetrics(nameFont).elidedText(text(), Qt::ElideRight, static_cast<int>(textWidth)));
  if (two) {
    QFont small = typeOf(type::note);
    painter.setFont(small);
    const bool amber = status_.state == StepState::outOfDate || status_.state == StepState::coarse ||
                       status_.state == StepState::doubtful;
    painter.setPen(amber || status_.isHeldUp            ? c.amber
                   : status_.state == StepState::failed ? c.error
                                                        : c.secondary);
    painter.drawText(
        place(QRectF(nameLeft, top + 20, textWidth, 18)), side,
        QFontMetrics(small).elidedText(status_.result, Qt::ElideRight, static_cast<int>(textWidth)));
  }
  if (locked_)
    drawIcon(painter, Icon::lock, place(QRectF(width() - 30.0, height() / 2.0 - 8.0, 16, 16)), c.disabled);
}

StepRail::StepRail(Wizard& wizard, Session& session, QWidget* parent)
    : QWidget(parent), wizard_(wizard), session_(session) {
  setRole(this, "rail");
  setAttribute(Qt::WA_StyledBackground);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 14, 8, 8);
  column->setSpacing(4);
  top_ = new QHBoxLayout;
  top_->setSpacing(10);
  top_->addWidget(new Mark);
  names_ = new QWidget;
  auto* names = new QVBoxLayout(names_);
  names->setContentsMargins(0, 0, 0, 0);
  names->setSpacing(0);
  names->addWidget(labelOf("Relucent", "heading"));
  names->addWidget(venue_ = elidedLabel("note"));
  top_->addWidget(names_, 1);
  column->addLayout(top_);
  scroll_ = new QScrollArea;
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setFrameShape(QFrame::NoFrame);
  auto* inside = new QWidget;
  auto* rows = new QVBoxLayout(inside);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(4);
  scroll_->setWidget(inside);
  column->addWidget(scroll_, 1);
  for (std::size_t i = 0; i < wizard_.count(); ++i) {
    auto* step = new StepButton(static_cast<int>(i) + 1);
    step->setObjectName(QString("step-%1").arg(i + 1));
    connect(step, &StepButton::clicked, this, [this, i] {
      if (i == wizard_.current()) return Q_EMIT currentPressed();
      wizard_.go(i);
    });
    connect(step, &StepButton::lockedPressed, this,
            [this, step] { Q_EMIT lockedPressed(step->accessibleDescription()); });
    steps_.push_back(step);
    rows->addWidget(step);
  }
  rows->addStretch(1);
  column->addLayout(footer_ = new QHBoxLayout);
  setNarrow(false);
  connect(&wizard_, &Wizard::statusChanged, this, &StepRail::refresh);
  connect(&wizard_, &Wizard::progressChanged, this, &StepRail::refresh);
  connect(&wizard_, &Wizard::moved, this, [this] {
    refresh();
    scroll_->ensureWidgetVisible(steps_[wizard_.current()]);
  });
  refresh();
}

void StepRail::setNarrow(bool narrow) {
  names_->setVisible(!narrow);
  top_->setContentsMargins(narrow ? 11 : 18, 0, narrow ? 0 : 8, 12);
  footer_->setDirection(narrow ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
  for (StepButton* step : steps_) step->setNarrow(narrow);
}

void StepRail::refresh() {
  // Of the venue that is open, also while another one is thought of: that has nothing yet.
  venue_->setWhole(session_.isOpen() ? session_.name() : tr("No venue open"));
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::optional<std::size_t> before = wizard_.lockedBy(i);
    const QString why = before ? tr("Opens once %1 is done.").arg(wizard_.page(*before).name()) : QString();
    steps_[i]->show(wizard_.page(i).name(), wizard_.statusOf(i), i == wizard_.current(), why);
  }
}

}  // namespace relucent::gui
