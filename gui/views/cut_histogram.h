// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "relucent/charts/chart.h"

namespace relucent::gui {

/// Bars over a logarithmic axis with a cut between values that are dropped and values that are kept. The cut
/// is dragged, or moved by the arrow keys: 1 % of it a step, with Shift 10 %. Without a cut it is a plain bar
/// chart.
class CutHistogram : public QWidget {
  Q_OBJECT

 public:
  struct Bar {
    double from = 0.0, to = 0.0;
    double count = 0.0;
    std::optional<double> kept{};  // of them; none: all above the cut, nothing below it
  };

  explicit CutHistogram(charts::Axis x, const QString& countTitle, QWidget* parent = nullptr);
  void setBars(const std::vector<Bar>& bars);
  /// What is drawn: of what is kept, and of what is left out behind it.
  const std::vector<charts::Column>& columns() const { return chart_.columns; }
  void setAxis(const charts::Axis& x);
  void setMovable(bool movable) { movable_ = movable; }
  void setCutText(const QString& text);
  double cut() const { return cut_; }
  /// Emits no signal. NaN: none.
  void setCut(double cut);
  /// Where the cut's text stands, once it was painted: beside the cut, and whole.
  QRectF cutTag() const;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// Emitted while the user moves the cut.
  void cutMoved(double cut);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void dragTo(double x);
  void move(double cut);
  void paintCut(QPainter& painter) const;

  charts::Chart chart_;  // logarithmic counts
  QRectF plot_;
  double cut_;
  QString cutText_;
  bool movable_ = true;
  bool followsCut_ = true;  // nobody has said what is kept
};

}  // namespace relucent::gui
