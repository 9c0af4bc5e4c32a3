// SPDX-License-Identifier: MIT
#pragma once

#include "theme/controls.h"
#include "wizard/preview/preview_page.h"

namespace relucent::gui {

class MethodsTable;

/// What is said beside a method, among `rows` that are compared.
QString noteOf(compensation::Method method, const std::vector<MethodPreview>& rows);

/// What each method makes of the content; the one that is clicked is used. Where there is little height, it
/// is the picture's, and the comparison is unfolded by a button.
class MethodsCard : public Card {
  Q_OBJECT

 public:
  explicit MethodsCard(PreviewPage& page, QWidget* parent = nullptr);

  /// Room for it is short: only its title is there until somebody wants to compare.
  void setFoldable(bool foldable);
  bool isFolded() const { return foldable_ && !unfolded_; }

 private:
  void arrange();
  QString chosenText() const;
  void choose(int row);
  void refresh();

  PreviewPage& page_;
  MethodsTable* table_;
  QPushButton* unfold_;
  bool foldable_ = false, unfolded_ = false;
};

}  // namespace relucent::gui
