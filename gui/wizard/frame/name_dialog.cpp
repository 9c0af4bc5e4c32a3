// SPDX-License-Identifier: MIT
#include "wizard/frame/name_dialog.h"

#include <algorithm>
#include <utility>

#include "theme/action_button.h"

namespace relucent::gui {

NameDialog::NameDialog(const QString& objects, Question question, QWidget* parent)
    : QDialog(parent), question_(std::move(question)) {
  setWindowTitle(question_.title);
  setObjectName(objects + "-dialog");
  setMinimumWidth(480);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(question_.title, "title"));
  QLabel* name = labelOf(tr("Name"), "section");
  column->addWidget(name);
  column->addWidget(name_ = new QLineEdit(question_.begin));
  name_->setObjectName(objects + "-name");
  name_->setPlaceholderText(question_.example);
  name_->setAccessibleName(name->text());
  name->setBuddy(name_);
  column->addWidget(labelOf(question_.note, "note"));
  column->addWidget(wrong_ = new Note(Note::Kind::amber));
  wrong_->setObjectName(objects + "-wrong");
  column->addStretch(1);
  column->addWidget(buttonRow(objects));
  connect(name_, &QLineEdit::textChanged, this, &NameDialog::look);
  name_->selectAll();
  name_->setFocus();
  look();
}

QWidget* NameDialog::buttonRow(const QString& objects) {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(whyNot_ = labelOf({}, "note"), 1);
  whyNot_->setObjectName(objects + "-why-not");
  QPushButton* cancel = buttonOf(tr("Cancel"));
  cancel->setObjectName(objects + "-cancel");
  do_ = buttonOf(question_.action, "primary");
  do_->setObjectName(objects + "-do");
  do_->setDefault(true);
  row->addWidget(cancel);
  row->addWidget(do_);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(do_, &QPushButton::clicked, this, [this] {
    Q_EMIT chosen(name_->text().trimmed());
    accept();
  });
  return buttons;
}

void NameDialog::look() {
  const QString name = name_->text().trimmed(), problem = question_.problem(name_->text());
  wrong_->setVisible(!problem.isEmpty());
  wrong_->setText(problem);
  const QString whyNot = !problem.isEmpty()          ? problem
                         : name.isEmpty()            ? tr("Type a name.")
                         : name == question_.present ? tr("It has this name.")
                                                     : QString();
  setPossible(do_, whyNot);
  // What is wrong stands in a note of its own.
  whyNot_->setText(problem.isEmpty() ? whyNot : QString());
  // A dialog that is seen does not grow by itself.
  if (isVisible()) resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
}

}  // namespace relucent::gui
