// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/frame/name_dialog.h"
#include "wizard/venue/recent_venues.h"

namespace relucent::gui {

/// Asks for another name of a venue.
class RenameDialog : public NameDialog {
  Q_OBJECT

 public:
  explicit RenameDialog(const RecentVenue& venue, QWidget* parent = nullptr);
};

}  // namespace relucent::gui
