// SPDX-License-Identifier: MIT
// What somebody pauses is no part of a measurement's time.
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/stopwatch.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/rig/watched_rig.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
using namespace relucent::venue;
using namespace std::chrono_literals;

namespace {

/// Has paused for an hour once there is a photograph.
class Somebody : public RoomWaiter, public rig::RigWatcher {
 public:
  Answer wait(const FullDisk&) override { return Answer::look; }
  std::chrono::steady_clock::duration otherPauses() const override { return paused_; }
  void photographed(std::size_t, const rig::CaptureRequest&, const rig::RawFrame&) override { paused_ = 1h; }

 private:
  std::chrono::steady_clock::duration paused_{};
};

}  // namespace

class TestPauses : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the time is the clock's less the pauses.
  void pausesAreNoWork() {
    QTemporaryDir folder;
    VenueSettings venue;
    venue.name = "plain";
    venue.projector = {24, 18};
    venue.camera = {20, 16};
    venue.pathsPerPixel = 16;
    CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 5;
    Progress quiet;
    SimulatedVenue simulated(venue, {}, quiet);
    auto somebody = std::make_shared<Somebody>();
    rig::Rig rig = rig::watched(simulated.rig(), somebody);
    CalibrationFolder calibration = beginCalibration(folder.filePath("venue").toStdString(), settings);
    const Stopwatch watch;
    measureLinearization(calibration, rig, somebody.get(), quiet);
    const double seconds =
        resultFrom<Stage::linearization>(*calibration.latest(Stage::linearization)).cost->seconds;
    QVERIFY2(seconds > -3600.0 && seconds < watch.seconds() - 3599.0, qPrintable(QString::number(seconds)));
  }
};

QTEST_APPLESS_MAIN(TestPauses)
#include "test_pauses.moc"
