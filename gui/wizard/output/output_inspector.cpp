// SPDX-License-Identifier: MIT
#include "wizard/output/output_inspector.h"

#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QLocale>
#include <cmath>

#include "text/written_times.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/devices/device_selector.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/devices/nudge_dialog.h"
#include "wizard/devices/on_measurement.h"
#include "wizard/devices/perfecting_part.h"
#include "wizard/frame/page_view.h"
#include "wizard/output/nights_part.h"
#include "wizard/output/output_page.h"
#include "wizard/output/playlist_view.h"
#include "wizard/output/repair_part.h"
#include "wizard/output/sets_part.h"

namespace relucent::gui {
namespace {

/// The projector's screen, filled again when one is plugged in or out.
QComboBox* screenBox(OutputPage& page) {
  auto* box = new QComboBox;
  box->setObjectName("output-screen");
  box->setAccessibleName(OutputPage::tr("Projector's screen"));
  QObject::connect(box, &QComboBox::activated, &page,
                   [&page](int index) { page.choose(static_cast<std::size_t>(index)); });
  auto refresh = [&page, box] {
    QStringList now;
    for (const OutputScreen& screen : page.screens()) {
      if (screen.isPageOnly) {
        now << OutputPage::tr("On this page only");
        continue;
      }
      QString name = screen.operators ? OutputPage::tr("This screen") : screen.identity.connector;
      now << QString("%1, %2").arg(name, sizeText(screen.size.width(), screen.size.height()));
    }
    QStringList shown;
    for (int i = 0; i < box->count(); ++i) shown << box->itemText(i);
    if (shown != now) {
      box->clear();
      box->addItems(now);
    }
    const QString missing = page.missingScreen();
    box->setPlaceholderText(missing.isEmpty() ? OutputPage::tr("No screen chosen")
                                              : OutputPage::tr("%1, unplugged").arg(missing));
    box->setAccessibleDescription(page.chosen() ? QString() : box->placeholderText());
    box->setCurrentIndex(page.chosen() ? static_cast<int>(*page.chosen()) : -1);
  };
  refreshOn(page, box, refresh, &OutputPage::settingsChanged);
  QObject::connect(&page, &OutputPage::remedyWanted, box, [box] { pointOut(box); });
  return box;
}

QString timeText(const QDateTime& when) {
  return QLocale().toString(when, QLocale::ShortFormat);
}

QString errorLine(const QString& what, const pipeline::ProvedProjection& projection) {
  return OutputPage::tr("%1: measured ΔE %2, predicted %3")
      .arg(what, decimalText(projection.measured.deltaE, 1), decimalText(projection.predicted.deltaE, 1));
}

/// Of several cameras: how each of them sees it.
QString viewsLine(const Proof& proof) {
  QStringList views;
  if (proof.figures.others.empty()) return {};
  for (std::size_t camera = 0; camera <= proof.figures.others.size(); ++camera) {
    const pipeline::ProvedView view = proof.figuresOf(camera);
    const QString figures =
        isolated(QString::fromUtf8("ΔE %1").arg(decimalText(view.after.measured.deltaE, 1)));
    views << (pipeline::isAsPredicted(view) ? OutputPage::tr("Camera %1: %2, as predicted")
                                            : OutputPage::tr("Camera %1: %2, not as predicted"))
                 .arg(camera + 1)
                 .arg(figures);
  }
  return views.join('\n');
}

/// Of a venue that stands still a prediction of large errors is not off by as much.
bool isBeyondPrediction(const pipeline::ProvedView& figures) {
  constexpr double mostOff = 1.2;
  return figures.after.measured.deltaE > mostOff * figures.after.predicted.deltaE;
}

/// Why errors are plain to see though nothing contradicts the prediction, and what helps.
QString reasonOf(const OutputPage& page, const pipeline::ProvedView& figures) {
  constexpr double enoughLight = 0.95;
  // What stays dark and should be bright, or the other way round, is off by about that much, out of 100.
  constexpr double offOutOfReach = 40.0;
  if (isBeyondPrediction(figures))
    return OutputPage::tr(
        "They are larger than predicted. A check for drift tells whether something has moved.");
  if (const double kept = page.lightKept(); kept < enoughLight)
    return OutputPage::tr(
               "Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are "
               "missing, in the prediction too. Keep more of it.")
        .arg(percentText(kept));
  if (2.0 * offOutOfReach * (1.0 - figures.reachable) > figures.after.measured.deltaE)
    return OutputPage::tr(
        "Nothing has moved: part of the picture is out of the projector's reach, in a shadow, darker than "
        "its "
        "black or brighter than its white there. Another picture, or another place for it, helps.");
  return OutputPage::tr(
      "Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.");
}

/// Of the picture that is shown: then the photograph is of what it was before.
bool wasPerfectedSince(OutputPage& page, const Proof& proof) {
  const Perfecting& perfecting = page.perfecting();
  if (!perfecting.known() || proof.picture.isEmpty() || proof.picture != perfecting.picture()) return false;
  return timeWritten(perfecting.known()->perfected) > proof.taken;
}

/// Where the part is that looks otherwise; nothing where nobody kept that.
QString placeLine(const pipeline::ProvedView& view) {
  const auto [x, y] = pipeline::changedPlace(view);
  if (x <= 0.0) return {};
  return OutputPage::tr("In the camera's picture it is %1 from the left and %2 from the top.")
             .arg(percentText(x), percentText(y)) +
         '\n';
}

void showProof(Remark& remark, OutputPage& page) {
  const Proof* proof = page.proof().proof().get();
  if (page.proof().work() == OutputProof::Work::photograph)
    return remark.show(Remark::Kind::watch, OutputPage::tr("A photograph is being taken."),
                       page.proof().mayFlash()
                           ? QString()
                           : OutputPage::tr("Slowly, as the room is not said to be clear: nothing flashes."));
  if (page.playsEarlier())
    return remark.show(
        Remark::Kind::watch, OutputPage::tr("Not to be proved yet"),
        OutputPage::tr("The projector still shows another correction. Show the current one, then take "
                       "the photograph."));
  if (const auto pixels = page.proof().leftElsewhere())
    return remark.show(
        Remark::Kind::warning, OutputPage::tr("The camera looks elsewhere"),
        OutputPage::tr("It was left %1 px from where it looked when it was measured. Put it back, or "
                       "repair the calibration.")
            .arg(decimalText(*pixels, 1)));
  if (page.proof().wasPushedBack())
    return remark.show(
        Remark::Kind::watch, OutputPage::tr("The camera is back at its place"),
        OutputPage::tr(
            "What was found before may have come of that: a photograph shows what is left of it."));
  if (page.proof().isOutOfDate())
    return remark.show(
        Remark::Kind::warning, OutputPage::tr("The photograph is out of date"),
        OutputPage::tr(
            "What it was taken of has been measured or chosen anew since, or is another set. Take it "
            "again to prove what is shown now."));
  if (proof == nullptr)
    return remark.show(Remark::Kind::watch, OutputPage::tr("Not photographed yet"),
                       OutputPage::tr("One photograph shows whether the surface looks as predicted."));
  const pipeline::ProvedView figures = proof->figuresOf(page.camera());
  const pipeline::DriftRecord* drift = page.proof().newestDrift();
  const bool isDoubted = drift != nullptr && drift->verdict != acquisition::Verdict::stillGood;
  const QString when = timeText(proof->taken);
  QString meaning =
      (drift == nullptr ? OutputPage::tr("Photographed %1.").arg(when)
                        : OutputPage::tr("Photographed %1, before the last check for drift.").arg(when)) +
      '\n';
  if (!proof->picture.isEmpty())
    meaning += OutputPage::tr("Picture: %1").arg(isolated(OutputPlaylist::nameOf(proof->picture))) + '\n';
  meaning += errorLine(OutputPage::tr("Corrected"), figures.after) + '\n' +
             errorLine(OutputPage::tr("Original"), figures.before) + '\n' +
             OutputPage::tr("%1 of the picture can be reached.").arg(percentText(figures.reachable));
  if (wasPerfectedSince(page, *proof))
    meaning = OutputPage::tr("This picture was perfected after the photograph.") + '\n' + meaning;
  if (const QString views = viewsLine(*proof); !views.isEmpty()) meaning = views + '\n' + meaning;
  const std::optional<std::size_t> differs = pipeline::viewThatDiffers(proof->figures);
  if (proof->isAsPredicted() && isDoubted)
    remark.show(Remark::Kind::watch, OutputPage::tr("The surface looked as predicted then"), meaning);
  else if (proof->isAsPredicted() && pipeline::isPlainToSee(proof->figures))
    remark.show(Remark::Kind::watch,
                isBeyondPrediction(figures) ? OutputPage::tr("Errors are plain to see")
                                            : OutputPage::tr("As predicted, but errors are plain to see"),
                meaning + '\n' + reasonOf(page, figures));
  else if (proof->isAsPredicted())
    remark.show(Remark::Kind::good, OutputPage::tr("The surface looks as predicted"), meaning);
  else if (const sentinels::Movement moved = proof->figuresOf(*differs).moved; moved.explains)
    remark.show(
        Remark::Kind::warning,
        (page.cameras() == 1
             ? OutputPage::tr("The camera's view has moved by %1 px sideways and %2 px up or down.")
             : OutputPage::tr("The view of camera %3 has moved by %1 px sideways and %2 px up or down.")
                   .arg(*differs + 1))
            .arg(decimalText(std::abs(moved.x), 1), decimalText(std::abs(moved.y), 1)),
        meaning);
  else if (const double patch = pipeline::changedPatch(proof->figuresOf(*differs));
           patch > pipeline::plainPatch)
    remark.show(Remark::Kind::warning,
                OutputPage::tr("A part of the surface looks otherwise than predicted, by ΔE %1.")
                    .arg(decimalText(patch, 1)),
                placeLine(proof->figuresOf(*differs)) + meaning);
  else if (page.cameras() > 1)
    remark.show(Remark::Kind::warning,
                OutputPage::tr("Camera %1 or a projector may have moved.").arg(*differs + 1), meaning);
  else
    remark.show(Remark::Kind::warning, OutputPage::tr("The camera or projector may have moved."), meaning);
}

/// `hasMoved`: the photograph shows that the camera was bumped, which can be undone by hand, too.
void showDrift(Remark& remark, const OutputProof& proof, bool hasMoved) {
  const bool isContradicted = proof.isCheckContradicted();
  const pipeline::DriftRecord* drift = isContradicted ? &*proof.drift() : proof.newestDrift();
  const bool isEnded = proof.endedUnclear() == OutputProof::Work::drift;
  remark.setVisible(isEnded || drift != nullptr);
  if (isEnded)
    return remark.show(Remark::Kind::watch,
                       OutputPage::tr("The check was ended: the room is not said to be clear"),
                       OutputPage::tr("It came to no result. Check again when the room is clear."));
  if (drift == nullptr) return;
  const QDateTime checked = timeWritten(drift->checked).toLocalTime();
  QString meaning =
      OutputPage::tr("Checked %1.").arg(timeText(checked)) + '\n' +
      OutputPage::tr("Error of the test patterns: %1, when measured %2. %3 of the view changed.")
          .arg(percentText(drift->error), percentText(drift->errorThen), percentText(drift->changedShare));
  // What else is other than it was, where that is not next to nothing.
  constexpr double leastAmbient = 0.002, leastLamp = 0.02;
  if (std::abs(drift->ambient) >= leastAmbient)
    meaning += '\n' + (drift->ambient > 0.0 ? OutputPage::tr("The room is brighter by %1 of full light.")
                                            : OutputPage::tr("The room is darker by %1 of full light."))
                          .arg(percentText(std::abs(drift->ambient)));
  // Where the view has changed, what of its light is missing says nothing of the projector.
  constexpr double mostChanged = 0.01;
  if (!hasMoved && drift->changedShare < mostChanged && std::abs(drift->lamp - 1.0) >= leastLamp)
    meaning +=
        '\n' +
        OutputPage::tr("The projector gives %1 of the light that it gave.").arg(percentText(drift->lamp));
  const bool mayRepair = !proof.isBeyondRepair();
  if (hasMoved && drift->verdict != acquisition::Verdict::stillGood)
    return remark.show(Remark::Kind::warning,
                       mayRepair ? OutputPage::tr("Put the camera back, or repair the calibration.")
                                 : OutputPage::tr("Put the camera back, or measure again."),
                       meaning);
  switch (drift->verdict) {
    case acquisition::Verdict::stillGood:
      if (isContradicted || proof.isUnsettled())
        return remark.show(Remark::Kind::watch,
                           OutputPage::tr("The test patterns fit, the photograph does not"),
                           meaning + '\n' +
                               OutputPage::tr("Few patterns can miss a small part. Where another photograph "
                                              "differs, too, a repair looks closer."));
      return remark.show(Remark::Kind::good, OutputPage::tr("The measurement still holds"), meaning);
    case acquisition::Verdict::remeasure:
      return remark.show(
          Remark::Kind::warning,
          acquisition::isRoomChanged(drift->ambient)
              ? OutputPage::tr(
                    "The room's light has changed. Restore it and check again, or repair the calibration.")
          : mayRepair ? OutputPage::tr("Something has changed. Repair the calibration.")
                      : OutputPage::tr("Something has changed. Measure again."),
          meaning);
    case acquisition::Verdict::startAgain:
      return remark.show(
          Remark::Kind::failed,
          !acquisition::isLightSeen(drift->lamp)
              ? OutputPage::tr("Almost nothing of the projector's light is seen. Look at the lens and at the "
                               "projector, then check again.")
          : mayRepair
              ? OutputPage::tr(
                    "Hardly anything fits. Put the camera back or repair the calibration; if neither "
                    "helps, aim and measure again.")
              : OutputPage::tr("Hardly anything fits. Put the camera back, or aim and measure again."),
          meaning);
  }
}

QWidget* proofPart(OutputPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(OutputPage::tr("Verification"), "section"));
  auto* found = new Remark;
  found->setObjectName("proof-remark");
  column->addWidget(found);
  auto* take = new ActionButton(Icon::camera, OutputPage::tr("Take verification photograph"));
  take->setObjectName("verify");
  take->setToolTip(OutputPage::tr("Ctrl+Shift+V"));
  column->addWidget(take);
  auto* changed = new Remark;
  changed->setObjectName("drift-remark");
  column->addWidget(changed);
  auto* drift = new ActionButton(Icon::drift, OutputPage::tr("Check for drift"));
  drift->setObjectName("check-drift");
  drift->setToolTip(OutputPage::tr("Photographs the test patterns of the measurement again, ten or so."));
  column->addWidget(drift);
  column->addWidget(repairPart(page));
  auto* push = new ActionButton(Icon::camera, OutputPage::tr("Put the camera back"));
  push->setObjectName("push-back");
  push->setToolTip(
      OutputPage::tr("Shows full light, and where the camera has to be turned to look where it looked."));
  column->addWidget(push);
  column->addWidget(consentWidget(page));
  QObject::connect(take, &QPushButton::clicked, &page, &OutputPage::verify);
  QObject::connect(drift, &QPushButton::clicked, &page, &OutputPage::checkDrift);
  QObject::connect(push, &QPushButton::clicked, &page, &OutputPage::pushBack);
  QObject::connect(&page, &OutputPage::nudgeWanted, part, [part, &page] {
    showNudge(*part, std::make_unique<Nudge>(page.session(), OutputPage::stepName),
              [&page](const Nudge& nudge) { page.pushedBack(nudge.sight(), nudge.wasElsewhere()); });
  });
  auto refresh = [=, &page] {
    showProof(*found, page);
    const std::shared_ptr<const Proof>& proof = page.proof().proof();
    const bool hasMoved = proof && !page.proof().isOutOfDate() && !page.proof().wasPushedBack() &&
                          proof->figures.moved.explains && !proof->isAsPredicted();
    showDrift(*changed, page.proof(), hasMoved);
    take->setWhyNot(page.whyNotProve());
    drift->setWhyNot(page.whyNoPatterns());
    push->setWhyNot(page.whyNoPhotograph());
  };
  refreshOn(page, part, refresh, &OutputPage::settingsChanged, &OutputPage::resultChanged);
  return part;
}

/// What starts at log-in, and what installing would change.
QString installedText(const OutputPage& page) {
  using InstalledShow = OutputPage::InstalledShow;
  if (page.installedShow() == InstalledShow::thisVenues && isNothingToldApart(page.session()))
    return OutputPage::tr("Installed, but the show cannot start with what was measured last.") + ' ' +
           (page.session().hasEarlier(calibration::Stage::acquisition)
                ? OutputPage::tr("Go on measuring, or use the earlier one, at Acquire.")
                : OutputPage::tr("Go on measuring at Acquire."));
  switch (page.installedShow()) {
    case InstalledShow::thisVenues:
      return (page.nightAt().isValid()
                  ? OutputPage::tr(
                        "Installed. The show starts at the next log-in, without wizard. The camera stays: "
                        "at night it looks after the picture.")
                  : OutputPage::tr(
                        "Installed. The show starts at the next log-in, without camera or wizard.")) +
             ' ' + OutputPage::tr("It plays this playlist with the measurement that is in use by then.") +
             ' ' + OutputPage::tr("To end it, hold Esc for two seconds at the projector's screen.");
    case InstalledShow::anotherVenues:
      return page.isInstallable()
                 ? OutputPage::tr("Another venue's show starts at log-in. Installing this one replaces it.")
                 : OutputPage::tr(
                       "Another venue's show starts at log-in. This is a rehearsal, which is not "
                       "installed.");
    case InstalledShow::none:
      break;
  }
  if (page.isInstallable() && page.nightAt().isValid())
    return OutputPage::tr(
        "Once installed, the show starts at every log-in, without wizard. The camera stays: at night it "
        "looks "
        "after the picture.");
  return page.isInstallable()
             ? OutputPage::tr("Once installed, the show starts at every log-in, without camera or wizard.")
             : OutputPage::tr(
                   "This is a rehearsal with simulated devices: its show is not installed. That of "
                   "a real venue starts at every log-in.");
}

QWidget* handOverPart(OutputPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(OutputPage::tr("Hand over"), "section"));
  auto* report = new ActionButton(Icon::report, OutputPage::tr("Save report"));
  report->setObjectName("report");
  column->addWidget(report);
  QLabel* written = labelOf({}, "note");
  written->setObjectName("report-written");
  column->addWidget(written);
  QLabel* state = labelOf({}, "note");
  state->setObjectName("install-state");
  column->addWidget(state);
  QPushButton* remove = buttonOf(OutputPage::tr("Remove installed show"));
  remove->setObjectName("remove-installed");
  remove->setToolTip(OutputPage::tr("It does not start at log-in any more. Venue and playlist stay."));
  column->addWidget(remove);
  QObject::connect(report, &QPushButton::clicked, &page, &OutputPage::report);
  QObject::connect(remove, &QPushButton::clicked, &page, &OutputPage::askToRemoveInstalled);
  auto refresh = [=, &page] {
    report->setWhyNot(page.whyNoPhotograph());
    written->setVisible(!page.reportFile().isEmpty());
    const QString where = OutputPage::tr("Written to %1, and for paper to report.pdf beside it.")
                              .arg(QDir::toNativeSeparators(page.reportFile()));
    written->setText(page.isReportShown()
                         ? where
                         : where + ' ' +
                               OutputPage::tr("No program here opens it: open it by hand, or take it to "
                                              "another computer."));
    remove->setVisible(page.installedShow() != OutputPage::InstalledShow::none);
    remove->setIcon(iconOf(Icon::remove, colours().text));
    state->setText(installedText(page));
  };
  refreshOn(page, part, refresh, &OutputPage::settingsChanged, &OutputPage::resultChanged);
  QObject::connect(&Theme::instance(), &Theme::changed, part, refresh);
  return part;
}

}  // namespace

QWidget* outputInspector(OutputPage& page) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(OutputPage::tr("Projector's screen"), "section"));
  column->addWidget(new DeviceSelector(DeviceSelector::Kind::projector, page, card));
  column->addWidget(screenBox(page));
  auto* differs = new Note(Note::Kind::information);
  column->addWidget(differs);
  auto* moved = new Note(Note::Kind::information);
  moved->setObjectName("moved-screen");
  column->addWidget(moved);
  column->addWidget(setsPart(page));
  column->addWidget(labelOf(OutputPage::tr("Playlist"), "section"));
  column->addWidget(playlistPart(page));
  auto* method = new Note(Note::Kind::information);
  method->setObjectName("method-note");
  column->addWidget(method);
  column->addWidget(lineOf());
  column->addWidget(proofPart(page));
  column->addWidget(lineOf());
  column->addWidget(perfectingPart(page, page.perfecting(),
                                   {[&page] { return page.whyNotProve(); }, [&page] { page.perfect(); }}));
  column->addWidget(lineOf());
  column->addWidget(new NightsPart(page));
  column->addWidget(lineOf());
  column->addWidget(handOverPart(page));
  column->addStretch(1);
  auto refresh = [=, &page] {
    Size size = page.projectorSize();
    differs->setVisible(page.chosen() && !page.screens()[*page.chosen()].isPageOnly &&
                        page.screens()[*page.chosen()].size != QSize(size.width, size.height));
    differs->setText(
        OutputPage::tr("This screen's resolution is not that of the projector that was measured."),
        OutputPage::tr("The picture stands in its middle, pixel for pixel."));
    QString meaning = page.meaningOfScreen();
    moved->setVisible(!meaning.isEmpty() && page.chosen());
    moved->setText(OutputPage::tr("The projector is another screen now"), meaning);
    QString still = page.stillMethod();
    method->setVisible(!still.isEmpty());
    method->setText(OutputPage::tr("Still pictures: %1").arg(still),
                    OutputPage::tr("Films and cross-fades use windows and steps, which are quick enough."));
  };
  refreshOn(page, card, refresh, &OutputPage::settingsChanged, &OutputPage::resultChanged);
  return card;
}

}  // namespace relucent::gui
