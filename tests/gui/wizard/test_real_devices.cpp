// SPDX-License-Identifier: MIT
// Measuring with real devices, through a window and sockets. $RELUCENT_UNPLUG_CYCLES says how often they go
// away.
#include <QGuiApplication>
#include <QRasterWindow>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QThread>
#include <QtTest>
#include <atomic>

#include "gui/wizard/gige_room.h"
#include "output/window_projector.h"
#include "relucent/base/file.h"
#include "relucent/base/message.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "support/own_network.h"
#include "support/waited.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/wizard.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/session/other_screens.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::venue;
using namespace relucent::test;
namespace fs = std::filesystem;

class TestRealDevices : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  std::unique_ptr<Room> room_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const {
    const QString given = qEnvironmentVariable("RELUCENT_TEST_CACHE");
    return given.isEmpty() ? root() / "cache" : fs::path(given.toStdString());
  }

  static ScreenRigSettings devices() {
    ScreenRigSettings rig;
    rig.display = displayOf(*screenOn("DUMMY1"));
    rig.projector = wantedSizes().projector;
    rig.frameRate = frameRate;
    rig.cameraAddress = "genicam:127.0.0.1";
    rig.camera = wantedSizes().camera;
    return rig;
  }

  /// All stages with real devices; the manifest says "simulated", so that the truth can be asked for.
  /// Screen and camera go away so many times.
  void calibrateThroughDevices(const std::string& name, int cycles) {
    std::string failure;
    std::atomic<bool> waits = false;
    std::unique_ptr<QThread> worker(QThread::create([&] {
      try {
        Progress silent;
        const ScreenOpener opener = [&waits](const ScreenRigSettings& screen) {
          return std::make_unique<WindowProjector>(identityOf(screen.display), screen.projector,
                                                   [&waits](bool missing) { waits = missing; });
        };
        OpenedRig opened = openRig(devices(), {}, opener, silent);
        opened.rig.cameras[0] = std::make_unique<VenueTime>(std::move(opened.rig.cameras[0]), *room_);
        CalibrationFolder folder = beginCalibration(root() / name, simulatedSettings());
        const Linearization linearization = measureLinearization(folder, opened.rig, silent);
        const Acquisition acquisition = measureAcquisition(folder, opened.rig, linearization, {}, silent);
        const MeasuredVenue venue = measuredVenueOf(acquisition, {});
        measureInverse(folder, venue, silent);
      } catch (const std::exception& error) {
        failure = error.what();
      }
    }));
    const int before = room_->photographs();
    QElapsedTimer timer;
    timer.start();
    worker->start();
    int gone = 0;
    waitFor(*worker, [&] {
      if (gone >= cycles || room_->photographs() - before < (gone + 1) * everyPhotographs) return;
      ++gone;
      switchScreen(false);
      QTRY_VERIFY(waits || worker->isFinished());
      if (gone % 2 == 0) room_->camera().unplug();
      const int stopped = room_->photographs();
      QVERIFY(!screenOn("DUMMY1"));
      if (gone % 2 == 0) room_->camera().plug();
      switchScreen(true);
      // A camera that does not answer is given some seconds before it is connected again.
      QTRY_VERIFY_WITH_TIMEOUT(room_->photographs() > stopped || worker->isFinished(), 30000);
    });
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QVERIFY2(failure.empty(), failure.c_str());
    QCOMPARE(gone, cycles);
    const int taken = room_->photographs() - before;
    qInfo("%s: %d photographs in %.1f s, %.0f a second; screen away %d times, camera %d times", name.c_str(),
          taken, 1e-3 * static_cast<double>(timer.elapsed()),
          1e3 * taken / static_cast<double>(timer.elapsed()), gone, gone / 2);
  }

  EvaluateResult quality(const std::string& name) const {
    EvaluateSettings settings;
    settings.methods = {Method::none, Method::mix, Method::windows};
    Progress silent;
    return evaluate(root() / name, settings, cache(), silent);
  }

  /// Empty where nothing was measured.
  std::string transportBytes(const std::string& name) const {
    if (!fs::exists(root() / name)) return {};
    for (const auto& entry : fs::recursive_directory_iterator(root() / name))
      if (entry.path().filename() == "transport.npz") return readFile(entry.path());
    return {};
  }

  static constexpr int everyPhotographs = 40;

 private slots:
  void initTestCase() {
    if (!cameraRegistry().find("genicam")->isBuiltIn)
      QSKIP("this build has no Aravis, which both ends of this test need");
    QVERIFY(screenOn("DUMMY1") != nullptr);
    const QSize size = nativeSize(*screenOn("DUMMY1"));
    QCOMPARE((Size{size.width(), size.height()}), wantedSizes().projector);
    room_ = std::make_unique<Room>(std::get<VenueSettings>(simulatedSettings().rig), cache());
    if (!room_->isRunning()) QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
  }
  void cleanupTestCase() { room_.reset(); }

  void throughAWindowAndSocketsItIsAsGoodAsDirectly() {
    Progress silent;
    calibrate(root() / "direct", simulatedSettings(), cache(), silent);
    calibrateThroughDevices("real", 0);
    const EvaluateResult direct = quality("direct"), real = quality("real");
    qInfo("frobenius %.4f directly, %.4f through devices", direct.transport.frobenius,
          real.transport.frobenius);
    // Exposures are whole frames and others than directly: no more than some leaves may differ.
    QVERIFY(std::abs(direct.transport.frobenius - real.transport.frobenius) < 0.02);
    for (std::size_t image = 0; image < direct.images.size(); ++image)
      for (std::size_t method = 0; method < direct.images[image].methods.size(); ++method) {
        const MethodScore& a = direct.images[image].methods[method];
        const MethodScore& b = real.images[image].methods[method];
        qInfo("%s, %s: %.2f dB directly, %.2f dB through devices", direct.images[image].name.c_str(),
              nameOf(a.method).data(), a.psnrReachable, b.psnrReachable);
        QVERIFY(std::abs(a.psnrReachable - b.psnrReachable) < 0.3);  // less than anybody could see
      }
  }

  void unpluggedAndRepluggedItEndsInTheSameBits() {
    if (transportBytes("real").empty()) QSKIP("there is nothing to compare with");
    calibrateThroughDevices("disturbed", unplugCycles(4));
    QVERIFY(transportBytes("real") == transportBytes("disturbed"));
  }

  /// The projector hangs on another output than the one that was chosen.
  void anotherScreenThatLightsUpIsNamed() {
    switchThirdScreen(true);
    const auto unplugged = qScopeGuard([] { switchThirdScreen(false); });
    ScreenRigSettings wrong = devices();
    wrong.display = displayOf(*screenOn("DUMMY2"));
    CalibrateSettings settings = simulatedSettings();
    settings.rig = wrong;
    Session session(cache());
    session.setPatience({4, 8});
    session.begin(root() / "wrong", settings);
    session.setRoomClear(true);
    CameraPage camera(session);
    QString told;
    connect(&camera, &PageModel::failed, this, [&told](const FailureReport& report) {
      told = report.failure.what + ' ' + report.failure.advice;
    });
    camera.enter();
    QTRY_VERIFY_WITH_TIMEOUT(!told.isEmpty(), 60000);
    QCOMPARE(told,
             QString("The camera sees DUMMY1, not DUMMY2. Choose DUMMY1, or aim the camera at DUMMY2."));
    QTRY_VERIFY(session.areDevicesFree());
  }

  /// Patterns never cover the wizard, wherever it stands.
  void noScreenThatTheOperatorWorksOnLightsUp() {
    auto mayLightUp = [] {
      QStringList connectors;
      for (const ScreenRigSettings& other : otherScreens(devices()))
        connectors << QString::fromStdString(other.display.connector);
      return connectors;
    };
    QCOMPARE(mayLightUp(), QStringList());
    switchThirdScreen(true);
    const auto unplugged = qScopeGuard([] { switchThirdScreen(false); });
    QCOMPARE(mayLightUp(), QStringList("DUMMY2"));
    QCOMPARE((otherScreens(devices()).front().projector), wantedSizes().projector);
    QRasterWindow wizard;
    wizard.setGeometry(screenOn("DUMMY2")->geometry());
    wizard.show();
    QVERIFY(QTest::qWaitForWindowExposed(&wizard));
    QCOMPARE(mayLightUp(), QStringList());
  }

  /// Law: a camera that is unplugged while it measures is said within five seconds, the same on every page;
  /// it goes on by itself when it is back; and whoever does not wait keeps what is measured, at once.
  void aLostCameraIsSaidAndWaitedForOrNot() {
    CalibrateSettings settings = simulatedSettings();
    settings.rig = devices();
    Session session(cache());
    session.setPatience({4, 8});
    session.begin(root() / "lost", settings);
    session.setRoomClear(true);
    LinearizePage linearize(session);
    AcquirePage acquire(session);
    Wizard wizard(session);
    wizard.add(linearize);
    wizard.add(acquire);
    QSignalSpy failed(&acquire, &PageModel::failed);
    linearize.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session.progress(Stage::linearization) == StageProgress::done, 60000);
    QTRY_VERIFY(session.areDevicesFree());
    session.live().setLeastInterval(60);
    acquire.primary()->trigger();
    const auto loseCamera = [&] {
      QElapsedTimer since;
      room_->camera().unplug();
      since.start();
      QTRY_VERIFY_WITH_TIMEOUT(session.isCameraSilent(), 20000);
      qInfo("noticed after %.1f s", 1e-3 * static_cast<double>(since.elapsed()));
      QVERIFY(since.elapsed() < 5000);
    };
    // A level has been confirmed: there is something to keep.
    QTRY_VERIFY_WITH_TIMEOUT(acquire.trace().growth().levels.size() > 2, 60000);
    loseCamera();
    const PatternCount count = acquire.patterns();
    for (std::size_t page : {std::size_t{0}, std::size_t{1}}) {
      QVERIFY(wizard.go(page));
      const std::optional<Banner> banner = wizard.banner();
      QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->command);
      QCOMPARE(banner->command->text(), AcquirePage::tr("Stop and keep"));
    }
    QVERIFY(wizard.statusOf(1).isHeldUp && acquire.isHeldUp());
    room_->camera().plug();
    QTRY_VERIFY_WITH_TIMEOUT(!session.isCameraSilent() && acquire.patterns().taken > count.taken + 2, 30000);
    QVERIFY(!wizard.banner() && !wizard.statusOf(1).isHeldUp && acquire.isMeasuring());

    loseCamera();
    QElapsedTimer since;
    since.start();
    wizard.banner()->command->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), 30000);
    qInfo("kept after %.1f s", 1e-3 * static_cast<double>(since.elapsed()));
    QVERIFY(failed.isEmpty() && acquire.isDone() && acquire.stoppedAt() > 0);
    QCOMPARE(acquire.status().state, StepState::coarse);
    room_->camera().plug();
    session.live().setLeastInterval(0);
    acquire.banner()->command->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring() && acquire.isDone(), 60000);
    QCOMPARE(acquire.stoppedAt(), 0);
  }

  /// As a person does it, page by page.
  void theWizardCalibratesWithThem() {
    if (wantedSizes().projector.width > 64) QSKIP("a test of the pages, not of size");
    QSettings settings(QString::fromStdString((root() / "settings.ini").string()), QSettings::IniFormat);
    Session session(cache());
    session.setPatience({4, 8});
    VenuePage venue(session, RecentVenues(settings));
    CameraPage camera(session);
    LinearizePage linearize(session);
    AcquirePage acquire(session);
    for (PageModel* page : std::initializer_list<PageModel*>{&venue, &camera, &linearize, &acquire})
      connect(page, &PageModel::failed, this, [](const FailureReport& report) {
        qWarning("%s %s", qPrintable(report.failure.what), qPrintable(report.failure.advice));
      });

    venue.setFolder(QString::fromStdString((root() / "venues").string()));
    venue.setMode(VenuePage::Mode::devices);
    QVERIFY(!venue.primary()->isEnabled());  // no screen is chosen
    const std::vector<ScreenChoice> screens = screenChoices();
    QCOMPARE(screens.size(), std::size_t{2});
    for (ScreenChoice screen : screens) {
      QCOMPARE(screen.refusal.isEmpty(), screen.display.connector == "DUMMY1");
      screen.frameRate = frameRate;
      venue.chooseScreen(screen);
    }
    QCOMPARE(venue.screen().display.connector, std::string("DUMMY1"));
    venue.setRoomClear(true);
    QVERIFY2(venue.primary()->isEnabled(), qPrintable(venue.problem()));
    venue.primary()->trigger();
    QVERIFY(session.isOpen() && session.screenRig() != nullptr && session.needsConsent());

    QVERIFY(camera.needsCamera() && !camera.primary()->isEnabled());
    QSignalSpy listed(&camera, &CameraPage::camerasListed);
    camera.enter();
    QTRY_VERIFY_WITH_TIMEOUT(!camera.foundCameras().cameras.empty(), 10000);
    const ListedCamera found = camera.foundCameras().cameras.front();
    QVERIFY2(found.usable, english(found.problem).c_str());
    QElapsedTimer since;
    since.start();
    camera.chooseCamera(found.address, wantedSizes().camera);
    // A picture comes first.
    QTRY_VERIFY_WITH_TIMEOUT(camera.look().has_value(), 30000);
    qInfo("first picture after %.1f s", 1e-3 * static_cast<double>(since.elapsed()));
    QVERIFY(camera.isChecking() && !camera.check() && camera.progress().has_value());
    QVERIFY(!camera.primary()->isEnabled());
    QTRY_VERIFY_WITH_TIMEOUT(camera.look().has_value() && camera.check().has_value(), 30000);
    for (const CheckVerdict& verdict : verdictsOf(*camera.check()))
      qInfo("%s", english(messageOf(verdict)).c_str());
    QTRY_VERIFY_WITH_TIMEOUT(!camera.isChecking(), 30000);
    qInfo("checked after %.1f s", 1e-3 * static_cast<double>(since.elapsed()));
    QVERIFY(!camera.progress());
    QVERIFY(camera.check()->proof.isSeen && !camera.check()->proof.sight.mirrored);
    QVERIFY(camera.primary()->isEnabled());
    camera.primary()->trigger();
    QTRY_VERIFY(session.progress(Stage::camera) == StageProgress::done && session.areDevicesFree());

    // Who would have had another camera has the former one back as it was.
    camera.secondary().back()->trigger();
    QVERIFY(camera.needsCamera());
    QCOMPARE(camera.secondary().size(), std::size_t{1});
    camera.secondary().front()->trigger();
    QVERIFY(!camera.needsCamera());
    QCOMPARE(session.screenRig()->cameraAddress, found.address);
    QTRY_VERIFY_WITH_TIMEOUT(camera.check().has_value() && !camera.isChecking(), 30000);
    camera.primary()->trigger();
    QTRY_VERIFY(session.progress(Stage::camera) == StageProgress::done && session.areDevicesFree());

    CalibrateSettings quick = session.settings();
    quick.linearization.levels = 9;
    quick.acquisition = settingsOf(AcquisitionMode::fast);
    session.changeSettings(quick);
    linearize.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session.progress(Stage::linearization) == StageProgress::done, 60000);
    QTRY_VERIFY(session.areDevicesFree());
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session.progress(Stage::acquisition) == StageProgress::done, 60000);

    // Another venue may have the camera, though this one looked through it last.
    QTRY_VERIFY(session.areDevicesFree());
    venue.setMode(VenuePage::Mode::devices);
    QTRY_VERIFY_WITH_TIMEOUT(!venue.finder().isLooking(), 30000);
    const std::vector<ListedCamera>& offered = venue.finder().cameras().cameras;
    QVERIFY(!offered.empty());
    QVERIFY2(offered.front().usable, english(offered.front().problem).c_str());

    // Remembered: another session knows screen, camera and latency.
    const std::filesystem::path kept = session.path();
    session.close();
    Session again(cache());
    again.open(kept);
    QCOMPARE(again.screenRig()->cameraAddress, found.address);
    QCOMPARE(again.screenRig()->display.connector, std::string("DUMMY1"));
    QVERIFY(again.figures<Stage::camera>()->latencySeconds.value() > 0.0);
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork();
  QGuiApplication application(argc, argv);
  TestRealDevices test;
  return QTest::qExec(&test, argc, argv);
}
#include "test_real_devices.moc"
