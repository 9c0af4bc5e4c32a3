// SPDX-License-Identifier: MIT
#include "wizard/venue/rename_dialog.h"

#include "wizard/venue/venue_keeping.h"

namespace relucent::gui {

RenameDialog::RenameDialog(const RecentVenue& venue, QWidget* parent)
    : NameDialog(
          "rename",
          {tr("Rename a venue"),
           tr("Its folder has the same name and is renamed with it. A show that starts at log-in follows."),
           tr("Rename"),
           venue.name,
           venue.name,
           {},
           [venue](const QString& typed) { return VenueKeeping::nameProblem(venue, typed); }},
          parent) {}

}  // namespace relucent::gui
