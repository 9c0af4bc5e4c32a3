// SPDX-License-Identifier: MIT
// A camera's patience and mistrust, against a driver that follows a script. Its clock moves only when it is
// waited for.
#include <QtTest>
#include <deque>

#include "relucent/base/error.h"
#include "relucent/devices/driven_camera.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::rig;
using namespace std::chrono_literals;
using std::chrono::microseconds;

namespace {

microseconds time(double seconds) {
  return std::chrono::duration_cast<microseconds>(std::chrono::duration<double>(seconds));
}

/// What the camera makes of being asked for a frame.
enum class Answer { good, nothing, damaged, small, otherFormat, late, repeated, gone };

/// What happens at the venue, shared with the test.
struct Script {
  std::deque<Answer> answers{};  // to the next requests; then only good ones
  int connectsThatFail = 0;      // before one succeeds
  CameraTraits traits{"Scripted", {4, 3}, {SensorLayout::mono, 8}, {0.001, 5.0}, true, 0.0, {}};
  ExposureRange kept{0.001, 5.0};  // what exposure times are cut to
  double factor = 1.0;             // of every exposure time
  bool runsByItself = false;       // frames arrive all the time, some of them begun earlier
  std::vector<std::string> diary{};
  microseconds clock = 10s;
  double exposure = 0.1;
  std::uint64_t frames = 0;
  std::deque<DriverFrame> underWay{};
  bool isConnected = false;
  std::optional<PicturePart> part{};  // that frames hold; none: all
  int step = 1;                       // of the corners of parts; 0: it knows none
  int shown = 0;                      // what the venue shows now: the value of good frames
  bool patterned = false;             // plus 10 y + x + 1
};

class ScriptedDriver : public CameraDriver {
 public:
  explicit ScriptedDriver(std::shared_ptr<Script> script) : script_(std::move(script)) {}

  std::string name() const override { return "scripted"; }
  CameraTraits connect() override {
    script_->diary.push_back("connect");
    if (script_->connectsThatFail-- > 0) throw CameraLost(Message::plain("nobody answers"));
    script_->connectsThatFail = 0;
    script_->isConnected = true;
    script_->part.reset();
    script_->underWay.clear();
    return script_->traits;
  }
  void disconnect() noexcept override {
    script_->isConnected = false;
    script_->underWay.clear();
  }
  double setExposure(double seconds) override {
    script_->exposure = script_->factor * std::clamp(seconds, script_->kept.shortest, script_->kept.longest);
    return script_->exposure;
  }
  std::optional<PicturePart> look(const PicturePart& part) override {
    script_->diary.push_back("look");
    if (script_->step == 0) return std::nullopt;
    const int step = script_->step;
    const Pixel begin{part.begin.x / step * step, part.begin.y / step * step};
    const Size size{part.begin.x + part.size.width - begin.x, part.begin.y + part.size.height - begin.y};
    script_->part = {begin, size};
    return script_->part;
  }
  void trigger() override {
    Answer answer = Answer::good;
    if (!script_->answers.empty()) {
      answer = script_->answers.front();
      script_->answers.pop_front();
    }
    const microseconds end = script_->clock + time(script_->exposure);
    if (script_->runsByItself) {
      send(script_->clock + time(0.3 * script_->exposure), 99);  // begun before it was asked for
      send(end + time(0.3 * script_->exposure));
      return;
    }
    switch (answer) {
      case Answer::gone:
        script_->isConnected = false;
        throw CameraLost(Message::plain("the cable was pulled"));
      case Answer::nothing:
        return;
      case Answer::damaged:
        send(end);
        script_->underWay.back().damage = Message::plain("parts of the photograph were lost");
        return;
      case Answer::small:
        send(end);
        script_->underWay.back().frame.size = {2, 3};
        return;
      case Answer::otherFormat:
        send(end);
        script_->underWay.back().frame.format.bits = 7;
        return;
      case Answer::late:
        send(script_->clock + 1us, 99);  // sooner than any exposure ends
        send(end);
        return;
      case Answer::repeated:
        send(end, 99);
        script_->underWay.back().id = script_->frames - 1;
        send(end + 1ms);
        return;
      case Answer::good:
        send(end);
        return;
    }
  }
  std::optional<DriverFrame> next(microseconds limit) override {
    if (script_->underWay.empty() || script_->underWay.front().arrived > script_->clock + limit) {
      script_->clock += limit;
      return std::nullopt;
    }
    DriverFrame frame = script_->underWay.front();
    script_->underWay.pop_front();
    script_->clock = std::max(script_->clock, frame.arrived);
    return frame;
  }
  void restart() override {
    script_->diary.push_back("restart");
    script_->underWay.clear();
  }
  microseconds now() const override { return script_->clock; }
  void wait(microseconds limit) override { script_->clock += limit; }

 private:
  void send(microseconds arrived, int value = -1) {
    const PicturePart part = script_->part.value_or(PicturePart{{0, 0}, script_->traits.size});
    DriverFrame frame{{part.size, script_->traits.format, {}}, ++script_->frames, arrived, {}};
    for (std::size_t i = 0; i < part.size.count(); ++i) {
      const Pixel at = pixelAt(part.size, i);
      const int own = script_->patterned ? 10 * (part.begin.y + at.y) + part.begin.x + at.x + 1 : 0;
      frame.frame.bytes.push_back(static_cast<std::uint8_t>(own + (value < 0 ? script_->shown : value)));
    }
    script_->underWay.push_back(std::move(frame));
  }

  std::shared_ptr<Script> script_;
};

struct Venue {
  std::shared_ptr<Script> script = std::make_shared<Script>();
  std::unique_ptr<DrivenCamera> camera{};

  void open(const DrivenCameraSettings& settings = {}) {
    camera = std::make_unique<DrivenCamera>(std::make_unique<ScriptedDriver>(script), settings);
  }
  /// The code of a photograph of what the venue shows now.
  int photograph(double seconds = 0.05) {
    ++script->shown;
    const RawFrame frame = camera->capture({{"test", script->shown}, 0, seconds});
    return static_cast<int>(std::lround(frame.signal.at(0, 0, 0) * 255.0f));
  }
};

}  // namespace

class TestDrivenCamera : public QObject {
  Q_OBJECT

 private slots:
  void aPhotographSaysWhatTheCameraKeptTo() {
    Venue venue;
    venue.script->factor = 0.9;
    venue.open();
    QCOMPARE(venue.camera->size(), (Size{4, 3}));
    const RawFrame frame = venue.camera->capture({{"test", 1}, 0, 0.2});
    QCOMPARE(frame.seconds, 0.9 * 0.2);
    QCOMPARE(frame.bits, 8);
    QCOMPARE(frame.signal.size(), (Size{4, 3}));
    QCOMPARE(venue.camera->repeats(), 0);
  }

  void everyFaultIsMendedByAskingAgain_data() {
    QTest::addColumn<QVector<int>>("answers");
    QTest::addColumn<int>("repeats");
    QTest::addColumn<int>("reconnections");
    auto row = [](const char* name, std::initializer_list<Answer> answers, int repeats, int reconnections) {
      QVector<int> numbers;
      for (Answer answer : answers) numbers.append(static_cast<int>(answer));
      QTest::newRow(name) << numbers << repeats << reconnections;
    };
    row("none", {}, 0, 0);
    row("lost packets", {Answer::damaged}, 1, 0);
    row("no frame", {Answer::nothing}, 1, 0);
    row("wrong size", {Answer::small}, 1, 1);
    row("other format", {Answer::otherFormat}, 1, 1);
    row("stale frame before", {Answer::late}, 0, 0);
    row("the same frame again", {Answer::repeated}, 0, 0);
    row("unplugged", {Answer::gone}, 1, 1);
    row("all of them", {Answer::damaged, Answer::nothing, Answer::small, Answer::gone}, 4, 3);
  }
  void everyFaultIsMendedByAskingAgain() {
    QFETCH(QVector<int>, answers);
    QFETCH(int, repeats);
    QFETCH(int, reconnections);
    Venue venue;
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    for (int answer : answers) venue.script->answers.push_back(static_cast<Answer>(answer));
    QCOMPARE(venue.photograph(), 2);  // never 99, the mark of an old frame
    QCOMPARE(venue.photograph(), 3);
    QCOMPARE(venue.camera->repeats(), repeats);
    QCOMPARE(venue.camera->reconnections(), reconnections);
    QVERIFY(venue.script->answers.empty());
  }

  void whatIsNotMendedIsTold_data() {
    QTest::addColumn<int>("answer");
    QTest::addColumn<QString>("part");
    QTest::newRow("lost packets")
        << static_cast<int>(Answer::damaged)
        << "scripted: 3 attempts at a photograph failed: parts of the photograph were lost";
    QTest::newRow("no frame") << static_cast<int>(Answer::nothing) << "no photograph came within 2.05 s";
    QTest::newRow("wrong size") << static_cast<int>(Answer::small)
                                << "the photograph has 2x3 pixels as Mono8 where 4x3 as Mono8 were agreed";
  }
  void whatIsNotMendedIsTold() {
    QFETCH(int, answer);
    QFETCH(QString, part);
    Venue venue;
    DrivenCameraSettings settings;
    settings.attempts = 3;
    venue.open(settings);
    for (int i = 0; i < 3; ++i) venue.script->answers.push_back(static_cast<Answer>(answer));
    const std::string sentence = sentenceOf([&] { venue.photograph(); }, ErrorKind::device);
    QVERIFY(mentions(sentence, part.toStdString()));
    QVERIFY(mentions(sentence, "every photograph so far is kept"));
    QCOMPARE(venue.photograph(), 2);  // and it can be gone on with
  }

  void aCameraThatIsGoneIsWaitedFor() {
    Venue venue;
    venue.open();
    venue.script->answers = {Answer::gone};
    venue.script->connectsThatFail = 20;  // 10 s at 0.5 s each
    QCOMPARE(venue.photograph(), 1);
    QCOMPARE(venue.camera->reconnections(), 1);
    QVERIFY(venue.script->clock >= 20s);
  }

  void aCameraThatStaysAwayIsTold() {
    Venue venue;
    venue.open();
    venue.script->answers = {Answer::gone};
    venue.script->connectsThatFail = 1000;
    const std::string sentence = sentenceOf([&] { venue.photograph(); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "the camera has been gone for 30 s: nobody answers"));
    venue.script->connectsThatFail = 0;
    QCOMPARE(venue.photograph(), 2);
  }

  void anotherCameraIsNotTakenForTheSame() {
    Venue venue;
    venue.open();
    venue.script->answers = {Answer::gone};
    venue.script->traits.size = {8, 6};
    const std::string sentence = sentenceOf([&] { venue.photograph(); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "came back with 8x6 pixels instead of 4x3"));
  }

  /// Law: what is looked at is what it would be without saying so, the rest is that or black, and the camera
  /// is told once, and again after it was gone.
  void ofAPartOnlyThatIsDelivered_data() {
    QTest::addColumn<int>("step");
    QTest::addColumn<bool>("isGone");
    for (int step : {0, 1, 2, 4})
      for (bool gone : {false, true})
        QTest::addRow("steps of %d%s", step, gone ? ", unplugged" : "") << step << gone;
  }
  void ofAPartOnlyThatIsDelivered() {
    QFETCH(int, step);
    QFETCH(bool, isGone);
    Venue venue;
    venue.script->traits.size = {10, 8};
    venue.script->patterned = true;
    venue.script->step = step;
    venue.open();
    const auto capture = [&](std::optional<PicturePart> part) {
      return venue.camera->capture({{"test", 1}, 0, 0.05, part}).signal;
    };
    const auto looks = [&] { return std::ranges::count(venue.script->diary, "look"); };
    const image::Image all = capture(std::nullopt);
    QCOMPARE(looks(), 0);
    const PicturePart part{{3, 5}, {6, 2}};
    for (int i = 0; i < 3; ++i) {
      if (i == 1 && isGone) venue.script->answers = {Answer::gone};
      const image::Image seen = capture(part);
      QCOMPARE(seen.size(), all.size());
      int black = 0;
      for (int y = 0; y < all.height(); ++y)
        for (int x = 0; x < all.width(); ++x) {
          const bool within = x >= 3 && x < 9 && y >= 5 && y < 7;
          const float value = seen.at(x, y, 1);
          QVERIFY(value == all.at(x, y, 1) || (!within && value == 0.0f));
          black += value == 0.0f;
        }
      QCOMPARE(black > 0, step > 0);
    }
    QCOMPARE(looks(), isGone ? 2 : 1);
    QVERIFY(capture(std::nullopt) == all);
    // All of it is no part.
    const auto before = looks();
    capture(PicturePart{{0, 0}, {10, 8}});
    QCOMPARE(looks(), before);
  }

  void aCameraThatIsNotThereIsTold() {
    Venue venue;
    venue.script->connectsThatFail = 1000;
    const std::string sentence = sentenceOf([&] { venue.open(); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "scripted: nobody answers; check its cable"));
    // Another program may have held it until now.
    venue.script->connectsThatFail = 5;
    venue.open();
    QCOMPARE(venue.photograph(), 1);
  }

  void aRangeThatIsNotKeptToIsFoundOut() {
    Venue venue;
    venue.script->kept = {0.002, 0.05};
    venue.open();
    QCOMPARE(venue.camera->exposures().shortest, 0.002);
    QCOMPARE(venue.camera->exposures().longest, 0.05);
    QCOMPARE(venue.camera->traits().remarks.size(), std::size_t{2});
    QVERIFY(mentions(english(venue.camera->traits().remarks[0]),
                     "claims exposures up to 5 s but reaches only 0.05 s"));
    // Whoever asks for more all the same is told.
    const std::string sentence = sentenceOf([&] { venue.photograph(1.0); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "was asked to expose 1 s but exposes 0.05 s"));
    QCOMPARE(venue.photograph(0.05), 2);
  }

  void aCameraWithoutManualExposureIsRefused() {
    Venue venue;
    venue.script->kept = {0.04, 0.04};
    QVERIFY(mentions(sentenceOf([&] { venue.open(); }, ErrorKind::device), "exposes 0.04 s whatever"));
    venue.script->traits.exposures = {0.0, 0.0};
    QVERIFY(mentions(sentenceOf([&] { venue.open(); }, ErrorKind::device), "claims exposures of 0 to 0 s"));
  }

  void framesThatWereBegunBeforeAreDropped() {
    Venue venue;
    venue.script->runsByItself = true;
    venue.script->traits.triggered = false;
    venue.open();
    for (int i = 1; i <= 5; ++i) QCOMPARE(venue.photograph(), i);
    QCOMPARE(venue.camera->repeats(), 0);
  }

  void framesWithTheOldExposureAreSkipped() {
    Venue venue;
    DrivenCameraSettings settings;
    settings.skipAfterChange = 2;
    venue.open(settings);
    venue.photograph(0.05);
    QCOMPARE(venue.script->frames, std::uint64_t{3});
    venue.photograph(0.05);
    QCOMPARE(venue.script->frames, std::uint64_t{4});
    venue.photograph(0.1);
    QCOMPARE(venue.script->frames, std::uint64_t{7});
  }

  void aCameraThatDoesNotTakeItsTimeCanBeUsed() {
    // A simulated one answers at once; with the usual settings all of its frames look stale.
    Venue venue;
    venue.open();
    venue.script->answers = std::deque<Answer>(1, Answer::late);
    DrivenCameraSettings settings;
    settings.exposureTakesTime = false;
    Venue trusting;
    trusting.open(settings);
    trusting.script->answers = {Answer::late};
    QCOMPARE(venue.photograph(), 1);
    QCOMPARE(trusting.photograph(), 99);
  }

  void problemsAreListed() {
    DrivenCameraSettings settings;
    settings.timeout = 0ms;
    settings.attempts = 0;
    settings.reconnectPause = 0ms;
    settings.skipAfterChange = -1;
    QCOMPARE(problems(settings).size(), std::size_t{4});
    QCOMPARE(problems(DrivenCameraSettings()).size(), std::size_t{0});
    Venue venue;
    QVERIFY_THROWS_EXCEPTION(std::logic_error, venue.open(settings));
  }
};

QTEST_GUILESS_MAIN(TestDrivenCamera)
#include "test_driven_camera.moc"
