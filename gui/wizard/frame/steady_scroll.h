// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>
#include <QScrollArea>
#include <vector>

namespace relucent::gui {

/// A column that scrolls where the window is low. What comes and goes in it does not move what somebody
/// points at, or else has the focus, or else sees first: it is scrolled along with that. Each visit begins at
/// the top, where what matters most stands, and with what comes there, until somebody moves the pointer or
/// the focus.
class SteadyScroll : public QScrollArea {
 public:
  explicit SteadyScroll(QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void scrollContentsBy(int x, int y) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Seen {
    QPointer<QWidget> widget;
    QRect where;  // in the viewport
  };
  QRect placeOf(const QWidget& widget) const;
  void look();
  const Seen* anchor() const;

  std::vector<Seen> seen_;  // as the column stood last, from its top
  bool isHolding_ = false;
  QPoint pointer_;  // where it was when the visit began
  QPointer<QWidget> focus_;
};

}  // namespace relucent::gui
