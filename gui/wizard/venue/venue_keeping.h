// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>
#include <QString>

#include "wizard/session/session.h"
#include "wizard/venue/recent_venues.h"

namespace relucent::gui {

/// Gives venues on the list another name, and takes them off the disk, into the desktop's trash. What leads
/// to them follows: the list, and the show that starts at log-in.
class VenueKeeping {
  Q_DECLARE_TR_FUNCTIONS(VenueKeeping)

 public:
  /// `session` outlives this.
  VenueKeeping(const Session& session, RecentVenues recent);

  /// Of the user's configuration, where shows are installed.
  void setConfigFolder(const QString& config) { config_ = config; }

  /// Why it cannot have another name now, a sentence; empty: it can.
  QString whyNotRenamed(const RecentVenue& venue) const;
  /// What is wrong with a name for it, a sentence; empty: nothing.
  static QString nameProblem(const RecentVenue& venue, const QString& name);
  /// Renames its folder. Returns where it is now. Contract: whyNotRenamed() and nameProblem() are empty.
  /// Throws: Error{input} while another program works on it; Error{disk}: it has the name of before, or,
  /// where the message names the show's file, the new one.
  QString rename(const RecentVenue& venue, const QString& name);

  /// Why it cannot be removed now, a sentence; empty: it can.
  QString whyNotRemoved(const RecentVenue& venue) const;
  /// Moves its folder into the trash. Contract: whyNotRemoved() is empty. Throws: Error{input} while another
  /// program works on it; Error{disk} where there is no trash for that disk.
  void remove(const RecentVenue& venue);

 private:
  bool isOpen(const RecentVenue& venue) const;
  bool isInstalled(const RecentVenue& venue) const;

  const Session& session_;
  RecentVenues recent_;
  QString config_;
};

}  // namespace relucent::gui
