// SPDX-License-Identifier: MIT
#include "wizard/output/output_view.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDropEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QShortcut>
#include <cmath>

#include "output/held_key.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/folding_rows.h"
#include "theme/readout.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/line_chart.h"
#include "views/number_text.h"
#include "wizard/devices/device_selector.h"
#include "wizard/output/output_inspector.h"
#include "wizard/output/playlist_view.h"

namespace relucent::gui {
namespace {

constexpr double worstDeltaE = 12.0;  // of the map
constexpr int foldedHeight = 260;     // of cards below each other: a picture that can be judged
constexpr double chartSeconds = 60.0, sampleSeconds = 0.5;
constexpr double legendRoom = 2.0;  // of the highest curve: the limit's words stand above all

/// The cards say so too.
QString whyNoShow(const OutputPage& page) {
  return page.isOpen() ? QString() : page.whatIsProjected();
}

/// Three figures, and the time of every frame in the last minute.
class PlaybackCard : public Card {
 public:
  explicit PlaybackCard(OutputPage& page) : Card(OutputPage::tr("Playback")), page_(page) {
    auto* row = new QHBoxLayout;
    row->setSpacing(space::gap);
    for (const auto& [readout, what] :
         {std::pair(&rate_, OutputPage::tr("frames a second")),
          std::pair(&time_, OutputPage::tr("frame time")), std::pair(&late_, OutputPage::tr("frames late")),
          std::pair(&live_, OutputPage::tr("arrival to light"))})
      row->addWidget(*readout = new Readout(what));
    row->addStretch(1);
    body()->addLayout(row);
    rate_->setObjectName("frame-rate");
    live_->setObjectName("live-delay");
    live_->setToolTip(
        OutputPage::tr("From a live picture's arrival at this computer until the projectors have it: the "
                       "longest of the last five seconds. The way there is not in it."));
    addAction(nextChart_ = toolOf(Icon::picture, OutputPage::tr("Next test chart (T)")));
    addAction(figures_ = toolOf(Icon::pulse, OutputPage::tr("Figures over the picture (O)")));
    nextChart_->setObjectName("next-chart");
    figures_->setObjectName("figures");
    figures_->setCheckable(true);
    OutputProjection& projection = page_.projection();
    connect(nextChart_, &QToolButton::clicked, &projection, &OutputProjection::nextChart);
    connect(figures_, &QToolButton::clicked, &projection,
            [&projection] { projection.setOverlay(!projection.hasOverlay()); });
    chart_ = new LineChart(axisOf(-chartSeconds, 0.0, OutputPage::tr("Seconds")),
                           axisOf(0.0, 20.0, OutputPage::tr("Frame time, ms")));
    chart_->setAccessibleName(OutputPage::tr("Frame times of the last minute"));
    body()->addWidget(chart_, 1);
    refreshOn(page_, this, [this] { refresh(); }, &OutputPage::progressChanged);
  }

 private:
  void refresh() {
    PlayerStatistics s = page_.projection().statistics();
    for (QToolButton* button : {nextChart_, figures_}) setPossible(button, whyNoShow(page_));
    figures_->setChecked(page_.projection().hasOverlay());
    bool open = page_.isOpen() && s.frames > 0, moves = s.framesPerSecond > 0.0;
    QString none = QString::fromUtf8("–");
    rate_->setValue(open && moves ? decimalText(s.framesPerSecond, 1) : none);
    time_->setValue(open && moves && s.frameSeconds > 0.0
                        ? OutputPage::tr("%1 ms").arg(decimalText(1000.0 * s.frameSeconds, 1))
                        : none);
    // A picture that stands is not late for anything.
    late_->setValue(open && moves ? countText(s.late) : none, moves && s.late > 0);
    const bool isLive = open && s.liveSeconds > 0.0;
    // In place of the frame time, which the chart tells: there is no room for four, and cards that fold as a
    // list changes between pictures and streams jump.
    live_->setVisible(isLive);
    time_->setVisible(!isLive);
    if (isLive) live_->setValue(OutputPage::tr("%1 ms").arg(decimalText(1000.0 * s.liveSeconds, 0)));
    setSubtitle(!open                          ? OutputPage::tr("closed")
                : moves || page_.livePlaying() ? OutputPage::tr("on %1").arg(engineText())
                                               : OutputPage::tr("still picture, on %1").arg(engineText()));
    charts::Curve curve{{}, "accent"};
    const std::deque<double>& times = page_.projection().frameTimes();
    double highest = 20.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      curve.line.push_back({-sampleSeconds * static_cast<double>(times.size() - 1 - i), times[i]});
      highest = std::max(highest, times[i]);
    }
    const charts::Curve most = limit(highest);
    chart_->setAxes(axisOf(-chartSeconds, 0.0, OutputPage::tr("Seconds")),
                    axisOf(0.0, legendRoom * highest, OutputPage::tr("Frame time, ms")));
    chart_->setCurves({curve, most});
  }
  /// What a picture may take at most, so that the display shows every one.
  charts::Curve limit(double& highest) const {
    charts::Curve line;
    if (!page_.isOpen() || !page_.chosen()) return line;
    const double rate = page_.screens()[*page_.chosen()].framesPerSecond;
    if (!(rate > 0.0)) return line;
    const double most = 1000.0 / rate;
    highest = std::max(highest, most);
    line.name = limitText(rate, most).toStdString();
    line.style = "amber";
    line.line = {{-chartSeconds, most}, {0.0, most}};
    return line;
  }
  static QString limitText(double rate, double milliseconds) {
    return OutputPage::tr("Limit for %1 frames a second: %2 ms")
        .arg(decimalText(rate, 0), decimalText(milliseconds, 1));
  }
  /// Nobody needs to know the instructions of a processor.
  QString engineText() const {
    const QString name = page_.projection().engineName();
    return name.startsWith("CPU") ? OutputPage::tr("the processor") : name;
  }
  OutputPage& page_;
  Readout *rate_, *time_, *late_, *live_;
  QToolButton *nextChart_, *figures_;
  LineChart* chart_;
};

/// What the projector shows, small; while its screen is unplugged it shows nothing.
class MirrorView : public ImageView {
 public:
  explicit MirrorView(OutputPage& page) : page_(page), projection_(page.projection()) {
    connect(&projection_, &OutputProjection::mirrored, this, &MirrorView::reflect);
    connect(&page_, &OutputPage::resultChanged, this, &MirrorView::reflect);
    reflect();
  }
  void reflect() {
    const QString missing = page_.isOpen() ? page_.missingScreen() : QString();
    const bool isCovered = page_.isCovered();
    setEmptyText(!missing.isEmpty()
                     ? OutputPage::tr("The screen %1 is unplugged. Nothing is projected.").arg(missing)
                 : isCovered ? OutputPage::tr("The light of another step is before the show.")
                             : page_.whatIsProjected());
    setPicture(missing.isEmpty() && !isCovered ? projection_.mirror() : QImage());
  }

 protected:
  // Nothing is scaled for a view that nobody sees.
  void showEvent(QShowEvent* event) override {
    ImageView::showEvent(event);
    projection_.watch(this, size() * devicePixelRatioF());
  }
  void resizeEvent(QResizeEvent* event) override {
    ImageView::resizeEvent(event);
    if (isVisible()) projection_.watch(this, size() * devicePixelRatioF());
  }
  void hideEvent(QHideEvent* event) override {
    ImageView::hideEvent(event);
    projection_.watch(this, {});
  }

 private:
  OutputPage& page_;
  OutputProjection& projection_;
};

/// Whether something is typed there. In the playlist a letter would choose what begins with it, while
/// somebody waits for the projector to go black.
bool acceptsText(const QWidget* widget) {
  return qobject_cast<const QLineEdit*>(widget) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(widget) != nullptr;
}

/// A closed list would choose what begins with the letter: a projector's screen, unseen.
bool wouldChoose(const QWidget* widget, const QKeyEvent& key) {
  const QString typed = key.text();
  const bool isTyped = (key.modifiers() & ~Qt::ShiftModifier) == Qt::NoModifier &&
                       key.key() != Qt::Key_Space && !typed.isEmpty() && typed.front().isPrint();
  return isTyped && qobject_cast<const QComboBox*>(widget) != nullptr;
}

/// Pictures beside each other. Wherever on the page the focus is, but where something is typed: A held shows
/// the original, B blackens, T shows test charts, O figures. While it has the focus itself, space freezes.
class OutputStage : public QWidget {
 public:
  explicit OutputStage(OutputPage& page) : page_(page) {
    setObjectName("output-stage");
    setAcceptDrops(true);
    auto* rows = new FoldingRows(this);
    rows->setFoldedHeight(foldedHeight);
    // Made in their order, in which Tab goes.
    Card *projector = projectorCard(), *photograph = photographCard(), *difference = differenceCard();
    rows->addRow({projector, photograph});
    rows->addRow({difference, new PlaybackCard(page_)});
    connect(new QShortcut(QKeySequence("Ctrl+Shift+V"), this), &QShortcut::activated, &page_,
            &OutputPage::verify);
    refreshOn(
        page_, this, [this] { refresh(); }, &OutputPage::settingsChanged, &OutputPage::resultChanged,
        &OutputPage::progressChanged);
    connect(&original_, &HeldKey::pressed, &page_, [this] { page_.setCompensated(false); });
    connect(&original_, &HeldKey::released, &page_, [this] { page_.setCompensated(true); });
    qApp->installEventFilter(this);
  }

 protected:
  /// Keys are told of in the action bar and the guide: they must not depend on what was clicked last.
  bool eventFilter(QObject* watched, QEvent* event) override {
    const bool isLeft = event->type() == QEvent::WindowDeactivate && watched == window();
    if (isLeft || (event->type() == QEvent::Hide && watched == this)) original_.take(*event);
    if ((event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) || !isVisible())
      return false;
    auto* key = static_cast<QKeyEvent*>(event);
    auto* widget = qobject_cast<QWidget*>(watched);
    if (widget == nullptr || widget->window() != window()) return false;
    const bool isOriginal = key->key() == Qt::Key_A;
    // Once it is down it goes up, whatever has come between.
    const bool isMeant = key->modifiers() == Qt::NoModifier && !acceptsText(QApplication::focusWidget());
    const bool isLetter = wouldChoose(QApplication::focusWidget(), *key);
    if (!isMeant && !(isOriginal && original_.isDown())) return isLetter;
    const bool isPressed = event->type() == QEvent::KeyPress, isRepeated = key->isAutoRepeat();
    if (isLetter && !isOriginal && !isSwitch(key->key())) return true;
    if (!isOriginal) return isPressed && (isRepeated ? isSwitch(key->key()) : act(key->key()));
    original_.take(*key);
    return true;
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) return page_.setFrozen(!page_.isFrozen());
    QWidget::keyPressEvent(event);
  }
  void dragEnterEvent(QDragEnterEvent* event) override {
    if (!draggedFiles(*event->mimeData()).isEmpty()) event->acceptProposedAction();
  }
  void dropEvent(QDropEvent* event) override { page_.addFiles(draggedFiles(*event->mimeData())); }

 private:
  static bool isSwitch(int key) { return key == Qt::Key_B || key == Qt::Key_T || key == Qt::Key_O; }
  /// False: the key does nothing here.
  bool act(int key) {
    if (key == Qt::Key_B) page_.setBlack(!page_.isBlack());
    if (key == Qt::Key_T) page_.projection().nextChart();
    if (key == Qt::Key_O) page_.projection().setOverlay(!page_.projection().hasOverlay());
    return isSwitch(key);
  }
  Card* projectorCard() {
    projector_ = new Card(OutputPage::tr("On the projector now"));
    compare_ = new Segmented({OutputPage::tr("Corrected"), OutputPage::tr("Original")});
    compare_->setObjectName("compare");
    projector_->addAction(compare_);
    // A row of its own: beside the title there is no room for it.
    projector_->body()->addWidget(new DeviceSelector(DeviceSelector::Kind::projector, page_, projector_));
    output_ = new MirrorView(page_);
    output_->setObjectName("output-view");
    output_->setAccessibleName(OutputPage::tr("What the projector shows"));
    output_->setAccessibleDescription(
        OutputPage::tr("Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O "
                       "figures."));
    output_->setToolTip(output_->accessibleDescription());
    projector_->body()->addWidget(output_, 1);
    connect(compare_, &Segmented::chosen, &page_, [this](int index) { page_.setCompensated(index == 0); });
    return projector_;
  }
  Card* photographCard() {
    photograph_ = new Card(OutputPage::tr("Photograph of the surface"));
    photograph_->addAction(new DeviceSelector(DeviceSelector::Kind::camera, page_, photograph_));
    photo_ = new ImageView;
    photo_->setObjectName("photograph-view");
    photo_->setLink(&link_);
    connect(&page_.session(), &Session::opened, &link_, &ViewLink::reset);
    photo_->setAccessibleName(
        OutputPage::tr("What was wanted at the left of the divider, the photograph at the right"));
    photo_->setEmptyText(OutputPage::tr("No verification photograph has been taken."));
    photograph_->body()->addWidget(photo_, 1);
    return photograph_;
  }
  Card* differenceCard() {
    auto* card = new Card(OutputPage::tr("Photograph against wanted"));
    card->setSubtitle(OutputPage::tr("colour difference"));
    difference_ = new ImageView;
    difference_->setObjectName("proof-difference");
    difference_->setLink(&link_);
    difference_->setAccessibleName(
        OutputPage::tr("Colour difference between the photograph and what was wanted"));
    difference_->setEmptyText(OutputPage::tr("A verification photograph shows here what is left to see."));
    difference_->setScale({ColourMap::cividis, 0.0, worstDeltaE, false}, QString::fromUtf8("ΔE₀₀"), false);
    card->body()->addWidget(difference_, 1);
    return card;
  }
  void refresh() {
    setPossible(compare_, whyNoShow(page_));
    compare_->setCurrent(page_.isCompensated() ? 0 : 1);
    output_->reflect();
    output_->setCaption(page_.figures());
    const std::shared_ptr<const Proof>& proof = page_.proof().proof();
    if (proof != shown_ || camera_ != page_.camera()) {
      shown_ = proof;
      camera_ = page_.camera();
      showProof();
    }
    photograph_->setSubtitle(takenText());
  }
  QString takenText() const {
    if (!shown_) return {};
    const QString when = QLocale().toString(shown_->taken.time(), QLocale::ShortFormat);
    QString taken = page_.proof().isOutOfDate() ? OutputPage::tr("taken %1, out of date").arg(when)
                                                : OutputPage::tr("taken %1").arg(when);
    // Of what is out of date nobody has to read which picture it was: there is no room for both.
    if (shown_->picture.isEmpty() || page_.proof().isOutOfDate()) return taken;
    return QString("%1, %2").arg(taken, isolated(OutputPlaylist::nameOf(shown_->picture)));
  }
  void showProof() {
    if (!shown_) {
      photo_->setPicture({});
      photo_->setCompared({}, {}, {});
      difference_->setPicture({});
      return;
    }
    const ProofView& view = shown_->view(camera_);
    photo_->setPicture(view.wanted);
    photo_->setCompared(view.photograph, OutputPage::tr("Wanted"), OutputPage::tr("Photograph"));
    ColourScale scale{ColourMap::cividis, 0.0, worstDeltaE, false};
    difference_->setPicture(mapped(view.deltaE.data(), view.deltaE.size(), scale));
    difference_->setReadout([proof = shown_, camera = camera_](QPoint pixel) {
      const float difference = proof->view(camera).deltaE.at(pixel.x(), pixel.y(), 0);
      return isolated(QString::fromUtf8("%1: ΔE %2")
                          .arg(placeText(pixel.x(), pixel.y()), numberText(static_cast<double>(difference))));
    });
  }

  OutputPage& page_;
  HeldKey original_{Qt::Key_A};
  ViewLink link_;
  Card *projector_, *photograph_;
  Segmented* compare_;
  MirrorView* output_;
  ImageView *photo_, *difference_;
  std::shared_ptr<const Proof> shown_;
  std::size_t camera_ = 0;  // of it
};

}  // namespace

PageView viewOf(OutputPage& page) {
  return {new OutputStage(page), outputInspector(page)};
}

}  // namespace relucent::gui
