// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

/// A large figure with its caption below. Digits have a fixed width, so that nothing moves while they change.
class Readout : public QWidget {
  Q_OBJECT

 public:
  explicit Readout(const QString& what, QWidget* parent = nullptr);
  void setValue(const QString& value, bool warning = false);
  QString value() const { return value_; }
  QSize sizeHint() const override;
  /// Its figure in full; the caption may end in an ellipsis.
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString what_, given_, value_;
  bool warning_ = false;
};

}  // namespace relucent::gui
