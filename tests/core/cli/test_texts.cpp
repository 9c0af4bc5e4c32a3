// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/cli/texts.h"

using namespace relucent;
using namespace relucent::cli;

class TestTexts : public QObject {
  Q_OBJECT

 private slots:
  void sharesHaveNoMinusZero_data() {
    QTest::addColumn<double>("share");
    QTest::addColumn<QString>("text");
    QTest::newRow("nothing") << 0.0 << "; 0.0 % of the light";
    QTest::newRow("a little too much light") << -1e-5 << "; 0.0 % of the light";
    QTest::newRow("more") << -0.0021 << "; -0.2 % of the light";
    QTest::newRow("less") << 0.0168 << "; 1.7 % of the light";
  }
  void sharesHaveNoMinusZero() {
    QFETCH(double, share);
    QFETCH(QString, text);
    pipeline::CalibrateResult result;
    result.unresolvedEnergy = share;
    QVERIFY2(QString::fromStdString(textOf(result)).contains(text), textOf(result).c_str());
  }

  /// Growth is of the second size on, and of stages that both have.
  void stagesAreListedBySize() {
    pipeline::ScaleBenchResult result;
    result.venue = "corner";
    for (int side : {100, 200}) {
      pipeline::ScaleBenchRun run;
      run.sizes = {{side, side}, {side, side}};
      run.stages = {{"inverse", std::pow(side, 4.0), 2'500'000'000, 1'000'000'000}};
      result.runs.push_back(run);
    }
    const std::string text = textOf(result);
    QVERIFY2(text.find("corner 200x200 / 200x200") != std::string::npos, text.c_str());
    QVERIFY(text.find("2.50") != std::string::npos && text.find("1.00") != std::string::npos);
    const std::size_t growth = text.find("2.00\n");  // of side^4 with side^2 pixels
    QVERIFY(growth != std::string::npos && growth > text.find("corner 200x200"));
  }
};

QTEST_APPLESS_MAIN(TestTexts)
#include "test_texts.moc"
