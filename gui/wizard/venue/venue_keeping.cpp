// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_keeping.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>
#include <array>
#include <system_error>

#include "output/installation.h"
#include "relucent/base/error.h"
#include "relucent/base/message.h"
#include "relucent/platform/folder_lock.h"

namespace relucent::gui {
namespace {

constexpr std::array starts{Start::service, Start::autostart};

/// Kept from other programs. Throws: Error{input} while one works on it; Error{disk}.
platform::FolderLock lockedAlone(const QString& folder) try {
  return {folder.toStdString(), platform::FolderLock::Kind::write};
} catch (const std::system_error& failure) {
  if (failure.code() == std::errc::operation_would_block)
    throw Error(
        ErrorKind::input,
        RELUCENT_MESSAGE("venue.used-by-another", "another program is working on this venue"),
        RELUCENT_MESSAGE("venue.wait-for-another", "wait until it has finished, or close it, then try again"),
        folder.toStdString());
  throw Error(ErrorKind::disk,
              RELUCENT_MESSAGE("venue.cannot-open-folder", "the folder cannot be opened ({})")
                  .with(failure.code().message()),
              RELUCENT_MESSAGE("show.check-folder-permissions", "check the folder's permissions"),
              folder.toStdString());
}

}  // namespace

VenueKeeping::VenueKeeping(const Session& session, RecentVenues recent)
    : session_(session),
      recent_(recent),
      config_(QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation)) {}

bool VenueKeeping::isOpen(const RecentVenue& venue) const {
  return session_.isOpen() &&
         QDir::cleanPath(QString::fromStdString(session_.path().string())) == venue.folder;
}

bool VenueKeeping::isInstalled(const RecentVenue& venue) const {
  return std::ranges::any_of(starts,
                             [&](Start start) { return gui::isInstalled(start, config_, venue.folder); });
}

QString VenueKeeping::whyNotRenamed(const RecentVenue& venue) const {
  if (!isOpen(venue)) return {};
  return session_.isMeasuring() ? tr("It is being measured.")
                                : tr("It is open. Open another venue, then come back.");
}

QString VenueKeeping::nameProblem(const RecentVenue& venue, const QString& name) {
  const QString wanted = name.trimmed();
  if (wanted.isEmpty()) return tr("Give the venue a name.");
  if (wanted.contains('/')) return tr("A name cannot hold a slash.");
  if (wanted.startsWith('.')) return tr("A name cannot begin with a full stop: its folder would be hidden.");
  if (wanted != venue.name && QFileInfo(QFileInfo(venue.folder).dir(), wanted).exists())
    return tr("There is a folder of that name. Choose another name.");
  return {};
}

QString VenueKeeping::rename(const RecentVenue& venue, const QString& name) {
  require(whyNotRenamed(venue).isEmpty() && nameProblem(venue, name).isEmpty(),
          "it cannot have that name now");
  const QString target = QFileInfo(venue.folder).dir().filePath(name.trimmed());
  if (target == venue.folder) return target;
  const platform::FolderLock alone = lockedAlone(venue.folder);
  std::error_code error;
  std::filesystem::rename(venue.folder.toStdString(), target.toStdString(), error);
  if (error)
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("venue.cannot-rename", "the folder cannot be renamed ({})").with(error.message()),
        RELUCENT_MESSAGE("show.check-folder-permissions", "check the folder's permissions"),
        venue.folder.toStdString());
  recent_.moved(venue.folder, target);
  for (Start start : starts) moveInstalled(start, config_, venue.folder, target);
  return target;
}

QString VenueKeeping::whyNotRemoved(const RecentVenue& venue) const {
  if (const QString why = whyNotRenamed(venue); !why.isEmpty()) return why;
  if (isInstalled(venue))
    return tr("Its show starts at log-in. Open it, and remove the installed show at Output first.");
  return {};
}

void VenueKeeping::remove(const RecentVenue& venue) {
  require(whyNotRemoved(venue).isEmpty(), "it cannot be removed now");
  const platform::FolderLock alone = lockedAlone(venue.folder);
  // Without this folder, in which its trash is made, Qt 6.4 moves files into the working directory instead.
  QDir().mkpath(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation));
  if (!QFile::moveToTrash(venue.folder))
    throw Error(ErrorKind::disk, RELUCENT_MESSAGE("venue.no-trash", "it cannot be moved to the trash"),
                RELUCENT_MESSAGE("venue.remove-folder-yourself",
                                 "this disk may have none: remove the folder with the file manager"),
                venue.folder.toStdString());
  recent_.forget(venue.folder);
}

}  // namespace relucent::gui
