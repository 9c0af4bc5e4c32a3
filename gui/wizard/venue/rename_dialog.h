// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>

#include "theme/controls.h"
#include "wizard/venue/recent_venues.h"

namespace relucent::gui {

/// Asks for another name of a venue.
class RenameDialog : public QDialog {
  Q_OBJECT

 public:
  explicit RenameDialog(const RecentVenue& venue, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// One that it can have.
  void chosen(const QString& name);

 private:
  QWidget* buttonRow();
  void look();

  RecentVenue venue_;
  QLineEdit* name_;
  Note* wrong_;
  QPushButton* rename_ = nullptr;
};

}  // namespace relucent::gui
