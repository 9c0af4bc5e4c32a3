// SPDX-License-Identifier: MIT
#include "wizard/preview/set_name_dialog.h"

#include <algorithm>

#include "text/message_text.h"

namespace relucent::gui {

SetNameDialog::SetNameDialog(Kind kind, const pipeline::TargetSets& sets, QWidget* parent)
    : QDialog(parent), sets_(sets) {
  setWindowTitle(kind == Kind::save ? tr("Save as a set") : tr("Rename a set"));
  setObjectName("set-dialog");
  setMinimumWidth(480);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(windowTitle(), "title"));
  QLabel* name = labelOf(tr("Name"), "section");
  column->addWidget(name);
  column->addWidget(
      name_ = new QLineEdit(kind == Kind::rename ? QString::fromStdString(sets.nameInUse()) : QString()));
  name_->setObjectName("set-name");
  name_->setPlaceholderText(tr("Day, night, school class"));
  name_->setAccessibleName(name->text());
  name->setBuddy(name_);
  column->addWidget(
      labelOf(kind == Kind::save
                  ? tr("What you see becomes this set, and is changed in it from now on.")
                  : tr("Playlists and controllers that call it by its present name have to be changed, too."),
              "note"));
  column->addWidget(wrong_ = new Note(Note::Kind::amber));
  wrong_->setObjectName("set-wrong");
  column->addStretch(1);
  column->addWidget(buttonRow(kind == Kind::save ? tr("Save") : tr("Rename")));
  connect(name_, &QLineEdit::textChanged, this, &SetNameDialog::look);
  name_->selectAll();
  name_->setFocus();
  look();
}

QWidget* SetNameDialog::buttonRow(const QString& text) {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  QPushButton* cancel = buttonOf(tr("Cancel"));
  cancel->setObjectName("set-cancel");
  do_ = buttonOf(text, "primary");
  do_->setObjectName("set-do");
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

void SetNameDialog::look() {
  const std::string name = name_->text().trimmed().toStdString();
  QString problem;
  if (const Message wrong = pipeline::problemOfSetName(name); !wrong.empty() && !name.empty())
    problem = fullSentence(wrong);
  else if (std::ranges::count(sets_.all, name, &pipeline::TargetSet::name) > 0 && name != sets_.nameInUse())
    problem = tr("There is a set of this name already.");
  wrong_->setVisible(!problem.isEmpty());
  wrong_->setText(problem);
  do_->setEnabled(problem.isEmpty() && !name.empty() && name != sets_.nameInUse());
  // A dialog that is seen does not grow by itself.
  if (isVisible()) resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
}

}  // namespace relucent::gui
