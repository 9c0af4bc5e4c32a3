// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>

#include "content/set_times.h"

class QComboBox;
class QLineEdit;

namespace relucent::gui {

/// When the installed show changes the set of the calibration: a list that is added to and removed from.
class SetTimesDialog : public QDialog {
  Q_OBJECT

 public:
  SetTimesDialog(const QStringList& sets, const QList<SetTime>& times, QWidget* parent = nullptr);

 Q_SIGNALS:
  void chosen(const QList<SetTime>& times);

 private:
  QWidget* addRow(const QStringList& sets);
  QWidget* buttonRow();
  void refresh();
  void look();

  QList<SetTime> times_;
  QListWidget* list_;
  QLineEdit* from_ = nullptr;
  QComboBox* set_ = nullptr;
  QPushButton* remove_ = nullptr;
};

}  // namespace relucent::gui
