// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/devices/check/light_check.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

constexpr double frame = 1.0 / 60.0;
constexpr Size sensor{24, 16};

/// What is wrong with a projector, its light, and the camera before it.
struct Faults {
  double modulation = 0.0;  // of the lamp, four times a frame
  bool wheel = false;       // colours one after the other
  bool rolling = false;     // rows one after the other, over one frame
  bool dithers = false;     // greys pixel by pixel in time
  double unsteady = 0.0;    // from photograph to photograph
  double noise = 0.0;       // of each pixel
  double longest = 1.0;     // exposure
  double shortest = 1e-4;
  bool covered = false;
};

struct Room {
  Faults faults;
  double clock = 1.0;
  float level = 0.0f;
  std::uint64_t photographs = 0;

  double emitted(double time, int x, int y, int c) const {
    const double phase = time / frame - std::floor(time / frame);
    double light = static_cast<double>(level);
    if (faults.dithers && level > 0.0f && level < 1.0f) {
      // Sixteen times a frame every pixel is on or off, as in single-chip projectors.
      const auto part = static_cast<std::uint64_t>(time / frame * 16.0);
      Random random{3, part, static_cast<std::uint64_t>(y * sensor.width + x)};
      light = random.uniform() < light ? 1.0 : 0.0;
    }
    if (faults.wheel) light *= static_cast<int>(phase * 3.0) == c ? 3.0 : 0.0;
    return light * (1.0 + faults.modulation * (std::fmod(phase * 4.0, 1.0) < 0.5 ? 1.0 : -1.0));
  }
  double seen(double from, double seconds, int x, int y, int c) const {
    if (faults.covered) return 0.01;
    const int samples = std::max(24, static_cast<int>(std::lround(seconds / frame * 48.0)));
    const double start = from + (faults.rolling ? frame * y / sensor.height : 0.0);
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) sum += emitted(start + seconds * (i + 0.5) / samples, x, y, c);
    return sum / samples * seconds;
  }
};

class RoomProjector : public Projector {
 public:
  explicit RoomProjector(Room& room) : room_(room) {}
  std::string name() const override { return "room projector"; }
  Size size() const override { return {8, 6}; }
  int bits() const override { return 8; }
  void show(const Image& picture) override { room_.level = picture.at(0, 0, 0); }

 private:
  Room& room_;
};

class RoomCamera : public Camera {
 public:
  explicit RoomCamera(Room& room) : room_(room) {}
  std::string name() const override { return "room camera"; }
  Size size() const override { return sensor; }
  ExposureRange exposures() const override { return {room_.faults.shortest, room_.faults.longest}; }
  RawFrame capture(const CaptureRequest& request) override {
    Random random{9, ++room_.photographs};
    const double lamp = 1.0 + room_.faults.unsteady * random.normal();
    RawFrame photograph{Image(sensor, 3), 0, request.seconds};
    for (int y = 0; y < sensor.height; ++y)
      for (int x = 0; x < sensor.width; ++x)
        for (int c = 0; c < 3; ++c)
          photograph.signal.at(x, y, c) =
              static_cast<float>(0.01 + 20.0 * lamp * room_.seen(room_.clock, request.seconds, x, y, c) +
                                 room_.faults.noise * random.normal());
    room_.clock += request.seconds;
    return photograph;
  }

 private:
  Room& room_;
};

LightCheck checked(const Faults& faults, Progress& progress) {
  Room room;
  room.faults = faults;
  RoomProjector projector(room);
  RoomCamera camera(room);
  LightCheckSettings settings;
  settings.photographs = 12;
  return checkLight(
      projector, camera, frame, settings, [&room](double seconds) { room.clock += seconds; }, progress);
}

}  // namespace

class TestLightCheck : public QObject {
  Q_OBJECT

 private slots:
  /// Each fault is told in its own words, and none that is not there.
  void faultsPutInOnPurposeAreTold_data() {
    QTest::addColumn<Faults>("faults");
    QTest::addColumn<QStringList>("words");
    const QString flicker = "lamp flickers", wheel = "through a colour wheel", rolling = "rolling shutter",
                  dither = "mixes greys", unsteady = "let the lamp warm up", none = "The light is even";
    auto row = [](const char* name, const Faults& faults, const QStringList& words) {
      QTest::newRow(name) << faults << words;
    };
    Faults even, noisy, lamp, sequence, rows, rowsOfLamp, rowsOfSequence, greys, drifting;
    noisy.noise = 0.01;
    lamp.modulation = 0.5;
    sequence.wheel = true;
    rows.rolling = true;  // under even light nobody can tell, and nobody needs to
    rowsOfLamp = lamp;
    rowsOfLamp.rolling = true;
    rowsOfSequence = sequence;
    rowsOfSequence.rolling = true;
    greys.dithers = true;
    drifting.unsteady = 0.05;
    row("nothing", even, {none});
    row("noise", noisy, {none});
    row("lamp", lamp, {flicker});
    row("colour wheel", sequence, {wheel});
    row("rolling shutter, even light", rows, {none});
    row("rolling shutter, lamp", rowsOfLamp, {rolling});
    row("rolling shutter, colour wheel", rowsOfSequence, {wheel, rolling});
    row("dithering", greys, {dither});
    row("unsteady", drifting, {unsteady});
    greys.noise = sequence.noise = lamp.noise = 0.005;
    row("lamp, noise", lamp, {flicker});
    row("colour wheel, noise", sequence, {wheel});
    row("dithering, noise", greys, {dither});
  }
  void faultsPutInOnPurposeAreTold() {
    QFETCH(Faults, faults);
    QFETCH(QStringList, words);
    Progress silent;
    const LightCheck check = checked(faults, silent);
    QString all;
    for (const CheckVerdict& verdict : check.verdicts)
      all += QString::fromStdString(english(messageOf(verdict))) + "\n";
    qInfo("unsteady %.3f, flicker %.3f, colours %.3f, bands %.3f, dither %.3f", check.unsteady, check.flicker,
          check.colours, check.bands, check.dither);
    for (const char* word : {"lamp flickers", "through a colour wheel", "rolling shutter", "mixes greys",
                             "let the lamp warm up", "The light is even"})
      QVERIFY2(all.contains(word) == words.contains(word), qPrintable(QString(word) + " in:\n" + all));
  }

  void aCameraThatCannotExposeBrieflySaysSo() {
    Faults faults;
    faults.wheel = true;
    faults.shortest = 0.9 * frame;
    Progress silent;
    const LightCheck check = checked(faults, silent);
    QCOMPARE(check.brief, 0.0);
    QVERIFY(mentions(english(messageOf(check.verdicts.back())), "cannot be detected"));
  }

  void whatSeesNothingIsTold() {
    Faults faults;
    faults.covered = true;
    Progress silent;
    QVERIFY(mentions(sentenceOf([&] { checked(faults, silent); }, ErrorKind::device),
                     "room camera: the camera sees no difference between white and black"));
  }

  void stoppingStops() {
    Stopped stopped;
    QVERIFY_THROWS_EXCEPTION(Cancelled, checked({}, stopped));
  }

  void problemsAreListed() {
    LightCheckSettings settings;
    settings.frame = 0.0;
    settings.settle = -1.0;
    settings.photographs = 3;
    QCOMPARE(problems(settings).size(), std::size_t{3});
    QVERIFY(problems(LightCheckSettings()).empty());
  }
};

QTEST_GUILESS_MAIN(TestLightCheck)
#include "test_light_check.moc"
