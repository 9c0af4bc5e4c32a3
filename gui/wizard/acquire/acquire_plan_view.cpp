// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_plan_view.h"

#include <QComboBox>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "jobs/latest.h"
#include "relucent/base/time_left.h"
#include "relucent/pipeline/pictures.h"
#include "text/message_text.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/colour_map.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/acquire/lit_outline.h"
#include "wizard/acquire/outlook_view.h"
#include "wizard/devices/device_selector.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

constexpr double brightRoom = 0.02;  // of full light: beyond it photon noise of the room costs precision

/// How to begin: with time to leave, and a sound at the end.
QWidget* startPart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(lineOf());
  rows->addWidget(labelOf(AcquirePage::tr("Start"), "section"));
  auto* leaving = new QWidget;
  auto* row = new QHBoxLayout(leaving);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(labelOf(AcquirePage::tr("Leave the room first")), 1);
  auto* seconds = new QComboBox;
  seconds->setObjectName("seconds-to-leave");
  seconds->setAccessibleName(AcquirePage::tr("Time to leave the room before measuring begins"));
  for (int choice : {0, 10, 30, 60, 120}) seconds->addItem(AcquirePage::tr("%1 s").arg(choice), choice);
  row->addWidget(seconds);
  rows->addWidget(leaving);
  auto* sound = new Tick(AcquirePage::tr("A sound when it ends or needs me"));
  sound->setObjectName("measuring-sound");
  rows->addWidget(sound);
  QObject::connect(seconds, &QComboBox::activated, &model,
                   [&model, seconds] { model.setSecondsToLeave(seconds->currentData().toInt()); });
  QObject::connect(sound, &Tick::toggled, &model, &AcquirePage::setSound);
  auto refresh = [&model, leaving, seconds, sound] {
    leaving->setVisible(model.session().hasLight());
    if (int index = seconds->findData(model.secondsToLeave()); index >= 0) seconds->setCurrentIndex(index);
    const QSignalBlocker quiet(sound);
    sound->setChecked(model.hasSound());
  };
  refreshOn(model, part, refresh, &AcquirePage::settingsChanged, &AcquirePage::resultChanged);
  return part;
}

/// What would spoil a measurement that begins now.
QWidget* readyPart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(lineOf());
  rows->addWidget(labelOf(AcquirePage::tr("Ready"), "section"));
  auto* dark = new Remark;
  auto* disk = new Remark;
  rows->addWidget(dark);
  rows->addWidget(disk);
  auto refresh = [&model, part, dark, disk] {
    if (model.isMeasuring()) return;
    const std::optional<RoomLight>& light = model.session().roomLight();
    const std::optional<WorkLeft> work = model.expected();
    part->setVisible(!model.isDone() && (light || work));
    dark->setVisible(light.has_value());
    if (light && light->share <= brightRoom)
      dark->show(Remark::Kind::good, AcquirePage::tr("Dark enough"),
                 AcquirePage::tr("Room light is %1 of full light, limit %2.")
                     .arg(percentText(light->share), percentText(brightRoom)));
    else if (light)
      dark->show(
          Remark::Kind::warning, AcquirePage::tr("It is too bright here"),
          AcquirePage::tr("Room light is %1 of full light. Cover windows and lamps: less light, less noise.")
              .arg(percentText(light->share)));
    disk->setVisible(work.has_value());
    if (!work) return;
    const std::uint64_t free = model.freeBytes();
    const QString needs = AcquirePage::tr("Needs %1 of %2.").arg(bytesText(work->diskBytes), bytesText(free));
    if (work->diskBytes <= free)
      disk->show(Remark::Kind::good, AcquirePage::tr("Room on the disk"), needs);
    else
      disk->show(Remark::Kind::failed, AcquirePage::tr("The disk is too full"), needs);
  };
  refreshOn(model, part, refresh, &AcquirePage::settingsChanged, &AcquirePage::resultChanged);
  return part;
}

/// What stays on the disk afterwards.
QWidget* storagePart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(lineOf());
  rows->addWidget(labelOf(AcquirePage::tr("Photographs to keep"), "section"));
  auto* box = new QComboBox;
  box->setObjectName("kept-photographs");
  box->setAccessibleName(AcquirePage::tr("Photographs to keep once all is measured"));
  using Kept = pipeline::KeptPhotographs;
  const auto add = [box](const QString& name, Kept kept) { box->addItem(name, static_cast<int>(kept)); };
  add(AcquirePage::tr("All"), Kept::everything);
  add(AcquirePage::tr("Of the latest measurement"), Kept::latest);
  add(AcquirePage::tr("None: results only"), Kept::results);
  rows->addWidget(box);
  auto* meaning = labelOf(QString(), "note");
  rows->addWidget(meaning);
  auto* removed =
      labelOf(AcquirePage::tr("Those of the last measurement were removed: all are taken again."), "note");
  rows->addWidget(removed);
  QObject::connect(box, &QComboBox::activated, &model, [&model, box] {
    model.setKeptPhotographs(static_cast<Kept>(box->currentData().toInt()));
  });
  auto refresh = [&model, part, box, meaning, removed] {
    removed->setVisible(model.session().werePhotographsRemoved());
    part->setVisible(!model.isMeasuring() && !model.isDone());
    setPossible(box, model.whyLocked());
    box->setCurrentIndex(box->findData(static_cast<int>(model.keptPhotographs())));
    switch (model.keptPhotographs()) {
      case Kept::everything:
        return meaning->setText(
            AcquirePage::tr("Measuring with other settings then needs fewer new photographs."));
      case Kept::latest:
        return meaning->setText(AcquirePage::tr(
            "Those that were set aside by measuring again are removed once all is measured."));
      case Kept::results:
        return meaning->setText(AcquirePage::tr(
            "Removed once all is measured. Other settings then have to photograph everything again."));
    }
  };
  refreshOn(model, part, refresh, &AcquirePage::settingsChanged, &AcquirePage::resultChanged);
  return part;
}

/// What it came to.
QWidget* resultPart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(lineOf());
  rows->addWidget(labelOf(AcquirePage::tr("What was measured"), "section"));
  auto* patterns = new ValueRow(AcquirePage::tr("Patterns"));
  auto* photographs = new ValueRow(AcquirePage::tr("Photographs"));
  auto* repair = new ValueRow(AcquirePage::tr("Photographs of the repair since"));
  auto* error = new ValueRow(AcquirePage::tr("Error of the test patterns"));
  auto* quality = new ValueRow(AcquirePage::tr("Pictures expected at"));
  quality->setToolTip(qualityMeaning());
  for (ValueRow* row : {patterns, photographs, repair, error, quality}) rows->addWidget(row);
  QLabel* meaning = labelOf({}, "note");
  rows->addWidget(meaning);
  auto* findings = new Note(Note::Kind::amber);
  findings->setObjectName("findings");
  rows->addWidget(findings);
  auto refresh = [&model, part, patterns, photographs, repair, error, quality, meaning, findings] {
    const calibration::StageCost cost = model.cost().value_or(calibration::StageCost());
    const auto count = [](int number) { return countText(static_cast<std::uint64_t>(number)); };
    part->setVisible(model.verificationError().has_value());
    patterns->setValue(count(cost.patterns));
    photographs->setValue(count(cost.exposures));
    const std::optional<calibration::StageCost> repaired = model.repairCost();
    repair->setVisible(repaired.has_value());
    if (repaired) repair->setValue(count(repaired->exposures));
    // Test patterns that were not confirmed tell nothing; nor do those of blocks as coarse as what was
    // measured, beside how far pictures will be off.
    const int stoppedAt = model.stoppedAt();
    error->setVisible(stoppedAt == 0);
    const double off = model.verificationError().value_or(0.0);
    error->setValue(off > 0.0 ? percentText(off) : QString::fromUtf8("–"));
    meaning->setText(
        stoppedAt > 0
            ? AcquirePage::tr("Stopped early: light finer than blocks of %1 px is missing.").arg(stoppedAt)
            : AcquirePage::tr("Test patterns are predicted from the measurement, then photographed: this is "
                              "how far the two differ, the photographs' noise included."));
    const std::optional<transport::ExpectedQuality> expected = model.expectedQuality();
    quality->setVisible(expected.has_value());
    if (expected) quality->setValue(qualityText(expected->now));
    const QStringList found = model.findings();
    findings->setVisible(!found.isEmpty());
    findings->setText(AcquirePage::tr("Found while measuring"), found.join("\n\n"));
  };
  refreshOn(model, part, refresh, &AcquirePage::resultChanged);
  return part;
}

}  // namespace

namespace {

/// Pictures of as many pixels as the camera has, made on another thread.
struct FloodlightPicture {
  QImage picture;
  LitOutline lit;
};

FloodlightPicture floodlightPicture(const image::Image& flood) {
  if (flood.empty()) return {};
  return {pictureOf(flood, pipeline::displayWhite(flood)), litOutline(flood)};
}

}  // namespace

QWidget* floodlightCard(AcquirePage& model) {
  auto* card = new Card(AcquirePage::tr("Floodlight image"));
  auto* view = new ImageView;
  view->setObjectName("floodlight-view");
  view->setAccessibleName(AcquirePage::tr("The surface in the projector's full light"));
  card->body()->addWidget(view, 1);
  card->addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, card));
  auto show = [&model, card, view](const FloodlightPicture& flood) {
    view->setPicture(flood.picture);
    view->setOverlay(flood.lit.picture);
    const QString white = model.projectors() > 1 ? AcquirePage::tr("all projectors fully white")
                                                 : AcquirePage::tr("the projector fully white");
    const QString whole = AcquirePage::tr("%1; lit, within the dashes: %2 of the view")
                              .arg(white, percentText(flood.lit.share));
    card->setSubtitle(flood.lit.picture.isNull() ? white : whole);
    view->setAccessibleDescription(flood.lit.picture.isNull() ? QString() : whole);
  };
  auto making = std::make_shared<Latest<FloodlightPicture>>(
      show, [&model](const Failure& failure) { Q_EMIT model.failed({failure, {}}); });
  auto refresh = [&model, card, view, show, making,
                  shown = std::optional<std::pair<int, std::size_t>>()]() mutable {
    card->setVisible(!model.isMeasuring());
    view->setEmptyText(
        model.isFloodlightComing() ? AcquirePage::tr("Reading what was measured")
        : model.isDone() && model.isUnreadable()
            ? AcquirePage::tr("What was measured cannot be read.")
            : AcquirePage::tr("Appears when measuring begins. Nothing is projected before you start."));
    const auto wanted = std::pair(model.floodlightNumber(), model.camera());
    if (model.isMeasuring() || std::exchange(shown, wanted) == wanted) return;
    if (wanted.first == 0) {
      show({});
      making->ask([] { return FloodlightPicture(); });  // what is being made is of another measurement
    } else {
      making->ask([flood = std::make_shared<const image::Image>(model.floodlight())] {
        return floodlightPicture(*flood);
      });
    }
  };
  refreshOn(model, card, refresh, &AcquirePage::settingsChanged, &AcquirePage::resultChanged);
  return card;
}

QWidget* planOf(AcquirePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(AcquirePage::tr("How finely"), "section"));
  auto* group = new QButtonGroup(part);
  std::vector<Choice*> choices;
  const QStringList sentences{AcquirePage::tr("a first look; misses weak bounces"),
                              AcquirePage::tr("suits most surfaces"),
                              AcquirePage::tr("glass, gloss, deep corners")};
  for (const QString& name : {AcquirePage::tr("Fast"), AcquirePage::tr("Usual"), AcquirePage::tr("Fine")}) {
    auto* choice = new Choice(name, sentences[std::ssize(choices)]);
    group->addButton(choice, static_cast<int>(choices.size()));
    choices.push_back(choice);
    column->addWidget(choice);
  }
  QObject::connect(group, &QButtonGroup::idClicked, &model,
                   [&model](int id) { model.setFineness(static_cast<Fineness>(id)); });
  QLabel* locked = labelOf({}, "note");
  locked->setObjectName("why-locked");
  column->addWidget(locked);
  column->addSpacing(8);
  QWidget* start = startPart(model);
  column->addWidget(start);
  column->addWidget(readyPart(model));
  column->addWidget(storagePart(model));
  column->addWidget(resultPart(model));
  auto refresh = [&model, group, choices, sentences, start, locked] {
    if (model.isMeasuring()) return;
    const QString why = model.whyLocked();
    locked->setText(why);
    locked->setVisible(!why.isEmpty());
    group->button(static_cast<int>(model.fineness()))->setChecked(true);
    for (Fineness fineness : {Fineness::fast, Fineness::usual, Fineness::fine}) {
      const std::optional<WorkLeft> work = model.expected(fineness);
      const auto at = static_cast<std::size_t>(fineness);
      choices[at]->setSentence(
          AcquirePage::tr("%1; light right within about %2")
              .arg(sentences[static_cast<int>(fineness)], percentText(model.expectedDeviation(fineness))));
      choices[at]->setRemark(
          work ? groupedText(AcquirePage::tr("%n pattern(s)", nullptr, static_cast<int>(work->shots)),
                             work->shots) +
                     "\n" + text(expectedDuration(work->seconds))
               : QString());
      setPossible(choices[at], why);
    }
    start->setVisible(!model.isDone());
  };
  refreshOn(model, part, refresh, &AcquirePage::settingsChanged, &AcquirePage::resultChanged);
  return part;
}

}  // namespace relucent::gui
