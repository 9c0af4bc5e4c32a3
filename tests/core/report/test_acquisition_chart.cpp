// SPDX-License-Identifier: MIT
#include <QXmlStreamReader>
#include <QtTest>

#include "relucent/report/acquisition_chart.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::pipeline;

class TestAcquisitionChart : public QObject {
  Q_OBJECT

  static AcquisitionBenchRun run(const std::string& venue, AcquisitionMode mode, double threshold,
                                 int exposures, double refined) {
    AcquisitionBenchRun run;
    run.venue = venue;
    run.mode = mode;
    run.threshold = threshold;
    run.exposures = exposures;
    run.refined = refined;
    return run;
  }

 private slots:
  void everyModeIsACurveOfItsThresholds() {
    AcquisitionBenchResult result;
    for (const std::string& venue : {std::string("corner"), std::string("plain")}) {
      result.runs.push_back(run(venue, AcquisitionMode::multiplexed, 0.05, 150, 30.0));
      result.runs.push_back(run(venue, AcquisitionMode::multiplexed, 0.012, 200, 31.0));
      result.runs.push_back(run(venue, AcquisitionMode::adaptive, 0.008, 4000, 31.5));
    }
    result.runs.push_back(run("corner", AcquisitionMode::sen, 0.02, 9000, 31.0));  // not in the other venue
    QString svg = QString::fromStdString(report::acquisitionChart(result));
    QXmlStreamReader xml(svg);
    while (!xml.atEnd()) xml.readNext();
    QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
    QVERIFY(svg.contains("multiplexed") && svg.contains("adaptive") && !svg.contains("sen<"));
    QCOMPARE(svg.count("<path"), 2);
  }

  void nothingMeasuredIsAnEmptyChart() {
    QString svg = QString::fromStdString(report::acquisitionChart({}));
    QXmlStreamReader xml(svg);
    while (!xml.atEnd()) xml.readNext();
    QVERIFY(!xml.hasError());
  }
};

QTEST_APPLESS_MAIN(TestAcquisitionChart)
#include "test_acquisition_chart.moc"
