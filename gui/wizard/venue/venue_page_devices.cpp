// SPDX-License-Identifier: MIT
// The projectors and cameras of a new venue: lists that are added to, named and removed from.
#include <algorithm>

#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

using Screen = pipeline::ScreenRigSettings::Screen;
using Camera = pipeline::ScreenRigSettings::Camera;

/// Of the projector that has it; none: it is free.
std::optional<std::size_t> projectorAt(const std::vector<Screen>& screens,
                                       const pipeline::ScreenRigSettings::Display& display) {
  const auto found = std::ranges::find(screens, display, &Screen::display);
  if (found == screens.end()) return std::nullopt;
  return static_cast<std::size_t>(found - screens.begin());
}

/// For another projector. One that is chosen with a warning only, as the one that is worked on, is chosen by
/// hand.
bool isFree(const ScreenChoice& choice, const std::vector<Screen>& screens) {
  return choice.refusal.isEmpty() && choice.warning.isEmpty() && !projectorAt(screens, choice.display);
}

}  // namespace

void VenuePage::selectProjector(std::size_t projector) {
  if (projector >= projectors().size() || std::exchange(projector_, projector) == projector) return;
  tellSettings();
}

void VenuePage::chooseScreen(const ScreenChoice& choice) {
  if (!choice.refusal.isEmpty()) return;
  std::vector<Screen> screens = projectors();
  if (const auto other = projectorAt(screens, choice.display); other && *other != projector_) return;
  if (screens.empty()) screens.emplace_back();
  Screen& chosen = screens[std::min(projector_, screens.size() - 1)];
  chosen = {choice.display, choice.size, choice.frameRate, chosen.name};
  screen_ = pipeline::withScreens(std::move(screen_), screens);
  screenWarning_ = choice.warning;
  tellSettings();
}

std::vector<ScreenChoice> VenuePage::screensToChoose() const {
  std::vector<ScreenChoice> choices = screenChoices();
  for (ScreenChoice& choice : choices)
    if (const auto other = projectorAt(projectors(), choice.display);
        other && *other != projector_ && choice.refusal.isEmpty())
      choice.refusal = tr("This screen is projector %1 already.").arg(*other + 1);
  return choices;
}

bool VenuePage::mayAddProjector() const {
  const std::vector<Screen> screens = projectors();
  const std::vector<ScreenChoice> choices = screenChoices();
  return !screens.empty() && std::ranges::any_of(choices, [&screens](const ScreenChoice& choice) {
    return isFree(choice, screens);
  });
}

bool VenuePage::isPluggedIn(const Screen& screen) const {
  const std::vector<ScreenChoice> choices = screenChoices();
  return std::ranges::find(choices, screen.display, &ScreenChoice::display) != choices.end();
}

void VenuePage::addProjector() {
  std::vector<Screen> screens = projectors();
  for (const ScreenChoice& choice : screenChoices()) {
    if (!isFree(choice, screens)) continue;
    screens.push_back({choice.display, choice.size, choice.frameRate, {}});
    screen_ = pipeline::withScreens(std::move(screen_), screens);
    projector_ = screens.size() - 1;
    return tellSettings();
  }
}

void VenuePage::removeProjector(std::size_t projector) {
  std::vector<Screen> screens = projectors();
  if (projector >= screens.size()) return;
  screens.erase(screens.begin() + static_cast<std::ptrdiff_t>(projector));
  network_.remove(projector);
  screen_ = pipeline::withScreens(std::move(screen_), screens);
  if (projector_ >= screens.size()) projector_ = screens.empty() ? 0 : screens.size() - 1;
  tellSettings();
}

void VenuePage::nameProjector(std::size_t projector, const QString& name) {
  std::vector<Screen> screens = projectors();
  if (projector >= screens.size()) return;
  screens[projector].name = name.trimmed().toStdString();
  screen_ = pipeline::withScreens(std::move(screen_), screens);
  tellSettings();
}

bool VenuePage::hasCamera(const std::string& address) const {
  const std::vector<Camera> all = cameras();
  return std::ranges::find(all, address, &Camera::address) != all.end();
}

void VenuePage::addCamera(const std::string& address) {
  if (hasCamera(address)) return;
  std::vector<Camera> all = cameras();
  all.push_back({address, std::nullopt, {}});
  screen_ = pipeline::withCameras(std::move(screen_), all);
  tellSettings();
}

void VenuePage::removeCamera(const std::string& address) {
  std::vector<Camera> all = cameras();
  std::erase_if(all, [&address](const Camera& camera) { return camera.address == address; });
  screen_ = pipeline::withCameras(std::move(screen_), all);
  tellSettings();
}

void VenuePage::nameCamera(std::size_t camera, const QString& name) {
  std::vector<Camera> all = cameras();
  if (camera >= all.size()) return;
  all[camera].name = name.trimmed().toStdString();
  screen_ = pipeline::withCameras(std::move(screen_), all);
  tellSettings();
}

}  // namespace relucent::gui
