// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>

#include "relucent/pipeline/sets.h"
#include "theme/controls.h"

namespace relucent::gui {

/// Asks for the name of a set: of a new one, or another one of that in use.
class SetNameDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Kind { save, rename };
  SetNameDialog(Kind kind, const pipeline::TargetSets& sets, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// One that it can have.
  void chosen(const QString& name);

 private:
  QWidget* buttonRow(const QString& text);
  void look();

  pipeline::TargetSets sets_;
  QLineEdit* name_;
  Note* wrong_;
  QPushButton* do_ = nullptr;
};

}  // namespace relucent::gui
