// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/photography/photographer.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::photography;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

const std::vector<double> exposures{0.4, 0.1, 0.025};

/// A noiseless venue of one camera; radiances below are camera signal per second.
struct Studio {
  explicit Studio(double brightness) {
    SyntheticSettings settings;
    settings.projectors = {{8, 6}};
    settings.cameras = {{8, 6}};
    settings.brightness = brightness;
    TransportMatrix transport = syntheticTransport(settings);
    ScriptedCamera camera;
    camera.bits = 0;
    camera.readNoise = 0.0;
    camera.gain = 0.0;
    ScriptedSettings scripted;
    scripted.cameras = {camera};
    venue = std::make_unique<ScriptedVenue>(transport, CameraStack{}, scripted);
    rig = venue->rig();
    shots = std::make_unique<ShotTaker>(rig, log, "test");
    linearization.cameras.resize(1);
    linearization.exposures = exposures;
    photographer = std::make_unique<Photographer>(*shots, linearization);
  }
  std::vector<Demand> demands(float brightest, float deviation) const {
    return std::vector<Demand>(48, Demand{brightest, brightest, deviation});
  }

  std::unique_ptr<ScriptedVenue> venue;
  Rig rig;
  NoShotLog log;
  std::unique_ptr<ShotTaker> shots;
  Linearization linearization;
  std::unique_ptr<Photographer> photographer;
};

}  // namespace

class TestPhotographer : public QObject {
  Q_OBJECT

 private slots:
  /// Saturation is at 0.97 of full scale and 10 % stay free: 0.4 s serve up to 2.18, 0.1 s up to 8.73.
  void theFewestExposuresAreChosen_data() {
    QTest::addColumn<double>("brightest");
    QTest::addColumn<double>("deviation");
    QTest::addColumn<int>("exposure");
    QTest::newRow("dark") << 0.01 << 0.0 << 0;
    QTest::newRow("just unsaturated") << 2.1 << 0.0 << 0;
    QTest::newRow("just saturated") << 2.3 << 0.0 << 1;
    QTest::newRow("bright") << 30.0 << 0.0 << 2;
    QTest::newRow("too bright for all") << 1000.0 << 0.0 << 2;
  }
  void theFewestExposuresAreChosen() {
    QFETCH(double, brightest);
    QFETCH(double, deviation);
    QFETCH(int, exposure);
    Studio studio(1.0);
    auto demands = studio.demands(static_cast<float>(brightest), static_cast<float>(deviation));
    QCOMPARE(studio.photographer->exposuresFor(demands),
             std::vector<std::size_t>{static_cast<std::size_t>(exposure)});
  }

  void mixedPixelsGetMoreThanOneOnlyIfNoiseDemandsIt() {
    Studio studio(1.0);
    auto demands = studio.demands(0.5f, 1e-6f);
    for (std::size_t row = 0; row < 10; ++row) demands[row] = {20.0f, 20.0f, 1e-6f};
    QCOMPARE(studio.photographer->exposuresFor(demands), (std::vector<std::size_t>{0, 2}));
    for (Demand& demand : demands) demand.deviation = 1.0f;
    QCOMPARE(studio.photographer->exposuresFor(demands), (std::vector<std::size_t>{2}));
    std::fill(demands.begin(), demands.end(), Demand{});
    QVERIFY(studio.photographer->exposuresFor(demands).empty());
  }

  void whatSaturatesIsTakenAgain() {
    Studio studio(36.0);
    ProjectorStack white(3 * 48, 1.0f);
    HdrFrame frame = studio.photographer->take(white, studio.demands(0.1f, 1e-6f), Progress());
    QCOMPARE(studio.shots->shots(), 3);
    std::vector<Image> patterns{imageFromStack(white, studio.venue->transport().projectors(), 0)};
    Stack truth = studio.venue->radiance(patterns);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      QVERIFY(frame.valid[i]);
      QVERIFY(std::abs(frame.radiance[i] - truth[i]) < 1e-5f * truth[i] + 1e-6f);
    }
  }

  void pixelsThatNobodyNeedsAreNotTakenAgain() {
    Studio studio(12.0);
    std::vector<Demand> demands(48);
    ProjectorStack white(3 * 48, 1.0f);
    std::vector<Image> patterns{imageFromStack(white, studio.venue->transport().projectors(), 0)};
    Stack truth = studio.venue->radiance(patterns);
    std::size_t darkest = 0;
    for (std::size_t row = 0; row < 48; ++row)
      if (truth[3 * row + 1] < truth[3 * darkest + 1]) darkest = row;
    demands[darkest] = {8.0f, 1.0f, 1e-6f};
    studio.photographer->take(white, demands, Progress());
    QCOMPARE(studio.shots->shots(), 1);
  }

  void whatSaturatesInEveryExposureStaysInvalid() {
    Studio studio(1000.0);
    HdrFrame frame =
        studio.photographer->take(ProjectorStack(3 * 48, 1.0f), studio.demands(0.1f, 1e-6f), Progress());
    QVERIFY(std::count(frame.valid.begin(), frame.valid.end(), 0) > 0);
    QCOMPARE(studio.shots->exposures(), 3);
  }
};

QTEST_APPLESS_MAIN(TestPhotographer)
#include "test_photographer.moc"
