// SPDX-License-Identifier: MIT
#pragma once

#include <QSettings>
#include <QTemporaryDir>
#include <filesystem>
#include <string>

#include "relucent/pipeline/calibrate_settings.h"
#include "wizard/session/session.h"

/// What tests of pages begin with: a session in a folder of its own, and venues so small that they are
/// measured in seconds.
namespace relucent::gui {

constexpr int patience = 120'000;  // ms for a small measurement on a busy machine

/// A plain wall.
inline pipeline::CalibrateSettings smallVenue(Size projector = {48, 36}, Size camera = {40, 30},
                                              int levels = 9) {
  venue::VenueSettings venue;
  venue.name = "plain";
  venue.projector = projector;
  venue.camera = camera;
  venue.pathsPerPixel = 16;
  pipeline::CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = levels;
  return settings;
}

/// Scripts that show and photograph: devices whose light shines into a room.
inline pipeline::CalibrateSettings scriptedVenue(const std::string& show, const std::string& photograph) {
  pipeline::CommandRigSettings script;
  script.projector = {64, 48};
  script.camera = {48, 36};
  script.projectorCommand = show;
  script.cameraCommand = photograph;
  pipeline::CalibrateSettings settings;
  settings.rig = script;
  return settings;
}

/// A session with nothing open; folder and all that is in it go with this.
struct SimulatedSession {
  QTemporaryDir folder;
  Session session{path("cache")};
  QSettings settings{folder.filePath("settings.ini"), QSettings::IniFormat};

  std::filesystem::path path(const QString& name) const { return folder.filePath(name).toStdString(); }
  void begin(const pipeline::CalibrateSettings& venue = smallVenue(), const QString& name = "venue") {
    session.begin(path(name), venue);
  }
};

}  // namespace relucent::gui
