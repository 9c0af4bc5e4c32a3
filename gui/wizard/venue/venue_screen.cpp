// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_screen.h"

#include <QGuiApplication>

#include "output/window_projector.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/screen_devices.h"

namespace relucent::gui {

VenueScreen::VenueScreen(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &Session::opened, this, &VenueScreen::forget);
  // Without an interface there are no screens.
  auto* interface = qobject_cast<QGuiApplication*>(QCoreApplication::instance());
  if (interface == nullptr) return;
  connect(interface, &QGuiApplication::screenAdded, this, &VenueScreen::changed);
  connect(interface, &QGuiApplication::screenRemoved, this, &VenueScreen::changed);
}

std::optional<std::size_t> VenueScreen::missing() const {
  for (std::size_t projector = 0; projector < session_.projectors(); ++projector)
    if (const auto screen = session_.screenOf(projector);
        screen && findScreen(identityOf(screen->display)) == nullptr)
      return projector;
  return std::nullopt;
}

std::size_t VenueScreen::projector() const {
  return projector_ ? *projector_ : missing().value_or(0);
}

void VenueScreen::chooseProjector(std::size_t projector) {
  if (projector >= session_.projectors()) return;
  projector_ = projector;
  chosen_.reset();
  Q_EMIT changed();
}

std::vector<ScreenChoice> VenueScreen::choices() const {
  const std::optional<pipeline::ScreenRigSettings> screen = session_.screenOf(projector());
  if (!screen) return {};
  return session_.isMeasured() ? screenChoicesFor(screen->projector) : screenChoices();
}

void VenueScreen::choose(const ScreenChoice& choice) {
  if (!choice.refusal.isEmpty()) return;
  projector_ = projector();
  chosen_ = choice;
  Q_EMIT changed();
}

bool VenueScreen::isDifferentScreen() const {
  const std::optional<pipeline::ScreenRigSettings> screen = session_.screenOf(projector());
  return screen && chosen_ && chosen_->display != screen->display;
}

std::optional<std::size_t> VenueScreen::alsoOf() const {
  if (!chosen_) return std::nullopt;
  for (std::size_t other = 0; other < session_.projectors(); ++other)
    if (const auto screen = session_.screenOf(other);
        other != projector() && screen && screen->display == chosen_->display)
      return other;
  return std::nullopt;
}

QString VenueScreen::meaning() const {
  const std::optional<pipeline::ScreenRigSettings> screen = session_.screenOf(projector());
  if (!screen || !session_.isMeasured()) return {};
  return meaningOfMove(session_.measuredDisplay(projector()), chosen_ ? chosen_->display : screen->display);
}

void VenueScreen::apply() {
  require(isChangeable() && chosen_.has_value(), "there is no screen to change to");
  const std::size_t which = projector();
  const pipeline::ScreenRigSettings changed = withScreen(*session_.screenOf(which), *chosen_);
  chosen_.reset();
  // With nothing measured yet, a screen of other pixels will do.
  if (session_.isMeasured()) return session_.changeScreen(changed, which);
  std::vector<pipeline::ScreenRigSettings::Screen> screens = pipeline::screensOf(*session_.screenRig());
  screens[which] = pipeline::screensOf(changed).front();
  session_.changeRig(pipeline::withScreens(*session_.screenRig(), screens));
}

}  // namespace relucent::gui
