// SPDX-License-Identifier: MIT
// What people are told of flashing light.
#include "wizard/devices/flash_consent.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/calibrate.h"

using namespace relucent;
using namespace relucent::gui;

class TestFlashConsent : public QObject {
  Q_OBJECT

  SimulatedSession own_;

  /// As if measuring the projector's response had taken so long, pauses and pulled cables included.
  void becomesAsLongAs(double seconds) {
    own_.session.close();
    QFile file(
        QString::fromStdString((own_.path("venue") / calibration::CalibrationFolder::manifestName).string()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QJsonObject manifest = QJsonDocument::fromJson(file.readAll()).object();
    file.close();
    QJsonObject results = manifest["results"].toObject();
    QJsonArray all = results["linearization"].toArray();
    QJsonObject last = all.last().toObject(), values = last["values"].toObject(),
                cost = values["cost"].toObject();
    QVERIFY(cost["exposures"].toDouble() > 0.0);
    cost["seconds"] = seconds;
    values["cost"] = cost;
    last["values"] = values;
    all.replace(all.size() - 1, last);
    results["linearization"] = all;
    manifest["results"] = results;
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QJsonDocument(manifest).toJson());
    file.close();
    own_.session.open(own_.path("venue"));
  }
  double photographs() const {
    return own_.session.figures<calibration::Stage::linearization>()->cost->exposures;
  }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
    own_.session.open(own_.path("venue"));
  }

  void aRateIsSaidThatWasReached_data() {
    QTest::addColumn<double>("changes");  // a second, in the mean
    QTest::addColumn<bool>("isSaid");
    QTest::newRow("quick") << 20.0 << true;
    QTest::newRow("as quick as needs no consent") << 2.9 << false;
    QTest::newRow("held up") << 0.4 << false;
  }
  /// Law: a mean that is small for whatever reason is not said to be how quickly light flashes.
  void aRateIsSaidThatWasReached() {
    QFETCH(double, changes);
    QFETCH(bool, isSaid);
    becomesAsLongAs(photographs() / changes);
    const std::optional<double> said = measuredChanges(own_.session);
    QCOMPARE(said.has_value(), isSaid);
    if (said) QVERIFY(std::abs(*said / changes - 1.0) < 1e-6);
  }
};

QTEST_MAIN(TestFlashConsent)
#include "test_flash_consent.moc"
