// SPDX-License-Identifier: MIT
#include "wizard/venue/rename_dialog.h"

#include "wizard/venue/venue_keeping.h"

namespace relucent::gui {

RenameDialog::RenameDialog(const RecentVenue& venue, QWidget* parent) : QDialog(parent), venue_(venue) {
  setWindowTitle(tr("Rename a venue"));
  setObjectName("rename-dialog");
  setMinimumWidth(480);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(windowTitle(), "title"));
  QLabel* name = labelOf(tr("Name"), "section");
  column->addWidget(name);
  column->addWidget(name_ = new QLineEdit(venue.name));
  name_->setObjectName("rename-name");
  name_->setAccessibleName(name->text());
  name->setBuddy(name_);
  column->addWidget(labelOf(
      tr("Its folder has the same name and is renamed with it. A show that starts at log-in follows."),
      "note"));
  column->addWidget(wrong_ = new Note(Note::Kind::amber));
  wrong_->setObjectName("rename-wrong");
  column->addStretch(1);
  column->addWidget(buttonRow());
  connect(name_, &QLineEdit::textChanged, this, &RenameDialog::look);
  name_->selectAll();
  name_->setFocus();
  look();
}

QWidget* RenameDialog::buttonRow() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  QPushButton* cancel = buttonOf(tr("Cancel"));
  cancel->setObjectName("rename-cancel");
  rename_ = buttonOf(tr("Rename"), "primary");
  rename_->setObjectName("rename-do");
  rename_->setDefault(true);
  row->addWidget(cancel);
  row->addWidget(rename_);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(rename_, &QPushButton::clicked, this, [this] {
    Q_EMIT chosen(name_->text().trimmed());
    accept();
  });
  return buttons;
}

void RenameDialog::look() {
  const QString problem = VenueKeeping::nameProblem(venue_, name_->text());
  wrong_->setVisible(!problem.isEmpty());
  wrong_->setText(problem);
  rename_->setEnabled(problem.isEmpty() && name_->text().trimmed() != venue_.name);
  // A dialog that is seen does not grow by itself.
  if (isVisible()) resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
}

}  // namespace relucent::gui
