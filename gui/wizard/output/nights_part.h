// SPDX-License-Identifier: MIT
#pragma once

#include <QComboBox>
#include <QDateTime>
#include <QFileSystemWatcher>
#include <QPushButton>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "relucent/pipeline/night_record.h"
#include "theme/controls.h"

namespace relucent::gui {

class OutputPage;

/// When an installed show looks after the picture every night, and what the nights of this venue came to: the
/// last one, and all in a dialog (NightsDialog).
class NightsPart : public QWidget {
  Q_OBJECT

 public:
  explicit NightsPart(OutputPage& page, QWidget* parent = nullptr);

 protected:
  /// They may have become more while nobody looked.
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  QDateTime writtenNow() const;
  void reload();
  void showLast();
  void lookWhetherOneRuns();
  void showTime();
  void open();

  OutputPage& page_;
  std::vector<pipeline::NightRecord> nights_;
  QFileSystemWatcher folder_;
  QDateTime written_;  // their file, as it was read
  bool isUnreadable_ = false;
  bool isUnderWay_ = false;
  QTimer looking_;  // whether one runs, while the part is seen
  Remark* last_;
  QLabel* what_;
  QComboBox* when_;
  QPushButton* open_;
};

}  // namespace relucent::gui
