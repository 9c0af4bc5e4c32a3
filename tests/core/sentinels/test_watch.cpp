// SPDX-License-Identifier: MIT
#include <QtTest>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/rig/device_given_up.h"
#include "relucent/sentinels/watch.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::linearization;
using namespace relucent::photography;
using namespace relucent::rig;
using namespace relucent::sentinels;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

/// Sees `roomLight` besides, radiance; below nothing it is given up.
class LitCamera : public Camera {
 public:
  LitCamera(std::unique_ptr<Camera> camera, std::shared_ptr<const double> roomLight)
      : camera_(std::move(camera)), roomLight_(std::move(roomLight)) {}
  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  ExposureRange exposures() const override { return camera_->exposures(); }
  RawFrame capture(const CaptureRequest& request) override {
    if (*roomLight_ < 0.0)
      throw DeviceGivenUp(ErrorKind::device, Message::plain("gone"), Message::plain("wait"), name());
    RawFrame frame = camera_->capture(request);
    for (float& value : frame.signal.data())
      value = std::min(1.0f, value + static_cast<float>(request.seconds * *roomLight_));
    return frame;
  }

 private:
  std::unique_ptr<Camera> camera_;
  std::shared_ptr<const double> roomLight_;
};

/// A noiseless venue whose room light changes when it is told to, and a watch over it.
class WatchedVenue {
 public:
  explicit WatchedVenue(AlarmHandler handler)
      : rig_(rig(roomLight_)),
        shots_(rig_, log_, "test"),
        linearization_(linearization()),
        photographer_(shots_, linearization_),
        references_(measureReferences(photographer_, {}, 0.2, progress_)),
        supervision{std::move(handler), observer_},
        watch(photographer_, references_, {}, supervision) {}

  std::optional<Interruption> begin() { return watch.begin(progress_); }
  /// A pattern, and the check after it.
  std::optional<Interruption> checkWith(double roomLight) {
    *roomLight_ = roomLight;
    ProjectorStack white(3 * references_.projectors.count(), 1.0f);
    Interruptible<LampLight> light = watch.lightOfAll(white, progress_);
    if (!light) return light.interruption();
    return watch.check(progress_);
  }
  const References& references() const { return references_; }

 private:
  static Rig rig(const std::shared_ptr<double>& roomLight) {
    SyntheticSettings synthetic;
    synthetic.projectors = {{24, 16}};
    synthetic.cameras = {{20, 15}};
    synthetic.brightness = 16.0;
    TransportMatrix transport = syntheticTransport(synthetic);
    ScriptedCamera camera;
    camera.bits = 0;
    camera.readNoise = 0.0;
    camera.gain = 0.0;
    ScriptedSettings scripted;
    scripted.cameras = {camera};
    Rig rig = ScriptedVenue(transport, syntheticBlack(transport, 1e-3), scripted).rig();
    rig.cameras[0] = std::make_unique<LitCamera>(std::move(rig.cameras[0]), roomLight);
    return rig;
  }
  static Linearization linearization() {
    Linearization linearization;
    linearization.cameras.resize(1);
    linearization.cameras[0].readNoise = 1e-6;
    linearization.cameras[0].gain = 0.0;
    linearization.exposures = {0.1, 0.025};
    return linearization;
  }

  Progress progress_;
  NoShotLog log_;
  AcquisitionObserver observer_;
  std::shared_ptr<double> roomLight_ = std::make_shared<double>(0.0);
  Rig rig_;
  ShotTaker shots_;
  Linearization linearization_;
  Photographer photographer_;
  References references_;

 public:
  Supervision supervision;
  Watch watch;
};

double meanOf(const Stack& stack) {
  return std::accumulate(stack.begin(), stack.end(), 0.0) / static_cast<double>(stack.size());
}

}  // namespace

Q_DECLARE_METATYPE(Answer)
Q_DECLARE_METATYPE(std::optional<Interruption>)

class TestWatch : public QObject {
  Q_OBJECT

 private slots:
  /// What is decided about an alarm comes back as what the check returns; only what is accepted goes on.
  void anAnswerBecomesAnInterruption_data() {
    QTest::addColumn<Answer>("answer");
    QTest::addColumn<std::optional<Interruption>>("expected");
    QTest::newRow("retry") << Answer::retry << std::optional(Interruption::beginAgain);
    QTest::newRow("skip") << Answer::skip << std::optional<Interruption>();
    QTest::newRow("keep and stop") << Answer::keepAndStop << std::optional(Interruption::keepAndStop);
  }
  void anAnswerBecomesAnInterruption() {
    QFETCH(Answer, answer);
    QFETCH(std::optional<Interruption>, expected);
    int asked = 0;
    WatchedVenue venue([&](const Alarm& alarm) {
      asked += alarm.kind == AlarmKind::ambientChanged ? 1 : 0;
      return answer;
    });
    QVERIFY(!venue.begin());
    QVERIFY(!venue.checkWith(0.0));
    QCOMPARE(asked, 0);
    QVERIFY(venue.checkWith(1.0) == expected);
    QCOMPARE(asked, 1);
    QCOMPARE(venue.supervision.accepted.size(), std::size_t{answer == Answer::skip ? 1u : 0u});
    // What was accepted is expected from then on.
    if (answer == Answer::skip) QVERIFY(!venue.checkWith(1.0));
    QCOMPARE(asked, 1);
  }

  /// Law: a device that is given up ends a measurement with what is confirmed, whoever is there to ask.
  void aDeviceThatIsGivenUpEndsItWithWhatIsSafe() {
    int asked = 0;
    WatchedVenue venue([&asked](const Alarm&) {
      ++asked;
      return Answer::retry;
    });
    QVERIFY(!venue.begin());
    QVERIFY(!venue.checkWith(0.0));
    const int confirmed = venue.watch.confirmed();
    QVERIFY(venue.checkWith(-1.0) == Interruption::keepAndStop);
    QVERIFY(venue.watch.confirmed() == confirmed && asked == 0);
    QVERIFY(!venue.checkWith(0.0));
  }

  void withNobodyToAskItIsAnError() {
    WatchedVenue venue({});
    QVERIFY(!venue.begin());
    QVERIFY_THROWS_EXCEPTION(Error, std::ignore = venue.checkWith(1.0));
  }

  /// e goes with the room; the references, and with them thresholds and roots, stay as they were measured.
  void eIsFollowedAndReferencesStay() {
    WatchedVenue venue({});
    QVERIFY(!venue.begin());
    const CameraStack measured = venue.references().black.radiance;
    QVERIFY(venue.watch.black().radiance == measured);
    constexpr double rise = 0.01;  // below a two-hundredth of the flood: no alarm
    QVERIFY(!venue.checkWith(rise));
    double risen = meanOf(venue.watch.black().radiance) - meanOf(measured);
    QVERIFY2(std::abs(risen - rise) < 0.01 * rise, qPrintable(QString::number(risen)));
    QVERIFY(venue.references().black.radiance == measured);
  }
};

QTEST_APPLESS_MAIN(TestWatch)
#include "test_watch.moc"
