// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <map>
#include <memory>

#include "theme/controls.h"
#include "wizard/venue/venue_tidy.h"

class QProgressBar;

namespace relucent::gui {

/// What tidying a venue would free, by what is kept; asks, shows how far it is, and says what it came to.
class TidyDialog : public QDialog {
  Q_OBJECT

 public:
  TidyDialog(std::unique_ptr<VenueTidy> tidy, QWidget* parent = nullptr);

  VenueTidy& tidy() { return *tidy_; }
  /// What is being removed is ended first.
  void reject() override;

 protected:
  /// As high as what is shown now, once its parts know their lines.
  bool event(QEvent* event) override;

 private:
  QWidget* choicePart();
  QWidget* buttonRow();
  void refresh();
  void refreshChoices();
  void refreshButtons();

  std::unique_ptr<VenueTidy> tidy_;
  bool closes_ = false;  // as soon as the work has ended
  QLabel* doing_;
  QProgressBar* progress_;
  QWidget* choicePart_;
  std::map<pipeline::KeptPhotographs, Choice*> choices_;
  Note *incomplete_, *question_, *failure_, *stopped_;
  Remark* done_;
  QPushButton *close_, *back_, *primary_;
};

}  // namespace relucent::gui
