// SPDX-License-Identifier: MIT
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include "wizard/frame/page_model.h"

class QLineEdit;

namespace relucent::gui {

/// What a page looks like: the stage, and beside it the inspector with what is decided and what came out.
/// Thin: it shows what its model knows and passes on what the user does.
struct PageView {
  QWidget* stage = nullptr;
  QWidget* inspector = nullptr;
};

/// Keeps a widget that is in no window yet from being seen as a window of its own while it is told to be
/// visible.
class NotYetSeen {
 public:
  explicit NotYetSeen(QObject* widget);
  ~NotYetSeen();
  NotYetSeen(const NotYetSeen&) = delete;
  NotYetSeen& operator=(const NotYetSeen&) = delete;

 private:
  QWidget* widget_;  // nullptr: it is in a window, or none at all
};

/// Refreshes now, and whenever one of these signals of the page comes.
template <typename Refresh, typename... Signals>
// NOLINTNEXTLINE(performance-unnecessary-value-param): a lambda may change what it holds
void refreshOn(PageModel& page, QObject* context, Refresh refresh, Signals... signal) {
  {
    const NotYetSeen notYet(context);
    refresh();
  }
  (QObject::connect(&page, signal, context, refresh), ...);
}

/// Gives the focus to the first of the region's widgets that takes it by Tab; false: none does.
bool focusFirst(QWidget* region);
/// This one rather than the first of its region.
void beginHere(QWidget* widget);
/// Scrolls what is round a widget until that is in sight.
void bringIntoSight(QWidget* widget);
/// Gives the focus to what the user can change there and scrolls it into sight, if it is on the page that is
/// seen.
void pointOut(QWidget* widget);

/// While nothing is being typed in the field of `widget`, or the field itself, undo is the page's.
void leaveUndoToThePage(QWidget* widget, QLineEdit* field);

/// The inspector's card, which scrolls where the window is low. Its contents go into the layout.
QWidget* inspectorCard(QVBoxLayout*& contents);

}  // namespace relucent::gui
