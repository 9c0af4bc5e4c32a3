// SPDX-License-Identifier: MIT
#include "wizard/devices/nudge_dialog.h"

#include <QPainter>
#include <QPointer>
#include <cmath>

#include "relucent/pipeline/pictures.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

constexpr double leastTilt = 0.005;  // degrees that are written as more than none
// Of each direction: both together are then near enough.
constexpr double fits = NudgeSight::nearEnough / 1.4142;

/// From the middle of the view to where the camera has to be turned; as long as the way, but to be seen.
/// Finer than the photograph where that has few pixels, so that an arrow stays an arrow.
QImage arrowTo(QSize view, double x, double y) {
  constexpr int leastSide = 480;
  const int fine = std::max(1, leastSide / std::max(1, std::min(view.width(), view.height())));
  const QSize size = fine * view;
  QImage overlay(size, QImage::Format_ARGB32_Premultiplied);
  overlay.fill(Qt::transparent);
  const double way = std::hypot(x, y), side = std::min(size.width(), size.height());
  if (way < NudgeSight::nearEnough) return overlay;
  const double length = std::clamp(fine * way, 0.15 * side, 0.4 * side), head = 0.05 * side;
  const QPointF from(0.5 * size.width(), 0.5 * size.height()), along(x / way, y / way),
      across(-along.y(), along.x()), tip = from + length * along;
  QPainter painter(&overlay);
  painter.setRenderHint(QPainter::Antialiasing);
  for (auto [colour, width] : {std::pair(colours(Look::dark).picture, 0.03 * side),
                               std::pair(colours(Look::dark).accent, 0.015 * side)}) {
    painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawLine(from, tip);
    painter.drawLine(tip, tip - head * along + head * across);
    painter.drawLine(tip, tip - head * along - head * across);
  }
  return overlay;
}

QString wayText(double pixels, const QString& forwards, const QString& backwards) {
  if (std::abs(pixels) < fits) return NudgeDialog::tr("fits");
  return (pixels > 0.0 ? forwards : backwards).arg(decimalText(std::abs(pixels), 1));
}

QString tiltText(double degrees) {
  const QString much = decimalText(std::abs(degrees), 2);
  if (std::abs(degrees) < leastTilt) return NudgeDialog::tr("%1°").arg(much);
  return (degrees > 0.0 ? NudgeDialog::tr("%1° clockwise") : NudgeDialog::tr("%1° anticlockwise")).arg(much);
}

QString adviceOn(const sentinels::Movement& moved) {
  const bool across = std::abs(moved.x) >= fits, along = std::abs(moved.y) >= fits;
  if (across && along) {
    if (moved.x > 0.0)
      return moved.y > 0.0 ? NudgeDialog::tr("Turn the camera to the right and down.")
                           : NudgeDialog::tr("Turn the camera to the right and up.");
    return moved.y > 0.0 ? NudgeDialog::tr("Turn the camera to the left and down.")
                         : NudgeDialog::tr("Turn the camera to the left and up.");
  }
  if (across)
    return moved.x > 0.0 ? NudgeDialog::tr("Turn the camera to the right.")
                         : NudgeDialog::tr("Turn the camera to the left.");
  if (along)
    return moved.y > 0.0 ? NudgeDialog::tr("Turn the camera down.") : NudgeDialog::tr("Turn the camera up.");
  return moved.degrees > 0.0 ? NudgeDialog::tr("Tilt the camera clockwise.")
                             : NudgeDialog::tr("Tilt the camera anticlockwise.");
}

}  // namespace

NudgeDialog::NudgeDialog(Nudge& nudge, QWidget* parent) : QDialog(parent), nudge_(nudge) {
  setObjectName("nudge");
  setWindowTitle(tr("Put the camera back"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(24, 24, 24, 24);
  row->setSpacing(24);
  view_ = new ImageView;
  view_->setObjectName("nudge-view");
  view_->setAccessibleName(tr("What the camera saw, and what it sees now"));
  view_->setMinimumSize(480, 360);
  row->addWidget(view_, 1);
  auto* side = new QWidget;
  side->setFixedWidth(300);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(labelOf(windowTitle(), "title"));
  column->addWidget(labelOf(tr("The projector shows full light. Left of the line stands what the camera saw "
                               "when the venue was measured, right of it what it sees now."),
                            "note"));
  if (nudge_.isRehearsal())
    column->addWidget(labelOf(tr("In a rehearsal it comes back by itself while you look."), "note"));
  column->addWidget(lineOf());
  column->addWidget(across_ = new ValueRow(tr("Sideways")));
  column->addWidget(along_ = new ValueRow(tr("Up and down")));
  column->addWidget(turned_ = new ValueRow(tr("Tilt")));
  column->addWidget(lineOf());
  column->addWidget(verdict_ = new Remark);
  verdict_->setObjectName("nudge-verdict");
  column->addStretch(1);
  QPushButton* close = buttonOf(tr("Close"), "primary");
  close->setObjectName("nudge-close");
  close->setDefault(true);
  connect(close, &QPushButton::clicked, this, &NudgeDialog::reject);
  column->addWidget(close);
  row->addWidget(side);
  close->setFocus();
  resize(960, 560);
  connect(&nudge_, &Nudge::changed, this, &NudgeDialog::refresh);
  connect(&nudge_, &Nudge::ended, this, [this] {
    if (closing_) QDialog::reject();
  });
  refresh();
}

void NudgeDialog::reject() {
  closing_ = true;
  nudge_.stop();
}

void NudgeDialog::refresh() {
  showPictures();
  showVerdict();
}

void NudgeDialog::showPictures() {
  if (!nudge_.sight()) {
    view_->setPicture({});
    view_->setOverlay({});
    const std::optional<Banner> waiting = nudge_.waiting();
    view_->setEmptyText(nudge_.failure()           ? nudge_.failure()->what
                        : waiting                  ? waiting->sentence
                        : nudge_.stage().isEmpty() ? tr("Opening the devices")
                                                   : nudge_.stage());
    return;
  }
  const image::Image &then = nudge_.expected(), &now = nudge_.sight()->seen;
  const pipeline::AimOffset& offset = nudge_.sight()->offset;
  // Both as bright, so that only what has moved differs.
  const float white = pipeline::displayWhite(then), gain = static_cast<float>(offset.gain);
  view_->setPicture(pictureOf(then, white));
  view_->setCompared(pictureOf(now, gain > 0.0f ? gain * white : pipeline::displayWhite(now)), tr("Measured"),
                     tr("Now"));
  view_->setOverlay(offset.isRecognised
                        ? arrowTo(QSize(now.width(), now.height()), offset.movement.x, offset.movement.y)
                        : QImage());
}

void NudgeDialog::showVerdict() {
  const std::optional<NudgeSight>& sight = nudge_.sight();
  const bool isKnown = sight && sight->offset.isRecognised;
  const sentinels::Movement moved = isKnown ? sight->offset.movement : sentinels::Movement{};
  const QString nothing = QString::fromUtf8("–");
  across_->setValue(isKnown ? wayText(moved.x, tr("%1 px to the right"), tr("%1 px to the left")) : nothing);
  along_->setValue(isKnown ? wayText(moved.y, tr("%1 px down"), tr("%1 px up")) : nothing);
  turned_->setValue(isKnown ? tiltText(moved.degrees) : nothing);
  if (nudge_.failure())
    verdict_->show(Remark::Kind::failed, nudge_.failure()->what, nudge_.failure()->advice);
  else if (const std::optional<Banner> waiting = nudge_.waiting())
    verdict_->show(Remark::Kind::warning, waiting->sentence, waiting->more);
  else if (!sight)
    verdict_->show(Remark::Kind::watch, tr("Looking through the camera"), {});
  else if (sight->isAtItsPlace())
    verdict_->show(Remark::Kind::good, tr("The camera looks where it looked."),
                   tr("Fasten it, look once more, and close this window."));
  else if (isKnown)
    verdict_->show(
        Remark::Kind::warning, adviceOn(moved),
        std::hypot(moved.x, moved.y) < NudgeSight::nearEnough
            ? tr("If the projector was bumped instead, move its picture the other way.")
            : tr("The arrow shows where. If the projector was bumped instead, move its picture the "
                 "other way."));
  else
    verdict_->show(
        Remark::Kind::watch, tr("What is seen is not the view that was measured."),
        tr("Turn the camera until both halves look alike. If they do, the light or the surface has "
           "changed."));
}

void showNudge(QWidget& above, std::unique_ptr<Nudge> nudge, const std::function<void(const Nudge&)>& done) {
  // Another language has replaced that window, and the new one is asked as well.
  if (!above.window()->isVisible()) return;
  Nudge* looking = nudge.release();
  auto* dialog = new NudgeDialog(*looking, above.window());
  looking->setParent(dialog);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  // A desktop may give the keyboard to what plays on the projector instead.
  QObject::connect(dialog, &QDialog::finished, looking, [looking, done, whole = QPointer(above.window())] {
    done(*looking);
    if (whole) whole->activateWindow();
  });
  looking->start();
  dialog->show();
}

}  // namespace relucent::gui
