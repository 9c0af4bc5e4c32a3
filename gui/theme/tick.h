// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>

namespace relucent::gui {

/// A check box whose text wraps.
class Tick : public QCheckBox {
  Q_OBJECT

 public:
  explicit Tick(const QString& text, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  QSize sizeOf(const QString& text) const;
  QString inLines(int width) const;
  void fit();
  QString whole_;
};

}  // namespace relucent::gui
