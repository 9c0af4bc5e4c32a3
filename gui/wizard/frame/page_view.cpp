// SPDX-License-Identifier: MIT
#include "wizard/frame/page_view.h"

#include <QScrollArea>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent {

QWidget* inspectorCard(QVBoxLayout*& contents) {
  auto* card = new Card;
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* inside = new QWidget;
  contents = new QVBoxLayout(inside);
  contents->setContentsMargins(0, 0, 2, 0);
  contents->setSpacing(10);
  scroll->setWidget(inside);
  card->body()->addWidget(scroll);
  return card;
}

}  // namespace relucent
