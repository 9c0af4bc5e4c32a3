// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_view.h"

#include <QPainter>
#include <QPointer>
#include <QScrollArea>
#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "views/view_actions.h"
#include "wizard/devices/device_selector.h"
#include "wizard/preview/mask_view.h"
#include "wizard/preview/methods_card.h"
#include "wizard/preview/preview_inspector.h"

namespace relucent::gui {
namespace {

/// Hatches where the content cannot be reached, and its corners. Finer than the picture, so that lines stay
/// thin.
QImage hatchesOf(const ViewPreview& preview) {
  constexpr int fine = 4;
  Size size = preview.with.size();
  QImage overlay(size.width * fine, size.height * fine, QImage::Format_ARGB32_Premultiplied);
  overlay.fill(Qt::transparent);
  for (int y = 0; y < overlay.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(overlay.scanLine(y));
    for (int x = 0; x < overlay.width(); ++x) {
      std::size_t at = indexOf(size, {x / fine, y / fine});
      if (preview.inside[at] != 0 && preview.reachable[at] == 0 && (x + y) % 8 < 3)
        line[x] = colours(Look::dark).text.rgb();
    }
  }
  QPainter painter(&overlay);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!preview.corners) return overlay;
  QPolygonF outline;
  for (const auto& corner : *preview.corners) outline.append(QPointF(corner[0], corner[1]) * fine);
  painter.setPen(QPen(colours(Look::dark).accent, 3.0));
  painter.drawPolygon(outline);
  return overlay;
}

constexpr int leastHeight = 260;  // of its card: a picture that can be judged

enum Shown { picture, reachable, difference, uncertainty, contradiction };

class PreviewStage : public QWidget {
 public:
  explicit PreviewStage(PreviewPage& page) : page_(page) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(space::gap);
    card_ = new Card(PreviewPage::tr("Audience view"));
    card_->setMinimumHeight(leastHeight);
    kind_ = new Segmented({PreviewPage::tr("Picture"), PreviewPage::tr("Reachable light"),
                           PreviewPage::tr("Difference"), PreviewPage::tr("Uncertainty"),
                           PreviewPage::tr("Contradiction")});
    kind_->setObjectName("preview-kind");
    kind_->foldIntoList(PreviewPage::tr("What of it is shown"));
    card_->addAction(new DeviceSelector(DeviceSelector::Kind::camera, page_, card_));
    card_->addAction(kind_);
    views_ = {place_ = new MaskView, new ImageView, new ImageView, new ImageView, new ImageView};
    for (ImageView* view : views_) {
      view->setLink(&link_);
      view->setEmptyText(PreviewPage::tr("Preparing the preview"));
      card_->body()->addWidget(view, 1);
      view->hide();
    }
    views_[picture]->show();
    views_[picture]->setObjectName("preview-view");
    views_[picture]->setAccessibleName(
        PreviewPage::tr("What the audience will see, uncorrected at the left of the divider and "
                        "corrected at the right"));
    views_[reachable]->setAccessibleName(PreviewPage::tr(
        "The brightest light that can be reached; hatched where the content is out of reach"));
    views_[difference]->setAccessibleName(
        PreviewPage::tr("Colour difference between what is wanted and what is predicted"));
    views_[uncertainty]->setAccessibleName(
        PreviewPage::tr("How far the light may be from what is predicted, by the measurement's noise"));
    views_[contradiction]->setAccessibleName(
        PreviewPage::tr("How much worse a view is because of what the other views ask for"));
    views_[contradiction]->setEmptyText(PreviewPage::tr("Comparing the views"));
    addViewMenu(
        *card_, [this] { return shownView(); },
        [this](const Failure& failure) {
          Q_EMIT page_.failed({failure, PreviewPage::tr("What is measured is safe.")});
        });
    connect(place_, &CornerView::moved, &page_, &PreviewPage::setCorners);
    connectMasks();
    column->addWidget(card_, 1);
    column->addWidget(methods_ = new MethodsCard(page_));
    connect(kind_, &Segmented::chosen, this, [this](int index) {
      for (std::size_t i = 0; i < views_.size(); ++i)
        views_[i]->setVisible(i == static_cast<std::size_t>(index));
    });
    refreshOn(page_, this, [this] { refresh(); }, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    for (QWidget* around = parentWidget(); around != nullptr && !room_; around = around->parentWidget())
      if (const auto* scroll = qobject_cast<const QScrollArea*>(around)) room_ = scroll->viewport();
    if (room_) room_->installEventFilter(this);
    leaveRoomForThePicture();
  }
  void resizeEvent(QResizeEvent* event) override {
    QWidget::resizeEvent(event);
    leaveRoomForThePicture();
  }
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize) leaveRoomForThePicture();
    return QWidget::eventFilter(watched, event);
  }

 private:
  /// By what is in sight of the stage, which is higher where it scrolls.
  void leaveRoomForThePicture() {
    constexpr int roomForBoth = 540;  // 300 for the picture
    methods_->setFoldable((room_ ? room_->height() : height()) < roomForBoth);
  }
  /// What is looked at, and its numbers.
  ShownView shownView() const {
    const auto index = static_cast<std::size_t>(kind_->current());
    std::function<image::Image()> values;
    const auto of = [preview = shown_, camera = camera_]() -> const ViewPreview& {
      return preview->views[camera];
    };
    if (shown_ && index == reachable) values = [of] { return image::Image(of().with.size(), 1, of().reach); };
    if (shown_ && index == difference) values = [of] { return of().deltaE; };
    if (shown_ && index == uncertainty)
      values = [of] { return image::Image(of().with.size(), 1, of().uncertainty); };
    if (shown_ && index == contradiction && contradiction_)
      values = [found = contradiction_, camera = camera_] { return found->worse[camera]; };
    if (shown_ && index == picture) values = [of] { return of().with; };
    static constexpr std::array units{"camera signal per second", "of white", "CIEDE2000", "of white",
                                      "CIEDE2000"};
    return {*views_[index], {values, units[index]}};
  }
  std::size_t shownCamera() const {
    return page_.preview() ? std::min(page_.camera(), page_.preview()->views.size() - 1) : 0;
  }
  /// What the hatches say.
  QString legend() const {
    const double missing = 1.0 - shown_->views[camera_].reachableShare;
    return missing < 0.0005 ? PreviewPage::tr("All of it can be reached")
                            : PreviewPage::tr("Hatched: %1 cannot be reached").arg(percentText(missing));
  }
  /// The masks of the shown view, by their numbers among all.
  std::vector<std::size_t> masksInView() const {
    std::vector<std::size_t> numbers;
    for (std::size_t mask = 0; mask < page_.masks().masks().size(); ++mask)
      if (page_.masks().masks()[mask].camera == page_.camera()) numbers.push_back(mask);
    return numbers;
  }
  void connectMasks() {
    MaskEditing& editing = page_.masks();
    const auto number = [this](int mask) { return masksInView().at(static_cast<std::size_t>(mask)); };
    connect(place_, &MaskView::closed, this,
            [this, &editing](const MaskView::Points& points) { editing.add(page_.camera(), points); });
    connect(place_, &MaskView::cancelled, &editing, &MaskEditing::cancel);
    connect(place_, &MaskView::pointsMoved, this,
            [&editing, number](int mask, const MaskView::Points& points) {
              editing.setPoints(number(mask), points);
            });
    connect(place_, &MaskView::removed, this, [&editing, number](int mask) { editing.remove(number(mask)); });
    connect(place_, &MaskView::picked, this, [&editing, number](int mask) {
      editing.choose(mask < 0 ? std::nullopt : std::optional(number(mask)));
    });
    connect(&editing, &MaskEditing::changed, this, [this, &editing] {
      // It is drawn on the picture, which may not be what is looked at.
      if (editing.isDrawing() && !place_->isDrawing()) {
        if (kind_->current() != picture) {
          kind_->setCurrent(picture);
          Q_EMIT kind_->chosen(picture);
        }
        place_->setFocus(Qt::OtherFocusReason);
      }
      showMasks();
    });
  }
  void showMasks() {
    const MaskEditing& editing = page_.masks();
    std::vector<compensation::Mask> masks;
    int chosen = -1;
    for (const std::size_t number : masksInView()) {
      if (editing.chosen() == number) chosen = static_cast<int>(masks.size());
      masks.push_back(editing.masks()[number]);
    }
    place_->setMasks(masks, chosen);
    place_->setDrawing(editing.isDrawing(), editing.outline());
  }
  void refresh() {
    showMasks();
    place_->setWrong(!page_.problem().isEmpty());
    // Where nothing is going to come, why.
    for (Shown kind : {picture, reachable, difference, uncertainty})
      views_[kind]->setEmptyText(page_.problem().isEmpty() ? PreviewPage::tr("Preparing the preview")
                                                           : page_.problem());
    place_->setCorners(page_.corners());
    const auto& preview = page_.preview();
    offer(contradiction, page_.cameras() > 1);
    // Of an import nothing is known of errors.
    if (preview) offer(uncertainty, !preview->views.front().uncertainty.empty());
    if (preview == shown_ && contradiction_ == page_.contradiction() &&
        (!preview || camera_ == shownCamera()))
      return;
    shown_ = preview;
    contradiction_ = page_.contradiction();
    if (preview) camera_ = shownCamera();
    if (!preview) {
      for (ImageView* view : views_) view->setPicture({});
      return;
    }
    const ViewPreview& view = preview->views[camera_];
    Size size = view.with.size();
    views_[picture]->setPicture(pictureOf(view.without, preview->white));
    views_[picture]->setCompared(pictureOf(view.with, preview->white), uncorrectedText(),
                                 page_.settings().method == compensation::Method::none
                                     ? PreviewPage::tr("Uncorrected, too")
                                     : PreviewPage::tr("Corrected, predicted"));
    divideContent(view);
    ColourScale reach{ColourMap::viridis, 0.02, 4.0, true};
    views_[reachable]->setScale(reach, PreviewPage::tr("of white"), true);
    views_[reachable]->setPicture(mapped(view.reach, size, reach));
    views_[reachable]->setOverlay(hatchesOf(view));
    views_[reachable]->setCaption(legend());
    ColourScale deltaE{ColourMap::cividis, 0.0, 12.0, false};
    views_[difference]->setScale(deltaE, QString::fromUtf8("ΔE₀₀"), false);
    views_[difference]->setPicture(mapped(view.deltaE.data(), size, deltaE));
    views_[difference]->setReadout([preview, camera = camera_](QPoint pixel) {
      const float difference = preview->views[camera].deltaE.at(pixel.x(), pixel.y(), 0);
      return isolated(QString::fromUtf8("%1: ΔE %2")
                          .arg(placeText(pixel.x(), pixel.y()), numberText(static_cast<double>(difference))));
    });
    showUncertainty(view);
    showContradiction();
  }
  /// What was measured in blocks is drawn in them, uncorrected as well.
  QString uncorrectedText() const {
    const int blocks = page_.session().stoppedAt();
    return blocks > 1 ? PreviewPage::tr("Uncorrected, in blocks of %1 px").arg(blocks)
                      : PreviewPage::tr("Uncorrected");
  }

  /// Wherever the content is placed, both halves of it are to be seen at first.
  void divideContent(const ViewPreview& view) {
    if (!view.corners || std::exchange(divided_, view.corners) == view.corners) return;
    const auto [left, right] = std::ranges::minmax(*view.corners | std::views::elements<0>);
    views_[picture]->divideWithin(left, right);
  }
  void offer(Shown kind, bool isOffered) {
    kind_->setOffered(kind, isOffered);
    if (isOffered || kind_->current() != kind) return;
    kind_->setCurrent(picture);
    Q_EMIT kind_->chosen(picture);
  }
  void showUncertainty(const ViewPreview& view) {
    if (view.uncertainty.empty()) {
      views_[uncertainty]->setPicture({});
      return;
    }
    const ColourScale scale{ColourMap::viridis, 0.001, 0.2, true};
    views_[uncertainty]->setScale(scale, PreviewPage::tr("of white"), true);
    views_[uncertainty]->setPicture(mapped(view.uncertainty, view.with.size(), scale));
    views_[uncertainty]->setCaption(
        PreviewPage::tr("95 of 100 pixels come within the value shown, on average %1 of white")
            .arg(marginText(view.uncertaintyMean)));
  }
  void showContradiction() {
    ImageView* view = views_[contradiction];
    if (!contradiction_ || camera_ >= contradiction_->worse.size()) {
      view->setPicture({});
      view->setReadout({});
      return;
    }
    const image::Image& worse = contradiction_->worse[camera_];
    ColourScale scale{ColourMap::cividis, 0.0, 10.0, false};
    view->setScale(scale, QString::fromUtf8("ΔE₀₀"), false);
    view->setPicture(mapped(worse.data(), worse.size(), scale));
    view->setCaption(PreviewPage::tr("Visibly worse because of other views: %1")
                         .arg(percentText(contradiction_->shares[camera_])));
    view->setReadout([found = contradiction_, camera = camera_](QPoint pixel) {
      const float much = found->worse[camera].at(pixel.x(), pixel.y(), 0);
      return isolated(QString::fromUtf8("%1: ΔE %2")
                          .arg(placeText(pixel.x(), pixel.y()), numberText(static_cast<double>(much))));
    });
  }

  PreviewPage& page_;
  ViewLink link_;
  Card* card_;
  Segmented* kind_;
  MaskView* place_;
  std::array<ImageView*, 5> views_{};
  MethodsCard* methods_;
  QPointer<QWidget> room_;
  std::shared_ptr<const ContentPreview> shown_;
  std::shared_ptr<const compensation::Contradiction> contradiction_;  // of it
  std::size_t camera_ = 0;                                            // of it
  std::optional<compensation::Corners> divided_;  // the place that the divider was moved to, if at all
};

}  // namespace

PageView viewOf(PreviewPage& page) {
  return {new PreviewStage(page), previewInspector(page)};
}

}  // namespace relucent::gui
