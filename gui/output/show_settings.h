// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QStringList>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "content/playlist.h"
#include "output/daily_hours.h"
#include "output/machine_clock.h"
#include "output/screen_identity.h"
#include "relucent/compensation/brightness.h"
#include "relucent/compensation/viewer.h"
#include "relucent/engine/fallback_backend.h"
#include "relucent/pipeline/watched_calibration.h"
#include "relucent/pjlink/address.h"
#include "remote/network_place.h"

namespace relucent::gui {

/// A projector of a show that is on the network.
struct ShowProjector {
  std::string label;
  pjlink::Address address;
  std::optional<Size> sent{};  // pixels of the picture that it is sent
};

/// Settings of an unattended show.
struct ShowSettings {
  std::filesystem::path calibration;
  PlaylistSettings content;
  QStringList displays;  // connectors, one a projector; empty: chosen by size, see displaysFor()
  Canvas canvas;
  bool adaptiveRange = false;  // brightness and offset follow the content
  /// How bright white is where; none: as the calibration has it.
  std::optional<compensation::Brightness> brightness;
  engine::BackendChoice backend = engine::BackendChoice::automatic;
  std::optional<DailyHours> hours;              // daily hours of play; none: always
  std::vector<compensation::Position> cameras;  // where they stand; empty: as the calibration has it
  std::optional<NetworkPlace> osc;              // where remote controls are listened to; none: nowhere
  std::optional<NetworkPlace> oscFeedback;      // who is told of every change
  QString folder;                               // folder of the log and the health file
  std::optional<NetworkPlace> status{};         // where the status page is shown; none: nowhere
  std::vector<ShowProjector> projectors{};      // that are on the network
  bool switchesPower = false;                   // of these: on for the hours of play, off outside them
  bool closesShutter = false;                   // while black is wanted
  std::optional<std::chrono::minutes>
      powerOffAfter{};           // of black, hours or not; none: at the end of the hours
  std::optional<QTime> night{};  // when the venue is tended, outside the hours; none: never
  std::string alarmCommand{};  // tells of a night's alarm, see pipeline::closeNight(); empty: nobody is told
  std::optional<pipeline::WatchSettings> watch{};  // by which camera the show is watched; none: by none
  bool fillsShadows = false;                       // of whoever it sees in a projector's light, by the others
  std::string set{};  // of the calibration, at first; empty: as the content's times say, else the one in use
  QString rehearsal{};  // file of its time, see RehearsalClock; empty: it is none
};

/// The projectors of a calibration that are on the network. Throws: as CalibrationFolder::open(),
/// Error{format}.
std::vector<ShowProjector> showProjectorsOf(const std::filesystem::path& calibration);

/// The displays of the projectors. A named one may be absent: the show waits for it. If none is named, for
/// each projector a display of exactly its size that is not the operator's, in the order of their positions.
/// Throws: Error{input} with the present displays if that is ambiguous.
std::vector<ScreenIdentity> displaysFor(const std::vector<QSize>& projectors, const QStringList& named);

/// The show's time: the computer's, or a rehearsal's.
/// Throws: Error{input} for a rehearsal with a calibration of real devices; as CalibrationFolder::open(),
/// RehearsalClock.
MachineClock clockOf(const ShowSettings& settings);

/// The content at a path: a playlist's file, or anything that a playlist item may name.
/// Throws: as readPlaylist(), streamAddressFrom().
PlaylistSettings contentOf(const QString& path);

}  // namespace relucent::gui
