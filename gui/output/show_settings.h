// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QStringList>
#include <filesystem>
#include <vector>

#include "content/playlist.h"
#include "engine/fallback_backend.h"
#include "output/daily_hours.h"
#include "output/screen_identity.h"

namespace relucent {

/// What an unattended show plays, and where.
struct ShowSettings {
  std::filesystem::path calibration;
  PlaylistSettings content;
  QStringList displays;  // connectors, one a projector; empty: chosen by size, see displaysFor()
  Canvas canvas;
  bool adaptiveRange = false;  // brightness and offset follow the content
  BackendChoice backend = BackendChoice::automatic;
  std::optional<DailyHours> hours;  // of the day in which it plays; none: all
  QString folder;                   // of the log and the health file
};

/// The displays that the projectors hang on. A named one may be absent: the show waits for it. With none
/// named, for each projector a display of exactly its size that is not the operator's, in the order of their
/// places. Throws: Error{input} naming the displays that are there if that does not settle it.
std::vector<ScreenIdentity> displaysFor(const std::vector<QSize>& projectors, const QStringList& named);

/// What content a path names: a playlist's file, or what an item of a playlist may name.
/// Throws: as readPlaylist().
PlaylistSettings contentOf(const QString& path);

}  // namespace relucent
