// SPDX-License-Identifier: MIT
#include "wizard/devices/flash_consent.h"

#include <cmath>

#include "theme/controls.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {

namespace {

QString rateSentence(std::optional<double> changes) {
  return changes ? FlashConsent::tr(
                       "The projector shows patterns that change about %n time(s) a second, and at times "
                       "more often.",
                       nullptr, static_cast<int>(std::ceil(*changes)))
                 : FlashConsent::tr(
                       "The projector shows patterns that change as quickly as the devices can, "
                       "perhaps more than 3 times a second.");
}

}  // namespace

std::optional<double> measuredChanges(const Session& session) {
  const auto& measured = session.figures<calibration::Stage::linearization>();
  if (!measured || !measured->cost) return std::nullopt;
  // There the patterns are photographed with every exposure, those of the light transport mostly with one.
  const double photographs = measured->cost->exposures, seconds = measured->cost->seconds;
  if (!(photographs > 0.0) || !(seconds > 0.0)) return std::nullopt;
  // A mean that a cable pulled or a pause makes small calms nobody: what is safe for all is not claimed.
  const double changes = photographs / seconds;
  return changes > Session::audienceLimit ? std::optional(changes) : std::nullopt;
}

FlashConsent::FlashConsent(QWidget* parent)
    : QWidget(parent), note_(new Note(Note::Kind::amber)), tick_(new Tick(tr("The room is clear"))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(tr("Flashing light"), "section"));
  column->addWidget(note_);
  tick_->setObjectName("room-is-clear");
  tick_->setAccessibleName(tr("The room is clear and everyone here knows"));
  tick_->setToolTip(tick_->accessibleName());
  column->addWidget(tick_);
  connect(tick_, &Tick::toggled, this, &FlashConsent::given);
}

void FlashConsent::show(bool needed, bool given, std::optional<double> changes) {
  setVisible(needed);
  QSignalBlocker quiet(tick_);
  tick_->setChecked(given);
  note_->setText(rateSentence(changes),
                 tr("Flashing light can cause seizures. Clear the room and cover the entrance."));
}

QWidget* consentWidget(DevicePage& page) {
  Session& session = page.session();
  auto* part = new FlashConsent;
  QObject::connect(part, &FlashConsent::given, &session, &Session::setRoomClear);
  auto refresh = [part, &session] {
    part->show(session.needsConsent(), session.isRoomClear(), measuredChanges(session));
  };
  for (auto signal : {&Session::opened, &Session::stepsChanged, &Session::devicesChanged})
    QObject::connect(&session, signal, part, refresh);
  QObject::connect(&page, &PageModel::remedyWanted, part, [part, &session] {
    if (!session.mayMeasure()) pointOut(part->tick());
  });
  refresh();
  return part;
}

}  // namespace relucent::gui
