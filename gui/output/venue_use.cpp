// SPDX-License-Identifier: MIT
#include "output/venue_use.h"

#include <QCryptographicHash>
#include <QDir>
#include <QStandardPaths>
#include <system_error>

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;
using Kind = platform::FolderLock::Kind;

/// An empty folder, which is locked instead of the venue's own: that one is locked while it is written.
QString noteOf(const fs::path& venue, VenueUse::Way way) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(venue / "", ignored);
  const QByteArray name =
      QCryptographicHash::hash(QByteArray::fromStdString(whole.string()), QCryptographicHash::Sha1);
  return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + "/in-use/" +
         (way == VenueUse::Way::wizard ? "wizard-" : "show-") + name.toHex();
}

}  // namespace

std::optional<VenueUse> VenueUse::take(const fs::path& venue, Way way) try {
  const QString note = noteOf(venue, way);
  if (!QDir().mkpath(note)) return VenueUse(std::nullopt);
  return VenueUse(platform::FolderLock(note.toStdString(), Kind::write));
} catch (const std::system_error& failure) {
  if (failure.code() == std::errc::operation_would_block) return std::nullopt;
  return VenueUse(std::nullopt);
}

bool VenueUse::isTaken(const fs::path& venue, Way way) try {
  const QString note = noteOf(venue, way);
  if (QDir(note).exists()) platform::FolderLock(note.toStdString(), Kind::read);
  return false;
} catch (const std::system_error& failure) {
  return failure.code() == std::errc::operation_would_block;
}

}  // namespace relucent::gui
