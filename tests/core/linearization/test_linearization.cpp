// SPDX-License-Identifier: MIT
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "relucent/base/error.h"
#include "relucent/linearization/linearization.h"
#include "support/sanitized.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

struct Setup {
  SyntheticSettings scene;
  ScriptedSettings devices;
  LinearizationSettings settings;

  ScriptedVenue venue() const {
    TransportMatrix transport = syntheticTransport(scene);
    CameraStack black = syntheticBlack(transport);
    return ScriptedVenue(std::move(transport), std::move(black), devices);
  }
};

/// Projectors that each fill the camera's picture, or a part of it as large as one alone would.
Setup setupOf(const std::vector<ScriptedProjector>& projectors, bool sideBySide, std::uint64_t seed) {
  Setup setup;
  setup.scene.seed = seed;
  setup.scene.projectors.assign(projectors.size(), {64, 48});
  setup.scene.cameras = {{sideBySide ? 56 * static_cast<int>(projectors.size()) : 56, 56}};
  setup.scene.sideBySide = sideBySide;
  setup.scene.interreflection = 0.1;
  setup.devices.projectors = projectors;
  setup.devices.seed = setup.settings.seed = seed;
  return setup;
}

Linearization run(const ScriptedVenue& venue, const LinearizationSettings& settings) {
  Rig rig = venue.rig();
  NoShotLog log;
  ShotTaker taker(rig, log, "linearization");
  Progress progress;
  return linearize(taker, settings, progress);
}

/// Largest deviation of a found curve from the truth at the projector's own codes, relative to white.
double worstError(const ResponseCurve& found, const Curve& truth) {
  double worst = 0.0;
  for (int code = 0; code <= 255; ++code)
    worst = std::max(worst, std::abs(found(code / 255.0) - truth(code / 255.0) / truth(1.0)));
  return worst;
}

/// Remembers shots, for resuming.
class MemoryLog : public ShotLog {
 public:
  std::optional<Shot> find(const ShotId& id, const std::string& fingerprint) override {
    auto found = shots_.find(id.number);
    if (found == shots_.end() || found->second.fingerprint != fingerprint) return std::nullopt;
    return found->second;
  }
  void keep(const Shot& shot) override { shots_[shot.id.number] = shot; }
  std::size_t size() const { return shots_.size(); }

 private:
  std::map<int, Shot> shots_;
};

class Watcher : public ProgressSink {
 public:
  void progressed(double fraction, const Message& stage) override {
    ascends_ = ascends_ && fraction >= last_ - 1e-12;
    last_ = fraction;
    if (stages_.empty() || stages_.back() != english(stage)) stages_.push_back(english(stage));
    if (!english(stage).starts_with("Checking")) return;
    ++checks_;
    if (checks_ == stopAtCheck_) stop_.ask(StopRequest::Kind::cancel);
  }
  bool ascends_ = true;
  double last_ = 0.0;
  std::vector<std::string> stages_;
  int checks_ = 0;        // reports while nothing is photographed any more
  int stopAtCheck_ = -1;  // at which of them somebody asks to cancel
  StopRequest stop_;
};

/// A projector that corrects its picture's uniformity: the exponent of its response changes from the middle
/// to the edges, or from one side to the other, by up to `amount`.
class UnevenProjector : public Projector {
 public:
  UnevenProjector(std::unique_ptr<Projector> projector, double amount, bool radial)
      : projector_(std::move(projector)), amount_(amount), radial_(radial) {}

  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const image::Image& encodedDrive) override {
    image::Image changed = encodedDrive;
    for (std::size_t i = 0; i < changed.pixels(); ++i) {
      Pixel pixel = pixelAt(size(), i);
      double u = 2.0 * pixel.x / size().width - 1.0, v = 2.0 * pixel.y / size().height - 1.0;
      double exponent = 1.0 + amount_ * (radial_ ? 0.5 * (u * u + v * v) : 0.5 * (u + 1.0));
      for (float& value : changed.pixel(i))
        value = static_cast<float>(std::pow(static_cast<double>(value), exponent));
    }
    projector_->show(changed);
  }

 private:
  std::unique_ptr<Projector> projector_;
  double amount_;
  bool radial_;
};

/// A projector whose contrast follows the content: the more of its picture is lit, the darker.
class DimmingProjector : public Projector {
 public:
  explicit DimmingProjector(std::unique_ptr<Projector> projector) : projector_(std::move(projector)) {}

  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const image::Image& encodedDrive) override {
    double lit = 0.0;
    for (float value : encodedDrive.data()) lit += value > 0.0f ? 1.0 : 0.0;
    lit /= static_cast<double>(encodedDrive.data().size());
    image::Image changed = encodedDrive;
    for (float& value : changed.data()) value *= static_cast<float>(1.0 - 0.1 * std::max(0.0, lit - 0.5));
    projector_->show(changed);
  }

 private:
  std::unique_ptr<Projector> projector_;
};

/// A projector that tells which share of its picture was lit.
class WatchedProjector : public Projector {
 public:
  WatchedProjector(std::unique_ptr<Projector> projector, std::vector<double>& lit)
      : projector_(std::move(projector)), lit_(lit) {}

  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const image::Image& encodedDrive) override {
    double lit = 0.0;
    for (std::size_t i = 0; i < encodedDrive.pixels(); ++i)
      lit += std::ranges::max(encodedDrive.pixel(i)) > 0.0f ? 1.0 : 0.0;
    lit_.push_back(lit / static_cast<double>(encodedDrive.pixels()));
    projector_->show(encodedDrive);
  }

 private:
  std::unique_ptr<Projector> projector_;
  std::vector<double>& lit_;
};

bool says(const Linearization& found, const char* part) {
  return std::ranges::any_of(found.findings, [part](const Message& finding) {
    return QString::fromStdString(english(finding)).contains(part);
  });
}

bool same(const Linearization& a, const Linearization& b) {
  bool equal =
      a.exposures == b.exposures && a.additivityError == b.additivityError && a.findings == b.findings;
  for (std::size_t p = 0; equal && p < a.projectors.size(); ++p)
    equal = a.projectors[p].channels == b.projectors[p].channels;
  for (std::size_t c = 0; equal && c < a.cameras.size(); ++c)
    equal = a.cameras[c].readNoise == b.cameras[c].readNoise && a.cameras[c].gain == b.cameras[c].gain &&
            a.cameras[c].times == b.cameras[c].times && a.cameras[c].response == b.cameras[c].response;
  return equal;
}

}  // namespace

class TestLinearization : public QObject {
  Q_OBJECT

 private slots:
  void projectorCurvesAreRecovered_data() {
    QTest::addColumn<int>("shape");
    QTest::addColumn<int>("cameraBits");
    QTest::addColumn<bool>("imperfect");
    QTest::addColumn<quint64>("seed");
    quint64 seed = 1;
    for (int shape = 0; shape < 5; ++shape)
      for (bool imperfect : {false, true}) {
        int bits = seed % 3 == 0 ? 8 : 12;
        QTest::addRow("shape %d, %d bits%s, seed %llu", shape, bits, imperfect ? ", imperfect" : "", seed)
            << shape << bits << imperfect << seed;
        ++seed;
      }
  }
  void projectorCurvesAreRecovered() {
    QFETCH(int, shape);
    QFETCH(int, cameraBits);
    QFETCH(bool, imperfect);
    QFETCH(quint64, seed);
    const std::vector<std::array<Curve, 3>> shapes{
        {gammaCurve(2.2), gammaCurve(2.0), gammaCurve(2.5)},
        {identityCurve(), gammaCurve(1.4), gammaCurve(3.0)},
        {sCurve(), sCurve(0.2), sCurve(0.9)},
        // Crushed shadows, clipped lights, and a kink.
        {[](double x) { return std::pow(std::max(0.0, (x - 0.08) / 0.92), 2.2); },
         [](double x) { return std::pow(std::min(1.0, x / 0.92), 2.2); },
         [](double x) { return x < 0.5 ? 0.5 * x : 0.25 + 1.5 * (x - 0.5); }},
        {gammaCurve(2.4), sCurve(), identityCurve()}};
    Setup setup;
    setup.scene.seed = seed;
    setup.scene.cameras = {{static_cast<int>(37 + 2 * seed), 41}};
    setup.scene.interreflection = 0.1;
    ScriptedProjector projector;
    projector.curves = shapes[static_cast<std::size_t>(shape)];
    setup.devices.projectors = {projector};
    ScriptedCamera camera;
    camera.bits = cameraBits;
    camera.timeError = imperfect ? 0.05 : 0.0;
    setup.devices.cameras = {camera};
    setup.devices.drift = imperfect ? 0.3 : 0.0;
    setup.devices.seed = seed;
    setup.settings.seed = seed;
    Linearization found = run(setup.venue(), setup.settings);

    // Noise: some 1500 pixels, each good to 1 %, leave 3e-4 at white; 4 sigma over 99 levels 1e-3. A level's
    // interpolation misses smooth curves by less, a kink between levels h = 0.05 apart by slope * h / 8.
    bool kinks = shape == 3;
    for (std::size_t c = 0; c < 3; ++c) {
      double error = worstError(found.projectors[0].channels[c], projector.curves[c]);
      QVERIFY2(error < (kinks ? 0.015 : 0.003), qPrintable(QString("channel %1: %2").arg(c).arg(error)));
    }
    QVERIFY2(found.findings.empty(), found.findings.empty() ? "" : english(found.findings.front()).c_str());
    QVERIFY(found.additivityError[0] < setup.settings.additivityLimit);
  }

  /// Law: what one projector does in the others' photographs changes nothing of theirs.
  void severalProjectorsAreRecovered_data() {
    QTest::addColumn<std::vector<ScriptedProjector>>("projectors");
    QTest::addColumn<bool>("sideBySide");
    QTest::addColumn<quint64>("seed");
    const ScriptedProjector plain;
    ScriptedProjector soft, drifting, dimming, flickering, uneven;
    soft.curves = {gammaCurve(1.8), gammaCurve(1.8), gammaCurve(1.8)};
    soft.brightness = 4.0;
    soft.bits = 10;
    drifting.drift = 0.3;
    dimming.drift = -0.3;
    flickering.flicker = 4e-3;
    uneven.curves = {sCurve(), identityCurve(), gammaCurve(3.0)};
    struct Row {
      const char* name;
      bool sideBySide;
      std::vector<ScriptedProjector> projectors;
    };
    // In the same place each one's light is noise of the others: every kind of rig is there. Side by side
    // they share no more than far light: one row each for brightness, time and number. A row takes seconds,
    // ten times as long under sanitizers, which see every sixth.
    constexpr bool inTheSamePlace = false, sideBySide = true;
    const std::vector<Row> rows{
        {"one", inTheSamePlace, {plain}},
        {"two alike", inTheSamePlace, {plain, plain}},
        {"gamma 2.2 and 1.8, the second four times as bright", inTheSamePlace, {plain, soft}},
        {"the first four times as bright", inTheSamePlace, {soft, plain}},
        {"other shapes", inTheSamePlace, {uneven, plain}},
        {"one lamp drifts", inTheSamePlace, {plain, drifting}},
        {"lamps drift apart", inTheSamePlace, {dimming, drifting}},
        {"one lamp flickers", inTheSamePlace, {flickering, plain}},
        {"three", inTheSamePlace, {plain, uneven, dimming}},
        {"four", inTheSamePlace, {plain, uneven, dimming, flickering}},
        {"gamma 2.2 and 1.8, the second four times as bright", sideBySide, {plain, soft}},
        {"one lamp drifts", sideBySide, {plain, drifting}},
        {"three", sideBySide, {plain, uneven, dimming}},
        {"four", sideBySide, {plain, uneven, dimming, soft}}};
    quint64 seed = 0;
    for (const Row& row : rows)
      QTest::addRow("%s, %s", row.name, row.sideBySide ? "side by side" : "in the same place")
          << row.projectors << row.sideBySide << ++seed;
  }
  void severalProjectorsAreRecovered() {
    QFETCH(std::vector<ScriptedProjector>, projectors);
    QFETCH(bool, sideBySide);
    QFETCH(quint64, seed);
    Setup setup = setupOf(projectors, sideBySide, seed);
    Linearization found = run(setup.venue(), setup.settings);
    QCOMPARE(found.projectors.size(), projectors.size());

    double all = 0.0, most = 0.0, flicker = 0.0;
    for (const ScriptedProjector& projector : projectors) {
      all += projector.brightness;
      most = std::max(most, projector.brightness);
      flicker = std::max(flicker, projector.flicker);
    }
    for (std::size_t p = 0; p < projectors.size(); ++p) {
      // As of one alone, over the share that it has in the exposed light, whose photons are the noise.
      const double share = projectors[p].brightness / (sideBySide ? most : all),
                   limit = 0.004 / share + flicker;
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = worstError(found.projectors[p].channels[c], projectors[p].curves[c]);
        QVERIFY2(
            error < limit,
            qPrintable(QString("projector %1, channel %2: %3, not %4").arg(p).arg(c).arg(error).arg(limit)));
      }
    }
    QVERIFY2(found.findings.empty(), found.findings.empty() ? "" : english(found.findings.front()).c_str());
  }

  /// Law: a fault of one projector is told of that one alone.
  void findingsNameTheirProjector_data() {
    QTest::addColumn<int>("fault");
    QTest::addColumn<int>("which");
    QTest::addColumn<bool>("sideBySide");
    QTest::addColumn<QString>("text");
    const std::vector<std::pair<const char*, const char*>> faults{
        {"white segment", "white segment"},
        {"picture mode that dims white", "two halves of a picture"},
        {"uneven response", "not the same everywhere"}};
    for (bool sideBySide : {false, true})
      for (int which : {0, 1})
        for (int fault = 0; fault < 3; ++fault)
          if (sideBySide == (which == 1))
            QTest::addRow("%s in projector %d, %s", faults[static_cast<std::size_t>(fault)].first, which + 1,
                          sideBySide ? "side by side" : "in the same place")
                << fault << which << sideBySide << faults[static_cast<std::size_t>(fault)].second;
  }
  void findingsNameTheirProjector() {
    QFETCH(int, fault);
    QFETCH(int, which);
    QFETCH(bool, sideBySide);
    QFETCH(QString, text);
    const auto at = static_cast<std::size_t>(which);
    std::vector<ScriptedProjector> projectors(2);
    for (ScriptedProjector& projector : projectors) projector.bits = 12;
    if (fault == 0) projectors[at].whiteSegment = 0.3;
    Setup setup = setupOf(projectors, sideBySide, 3);
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    if (fault == 1) rig.projectors[at] = std::make_unique<DimmingProjector>(std::move(rig.projectors[at]));
    if (fault == 2)
      rig.projectors[at] = std::make_unique<UnevenProjector>(std::move(rig.projectors[at]), 0.4, true);
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Progress progress;
    const Linearization found = linearize(taker, setup.settings, progress);
    // A camera may have seen its light change as well.
    QVERIFY(says(found, text.toUtf8().constData()));
    const QString other = QString("scripted projector %1:").arg(2 - which);
    for (const Message& finding : found.findings)
      QVERIFY2(!QString::fromStdString(english(finding)).startsWith(other), english(finding).c_str());
  }

  /// Where all groups are lit, cells stay dark in which other projectors are seen alone.
  void severalProjectorsLeaveCellsDark() {
    Setup setup = setupOf(std::vector<ScriptedProjector>(2), false, 1);
    setup.settings.levels = 6;
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    std::vector<double> lit;
    rig.projectors[1] = std::make_unique<WatchedProjector>(std::move(rig.projectors[1]), lit);
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Progress progress;
    linearize(taker, setup.settings, progress);
    QVERIFY(std::ranges::any_of(lit, [](double share) { return std::abs(share - 6.0 / 7.0) < 0.03; }));
  }

  void aMissingChannelNamesItsProjector() {
    std::vector<ScriptedProjector> projectors(2);
    projectors[1].curves[0] = [](double) { return 0.0; };
    Setup setup = setupOf(projectors, false, 1);
    try {
      run(setup.venue(), setup.settings);
      QFAIL("a projector without red was accepted");
    } catch (const Error& error) {
      QVERIFY(QString(error.what()).contains("red"));
      QVERIFY(QString(error.what()).contains("scripted projector 2"));
    }
  }

  void twoProjectorsAndTwoCameras() {
    Setup setup;
    setup.scene.projectors = {{32, 24}, {27, 19}};
    setup.scene.cameras = {{40, 30}, {33, 35}};
    setup.scene.brightness = 8.0;
    ScriptedProjector first, second;
    second.curves = {gammaCurve(1.8), sCurve(), gammaCurve(2.6)};
    second.bits = 10;
    setup.devices.projectors = {first, second};
    ScriptedCamera curved;
    curved.bits = 16;
    curved.response = [](double x) { return std::pow(x, 1.0 / 1.8); };
    curved.readNoise = 3e-3;
    setup.devices.cameras = {ScriptedCamera(), curved};
    setup.settings.levels = 25;
    Linearization found = run(setup.venue(), setup.settings);

    QCOMPARE(found.projectors.size(), std::size_t{2});
    QCOMPARE(found.cameras.size(), std::size_t{2});
    QCOMPARE(found.additivityError.size(), std::size_t{2});
    QVERIFY(found.cameras[0].response[0].isIdentity());
    QVERIFY(!found.cameras[1].response[0].isIdentity());
    QVERIFY(std::abs(found.cameras[0].readNoise - 1e-3) < 4e-4);
    // The curved camera's residual, up to 3 % of its own, is shared with the linear one's.
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t c = 0; c < 3; ++c) {
        const double error =
            worstError(found.projectors[p].channels[c], setup.devices.projectors[p].curves[c]);
        QVERIFY2(error < 0.015, qPrintable(QString("projector %1, channel %2: %3").arg(p).arg(c).arg(error)));
      }
  }

  void aCurvedCameraAloneWillDo() {
    Setup setup;
    ScriptedCamera camera;
    camera.bits = 8;
    camera.response = [](double x) {
      return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    };
    setup.devices.cameras = {camera};
    Linearization found = run(setup.venue(), setup.settings);
    for (std::size_t c = 0; c < 3; ++c) {
      double error = worstError(found.projectors[0].channels[c], gammaCurve(2.2));
      QVERIFY2(error < 0.02, qPrintable(QString::number(error)));
    }
  }

  void brokenAdditivityIsFound_data() {
    QTest::addColumn<double>("whiteSegment");
    QTest::addColumn<bool>("finding");
    QTest::newRow("none") << 0.0 << false;
    QTest::newRow("1 %, below the limit") << 0.01 << false;
    QTest::newRow("5 %") << 0.05 << true;
    QTest::newRow("60 %") << 0.6 << true;
  }
  void brokenAdditivityIsFound() {
    QFETCH(double, whiteSegment);
    QFETCH(bool, finding);
    Setup setup;
    ScriptedProjector projector;
    projector.whiteSegment = whiteSegment;
    setup.devices.projectors = {projector};
    setup.settings.levels = 9;
    Linearization found = run(setup.venue(), setup.settings);
    QCOMPARE(!found.findings.empty(), finding);
    QVERIFY2(std::abs(found.additivityError[0] - whiteSegment) < 0.005,
             qPrintable(QString::number(found.additivityError[0])));
    if (finding) QVERIFY(QString::fromStdString(english(found.findings.front())).contains("white segment"));
  }

  void anUnevenResponseIsFound_data() {
    QTest::addColumn<double>("amount");
    QTest::addColumn<bool>("radial");
    QTest::addColumn<bool>("finding");
    for (bool radial : {false, true}) {
      const char* where = radial ? "from the middle outwards" : "from left to right";
      QTest::addRow("even, %s", where) << 0.0 << radial << false;
      QTest::addRow("0.02 of the exponent, %s", where) << 0.02 << radial << false;
      QTest::addRow("0.3, %s", where) << 0.3 << radial << true;
      QTest::addRow("0.6, %s", where) << 0.6 << radial << true;
    }
  }
  void anUnevenResponseIsFound() {
    QFETCH(double, amount);
    QFETCH(bool, radial);
    QFETCH(bool, finding);
    Setup setup;
    setup.scene.interreflection = 0.2;
    setup.devices.flicker = 2e-3;
    ScriptedProjector projector;
    projector.bits = 12;
    setup.devices.projectors = {projector};
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    rig.projectors[0] = std::make_unique<UnevenProjector>(std::move(rig.projectors[0]), amount, radial);
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Progress progress;
    Linearization found = linearize(taker, setup.settings, progress);
    QCOMPARE(says(found, "not the same everywhere"), finding);
    if (!finding) QVERIFY(found.findings.empty());
  }

  void aWhiteSegmentLeavesTheCurves() {
    Setup setup;
    ScriptedProjector projector;
    projector.whiteSegment = 0.4;
    projector.curves = {gammaCurve(2.2), sCurve(), gammaCurve(1.8)};
    setup.devices.projectors = {projector};
    Linearization found = run(setup.venue(), setup.settings);
    // 1200 pixels, each good to 1 %.
    for (std::size_t c = 0; c < 3; ++c)
      QVERIFY(worstError(found.projectors[0].channels[c], projector.curves[c]) < 0.005);
  }

  void flickerIsFound() {
    Setup setup;
    setup.devices.flicker = 0.03;
    setup.settings.levels = 9;
    Linearization found = run(setup.venue(), setup.settings);
    QVERIFY(says(found, "from one photograph to the next"));
  }

  /// Law: every level has its residual, also where levels were pooled for the curve to rise: some of the
  /// noise.
  void everyLevelHasAResidual() {
    std::size_t pooled = 0;
    for (std::uint64_t seed = 1; seed <= (isSanitized ? 1 : 4); ++seed) {
      ScriptedProjector flat;
      flat.curves.fill([](double drive) { return std::pow(std::max(0.0, drive - 0.3) / 0.7, 2.0); });
      Setup setup = setupOf({flat}, false, seed);
      setup.devices.cameras = {{.bits = 10, .readNoise = 5e-3}};
      const Linearization found = run(setup.venue(), setup.settings);
      const ProjectorResponse& response = found.projectors.front();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<LevelResidual>& residuals = response.residuals[c];
        QCOMPARE(residuals.front().drive, 0.0);
        QCOMPARE(residuals.back().drive, 1.0);
        QVERIFY(std::ranges::is_sorted(residuals, {}, &LevelResidual::drive));
        for (const auto [drive, light] : residuals)
          QVERIFY2(std::abs(light) < 0.05, qPrintable(QString::number(light)));
        QVERIFY(response.channels[c].x().size() <= residuals.size());
        pooled += residuals.size() - response.channels[c].x().size();
      }
    }
    QVERIFY(pooled > 0);
  }

  void blindCamerasAreRefused_data() {
    QTest::addColumn<double>("ambient");
    QTest::newRow("in the dark") << 0.0;
    QTest::newRow("in room light") << 5.0;
  }
  void blindCamerasAreRefused() {
    QFETCH(double, ambient);
    Setup setup;
    setup.scene.brightness = 1e-7;
    setup.devices.ambient = CameraStack(Stack(3 * 40 * 30, static_cast<float>(ambient)));
    ScriptedVenue venue = setup.venue();
    try {
      run(venue, setup.settings);
      QFAIL("a blind camera was accepted");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::input);
      QVERIFY(QString(error.what()).contains("no difference"));
    }
  }

  void aDarkChannelIsRefused() {
    Setup setup;
    ScriptedProjector projector;
    projector.curves[2] = [](double) { return 0.0; };
    setup.devices.projectors = {projector};
    try {
      run(setup.venue(), setup.settings);
      QFAIL("a projector without blue was accepted");
    } catch (const Error& error) {
      QVERIFY(QString(error.what()).contains("blue"));
    }
  }

  void cancellingAtAnyShotEndsAsCancelledAndResumes_data() {
    QTest::addColumn<int>("projectors");
    QTest::newRow("one projector") << 1;
    QTest::newRow("two") << 2;
  }
  void cancellingAtAnyShotEndsAsCancelledAndResumes() {
    QFETCH(int, projectors);
    Setup setup;
    setup.scene.projectors.assign(static_cast<std::size_t>(projectors), {12, 9});
    setup.scene.cameras = {{13, 11}};
    setup.settings.levels = 6;
    Linearization whole = run(setup.venue(), setup.settings);

    int captures = 0;
    {
      ScriptedVenue venue = setup.venue();
      run(venue, setup.settings);
      captures = venue.captures();
    }
    QVERIFY(captures > 15);
    for (int stopAt = 0; stopAt < captures; stopAt += 3) {
      StopRequest stop;
      int count = 0;
      Setup stopping = setup;
      stopping.devices.beforeCapture = [&](const CaptureRequest&) {
        if (count++ == stopAt) stop.ask(StopRequest::Kind::cancel);
      };
      ScriptedVenue venue = stopping.venue();
      Rig rig = venue.rig();
      MemoryLog log;
      Watcher watcher;
      {
        ShotTaker taker(rig, log, "linearization");
        Progress progress(watcher, stop);
        QVERIFY_EXCEPTION_THROWN(linearize(taker, setup.settings, progress), Cancelled);
      }
      // Going on from what was kept ends in the same bits.
      if (stopAt % 15 != 0) continue;
      ScriptedVenue again = setup.venue();
      Rig freshRig = again.rig();
      ShotTaker taker(freshRig, log, "linearization");
      Progress progress;
      QVERIFY(same(linearize(taker, setup.settings, progress), whole));
      QVERIFY(again.captures() < captures || stopAt == 0);
    }
  }

  void progressIsReported_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<int>("stages");
    QTest::newRow("one projector") << 1 << 4;
    QTest::newRow("two") << 2 << 6;
  }
  void progressIsReported() {
    QFETCH(int, projectors);
    QFETCH(int, stages);
    Setup setup;
    setup.scene.projectors.assign(static_cast<std::size_t>(projectors), {32, 24});
    setup.settings.levels = 6;
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Watcher watcher;
    Progress progress(watcher, watcher.stop_);
    linearize(taker, setup.settings, progress);
    QVERIFY(watcher.ascends_);
    QCOMPARE(watcher.last_, 1.0);
    // Every photograph that is read, every round of the fit, every part of the picture.
    QVERIFY2(watcher.checks_ > taker.shots(), qPrintable(QString::number(watcher.checks_)));
    QVERIFY2(static_cast<int>(watcher.stages_.size()) >= stages,
             qPrintable(QString::number(watcher.stages_.size())));
  }

  /// The last photograph is taken, and what they all say is being computed.
  void computingCanBeCancelled_data() {
    QTest::addColumn<int>("check");
    for (int check : {1, 10, 20, 30, 40}) QTest::addRow("report %d", check) << check;
  }
  void computingCanBeCancelled() {
    QFETCH(int, check);
    Setup setup = setupOf(std::vector<ScriptedProjector>(2), true, 1);
    setup.settings.levels = 6;
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Watcher watcher;
    watcher.stopAtCheck_ = check;
    Progress progress(watcher, watcher.stop_);
    QVERIFY_EXCEPTION_THROWN(linearize(taker, setup.settings, progress), Cancelled);
    QCOMPARE(watcher.checks_, check);
  }

  /// Ten more for the second; of three and more seven for each, and some for their levels.
  void fewPhotographsMoreForEachProjector_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<int>("photographs");
    QTest::newRow("one") << 1 << 30;
    QTest::newRow("two") << 2 << 41;
    QTest::newRow("three") << 3 << 49;
    QTest::newRow("four") << 4 << 56;
  }
  void fewPhotographsMoreForEachProjector() {
    QFETCH(int, projectors);
    QFETCH(int, photographs);
    const auto count = static_cast<std::size_t>(projectors);
    Setup setup = setupOf(std::vector<ScriptedProjector>(count), false, 1);
    ScriptedVenue venue = setup.venue();
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "linearization");
    Progress progress;
    linearize(taker, setup.settings, progress);
    QVERIFY2(taker.exposures() <= photographs, qPrintable(QString::number(taker.exposures())));
    QVERIFY(std::abs(taker.shots() - usualShots(setup.settings, count)) <= 2);
  }

  /// What was photographed of other patterns, as an earlier version showed them, is photographed again.
  void aJournalOfOtherPatternsIsReplaced() {
    Setup setup = setupOf(std::vector<ScriptedProjector>(2), false, 1);
    setup.settings.levels = 6;
    auto linearized = [&setup](MemoryLog& log, std::uint64_t seed, int& captures) {
      Setup own = setup;
      own.settings.seed = seed;
      ScriptedVenue venue = own.venue();
      Rig rig = venue.rig();
      ShotTaker taker(rig, log, "linearization");
      Progress progress;
      Linearization result = linearize(taker, own.settings, progress);
      captures = venue.captures();
      return result;
    };
    MemoryLog none, other;
    int all = 0, first = 0, again = 0, kept = 0;
    const Linearization whole = linearized(none, 1, all);
    linearized(other, 2, first);
    QVERIFY(same(linearized(other, 1, again), whole));
    QVERIFY(again < all);  // exposures and black were known
    QVERIFY(same(linearized(other, 1, kept), whole));
    QCOMPARE(kept, 0);
  }

  void badSettingsAreNamed() {
    QVERIFY(problems(LinearizationSettings()).empty());
    QCOMPARE(problems({.levels = 2}).size(), std::size_t{1});
    QCOMPARE(problems({.shadowPower = std::nan("")}).size(), std::size_t{1});
    QCOMPARE(problems({.noisePairs = 0}).size(), std::size_t{1});
    QCOMPARE(problems({.additivityLimit = 0.0}).size(), std::size_t{1});
  }
};

QTEST_APPLESS_MAIN(TestLinearization)
#include "test_linearization.moc"
