// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>

#include "theme/controls.h"

namespace relucent::gui {

/// Asks for the address of a live picture on the network, and what is shown while it is lost.
class StreamDialog : public QDialog {
  Q_OBJECT

 public:
  explicit StreamDialog(QWidget* parent = nullptr);

 Q_SIGNALS:
  /// The path of a playlist item, see StreamAddress.
  void chosen(const QString& path);

 private:
  QWidget* buttonRow();
  void add();

  QLineEdit* address_;
  Segmented* hold_;
  Note* wrong_;
};

}  // namespace relucent::gui
