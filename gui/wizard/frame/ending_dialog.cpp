// SPDX-License-Identifier: MIT
#include "wizard/frame/ending_dialog.h"

#include <QProgressBar>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent::gui {

EndingDialog::EndingDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("ending");
  setWindowTitle(tr("Ending"));
  setWindowFlag(Qt::WindowCloseButtonHint, false);
  setModal(true);
  setMinimumWidth(480);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(space::gap);
  column->addWidget(labelOf(tr("Ending…"), "title"));
  column->addWidget(labelOf(tr(
      "Everything that was measured is safe. The devices finish what they are doing, which can take half a "
      "minute; then this window closes by itself.")));
  auto* bar = new QProgressBar;
  bar->setRange(0, 0);
  bar->setTextVisible(false);
  bar->setAccessibleName(tr("Ending"));
  column->addWidget(bar);
}

}  // namespace relucent::gui
