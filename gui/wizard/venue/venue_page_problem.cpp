// SPDX-License-Identifier: MIT
// What a new venue will take, and what stands against beginning it.
#include <QDir>
#include <QFileInfo>
#include <QGuiApplication>

#include <algorithm>

#include "jobs/free_space.h"
#include "relucent/acquisition/forecast.h"
#include "relucent/base/message.h"
#include "relucent/devices/camera_address.h"
#include "relucent/devices/command/command_camera.h"
#include "text/message_text.h"
#include "views/number_text.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

constexpr Size usualScreen{1920, 1080};

constexpr double meanExposure = 0.1;  // seconds

bool hasOneScreen() {
  return QGuiApplication::screens().size() == 1;
}

/// A screen that Relucent shows on, and a camera by command.
pipeline::ScreenRigSettings screenOfScript(const pipeline::CommandRigSettings& script,
                                           const ScreenChoice& screen) {
  pipeline::ScreenRigSettings rig = withScreen({}, screen);
  rig.cameraAddress = devices::toString({devices::CommandCamera::kind, script.cameraCommand});
  rig.camera = script.camera;
  rig.shortestExposure = script.shortestExposure;
  rig.longestExposure = script.longestExposure;
  return rig;
}

/// What photographs take that a page knows of by size alone: the forecast then asks for no more.
rig::ShotTimes photographsOf(double seconds) {
  rig::ShotTimes times;
  times.shots = times.exposures = 1;
  times.capturing = seconds;
  times.asked = meanExposure;
  times.askedSquared = meanExposure * meanExposure;
  return times;
}

}  // namespace

std::uint64_t VenuePage::freeBytes() const {
  return freeBytesAt(parent_);
}

pipeline::CalibrateSettings VenuePage::wanted() const {
  pipeline::CalibrateSettings settings;
  if (isReal()) {
    if (isScriptOnScreen())
      settings.rig = screenOfScript(script_, *scriptScreen_);
    else if (mode_ == Mode::script)
      settings.rig = script_;
    else
      settings.rig = screen_;
    if (mode_ == Mode::devices) settings.network = network_.wanted(projectors().size());
    return settings;
  }
  venue::VenueSettings venue;
  venue.name = venues_[venue_].id;
  venue.projector = sizes_[size_].projector;
  venue.camera = sizes_[size_].camera;
  settings.rig = venue;
  return settings;
}

WorkLeft VenuePage::expectedWith(double secondsAPhotograph) const {
  const auto forecastOf = [&](const Rasters& cameras, const Rasters& projectors) {
    constexpr std::size_t exposures = 2;
    return acquisition::forecast({cameras, projectors, exposures, meanExposure}, wanted().acquisition,
                                 photographsOf(secondsAPhotograph), {});
  };
  Size projector, camera;
  if (mode_ == Mode::script) {
    projector = script_.projector;
    camera = script_.camera.value_or(projector);
  } else if (mode_ == Mode::devices) {
    // Of a camera about as many pixels are used as the projector has; one is chosen later if none is yet.
    std::vector<Size> screens;
    for (const pipeline::ScreenRigSettings::Screen& screen : projectors())
      screens.push_back(screen.projector);
    if (screens.empty()) screens.push_back(usualScreen);
    const std::vector<Size> seen(std::max<std::size_t>(1, cameras().size()), screens.front());
    return forecastOf(Rasters(seen), Rasters(screens));
  } else {
    return expectedOf(venues_[venue_]);
  }
  return forecastOf(Rasters(camera), Rasters(projector));
}

/// By the same forecast as Acquire asks once the response is measured.
WorkLeft VenuePage::expectedOf(const RehearsalVenue& venue) const {
  // A photograph that is computed, on two processors of an older laptop.
  constexpr double secondsAPixel = 2e-6;
  const RehearsalSize& size = sizes_[size_];
  venue::VenueSettings simulated;
  simulated.name = venue.id;
  const Rasters projectors(std::vector<Size>(Session::projectorsOf(simulated), size.projector));
  const Rasters cameras(std::vector<Size>(Session::camerasOf(simulated), size.camera));
  constexpr std::size_t exposures = 2;
  return acquisition::forecast({cameras, projectors, exposures, meanExposure}, wanted().acquisition,
                               photographsOf(secondsAPixel * static_cast<double>(cameras.count())), {});
}

WorkLeft VenuePage::expected() const {
  return expectedWith(meanExposure);
}

std::pair<double, double> VenuePage::expectedSeconds() const {
  // A GigE camera gave 16 photographs a second; a still camera takes and sends a raw file in some 3 seconds.
  constexpr double fastPhotograph = 1.0 / 16.0, slowPhotograph = 3.0;
  return {expectedWith(fastPhotograph).seconds, expectedWith(slowPhotograph).seconds};
}

VenuePage::Problem VenuePage::firstProblem() const {
  if (mode_ == Mode::start) return {};
  if (mode_ == Mode::screen) {
    if (!openScreen_.isChangeable())
      return {tr("The devices are in use at %1.").arg(session_.devicesUserName())};
    if (!openScreen_.isDifferentScreen()) return {tr("Choose another screen."), Remedy::screen};
    if (const auto other = openScreen_.alsoOf())
      return {tr("That screen is projector %1. Choose another screen.").arg(*other + 1), Remedy::screen};
    return {};
  }
  if (mode_ == Mode::programs) {
    if (!openPrograms_.isChangeable())
      return {tr("The devices are in use at %1.").arg(session_.devicesUserName())};
    if (!openPrograms_.isDifferent()) return {tr("Type another command.")};
    return {openPrograms_.problem()};
  }
  if (venueName_.trimmed().isEmpty()) return {tr("Give the venue a name."), Remedy::name};
  if (venueName_.contains('/')) return {tr("A name cannot hold a slash."), Remedy::name};
  if (QFileInfo::exists(target()))
    return {tr("There is a folder of that name. Choose another name."), Remedy::name};
  if (mode_ == Mode::devices && screen_.projector.empty())
    return {hasOneScreen()
                ? tr("Only your own screen is there. Plug the projector in, and extend the desktop to it.")
                : tr("Choose the screen that shines on the surface."),
            Remedy::screen};
  if (const QString wrong = network_.problem(projectors().size()); mode_ == Mode::devices && !wrong.isEmpty())
    return {wrong};
  if (mode_ == Mode::script && script_.projectorCommand.empty() && !scriptScreen_)
    return {tr("Choose the projector's screen, or type the command that shows."), Remedy::screen};
  if (std::vector<Message> found = problems(wanted()); !found.empty()) return {fullSentence(found.front())};
  std::uint64_t needed = expected().diskBytes, free = freeBytes();
  if (free < needed)
    return {tr("Free %1 or choose another folder.").arg(bytesText(needed - free)), Remedy::folder};
  if (needsConsent() && !roomClear_) return {tr("Confirm that the room is clear."), Remedy::consent};
  return {};
}

}  // namespace relucent::gui
