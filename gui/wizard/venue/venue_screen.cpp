// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_screen.h"

#include <QGuiApplication>

#include "output/window_projector.h"
#include "relucent/base/error.h"

namespace relucent::gui {

VenueScreen::VenueScreen(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &Session::opened, this, &VenueScreen::forget);
  // Without an interface there are no screens.
  auto* interface = qobject_cast<QGuiApplication*>(QCoreApplication::instance());
  if (interface == nullptr) return;
  connect(interface, &QGuiApplication::screenAdded, this, &VenueScreen::changed);
  connect(interface, &QGuiApplication::screenRemoved, this, &VenueScreen::changed);
}

bool VenueScreen::isMissing() const {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  return screen != nullptr && findScreen(identityOf(screen->display)) == nullptr;
}

std::vector<ScreenChoice> VenueScreen::choices() const {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  if (screen == nullptr) return {};
  return session_.isMeasured() ? screenChoicesFor(screen->projector) : screenChoices();
}

void VenueScreen::choose(const ScreenChoice& choice) {
  if (!choice.refusal.isEmpty()) return;
  chosen_ = choice;
  Q_EMIT changed();
}

bool VenueScreen::isDifferentScreen() const {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  return screen != nullptr && chosen_ && chosen_->display != screen->display;
}

QString VenueScreen::meaning() const {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  if (screen == nullptr || !session_.isMeasured()) return {};
  return meaningOfMove(session_.measuredDisplay(), chosen_ ? chosen_->display : screen->display);
}

void VenueScreen::apply() {
  require(isChangeable() && chosen_.has_value(), "there is no screen to change to");
  const pipeline::ScreenRigSettings changed = withScreen(*session_.screenRig(), *chosen_);
  chosen_.reset();
  // With nothing measured yet, a screen of other pixels will do.
  if (session_.isMeasured())
    session_.changeScreen(changed);
  else
    session_.changeRig(changed);
}

}  // namespace relucent::gui
