// SPDX-License-Identifier: MIT
// A measurement that fits nothing says so.
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/calibration/results.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stopped_early.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
using namespace relucent::venue;

class TestPoorQuality : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what was measured from two places of the camera, since somebody accepted that, is found to fit
  /// nothing, first of all that is found; it is stored. From one place there is nothing to be said.
  void whatFitsNothingIsFound_data() {
    QTest::addColumn<double>("pixels");
    QTest::addColumn<bool>("isPoor");
    QTest::newRow("left alone") << 0.0 << false;
    QTest::newRow("bumped, and accepted") << 6.0 << true;
  }
  void whatFitsNothingIsFound() {
    QFETCH(double, pixels);
    QFETCH(bool, isPoor);
    QTemporaryDir own;
    VenueSettings venue;
    venue.name = "statue";
    venue.projector = {40, 30};
    venue.camera = {28, 21};
    venue.pathsPerPixel = 32;
    CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 9;
    Progress quiet;
    const SimulatedVenue simulated(venue, {}, quiet);
    auto faults = std::make_shared<FaultSchedule>();
    rig::Rig rig = simulated.rig(faults);
    CalibrationFolder folder = beginCalibration(own.filePath("venue").toStdString(), settings);
    const linearization::Linearization response = measureLinearization(folder, rig, quiet);
    DeviceFault bump;
    bump.kind = FaultKind::shiftedCamera;
    bump.stage = "acquisition";
    bump.first = 30;
    bump.last = 1 << 20;
    bump.amount = pixels;
    if (pixels > 0.0) faults->faults = {bump};
    const auto skips = [](const sentinels::Alarm&) { return sentinels::Answer::skip; };
    const transport::Acquisition measured = measureAcquisition(folder, rig, response, skips, quiet);
    QVERIFY(measured.expected.has_value());
    QVERIFY2(isPoor == transport::isPoor(*measured.expected),
             qPrintable(QString::number(measured.expected->whole)));
    const auto stored = resultFrom<Stage::acquisition>(*folder.latest(Stage::acquisition));
    const bool isSaid =
        !stored.findings.empty() && stored.findings.front().id() == "acquisition.poor-quality";
    QCOMPARE(isSaid, isPoor);
  }
};

QTEST_GUILESS_MAIN(TestPoorQuality)
#include "test_poor_quality.moc"
