// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QGridLayout>
#include <QMouseEvent>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>
#include <map>
#include <optional>

#include "theme/controls.h"
#include "wizard/frame/wizard.h"

namespace relucent::gui {

/// Back; the time or a reason, of every action here that is not possible; secondary actions; the one primary
/// action, named by its verb. Where the window
/// is narrow, time or reason stand in a row of their own above. While a page is shown its buttons do not
/// become narrower, so that none moves under the pointer; and the second click of a double click is only for
/// what the first one was for: where that has made room for another action, it does nothing.
class ActionBar : public QFrame {
  Q_OBJECT

 public:
  explicit ActionBar(Wizard& wizard, QWidget* parent = nullptr);
  /// Triggers the primary command if it is enabled.
  void runPrimary();
  /// The primary command has the focus; false if it is not possible now.
  bool focusPrimary();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void refreshSecondary(const std::vector<PageCommand*>& commands);
  QString hintText(const PageModel& page) const;
  void arrange();
  void keepWidth(QPushButton& button, const PageCommand& command);
  bool isMeantForAnother(const QPushButton& button, const QMouseEvent& press);
  Wizard& wizard_;
  QProgressBar* progress_;
  QPushButton *back_, *primary_;
  QPushButton* remedy_;  // leads to where what the hint asks for is done
  QWidget* reason_;
  QLabel* hint_;
  QGridLayout* grid_;
  QWidget* secondary_;
  std::vector<QPushButton*> buttons_;
  std::vector<QPointer<PageCommand>> commands_;
  const PageModel* shown_ = nullptr;
  std::map<const PageCommand*, int> widths_;  // of the page that is shown
  /// The last press on a button of the bar.
  struct Press {
    quint64 when = 0;  // milliseconds
    QRect where;       // of the button, on the desktop
    QString words;     // that stood on it
  };
  std::optional<Press> press_;
};

}  // namespace relucent::gui
