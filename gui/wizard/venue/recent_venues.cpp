// SPDX-License-Identifier: MIT
#include "wizard/venue/recent_venues.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>

#include "output/venue_use.h"
#include "relucent/base/error.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/stored_settings.h"
#include "wizard/session/kept_shots.h"
#include "wizard/venue/venue_thumbnail.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(RecentVenues)
};

constexpr const char* key = "recent/venues";

QString folderOf(const QString& entry) {
  return entry.mid(entry.indexOf('|') + 1);
}

QString stateOf(const calibration::CalibrationFolder& folder) {
  if (VenueUse::isTaken(folder.path(), VenueUse::Way::show)) return Translated::tr("A show plays");
  const bool isFirst =
      calibration::progressOf(folder, calibration::Stage::acquisition) == calibration::StageProgress::open;
  const int kept = photographsInterrupted(folder);
  if (isFirst && kept > 0) return Translated::tr("Interrupted: %n pattern(s) are safe", nullptr, kept);
  if (isFirst)
    return calibration::progressOf(folder, calibration::Stage::linearization) ==
                   calibration::StageProgress::open
               ? Translated::tr("Nothing measured yet")
               : Translated::tr("Acquire is next");
  if (const auto stored = calibration::resultOf(folder, calibration::Stage::acquisition)) {
    const auto measured = calibration::resultFrom<calibration::Stage::acquisition>(*stored);
    if (measured.changed) return Translated::tr("Ended by a change");
    if (measured.stoppedAt > 0 && kept > 0)
      return Translated::tr("Stopped at %1 px; newer patterns: %2").arg(measured.stoppedAt).arg(kept);
    if (measured.stoppedAt > 0) return Translated::tr("Stopped at blocks of %1 px").arg(measured.stoppedAt);
  }
  if (kept > 0) return Translated::tr("Measured; %n newer pattern(s) are safe", nullptr, kept);
  if (calibration::progressOf(folder, calibration::Stage::content) == calibration::StageProgress::done)
    return Translated::tr("Ready to play");
  if (calibration::progressOf(folder, calibration::Stage::content) == calibration::StageProgress::stale)
    return Translated::tr("Preview out of date");
  return Translated::tr("Measured");
}

}  // namespace

QList<RecentVenue> RecentVenues::list() const {
  QList<RecentVenue> venues;
  for (const QString& entry : settings_.value(key).toStringList()) {
    qsizetype bar = entry.indexOf('|');
    RecentVenue venue;
    venue.opened = QDateTime::fromString(entry.left(bar), Qt::ISODate);
    venue.folder = entry.mid(bar + 1);
    venue.name = QFileInfo(venue.folder).fileName();
    if (!QFileInfo::exists(venue.folder)) continue;
    // Of one that is being measured again, the one before, though nobody else may look into it now.
    venue.picture = thumbnailOf(venue.folder);
    try {
      auto folder = calibration::CalibrationFolder::open(venue.folder.toStdString(),
                                                         calibration::CalibrationFolder::Access::read);
      venue.state = stateOf(folder);
      venue.isInterrupted = photographsInterrupted(folder) > 0;
      venue.simulated = std::holds_alternative<venue::VenueSettings>(pipeline::settingsOf(folder).rig);
    } catch (const Error&) {
      // It stays on the list: opening it tells what is wrong.
    }
    venues.append(venue);
  }
  return venues;
}

void RecentVenues::add(const QString& folder, const QDateTime& now) {
  QStringList entries = settings_.value(key).toStringList();
  QString clean = QDir::cleanPath(folder);
  entries.removeIf([&](const QString& entry) { return folderOf(entry) == clean; });
  entries.prepend(now.toString(Qt::ISODate) + '|' + clean);
  while (entries.size() > most) entries.removeLast();
  settings_.setValue(key, entries);
}

void RecentVenues::moved(const QString& from, const QString& to) {
  QStringList entries = settings_.value(key).toStringList();
  for (QString& entry : entries)
    if (folderOf(entry) == from) entry = entry.left(entry.indexOf('|') + 1) + to;
  settings_.setValue(key, entries);
}

void RecentVenues::forget(const QString& folder) {
  QStringList entries = settings_.value(key).toStringList();
  entries.removeIf([&](const QString& entry) { return folderOf(entry) == folder; });
  settings_.setValue(key, entries);
}

}  // namespace relucent::gui
