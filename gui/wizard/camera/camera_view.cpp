// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_view.h"

#include <QGridLayout>
#include <QLocale>
#include <QPainter>
#include <QProgressBar>
#include <QStackedWidget>
#include <bit>
#include <cmath>
#include <functional>

#include "theme/accessible_role.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/image_view.h"
#include "views/line_chart.h"
#include "views/number_text.h"
#include "wizard/camera/camera_choice_view.h"
#include "wizard/camera/checks_view.h"
#include "wizard/camera/pixel_use_view.h"
#include "wizard/devices/device_selector.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/session/device_label.h"

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

/// The more projectors, the brighter.
QColor overlapColour(std::size_t projectors, std::size_t of) {
  return qtColourAt(ColourMap::viridis, static_cast<double>(projectors) / static_cast<double>(of));
}

QImage overlapPicture(const std::vector<std::uint32_t>& lit, Size size, std::size_t projectors) {
  QImage picture(size.width, size.height, QImage::Format_RGB32);
  picture.fill(invalidColour);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const Pixel pixel = pixelAt(size, i);
    if (lit[i] != 0)
      picture.setPixelColor(pixel.x, pixel.y,
                            overlapColour(static_cast<std::size_t>(std::popcount(lit[i])), projectors));
  }
  return picture;
}

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

/// What one camera sees, with what its hatches mean below it.
class CameraTile : public QFrame {
 public:
  std::function<void(QPoint)> focusWanted;

  CameraTile(CameraPage& model, std::size_t camera) : model_(model), camera_(camera) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    view_ = new ImageView;
    view_->setObjectName(camera == 0 ? QString("camera-view") : QString("camera-view-%1").arg(camera + 1));
    view_->setScaleBar(true);
    column->addWidget(view_, 1);
    // Where there are several, each has a line of its own.
    line_ = new QWidget;
    auto* words = new QHBoxLayout(line_);
    words->setContentsMargins(0, 0, 0, 0);
    words->addWidget(name_ = labelOf({}, "strong"));
    words->addWidget(facts_ = elidedLabel("note"), 1);
    column->addWidget(line_);
    column->addWidget(legend_ = labelOf({}, "note"));
    legend_->setTextFormat(Qt::RichText);
    legend_->hide();
    connect(&view_->link(), &ViewLink::picked, this, [this] {
      if (auto pick = view_->link().pick(); pick && focusWanted) focusWanted(*pick);
    });
    connect(&model_.session(), &Session::opened, this, [this] { view_->link().setPick(std::nullopt); });
  }

  void show(bool hasPeaks, bool isOverlap, bool isAlone) {
    const QString name = cameraLabel(model_.session(), camera_);
    line_->setVisible(!isAlone);
    name_->setText(name);
    const bool isShown = !isAlone && camera_ == model_.camera();
    setRole(name_, isShown ? "strong" : "note");
    view_->setAccessibleName(isAlone ? CameraPage::tr("What the camera sees now")
                                     : CameraPage::tr("What %1 sees now").arg(name));
    if (isOverlap && camera_ < model_.rigCoverage().litBy.size()) return showOverlap();
    const std::optional<CameraLook>& look = model_.look(camera_);
    legend_->hide();
    view_->setAccessibleDescription({});
    if (!look) {
      view_->setPicture({});
      facts_->setWhole({});
      view_->setEmptyText(model_.isLooking() ? model_.stage()
                                             : CameraPage::tr("The camera is not being looked through."));
      return;
    }
    view_->setPicture(pictureOf(look->frame.signal, 1.0f));
    view_->setOverlay(overlayOf(*look, model_.focusArea(camera_), hasPeaks));
    QStringList facts;
    if (look->check.tooBright > 0.0)
      facts << CameraPage::tr("Too bright %1").arg(percentText(look->check.tooBright));
    if (look->check.tooDark > 0.0)
      facts << CameraPage::tr("Too dark %1").arg(percentText(look->check.tooDark));
    if (model_.focus(camera_) > 0.0)
      facts << CameraPage::tr("Focus %1").arg(percentText(model_.focus(camera_)));
    facts_->setWhole(QLocale().createSeparatedList(facts));
  }

 private:
  /// Where how many projectors shine on each other.
  void showOverlap() {
    const linearization::RigCoverage& coverage = model_.rigCoverage();
    const std::vector<std::uint32_t>& lit = coverage.litBy[camera_];
    const std::optional<CameraLook>& look = model_.look(camera_);
    if (!look || look->frame.signal.pixels() != lit.size()) return;
    view_->setOverlay({});
    view_->setPicture(overlapPicture(lit, look->frame.signal.size(), coverage.coverages.size()));
    facts_->setWhole({});
    const std::vector<double> overlaps = coverage.overlaps(camera_);
    QStringList words, coloured;
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
      if (!(overlaps[i] > 0.0005)) continue;
      words << CameraPage::tr("%n projector(s): %1", nullptr, static_cast<int>(i + 1))
                   .arg(percentText(overlaps[i]));
      coloured << QString::fromUtf8("<span style=\"color:%1\">■</span>&nbsp;%2")
                      .arg(overlapColour(i + 1, overlaps.size()).name(), words.back().toHtmlEscaped());
    }
    // Below each other: in some languages lines would break within entries.
    legend_->setText(coloured.join("<br>"));
    legend_->setAccessibleName(words.join(QString::fromUtf8(", ")));
    legend_->setVisible(!words.isEmpty());
    view_->setAccessibleDescription(words.join(QString::fromUtf8(", ")));
  }

  CameraPage& model_;
  std::size_t camera_;
  ImageView* view_;
  QWidget* line_;
  QLabel* name_;
  ElidedLabel* facts_;
  QLabel* legend_;
};

/// Cameras side by side, in as even a grid as there are.
class CameraStage : public Card {
 public:
  explicit CameraStage(CameraPage& model) : Card(CameraPage::tr("Camera view")), model_(model) {
    auto* tiles = new QWidget;
    grid_ = new QGridLayout(tiles);
    grid_->setContentsMargins(0, 0, 0, 0);
    body()->addWidget(tiles, 1);
    // What the hatches mean.
    for (auto [label, role, name] :
         {std::tuple(&bright_, "amber", "too-bright"), std::tuple(&dark_, "information", "too-dark")}) {
      addAction(*label = labelOf({}, role));
      (*label)->setObjectName(name);
      (*label)->setWordWrap(false);
      (*label)->hide();
    }
    addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, this));
    kind_ = new Segmented({CameraPage::tr("Light"), CameraPage::tr("Overlap")});
    kind_->setObjectName("camera-overlap");
    connect(kind_, &Segmented::chosen, this, [this] { refresh(); });
    addAction(kind_);
    peaks_ = new Tick(CameraPage::tr("Mark what is sharp"));
    peaks_->setObjectName("focus-peaks");
    connect(peaks_, &Tick::toggled, this, [this] { refresh(); });
    addAction(peaks_);
    refreshOn(
        model_, this, [this] { refresh(); }, &CameraPage::settingsChanged, &CameraPage::resultChanged,
        &CameraPage::progressChanged);
  }

 private:
  void moveArea(std::size_t camera, QPoint to) {
    model_.showCamera(camera);
    if (isOverlap()) return;
    image::Region area = model_.focusArea();
    area.x = to.x() - area.width / 2;
    area.y = to.y() - area.height / 2;
    model_.setFocusArea(area);
  }
  bool isOverlap() const { return kind_->isVisibleTo(this) && kind_->current() == 1; }
  /// As many tiles as there are cameras; they stay while that does.
  void arrange() {
    if (tiles_.size() == model_.cameras()) return;
    for (CameraTile* tile : tiles_) delete tile;
    tiles_.clear();
    const auto cameras = static_cast<int>(model_.cameras());
    const int across = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cameras))));
    for (int i = 0; i < cameras; ++i) {
      auto* tile = new CameraTile(model_, static_cast<std::size_t>(i));
      tile->focusWanted = [this, i](QPoint to) { moveArea(static_cast<std::size_t>(i), to); };
      tiles_.push_back(tile);
      grid_->addWidget(tile, i / across, i % across);
    }
  }
  void refresh() {
    arrange();
    const bool isAlone = tiles_.size() == 1;
    kind_->setVisible(model_.projectors() > 1 && !model_.rigCoverage().litBy.empty());
    for (CameraTile* tile : tiles_) tile->show(peaks_->isChecked(), isOverlap(), isAlone);
    const std::optional<CameraLook>& look = model_.look();
    bright_->setVisible(isAlone && look && look->check.tooBright > 0.0);
    dark_->setVisible(isAlone && look && look->check.tooDark > 0.0);
    if (!look) return setSubtitle({});
    setSubtitle(isOverlap() ? CameraPage::tr("how many projectors light each place")
                : model_.isLooking()
                    ? CameraPage::tr("exposure %1, click to judge focus").arg(exposureText(secondsOf(*look)))
                    : CameraPage::tr("as it was seen last, exposure %1").arg(exposureText(secondsOf(*look))));
    bright_->setText(CameraPage::tr("Too bright %1").arg(percentText(look->check.tooBright)));
    dark_->setText(CameraPage::tr("Too dark %1").arg(percentText(look->check.tooDark)));
  }
  /// As it was chosen: what a camera grants differs a little, and would be another number than the button's.
  double secondsOf(const CameraLook& look) const {
    const std::vector<double> chosen = model_.exposures();
    return look.exposure && *look.exposure < chosen.size() ? chosen[*look.exposure] : look.frame.seconds;
  }

  CameraPage& model_;
  QGridLayout* grid_;
  std::vector<CameraTile*> tiles_;
  QLabel *bright_, *dark_;
  Segmented* kind_;
  Tick* peaks_;
};

class CameraInspector {
 public:
  static QWidget* make(CameraPage& model) {
    QVBoxLayout* column = nullptr;
    QWidget* card = inspectorCard(column);
    // First what is looked at while somebody turns the lens or aims, and what stands against going on.
    auto* focus = new ValueRow(CameraPage::tr("Focus"));
    auto* meter = new FocusMeter;
    column->addWidget(focus);
    column->addWidget(meter);
    QLabel* advice =
        labelOf(CameraPage::tr("Turn the lens until the bar stays at the mark: the best so far."), "note");
    column->addWidget(advice);
    QFrame* line = lineOf();
    column->addWidget(line);
    column->addWidget(checksPart(model));
    column->addWidget(consentWidget(model));  // they are what it is for
    column->addWidget(lineOf());
    QLabel* exposuresTitle = labelOf(CameraPage::tr("Exposures"), "section");
    column->addWidget(exposuresTitle);
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
    column->addWidget(labelOf(CameraPage::tr("Light in this exposure: red, green, blue"), "section"));
    auto* histogram = new LineChart(axisOf(0.0, 1.0, CameraPage::tr("Signal")), {1.0, 1e4, true, {}});
    histogram->setFixedHeight(150);
    histogram->setMark(0.97);
    column->addWidget(histogram);
    column->addWidget(pixelUseView(model));
    column->addStretch(1);

    auto refresh = [&model, histogram, focus, meter, advice, line, group, exposuresTitle] {
      // Where nothing is looked at before somebody agrees, what asks for it is in sight in the lowest window.
      const bool isAwaited = !model.isLooking() && !model.session().mayMeasure();
      for (QWidget* part : std::initializer_list<QWidget*>{focus, meter, advice, line})
        part->setVisible(!isAwaited);
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
      // What is too bright to be judged by looks sharp.
      meter->setValue(model.isFocusJudged() ? model.focus() : 0.0);
      const std::vector<double> exposures = model.exposures();
      const bool isPaused = seen && !model.isKept() && !model.mayChooseExposure();
      exposuresTitle->setText(model.isKept() ? CameraPage::tr("Exposures, kept")
                              : isPaused     ? CameraPage::tr("Exposures, paused")
                                             : CameraPage::tr("Exposures"));
      for (int i = 0; i < 4; ++i) {
        bool used = static_cast<std::size_t>(i) < exposures.size();
        group->button(i)->setVisible(used);
        setPossible(group->button(i), model.mayChooseExposure(),
                    CameraPage::tr("Check again to look with another one."));
        if (used) group->button(i)->setText(exposureText(exposures[static_cast<std::size_t>(i)]));
        if (used) group->button(i)->setChecked(static_cast<std::size_t>(i) == model.exposure());
      }
    };
    refreshOn(model, card, refresh, &CameraPage::settingsChanged, &CameraPage::resultChanged,
              &CameraPage::statusChanged);
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
