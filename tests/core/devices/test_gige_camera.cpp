// SPDX-License-Identifier: MIT
// GenICam cameras through real sockets: Aravis' GigE Vision camera on the loopback network, and what goes
// wrong with such cameras.
#include <QtTest>
#include <atomic>
#include <thread>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/genicam/genicam_driver.h"
#include "support/fake_gige_camera.h"
#include "support/own_network.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;
using namespace std::chrono_literals;
using namespace relucent::test;

namespace {

constexpr Size photograph{32, 24};

/// The camera's side of the venue: fills frames with codes that depend on `scene` alone.
struct Sight {
  std::atomic<unsigned> scene{1};
  std::atomic<double> seconds{0.0};
  std::atomic<unsigned> gain{0};
  std::atomic<int> looks{0};
  std::atomic<std::size_t> pixels{0};  // of the sensor that were delivered last
  Pixel begin;                         // of the whole photograph on the sensor
  std::function<void(int)> whileLooking = [](int) {};

  static std::vector<std::uint8_t> bytesOf(Size sensor, int bits, unsigned scene) {
    Random random{7, scene};
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < sensor.count(); ++i) {
      const auto code = static_cast<unsigned>(random.below(1u << bits));
      bytes.push_back(static_cast<std::uint8_t>(code & 0xffu));
      if (bits > 8) bytes.push_back(static_cast<std::uint8_t>(code >> 8));
    }
    return bytes;
  }

  void operator()(const FakeGigeCamera::View& view) {
    seconds = view.seconds;
    gain = view.gain;
    const unsigned now = scene;
    whileLooking(++looks);
    if (view.format == "other") return;
    pixels = view.sensor.count();
    const SensorFormat format = *sensorFormatFromName(view.format);
    const Size whole = sensorSize(photograph, format);
    if (view.sensor.count() >= whole.count()) {
      begin = view.begin;
      const std::vector<std::uint8_t> bytes = bytesOf(view.sensor, format.bits, now);
      std::copy(bytes.begin(), bytes.end(), view.bytes);
      return;
    }
    const std::vector<std::uint8_t> bytes = bytesOf(whole, format.bits, now);
    const int each = format.bits > 8 ? 2 : 1;
    std::uint8_t* to = view.bytes;
    for (int y = 0; y < view.sensor.height; ++y) {
      const int row = (view.begin.y - begin.y + y) * whole.width + view.begin.x - begin.x;
      to = std::copy_n(bytes.begin() + each * row, each * view.sensor.width, to);
    }
  }
};

struct Venue {
  Sight sight;
  std::unique_ptr<FakeGigeCamera> fake;
  std::unique_ptr<DrivenCamera> camera;

  explicit Venue(FakeGigeSettings settings = {}) {
    fake = std::make_unique<FakeGigeCamera>(settings, [this](const FakeGigeCamera::View& v) { sight(v); });
  }
  ~Venue() {
    camera.reset();
    fake.reset();
  }
  static GenicamSettings genicam(const std::string& format = "BayerRG12") {
    GenicamSettings settings;
    settings.camera = "127.0.0.1";
    settings.photograph = photograph;
    settings.format = format;
    settings.packetSize = 1000;  // several packets a photograph
    return settings;
  }
  /// Long enough for a busy machine; tests of what does not come say how long they wait.
  static DrivenCameraSettings patience(std::chrono::milliseconds timeout = 3000ms) {
    DrivenCameraSettings settings;
    settings.exposureTakesTime = false;
    settings.timeout = timeout;
    settings.reconnectFor = 10s;
    settings.reconnectPause = 50ms;
    settings.attempts = 8;
    return settings;
  }
  void open(const GenicamSettings& settings = genicam(), DrivenCameraSettings driven = patience()) {
    camera.reset();
    camera = std::make_unique<DrivenCamera>(makeGenicamDriver(settings), driven);
  }
  Image shows(unsigned scene, const std::string& format = "BayerRG12") const {
    const SensorFormat sensor = *sensorFormatFromName(format);
    const Size size = sensorSize(photograph, sensor);
    return photographOf({size, sensor, Sight::bytesOf(size, sensor.bits, scene)}, "expected");
  }
  Image photographed(unsigned scene, double seconds = 0.01) {
    sight.scene = scene;
    return camera->capture({{"test", 1}, 0, seconds}).signal;
  }
};

}  // namespace

class TestGigeCamera : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    enterOwnNetwork();
    Venue venue;
    if (!venue.fake->isRunning())
      QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
  }

  /// More than a socket holds as the system makes it, less than it may: the library makes room once the first
  /// packet has come. Whether the rest finds room without is chance, so there are several streams.
  void theFirstPhotographOfAStreamIsWhole() {
    Venue venue;
    GenicamSettings large = Venue::genicam();
    large.photograph = Size{160, 120};
    for (int stream = 0; stream < 16; ++stream) {
      venue.open(large);
      venue.photographed(1);
      QCOMPARE(venue.camera->repeats(), 0);
    }
  }

  void everyPixelFormatArrivesBitForBit_data() {
    QTest::addColumn<QString>("format");
    for (const char* format : {"Mono8", "Mono10", "Mono12", "Mono16", "BayerRG12", "BayerGB10"})
      QTest::newRow(format) << format;
  }
  void everyPixelFormatArrivesBitForBit() {
    QFETCH(QString, format);
    Venue venue;
    venue.open(Venue::genicam(format.toStdString()));
    QCOMPARE(venue.camera->size(), photograph);
    for (unsigned scene : {1u, 2u, 3u})
      QVERIFY(venue.photographed(scene) == venue.shows(scene, format.toStdString()));
    QCOMPARE(venue.camera->repeats(), 0);
  }

  /// Law: of a part that is looked at the camera delivers what it would have in all of the photograph, and
  /// hardly more, on whatever it steps by; afterwards all of it again.
  void aPartIsReadAlone_data() {
    QTest::addColumn<QString>("format");
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("y");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    for (const char* format : {"Mono8", "BayerRG12"}) {
      QTest::addRow("%s, in the middle", format) << format << 5 << 7 << 11 << 9;
      QTest::addRow("%s, at the end", format) << format << 27 << 13 << 5 << 11;
      QTest::addRow("%s, a pixel", format) << format << 31 << 0 << 1 << 1;
    }
  }
  void aPartIsReadAlone() {
    QFETCH(QString, format);
    QFETCH(int, x);
    QFETCH(int, y);
    QFETCH(int, width);
    QFETCH(int, height);
    Venue venue;
    venue.open(Venue::genicam(format.toStdString()));
    QVERIFY(venue.photographed(1) == venue.shows(1, format.toStdString()));
    const std::size_t all = venue.sight.pixels;
    for (unsigned scene : {2u, 3u}) {
      venue.sight.scene = scene;
      const Image seen =
          venue.camera->capture({{"test", 1}, 0, 0.01, PicturePart{{x, y}, {width, height}}}).signal;
      const Image whole = venue.shows(scene, format.toStdString());
      QCOMPARE(seen.size(), whole.size());
      for (int v = y; v < y + height; ++v)
        for (int u = x; u < x + width; ++u)
          for (int c = 0; c < 3; ++c) QCOMPARE(seen.at(u, v, c), whole.at(u, v, c));
      QVERIFY2(venue.sight.pixels < all / 2, qPrintable(QString::number(venue.sight.pixels)));
    }
    // Back from where it was switched off it is told again.
    venue.fake->unplug();
    venue.fake->plug();
    venue.sight.scene = 4;
    const Image again =
        venue.camera->capture({{"test", 1}, 0, 0.01, PicturePart{{x, y}, {width, height}}}).signal;
    QCOMPARE(again.at(x, y, 0), venue.shows(4, format.toStdString()).at(x, y, 0));
    QVERIFY(venue.photographed(5) == venue.shows(5, format.toStdString()));
    QCOMPARE(venue.sight.pixels.load(), all);
  }

  void exposureAndGainReachTheCamera() {
    Venue venue;
    GenicamSettings settings = Venue::genicam();
    settings.gain = 3.0;
    venue.open(settings);
    QCOMPARE(venue.camera->traits().gain, 3.0);
    for (double seconds : {0.0001, 0.012345, 1.5}) {
      const RawFrame frame = venue.camera->capture({{"test", 1}, 0, seconds});
      QVERIFY(std::abs(frame.seconds - seconds) < 1e-6);  // the register holds whole microseconds
      QCOMPARE(venue.sight.seconds.load(), frame.seconds);
      QCOMPARE(venue.sight.gain.load(), 3u);
    }
    QCOMPARE(venue.camera->traits().model, std::string("Aravis Fake"));
    QVERIFY(venue.camera->traits().triggered);
  }

  void aCameraThatCutsExposuresWithoutAWordIsFoundOut() {
    FakeGigeSettings settings;
    settings.longestKept = 50000;
    Venue venue(settings);
    venue.open();
    QCOMPARE(venue.camera->exposures().longest, 0.05);
    QCOMPARE(venue.camera->traits().remarks.size(), std::size_t{1});
    QVERIFY(mentions(english(venue.camera->traits().remarks[0]),
                     "claims exposures up to 10 s but reaches only 0.05 s"));
    const std::string sentence =
        sentenceOf([&] { venue.camera->capture({{"test", 1}, 0, 0.5}); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "genicam:127.0.0.1: the camera was asked to expose 0.5 s but exposes 0.05 s"));
  }

  void whatTheCameraCannotIsRefused_data() {
    QTest::addColumn<QString>("format");
    QTest::addColumn<Size>("size");
    QTest::addColumn<double>("gain");
    QTest::addColumn<QString>("part");
    QTest::newRow("format") << "BayerBG14" << photograph << 0.0 << "no pixel format BayerBG14";
    QTest::newRow("size") << "Mono8" << Size{5000, 24} << 0.0
                          << "5000x24 pixels are wanted and the camera has 2048x2048";
    QTest::newRow("gain") << "Mono8" << photograph << 99.0
                          << "a gain of 99 is wanted; choose a gain from 0 to 10";
  }
  void whatTheCameraCannotIsRefused() {
    QFETCH(QString, format);
    QFETCH(Size, size);
    QFETCH(double, gain);
    QFETCH(QString, part);
    Venue venue;
    GenicamSettings settings = Venue::genicam(format.toStdString());
    settings.photograph = size;
    settings.gain = gain;
    QVERIFY(mentions(sentenceOf([&] { venue.open(settings); }, ErrorKind::device), part.toStdString()));
  }

  void lostPacketsAreAskedForAgain() {
    FakeGigeSettings settings;
    settings.lostPackets = 0.05;  // of 9 packets: 0.37 of all photographs lack one
    Venue venue(settings);
    DrivenCameraSettings patience = Venue::patience();
    patience.attempts = 64;  // 0.37^8 would happen once in a thousand runs
    venue.open(Venue::genicam(), patience);
    int scene = 1;
    for (; venue.camera->repeats() == 0 && scene < 100; ++scene)
      QVERIFY(venue.photographed(static_cast<unsigned>(scene)) == venue.shows(static_cast<unsigned>(scene)));
    QVERIFY(venue.camera->repeats() > 0);
  }

  void aBrokenCableIsTold() {
    Venue venue;
    DrivenCameraSettings patience = Venue::patience(100ms);
    patience.attempts = 2;
    venue.open(Venue::genicam(), patience);
    venue.fake->losePackets(1.0);
    const std::string sentence =
        sentenceOf([&] { venue.camera->capture({{"test", 1}, 0, 0.01}); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "2 attempts at a photograph failed: no photograph came within 0.11 s"));
    QVERIFY(mentions(sentence, "check the camera's cable"));
    venue.fake->losePackets(0.0);
    QVERIFY(venue.photographed(5) == venue.shows(5));
  }

  void aPhotographThatComesTooLateIsNotTakenForTheNext() {
    Venue venue;
    venue.open(Venue::genicam(), Venue::patience(300ms));
    QVERIFY(venue.photographed(1) == venue.shows(1));
    // The camera looks at scene 2, and dawdles until the venue shows scene 3.
    const int slow = venue.sight.looks + 1;
    venue.sight.whileLooking = [&](int look) {
      if (look != slow) return;
      venue.sight.scene = 3;
      std::this_thread::sleep_for(500ms);  // longer than the photograph is waited for
    };
    venue.sight.scene = 2;
    QVERIFY(venue.camera->capture({{"test", 2}, 0, 0.01}).signal == venue.shows(3));
    QVERIFY(venue.camera->repeats() > 0);
    venue.sight.whileLooking = [](int) {};
  }

  void aCameraThatWasResizedIsSetUpAgain() {
    Venue venue;
    venue.open();
    QVERIFY(venue.photographed(1) == venue.shows(1));
    venue.fake->setSensorSize({16, 12});
    QVERIFY(venue.photographed(2) == venue.shows(2));
    QCOMPARE(venue.camera->reconnections(), 1);
  }

  void aCameraThatWasSwitchedOffAndOnGoesOn() {
    Venue venue;
    venue.open(Venue::genicam(), Venue::patience(150ms));
    for (unsigned scene = 1; scene <= 2; ++scene) {
      venue.fake->unplug();
      venue.fake->plug();
      QVERIFY(venue.photographed(scene) == venue.shows(scene));
    }
    QVERIFY(venue.camera->reconnections() >= 2);
  }

  void camerasAreFoundByTheirSerialNumber() {
    FakeGigeSettings fake;
    fake.serial = "RL07";
    Venue venue(fake);
    const CameraList devices = cameraRegistry().list();
    auto ours = std::find_if(devices.cameras.begin(), devices.cameras.end(),
                             [](const ListedCamera& camera) { return camera.address == "genicam:RL07"; });
    QVERIFY(ours != devices.cameras.end());
    QVERIFY2(ours->problem.empty(), english(ours->problem).c_str());
    QVERIFY(ours->usable);
    QCOMPARE(english(ours->model), std::string("Aravis Fake"));
    QCOMPARE(nameOf(ours->traits.format), std::string("BayerRG12"));  // the best that it has
    QCOMPARE(ours->traits.size, (Size{1024, 1024}));
    QVERIFY(devices.support.front().available);
    GenicamSettings settings = Venue::genicam();
    settings.camera = "RL99";
    DrivenCameraSettings hasty = Venue::patience();
    hasty.connectFor = 0ms;
    const std::string sentence = sentenceOf([&] { venue.open(settings, hasty); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "genicam:RL99: no GenICam camera 'RL99' answers; check its cable"));
  }
};

QTEST_GUILESS_MAIN(TestGigeCamera)
#include "test_gige_camera.moc"
