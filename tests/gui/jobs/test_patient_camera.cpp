// SPDX-License-Identifier: MIT
// A camera that is waited for, as long as somebody does.
#include "jobs/patient_camera.h"

#include <QSemaphore>
#include <QtTest>
#include <atomic>

#include "jobs/job.h"
#include "relucent/base/message.h"
#include "relucent/rig/device_given_up.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::rig;
using namespace std::chrono_literals;

namespace {

/// What the camera does next is told to it by the test.
struct Script {
  std::atomic<bool> fails{false}, hangs{false};
  std::atomic<int> tries{0};
  QSemaphore freed;
};

class ScriptedCamera : public Camera {
 public:
  explicit ScriptedCamera(Script& script) : script_(script) {}
  std::string name() const override { return "scripted"; }
  Size size() const override { return {2, 1}; }
  ExposureRange exposures() const override { return {1e-3, 1.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    ++script_.tries;
    if (script_.hangs) script_.freed.acquire();
    if (script_.fails)
      throw Error(ErrorKind::device, Message::plain("no photograph came"),
                  Message::plain("push in the cable"));
    return {Image({2, 1}, 3, 0.25f), 12, request.seconds};
  }

 private:
  Script& script_;
};

struct Bench {
  Bench() : camera(std::make_unique<ScriptedCamera>(script), patience, 1ms) {}
  ~Bench() { script.freed.release(100); }
  Script script;
  std::shared_ptr<CameraPatience> patience = std::make_shared<CameraPatience>();
  PatientCamera camera;
};

constexpr CaptureRequest request(double seconds) {
  return {{}, 0, seconds};
}

}  // namespace

class TestPatientCamera : public QObject {
  Q_OBJECT

 private slots:
  void itIsTheCameraThatItWaitsFor() {
    Bench bench;
    QCOMPARE(bench.camera.name(), std::string("scripted"));
    QCOMPARE(bench.camera.size(), (Size{2, 1}));
    QCOMPARE(bench.camera.exposures().longest, 1.0);
    const RawFrame frame = bench.camera.capture(request(0.5));
    QCOMPARE(frame.seconds, 0.5);
    QCOMPARE(frame.signal, Image({2, 1}, 3, 0.25f));
  }

  /// Who has never delivered a photograph is no camera that was lost.
  void oneThatHasNeverWorkedIsAnError() {
    Bench bench;
    bench.script.fails = true;
    QVERIFY_THROWS_EXCEPTION(Error, std::ignore = bench.camera.capture(request(0.1)));
    QCOMPARE(bench.script.tries.load(), 1);
  }

  /// Law: what fails is tried again until it works; why it failed is told meanwhile.
  void oneThatHasWorkedIsTriedUntilItWorksAgain() {
    Bench bench;
    std::ignore = bench.camera.capture(request(0.1));
    bench.script.fails = true;
    Job job;
    job.start([&](Progress&) { std::ignore = bench.camera.capture(request(0.1)); });
    QTRY_VERIFY(bench.script.tries > 3);
    QVERIFY(job.isRunning());
    QTRY_VERIFY(bench.patience->failure().has_value());
    QVERIFY(bench.patience->failure()->what.contains("no photograph came", Qt::CaseInsensitive));
    bench.script.fails = false;
    QTRY_VERIFY(!job.isRunning());
    QCOMPARE(job.state(), Job::State::done);
    QVERIFY(!bench.patience->failure());
  }

  /// Law: whoever no longer waits is free at once, whatever the driver does; and can wait again.
  void givenUpItIsNotWaitedFor_data() {
    QTest::addColumn<bool>("hangs");
    QTest::newRow("it fails") << false;
    QTest::newRow("its driver hangs") << true;
  }
  void givenUpItIsNotWaitedFor() {
    QFETCH(bool, hangs);
    Bench bench;
    std::ignore = bench.camera.capture(request(0.1));
    (hangs ? bench.script.hangs : bench.script.fails) = true;
    bool isGivenUp = false;
    Job job;
    job.start([&](Progress&) {
      try {
        std::ignore = bench.camera.capture(request(0.1));
      } catch (const DeviceGivenUp&) {
        isGivenUp = true;
      }
    });
    QTRY_VERIFY(bench.script.tries > 1);
    bench.patience->giveUp();
    QTRY_VERIFY_WITH_TIMEOUT(!job.isRunning(), 1000);
    QVERIFY(isGivenUp);
    QVERIFY_THROWS_EXCEPTION(DeviceGivenUp, std::ignore = bench.camera.capture(request(0.1)));
    bench.script.hangs = bench.script.fails = false;
    bench.script.freed.release();
    bench.patience->wait();
    QCOMPARE(bench.camera.capture(request(0.3)).seconds, 0.3);
  }

  void cancellingFreesAtOnce() {
    Bench bench;
    bench.script.hangs = true;
    Job job;
    job.start([&](Progress&) { std::ignore = bench.camera.capture(request(0.1)); });
    QTRY_COMPARE(bench.script.tries.load(), 1);
    job.cancel();
    QTRY_VERIFY_WITH_TIMEOUT(!job.isRunning(), 1000);
    QCOMPARE(job.state(), Job::State::cancelled);
  }
};

QTEST_GUILESS_MAIN(TestPatientCamera)
#include "test_patient_camera.moc"
