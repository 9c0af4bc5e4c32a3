// SPDX-License-Identifier: MIT
#include "wizard/frame/stage_scroll.h"

#include <QEvent>
#include <QLayout>
#include <algorithm>

namespace relucent::gui {
namespace {

/// Has no layout of its own, which would pass on how high the stage likes to be at a width.
class Held : public QWidget {
 public:
  explicit Held(QWidget* stage) : stage_(stage) { stage->setParent(this); }

  QSize sizeHint() const override { return minimumSizeHint(); }
  /// Of the width that the scroll area gives.
  QSize minimumSizeHint() const override {
    QSize least = stage_->minimumSizeHint().expandedTo(stage_->minimumSize());
    const QLayout* layout = stage_->layout();
    if (layout == nullptr || !layout->hasHeightForWidth() || parentWidget() == nullptr) return least;
    const int width = std::max(least.width(), parentWidget()->width());
    return {least.width(), std::max(stage_->minimumHeight(), layout->minimumHeightForWidth(width))};
  }

 protected:
  void resizeEvent(QResizeEvent*) override { stage_->resize(size()); }
  bool event(QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) updateGeometry();
    return QWidget::event(event);
  }

 private:
  QWidget* stage_;
};

}  // namespace

QScrollArea* stageScroll(QWidget* stage) {
  auto* scroll = new QScrollArea;
  scroll->setObjectName("stage");
  scroll->setWidgetResizable(true);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(new Held(stage));
  return scroll;
}

}  // namespace relucent::gui
