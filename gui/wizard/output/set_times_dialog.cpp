// SPDX-License-Identifier: MIT
#include "wizard/output/set_times_dialog.h"

#include <QComboBox>
#include <QLineEdit>
#include <QLocale>
#include <QVBoxLayout>
#include <algorithm>

#include "theme/action_button.h"
#include "theme/controls.h"

namespace relucent::gui {

namespace {

/// As people write it, or none.
QTime timeOf(const QString& text) {
  for (const QString& format :
       {QLocale().timeFormat(QLocale::ShortFormat), QString("H:mm"), QString("H.mm"), QString("H")})
    if (const QTime time = QLocale().toTime(text.trimmed(), format); time.isValid()) return time;
  return {};
}

}  // namespace

SetTimesDialog::SetTimesDialog(const QStringList& sets, const QList<SetTime>& times, QWidget* parent)
    : QDialog(parent), times_(times) {
  setWindowTitle(tr("Sets by the time of the day"));
  setObjectName("set-times-dialog");
  setMinimumWidth(480);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(windowTitle(), "title"));
  column->addWidget(labelOf(
      tr("From each time on the installed show plays that set, every day, until the next time."), "note"));
  column->addWidget(list_ = new QListWidget);
  list_->setObjectName("set-times-list");
  list_->setAccessibleName(windowTitle());
  column->addWidget(addRow(sets));
  column->addWidget(buttonRow());
  connect(list_, &QListWidget::currentRowChanged, this, &SetTimesDialog::look);
  refresh();
}

QWidget* SetTimesDialog::addRow(const QStringList& sets) {
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  // A line, which is typed over as a whole; an editor of hours and minutes is not.
  from_ = new QLineEdit(QLocale().toString(QTime(18, 0), QLocale::ShortFormat));
  from_->setObjectName("set-time");
  from_->setAccessibleName(tr("From this time on"));
  set_ = new QComboBox;
  set_->setObjectName("set-of-time");
  set_->setAccessibleName(tr("Set"));
  set_->addItems(sets);
  QPushButton* add = buttonOf(tr("Add"));
  add->setObjectName("add-set-time");
  remove_ = buttonOf(tr("Remove"));
  remove_->setObjectName("remove-set-time");
  row->addWidget(from_);
  row->addWidget(set_, 1);
  row->addWidget(add);
  row->addWidget(remove_);
  const auto lookAtTime = [this, add] {
    setPossible(add, timeOf(from_->text()).isValid()
                         ? QString()
                         : tr("Type a time of the day, such as %1.")
                               .arg(QLocale().toString(QTime(18, 0), QLocale::ShortFormat)));
  };
  connect(from_, &QLineEdit::textChanged, this, lookAtTime);
  lookAtTime();
  // Of one time there is one set.
  connect(add, &QPushButton::clicked, this, [this] {
    const SetTime added{timeOf(from_->text()), set_->currentText()};
    times_.removeIf([&](const SetTime& time) { return time.from == added.from; });
    times_.append(added);
    refresh();
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    if (list_->currentRow() >= 0) times_.removeAt(list_->currentRow());
    refresh();
  });
  return line;
}

QWidget* SetTimesDialog::buttonRow() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  QPushButton* cancel = buttonOf(tr("Cancel"));
  cancel->setObjectName("set-times-cancel");
  QPushButton* keep = buttonOf(tr("Apply"), "primary");
  keep->setObjectName("set-times-do");
  keep->setDefault(true);
  row->addWidget(cancel);
  row->addWidget(keep);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(keep, &QPushButton::clicked, this, [this] {
    Q_EMIT chosen(times_);
    accept();
  });
  return buttons;
}

void SetTimesDialog::refresh() {
  std::ranges::sort(times_, {}, &SetTime::from);
  list_->clear();
  for (const SetTime& time : times_)
    list_->addItem(tr("%1: %2").arg(QLocale().toString(time.from, QLocale::ShortFormat), time.set));
  // One is always chosen, so that the empty list alone stands against removing.
  if (list_->count() > 0) list_->setCurrentRow(0);
  look();
}

void SetTimesDialog::look() {
  setPossible(remove_, list_->currentRow() >= 0 ? QString() : tr("There are no times yet."));
}

}  // namespace relucent::gui
