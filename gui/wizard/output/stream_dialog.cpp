// SPDX-License-Identifier: MIT
#include "wizard/output/stream_dialog.h"

#include <algorithm>

#include "content/stream_address.h"
#include "relucent/base/error.h"
#include "text/message_text.h"

namespace relucent::gui {

StreamDialog::StreamDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Add a stream"));
  setObjectName("stream-dialog");
  setMinimumWidth(560);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(windowTitle(), "title"));
  column->addWidget(
      labelOf(tr("A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. "
                 "While it plays, this computer is connected to that address."),
              "note"));
  QLabel* name = labelOf(tr("Address"), "section");
  column->addWidget(name);
  address_ = new QLineEdit;
  address_->setObjectName("stream-address");
  address_->setAccessibleName(name->text());
  address_->setPlaceholderText("rtsp://192.168.1.70:554/live");
  // An address is read from left to right in every language.
  address_->setLayoutDirection(Qt::LeftToRight);
  name->setBuddy(address_);
  column->addWidget(address_);
  column->addWidget(labelOf(
      tr("User name and password stand before the host, as in rtsp://user:password@host. They are kept in "
         "the playlist, and shown nowhere."),
      "note"));
  column->addWidget(labelOf(tr("While it is lost"), "section"));
  hold_ = new Segmented({tr("Its last picture"), tr("Black")});
  hold_->setObjectName("stream-hold");
  hold_->setAccessibleName(tr("While it is lost"));
  hold_->setCurrent(0);
  column->addWidget(hold_);
  column->addWidget(wrong_ = new Note(Note::Kind::error));
  wrong_->setObjectName("stream-wrong");
  wrong_->hide();
  column->addStretch(1);
  column->addWidget(buttonRow());
  connect(address_, &QLineEdit::textChanged, wrong_, &QWidget::hide);
  connect(hold_, &Segmented::chosen, hold_, &Segmented::setCurrent);
  address_->setFocus();
}

QWidget* StreamDialog::buttonRow() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  QPushButton* cancel = buttonOf(tr("Cancel"));
  cancel->setObjectName("stream-cancel");
  QPushButton* add = buttonOf(tr("Add"), "primary");
  add->setObjectName("stream-add");
  add->setDefault(true);
  row->addWidget(cancel);
  row->addWidget(add);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(add, &QPushButton::clicked, this, &StreamDialog::add);
  return buttons;
}

void StreamDialog::add() {
  QString which = address_->text().trimmed();
  if (which.startsWith("stream:")) which.remove(0, 7);
  if (hold_->current() == 1 && !which.contains("#hold=")) which += "#hold=black";
  try {
    streamAddressFrom(which);
  } catch (const Error& error) {
    wrong_->setText(fullSentence(error.summary()), fullSentence(error.advice()));
    wrong_->show();
    // A dialog that is seen does not grow by itself.
    resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
    address_->setFocus();
    return;
  }
  Q_EMIT chosen("stream:" + which);
  accept();
}

}  // namespace relucent::gui
