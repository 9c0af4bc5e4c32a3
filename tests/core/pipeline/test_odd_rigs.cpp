// SPDX-License-Identifier: MIT
// Rigs of several devices that were put up wrongly, measured as far as they can be.
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/image/image.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/reduction/reduced_rig.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::venue;

namespace {

CalibrateSettings smallVenue(const std::string& name) {
  VenueSettings venue;
  venue.name = name;
  venue.projector = {32, 24};
  venue.camera = {28, 21};
  venue.pathsPerPixel = 32;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 9;
  return settings;
}

/// With its lens covered.
class CoveredProjector : public Projector {
 public:
  explicit CoveredProjector(std::unique_ptr<Projector> projector) : projector_(std::move(projector)) {}
  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const image::Image&) override { projector_->show(image::Image(size(), 3)); }

 private:
  std::unique_ptr<Projector> projector_;
};

/// A part of what another camera sees.
class PartOfCamera : public Camera {
 public:
  PartOfCamera(Camera& camera, std::string name, Pixel begin, Size part)
      : camera_(camera),
        name_(std::move(name)),
        part_(reduction::reductionTo(camera.size(), begin, part, 1)) {}
  std::string name() const override { return name_; }
  Size size() const override { return part_.reduction().size(); }
  ExposureRange exposures() const override { return camera_.exposures(); }
  RawFrame capture(const CaptureRequest& request) override { return part_(camera_.capture(request)); }

 private:
  Camera& camera_;
  std::string name_;
  reduction::Reducer part_;
};

/// Its cap is on: it sees its own noise.
class CameraInTheDark : public Camera {
 public:
  std::string name() const override { return "in the dark"; }
  Size size() const override { return {20, 16}; }
  ExposureRange exposures() const override { return {1e-4, 10.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    Random random(
        {7, static_cast<std::uint64_t>(request.shot.number), static_cast<std::uint64_t>(request.exposure)});
    image::Image noise(size(), 3);
    for (float& value : noise.data()) value = static_cast<float>(random.below(4)) / 4095.0f;
    return {std::move(noise), 12, request.seconds};
  }
};

}  // namespace

class TestOddRigs : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  std::filesystem::path path(const char* name) const { return temporary_.filePath(name).toStdString(); }

  static MeasuredCalibration measured(CalibrationFolder& folder, Rig& rig) {
    Progress silent;
    const linearization::Linearization linearization = measureLinearization(folder, rig, silent);
    measureInverse(folder, measuredVenueOf(measureAcquisition(folder, rig, linearization, {}, silent), {}),
                   silent);
    return loadCalibration(folder, silent);
  }

 private slots:
  /// It is told before hundreds of patterns are shown by it in vain.
  void aProjectorThatNoCameraSees_data() {
    QTest::addColumn<int>("covered");
    QTest::newRow("the first") << 0;
    QTest::newRow("the second") << 1;
  }
  void aProjectorThatNoCameraSees() {
    QFETCH(int, covered);
    const CalibrateSettings settings = smallVenue("relief");
    Progress silent;
    OpenedRig opened = openRig(settings.rig, path("cache"), silent);
    std::unique_ptr<Projector>& projector = opened.rig.projectors[static_cast<std::size_t>(covered)];
    projector = std::make_unique<CoveredProjector>(std::move(projector));
    CalibrationFolder folder = beginCalibration(path(covered == 0 ? "first" : "second"), settings);
    const std::string told = sentenceOf([&] { measured(folder, opened.rig); }, ErrorKind::input);
    QVERIFY(
        mentions(told, "simulated projector " + std::to_string(covered + 1) +
                           ": no camera can measure the white of this projector; check that its picture"));
  }

  void aCameraInTheDark() {
    const CalibrateSettings settings = smallVenue("relief");
    Progress silent;
    OpenedRig opened = openRig(settings.rig, path("cache"), silent);
    opened.rig.cameras.push_back(std::make_unique<CameraInTheDark>());
    CalibrationFolder folder = beginCalibration(path("dark"), settings);
    const std::string told = sentenceOf([&] { measured(folder, opened.rig); }, ErrorKind::input);
    QVERIFY(
        mentions(told, "in the dark: the camera sees no difference between a white and a black projection"));
  }

  /// All is measured, and said: no picture lies in the second one's view.
  void camerasThatShareNoLitPixel() {
    const CalibrateSettings settings = smallVenue("plain");
    Progress silent;
    OpenedRig opened = openRig(settings.rig, path("cache"), silent);
    const std::unique_ptr<Camera> whole = std::move(opened.rig.cameras.front());
    const Size size = whole->size();
    opened.rig.cameras.clear();
    opened.rig.cameras.push_back(
        std::make_unique<PartOfCamera>(*whole, "left", Pixel{0, 0}, Size{12, size.height}));
    opened.rig.cameras.push_back(
        std::make_unique<PartOfCamera>(*whole, "right", Pixel{size.width - 12, 0}, Size{12, size.height}));
    CalibrationFolder folder = beginCalibration(path("apart"), settings);
    const std::vector<Message> findings = summaryOf(folder, measured(folder, opened.rig)).findings;
    const auto isTold = [](const Message& finding) {
      return english(finding).starts_with("camera 2 sees no lit place that another camera sees");
    };
    QCOMPARE(std::ranges::count_if(findings, isTold), 1);
  }
};

QTEST_GUILESS_MAIN(TestOddRigs)
#include "test_odd_rigs.moc"
