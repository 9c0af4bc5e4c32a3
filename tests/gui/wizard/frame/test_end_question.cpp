// SPDX-License-Identifier: MIT
// What another venue or the end of the program would end, and that nothing ends by the way.
#include "wizard/frame/end_question.h"

#include <QTemporaryDir>
#include <QtTest>

#include "wizard/frame/failure_dialog.h"

using namespace relucent;
using namespace relucent::gui;

class TestEndQuestion : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what is under way is named, and ends by an answer only.
  void whatWouldEndIsAskedAbout_data() {
    QTest::addColumn<bool>("measures");
    QTest::addColumn<bool>("plays");
    QTest::addColumn<QString>("heading");
    QTest::newRow("nothing") << false << false << QString();
    QTest::newRow("a measurement") << true << false << "A measurement is under way";
    QTest::newRow("a show") << false << true << "A show is playing";
    QTest::newRow("both") << true << true << "A measurement and a show are under way";
  }
  void whatWouldEndIsAskedAbout() {
    QFETCH(bool, measures);
    QFETCH(bool, plays);
    QFETCH(QString, heading);
    Session session{std::filesystem::path()};
    DeviceLease lease;
    const StepName step{"acquire", "", "Acquire"};
    if (measures) lease = session.leaseDevices(step, DeviceWork::measurement);
    session.setShowing(plays);
    EndQuestion question(session);
    QCOMPARE(question.isNeeded(), measures || plays);
    for (bool agrees : {false, true}) {
      int ended = 0;
      std::optional<FailureReport> asked;
      question.whenNothingEnds([&ended] { ++ended; },
                               [&asked](const FailureReport& report) { asked = report; });
      if (heading.isEmpty()) {
        QVERIFY(!asked);
        QCOMPARE(ended, 1);
        continue;
      }
      QCOMPARE(ended, 0);
      QVERIFY(asked && asked->isQuestion && asked->endsWork && !asked->safe.isEmpty());
      QCOMPARE(asked->failure.heading, heading);
      QCOMPARE(asked->failure.what.contains("Acquire"), measures);
      QCOMPARE(asked->failure.what.contains("show"), plays);
      (agrees ? asked->goOn : asked->resume)->trigger();
      QCOMPARE(ended, agrees ? 1 : 0);
      // An answer is for one question.
      asked->goOn->trigger();
      QCOMPARE(ended, agrees ? 1 : 0);
    }
  }

  /// Law: a question outlives what it asks about by nothing; what was to be done afterwards is not done.
  void whatHasEndedIsNotAskedAbout_data() {
    QTest::addColumn<bool>("measures");
    QTest::newRow("a measurement") << true;
    QTest::newRow("a show") << false;
  }
  void whatHasEndedIsNotAskedAbout() {
    QFETCH(bool, measures);
    Session session{std::filesystem::path()};
    DeviceLease lease;
    const StepName step{"acquire", "", "Acquire"};
    if (measures) lease = session.leaseDevices(step, DeviceWork::measurement);
    session.setShowing(!measures);
    EndQuestion question(session);
    int ended = 0;
    std::unique_ptr<FailureDialog> dialog;
    PageCommand* agree = nullptr;
    question.whenNothingEnds([&ended] { ++ended; },
                             [&](const FailureReport& report) {
                               agree = report.goOn;
                               dialog = std::make_unique<FailureDialog>(report, "Acquire");
                               dialog->show();
                             });
    QVERIFY(dialog && dialog->isVisible());
    // What has nothing to do with it changes nothing.
    Q_EMIT session.devicesChanged();
    QVERIFY(dialog->isVisible());
    if (measures)
      lease.release();
    else
      session.setShowing(false);
    QTRY_VERIFY(!dialog->isVisible());
    agree->trigger();
    QCOMPARE(ended, 0);
  }

  /// Law: devices that are borrowed for a moment are nobody's measurement.
  void briefWorkIsNotAskedAbout() {
    Session session{std::filesystem::path()};
    const DeviceLease lease = session.leaseDevices({"camera", "", "Camera"}, DeviceWork::brief);
    QVERIFY(!EndQuestion(session).isNeeded());
  }
};

QTEST_MAIN(TestEndQuestion)
#include "test_end_question.moc"
