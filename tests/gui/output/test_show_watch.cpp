// SPDX-License-Identifier: MIT
// A camera that watches a show: what it tells, and that its troubles are nobody else's.
#include "output/show_watch.h"

#include <QJsonArray>
#include <QSignalSpy>
#include <QtTest>
#include <array>
#include <atomic>

#include "relucent/base/error.h"
#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::gui;
using monitoring::FindingKind;

namespace {

constexpr Size raster{32, 24};
constexpr float perDrive = 10.0f, black = 0.1f;  // camera signal per second

/// What stands before the scripted camera.
struct Scene {
  std::atomic<float> lamp{1.0f};
  std::atomic<bool> unplugged{false};
  std::atomic<bool> inTheWay{false};  // somebody, in the light of the second projector
  std::atomic<int> photographs{0}, opened{0}, read{0}, held{0};
  std::vector<QImage> pictures;  // one a projector
};

QImage blobs(double slower = 1.0) {
  QImage picture(raster.width, raster.height, QImage::Format_RGBX8888);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const auto level = [&](double f) {
        return static_cast<int>(120 + 80 * std::sin(slower * f * x) * std::cos(0.3 * y));
      };
      picture.setPixel(x, y, qRgb(level(0.4), level(0.5), level(0.3)));
    }
  return picture;
}

class ScriptedCamera : public rig::Camera {
 public:
  explicit ScriptedCamera(std::shared_ptr<Scene> scene) : scene_(std::move(scene)) { ++scene_->held; }
  ~ScriptedCamera() override { --scene_->held; }
  std::string name() const override { return "scripted"; }
  Size size() const override { return raster; }
  rig::ExposureRange exposures() const override { return {0.01, 0.1}; }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    ++scene_->photographs;
    if (scene_->unplugged)
      throw Error(ErrorKind::device, Message::plain("the cable is out"), Message::plain("push it in"));
    rig::RawFrame frame{image::Image(raster, 3), 12, request.seconds};
    Random random({static_cast<std::uint64_t>(request.shot.number)});
    for (std::size_t i = 0; i < raster.count(); ++i) {
      const Pixel at = pixelAt(raster, i);
      std::array<int, 3> codes{};
      for (std::size_t j = 0; j < scene_->pictures.size(); ++j) {
        if (j == 1 && scene_->inTheWay && at.x >= 8 && at.x < 20 && at.y >= 6 && at.y < 18) continue;
        const QRgb code = scene_->pictures[j].pixel(at.x, at.y);
        codes = {codes[0] + qRed(code), codes[1] + qGreen(code), codes[2] + qBlue(code)};
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = black + perDrive * scene_->lamp * static_cast<float>(codes[c]) / 255.0f;
        const float signal =
            light * static_cast<float>(request.seconds) + 1e-3f * static_cast<float>(random.normal());
        frame.signal.pixel(i)[c] = std::clamp(signal, 0.0f, 1.0f);
      }
    }
    return frame;
  }

 private:
  std::shared_ptr<Scene> scene_;
};

class ScriptedSource : public WatchSource {
 public:
  explicit ScriptedSource(std::shared_ptr<Scene> scene, bool broken = false)
      : scene_(std::move(scene)), broken_(broken) {}
  pipeline::WatchingCamera read(Progress&) override {
    ++scene_->read;
    if (broken_)
      throw Error(ErrorKind::input, Message::plain("the calibration is gone"),
                  Message::plain("bring it back"));
    const std::size_t projectors = scene_->pictures.size();
    const Rasters projector(std::vector<Size>(projectors, raster));
    transport::BlockSparseBuilder builder(transport::NodeLayout(projector).count(),
                                          std::vector<float>(raster.count(), perDrive));
    for (std::size_t i = 0; i < raster.count(); ++i)
      for (std::size_t j = 0; j < projectors; ++j)
        builder.add(i, j * raster.count() + i, perDrive * transport::ColourBlock::Identity());
    const transport::TransportMatrix transport(Rasters(raster), projector, builder.build());
    pipeline::WatchingCamera watching;
    watching.venue.sampling = monitoring::sampledPixels(raster, std::vector<std::uint8_t>(raster.count(), 1));
    watching.venue.transport = monitoring::SampledTransport(transport, watching.venue.sampling.pixels);
    watching.venue.black.assign(3 * raster.count(), black);
    watching.venue.flood.assign(3 * raster.count(), perDrive * static_cast<float>(projectors));
    watching.venue.camera.readNoise = 1e-3;
    watching.exposures = {0.05, 0.02};
    watching.lights.resize(projectors);
    for (auto& lights : watching.lights)
      for (auto& channel : lights)
        for (std::size_t code = 0; code < 256; ++code) channel[code] = static_cast<float>(code) / 255.0f;
    return watching;
  }
  void open(pipeline::WatchingCamera& watching) override {
    ++scene_->opened;
    if (scene_->unplugged)
      throw Error(ErrorKind::device, Message::plain("the cable is out"), Message::plain("push it in"));
    watching.used.cameras.push_back(std::make_unique<ScriptedCamera>(scene_));
  }

 private:
  std::shared_ptr<Scene> scene_;
  bool broken_;
};

}  // namespace

class TestShowWatch : public QObject {
  Q_OBJECT

  std::shared_ptr<Scene> scene_;
  std::shared_ptr<PlayedTap> tap_;
  /// Two seconds pass from photograph to photograph, whatever the time.
  static WatchPace quick() {
    using std::chrono::milliseconds;
    return {milliseconds(1), milliseconds(0), milliseconds(1),
            [now = std::make_shared<double>(0.0)] { return *now += 2.0; }};
  }
  std::unique_ptr<ShowWatch> watched(bool broken = false, bool fillsShadows = false) {
    WatchPace pace = quick();
    pace.fillsShadows = fillsShadows;
    pace.betweenShadows = pace.between;
    return std::make_unique<ShowWatch>(std::make_unique<ScriptedSource>(scene_, broken), tap_, pace);
  }
  void play() {
    std::vector<DrivePicture> drives;
    for (const QImage& picture : scene_->pictures) drives.emplace_back(picture);
    tap_->put(drives);
  }

 private slots:
  void init() {
    scene_ = std::make_shared<Scene>();
    scene_->pictures = {blobs()};
    tap_ = std::make_shared<PlayedTap>();
    play();
  }

  void whatLastsIsToldAndThatItIsOver() {
    auto watch = watched();
    QSignalSpy found(watch.get(), &ShowWatch::found), over(watch.get(), &ShowWatch::over);
    watch->setPlaying(true);
    QTRY_VERIFY(watch->status().used > 30);
    QCOMPARE(watch->status().state, WatchState::watching);
    QVERIFY2(found.isEmpty(), "nothing has changed");
    scene_->lamp = 0.9f;
    QTRY_COMPARE(found.size(), 1);
    const auto finding = found.front().front().value<monitoring::Finding>();
    QCOMPARE(finding.kind, FindingKind::faded);
    QVERIFY(std::abs(finding.amount - 0.1) < 0.01);
    const QJsonObject json = toJson(watch->status());
    QCOMPARE(json["state"].toString(), QString("watching"));
    QCOMPARE(json["findings"][0]["kind"].toString(), QString("faded"));
    QVERIFY(json["findings"][0]["what"].toString().contains("10 % less light"));
    QVERIFY(!json["findings"][0]["advice"].toString().isEmpty());
    scene_->lamp = 1.0f;
    QTRY_COMPARE(over.size(), 1);
    QTRY_VERIFY(watch->status().findings.empty());
  }

  void aCameraThatIsGoneIsToldOnceAndWaitedFor() {
    auto watch = watched();
    QSignalSpy failed(watch.get(), &ShowWatch::failed);
    watch->setPlaying(true);
    QTRY_VERIFY(watch->status().used > 3);
    scene_->unplugged = true;
    QTRY_COMPARE(watch->status().state, WatchState::noCamera);
    QTRY_VERIFY(scene_->opened > 3);
    QCOMPARE(failed.size(), 1);
    QVERIFY(english(failed.front().front().value<Message>()).find("the cable is out") != std::string::npos);
    const int before = watch->status().used;
    scene_->unplugged = false;
    QTRY_VERIFY(watch->status().used > before);
    QCOMPARE(watch->status().state, WatchState::watching);
    QVERIFY(!toJson(watch->status()).contains("problem"));
  }

  void aCalibrationThatCannotBeReadIsTold() {
    auto watch = watched(true);
    QSignalSpy failed(watch.get(), &ShowWatch::failed);
    watch->setPlaying(true);
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(watch->status().state, WatchState::noCalibration);
    QCOMPARE(scene_->photographs, 0);
  }

  void nothingIsPhotographedWhileBlack() {
    auto watch = watched();
    QTRY_COMPARE(watch->status().state, WatchState::paused);
    QCOMPARE(scene_->photographs, 0);
    watch->setPlaying(true);
    QTRY_VERIFY(watch->status().used > 3);
    watch->setPlaying(false);
    QTRY_COMPARE(watch->status().state, WatchState::paused);
    const int photographs = scene_->photographs;
    watch->setPlaying(true);
    QTRY_VERIFY(scene_->photographs > photographs);
  }

  /// Who measures needs the camera for itself.
  void theCameraIsFreeWhileNothingPlays() {
    auto watch = watched();
    Progress quiet;
    watch->camera()->awaitFree(quiet);  // it has not begun
    for (int time = 0; time < 3; ++time) {
      watch->setPlaying(true);
      // Counted where they are taken: what the watch tells is still under way from before.
      const int photographs = scene_->photographs;
      QTRY_VERIFY(scene_->photographs > photographs + 3);
      QCOMPARE(scene_->held.load(), 1);
      watch->setPlaying(false);
      watch->camera()->awaitFree(quiet);
      QCOMPARE(scene_->held.load(), 0);
    }
    watch->setPlaying(true);
    QTRY_COMPARE(scene_->held.load(), 1);
    watch.reset();
    QCOMPARE(scene_->held.load(), 0);
  }

  void anotherMeasurementIsReadAndBeginsAnew() {
    auto watch = watched();
    QSignalSpy found(watch.get(), &ShowWatch::found);
    watch->setPlaying(true);
    scene_->lamp = 0.9f;
    QTRY_COMPARE(found.size(), 1);
    QCOMPARE(scene_->read.load(), 1);
    scene_->lamp = 1.0f;
    watch->readAgain();
    QTRY_COMPARE(scene_->read.load(), 2);
    QTRY_VERIFY(watch->status().findings.empty());
    const int used = watch->status().used;
    QTRY_VERIFY(watch->status().used > used + 3);
    watch->setPlaying(false);
    watch->readAgain();
    QTRY_COMPARE(scene_->read.load(), 3);
    QCOMPARE(scene_->held.load(), 0);
  }

  /// Whose light it is, told at once, with what is to be projected; and that it is over. What lasts is
  /// watched too.
  void aShadowIsToldAtOnce() {
    scene_->pictures = {blobs(), blobs(0.6)};
    play();
    auto watch = watched(false, true);
    QSignalSpy shadows(watch.get(), &ShowWatch::shadowsChanged), cannot(watch.get(), &ShowWatch::cannotFill);
    watch->setPlaying(true);
    QTRY_VERIFY(watch->status().used > 3);
    QVERIFY(shadows.isEmpty() && watch->status().available == nullptr);
    QCOMPARE(toJson(watch->status())["filled"].toArray().size(), 0);
    scene_->inTheWay = true;
    QTRY_VERIFY(!shadows.isEmpty());
    QVERIFY(watch->status().available != nullptr);
    QCOMPARE(watch->status().filled.front().projector, 1u);
    const QJsonObject told = toJson(watch->status())["filled"][0].toObject();
    QCOMPARE(told["projector"].toInt(), 2);
    QVERIFY(told["what"].toString().contains("projector 2"));
    QVERIFY(std::abs(told["x"].toDouble() - 14.0 / 32) < 0.1);
    scene_->inTheWay = false;
    QTRY_VERIFY(watch->status().available == nullptr);
    scene_->inTheWay = true;
    QTRY_VERIFY(watch->status().available != nullptr);
    watch->setPlaying(false);
    QTRY_VERIFY2(watch->status().available == nullptr, "nobody looks any more");
    QVERIFY(cannot.isEmpty());
  }

  void whereNoProjectorsOverlapNothingIsFilled() {
    auto watch = watched(false, true);
    QSignalSpy cannot(watch.get(), &ShowWatch::cannotFill);
    watch->setPlaying(true);
    QTRY_COMPARE(cannot.size(), 1);
    QVERIFY(english(cannot.front().front().value<Message>()).find("no place that two projectors light") !=
            std::string::npos);
    QTRY_VERIFY(watch->status().used > 3);
    QVERIFY(!toJson(watch->status()).contains("filled"));
  }

  void theTapKeepsTheNewestFramesWhileSomebodyAsks() {
    QVERIFY(tap_->end().empty());
    tap_->begin();
    for (int n = 0; n < 50; ++n) tap_->put({DrivePicture(blobs())});
    const std::vector<PlayedTap::Sent> sent = tap_->end();
    QCOMPARE(sent.size(), std::size_t{20});
    for (std::size_t i = 1; i < sent.size(); ++i) QVERIFY(sent[i].seconds >= sent[i - 1].seconds);
    tap_->put({DrivePicture(blobs())});
    QVERIFY2(tap_->end().empty(), "nobody asks");
    tap_->begin();
    QCOMPARE(tap_->end().size(), std::size_t{1});  // the one that is shown
  }
};

QTEST_GUILESS_MAIN(TestShowWatch)
#include "test_show_watch.moc"
