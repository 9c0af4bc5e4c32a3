// SPDX-License-Identifier: MIT
// What people are told of flashing light.
#include "wizard/devices/flash_consent.h"

#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;

class TestFlashConsent : public QObject {
  Q_OBJECT

 private slots:
  void howOftenLightFlashesIsTold_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<std::optional<double>>("told");
    QTest::newRow("quick") << 2.0 << std::optional(20.0);
    QTest::newRow("more than needs no consent") << 10.0 << std::optional(4.0);
    QTest::newRow("as much") << 40.0 / Session::audienceLimit << std::optional<double>();
    QTest::newRow("held up") << 100.0 << std::optional<double>();
  }
  /// Law: it is told by photographs, of which a pattern may have several; and a mean that is small, for
  /// whatever reason, is not said to be how quickly light flashes.
  void howOftenLightFlashesIsTold() {
    QFETCH(double, seconds);
    QFETCH(std::optional<double>, told);
    SimulatedSession own;
    own.begin();
    QVERIFY(!measuredChanges(own.session));
    {
      CalibrationFolder folder =
          CalibrationFolder::open(own.session.path(), CalibrationFolder::Access::write);
      const StageCost cost{.seconds = seconds, .patterns = 10, .exposures = 40};
      storeLinearization(folder, fingerprintOf(folder, Stage::linearization), {}, cost);
    }
    own.session.reload();
    QCOMPARE(measuredChanges(own.session), told);
  }
};

QTEST_MAIN(TestFlashConsent)
#include "test_flash_consent.moc"
