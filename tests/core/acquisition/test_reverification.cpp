// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/acquisition/reverification.h"
#include "relucent/acquisition/verification.h"
#include "relucent/base/message.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::venue;

namespace {

/// A simulated venue, measured once, and looked at again with whatever has changed since.
class MeasuredVenue {
 public:
  explicit MeasuredVenue(const char* name, const AcquisitionSettings& settings = {})
      : venue_(settingsOf(name), {}, progress_), settings_(settings) {
    Rig rig = venue_.rig();
    NoShotLog log;
    ShotTaker first(rig, log, "linearization");
    LinearizationSettings fewer;
    fewer.levels = 9;
    linearization_ = linearize(first, fewer, progress_);
    ShotTaker second(rig, log, "acquisition");
    acquisition_ = acquire({second, linearization_, settings_}, progress_);
  }

  Reverification lookAgain(std::vector<DeviceFault> faults = {}) {
    auto schedule = std::make_shared<FaultSchedule>();
    schedule->faults = std::move(faults);
    return lookAgain(venue_.rig(schedule));
  }
  Reverification lookAgain(Rig rig) {
    NoShotLog log;
    ShotTaker shots(rig, log, "verify");
    return verifyAgain({shots, linearization_, settings_}, acquisition_, progress_);
  }
  Rig rig() const { return venue_.rig(); }
  double errorThen() const { return acquisition_.verificationError; }
  const Acquisition& acquisition() const { return acquisition_; }

  static VenueSettings settingsOf(const char* name, std::uint64_t seed = 1) {
    VenueSettings settings;
    settings.name = name;
    settings.projector = {48, 36};
    settings.camera = {40, 30};
    settings.pathsPerPixel = 32;
    settings.seed = seed;
    return settings;
  }

 private:
  Progress progress_;
  SimulatedVenue venue_;
  Linearization linearization_;
  AcquisitionSettings settings_;
  Acquisition acquisition_;
};

/// Sees all light times `power`, what is not the projector's included.
class DimmedCamera : public Camera {
 public:
  DimmedCamera(std::unique_ptr<Camera> camera, double power) : camera_(std::move(camera)), power_(power) {}
  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  ExposureRange exposures() const override { return camera_->exposures(); }
  RawFrame capture(const CaptureRequest& request) override {
    RawFrame frame = camera_->capture(request);
    // What was cut off stays cut off: how bright it was is not known.
    for (float& value : frame.signal.data())
      if (value < 0.97f) value = std::min(1.0f, value * static_cast<float>(power_));
    frame.bits = 0;
    return frame;
  }

 private:
  std::unique_ptr<Camera> camera_;
  double power_;
};

DeviceFault always(FaultKind kind, double amount = 0.0) {
  DeviceFault fault;
  fault.kind = kind;
  fault.stage = "verify";
  fault.last = 1000;
  fault.amount = amount;
  return fault;
}

DeviceFault handInView() {
  DeviceFault fault = always(FaultKind::hand);
  fault.x0 = 0.4, fault.x1 = 0.6, fault.y0 = 0.3, fault.y1 = 0.6;
  return fault;
}

QString shown(const Reverification& found) {
  return QString("error %1, without lamp %2, changed %3, lamp %4, ambient %5")
      .arg(found.error)
      .arg(found.adapted)
      .arg(found.changedShare)
      .arg(found.lamp)
      .arg(found.ambient);
}

}  // namespace

Q_DECLARE_METATYPE(Verdict)
Q_DECLARE_METATYPE(std::vector<DeviceFault>)

class TestReverification : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    for (const char* name : {"plain", "corner"}) venues_[name] = std::make_unique<MeasuredVenue>(name);
  }

  /// Law: a few rows, which are taken apart, are predicted as they are by a product with all of T.
  void rowsArePredictedAlikeHoweverMany() {
    const MeasuredVenue venue("corner", acquisition::settingsOf(AcquisitionMode::multiplexed));
    const Acquisition& measured = venue.acquisition();
    const std::size_t rows = measured.flagged.size();
    QVERIFY(!measured.transport.groups().empty());
    const std::vector<float> tolerable(rows, 1.0f);
    const Expectation expected{measured.transport, measured.black, tolerable};
    const LightSource light = [&](const ProjectorStack& pattern, const auto&) {
      hdr::LampLight seen;
      seen.radiance = measured.transport.apply(pattern);
      for (float& value : seen.radiance) value *= 1.1f;
      seen.variance.assign(3 * rows, 1e-4f);
      seen.valid.assign(3 * rows, 1);
      return sentinels::Interruptible<SeenLight>(std::make_shared<const hdr::LampLight>(seen));
    };
    AcquisitionSettings settings;
    CameraMask few(rows, 0);
    for (std::size_t row = 7; row < rows; row += 29) few[row] = 1;
    Progress quiet;
    const auto ofAll = verify(expected, light, {settings, CameraMask(rows, 1)}, quiet),
               ofFew = verify(expected, light, {settings, few}, quiet);
    QVERIFY(ofAll && ofFew);
    std::size_t lit = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      const Residual &one = ofAll->rows[row], &other = ofFew->rows[row];
      QCOMPARE(other.light > 0.0, few[row] != 0 && one.light > 0.0);
      if (!(other.light > 0.0)) continue;
      ++lit;
      // Sums of hundreds of single precision, in another order.
      QVERIFY(std::abs(one.predicted - other.predicted) <= 1e-5 * one.predicted);
      QVERIFY(std::abs(one.variance - other.variance) <= 1e-5 * one.variance);
      QVERIFY(one.variance > one.noise);
    }
    QVERIFY(lit > 20);
  }

  void whatHasChanged_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<std::vector<DeviceFault>>("faults");
    QTest::addColumn<Verdict>("verdict");
    QTest::addColumn<QString>("says");
    using Faults = std::vector<DeviceFault>;
    for (const char* venue : {"plain", "corner"}) {
      auto row = [&](const char* what, const Faults& faults, Verdict verdict, const char* says) {
        QTest::addRow("%s: %s", venue, what) << QString(venue) << faults << verdict << QString(says);
      };
      row("nothing", {}, Verdict::stillGood, "Still good");
      row("room light", {always(FaultKind::ambient, 0.02)}, Verdict::remeasure, "room is brighter");
      row("something in the way", {handInView()}, Verdict::remeasure, "moved");
      row("moved camera", {always(FaultKind::shiftedCamera, 2.0)}, Verdict::startAgain, "has moved");
      row("mirrored screen", {always(FaultKind::mirroredScreen)}, Verdict::startAgain, "Start again");
      row("covered lens", {always(FaultKind::coveredLens)}, Verdict::startAgain, "lens");
      row("projector off", {always(FaultKind::asleepProjector)}, Verdict::startAgain, "projector off");
    }
  }
  void whatHasChanged() {
    QFETCH(QString, venue);
    QFETCH(std::vector<DeviceFault>, faults);
    QFETCH(Verdict, verdict);
    QFETCH(QString, says);
    MeasuredVenue& measured = *venues_[venue];
    Reverification found = measured.lookAgain(faults);
    Judgement judgement = judge(found, measured.errorThen());
    QByteArray figures =
        (shown(found) + "; " + QString::fromStdString(english(judgement.sentence))).toLocal8Bit();
    QVERIFY2(judgement.verdict == verdict, figures.constData());
    QVERIFY2(QString::fromStdString(english(judgement.sentence)).contains(says), figures.constData());
  }

  /// Law: another seed is other noise, not another venue: the error stays what it was. Twice 8 patterns of
  /// noise above threshold leave the figure within a tenth.
  void otherNoiseIsStillGood() {
    Progress silent;
    MeasuredVenue& measured = *venues_["corner"];
    SimulatedVenue again(MeasuredVenue::settingsOf("corner", 77), {}, silent);
    Reverification found = measured.lookAgain(again.rig());
    QVERIFY(judge(found, measured.errorThen()).verdict == Verdict::stillGood);
    QVERIFY2(std::abs(found.error / measured.errorThen() - 1.0) < 0.1,
             qPrintable(QString("%1 then %2").arg(found.error).arg(measured.errorThen())));
  }

  /// Law: a dimmer lamp is found to be as dim as it is, and no pixel is blamed for it.
  void aDimmerLampIsMeasured_data() {
    QTest::addColumn<double>("power");
    QTest::addColumn<Verdict>("verdict");
    QTest::newRow("as it was") << 1.0 << Verdict::stillGood;
    QTest::newRow("a little dimmer") << 0.95 << Verdict::stillGood;
    QTest::newRow("much dimmer") << 0.8 << Verdict::remeasure;
    QTest::newRow("brighter") << 1.2 << Verdict::remeasure;
  }
  void aDimmerLampIsMeasured() {
    QFETCH(double, power);
    QFETCH(Verdict, verdict);
    MeasuredVenue& measured = *venues_["corner"];
    Rig rig = measured.rig();
    rig.cameras[0] = std::make_unique<DimmedCamera>(std::move(rig.cameras[0]), power);
    Reverification found = measured.lookAgain(std::move(rig));
    Judgement judgement = judge(found, measured.errorThen());
    QByteArray figures =
        (shown(found) + "; " + QString::fromStdString(english(judgement.sentence))).toLocal8Bit();
    QVERIFY2(judgement.verdict == verdict, figures.constData());
    // Saturated pixels are left out; the least squares of 8 patterns over 1200 pixels is known to a per
    // mille.
    QVERIFY2(std::abs(found.lamp / power - 1.0) < 0.01, figures.constData());
    QVERIFY2(found.changedShare < 0.02, figures.constData());
  }

  void whatCanBeRepairedIsNotToBeMeasuredAgain_data() {
    QTest::addColumn<double>("lamp");
    QTest::addColumn<double>("ambient");
    QTest::addColumn<double>("changed");
    QTest::addColumn<double>("adapted");
    QTest::newRow("brighter room") << 1.0 << 0.02 << 0.0 << 0.0;
    QTest::newRow("darker room") << 1.0 << -0.02 << 0.0 << 0.0;
    QTest::newRow("changed view") << 1.0 << 0.0 << 0.1 << 0.0;
    QTest::newRow("lamp") << 0.8 << 0.0 << 0.0 << 0.0;
    QTest::newRow("prediction") << 1.0 << 0.0 << 0.0 << 0.5;
  }
  /// Law: the shortest way back is the one that is named: a repair takes seconds, a measurement minutes.
  void whatCanBeRepairedIsNotToBeMeasuredAgain() {
    QFETCH(double, lamp);
    QFETCH(double, ambient);
    QFETCH(double, changed);
    QFETCH(double, adapted);
    Reverification found;
    found.lamp = lamp;
    found.ambient = ambient;
    found.changedShare = changed;
    found.adapted = adapted;
    const Judgement judgement = judge(found, 0.02);
    const QString sentence = QString::fromStdString(english(judgement.sentence));
    QVERIFY(judgement.verdict == Verdict::remeasure);
    QVERIFY2(sentence.startsWith("Repair: ") && sentence.contains("epair the calibration"),
             qPrintable(sentence));
    QVERIFY2(!sentence.contains("measure", Qt::CaseInsensitive), qPrintable(sentence));
  }

  /// The map shows where: nearly all changed pixels lie in the part of the view that was covered.
  void changesAreWhereTheyAre() {
    Reverification found = venues_["plain"]->lookAgain({handInView()});
    int inside = 0, outside = 0;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        if (found.changed[static_cast<std::size_t>(40 * y + x)] != 0)
          ++(x >= 16 && x < 24 && y >= 9 && y < 18 ? inside : outside);
    QVERIFY2(inside > 60 && outside < 6, qPrintable(QString("%1 and %2").arg(inside).arg(outside)));
    QCOMPARE(found.residual.size(), std::size_t{4});
    for (const Stack& map : found.residual) QCOMPARE(map.size(), std::size_t{3 * 40 * 30});
  }

  void aboutTenPatterns() {
    Reverification found = venues_["plain"]->lookAgain();
    QVERIFY2(found.patterns >= 5 && found.patterns <= 12, qPrintable(QString::number(found.patterns)));
  }

  void otherSizesAreRefused() {
    VenueSettings settings = MeasuredVenue::settingsOf("plain");
    settings.projector = {50, 36};
    Progress silent;
    SimulatedVenue other(settings, {}, silent);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, venues_["plain"]->lookAgain(other.rig()));
  }

 private:
  std::map<QString, std::unique_ptr<MeasuredVenue>> venues_;
};

QTEST_GUILESS_MAIN(TestReverification)
#include "test_reverification.moc"
