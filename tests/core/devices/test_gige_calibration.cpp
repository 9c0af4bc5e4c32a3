// SPDX-License-Identifier: MIT
// A calibration of a simulated venue photographed through a GigE Vision camera's real protocol, beside the
// same venue calibrated directly.
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <mutex>

#include "relucent/base/file.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/genicam/genicam_driver.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/venue/venue.h"
#include "support/fake_gige_camera.h"
#include "support/own_network.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::venue;
using namespace std::chrono_literals;
using namespace relucent::test;
namespace fs = std::filesystem;

namespace {

constexpr int noUnplugging = 1 << 30;

CalibrateSettings smallVenue() {
  VenueSettings venue;
  venue.name = "corner";
  venue.projector = {32, 24};
  venue.camera = {28, 21};
  venue.pathsPerPixel = 32;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 9;
  settings.acquisition = settingsOf(AcquisitionMode::fast);
  return settings;
}

/// The simulated camera behind a GigE Vision one: what the latter is asked for over the network, the former
/// photographs. The number of the shot, which keys the noise, is the only thing that goes another way.
class ServedCamera : public Camera {
 public:
  explicit ServedCamera(std::unique_ptr<Camera> simulated) : simulated_(std::move(simulated)) {
    fake_ = std::make_unique<FakeGigeCamera>(FakeGigeSettings{},
                                             [this](const FakeGigeCamera::View& view) { look(view); });
    if (!fake_->isRunning()) return;
    GenicamSettings genicam;
    genicam.camera = "127.0.0.1";
    genicam.format = "BayerRG12";
    genicam.photograph = simulated_->size();
    genicam.packetSize = 9000;
    DrivenCameraSettings patience;
    patience.exposureTakesTime = false;  // neither of the two cameras waits
    patience.timeout = 200ms;
    patience.reconnectPause = 50ms;
    camera_ = std::make_unique<DrivenCamera>(makeGenicamDriver(genicam), patience);
  }
  ~ServedCamera() override {
    camera_.reset();
    fake_.reset();
  }

  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  ExposureRange exposures() const override {
    // A sensor that never saturates would be better than the venue's own.
    return simulated_->exposures();
  }
  RawFrame capture(const CaptureRequest& request) override {
    {
      std::lock_guard guard(lock_);
      request_ = request;
    }
    if (++captures_ % unplugEvery_ == 0) {
      fake_->unplug();
      fake_->plug();
    }
    return camera_->capture(request);
  }

  bool isRunning() const { return camera_ != nullptr; }
  void unplugEvery(int captures) { unplugEvery_ = captures; }
  int captures() const { return captures_; }
  const DrivenCamera& driven() const { return *camera_; }

 private:
  void look(const FakeGigeCamera::View& view) {
    CaptureRequest request;
    {
      std::lock_guard guard(lock_);
      request = request_;
    }
    request.seconds = view.seconds;
    if (view.format != "BayerRG12" ||
        view.sensor != sensorSize(simulated_->size(), {SensorLayout::bayerRG, 12}))
      return;
    fillBayerRG12(simulated_->capture(request).signal, view.bytes);
  }

  std::unique_ptr<Camera> simulated_;
  std::mutex lock_;
  CaptureRequest request_;
  int captures_ = 0;
  int unplugEvery_ = noUnplugging;
  std::unique_ptr<FakeGigeCamera> fake_;
  std::unique_ptr<DrivenCamera> camera_;
};

}  // namespace

class TestGigeCalibration : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const { return root() / "cache"; }

  EvaluateResult quality(const fs::path& calibration) const {
    EvaluateSettings settings;
    settings.methods = {Method::none, Method::mix, Method::windows};
    Progress silent;
    return evaluate(calibration, settings, cache(), silent);
  }

  /// All stages of a calibration with this rig.
  static void calibrateWith(Rig& rig, const fs::path& path) {
    Progress silent;
    CalibrationFolder folder = beginCalibration(path, smallVenue());
    const Linearization linearization = measureLinearization(folder, rig, silent);
    const Acquisition acquisition = measureAcquisition(folder, rig, linearization, {}, silent);
    const MeasuredVenue venue = measuredVenueOf(acquisition, {});
    measureInverse(folder, venue, silent);
  }

  void measureThroughSockets(const std::string& name, int unplugEvery) const {
    if (fs::exists(root() / name)) return;
    Progress silent;
    SimulatedVenue venue(std::get<VenueSettings>(smallVenue().rig), cache(), silent);
    Rig rig = venue.rig();
    auto served = std::make_unique<ServedCamera>(std::move(rig.cameras.front()));
    if (!served->isRunning()) QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
    ServedCamera& camera = *served;
    camera.unplugEvery(unplugEvery);
    rig.cameras.front() = std::move(served);
    QElapsedTimer timer;
    timer.start();
    calibrateWith(rig, root() / name);
    qInfo("%s: %d photographs, %.0f a second; the camera went away %d times", name.c_str(), camera.captures(),
          1000.0 * camera.captures() / static_cast<double>(timer.elapsed()), camera.driven().reconnections());
    QVERIFY(camera.driven().reconnections() >= camera.captures() / unplugEvery);
  }

  std::string transportBytes(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(root() / name))
      if (entry.path().filename() == "transport.npz") return readFile(entry.path());
    return {};
  }

 private slots:
  void initTestCase() {
    enterOwnNetwork();
    Progress silent;
    calibrate(root() / "direct", smallVenue(), cache(), silent);
  }

  void throughSocketsItIsAsGoodAsDirectly() {
    measureThroughSockets("served", noUnplugging);
    const EvaluateResult direct = quality(root() / "direct"), served = quality(root() / "served");
    // Exposure times are rounded to whole microseconds, full scale is a code's width away, all else is the
    // same: no more than a few leaves may fall on the other side of a threshold.
    QVERIFY(std::abs(direct.transport.frobenius - served.transport.frobenius) < 0.01);
    for (std::size_t image = 0; image < direct.images.size(); ++image)
      for (std::size_t method = 0; method < direct.images[image].methods.size(); ++method) {
        const MethodScore& a = direct.images[image].methods[method];
        const MethodScore& b = served.images[image].methods[method];
        QCOMPARE(a.method, b.method);
        qInfo("%s, %s: %.2f dB directly, %.2f dB through sockets", direct.images[image].name.c_str(),
              std::string(nameOf(a.method)).c_str(), a.psnrReachable, b.psnrReachable);
        QVERIFY(std::abs(a.psnrReachable - b.psnrReachable) < 0.3);  // less than anybody could see
      }
  }

  void switchedOffAndOnItEndsInTheSameBits() {
    measureThroughSockets("served", noUnplugging);
    measureThroughSockets("disturbed", 50);
    QVERIFY(!transportBytes("served").empty());
    QVERIFY(transportBytes("served") == transportBytes("disturbed"));
  }
};

QTEST_GUILESS_MAIN(TestGigeCalibration)
#include "test_gige_calibration.moc"
