// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QPushButton>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// The banner of the current page, if it has one.
class BannerBar : public QWidget {
  Q_OBJECT

 public:
  explicit BannerBar(Wizard& wizard, QWidget* parent = nullptr);

 private:
  void refresh();
  Wizard& wizard_;
  QFrame* frame_;
  IconLabel* icon_;
  QLabel *sentence_, *more_;
  QPushButton* button_;
};

}  // namespace relucent::gui
