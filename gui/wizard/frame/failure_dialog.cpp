// SPDX-License-Identifier: MIT
#include "wizard/frame/failure_dialog.h"

#include <QClipboard>
#include <QGuiApplication>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

QString headingOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::device:
      return FailureDialog::tr("A device did not do what was asked");
    case ErrorKind::disk:
      return FailureDialog::tr("The disk did not do what was asked");
    case ErrorKind::memory:
      return FailureDialog::tr("The memory is full");
    case ErrorKind::format:
      return FailureDialog::tr("A file cannot be read");
    case ErrorKind::usage:
    case ErrorKind::input:
      return FailureDialog::tr("This cannot be done as it is");
    case ErrorKind::numerics:
      break;
  }
  return FailureDialog::tr("The computation failed");
}

}  // namespace

FailureDialog::FailureDialog(const FailureReport& report, const QString& page, QWidget* parent)
    : QDialog(parent) {
  QString heading =
      report.failure.heading.isEmpty() ? headingOf(report.failure.kind) : report.failure.heading;
  setObjectName("failure");
  setWindowTitle(heading);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  // A minimum width of the dialog itself would take the place of what the buttons need.
  column->addStrut(504);
  column->setSpacing(8);
  auto* top = new QHBoxLayout;
  top->addWidget(report.isPutRight   ? new IconLabel(Icon::tick, goodColour, 32)
                 : report.isQuestion ? new IconLabel(Icon::warning, amberColour, 32)
                                     : new IconLabel(Icon::failed, errorColour, 32),
                 0, Qt::AlignTop);
  auto* titles = new QVBoxLayout;
  titles->addWidget(labelOf(heading, "title"));
  titles->addWidget(labelOf(page, "note"));
  top->addLayout(titles, 1);
  column->addLayout(top);
  auto part = [&](const QString& title, const QString& text) {
    if (text.isEmpty()) return;
    column->addSpacing(8);
    column->addWidget(labelOf(title, "strong"));
    column->addWidget(labelOf(text));
  };
  part(report.endsWork     ? tr("What it ends")
       : report.isQuestion ? tr("What happens")
                           : tr("What happened"),
       report.failure.what);
  part(tr("What is safe"), report.safe);
  part(tr("What to do"), report.failure.advice);
  column->addSpacing(16);
  auto* row = new QHBoxLayout;
  QPushButton* copy = buttonOf(tr("Copy details"), "flat");
  copy->setVisible(!report.failure.details.isEmpty());
  connect(copy, &QPushButton::clicked, this,
          [details = report.failure.details] { QGuiApplication::clipboard()->setText(details); });
  row->addWidget(copy);
  row->addStretch(1);
  QPushButton* first = nullptr;
  auto action = [&](PageCommand* command, const char* role) {
    if (command == nullptr) return;
    QPushButton* button = buttonOf(command->text(), role);
    connect(button, &QPushButton::clicked, command, [this, command] {
      accept();
      command->trigger();
    });
    row->addWidget(first = button);
  };
  action(report.repair, "");
  action(report.keep, "");
  action(report.goOn, "");
  if (report.resume == nullptr) {
    QPushButton* close = buttonOf(tr("Close"), "primary");
    connect(close, &QPushButton::clicked, this, &QDialog::accept);
    row->addWidget(first = close);
  }
  action(report.resume, "primary");
  column->addLayout(row);
  if (report.reason) connect(report.reason, &QObject::destroyed, this, &QDialog::reject);
  first->setDefault(true);
  first->setFocus();
}

}  // namespace relucent::gui
