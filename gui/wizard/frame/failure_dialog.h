// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>

#include "wizard/frame/page_model.h"

namespace relucent::gui {

/// What happened, what is safe, what to do; or a question, with what it would end. Esc and Close leave
/// everything as it is. It closes by itself once its reason is gone.
class FailureDialog : public QDialog {
  Q_OBJECT

 public:
  FailureDialog(const FailureReport& report, const QString& page, QWidget* parent = nullptr);
};

}  // namespace relucent::gui
