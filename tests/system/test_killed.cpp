// SPDX-License-Identifier: MIT
// The program is killed at random instants of a calibration and of resuming it, and resumed to the end.
//   RELUCENT_KILLS      how often, a row; RELUCENT_KILL_SEED  of the instants: for those who have more time
#include <sys/stat.h>

#include <QDirIterator>
#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "relucent/base/random.h"
#include "support/sanitized.h"
#include "system/command_venue.h"

using namespace relucent;

namespace {

constexpr int longest = 300'000;
constexpr int killsPerCalibration = 5;

QString tool(const char* name) {
  return QCoreApplication::applicationDirPath() + "/" + name;
}

/// In memory where there is such a place: a thousand synced photographs would time the disk.
QString scratch() {
  QFileInfo memory("/dev/shm");
  return (memory.isDir() && memory.isWritable() ? memory.filePath() : QDir::tempPath()) +
         "/relucent-killed-XXXXXX";
}

/// Of the environment; none: `otherwise`.
int asked(const char* name, int otherwise) {
  bool isGiven = false;
  const int value = qEnvironmentVariableIntValue(name, &isGiven);
  return isGiven ? value : otherwise;
}

QByteArray contentOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QJsonObject manifestOf(const QString& calibration) {
  return QJsonDocument::fromJson(contentOf(calibration + "/calibration.relucent")).object();
}

bool hasResult(const QString& calibration, const char* stage) {
  return manifestOf(calibration)["results"].toObject().contains(stage);
}

int shotsIn(const QString& calibration) {
  return static_cast<int>(QDir(calibration + "/shots").entryList({"*.shot"}, QDir::Files).size());
}

QJsonObject costOf(const QString& calibration, const char* stage) {
  QJsonObject results = manifestOf(calibration)["results"].toObject();
  QJsonObject entry = results[stage].toArray().last().toObject();
  return entry["values"].toObject()["cost"].toObject();
}

/// The manifest without what a clock says.
QJsonObject timeless(QJsonObject manifest) {
  manifest.remove("created");
  QJsonObject results = manifest["results"].toObject();
  for (const QString& stage : results.keys()) {
    QJsonArray entries;
    for (const QJsonValue& value : results[stage].toArray()) {
      QJsonObject entry = value.toObject(), values = entry["values"].toObject();
      QJsonObject cost = values["cost"].toObject();
      cost.remove("seconds");
      values["cost"] = cost;
      values.remove("times");
      entry["values"] = values;
      entry.remove("stored");
      entries.append(entry);
    }
    results[stage] = entries;
  }
  manifest["results"] = results;
  return manifest;
}

/// Every file but the manifest, by its name within the calibration; not when each thing happened, which is
/// for its charts.
std::map<QString, QByteArray> filesOf(const QString& calibration) {
  std::map<QString, QByteArray> files;
  QDirIterator walk(calibration, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories);
  while (walk.hasNext()) {
    QString path = walk.next();
    QString name = path.mid(calibration.size() + 1);
    if (name != "calibration.relucent" && !name.endsWith("/record.json")) files[name] = contentOf(path);
  }
  return files;
}

/// What tells a journalled shot from one that was taken again: a new file is another inode.
std::map<QString, ino_t> shotInodes(const QString& calibration) {
  std::map<QString, ino_t> inodes;
  for (const QString& name : QDir(calibration + "/shots").entryList({"*.shot"}, QDir::Files)) {
    struct stat status{};
    if (::stat((calibration + "/shots/" + name).toLocal8Bit().constData(), &status) == 0)
      inodes[name] = status.st_ino;
  }
  return inodes;
}

/// A calibration on disk and the programs that work on it, one after the other.
class Campaign {
 public:
  Campaign(QString calibration, QStringList calibrate, QStringList resume)
      : calibration_(std::move(calibration)), calibrate_(std::move(calibrate)), resume_(std::move(resume)) {}

  /// Calibrates or, where that has begun, resumes.
  void start(QProcess& program) const {
    bool begun = QFile::exists(calibration_ + "/calibration.relucent");
    program.start(tool("relucent-cli"), begun ? resume_ : calibrate_);
  }

  /// To the end; what it printed on standard error if it failed.
  QByteArray finish() const {
    QProcess program;
    start(program);
    if (!program.waitForFinished(longest)) return "it did not end";
    return program.exitCode() == 0 ? QByteArray() : program.readAllStandardError();
  }

  const QString& calibration() const { return calibration_; }

 private:
  QString calibration_;
  QStringList calibrate_, resume_;
};

/// Kills the program as soon as `reached` says so. False if it ended before.
bool killWhen(QProcess& program, const std::function<bool()>& reached) {
  while (!reached())
    if (program.waitForFinished(1)) return false;
  program.kill();
  program.waitForFinished(longest);
  return program.exitStatus() == QProcess::CrashExit;
}

}  // namespace

class TestKilled : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    if (isSanitized)
      QSKIP(
          "some sixty whole runs of the program take an hour under a sanitizer; what is on disk is the same");
  }

  /// Law: killed anywhere and resumed, however often, a calibration ends in the bits of an undisturbed one.
  void endsInTheSameBits_data() {
    QTest::addColumn<QString>("mode");
    QTest::addColumn<quint64>("seed");
    QTest::addRow("adaptive") << "adaptive" << quint64{1};
    QTest::addRow("sen") << "sen" << quint64{2};
    QTest::addRow("multiplexed") << "multiplexed" << quint64{3};
    QTest::addRow("multiplexed, other instants") << "multiplexed" << quint64{4};
  }
  void endsInTheSameBits() {
    QFETCH(QString, mode);
    QFETCH(quint64, seed);
    const int wantedKills = asked("RELUCENT_KILLS", 15);
    QTemporaryDir folder(scratch());
    auto campaign = [&](int number) {
      QString calibration = folder.filePath(QString::number(number)), cache = folder.filePath("cache");
      return Campaign(calibration,
                      {"calibrate", calibration, "--venue", "corner", "--projector", "24x16", "--camera",
                       "20x16", "--paths", "16", "--acquisition", mode, "--cache", cache},
                      {"resume", calibration, "--cache", cache});
    };
    Campaign undisturbed = campaign(0);
    QElapsedTimer clock;
    clock.start();
    QCOMPARE(undisturbed.finish(), QByteArray());
    qint64 wholeRun = clock.elapsed();
    std::map<QString, QByteArray> expected = filesOf(undisturbed.calibration());
    QJsonObject expectedManifest = timeless(manifestOf(undisturbed.calibration()));
    int allShots = shotsIn(undisturbed.calibration());
    double inverting = 1000.0 * costOf(undisturbed.calibration(), "inverse")["seconds"].toDouble();
    int linearizing = costOf(undisturbed.calibration(), "linearization")["patterns"].toInt();
    QVERIFY(linearizing > 10 && allShots > 3 * linearizing);

    int kills = 0, takenAgain = 0;
    std::map<QString, int> killedIn;
    const auto more = static_cast<std::uint64_t>(asked("RELUCENT_KILL_SEED", 0));
    Random random{20071028 + more, seed};
    for (int number = 1; kills < wantedKills; ++number) {
      QVERIFY2(number <= 4 * wantedKills / killsPerCalibration, "the program hardly ever lives to be killed");
      Campaign disturbed = campaign(number);
      const QString& calibration = disturbed.calibration();
      // Every other instant is a number of shots, 0 being none, or, past the last, some time in the inverse;
      // the others any time of a run, reading the journal included.
      std::vector<double> places;
      for (int i = 0; i < killsPerCalibration; ++i) places.push_back(random.uniform());
      std::sort(places.begin(), places.end());
      for (int i = 0; i < killsPerCalibration && kills < wantedKills; ++i) {
        // The last one of each in the inverse.
        const bool isLast = i + 1 == killsPerCalibration;
        double place = isLast ? 1.0 : places[static_cast<std::size_t>(i)], late = 0.7 * random.uniform();
        std::map<QString, ino_t> before = shotInodes(calibration);
        QProcess program;
        QElapsedTimer running, acquired;
        disturbed.start(program);
        running.start();
        bool killed = killWhen(program, [&] {
          if (i % 2 == 1)
            return static_cast<double>(running.elapsed()) >= place * 0.7 * static_cast<double>(wholeRun);
          // A fifth of the instants in linearization, however few shots it has.
          double shots = place < 0.2 ? 5.0 * place * linearizing
                                     : linearizing + (place - 0.2) / 0.8 * 1.25 * (allShots - linearizing);
          if (shots < allShots) return shotsIn(calibration) >= shots;
          if (!acquired.isValid() && hasResult(calibration, "acquisition")) acquired.start();
          return acquired.isValid() && static_cast<double>(acquired.elapsed()) >= late * inverting;
        });
        for (const auto& [name, inode] : shotInodes(calibration))
          takenAgain += before.contains(name) && before[name] != inode;
        if (!killed) break;
        ++kills;
        ++killedIn[hasResult(calibration, "acquisition")     ? "inverse"
                   : hasResult(calibration, "linearization") ? "acquisition"
                                                             : "linearization"];
      }
      QCOMPARE(disturbed.finish(), QByteArray());
      std::map<QString, QByteArray> got = filesOf(calibration);
      for (const auto& [name, content] : expected)
        QVERIFY2(got.contains(name) && got[name] == content,
                 qPrintable(QString("calibration %1: %2 is not as undisturbed").arg(number).arg(name)));
      QCOMPARE(got.size(), expected.size());
      QCOMPARE(timeless(manifestOf(calibration)), expectedManifest);
      QDir(calibration).removeRecursively();
    }
    qInfo("killed %d times: %d in linearization, %d in acquisition, %d in the inverse", kills,
          killedIn["linearization"], killedIn["acquisition"], killedIn["inverse"]);
    QCOMPARE(takenAgain, 0);
    for (const char* stage : {"linearization", "acquisition", "inverse"})
      QVERIFY2(killedIn[stage] > 0, qPrintable(QString("never killed in %1").arg(stage)));
  }

  /// Law: at most the shot in flight is photographed twice, by the count of whoever stands at the camera.
  void losesAtMostTheShotInFlight() {
    QTemporaryDir folder(scratch());
    QString venue = tool("command-venue"), log = folder.filePath("photographs.log");
    QString calibration = folder.filePath("calibration");
    Campaign campaign(
        calibration,
        {"calibrate", calibration, "--acquisition", "fast", "--levels", "5", "--projector-command",
         "cp {image} " + folder.path() + "/shown.png", "--camera-command",
         "echo {shot} >>" + log + "; " + venue + " photograph " + folder.path() +
             " {exposure} {output} {shot}",
         "--projector",
         QString("%1x%2").arg(test::commandProjector.width).arg(test::commandProjector.height)},
        {"resume", calibration});
    int kills = 0;
    Random random{20071028, 3};
    // The log grows when a photograph begins: that one is in flight.
    for (double begun = 1.0; kills < 6; begun += 1.0 + 15.0 * random.uniform()) {
      QProcess program;
      campaign.start(program);
      QVERIFY2(killWhen(program, [&] { return static_cast<double>(contentOf(log).count('\n')) >= begun; }),
               program.readAllStandardError().constData());
      ++kills;
    }
    QCOMPARE(campaign.finish(), QByteArray());

    std::map<QByteArray, int> photographs;
    for (const QByteArray& name : contentOf(log).split('\n'))
      if (name.startsWith("linearization") || name.startsWith("acquisition")) ++photographs[name];
    std::set<QByteArray> lost;
    for (const auto& [name, times] : photographs)
      if (times > 1) lost.insert(name.left(name.lastIndexOf('-')));
    int exposures = 0;
    for (const char* stage : {"linearization", "acquisition"})
      exposures += costOf(calibration, stage)["exposures"].toInt();
    qInfo("%d kills, %d photographs, %d shots begun again", kills, exposures, static_cast<int>(lost.size()));
    QCOMPARE(static_cast<int>(photographs.size()), exposures);
    QVERIFY(static_cast<int>(lost.size()) <= kills);
    for (const auto& [name, times] : photographs) QVERIFY2(times <= 1 + kills, name.constData());
  }
};

QTEST_GUILESS_MAIN(TestKilled)
#include "test_killed.moc"
