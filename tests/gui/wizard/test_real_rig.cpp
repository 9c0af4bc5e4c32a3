// SPDX-License-Identifier: MIT
// A venue of several projectors and cameras, all of them real to the program: a window on each of two screens
// beside the operator's, and GigE Vision cameras in subnets of their own that photograph both.
#include <QGuiApplication>
#include <QTemporaryDir>
#include <QThread>
#include <QtTest>
#include <atomic>

#include "gui/wizard/gige_room.h"
#include "output/window_projector.h"
#include "relucent/base/file.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/genicam/genicam_driver.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/standard_images.h"
#include "support/sentences.h"
#include "support/waited.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/wizard.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/output_proof.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::venue;
using namespace relucent::test;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> screens{"DUMMY1", "DUMMY2"};
constexpr std::size_t cameras = 3;

/// A bust between two projectors that shine into each other's shadows, seen from three sides.
CalibrateSettings statue() {
  CalibrateSettings settings = simulatedSettings();
  VenueSettings venue = std::get<VenueSettings>(settings.rig);
  venue.name = "statue3";
  settings.rig = venue;
  settings.acquisition = acquisition::settingsOf(acquisition::AcquisitionMode::multiplexed);
  return settings;
}

/// What one method makes of a picture in one view.
struct Seen {
  double reachable = 0.0;
  double uncorrected = 0.0, refined = 0.0;  // dB
  std::vector<AloneScore> alone;            // projector after projector
};
Seen seenFrom(const ImageScore& image, std::size_t view) {
  const auto from = [](const auto& score) {
    return Seen{score.reachable, score.methods[0].psnrReachable, score.methods[1].psnrReachable, score.alone};
  };
  return view == 0 ? from(image) : from(image.others[view - 1]);
}

std::string addressOf(std::size_t camera) {
  return "genicam:" + ownAddress(static_cast<int>(camera));
}

}  // namespace

class TestRealRig : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  std::unique_ptr<Room> room_;
  int undisturbed_ = 0;  // photographs of all that is measured
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const {
    const QString given = qEnvironmentVariable("RELUCENT_TEST_CACHE");
    return given.isEmpty() ? root() / "cache" : fs::path(given.toStdString());
  }

  /// Other cameras stand in the room.
  void replaceCameras(std::vector<RoomCamera> all) {
    room_.reset();
    room_ = std::make_unique<Room>(std::get<VenueSettings>(statue().rig), cache(),
                                   RoomDevices{screens, std::move(all)});
    QVERIFY(room_->isRunning());
  }
  /// One has a smaller sensor, whose signal is not linear.
  static std::vector<RoomCamera> unlike() {
    const Size camera = wantedSizes().camera;
    RoomCamera other{"RL02"};
    other.sensor = reduction::reductionTo(camera, {2, 1}, {camera.width - 4, camera.height - 3}, 1);
    other.gamma = 1.6;
    return {{"RL01"}, other};
  }
  /// A new venue on both screens, with all cameras that are found.
  void begin(VenuePage& venue) const {
    venue.setFolder(QString::fromStdString((root() / "venues").string()));
    venue.setMode(VenuePage::Mode::devices);
    for (const std::string& connector : screens) {
      if (!venue.projectors().empty()) venue.addProjector();
      for (ScreenChoice screen : screenChoices()) {
        screen.frameRate = frameRate;
        if (screen.display.connector == connector) venue.chooseScreen(screen);
      }
    }
    QCOMPARE(venue.projectors().size(), screens.size());
    venue.nameProjector(1, "From the left");
    venue.finder().look();
    QTRY_VERIFY_WITH_TIMEOUT(!venue.finder().isLooking(), 10000);
    for (const ListedCamera& found : venue.finder().cameras().cameras) {
      QVERIFY2(found.usable, english(found.problem).c_str());
      venue.addCamera(found.address);
    }
    QCOMPARE(venue.cameras().size(), room_->cameras());
    venue.setRoomClear(true);
    QVERIFY2(venue.primary()->isEnabled(), qPrintable(venue.problem()));
    venue.primary()->trigger();
  }

  /// Both screens and all cameras of the room.
  ScreenRigSettings devices() const {
    std::vector<ScreenRigSettings::Screen> projectors;
    for (const std::string& screen : screens)
      projectors.push_back(
          {displayOf(*screenOn(QString::fromStdString(screen))), wantedSizes().projector, frameRate, {}});
    std::vector<ScreenRigSettings::Camera> all;
    for (std::size_t i = 0; i < room_->cameras(); ++i) all.push_back({addressOf(i), room_->size(i), {}});
    return withCameras(withScreens({}, projectors), all);
  }

  /// What opening both screens with these cameras says; empty: it opens, and is closed.
  std::string openedWith(const std::vector<std::string>& addresses) const {
    std::vector<ScreenRigSettings::Camera> all;
    for (const std::string& address : addresses) all.push_back({address, std::nullopt, {}});
    const ScreenRigSettings settings = withCameras(devices(), all);
    const ScreenOpener opener = [](const ScreenRigSettings& screen) {
      return std::make_unique<WindowProjector>(identityOf(screen.display), screen.projector);
    };
    std::string sentence;
    std::unique_ptr<QThread> worker(QThread::create([&] {
      Progress silent;
      sentence = sentenceOf([&] { openRig(settings, {}, opener, silent); }, ErrorKind::input);
    }));
    worker->start();
    if (!QTest::qWaitFor([&worker] { return worker->isFinished(); }, 60000)) return "it takes too long";
    return sentence;
  }

  /// The devices as openRig() makes them, but for how long the cameras are waited for.
  ScreenRig hastyDevices(std::atomic<int>& waiting) const {
    std::vector<std::unique_ptr<ScreenProjector>> projectors;
    for (const ScreenRigSettings::Screen& screen : screensOf(devices()))
      projectors.push_back(
          std::make_unique<WindowProjector>(identityOf(screen.display), screen.projector,
                                            [&waiting](bool missing) { waiting += missing ? 1 : -1; }));
    DrivenCameraSettings hasty;
    hasty.reconnectFor = 2000ms;
    std::vector<std::unique_ptr<Camera>> all;
    for (std::size_t i = 0; i < cameras; ++i) {
      GenicamSettings genicam;
      genicam.camera = ownAddress(static_cast<int>(i));
      genicam.photograph = room_->size(i);
      all.push_back(std::make_unique<DrivenCamera>(makeGenicamDriver(genicam), hasty));
    }
    return screenRig(std::move(projectors), std::move(all), {0.0, 1.0 / frameRate}, sleepFor);
  }

  /// All stages with real devices, or what is left of them; the manifest says "simulated", so that the truth
  /// can be asked for. `meanwhile` is called again and again. What failed, a sentence; empty: nothing.
  std::string measured(const std::string& name, const std::function<void(int waiting)>& meanwhile = {}) {
    std::string failure;
    std::atomic<int> waiting = 0;
    std::unique_ptr<QThread> worker(QThread::create([&] {
      try {
        Progress silent;
        ScreenRig opened = hastyDevices(waiting);
        for (std::size_t i = 0; i < cameras; ++i)
          opened.rig.cameras[i] = std::make_unique<VenueTime>(std::move(opened.rig.cameras[i]), *room_, i);
        CalibrationFolder folder =
            fs::exists(root() / name)
                ? CalibrationFolder::open(root() / name, CalibrationFolder::Access::write)
                : beginCalibration(root() / name, statue());
        const linearization::Linearization linearization = measureLinearization(folder, opened.rig, silent);
        measureInverse(folder,
                       measuredVenueOf(measureAcquisition(folder, opened.rig, linearization, {}, silent), {}),
                       silent);
      } catch (const std::exception& error) {
        failure = error.what();
      }
    }));
    QElapsedTimer timer;
    timer.start();
    const int before = room_->photographs();
    worker->start();
    waitFor(*worker, [&] {
      if (meanwhile) meanwhile(waiting);
    });
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    qInfo("%s: %d photographs in %.1f s", name.c_str(), room_->photographs() - before,
          1e-3 * static_cast<double>(timer.elapsed()));
    return failure;
  }

  fs::path picture() const {
    const fs::path file = root() / "picture.png";
    if (!fs::exists(file)) image::writePng(file, standardImages({40, 30}).front().linear, 8);
    return file;
  }
  EvaluateResult quality(const std::string& name) const {
    EvaluateSettings settings;
    settings.methods = {Method::none, Method::refined};
    settings.images = {picture()};
    settings.blended = true;
    Progress silent;
    return evaluate(root() / name, settings, cache(), silent);
  }

  std::string transportBytes(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(root() / name))
      if (entry.path().filename() == "transport.npz") return readFile(entry.path());
    return {};
  }

 private slots:
  void initTestCase() {
    if (!cameraRegistry().find("genicam")->isBuiltIn)
      QSKIP("this build has no Aravis, which both ends of this test need");
    QVERIFY(screenOn("DUMMY1") != nullptr);
    switchThirdScreen(true);
    const RoomDevices devices{screens, {{"RL01"}, {"RL02"}, {"RL03"}}};
    room_ = std::make_unique<Room>(std::get<VenueSettings>(statue().rig), cache(), devices);
    if (!room_->isRunning())
      QSKIP("no GigE Vision cameras can be simulated: is there a loopback network of this test's own?");
  }
  void cleanupTestCase() {
    room_.reset();
    switchThirdScreen(false);
  }

  /// Law: windows, screens and networks take nothing away, in no view; and both projectors together reach
  /// what neither does alone.
  void throughWindowsAndSocketsEveryViewIsAsGoodAsDirectly() {
    Progress silent;
    calibrate(root() / "direct", statue(), cache(), silent);
    const int before = room_->photographs();
    QCOMPARE(measured("real"), std::string());
    undisturbed_ = room_->photographs() - before;
    const EvaluateResult direct = quality("direct"), real = quality("real");
    qInfo("frobenius %.4f directly, %.4f through devices", direct.transport.frobenius,
          real.transport.frobenius);
    QVERIFY(std::abs(direct.transport.frobenius - real.transport.frobenius) < 0.02);
    for (std::size_t image = 0; image < real.images.size(); ++image)
      for (std::size_t view = 0; view < cameras; ++view) {
        const Seen directly = seenFrom(direct.images[image], view),
                   through = seenFrom(real.images[image], view);
        qInfo("%s, view %zu: %.2f dB uncorrected, %.2f dB directly, %.2f dB through devices",
              real.images[image].name.c_str(), view + 1, through.uncorrected, directly.refined,
              through.refined);
        QVERIFY(through.refined > directly.refined - 1.0);  // other exposures, other noise
        QVERIFY(through.refined > through.uncorrected + 6.0);
        double best = 0.0;
        for (const AloneScore& alone : through.alone) {
          const double dB = alone.optimum ? alone.optimum->psnrReachable : 0.0;
          qInfo("  %.1f %% in reach, %.1f %% of one projector alone, %.2f dB", 100.0 * through.reachable,
                100.0 * alone.reachable, dB);
          // The statue's front has places that only one of them lights; a side is nearly all one's.
          QVERIFY(through.reachable >= alone.reachable + (view == 0 ? 0.1 : 0.0));
          best = std::max(best, dB);
        }
        QVERIFY(through.refined > best + 3.0);
      }
  }

  /// Law: whichever screen or camera goes away for a while, in turn, nothing is told and nothing is lost. A
  /// camera that stays away is named, and what all of them photographed stays: it ends in the same bits.
  void whateverGoesAwayItEndsInTheSameBits() {
    if (transportBytes("real").empty()) QSKIP("there is nothing to compare with");
    const std::vector<std::function<void(bool)>> cables{
        [](bool on) {
          switchScreen(on);
          if (on) switchThirdScreen(on);  // its place depends on the other's
        },
        [this](bool on) { on ? room_->camera(2).plug() : room_->camera(2).unplug(); },
    };
    constexpr int every = 80;  // photographs
    const int begun = room_->photographs();
    std::size_t gone = 0;
    bool isOut = false;
    QElapsedTimer since;
    const std::string failure = measured("disturbed", [&](int waiting) {
      const int next = begun + every * (static_cast<int>(gone) + 1);
      const bool isScreen = gone % 2 == 0;
      if (!isOut && room_->photographs() >= next) {
        if (gone == cables.size()) return room_->camera(1).unplug();
        cables[gone](false);
        isOut = true;
        since.start();
      } else if (isOut && (isScreen ? waiting > 0 : since.hasExpired(500))) {
        cables[gone++](true);
        isOut = false;
      }
    });
    QCOMPARE(gone, cables.size());
    QVERIFY(mentions(failure, addressOf(1) + ": the camera has been gone for"));
    QVERIFY(mentions(failure, "every photograph so far is kept"));
    for (std::size_t other : {std::size_t{0}, std::size_t{2}})
      QVERIFY2(failure.find(addressOf(other)) == std::string::npos, failure.c_str());
    room_->camera(1).plug();
    const int kept = room_->photographs() - begun;
    QCOMPARE(measured("disturbed"), std::string());
    const int all = room_->photographs() - begun;
    qInfo("%d photographs, then %d; %d undisturbed", kept, all - kept, undisturbed_);
    // Each time a pattern at most, and what a new camera is tried with, are photographed anew.
    QVERIFY(all < undisturbed_ + 60);
    QVERIFY(transportBytes("real") == transportBytes("disturbed"));
  }

  /// As a person does it, page by page, with cameras of unlike sensors, one of which is not linear. A lost
  /// camera or screen is named. Each view is proved by its photograph, and is better than where only the
  /// other one's is asked for.
  void theWizardCalibratesUnlikeCameras() {
    replaceCameras(unlike());
    QSettings settings(QString::fromStdString((root() / "settings.ini").string()), QSettings::IniFormat);
    Session session(cache());
    session.setPatience({4, 8});
    VenuePage venue(session, RecentVenues(settings));
    CameraPage camera(session);
    LinearizePage linearize(session);
    AcquirePage acquire(session);
    Wizard wizard(session);
    QStringList failures;
    for (PageModel* page : std::initializer_list<PageModel*>{&venue, &camera, &linearize, &acquire}) {
      wizard.add(*page);
      connect(page, &PageModel::failed, this, [&failures](const FailureReport& report) {
        failures << report.failure.what + report.failure.details;
      });
    }
    const auto hasWorked = [&failures] {
      if (!failures.empty()) qWarning("%s", qPrintable(failures.join('\n')));
      return failures.empty();
    };

    begin(venue);
    QVERIFY(session.isOpen() && session.screenRig() != nullptr);
    camera.enter();
    QTRY_VERIFY_WITH_TIMEOUT(!failures.empty() || camera.areChecksDone(), 60000);
    QVERIFY(hasWorked());
    for (std::size_t i = 0; i < room_->cameras(); ++i)
      QCOMPARE(camera.look(i)->frame.signal.size(), room_->size(i));
    camera.primary()->trigger();
    QTRY_VERIFY(session.progress(Stage::camera) == StageProgress::done && session.areDevicesFree());
    CalibrateSettings quick = session.settings();
    quick.linearization.levels = 9;
    session.changeSettings(quick);
    linearize.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(
        !failures.empty() || session.progress(Stage::linearization) == StageProgress::done, 60000);
    QVERIFY(hasWorked());
    QTRY_VERIFY(session.areDevicesFree());

    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(acquire.patterns().taken > 5, 60000);
    room_->camera(1).unplug();
    QTRY_VERIFY_WITH_TIMEOUT(wizard.banner().has_value(), 20000);
    QCOMPARE(wizard.banner()->sentence, QString("Camera 2 does not answer"));
    room_->camera(1).plug();
    QTRY_VERIFY_WITH_TIMEOUT(!wizard.banner().has_value(), 30000);
    switchThirdScreen(false);
    QTRY_VERIFY_WITH_TIMEOUT(wizard.banner().has_value(), 20000);
    QCOMPARE(wizard.banner()->sentence, QString("From the left: its screen is unplugged"));
    switchThirdScreen(true);
    QTRY_VERIFY_WITH_TIMEOUT(!failures.empty() || session.progress(Stage::acquisition) == StageProgress::done,
                             120000);
    QVERIFY(hasWorked() && !wizard.banner());
    QTRY_VERIFY(session.areDevicesFree());

    OutputProof proof(session, AcquirePage::stepName);
    connect(&proof, &OutputProof::failed, this,
            [&failures](const Failure& failure) { failures << failure.what; });
    const auto proved = [&](double first, double second) {
      CalibrateSettings weighted = session.settings();
      weighted.content.views.assign(2, {});
      weighted.content.views[0].weight = first;
      weighted.content.views[1].weight = second;
      session.changeSettings(weighted);
      proof.photograph(QString::fromStdString(picture().string()), Canvas());
      if (!QTest::qWaitFor([&] { return proof.work() == OutputProof::Work::none; }, 60000) ||
          !proof.proof() || proof.isOutOfDate())
        return ProveResult();
      return proof.proof()->figures;
    };
    const ProveResult both = proved(1, 1), one = proved(1, 0), other = proved(0, 1);
    QVERIFY(hasWorked());
    QVERIFY(isAsPredicted(both));
    for (std::size_t view = 0; view < 2; ++view) {
      const ProvedView joint = viewOf(both, view), ignored = viewOf(view == 0 ? other : one, view);
      qInfo(
          "view %zu: %.1f dB uncorrected, %.1f dB corrected (predicted %.1f dB); %.1f dB where it is not "
          "asked for",
          view + 1, joint.before.measured.psnr, joint.after.measured.psnr, joint.after.predicted.psnr,
          ignored.after.measured.psnr);
      QVERIFY(joint.after.measured.psnr > joint.before.measured.psnr + 3.0);
      QVERIFY(joint.after.measured.psnr > ignored.after.measured.psnr + 3.0);
    }
  }

  /// Law: two cameras of one serial number are told apart by their network addresses; one camera by both of
  /// its addresses is not taken for two, nor for one that another program has.
  void twoCamerasOfOneSerialNumber() {
    std::vector<RoomCamera> twins = unlike();
    twins[1].serial = twins[0].serial;
    replaceCameras(twins);
    QCOMPARE(openedWith({addressOf(0), addressOf(1)}), std::string());
    replaceCameras(unlike());
    QCOMPARE(openedWith({"genicam:RL01", "genicam:RL02"}), std::string());
    const std::string sentence = openedWith({"genicam:RL01", addressOf(1), addressOf(0)});
    QVERIFY(mentions(sentence, "cameras 1 and 3 are the same device: both are " + addressOf(0) + "; choose"));
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork(cameras);
  QGuiApplication application(argc, argv);
  TestRealRig test;
  return QTest::qExec(&test, argc, argv);
}
#include "test_real_rig.moc"
