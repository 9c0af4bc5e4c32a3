// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_view.h"

#include <QLabel>
#include <QLocale>
#include <QTime>
#include <cmath>
#include <vector>

#include "relucent/base/time_left.h"
#include "text/message_text.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_plan_view.h"
#include "wizard/acquire/acquire_watch_view.h"
#include "wizard/acquire/block_sizes_view.h"
#include "wizard/acquire/outlook_view.h"
#include "wizard/devices/device_selector.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/devices/nudge_dialog.h"

namespace relucent::gui {
namespace {

/// Cards beside each other, whose titles take two lines where one is too long.
class PictureRow : public QWidget {
 public:
  PictureRow() : row_(new QHBoxLayout(this)) {
    row_->setContentsMargins(0, 0, 0, 0);
    row_->setSpacing(space::gap);
  }
  void add(QWidget* card) {
    row_->addWidget(card, 1);
    // The first in it is its title.
    titles_.push_back(card->findChild<QLabel*>());
  }
  QSize minimumSizeHint() const override {
    constexpr int leastCard = 150;
    const int cards = static_cast<int>(titles_.size());
    return {cards * leastCard + (cards - 1) * space::gap, row_->totalMinimumSize().height()};
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QWidget::resizeEvent(event);
    wrapTitles();
  }
  /// A selector may have come or gone.
  bool event(QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) wrapTitles();
    return QWidget::event(event);
  }

 private:
  void wrapTitles() {
    const int cards = static_cast<int>(titles_.size());
    const int room = (width() - (cards - 1) * space::gap) / cards - 2 * (space::card + space::small);
    for (QLabel* title : titles_) {
      // Beside it a device may be chosen.
      const auto* selector = title->parentWidget()->findChild<DeviceSelector*>();
      const bool isChosen = selector != nullptr && !selector->isHidden();
      const int beside = isChosen ? selector->sizeHint().width() + space::small : 0;
      const bool wraps = title->fontMetrics().horizontalAdvance(title->text()) > room - beside;
      if (title->wordWrap() != wraps) title->setWordWrap(wraps);
    }
  }

  QHBoxLayout* row_;
  std::vector<QLabel*> titles_;
};

/// What goes out and what comes back while it measures.
QWidget* livePart(AcquirePage& model) {
  auto* part = new PictureRow;
  auto* sent = new Card(AcquirePage::tr("Sent to the projector"));
  auto* seen = new Card(AcquirePage::tr("Seen by the camera"));
  auto* pattern = new ImageView;
  auto* photograph = new ImageView;
  pattern->setObjectName("pattern-view");
  photograph->setObjectName("photograph-view");
  pattern->setAccessibleName(AcquirePage::tr("Pattern that the projector shows"));
  photograph->setAccessibleName(AcquirePage::tr("Last photograph"));
  for (ImageView* view : {pattern, photograph}) view->setMinimumHeight(leastPictureHeight);
  sent->body()->addWidget(pattern, 1);
  seen->body()->addWidget(photograph, 1);
  sent->addAction(new DeviceSelector(DeviceSelector::Kind::projector, model, sent));
  seen->addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, seen));
  for (QWidget* card : std::initializer_list<QWidget*>{sent, seen, outlookCard(model)}) part->add(card);
  auto refresh = [&model, part, pattern, photograph, seen] {
    part->setVisible(model.isMeasuring());
    LivePictures live = model.pictures();
    // The last ones of another step say nothing here.
    if (!model.isMeasuring() && model.trace().seconds() <= 0.0) {
      for (ImageView* view : {pattern, photograph}) view->setPicture({});
      return seen->setSubtitle({});
    }
    const bool isUnplugged = model.session().projectorWithoutScreen() == model.projector();
    const bool isDark = model.isPaused() || model.isDiskFull() || isUnplugged;
    const QString none = model.isReading() ? AcquirePage::tr("Kept photographs are read first.")
                         : isDark          ? AcquirePage::tr("Nothing is being projected.")
                                           : QString();
    for (ImageView* view : {pattern, photograph}) view->setEmptyText(none);
    if (model.isReading())
      for (ImageView* view : {pattern, photograph}) view->setPicture({});
    if (live.photographs == 0 || live.pattern.empty() || model.isReading()) return;
    // What was shown last is dark by now.
    pattern->setPicture(isDark ? QImage() : encodedPictureOf(live.pattern));
    photograph->setPicture(pictureOf(live.frame.signal, 1.0f));
    seen->setSubtitle(exposureText(live.frame.seconds));
  };
  refreshOn(model, part, refresh, &AcquirePage::progressChanged, &AcquirePage::settingsChanged,
            &AcquirePage::resultChanged);
  return part;
}

QWidget* stageOf(AcquirePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  column->addWidget(floodlightCard(model), 1);
  column->addWidget(livePart(model), 1);
  column->addWidget(blockSizesCard(model));
  column->addWidget(traceCard(model));
  return stage;
}

/// How long it still takes; held up, that stands still.
QString timeText(const AcquirePage& model) {
  if (model.isStopping() && !model.isPaused()) return AcquirePage::tr("Ending");
  const std::optional<double> seconds = model.secondsLeft();
  const bool isPaused = model.isPaused() || model.isDiskFull();
  if (!seconds)
    return isPaused               ? AcquirePage::tr("Paused")
           : model.isHeldUp()     ? AcquirePage::tr("Waiting")
           : model.isReading()    ? AcquirePage::tr("Reading")
           : model.isWorkingOut() ? AcquirePage::tr("Working out the result")
                                  : AcquirePage::tr("Measuring");
  const bool isShort = isUnderAMinute(*seconds);
  const QString left = text(expectedDuration(*seconds));
  if (model.isReading() && !isPaused)
    return isShort ? AcquirePage::tr("Reading, under a minute left")
                   : AcquirePage::tr("Reading, about %1 left").arg(left);
  if (isPaused)
    return isShort ? AcquirePage::tr("Paused, under a minute left")
                   : AcquirePage::tr("Paused, about %1 left").arg(left);
  if (model.isHeldUp())
    return isShort ? AcquirePage::tr("Waiting, under a minute left")
                   : AcquirePage::tr("Waiting, about %1 left").arg(left);
  return isShort ? AcquirePage::tr("Under a minute left") : AcquirePage::tr("About %1 left").arg(left);
}

/// What is done now, and when all of it ends.
QString stageText(const AcquirePage& model) {
  if (model.isReading()) {
    const PatternCount read = model.reading();
    return AcquirePage::tr("Reading the photographs of %n pattern(s): %1.", nullptr, read.expected)
        .arg(percentText(static_cast<double>(read.taken) / read.expected));
  }
  QString stage = model.stage();
  const std::optional<double> seconds = model.secondsLeft();
  // Of what ends within a minute, minutes would say nothing.
  if (!seconds || model.isHeldUp() || model.isStopping() || isUnderAMinute(*seconds)) return stage;
  const QTime end = QTime::currentTime().addSecs(static_cast<int>(*seconds));
  return AcquirePage::tr("Ends near %1. %2").arg(QLocale().toString(end, QLocale::ShortFormat), stage);
}

/// While it goes on: how long, how fast.
QWidget* runOf(AcquirePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  QLabel* left = labelOf({}, "readout");
  QLabel* counts = labelOf({}, "note");
  column->addWidget(left);
  column->addWidget(counts);
  column->addWidget(outlookPart(model));
  column->addWidget(lineOf());
  auto* patterns = new ValueRow(AcquirePage::tr("Patterns"));
  auto* photographs = new ValueRow(AcquirePage::tr("Photographs"));
  auto* disk = new ValueRow(AcquirePage::tr("Disk still needed"));
  for (ValueRow* row : {patterns, photographs, disk}) column->addWidget(row);
  column->addWidget(lineOf());
  column->addWidget(watchPart(model));
  auto refresh = [&model, left, counts, patterns, photographs, disk] {
    if (!model.isMeasuring()) return;
    left->setText(timeText(model));
    counts->setText(stageText(model));
    const PatternCount count = model.patterns();
    const QString taken = countText(static_cast<std::uint64_t>(count.taken));
    const QString expected = countText(static_cast<std::uint64_t>(count.expected));
    patterns->setValue(count.taken < count.expected ? AcquirePage::tr("%1 of about %2").arg(taken, expected)
                                                    : taken);
    const QString photographed = countText(static_cast<std::uint64_t>(model.photographs()));
    const std::optional<double> rate = model.photographsAMinute();
    photographs->setValue(rate ? AcquirePage::tr("%1, %2 a minute").arg(photographed, decimalText(*rate, 0))
                               : photographed);
    if (const auto& work = model.forecast()) disk->setValue(bytesText(work->diskBytes));
  };
  refreshOn(model, part, refresh, &AcquirePage::progressChanged, &AcquirePage::resultChanged);
  return part;
}

QWidget* inspectorOf(AcquirePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  QWidget* plan = planOf(model);
  QWidget* run = runOf(model);
  // Above the fold: nothing is measured without it.
  column->addWidget(consentWidget(model));
  column->addWidget(plan);
  column->addWidget(run);
  column->addStretch(1);
  auto refresh = [&model, plan, run] {
    plan->setVisible(!model.isMeasuring());
    run->setVisible(model.isMeasuring());
  };
  refreshOn(model, card, refresh, &AcquirePage::resultChanged);
  return card;
}

}  // namespace

PageView viewOf(AcquirePage& model) {
  PageView view{stageOf(model), inspectorOf(model)};
  QObject::connect(&model, &AcquirePage::nudgeWanted, view.stage, [&model, stage = view.stage] {
    showNudge(
        *stage, std::make_unique<Nudge>(model.session(), model.viewBefore()),
        [&model](const Nudge& nudge) { model.askAgain(nudge.sight() && nudge.sight()->isAtItsPlace()); });
  });
  return view;
}

}  // namespace relucent::gui
