// SPDX-License-Identifier: MIT
#include "relucent/engine/step_budget.h"

#include <QtTest>

using namespace relucent;
using namespace relucent::engine;
using namespace std::chrono_literals;

namespace {

/// A machine that takes `fixed` and `step` each, for a number of frames.
void run(StepBudget& budget, std::chrono::duration<double> fixed, std::chrono::duration<double> step,
         int frames) {
  for (int i = 0; i < frames; ++i)
    budget.add({budget.steps(), 0.0, fixed + budget.steps() * step, budget.steps() * step});
}

}  // namespace

class TestStepBudget : public QObject {
  Q_OBJECT

 private slots:
  void takesWhatFits_data() {
    QTest::addColumn<double>("fixed");
    QTest::addColumn<double>("step");
    QTest::addColumn<int>("steps");
    QTest::newRow("no time for any") << 0.032 << 0.010 << 0;
    QTest::newRow("not even without") << 0.100 << 0.010 << 0;
    QTest::newRow("two") << 0.010 << 0.008 << 2;
    QTest::newRow("as many as there are") << 0.001 << 0.001 << 6;
    QTest::newRow("steps dearer than guessed") << 0.010 << 0.100 << 0;
  }
  void takesWhatFits() {
    QFETCH(double, fixed);
    QFETCH(double, step);
    QFETCH(int, steps);
    StepBudget budget(33ms, 6);
    run(budget, std::chrono::duration<double>(fixed), std::chrono::duration<double>(step), 400);
    QCOMPARE(budget.steps(), steps);
  }

  void givesWayAtOnce() {
    StepBudget budget(33ms, 6);
    run(budget, 5ms, 4ms, 400);
    int before = budget.steps();
    QVERIFY(before >= 5);
    run(budget, 20ms, 10ms, 20);
    QVERIFY(budget.steps() <= 1);
    // And comes back only when there has been time for a while.
    run(budget, 5ms, 4ms, 20);
    QVERIFY(budget.steps() <= 1);
    run(budget, 5ms, 4ms, 400);
    QCOMPARE(budget.steps(), before);
  }

  void oneSlowFrameIsNoTrend() {
    StepBudget budget(33ms, 6);
    run(budget, 10ms, 4ms, 400);
    int before = budget.steps();
    run(budget, 14ms, 4ms, 1);
    QCOMPARE(budget.steps(), before);
  }

  void withoutSteps() {
    StepBudget budget(33ms, 0);
    run(budget, 1ms, 0ms, 100);
    QCOMPARE(budget.steps(), 0);
  }
};

QTEST_GUILESS_MAIN(TestStepBudget)
#include "test_step_budget.moc"
