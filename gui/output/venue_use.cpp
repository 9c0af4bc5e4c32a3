// SPDX-License-Identifier: MIT
#include "output/venue_use.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QSaveFile>
#include <QStandardPaths>
#include <system_error>

#include "relucent/platform/process.h"

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;
using Kind = platform::FolderLock::Kind;

/// A folder of its own, which is locked instead of the venue's own: that one is locked while it is written.
QString noteOf(const fs::path& venue, VenueUse::Way way) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(venue / "", ignored);
  const QByteArray name =
      QCryptographicHash::hash(QByteArray::fromStdString(whole.string()), QCryptographicHash::Sha1);
  // Not by the program's names: every part of it, and tests of it, mean the same.
  const char* const what = way == VenueUse::Way::wizard  ? "wizard-"
                           : way == VenueUse::Way::show  ? "show-"
                           : way == VenueUse::Way::night ? "night-"
                                                         : "screen-";
  return QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + "/relucent/in-use/" + what +
         name.toHex();
}

constexpr const char* holderName = "/process";  // its number

}  // namespace

fs::path VenueUse::ofScreen(const QString& connector) {
  const QByteArray wayland = qgetenv("WAYLAND_DISPLAY");
  const QByteArray desktop = wayland.isEmpty() ? qgetenv("DISPLAY") : wayland;
  return fs::path("/") / desktop.toStdString() / connector.toStdString();
}

std::optional<VenueUse> VenueUse::take(const fs::path& venue, Way way) try {
  const QString note = noteOf(venue, way);
  if (!QDir().mkpath(note)) return VenueUse(std::nullopt);
  platform::FolderLock lock(note.toStdString(), Kind::write);
  QSaveFile holder(note + holderName);
  if (holder.open(QIODevice::WriteOnly)) {
    holder.write(QByteArray::number(quint64{platform::processNumber()}));
    holder.commit();
  }
  return VenueUse(std::move(lock));
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

bool VenueUse::end(const fs::path& venue, Way way) {
  QFile holder(noteOf(venue, way) + holderName);
  if (!isTaken(venue, way) || !holder.open(QIODevice::ReadOnly)) return false;
  bool isNumber = false;
  const quint64 number = holder.readAll().toULongLong(&isNumber);
  return isNumber && platform::askToEnd(number);
}

}  // namespace relucent::gui
