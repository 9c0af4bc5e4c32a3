// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_view.h"

#include <QPainter>
#include <QProgressBar>
#include <QStackedWidget>

#include "theme/accessible_role.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/image_view.h"
#include "views/line_chart.h"
#include "views/number_text.h"
#include "wizard/camera/camera_choice_view.h"
#include "wizard/camera/checks_view.h"
#include "wizard/camera/pixel_use_view.h"

namespace relucent::gui {
namespace {

/// Marks what is sharp.
void paintPeaks(QPainter& painter, const image::Image& signal, int fine) {
  const std::vector<std::uint8_t> peaks = image::focusPeaks(signal);
  const QColor colour = colours(Look::dark).accent;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const Pixel pixel = pixelAt(signal.size(), i);
    if (peaks[i] != 0) painter.fillRect(pixel.x * fine, pixel.y * fine, fine, fine, colour);
  }
}

/// Hatches over what is too bright (amber) and too dark (blue, the other slope), the focus area round its
/// pixels; where it is sharp, if that is wanted. Drawn finer than the photograph, so that stripes stay
/// stripes.
QImage overlayOf(const CameraLook& look, const image::Region& area, bool hasPeaks) {
  constexpr int fine = 4;
  Size size = look.frame.signal.size();
  QImage overlay(size.width * fine, size.height * fine, QImage::Format_ARGB32_Premultiplied);
  overlay.fill(Qt::transparent);
  QRgb amber = colours(Look::dark).amber.rgb(), blue = colours(Look::dark).information.rgb();
  for (int y = 0; y < overlay.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(overlay.scanLine(y));
    for (int x = 0; x < overlay.width(); ++x) {
      image::Exposed exposed = look.check.exposed[indexOf(size, {x / fine, y / fine})];
      if (exposed == image::Exposed::tooBright && (x + y) % 8 < 4) line[x] = amber;
      if (exposed == image::Exposed::tooDark && (x - y + (1 << 20)) % 8 < 4) line[x] = blue;
    }
  }
  QPainter painter(&overlay);
  if (hasPeaks) paintPeaks(painter, look.frame.signal, fine);
  for (auto [colour, width] :
       {std::pair(colours(Look::dark).picture, 6.0), std::pair(colours(Look::dark).text, 3.0)}) {
    painter.setPen(QPen(colour, width));
    painter.drawRect(QRectF(area.x * fine, area.y * fine, area.width * fine, area.height * fine));
  }
  return overlay;
}

std::vector<charts::Curve> histogramOf(const image::PhotographCheck& check) {
  std::vector<charts::Curve> curves;
  constexpr std::array styles{"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) {
    charts::Curve curve{{}, styles[c]};
    for (std::size_t i = 0; i < image::PhotographCheck::bins; ++i)
      curve.line.push_back({(static_cast<double>(i) + 0.5) / image::PhotographCheck::bins,
                            1.0 + static_cast<double>(check.histogram[c][i])});
    curves.push_back(std::move(curve));
  }
  return curves;
}

double tallest(const image::PhotographCheck& check) {
  std::uint32_t most = 10;
  for (const auto& channel : check.histogram)
    most = std::max(most, *std::max_element(channel.begin(), channel.end()));
  return static_cast<double>(most) * 2.0;
}

/// Of the best so far: what noise alone takes away is no fault of the lens.
constexpr double goodFocus = 0.9;

class FocusMeter : public QWidget {
 public:
  FocusMeter() {
    setFixedHeight(24);
    setAccessibleRole(this, QAccessible::ProgressBar);
  }
  void setValue(double value) {
    value_ = value;
    setAccessibleName(CameraPage::tr("Focus, %1 of best").arg(percentText(value)));
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    QRectF bar(0, 7, width() - 2.0, 10);
    painter.setBrush(colours().line);
    painter.drawRoundedRect(bar, 3, 3);
    painter.setBrush(value_ > goodFocus ? colours().good : colours().amber);
    painter.drawRoundedRect(QRectF(bar.left(), bar.top(), bar.width() * value_, bar.height()), 3, 3);
    // Nothing was best before anything was seen.
    if (!(value_ > 0.0)) return;
    painter.setPen(QPen(colours().text, 2.0));
    painter.drawLine(QPointF(bar.right(), 1), QPointF(bar.right(), 23));
  }

 private:
  double value_ = 0.0;
};

/// Where nothing but full light is seen, nothing can be sharp.
QString focusText(const CameraPage& model) {
  return model.isFocusJudged() ? percentText(model.focus()) : CameraPage::tr("too bright to tell");
}

class CameraStage : public Card {
 public:
  explicit CameraStage(CameraPage& model) : Card(CameraPage::tr("Camera view")), model_(model) {
    view_ = new ImageView;
    view_->setObjectName("camera-view");
    view_->setAccessibleName(CameraPage::tr("What the camera sees now"));
    view_->setScaleBar(true);
    body()->addWidget(view_, 1);
    // What the hatches mean.
    for (auto [label, role, name] :
         {std::tuple(&bright_, "amber", "too-bright"), std::tuple(&dark_, "information", "too-dark")}) {
      addAction(*label = labelOf({}, role));
      (*label)->setObjectName(name);
      (*label)->setWordWrap(false);
      (*label)->hide();
    }
    peaks_ = new Tick(CameraPage::tr("Mark what is sharp"));
    peaks_->setObjectName("focus-peaks");
    connect(peaks_, &Tick::toggled, this, [this] { refresh(); });
    addAction(peaks_);
    connect(&view_->link(), &ViewLink::picked, this, [this] {
      if (auto pick = view_->link().pick()) moveArea(*pick);
    });
    refreshOn(
        model_, this, [this] { refresh(); }, &CameraPage::settingsChanged, &CameraPage::resultChanged,
        &CameraPage::progressChanged);
  }

 private:
  void moveArea(QPoint to) {
    image::Region area = model_.focusArea();
    area.x = to.x() - area.width / 2;
    area.y = to.y() - area.height / 2;
    model_.setFocusArea(area);
  }
  void refresh() {
    if (!model_.look()) {
      view_->setPicture({});
      setSubtitle({});
      bright_->hide();
      dark_->hide();
      view_->setEmptyText(model_.isLooking() ? model_.stage()
                                             : CameraPage::tr("The camera is not being looked through."));
      return;
    }
    const CameraLook& look = *model_.look();
    setSubtitle(CameraPage::tr("exposure %1. Click where the focus is to be judged.")
                    .arg(exposureText(look.frame.seconds)));
    bright_->setVisible(look.check.tooBright > 0.0);
    bright_->setText(CameraPage::tr("Too bright %1").arg(percentText(look.check.tooBright)));
    dark_->setVisible(look.check.tooDark > 0.0);
    dark_->setText(CameraPage::tr("Too dark %1").arg(percentText(look.check.tooDark)));
    view_->setPicture(pictureOf(look.frame.signal, 1.0f));
    view_->setOverlay(overlayOf(look, model_.focusArea(), peaks_->isChecked()));
  }
  CameraPage& model_;
  ImageView* view_;
  QLabel *bright_, *dark_;
  Tick* peaks_;
};

class CameraInspector {
 public:
  static QWidget* make(CameraPage& model) {
    QVBoxLayout* column = nullptr;
    QWidget* card = inspectorCard(column);
    column->addWidget(labelOf(CameraPage::tr("Light in this exposure: red, green, blue"), "section"));
    auto* histogram = new LineChart(axisOf(0.0, 1.0, CameraPage::tr("Signal")), {1.0, 1e4, true, {}});
    histogram->setFixedHeight(150);
    histogram->setMark(0.97);
    column->addWidget(histogram);
    column->addWidget(lineOf());
    auto* focus = new ValueRow(CameraPage::tr("Focus"));
    auto* meter = new FocusMeter;
    column->addWidget(focus);
    column->addWidget(meter);
    QLabel* best =
        labelOf(CameraPage::tr("Turn the lens until the bar stays at the mark: the best so far."), "note");
    column->addWidget(best);
    column->addWidget(lineOf());
    column->addWidget(labelOf(CameraPage::tr("Exposures"), "section"));
    auto* buttons = new QHBoxLayout;
    column->addLayout(buttons);
    auto* group = new QButtonGroup(card);
    for (int i = 0; i < 4; ++i) {
      QPushButton* button = buttonOf({}, "segment");
      button->setCheckable(true);
      group->addButton(button, i);
      buttons->addWidget(button);
    }
    QObject::connect(group, &QButtonGroup::idClicked, &model,
                     [&model](int id) { model.chooseExposure(static_cast<std::size_t>(id)); });
    column->addWidget(pixelUseView(model));
    column->addWidget(lineOf());
    column->addWidget(checksPart(model));
    column->addStretch(1);

    auto refresh = [&model, histogram, focus, meter, group] {
      bool seen = model.look().has_value();
      if (seen) {
        histogram->setAxes(axisOf(0.0, 1.0, CameraPage::tr("Signal, share of full")),
                           {1.0, tallest(model.look()->check), true, CameraPage::tr("Pixels").toStdString()});
        histogram->setCurves(histogramOf(model.look()->check));
      } else {
        histogram->setCurves({});  // of another venue
      }
      const bool isKnown = seen && (model.focus() > 0.0 || !model.isFocusJudged());
      focus->setValue(isKnown ? focusText(model) : QString::fromUtf8("–"));
      meter->setValue(model.focus());
      const std::vector<double> exposures = model.exposures();
      for (int i = 0; i < 4; ++i) {
        bool used = static_cast<std::size_t>(i) < exposures.size();
        group->button(i)->setVisible(used);
        group->button(i)->setEnabled(!model.isKept());
        if (used) group->button(i)->setText(exposureText(exposures[static_cast<std::size_t>(i)]));
        if (used) group->button(i)->setChecked(static_cast<std::size_t>(i) == model.exposure());
      }
    };
    refreshOn(model, card, refresh, &CameraPage::settingsChanged, &CameraPage::resultChanged);
    return card;
  }
};

}  // namespace

PageView viewOf(CameraPage& model) {
  auto* stages = new QStackedWidget;
  stages->addWidget(new CameraStage(model));
  stages->addWidget(cameraChoice(model));
  auto refresh = [&model, stages] { stages->setCurrentIndex(model.needsCamera() ? 1 : 0); };
  refreshOn(model, stages, refresh, &CameraPage::resultChanged);
  return {stages, CameraInspector::make(model)};
}

}  // namespace relucent::gui
