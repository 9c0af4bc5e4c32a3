// SPDX-License-Identifier: MIT
#include "text/written_times.h"

#include <QtTest>

using namespace relucent::gui;

class TestWrittenTimes : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what is written is read as the same second, in whatever zone it was.
  void whatIsWrittenIsRead_data() {
    QTest::addColumn<int>("hoursFromUtc");
    for (int hours : {-11, -5, 0, 1, 9, 14}) QTest::addRow("%d hours", hours) << hours;
  }
  void whatIsWrittenIsRead() {
    QFETCH(int, hoursFromUtc);
    const QDateTime time(QDate(2026, 12, 31), QTime(23, 30, 15, 400), Qt::OffsetFromUTC, 3600 * hoursFromUtc);
    const std::string text = written(time);
    QCOMPARE(text.back(), 'Z');
    QCOMPARE(timeWritten(text).toSecsSinceEpoch(), time.toSecsSinceEpoch());
    QCOMPARE(written(timeWritten(text)), text);
  }

  void whatIsNoTimeIsNone_data() {
    QTest::addColumn<QString>("text");
    for (const char* text : {"", "yesterday", "2026-13-01T00:00:00Z", "2026-02-30T12:00:00Z"})
      QTest::addRow("\"%s\"", text) << QString(text);
  }
  void whatIsNoTimeIsNone() {
    QFETCH(QString, text);
    QVERIFY(!timeWritten(text.toStdString()).isValid());
  }
};

QTEST_GUILESS_MAIN(TestWrittenTimes)
#include "test_written_times.moc"
