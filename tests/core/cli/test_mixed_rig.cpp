// SPDX-License-Identifier: MIT
// The program as a script calls it, with devices of unlike kinds: two projectors by commands, a GigE Vision
// camera on the network, and a camera by a command whose sensor is smaller and not linear.
#include <sys/stat.h>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <atomic>
#include <fstream>
#include <mutex>
#include <thread>

#include "relucent/devices/camera_registry.h"
#include "relucent/devices/sensor_frame.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/reduction/reduced_rig.h"
#include "relucent/venue/venue.h"
#include "support/fake_gige_camera.h"
#include "support/own_network.h"

using namespace relucent;
using namespace relucent::test;
namespace fs = std::filesystem;

namespace {

constexpr Size projectorSize{32, 24}, venueCamera{28, 21};
constexpr int patience = 180'000;      // milliseconds
constexpr double brightness = 2.0;     // of the lamps: exposures are waited for
constexpr double responseGamma = 1.8;  // of the camera by command: signal = light^(1 / gamma)
constexpr devices::SensorFormat sensor{devices::SensorLayout::bayerRG, 12};

/// A bust before two projectors whose pictures are files, as two of its cameras see it: one on the network,
/// one that answers who writes "SECONDS FILE" into a pipe.
class FileRoom {
 public:
  explicit FileRoom(fs::path folder) : folder_(std::move(folder)) {
    venue::VenueSettings settings;
    settings.name = "statue3";
    settings.projector = projectorSize;
    settings.camera = venueCamera;
    settings.pathsPerPixel = 32;
    Progress silent;
    rig_ = venue::SimulatedVenue(settings, folder_ / "cache", silent).rig();
    small_ = reduction::reductionTo(venueCamera, {3, 2}, {22, 17}, 1);
    FakeGigeSettings camera;
    camera.sensor = devices::sensorSize(venueCamera, sensor);
    fake_ = std::make_unique<FakeGigeCamera>(camera, [this](const FakeGigeCamera::View& view) {
      if (view.sensor != devices::sensorSize(venueCamera, sensor) || view.format != devices::nameOf(sensor))
        return;
      const rig::RawFrame frame = photograph(0, view.seconds);
      std::this_thread::sleep_for(std::chrono::duration<double>(view.seconds));  // as a sensor does
      fillBayerRG12(frame.signal, view.bytes);
    });
    for (const char* pipe : {"ask", "answer"}) ::mkfifo((folder_ / pipe).c_str(), 0600);
    answering_ = std::thread([this] { answer(); });
  }
  ~FileRoom() {
    ends_ = true;
    std::ofstream(folder_ / "ask") << "0 none\n";
    std::ifstream(folder_ / "answer").get();
    answering_.join();
  }
  bool isRunning() const { return fake_->isRunning(); }
  Size smallSize() const { return small_.size(); }

 private:
  rig::RawFrame photograph(std::size_t camera, double seconds) {
    std::lock_guard guard(lock_);
    const char* names[] = {"left.png", "right.png"};
    for (std::size_t i = 0; i < 2; ++i)
      rig_.projectors[i]->show(fs::exists(folder_ / names[i]) ? image::readPicture(folder_ / names[i]).encoded
                                                              : image::Image(projectorSize, 3));
    return rig_.cameras[camera]->capture({{"taken", ++taken_}, 0, brightness * seconds});
  }
  void answer() {
    while (!ends_) {
      std::ifstream ask(folder_ / "ask");
      double seconds = 0.0;
      std::string file;
      if (ask >> seconds >> file && !ends_) {
        image::Image signal = reduction::Reducer(small_)(photograph(1, seconds)).signal;
        for (float& value : signal.data())
          value = std::pow(std::max(value, 0.0f), static_cast<float>(1.0 / responseGamma));
        image::writePng(file, signal, 16);
      }
      std::ofstream(folder_ / "answer") << "taken\n";
    }
  }

  fs::path folder_;
  std::mutex lock_;
  rig::Rig rig_;
  reduction::Reduction small_;
  int taken_ = 0;
  std::unique_ptr<FakeGigeCamera> fake_;
  std::atomic<bool> ends_ = false;
  std::thread answering_;
};

}  // namespace

class TestMixedRig : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  std::unique_ptr<FileRoom> room_;
  QString file(const char* name) const { return temporary_.filePath(name); }

  /// What it printed; null with a warning if it failed.
  static QJsonObject run(const QStringList& arguments) {
    QProcess process;
    process.start(qEnvironmentVariable("RELUCENT_CLI"), arguments);
    const bool hasEnded = process.waitForFinished(patience);
    if (!hasEnded) process.kill();
    if (!hasEnded || process.exitCode() != 0) qWarning("%s", process.readAllStandardError().constData());
    return QJsonDocument::fromJson(process.readAllStandardOutput()).object();
  }

 private slots:
  void initTestCase() {
    if (!devices::cameraRegistry().find("genicam")->isBuiltIn)
      QSKIP("this build has no Aravis, which both ends of this test need");
    room_ = std::make_unique<FileRoom>(temporary_.path().toStdString());
    if (!room_->isRunning()) QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
  }
  void cleanupTestCase() { room_.reset(); }

  void bothViewsAreProved() {
    const auto show = [this](const char* name) {
      return QString("cp {image} %1.part && mv %1.part %1").arg(file(name));
    };
    const QString photograph =
        QString(
            "command:echo {exposure} $(dirname {output})/$(basename {output} .exr).png > "
            "%1 && read taken < %2")
            .arg(file("ask"), file("answer"));
    const QString projector = QString("%1x%2").arg(projectorSize.width).arg(projectorSize.height);
    const QString sizes[] = {QString("%1x%2").arg(venueCamera.width).arg(venueCamera.height),
                             QString("%1x%2").arg(room_->smallSize().width).arg(room_->smallSize().height)};
    QElapsedTimer since;
    since.start();
    const QJsonObject measured =
        run({"calibrate", file("mixed"), "--projector", projector, "--projector-command", show("left.png"),
             "--projector-command", show("right.png"), "--camera", "genicam:RL01", "--camera", photograph,
             "--camera-size", sizes[0], "--camera-size", sizes[1], "--json"});
    QVERIFY(!measured.isEmpty());
    qInfo("%d photographs in %.1f s", measured["exposures"].toInt(),
          1e-3 * static_cast<double>(since.elapsed()));
    image::writePng(file("picture.png").toStdString(), pipeline::standardImages({40, 30}).front().linear, 8);
    const QJsonObject proof =
        run({"prove", file("mixed"), "--image", file("picture.png"), "--out", file("proof"), "--json"});
    QVERIFY(!proof.isEmpty());
    const QJsonArray others = proof["other_views"].toArray();
    QCOMPARE(others.size(), qsizetype{1});
    for (const QJsonObject& view : {proof, others[0].toObject()}) {
      const double before = view["before"].toObject()["psnr_measured"].toDouble();
      const QJsonObject after = view["after"].toObject();
      qInfo("%.1f dB uncorrected, %.1f dB corrected, %.1f dB predicted", before,
            after["psnr_measured"].toDouble(), after["psnr_predicted"].toDouble());
      QVERIFY(after["psnr_measured"].toDouble() > before + 3.0);
      QVERIFY(std::abs(after["psnr_measured"].toDouble() - after["psnr_predicted"].toDouble()) < 3.0);
    }
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork();
  QCoreApplication application(argc, argv);
  TestMixedRig test;
  return QTest::qExec(&test, argc, argv);
}
#include "test_mixed_rig.moc"
