// SPDX-License-Identifier: MIT
#include "relucent/pipeline/kept_windows.h"

#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/file.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stored_settings.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

using Access = CalibrationFolder::Access;

}  // namespace

class TestKeptWindows : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  Progress quiet_;
  fs::path venue_;

  fs::path file() const { return venue_ / "results" / "windows.npz"; }

  /// Whether windows lie there for what is measured, and what a calibration's reader gets, made or read.
  bool areKept() {
    const CalibrationFolder folder = CalibrationFolder::open(venue_, Access::read);
    const MeasuredCalibration measured = loadCalibration(folder, quiet_);
    inverse::WindowSettings settings = settingsOf(folder).windows;
    settings.ridge = measured.ridge;
    const auto made =
        inverse::computeWindows(measured.venue.transport, measured.venue.usable, settings, quiet_);
    if (!(measured.inverse == made)) QTest::qFail("these are other windows", __FILE__, __LINE__);
    if (measured.ridgeCurve.empty()) QTest::qFail("nobody knows how the ridge was found", __FILE__, __LINE__);
    const auto kept = keptWindows(folder, measured.venue, settings);
    if (kept && !(*kept == made)) QTest::qFail("others are kept", __FILE__, __LINE__);
    return kept.has_value();
  }

 private slots:
  void init() {
    venue_ = fs::path(temporary_.filePath(QTest::currentTestFunction()).toStdString());
    venue::VenueSettings venue;
    venue.name = "plain";
    venue.projector = {24, 18};
    venue.camera = {20, 16};
    venue.pathsPerPixel = 16;
    CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 5;
    calibrate(venue_, settings, temporary_.filePath("cache").toStdString(), quiet_);
  }

  /// Law: whoever reads a calibration gets the windows of what was measured, whatever lies beside it.
  void whatIsKeptIsOnlyQuicker() {
    QVERIFY(areKept());
    const std::string whole = readFile(file());
    fs::remove(file());
    QVERIFY(!areKept());
    writeFileAtomically(file(), whole.substr(0, whole.size() / 2));
    QVERIFY(!areKept());
    writeFileAtomically(file(), whole);
    QVERIFY(areKept());
  }

  /// Law: those of another threshold are not taken for these, and these come back when they are chosen again.
  void anotherThreshold() {
    const std::string before = readFile(file());
    const auto threshold = [this](float cut) {
      CalibrationFolder folder = CalibrationFolder::open(venue_, Access::write);
      CalibrateSettings settings = settingsOf(folder);
      settings.threshold.absolute = cut;
      changeSettings(folder, settings);
      return folder;
    };
    {
      CalibrationFolder folder = threshold(0.01f);
      QVERIFY(!keptWindows(folder, loadMeasuredVenue(folder, quiet_), settingsOf(folder).windows));
      measureInverse(folder, loadMeasuredVenue(folder, quiet_), quiet_);
    }
    QVERIFY(areKept());
    QVERIFY(readFile(file()) != before);
    threshold(0.0f);
    QVERIFY(!areKept());
  }

  /// Law: what a killed program left of them goes when the calibration is opened to be written.
  void leftovers() {
    const fs::path part = venue_ / "results" / ".windows.part123.npz";
    writeFileAtomically(part, "half");
    CalibrationFolder::open(venue_, Access::write);
    QVERIFY(!fs::exists(part) && fs::exists(file()));
  }
};

QTEST_GUILESS_MAIN(TestKeptWindows)
#include "test_kept_windows.moc"
