// SPDX-License-Identifier: MIT
// Two days of a venue, by both programs: power, input and night.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

class TestRehearseDay : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  static constexpr int patience = 120'000;  // ms

  QString path(const QString& name) const { return folder_.filePath(name); }
  struct Ran {
    int status = -1;
    QByteArray said, errors;
    QJsonObject document() const { return QJsonDocument::fromJson(said).object(); }
  };
  Ran run(const QStringList& arguments) const {
    QProcess process;
    process.start(QCoreApplication::applicationDirPath() + "/relucent-cli", arguments);
    if (!process.waitForFinished(patience)) return {};
    return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
  }
  static QStringList happened(const QJsonValue& day) {
    QStringList names;
    for (const QJsonValue one : day["happened"].toArray()) names.append(one["what"].toString());
    return names;
  }

 private slots:
  void initTestCase() {
    const Ran measured = run({"calibrate", path("venue"), "--venue", "corner", "--projector", "32x24",
                              "--camera", "24x18", "--cache", path("cache")});
    QVERIFY2(measured.status == 0, measured.errors);
  }

  /// The show lasts them all: hours, a live picture that is lost, a power failure, a still that is gone, a
  /// projector that leaves the network, two nights.
  void twoDaysOfAVenue() {
    const Ran ran = run({"rehearse-day", path("venue"), "--days", "2", "--day-seconds", "1", "--out",
                         path("rehearsal"), "--cache", path("cache"), "--json"});
    QVERIFY2(ran.status == 0, ran.said + ran.errors);
    const QJsonObject result = ran.document();
    QVERIFY(result["held"].toBool());
    const QJsonArray days = result["days"].toArray();
    QCOMPARE(days.size(), 2);
    QCOMPARE(happened(days[0]), (QStringList{"opening", "input-lost", "power-failure", "closing", "night"}));
    QCOMPARE(happened(days[1]), (QStringList{"opening", "still-gone", "projector-gone", "closing", "night"}));
    for (const QJsonValue day : days) {
      QVERIFY(day["night"].toString().startsWith("nothing-to-do"));
      QVERIFY(day["resident_bytes"].toDouble() > 1e7 && day["handles"].toInt() > 3 &&
              day["threads"].toInt() > 1);
    }
    // Nobody takes it for a show's, and the calibration's own nights are none of these.
    QFile log(path("rehearsal/log/show.log"));
    QVERIFY(log.open(QIODevice::ReadOnly));
    for (const QByteArray& line : log.readAll().split('\n'))
      QVERIFY2(line.isEmpty() || line.contains(" rehearsal 2026-05-"), line);
    QFile health(path("rehearsal/log/health.json"));
    QVERIFY(health.open(QIODevice::ReadOnly));
    QVERIFY(QJsonDocument::fromJson(health.readAll())["rehearsal"].isObject());
    QVERIFY(QFile::exists(path("rehearsal/calibration/nights.jsonl")));
    QVERIFY(!QFile::exists(path("venue/nights.jsonl")));
  }

  /// Something that ends instead of showing is no venue's day.
  void aShowThatEndsIsFound() {
    const Ran ran = run({"rehearse-day", path("venue"), "--days", "3", "--program", "/bin/false", "--out",
                         path("false"), "--cache", path("cache"), "--json"});
    QCOMPARE(ran.status, 3);
    QCOMPARE(ran.document()["days"].toArray().size(), 1);
    QVERIFY(ran.document()["days"][0]["happened"][0]["missed"].toString().contains("ended by itself"));
  }

  void refusesWithOneSentence_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("part");
    QTest::newRow("no calibration") << QStringList{"/nowhere"} << "/nowhere";
    QTest::newRow("no days") << QStringList{"VENUE", "--days", "0"} << "1 to 1000";
    QTest::newRow("no program") << QStringList{"VENUE", "--program", "/nowhere/relucent"} << "--program";
    QTest::newRow("a folder in use") << QStringList{"VENUE", "--out", "REHEARSAL"} << "--out";
  }
  void refusesWithOneSentence() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, part);
    arguments.replaceInStrings("VENUE", path("venue"));
    arguments.replaceInStrings("REHEARSAL", path("rehearsal"));
    if (!arguments.contains("--out")) arguments << "--out" << path("other");
    const Ran ran = run(QStringList{"rehearse-day"} + arguments);
    QVERIFY2(ran.status == 1 && ran.errors.contains(part.toUtf8()), ran.errors);
  }
};

QTEST_GUILESS_MAIN(TestRehearseDay)
#include "test_rehearse_day.moc"
