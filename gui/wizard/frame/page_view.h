// SPDX-License-Identifier: MIT
#pragma once

#include <QVBoxLayout>
#include <QWidget>

namespace relucent {

/// What a page looks like: the stage, and beside it the inspector with what is decided and what came out.
/// Thin: it shows what its model knows and passes on what the user does.
struct PageView {
  QWidget* stage = nullptr;
  QWidget* inspector = nullptr;
};

/// The inspector's card, which scrolls where the window is low. Its contents go into the layout.
QWidget* inspectorCard(QVBoxLayout*& contents);

}  // namespace relucent
