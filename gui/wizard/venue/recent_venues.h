// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QImage>
#include <QList>
#include <QSettings>
#include <QString>

namespace relucent::gui {

/// A calibration that was opened before.
struct RecentVenue {
  QString folder;
  QString name;
  QDateTime opened;
  QString state;  // of its steps, one short line; empty if it cannot be read now
  bool simulated = false;
  bool isInterrupted = false;  // photographs of a measurement that has not ended
  QImage picture;              // of the surface, small; null: it is not measured yet
};

/// The calibrations that were opened, newest first, kept by the desktop's settings. Those that are gone from
/// the disk are left out, not forgotten: their disk may come back.
class RecentVenues {
 public:
  static constexpr qsizetype most = 12;

  /// `settings` outlives this.
  explicit RecentVenues(QSettings& settings) : settings_(settings) {}
  QList<RecentVenue> list() const;
  void add(const QString& folder, const QDateTime& now = QDateTime::currentDateTime());
  /// One is elsewhere now; it keeps its place.
  void moved(const QString& from, const QString& to);
  /// One is gone for good.
  void forget(const QString& folder);

 private:
  QSettings& settings_;
};

}  // namespace relucent::gui
