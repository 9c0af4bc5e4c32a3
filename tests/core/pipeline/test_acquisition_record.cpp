// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QTest>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/acquisition_record.h"

using namespace relucent;
using namespace relucent::pipeline;
using namespace relucent::sentinels;

namespace {

constexpr std::array allAlarms{AlarmKind::flicker,     AlarmKind::ambientChanged, AlarmKind::lampChanged,
                               AlarmKind::moved,       AlarmKind::localChange,    AlarmKind::mirroredScreen,
                               AlarmKind::wrongScreen, AlarmKind::coveredLens,    AlarmKind::projectorAsleep};

class Counting : public AcquisitionObserver {
 public:
  void checked(const Reading&) override { ++checks; }
  void takenAgain(const Retake&) override { ++again; }
  void grew(const std::vector<int>&, int) override { ++grown; }
  bool wantsDrafts() const override { return true; }
  int checks = 0, again = 0, grown = 0;
};

void compare(const Reading& a, const Reading& b) {
  QCOMPARE(a.shot, b.shot);
  QCOMPARE(a.roomLight, b.roomLight);
  QCOMPARE(a.roomLightAtFirst, b.roomLightAtFirst);
  QCOMPARE(a.roomLightExpected, b.roomLightExpected);
  QCOMPARE(a.view, b.view);
  QCOMPARE(a.lamp, b.lamp);
  QCOMPARE(a.lampExpected, b.lampExpected);
  QCOMPARE(a.flicker, b.flicker);
  QVERIFY(a.alarm == b.alarm);
}

}  // namespace

class TestAcquisitionRecord : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::filesystem::path path() const { return folder_.path().toStdString(); }

  static AcquisitionRecord record() {
    AcquisitionRecord record{12.5, {3, 12, 40}, {}, {}};
    const Reading steady{1, 0.0012, 0.001, 0.0011, 0.003, 0.99, 1.01, 0.002, {}};
    record.checks.push_back({0.25, steady});
    for (AlarmKind kind : allAlarms) {
      record.checks.push_back({1.0, steady});
      record.checks.back().reading.alarm = kind;
      record.again.push_back({2.0, {7, 3, RetakeReason::alarm, kind}});
    }
    for (RetakeReason reason : {RetakeReason::overexposed, RetakeReason::contradiction})
      record.again.push_back({3.0, {9, 1, reason, {}}});
    return record;
  }

 private slots:
  void init() { std::filesystem::remove(path() / acquisitionRecordName); }

  void whatIsSavedIsLoaded() {
    QVERIFY(!loadAcquisitionRecord(path()));
    const AcquisitionRecord saved = record();
    saveAcquisitionRecord(saved, path());
    const std::optional<AcquisitionRecord> loaded = loadAcquisitionRecord(path());
    QVERIFY(loaded);
    QCOMPARE(loaded->seconds, saved.seconds);
    QCOMPARE(loaded->levels, saved.levels);
    QCOMPARE(loaded->checks.size(), saved.checks.size());
    for (std::size_t i = 0; i < saved.checks.size(); ++i) {
      QCOMPARE(loaded->checks[i].seconds, saved.checks[i].seconds);
      compare(loaded->checks[i].reading, saved.checks[i].reading);
    }
    QCOMPARE(loaded->again.size(), saved.again.size());
    for (std::size_t i = 0; i < saved.again.size(); ++i) {
      QCOMPARE(loaded->again[i].seconds, saved.again[i].seconds);
      const Retake &a = loaded->again[i].retake, &b = saved.again[i].retake;
      QVERIFY(a.shot == b.shot && a.patterns == b.patterns && a.reason == b.reason && a.alarm == b.alarm);
    }
  }

  void whatIsBrokenIsSaid_data() {
    QTest::addColumn<QByteArray>("was");
    QTest::addColumn<QByteArray>("is");
    QTest::newRow("no JSON") << QByteArray("{") << QByteArray("[");
    QTest::newRow("a value missing") << QByteArray("room_light_expected") << QByteArray("other");
    QTest::newRow("an unknown alarm") << QByteArray("covered_lens") << QByteArray("perhaps");
  }
  void whatIsBrokenIsSaid() {
    QFETCH(QByteArray, was);
    QFETCH(QByteArray, is);
    saveAcquisitionRecord(record(), path());
    const std::filesystem::path file = path() / acquisitionRecordName;
    QByteArray json = QByteArray::fromStdString(readFile(file));
    QVERIFY(json.contains(was));
    writeFileAtomically(file, json.replace(was, is).toStdString());
    QVERIFY_EXCEPTION_THROWN(loadAcquisitionRecord(path()), Error);
  }

  /// Law: who looks on is told all the same, and a second session follows the first.
  void sessionsFollowEachOther() {
    Counting other;
    AcquisitionRecord earlier = record();
    RecordingObserver recording(other, earlier);
    QVERIFY(recording.wantsDrafts());
    recording.checked({});
    recording.takenAgain({});
    recording.grew({3, 12, 40, 90}, 31);
    QCOMPARE(other.checks + other.again + other.grown, 3);
    const AcquisitionRecord both = recording.record();
    QCOMPARE(both.checks.size(), earlier.checks.size() + 1);
    QCOMPARE(both.again.size(), earlier.again.size() + 1);
    QVERIFY(both.checks.back().seconds >= earlier.seconds && both.seconds >= both.checks.back().seconds);
    QCOMPARE(both.levels, (std::vector<int>{3, 12, 40, 31}));
  }
};

QTEST_GUILESS_MAIN(TestAcquisitionRecord)
#include "test_acquisition_record.moc"
