// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <functional>

#include "theme/controls.h"

namespace relucent::gui {

/// Asks for a name, and says what is wrong with it while it is typed.
class NameDialog : public QDialog {
  Q_OBJECT

 public:
  struct Question {
    QString title, note, action;  // `action`: of the button
    QString begin{};              // what is written there at first
    QString present{};            // the name that it has, which is none to choose
    QString example{};
    /// What is wrong with what was typed; empty: nothing.
    std::function<QString(const QString& typed)> problem;
  };
  /// `objects`: what its parts' names begin with.
  NameDialog(const QString& objects, Question question, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// One that it can have.
  void chosen(const QString& name);

 private:
  QWidget* buttonRow(const QString& objects);
  void look();

  Question question_;
  QLineEdit* name_;
  Note* wrong_;
  QLabel* whyNot_ = nullptr;
  QPushButton* do_ = nullptr;
};

}  // namespace relucent::gui
