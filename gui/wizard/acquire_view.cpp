// SPDX-License-Identifier: MIT
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/acquire_page.h"
#include "wizard/acquire_watch_view.h"
#include "wizard/device_selector.h"
#include "wizard/flash_consent.h"
#include "wizard/page_view.h"

namespace relucent {
namespace {

QWidget* stageOf(AcquirePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* row = new QHBoxLayout;
  row->setSpacing(space::gap);
  column->addLayout(row, 1);
  column->addWidget(traceCard(model));
  auto* sent = new Card(AcquirePage::tr("Sent to the projector"));
  auto* seen = new Card(AcquirePage::tr("Seen by the camera"));
  auto* pattern = new ImageView;
  auto* photograph = new ImageView;
  pattern->setObjectName("pattern-view");
  photograph->setObjectName("photograph-view");
  pattern->setAccessibleName(AcquirePage::tr("Pattern that the projector shows"));
  photograph->setAccessibleName(AcquirePage::tr("Last photograph"));
  for (ImageView* view : {pattern, photograph})
    view->setEmptyText(
        AcquirePage::tr("Appears when measuring begins. Nothing is projected before you start."));
  sent->body()->addWidget(pattern, 1);
  seen->body()->addWidget(photograph, 1);
  sent->addAction(new DeviceSelector(DeviceSelector::Kind::projector, model, sent));
  seen->addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, seen));
  row->addWidget(sent, 1);
  row->addWidget(seen, 1);
  auto refresh = [&model, pattern, photograph, seen] {
    LivePictures live = model.pictures();
    // The last ones of another step say nothing here.
    if (!model.isMeasuring() && model.trace().seconds() <= 0.0) {
      for (ImageView* view : {pattern, photograph}) view->setPicture({});
      return seen->setSubtitle({});
    }
    if (live.photographs == 0 || live.pattern.empty()) return;
    pattern->setPicture(encodedPictureOf(live.pattern));
    photograph->setPicture(pictureOf(live.frame.signal, 1.0f));
    seen->setSubtitle(exposureText(live.frame.seconds));
  };
  QObject::connect(&model, &AcquirePage::changed, stage, refresh);
  refresh();
  return stage;
}

/// Before and after: what to measure with.
QWidget* planOf(AcquirePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(AcquirePage::tr("How finely"), "section"));
  auto* group = new QButtonGroup(part);
  for (auto [name, sentence] :
       {std::pair(AcquirePage::tr("Fast"), AcquirePage::tr("a first look; misses weak bounces")),
        std::pair(AcquirePage::tr("Usual"), AcquirePage::tr("suits most surfaces")),
        std::pair(AcquirePage::tr("Fine"), AcquirePage::tr("glass, gloss, deep corners"))}) {
    auto* choice = new Choice(name, sentence);
    group->addButton(choice, static_cast<int>(group->buttons().size()));
    column->addWidget(choice);
  }
  QObject::connect(group, &QButtonGroup::idClicked, &model,
                   [&model](int id) { model.setFineness(static_cast<Fineness>(id)); });
  column->addSpacing(8);
  column->addWidget(lineOf());
  column->addWidget(labelOf(AcquirePage::tr("Colours"), "section"));
  auto* colour = new Segmented({AcquirePage::tr("Red, green, blue"), AcquirePage::tr("White only")});
  column->addWidget(colour);
  column->addWidget(
      labelOf(AcquirePage::tr("White only is three times faster, with colours a few percent off."), "note"));
  QObject::connect(colour, &Segmented::chosen, &model, [&model](int index) { model.setWhite(index == 1); });
  auto* result = new QWidget;
  auto* rows = new QVBoxLayout(result);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(lineOf());
  rows->addWidget(labelOf(AcquirePage::tr("What was measured"), "section"));
  auto* patterns = new ValueRow(AcquirePage::tr("Patterns"));
  auto* photographs = new ValueRow(AcquirePage::tr("Photographs"));
  auto* error = new ValueRow(AcquirePage::tr("Error of the test patterns"));
  for (ValueRow* row : {patterns, photographs, error}) rows->addWidget(row);
  rows->addWidget(labelOf(AcquirePage::tr("Test patterns are predicted from the measurement, then "
                                          "photographed: this is how far the two differ."),
                          "note"));
  auto* findings = new Note(Note::Kind::amber);
  findings->setObjectName("findings");
  rows->addWidget(findings);
  column->addWidget(result);
  auto refresh = [&model, group, colour, result, patterns, photographs, error, findings] {
    auto count = [&model](const char* name) {
      return countText(static_cast<std::uint64_t>(model.figure(name).value_or(0.0)));
    };
    result->setVisible(model.verificationError().has_value());
    patterns->setValue(count("patterns"));
    photographs->setValue(count("exposures"));
    error->setValue(percentText(model.verificationError().value_or(0.0)));
    const QStringList found = model.findings();
    findings->setVisible(!found.isEmpty());
    findings->setText(AcquirePage::tr("Found while measuring"), found.join("\n\n"));
    group->button(static_cast<int>(model.fineness()))->setChecked(true);
    colour->setCurrent(model.isWhite() ? 1 : 0);
  };
  QObject::connect(&model, &AcquirePage::changed, part, refresh);
  refresh();
  return part;
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
  column->addWidget(lineOf());
  auto* rate = new ValueRow(AcquirePage::tr("Photographs a second"));
  auto* taken = new ValueRow(AcquirePage::tr("Taken in this session"));
  auto* ahead = new ValueRow(AcquirePage::tr("Patterns ahead"));
  auto* disk = new ValueRow(AcquirePage::tr("Disk still needed"));
  for (ValueRow* row : {rate, taken, ahead, disk}) column->addWidget(row);
  column->addWidget(lineOf());
  column->addWidget(watchPart(model));
  auto refresh = [&model, left, counts, rate, taken, ahead, disk] {
    if (!model.isMeasuring()) return;
    if (model.isPaused())
      left->setText(AcquirePage::tr("Paused"));
    else if (auto seconds = model.secondsLeft())
      left->setText(AcquirePage::tr("About %1 left").arg(durationText(*seconds)));
    else
      left->setText(AcquirePage::tr("Measuring"));
    QString stage = model.stage();
    if (!stage.isEmpty()) stage[0] = stage[0].toUpper();
    counts->setText(stage);
    rate->setValue(numberText(model.rate()));
    taken->setValue(countText(static_cast<std::uint64_t>(model.photographs())));
    if (const auto& work = model.forecast()) {
      ahead->setValue(AcquirePage::tr("about %1").arg(countText(static_cast<std::uint64_t>(work->shots))));
      disk->setValue(bytesText(work->diskBytes));
    }
  };
  QObject::connect(&model, &AcquirePage::changed, part, refresh);
  refresh();
  return part;
}

QWidget* inspectorOf(AcquirePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  QWidget* plan = planOf(model);
  QWidget* run = runOf(model);
  column->addWidget(plan);
  column->addWidget(run);
  column->addWidget(consentPart(model.session()));
  column->addStretch(1);
  auto refresh = [&model, plan, run] {
    plan->setVisible(!model.isMeasuring());
    run->setVisible(model.isMeasuring());
  };
  QObject::connect(&model, &AcquirePage::changed, card, refresh);
  refresh();
  return card;
}

}  // namespace

PageView viewOf(AcquirePage& model) {
  return {stageOf(model), inspectorOf(model)};
}

}  // namespace relucent
