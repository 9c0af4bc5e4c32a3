// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "acquisition_run.h"
#include "relucent/acquisition/forecast.h"
#include "relucent/base/message.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::image;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

/// Keeps every expectation, and where the measurement stood when it was told.
class Listener : public ProgressSink {
 public:
  void progressed(double, const Message& stage) override {
    const std::string name = english(stage);
    if (name.starts_with("level") && (levels.empty() || levels.back() != name)) levels.push_back(name);
  }
  void expected(const WorkLeft& work) override {
    told.push_back(work);
    if (taken != nullptr) before.push_back(*taken);
  }

  std::vector<std::string> levels;
  std::vector<WorkLeft> told;
  const int* taken = nullptr;  // how many photographs there are
  std::vector<int> before;     // each expectation
};

Venue venueOf(Size projector, Size camera, double interreflection, std::uint64_t seed) {
  Venue venue;
  venue.synthetic.projectors = {projector};
  venue.synthetic.cameras = {camera};
  venue.synthetic.interreflection = interreflection;
  venue.synthetic.seed = seed;
  venue.noise = 5e-4;
  venue.settings.flagRelative = 10.0;  // nothing is flagged, so nothing is measured again
  return venue;
}

/// Devices whose time is a number that they advance themselves.
struct TimedDevices {
  double now = 0.0;
  double show = 0.0, overhead = 0.0, slope = 1.0;

  class TimedProjector : public Projector {
   public:
    explicit TimedProjector(TimedDevices& times) : times_(times) {}
    std::string name() const override { return "projector"; }
    Size size() const override { return {4, 4}; }
    int bits() const override { return 8; }
    void show(const Image&) override { times_.now += times_.show; }

   private:
    TimedDevices& times_;
  };
  class TimedCamera : public Camera {
   public:
    explicit TimedCamera(TimedDevices& times) : times_(times) {}
    std::string name() const override { return "camera"; }
    Size size() const override { return {4, 4}; }
    ExposureRange exposures() const override { return {0.01, 1.0}; }
    RawFrame capture(const CaptureRequest& request) override {
      times_.now += times_.overhead + times_.slope * request.seconds;
      return {Image({4, 4}, 3), 12, request.seconds};
    }

   private:
    TimedDevices& times_;
  };
};

}  // namespace

class TestForecast : public QObject {
  Q_OBJECT

 private slots:
  /// Law: a line through the devices' times gives any other exposure's time, up to rounding.
  void devicesAreBenchmarked_data() {
    QTest::addColumn<double>("slope");
    QTest::newRow("a real camera") << 1.0;
    QTest::newRow("a simulated one, no time to expose") << 0.0;
    QTest::newRow("a camera that exposes twice") << 2.0;
  }
  void devicesAreBenchmarked() {
    QFETCH(double, slope);
    TimedDevices devices{0.0, 0.05, 0.2, slope};
    Rig rig;
    rig.projectors.push_back(std::make_unique<TimedDevices::TimedProjector>(devices));
    rig.cameras.push_back(std::make_unique<TimedDevices::TimedCamera>(devices));
    NoShotLog log;
    ShotTaker shots(rig, log, "test", [&] { return std::chrono::duration<double>(devices.now); });
    for (double seconds : {0.1, 0.4, 0.02}) {
      shots.take({Image({4, 4}, 3)}, {seconds, 0.5 * seconds}, Progress());
      devices.now += 0.03;  // computing
    }
    const ShotTimes& times = shots.times();
    QCOMPARE(times.shots, 3);
    QCOMPARE(times.exposures, 6);
    QCOMPARE(times.bytes, std::uint64_t{6 * 4 * 4 * 3 * 2});
    // Computing lies between shots: two gaps for three of them.
    QVERIFY(std::abs(times.shotSeconds() - (0.05 + 0.03 * 2.0 / 3.0)) < 1e-9);
    for (double seconds : {0.01, 0.25, 2.0})
      QVERIFY2(std::abs(times.exposureSeconds(seconds) - (0.2 + slope * seconds)) < 1e-9,
               qPrintable(QString::number(times.exposureSeconds(seconds))));
  }

  void nothingMeasuredIsNoTime() {
    QCOMPARE(ShotTimes().shotSeconds(), 0.0);
    QCOMPARE(ShotTimes().exposureSeconds(0.5), 0.5);
  }

  /// Law: what a log held already says nothing about the devices.
  void shotsThatWereReadAreNotTimed() {
    TimedDevices devices;
    Rig rig;
    rig.projectors.push_back(std::make_unique<TimedDevices::TimedProjector>(devices));
    rig.cameras.push_back(std::make_unique<TimedDevices::TimedCamera>(devices));
    MemoryLog own;
    ShotTaker first(rig, own, "test");
    first.take({Image({4, 4}, 3)}, {0.1}, Progress());
    ShotTaker again(rig, own, "test");
    again.take({Image({4, 4}, 3)}, {0.1}, Progress());
    QCOMPARE(first.times().shots, 1);
    QCOMPARE(again.times().shots, 0);
    QCOMPARE(again.shots(), 1);
  }

  /// Law: the levels that are known are as they are; no level needs more than a pattern a block, quadrant and
  /// light; least <= likely <= most.
  void levelsAreBounded_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("one pixel") << 1 << 1;
    QTest::newRow("a line") << 37 << 1;
    QTest::newRow("small") << 32 << 24;
    QTest::newRow("full scale") << 1024 << 768;
  }
  void levelsAreBounded() {
    QFETCH(int, width);
    QFETCH(int, height);
    Rasters projectors({Size{width, height}});
    NodeLayout layout(projectors);
    for (auto [known, threshold] :
         {std::pair(std::vector<int>{}, 0.008), std::pair(std::vector<int>{12, 36, 60}, 0.008),
          std::pair(std::vector<int>{}, 0.0001), std::pair(std::vector<int>{12}, 0.5)}) {
      std::vector<PatternRange> levels = levelPatterns(projectors, 3, known, colourFactor(threshold));
      QCOMPARE(static_cast<int>(levels.size()), layout.levels() - 1);
      for (std::size_t i = 0; i < levels.size(); ++i) {
        if (i < known.size()) {
          QCOMPARE(levels[i].likely, static_cast<double>(known[i]));
          continue;
        }
        int level = layout.levels() - 1 - static_cast<int>(i);
        QVERIFY(levels[i].least <= levels[i].likely && levels[i].likely <= levels[i].most);
        QVERIFY(levels[i].most <= 12.0 * static_cast<double>(layout.gridSize(0, level).count()));
      }
    }
  }

  /// Law: what is looked at more finely takes longer, and the usual as long as ever.
  void finerTakesLonger() {
    AcquisitionSettings settings;
    QCOMPARE(colourFactor(settings.relativeThreshold), 1.0);
    int before = 0;
    for (double threshold : {0.1, 0.02, 0.008, 0.006}) {
      settings.relativeThreshold = threshold;
      WorkLeft work = forecast({Rasters(Size{64, 48}), Rasters(Size{128, 96}), 2, 0.1}, settings, {}, {});
      QVERIFY2(work.shots > before, qPrintable(QString::number(threshold)));
      before = work.shots;
    }
  }

  /// Law: what is foretold happens. Before the first photograph the range holds the number of patterns that
  /// were then needed; once all levels have begun, only what nobody can know is missing, the repair of
  /// flagged pixels; what is on disk is exact where the number of exposures is.
  void whatIsForetoldHappens_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<double>("interreflection");
    QTest::addColumn<quint64>("seed");
    QTest::addColumn<int>("scheme");
    for (quint64 seed : {1, 2}) {
      QTest::addRow("direct, %d", int(seed)) << 32 << 0.0 << seed << 0;
      QTest::addRow("interreflecting, %d", int(seed)) << 45 << 0.4 << seed << 0;
      QTest::addRow("sen, %d", int(seed)) << 32 << 0.2 << seed << 1;
    }
  }
  void whatIsForetoldHappens() {
    QFETCH(int, width);
    QFETCH(double, interreflection);
    QFETCH(quint64, seed);
    QFETCH(int, scheme);
    Venue venue = venueOf({width, 3 * width / 4}, {24, 18}, interreflection, seed);
    venue.settings.scheme = static_cast<AcquisitionScheme>(scheme);
    Listener listener;
    StopRequest stop;
    NoShotLog log;
    Acquisition acquisition = Run(venue)(log, Progress(listener, stop));

    // One before, one for each level that has patterns.
    QCOMPARE(listener.told.size(), listener.levels.size() + 1);
    const WorkLeft& before = listener.told.front();
    QByteArray figures = QString("%1 to %2, likely %3, were %4 patterns, %5 exposures; last %6")
                             .arg(before.leastShots)
                             .arg(before.mostShots)
                             .arg(before.shots)
                             .arg(acquisition.patterns)
                             .arg(acquisition.exposures)
                             .arg(listener.told.back().shots)
                             .toLocal8Bit();
    qInfo("%s", figures.constData());
    QVERIFY2(before.leastShots <= acquisition.patterns && acquisition.patterns <= before.mostShots,
             figures.constData());
    // The range narrows to nothing.
    const WorkLeft& last = listener.told.back();
    QCOMPARE(last.leastShots, last.mostShots);
    QVERIFY(before.mostShots > before.leastShots);
  }

  /// Law: with every level known, all shots are counted exactly: references, checks, tree, test patterns.
  void countsAreExactWhereTheyAreKnown() {
    Venue venue = venueOf({32, 24}, {24, 18}, 0.1, 3);
    Listener listener;
    StopRequest stop;
    NoShotLog log;
    Acquisition acquisition = Run(venue)(log, Progress(listener, stop));
    AcquisitionState state;
    for (const std::string& level : listener.levels)
      state.levels.push_back(QString::fromStdString(level).section(": ", 1).section(' ', 0, 0).toInt());
    WorkLeft all =
        forecast({Rasters(Size{24, 18}), Rasters(Size{32, 24}), 2, 0.1}, venue.settings, {}, state);
    QCOMPARE(all.shots, acquisition.patterns);
    QCOMPARE(all.leastShots, all.mostShots);
  }

  /// Law: of dense patterns as many photographs are foretold as are then taken, although references and
  /// checks have every exposure and patterns one, rarely two: up to the fifth that may need another one.
  void photographsOfDensePatternsAreForetold_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("exposures");
    QTest::addColumn<quint64>("seed");
    for (int width : {32, 64})
      for (int exposures : {1, 2, 4})
        for (quint64 seed : {1, 2})
          QTest::addRow("%d wide, %d exposures, %d", width, exposures, int(seed))
              << width << exposures << seed;
  }
  void photographsOfDensePatternsAreForetold() {
    QFETCH(int, width);
    QFETCH(int, exposures);
    QFETCH(quint64, seed);
    Venue venue = venueOf({width, 3 * width / 4}, {width / 4 * 3, width / 2}, 0.2, seed);
    venue.settings = settingsOf(AcquisitionMode::multiplexed);
    venue.settings.flagRelative = 10.0;
    venue.exposures.clear();
    for (int i = 0; i < exposures; ++i) venue.exposures.push_back(0.05 * std::pow(4.0, exposures - 1 - i));
    Listener listener;
    StopRequest stop;
    class CountingLog : public NoShotLog {
     public:
      void keep(const Shot& shot) override { exposures += static_cast<int>(shot.frames.size()); }
      int exposures = 0;
    } log;
    listener.taken = &log.exposures;
    Acquisition acquisition = Run(venue)(log, Progress(listener, stop));
    QCOMPARE(log.exposures, acquisition.exposures);
    const int left = acquisition.exposures - listener.before.back();
    const WorkLeft &first = listener.told.front(), &last = listener.told.back();
    const QByteArray figures = QString("at first %1 of %2 shots, were %3 of %4; at last %5, were %6")
                                   .arg(first.exposures)
                                   .arg(first.shots)
                                   .arg(acquisition.exposures)
                                   .arg(acquisition.patterns)
                                   .arg(last.exposures)
                                   .arg(left)
                                   .toLocal8Bit();
    qInfo("%s", figures.constData());
    const auto isNear = [](double foretold, double was) { return std::abs(foretold - was) <= 0.25 * was; };
    QVERIFY2(isNear(first.exposures, acquisition.exposures), figures.constData());
    QVERIFY2(
        isNear(double(first.exposures) / first.shots, double(acquisition.exposures) / acquisition.patterns),
        figures.constData());
    QVERIFY2(last.exposures >= 0.75 * left, figures.constData());  // checks gather at the end
  }

  /// What is measured replaces the benchmark.
  void timesAreRefined() {
    Rasters cameras({Size{40, 30}}), projectors({Size{32, 24}});
    AcquisitionSettings settings;
    ShotTimes slow, fast;
    slow.shots = fast.shots = 100;
    slow.exposures = fast.exposures = 200;
    slow.capturing = 200.0;
    slow.asked = fast.asked = 20.0;
    slow.askedSquared = fast.askedSquared = 2.0;
    fast.capturing = 20.0;
    slow.bytes = fast.bytes = 200 * 40 * 30 * 6;
    WorkLeft before = forecast({cameras, projectors, 2, 0.1}, settings, slow, {});
    // A second an exposure, two a shot.
    QVERIFY(std::abs(before.seconds - 2.0 * before.shots) < 1e-6 * before.seconds);
    WorkLeft under = forecast({cameras, projectors, 2, 0.1}, settings, slow, {{}, 0, fast});
    QVERIFY(std::abs(under.seconds - 0.2 * under.shots) < 1e-6 * under.seconds);
    QCOMPARE(before.exposures, 2 * before.shots);
    QVERIFY(before.diskBytes >= static_cast<std::uint64_t>(before.exposures) * 40 * 30 * 6);
    // Dense patterns are computed with as well, the longer the more pixels see them; a benchmark of
    // photographs knows nothing of it.
    AcquisitionSettings dense = settingsOf(AcquisitionMode::multiplexed);
    ShotTimes quick = fast;
    quick.capturing = 0.2;
    const auto denseSeconds = [&](Size camera, const AcquisitionState& state) {
      return forecast({Rasters(camera), projectors, 2, 0.1}, dense, quick, state).seconds;
    };
    const double small = denseSeconds({80, 60}, {}), fourfold = denseSeconds({160, 120}, {});
    QVERIFY2(small > 4.0 && small < 10.0, QByteArray::number(small));
    QVERIFY2(fourfold > 3.0 * small && fourfold < 4.0 * small, QByteArray::number(fourfold));
    // Known to take longer, that counts.
    ShotTimes busy = quick;
    busy.between = 100.0;
    QVERIFY(denseSeconds({80, 60}, {{}, 0, busy}) > 2.0 * small);
    QCOMPARE(denseSeconds({80, 60}, {{}, 1000, quick}), 0.0);
    WorkLeft larger = forecast({Rasters(Size{80, 60}), projectors, 2, 0.1}, settings, slow, {});
    QVERIFY(larger.memoryBytes > before.memoryBytes);
  }
};

QTEST_GUILESS_MAIN(TestForecast)
#include "test_forecast.moc"
