// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QTest>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/drift_record.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::pipeline;

class TestDriftRecord : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::filesystem::path path() const { return folder_.filePath("verification").toStdString(); }

 private slots:
  void whatIsSavedIsLoaded() {
    QVERIFY(!loadDriftRecord(path()));
    for (Verdict verdict : {Verdict::stillGood, Verdict::remeasure, Verdict::startAgain}) {
      saveDriftRecord({"2026-01-02T03:04:05Z", "2026-01-01T00:00:00Z", verdict, 0.041, 0.03, 0.002}, path());
      const std::optional<DriftRecord> loaded = loadDriftRecord(path());
      QVERIFY(loaded);
      QCOMPARE(loaded->checked, std::string("2026-01-02T03:04:05Z"));
      QCOMPARE(loaded->measurement, std::string("2026-01-01T00:00:00Z"));
      QVERIFY(loaded->verdict == verdict);
      QCOMPARE(loaded->error, 0.041);
      QCOMPARE(loaded->errorThen, 0.03);
      QCOMPARE(loaded->changedShare, 0.002);
    }
  }

  void whatIsBrokenIsSaid_data() {
    QTest::addColumn<QByteArray>("was");
    QTest::addColumn<QByteArray>("is");
    QTest::newRow("no JSON") << QByteArray("{") << QByteArray("[");
    QTest::newRow("a value missing") << QByteArray("changed_share") << QByteArray("other");
    QTest::newRow("an unknown verdict") << QByteArray("still_good") << QByteArray("perhaps");
  }
  void whatIsBrokenIsSaid() {
    QFETCH(QByteArray, was);
    QFETCH(QByteArray, is);
    saveDriftRecord({}, path());
    const std::filesystem::path file = path() / "drift.json";
    QByteArray json = QByteArray::fromStdString(readFile(file));
    QVERIFY(json.contains(was));
    writeFileAtomically(file, json.replace(was, is).toStdString());
    QVERIFY_EXCEPTION_THROWN(loadDriftRecord(path()), Error);
  }
};

QTEST_GUILESS_MAIN(TestDriftRecord)
#include "test_drift_record.moc"
