// SPDX-License-Identifier: MIT
#include <QtTest>
#include <limits>
#include <map>

#include "relucent/base/error.h"
#include "relucent/rig/shot.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

/// What happened to the devices, in order: "show 0 0.5", "take 1 acquisition 3 0 0.25".
using Diary = std::vector<std::string>;

class DiaryProjector : public Projector {
 public:
  DiaryProjector(Diary& diary, int number) : diary_(diary), number_(number) {}
  std::string name() const override { return "projector"; }
  Size size() const override { return {2, 2}; }
  int bits() const override { return 8; }
  void show(const Image& drive) override {
    diary_.push_back(fmt::format("show {} {}", number_, drive.at(0, 0, 0)));
  }

 private:
  Diary& diary_;
  int number_;
};

class DiaryCamera : public Camera {
 public:
  DiaryCamera(Diary& diary, int number) : diary_(diary), number_(number) {}
  std::string name() const override { return fmt::format("camera {}", number_); }
  Size size() const override { return {3, 2}; }
  ExposureRange exposures() const override { return {1e-3, 1.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    if (beforeCapture) beforeCapture();
    diary_.push_back(fmt::format("take {} {} {} {} {}", number_, request.shot.stage, request.shot.number,
                                 request.exposure, request.seconds));
    return {Image({3, 2}, 3, value), 8, request.seconds};
  }
  std::function<void()> beforeCapture;
  float value = 0.5f;

 private:
  Diary& diary_;
  int number_;
};

/// Keeps shots in memory, as a disk would.
class MemoryLog : public ShotLog {
 public:
  std::optional<Shot> find(const ShotId& id, const std::string& fingerprint) override {
    auto shot = shots.find({id.stage, id.number});
    if (shot == shots.end() || shot->second.fingerprint != fingerprint) return std::nullopt;
    return shot->second;
  }
  void keep(const Shot& shot) override { shots[{shot.id.stage, shot.id.number}] = shot; }
  void forget(const ShotId& id, const std::string& fingerprint) override {
    if (find(id, fingerprint)) shots.erase({id.stage, id.number});
  }
  std::map<std::pair<std::string, int>, Shot> shots;
};

Image pattern(float value) {
  return Image({2, 2}, 3, value);
}

}  // namespace

class TestShotTaker : public QObject {
  Q_OBJECT

  Diary diary_;
  Rig rig_;
  std::vector<DiaryCamera*> cameras_;

 private slots:
  void init() {
    diary_.clear();
    rig_ = Rig();
    cameras_.clear();
    for (int i : {0, 1}) {
      rig_.projectors.push_back(std::make_unique<DiaryProjector>(diary_, i));
      auto camera = std::make_unique<DiaryCamera>(diary_, i);
      cameras_.push_back(camera.get());
      rig_.cameras.push_back(std::move(camera));
    }
  }

  void allIsShownBeforeAnythingIsTaken() {
    NoShotLog log;
    ShotTaker shots(rig_, log, "acquisition");
    shots.take({pattern(0), pattern(0)}, {1.0}, Progress());
    diary_.clear();
    const Shot shot = shots.take({pattern(0.25f), pattern(0.5f)}, {0.5, 0.125}, Progress());
    QCOMPARE(diary_,
             (Diary{"show 0 0.25", "show 1 0.5", "take 0 acquisition 1 0 0.5", "take 1 acquisition 1 0 0.5",
                    "take 0 acquisition 1 1 0.125", "take 1 acquisition 1 1 0.125"}));
    QCOMPARE(shot.id, (ShotId{"acquisition", 1}));
    QCOMPARE(shot.frames.size(), std::size_t{2});
    QCOMPARE(shot.frames[1].size(), std::size_t{2});
    QCOMPARE(shot.frames[1][0].seconds, 0.125);
    QCOMPARE(shots.shots(), 2);
    QCOMPARE(shots.exposures(), 3);
  }

  void whatIsKeptIsNotTakenAgain() {
    MemoryLog log;
    std::vector<Shot> first, second;
    for (std::vector<Shot>* run : {&first, &second}) {
      diary_.clear();
      cameras_[0]->value = run == &first ? 0.5f : 0.75f;  // the light has changed meanwhile
      ShotTaker shots(rig_, log, "acquisition");
      for (float value : {0.0f, 0.5f, 1.0f})
        run->push_back(shots.take({pattern(value), pattern(0)}, {0.5}, Progress()));
      QCOMPARE(shots.shots(), 3);
      QCOMPARE(shots.exposures(), 3);
    }
    QVERIFY(diary_.empty());
    for (std::size_t i = 0; i < 3; ++i) {
      QCOMPARE(second[i].id, first[i].id);
      QCOMPARE(second[i].fingerprint, first[i].fingerprint);
      QCOMPARE(second[i].frames[0][0].signal, first[i].frames[0][0].signal);
    }
  }

  /// Law: a log from elsewhere is believed only where its shots are of these devices.
  void whatDoesNotFitTheDevicesIsTakenAnew_data() {
    QTest::addColumn<int>("change");
    QTest::newRow("no exposure") << 0;
    QTest::newRow("an exposure too many") << 1;
    QTest::newRow("a camera less") << 2;
    QTest::newRow("a photograph of another size") << 3;
    QTest::newRow("a photograph without colours") << 4;
  }
  void whatDoesNotFitTheDevicesIsTakenAnew() {
    QFETCH(int, change);
    MemoryLog log;
    const auto take = [&] {
      diary_.clear();
      return ShotTaker(rig_, log, "acquisition").take({pattern(0), pattern(1)}, {0.5}, Progress());
    };
    const Shot sound = take();
    std::vector<std::vector<RawFrame>>& frames = log.shots.begin()->second.frames;
    if (change == 0) frames.clear();
    if (change == 1) frames.push_back(frames.front());
    if (change == 2) frames.front().pop_back();
    if (change == 3) frames.front()[1].signal = Image({2, 3}, 3);
    if (change == 4) frames.front()[0].signal = Image({3, 2}, 1);
    const Shot again = take();
    QVERIFY(!diary_.empty());
    QCOMPARE(again.frames.size(), sound.frames.size());
    QCOMPARE(log.shots.begin()->second.frames.front().size(), std::size_t{2});
    QCOMPARE(take().frames.size(), std::size_t{1});
    QVERIFY(diary_.empty());
  }

  void forgottenShotsAreTakenAnew() {
    MemoryLog log;
    ShotTaker shots(rig_, log, "acquisition");
    auto takeAll = [&] {
      for (float value : {0.0f, 0.5f, 1.0f})
        shots.take({pattern(value), pattern(0)}, {0.5, 0.25}, Progress());
    };
    takeAll();
    shots.forgetFrom(1);
    QCOMPARE(log.shots.size(), std::size_t{1});
    shots.goBackTo(0);
    QCOMPARE(shots.shots(), 0);
    QCOMPARE(shots.exposures(), 0);
    diary_.clear();
    takeAll();
    QCOMPARE(diary_.front(), std::string("show 0 0.5"));
    QCOMPARE(shots.shots(), 3);
    QCOMPARE(shots.exposures(), 6);
    QCOMPARE(log.shots.size(), std::size_t{3});
    QVERIFY_THROWS_EXCEPTION(std::logic_error, shots.goBackTo(4));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, shots.forgetFrom(-1));
  }

  void anInterruptedRunGoesOnWhereItStopped() {
    MemoryLog log;
    {
      ShotTaker shots(rig_, log, "acquisition");
      shots.take({pattern(0), pattern(0)}, {0.5}, Progress());
      cameras_[1]->beforeCapture = [] {
        throw Error(ErrorKind::device, Message::plain("the cable is out"), Message::plain("plug it in"),
                    "camera 1");
      };
      QVERIFY_THROWS_EXCEPTION(Error, shots.take({pattern(1), pattern(0)}, {0.5}, Progress()));
      QCOMPARE(log.shots.size(), std::size_t{1});  // no half shot is kept
    }
    cameras_[1]->beforeCapture = nullptr;
    diary_.clear();
    ShotTaker shots(rig_, log, "acquisition");
    shots.take({pattern(0), pattern(0)}, {0.5}, Progress());
    QVERIFY(diary_.empty());
    shots.take({pattern(1), pattern(0)}, {0.5}, Progress());
    QCOMPARE(diary_,
             (Diary{"show 0 1", "show 1 0", "take 0 acquisition 1 0 0.5", "take 1 acquisition 1 0 0.5"}));
  }

  void anotherPatternOrExposureIsTakenAnew_data() {
    QTest::addColumn<float>("left");
    QTest::addColumn<float>("right");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("stage");
    QTest::addColumn<bool>("again");
    QTest::newRow("the same") << 0.25f << 0.75f << 0.5 << "acquisition" << false;
    QTest::newRow("pattern") << 0.5f << 0.75f << 0.5 << "acquisition" << true;
    QTest::newRow("projectors exchanged") << 0.75f << 0.25f << 0.5 << "acquisition" << true;
    QTest::newRow("exposure") << 0.25f << 0.75f << 0.25 << "acquisition" << true;
    QTest::newRow("stage") << 0.25f << 0.75f << 0.5 << "linearization" << true;
  }
  void anotherPatternOrExposureIsTakenAnew() {
    QFETCH(float, left);
    QFETCH(float, right);
    QFETCH(double, seconds);
    QFETCH(QString, stage);
    QFETCH(bool, again);
    MemoryLog log;
    ShotTaker(rig_, log, "acquisition").take({pattern(0.25f), pattern(0.75f)}, {0.5}, Progress());
    diary_.clear();
    ShotTaker shots(rig_, log, stage.toStdString());
    const Shot shot = shots.take({pattern(left), pattern(right)}, {seconds}, Progress());
    QCOMPARE(!diary_.empty(), again);
    // What was taken last is what is kept.
    QCOMPARE(log.shots.at({stage.toStdString(), 0}).fingerprint, shot.fingerprint);
  }

  void cancellingStopsBeforeTheNextExposure() {
    SilentSink sink;
    StopRequest stop;
    Progress progress(sink, stop);
    MemoryLog log;
    ShotTaker shots(rig_, log, "acquisition");
    cameras_[0]->beforeCapture = [&] { stop.ask(StopRequest::Kind::cancel); };
    QVERIFY_THROWS_EXCEPTION(Cancelled, shots.take({pattern(0), pattern(0)}, {0.5, 0.25}, progress));
    QCOMPARE(diary_, (Diary{"show 0 0", "show 1 0", "take 0 acquisition 0 0 0.5"}));
    QVERIFY(log.shots.empty());

    diary_.clear();
    QVERIFY_THROWS_EXCEPTION(Cancelled, shots.take({pattern(0), pattern(0)}, {0.5}, progress));
    QVERIFY(diary_.empty());
  }

  void anUnusablePhotographIsNotKept() {
    MemoryLog log;
    ShotTaker shots(rig_, log, "acquisition");
    cameras_[1]->value = std::numeric_limits<float>::infinity();
    QVERIFY_THROWS_EXCEPTION(Error, shots.take({pattern(0), pattern(0)}, {0.5}, Progress()));
    QVERIFY(log.shots.empty());
  }

  void contractsAreChecked() {
    NoShotLog log;
    ShotTaker shots(rig_, log, "acquisition");
    QVERIFY_THROWS_EXCEPTION(std::logic_error, shots.take({pattern(0)}, {0.5}, Progress()));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, shots.take({pattern(0), pattern(0)}, {}, Progress()));
    QVERIFY(diary_.empty());
  }
};

QTEST_APPLESS_MAIN(TestShotTaker)
#include "test_shot_taker.moc"
