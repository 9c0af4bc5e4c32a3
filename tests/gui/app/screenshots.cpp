// SPDX-License-Identifier: MIT
// screenshots DIR CALIBRATION|VENUE [CACHE]: every page of the wizard in both themes, at those of 960x540,
// 1366x768 and 1920x1080 that the screen has room for (see $QT_SCALE_FACTOR), from a finished calibration,
// which is changed: give it a copy; or the name of a simulated venue, which is measured first. `finished`:
// without measuring another one. Of a calibration with several views, these too. To be run on an X server of
// its own:
//   OPERATOR_SCREEN=1920x1080 tests/support/with-two-screens build/dev/bin/screenshots DIR dome4
#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QMenu>
#include <QPushButton>
#include <QScreen>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "app/wizard_window.h"
#include "gui/wizard/output/night_history.h"
#include "output/venue_use.h"
#include "relucent/base/message.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/venue/venue.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/map_view.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/devices/identify_overlay.h"
#include "wizard/devices/nudge_dialog.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/output_page.h"
#include "wizard/preview/preview_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

/// Two to be played after the demonstration picture.
QStringList morePictures(const std::filesystem::path& folder) {
  QStringList files;
  for (const auto& [name, hue] : {std::pair("Opening.png", 30), std::pair("Stones speak.png", 200)}) {
    QImage picture(160, 120, QImage::Format_RGB32);
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        picture.setPixelColor(x, y, QColor::fromHsv(hue, 40 + x, 60 + y));
    files << QString::fromStdString((folder / name).string());
    picture.save(files.back());
  }
  return files;
}

/// Waits for what a page computes, a minute at most.
template <typename Condition>
void until(const Condition& condition) {
  if (!QTest::qWaitFor(condition, 60000)) std::fprintf(stderr, "screenshots: a page is not ready\n");
}

class Photographs {
 public:
  Photographs(WizardWindow& wizard, QDir folder) : wizard_(wizard), folder_(std::move(folder)) {}

  void take(const QString& page) { take(page, wizard_.window()); }
  /// Of a dialog that is open, which is closed then.
  void takeDialog(const QString& page, const char* name) {
    QDialog* dialog = nullptr;
    until([&] { return (dialog = wizard_.window().findChild<QDialog*>(name)) != nullptr; });
    if (dialog == nullptr) return;
    for (auto [look, theme] : {std::pair(Look::dark, "dark"), std::pair(Look::light, "light")}) {
      Theme::instance().apply(look);
      QTest::qWait(50);
      dialog->grab().save(folder_.filePath(QString("%1-%2.png").arg(page, theme)));
    }
    dialog->close();
  }

 private:
  /// Logical pixels: those of usual screens that this one has room for, and its own.
  static QList<QSize> sizes() {
    const QSize screen = QGuiApplication::primaryScreen()->size();
    QList<QSize> all{{960, 540}, {1366, 768}, {1920, 1080}};
    all.removeIf([screen](QSize size) { return screen.boundedTo(size) != size; });
    if (!all.contains(screen)) all << screen;
    return all;
  }

  void take(const QString& page, QWidget& window) {
    for (auto [look, name] : {std::pair(Look::dark, "dark"), std::pair(Look::light, "light")})
      for (QSize size : sizes()) {
        Theme::instance().apply(look);
        window.resize(size);
        QCoreApplication::processEvents();
        QTest::qWait(50);
        QString file = QString("%1-%2-%3.png").arg(page, name).arg(size.width());
        window.grab().save(folder_.filePath(file));
      }
  }

  WizardWindow& wizard_;
  QDir folder_;
};

/// A calibration, or one that is measured in the simulated venue of this name.
std::filesystem::path measuredIn(const std::string& which, const QTemporaryDir& own,
                                 const std::filesystem::path& cache) {
  if (std::ranges::none_of(venues(), [&which](const VenueDescription& each) { return each.name == which; }))
    return which;
  CalibrateSettings settings;
  VenueSettings venue;
  venue.name = which;
  venue.projector = {128, 96};
  venue.camera = {96, 72};
  venue.pathsPerPixel = 64;
  settings.rig = venue;
  const std::filesystem::path folder = own.filePath(QString::fromStdString(which)).toStdString();
  Progress silent;
  calibrate(folder, settings, cache, silent);
  return folder;
}

/// What cannot be used and why, and what asks for names.
void takeReasons(WizardWindow& wizard, Photographs& photographs) {
  constexpr std::size_t venue = 0, acquire = 3, preview = 6, output = 7;
  {
    const DeviceLease lease = wizard.session().leaseDevices(AcquirePage::stepName, DeviceWork::measurement);
    photographs.take("08-in-use");
    for (auto [step, name] : {std::pair(preview, "07-in-use"), {venue, "00-in-use"}}) {
      wizard.wizard().go(step);
      photographs.take(name);
    }
  }
  wizard.wizard().go(preview);
  wizard.window().findChild<QAction*>("save-set")->trigger();
  photographs.takeDialog("07-save-set", "set-dialog");
  const std::filesystem::path path = wizard.session().path();
  wizard.session().close();
  wizard.wizard().go(venue);
  wizard.page<VenuePage>().refresh();
  if (const auto* more = wizard.window().findChild<QPushButton*>("more")) {
    Q_EMIT more->menu()->aboutToShow();
    more->menu()->findChild<QAction*>("rename")->trigger();
    photographs.takeDialog("00-rename", "rename-dialog");
  }
  {
    CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
    const StageResult stored = folder.latest(Stage::acquisition).value();
    transport::Acquisition measured = loadAcquisition(stored);
    measured.changed = transport::FoundChange{
        RELUCENT_MESSAGE("alarm.moved",
                         "a camera or projector has moved: the view of camera {} is shifted by {}, {} "
                         "pixels and turned by {} degrees")
            .with(as::label(1), as::pixels(2.0, as::decimals(1)), as::pixels(1.5, as::decimals(1)),
                  as::degrees(0.2, as::decimals(1))),
        true};
    storeAcquisition(folder, stored.inputs, measured,
                     resultFrom<Stage::acquisition>(stored).cost.value_or(StageCost()));
  }
  wizard.session().open(path);
  wizard.wizard().go(acquire);
  photographs.take("04-changed");
  wizard.wizard().go(output);
}

/// Cameras as a desk with three of them would list them.
CameraList someCameras() {
  ListedCamera industrial, webcam, taken;
  industrial.address = "genicam:40012345";
  industrial.model = Message::plain("Industrial camera, 12 bit");
  industrial.usable = true;
  industrial.traits.size = {1632, 1224};
  industrial.traits.format.bits = 12;
  industrial.traits.exposures = {1e-4, 4.0};
  webcam.address = "v4l2:/dev/video0";
  webcam.model = Message::plain("Webcam");
  webcam.usable = true;
  webcam.traits.size = {1280, 720};
  webcam.traits.format.bits = 8;
  webcam.traits.exposures = {1e-3, 0.3};
  webcam.traits.remarks = {Message::plain("its exposure times are believed as far as they can be read back")};
  taken.address = "gphoto2:usb:001,012";
  taken.model = Message::plain("Photo camera");
  taken.problem = Message::plain("the desktop's file manager holds it; unmount it there, then look again");
  return {{}, {industrial, webcam, taken}};
}

/// A new venue with a projector on every screen that is there, and two cameras.
void takeDevices(WizardWindow& wizard, Photographs& photographs) {
  auto& venue = wizard.page<VenuePage>();
  for (const ScreenChoice& choice : venue.screensToChoose())
    if (choice.refusal.isEmpty() && venue.projectors().empty()) venue.chooseScreen(choice);
  while (venue.mayAddProjector()) venue.addProjector();
  until([&] { return !venue.finder().isLooking(); });
  for (const char* camera : {"genicam:40012345", "v4l2:/dev/video0"}) venue.addCamera(camera);
  venue.nameCamera(0, "Door");
  photographs.take("01-devices-several");
}

/// A venue whose devices are driven by programs, and how these are changed.
void takePrograms(WizardWindow& wizard, Photographs& photographs, const QTemporaryDir& own) {
  CalibrateSettings settings;
  CommandRigSettings rig;
  rig.projector = {1024, 768};
  rig.projectorCommand = "show-on-projector {image}";
  rig.cameraCommand = "photograph --seconds {exposure} --to {output}";
  settings.rig = rig;
  wizard.session().begin(own.filePath("Cloister").toStdString(), settings);
  wizard.wizard().go(1);
  photographs.take("02-consent");
  wizard.session().setRoomClear(true);
  // There is no such program.
  until([&] { return wizard.window().findChild<QDialog*>("failure") != nullptr; });
  photographs.takeDialog("12-program-failed", "failure");
  wizard.wizard().go(0);
  photographs.take("00-programs");
  wizard.page<VenuePage>().setMode(VenuePage::Mode::programs);
  photographs.take("01-programs");
  wizard.page<VenuePage>().setMode(VenuePage::Mode::start);
}

/// The choice of cameras for a screen of the desktop.
void takeCameras(WizardWindow& wizard, Photographs& photographs, const QTemporaryDir& own) {
  wizard.page<CameraPage>().setLister(someCameras);
  CalibrateSettings settings;
  ScreenRigSettings rig;
  rig.display.connector = "HDMI-1";
  rig.projector = {1024, 768};
  settings.rig = rig;
  wizard.session().begin(own.filePath("Chapel niche").toStdString(), settings);
  wizard.wizard().go(1);
  until([&] {
    return !wizard.page<CameraPage>().isListing() &&
           !wizard.page<CameraPage>().foundCameras().cameras.empty();
  });
  photographs.take("02-cameras");
  wizard.session().decide(CameraCheckResult{{1.0}, std::nullopt, {}});
  wizard.wizard().go(2);
  photographs.take("03-consent");
}

/// The measurement of a rehearsal under way: what it is going to look like, sharper and sharper.
void takeMeasuring(WizardWindow& wizard, Photographs& photographs, const QTemporaryDir& own) {
  CalibrateSettings settings;
  VenueSettings venue;
  venue.projector = {256, 192};
  venue.camera = {160, 120};
  venue.pathsPerPixel = 64;
  settings.rig = venue;
  settings.acquisition.checkInterval = 10;
  wizard.session().begin(own.filePath("Rehearsal").toStdString(), settings);
  wizard.wizard().go(1);
  until([&] { return wizard.page<CameraPage>().tooDarkEverywhere().has_value(); });
  wizard.page<CameraPage>().primary()->trigger();
  until([&] { return wizard.session().areDevicesFree() && wizard.wizard().current() == 2; });
  wizard.page<LinearizePage>().primary()->trigger();
  until([&] { return wizard.page<LinearizePage>().result() && !wizard.page<LinearizePage>().isMeasuring(); });
  wizard.wizard().go(3);
  photographs.take("04-plan");
  wizard.page<AcquirePage>().primary()->trigger();
  wizard.session().live().setLeastInterval(250);  // as real devices would be
  wizard.page<AcquirePage>().pause();
  wizard.wizard().go(2);
  photographs.take("03-while-measuring");
  wizard.wizard().go(3);
  wizard.window().close();
  photographs.takeDialog("12-question", "failure");
  wizard.page<AcquirePage>().resume();
  const AcquisitionTrace& trace = wizard.page<AcquirePage>().trace();
  for (const auto& [blocks, name] :
       {std::pair{16, "04-measuring-coarse"}, {4, "04-measuring"}, {1, "04-measuring-fine"}}) {
    until([&, blocks = blocks] { return trace.outlook() && trace.outlook()->blocks <= blocks; });
    photographs.take(name);
  }
  wizard.session().live().setLeastInterval(0);
  wizard.page<AcquirePage>().finish();
  until([&] { return !wizard.page<AcquirePage>().isMeasuring(); });
}

/// Where several projectors overlap.
void takeOverlap(WizardWindow& wizard, Photographs& photographs) {
  auto* overlap = wizard.window().findChild<Segmented*>("camera-overlap");
  if (wizard.session().projectors() < 2 || !overlap->isVisible()) return;
  overlap->setCurrent(1);
  Q_EMIT overlap->chosen(1);
  photographs.take("02-camera-overlap");
  overlap->setCurrent(0);
  Q_EMIT overlap->chosen(0);
}

/// Somebody who stands between the cameras, as the second one sees it.
void takeViewer(WizardWindow& wizard, Photographs& photographs) {
  auto& preview = wizard.page<PreviewPage>();
  if (preview.cameras() < 2) return;
  const auto ready = [&preview] { return !preview.isComputing() && preview.table().size() >= 5; };
  preview.showCamera(1);
  wizard.window().findChild<Tick*>("one-viewer")->click();
  preview.setViewerOnPath(0.7);
  until(ready);
  photographs.take("07-preview-viewer");
  preview.setViewer(std::nullopt);
  preview.showCamera(0);
  until(ready);
}

/// A measurement that was stopped early, and what follows from it.
void takeStopped(WizardWindow& wizard, Photographs& photographs) {
  AcquirePage& acquire = wizard.page<AcquirePage>();
  const QMetaObject::Connection stopping =
      QObject::connect(&acquire.trace(), &AcquisitionTrace::changed, &acquire, [&acquire] {
        const bool takes = acquire.isMeasuring() && !acquire.isReading() && !acquire.isStopping();
        if (takes && acquire.trace().growth().levels.size() > 2) acquire.stopAndKeep();
      });
  // On a busy machine the one before may have ended by itself.
  (acquire.isDone() ? acquire.secondary().front() : acquire.primary())->trigger();
  until([&] { return !acquire.isMeasuring(); });
  QObject::disconnect(stopping);
  photographs.take("04-stopped");
  wizard.wizard().go(4);
  until([&] { return wizard.page<ThresholdPage>().kept().has_value(); });
  wizard.page<ThresholdPage>().primary()->trigger();
  until([&] { return wizard.page<ClusterPage>().result() && !wizard.page<ClusterPage>().isComputing(); });
  photographs.take("06-stopped");
}

/// Measured again, and back to what was there before: both questions.
void takeReturning(WizardWindow& wizard, Photographs& photographs) {
  AcquirePage& acquire = wizard.page<AcquirePage>();
  // Which of the buttons it is depends on how good the measurement was that was stopped.
  const auto press = [&acquire](const QString& text) {
    std::vector<PageCommand*> commands = acquire.secondary();
    commands.push_back(acquire.primary());
    for (PageCommand* command : commands)
      if (command != nullptr && command->text() == text) return command->trigger();
    std::fprintf(stderr, "screenshots: there is no button \"%s\"\n", qPrintable(text));
  };
  wizard.wizard().go(3);
  press(AcquirePage::tr("Measure again"));
  wizard.session().live().setLeastInterval(50);
  until([&] { return acquire.photographs() > 3 && acquire.trace().growth().levels.size() > 2; });
  press(AcquirePage::tr("Keep the earlier one"));
  photographs.takeDialog("04-keep-earlier", "failure");
  acquire.stopAndKeep();
  until([&] { return !acquire.isMeasuring(); });
  wizard.session().live().setLeastInterval(0);
  photographs.take("04-stopped-again");
  press(AcquirePage::tr("Use the earlier one"));
  photographs.takeDialog("04-use-earlier", "failure");
}

/// A good photograph, and a later check for drift that found something.
/// Beside a show of another program.
void takeOtherShow(WizardWindow& wizard, Photographs& photographs) {
  const auto show = VenueUse::take(wizard.session().path(), VenueUse::Way::show);
  until([&] { return wizard.session().isShownElsewhere(); });
  wizard.wizard().go(7);
  photographs.take("08-other-show");
}

void takeDoubted(WizardWindow& wizard, Photographs& photographs) {
  const std::filesystem::path path = wizard.session().path();
  DriftRecord drift;
  drift.checked = QDateTime::currentDateTimeUtc().addSecs(60).toString(Qt::ISODate).toStdString();
  drift.measurement = wizard.session().result(Stage::acquisition)->stored;
  drift.verdict = acquisition::Verdict::remeasure;
  drift.error = 0.08;
  drift.errorThen = 0.01;
  drift.changedShare = 0.12;
  saveDriftRecord(drift, path / "verification");
  wizard.session().open(path);
  wizard.wizard().go(7);
  wizard.page<OutputPage>().open();
  until([&] { return !wizard.page<OutputPage>().projection().mirror().isNull(); });
  photographs.take("08-doubted");
  wizard.page<OutputPage>().close();
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: screenshots DIR CALIBRATION|VENUE [CACHE [LANGUAGE [finished]]]\n");
    return 2;
  }
  QDir folder(argv[1]);
  folder.mkpath(".");
  QTemporaryDir own;
  const std::filesystem::path cache = argc > 3 ? argv[3] : own.filePath("cache").toStdString();
  const std::filesystem::path calibration = measuredIn(argv[2], own, cache);
  QSettings settings(own.filePath("settings.ini"), QSettings::IniFormat);
  WizardWindow wizard(settings, cache);
  wizard.page<VenuePage>().setFolder(own.filePath("venues"));
  if (argc > 4) wizard.preferences().setLanguage(argv[4]);
  Photographs photographs(wizard, folder);
  wizard.window().show();
  photographs.take("00-empty");
  wizard.page<VenuePage>().setMode(VenuePage::Mode::rehearse);
  photographs.take("01-rehearse");
  wizard.page<VenuePage>().setMode(VenuePage::Mode::script);
  photographs.take("01-script");
  CameraFinder& finder = wizard.page<VenuePage>().finder();
  finder.setLister([] { return CameraList(); });
  wizard.page<VenuePage>().setMode(VenuePage::Mode::devices);
  until([&] { return !finder.isLooking(); });
  photographs.take("01-no-camera");
  finder.setLister(someCameras);
  finder.look();
  until([&] { return !finder.isLooking(); });
  photographs.take("01-devices");
  takeDevices(wizard, photographs);

  takePrograms(wizard, photographs, own);
  takeCameras(wizard, photographs, own);
  if (argc < 6) {
    takeMeasuring(wizard, photographs, own);
    takeStopped(wizard, photographs);
    takeReturning(wizard, photographs);
  }
  wizard.page<VenuePage>().open(QString::fromStdString(calibration.string()));
  wizard.wizard().go(0);
  photographs.take("00-start");
  Wizard& steps = wizard.wizard();
  steps.go(1);
  // Exposures that were kept before are not looked for again.
  const bool isDecided = wizard.session().result(Stage::camera).has_value();
  if (!isDecided) until([&] { return wizard.page<CameraPage>().tooDarkEverywhere().has_value(); });
  photographs.take("02-camera");
  takeOverlap(wizard, photographs);
  if (isDecided)
    steps.go(2);
  else
    wizard.page<CameraPage>().primary()->trigger();
  until([&] { return wizard.session().areDevicesFree() && steps.current() == 2; });
  photographs.take("03-linearize");
  steps.go(3);
  photographs.take("04-acquire");
  steps.go(4);
  until([&] { return wizard.page<ThresholdPage>().kept() && wizard.page<ThresholdPage>().whole(); });
  wizard.page<ThresholdPage>().pick({82, 70});
  until([&] { return wizard.page<ThresholdPage>().footprint() != nullptr; });
  wizard.page<ThresholdPage>().setAbsolute(
      transport::cutKeeping(wizard.page<ThresholdPage>().whole()->histogram, 0.98));
  QTest::qWait(300);
  photographs.take("05-threshold");
  auto* matrix = wizard.window().findChild<PlaneView*>("matrix-view");
  matrix->asSeen().save(folder.filePath("05-saved-matrix.png"));
  matrix->setWholeScreen(true);
  QTest::qWait(1000);
  matrix->asSeen().save(folder.filePath("05-whole-screen.png"));
  matrix->setWholeScreen(false);
  wizard.page<ThresholdPage>().setAbsolute(0.0);
  until([&] { return wizard.page<ThresholdPage>().kept()->energyKept == 1.0; });
  wizard.page<ThresholdPage>().primary()->trigger();
  until([&] { return wizard.page<ClusterPage>().result() && !wizard.page<ClusterPage>().isComputing(); });
  photographs.take("06-cluster");
  auto* error = wizard.window().findChild<MapView*>("error-view");
  error->setRelief(true);
  photographs.take("06-cluster-relief");
  error->asSeen().save(folder.filePath("06-saved-relief.png"));
  error->setRelief(false);
  wizard.page<ClusterPage>().primary()->trigger();
  until(
      [&] { return wizard.page<PreviewPage>().preview() && wizard.page<PreviewPage>().table().size() >= 5; });
  photographs.take("07-preview");
  Corners corners = *wizard.page<PreviewPage>().corners();
  corners[0][0] += 3.0;
  wizard.page<PreviewPage>().setCorners(corners);
  until([&] {
    return !wizard.page<PreviewPage>().isComputing() && wizard.page<PreviewPage>().table().size() >= 5;
  });
  wizard.window().findChild<QWidget*>("preview-view")->setFocus(Qt::TabFocusReason);
  photographs.take("07-preview-corners");
  auto* kind = wizard.window().findChild<Segmented*>("preview-kind");
  for (auto [index, name] : {std::pair{1, "07-preview-reach"}, {0, ""}}) {
    kind->setCurrent(index);
    Q_EMIT kind->chosen(index);
    if (index > 0) photographs.take(name);
  }
  takeViewer(wizard, photographs);
  wizard.page<PreviewPage>().primary()->trigger();
  wizard.page<OutputPage>().open();
  until([&] { return !wizard.page<OutputPage>().projection().mirror().isNull(); });
  wizard.page<OutputPage>().verify();
  until([&] { return wizard.page<OutputPage>().proof().proof() != nullptr; });
  wizard.page<OutputPage>().perfect();
  until(
      [&] { return wizard.page<OutputPage>().perfecting().outcome() && wizard.page<OutputPage>().isOpen(); });
  wizard.page<OutputPage>().addFiles(morePictures(wizard.session().path().parent_path()));
  wizard.page<OutputPage>().checkDrift();
  until([&] { return wizard.page<OutputPage>().proof().drift().has_value(); });
  wizard.page<OutputPage>().pushBack();
  const auto* nudge = wizard.window().findChild<Nudge*>();
  until([&] { return nudge->sight().has_value(); });
  photographs.takeDialog("08-push-back", "nudge");
  until([&] { return wizard.window().findChild<QDialog*>("nudge") == nullptr; });
  addFourWeeks(wizard.session().path());
  photographs.take("08-output");
  wizard.window().findChild<QPushButton*>("nights-open")->click();
  photographs.takeDialog("08-nights", "nights");
  if (wizard.session().cameras() > 1) {
    wizard.page<OutputPage>().showCamera(1);
    photographs.take("08-output-second");
    wizard.page<OutputPage>().showCamera(0);
  }
  wizard.page<OutputPage>().report();
  until([&] { return !wizard.page<OutputPage>().reportFile().isEmpty(); });
  const QString paper = QFileInfo(wizard.page<OutputPage>().reportFile()).dir().filePath("report.pdf");
  QFile::remove(folder.filePath("13-report.pdf"));
  QFile::copy(paper, folder.filePath("13-report.pdf"));
  wizard.window().close();
  photographs.takeDialog("12-question-show", "failure");
  CalibrateSettings changed = wizard.session().settings();
  changed.clustering.patchRadius += 1.0;
  wizard.session().changeSettings(changed);
  photographs.take("08-out-of-date");
  wizard.page<OutputPage>().close();
  photographs.take("08-closed");
  takeOtherShow(wizard, photographs);
  takeDoubted(wizard, photographs);
  takeReasons(wizard, photographs);
  QTest::mouseClick(wizard.window().findChild<QPushButton*>("open-settings"), Qt::LeftButton);
  photographs.takeDialog("10-settings", "settings");
  QTest::mouseClick(wizard.window().findChild<QPushButton*>("open-help"), Qt::LeftButton);
  photographs.takeDialog("11-help", "help");
  IdentifyOverlay overlay;
  overlay.show();
  for (QScreen* screen : QGuiApplication::screens())
    if (screen != QGuiApplication::primaryScreen()) {
      QTest::qWait(300);
      screen->grabWindow(0).save(folder.filePath("09-identify.png"));
    }
  return 0;
}
