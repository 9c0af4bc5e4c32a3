// SPDX-License-Identifier: MIT
// The whole calibration through external commands: real processes, real files.
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <cstdlib>

#include "relucent/image/picture_files.h"
#include "relucent/transport/difference.h"
#include "relucent/transport/files.h"
#include "support/sanitized.h"
#include "system/command_venue.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

// A thousand processes: half a minute on a free machine, several on a busy one with sanitizers.
constexpr int longest = 560'000;

QString tool(const char* name) {
  // The test's own folder holds all programs of the build.
  return QCoreApplication::applicationDirPath() + "/" + name;
}

struct Run {
  int status;
  QByteArray output;
  QByteArray errors;
};

Run run(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.start(program, arguments);
  bool finished = process.waitForFinished(longest);
  if (!finished) process.kill();
  return {finished ? process.exitCode() : -1, process.readAllStandardOutput(),
          process.readAllStandardError()};
}

Run runCli(const QStringList& arguments) {
  return run(tool("relucent-cli"), arguments);
}

}  // namespace

class TestCommands : public QObject {
  Q_OBJECT

  QTemporaryDir home_;

 private slots:
  /// What is agreed to here is nothing that the user of this computer agreed to.
  void init() { qputenv("XDG_DATA_HOME", home_.path().toUtf8()); }

  void calibratesAndCompensates() {
    QTemporaryDir folder;
    QString venue = tool("command-venue");
    QString calibration = folder.filePath("calibration");
    Run calibrated = runCli(
        {"calibrate", calibration, "--projector-command", "cp {image} " + folder.path() + "/shown.png",
         "--camera-command", venue + " photograph " + folder.path() + " {exposure} {output} {shot}",
         "--projector", QString("%1x%2").arg(test::commandProjector.width).arg(test::commandProjector.height),
         "--json"});
    QVERIFY2(calibrated.status == 0, calibrated.errors.constData());
    QVERIFY2(calibrated.output.contains("\"leaves\""), calibrated.output.constData());

    QString leaves = folder.filePath("leaves.npz");
    Run exported = runCli({"export", calibration, "--leaves", leaves});
    QVERIFY2(exported.status == 0, exported.errors.constData());
    TransportMatrix measured = loadTransport(leaves.toStdString());
    test::ScriptedVenue truth = test::commandVenue();
    // Threshold 0.8 % of a row and photographs of 12 bits with 0.1 % read noise leave a few percent; a
    // broken step of the chain leaves tens of percent.
    double error = difference(measured, truth.transport()).frobenius;
    QVERIFY2(error < 0.08, qPrintable(QString::number(error)));

    const QString players = folder.filePath("players");
    Run mapped = runCli({"export", calibration, "--mpcdi", folder.filePath("venue.mpcdi"), "--player-maps",
                         players, "--canvas", "64x48"});
    QVERIFY2(mapped.status == 0, mapped.errors.constData());
    QVERIFY2(mapped.output.contains(" dB, Relucent with "), mapped.output.constData());
    for (const char* file :
         {"venue.mpcdi", "players/st-1.exr", "players/mask-1.png", "players/response-1.cube"})
      QVERIFY2(QFileInfo(folder.filePath(file)).size() > 0, file);

    QString matrix = folder.filePath("T.npz");
    Run written = runCli({"export", calibration, "--transport", matrix});
    QVERIFY2(written.status == 0, written.errors.constData());
    if (run("/usr/bin/python3", {"-I", "-c", "import scipy.sparse"}).status != 0)
      QSKIP("python3-scipy is not installed: nobody to open the exported matrix");
    Run predicted =
        run("/usr/bin/python3",
            {QString(RELUCENT_SYSTEM_TESTS) + "/predict_photograph.py", matrix, venue, folder.path(),
             QString::number(test::commandProjector.width), QString::number(test::commandProjector.height)});
    qInfo("%s", predicted.output.constData());
    QVERIFY2(predicted.status == 0, predicted.errors.constData());
  }

  /// A simulated venue: perfected, gone on with, forgotten; a picture that is missing is told of.
  void perfectsPictures() {
    QTemporaryDir folder;
    const QString calibration = folder.filePath("calibration"), cache = folder.filePath("cache"),
                  picture = folder.filePath("picture.png");
    image::Image waves({64, 36}, 3);
    for (int y = 0; y < waves.height(); ++y)
      for (int x = 0; x < waves.width(); ++x)
        for (int c = 0; c < 3; ++c)
          waves.at(x, y, c) = static_cast<float>(0.5 + 0.3 * std::sin(0.1 * (c + 1) * x) * std::cos(0.2 * y));
    image::writePng(picture.toStdString(), waves, 8);
    const Run calibrated = runCli({"calibrate", calibration, "--venue", "glass", "--projector", "40x30",
                                   "--camera", "28x21", "--cache", cache});
    QVERIFY2(calibrated.status == 0, calibrated.errors.constData());
    const auto perfect = [&](const QString& content) {
      return runCli({"perfect", calibration, "--content", content, "--cache", cache, "--json"});
    };
    const Run first = perfect(picture);
    QVERIFY2(first.status == 0, first.errors.constData());
    const QJsonObject found = QJsonDocument::fromJson(first.output).object()["images"][0].toObject();
    QVERIFY2(found["kept"].toBool() && !found["went_on"].toBool(), first.output.constData());
    QVERIFY(found["after"]["error"].toDouble() < found["before"]["error"].toDouble());
    const Run second = perfect(picture);
    QVERIFY2(second.output.contains("\"went_on\": true"), second.output.constData());
    const Run missing = perfect(folder.filePath("missing.png"));
    QCOMPARE(missing.status, 1);
    QVERIFY2(missing.output.contains("missing.png"), missing.output.constData());
    const Run forgotten = runCli({"perfect", calibration, "--forget"});
    QVERIFY2(forgotten.status == 0 && forgotten.output.contains("picture.png"), forgotten.output.constData());
  }

  /// Two projectors and two cameras, each by a script and of another size; what is measured of them is
  /// compensated and proved by the same scripts.
  void severalProjectorsAndCameras() {
    if (isSanitized)
      QSKIP("programs start by the hundred, each with a sanitizer: one projector and camera do that already");
    QTemporaryDir folder;
    const QString calibration = folder.filePath("calibration");
    QStringList arguments{"calibrate", calibration, "--levels", "9"};
    for (const char* number : {"0", "1"})
      arguments << "--projector-command"
                << "cp {image} " + folder.path() + "/shown-" + number + ".png" << "--camera-command"
                << tool("command-venue") + " photograph-several " + folder.path() +
                       " {exposure} {output} {shot} " + number;
    arguments << "--projector"
              << "16x12"
              << "--projector"
              << "12x16";
    const Run calibrated = runCli(arguments);
    QVERIFY2(calibrated.status == 0, calibrated.errors.constData());

    const QString leaves = folder.filePath("leaves.npz");
    const Run exported = runCli({"export", calibration, "--leaves", leaves});
    QVERIFY2(exported.status == 0, exported.errors.constData());
    const TransportMatrix measured = loadTransport(leaves.toStdString());
    QVERIFY((measured.projectors().sizes() == std::vector{test::commandProjector, test::secondProjector}));
    QVERIFY((measured.cameras().sizes() == std::vector{test::commandCamera, test::secondCamera}));
    // As above; every pixel has the light of two projectors, and the threshold is a share of both.
    const double error = difference(measured, test::commandVenue(true).transport()).frobenius;
    QVERIFY2(error < 0.12, qPrintable(QString::number(error)));

    image::writePng(folder.filePath("grey.png").toStdString(), image::Image(Size{16, 12}, 3, 0.5f), 8);
    // Somebody else's computer: none of its programs runs before he agrees, once.
    qputenv("XDG_DATA_HOME", folder.filePath("stranger").toUtf8());
    QStringList prove{
        "prove", calibration, "--image", folder.filePath("grey.png"), "--out", folder.filePath("proof"),
        "--json"};
    QFile::remove(folder.filePath("shown-0.png"));
    const Run refused = runCli(prove);
    QCOMPARE(refused.status, 2);
    QVERIFY2(refused.errors.contains("nobody at this computer has agreed: cp {image} "),
             refused.errors.constData());
    QVERIFY(refused.errors.contains("--allow-commands") && !QFile::exists(folder.filePath("shown-0.png")));
    const Run proved = runCli(prove + QStringList{"--allow-commands"});
    QVERIFY2(proved.status == 0, proved.errors.constData());
    QVERIFY2(QFileInfo(folder.filePath("proof/target-2.png")).size() > 0, proved.output.constData());
  }

  void failingCommandIsOneSentence() {
    QTemporaryDir folder;
    Run failed = runCli({"calibrate", folder.filePath("calibration"), "--projector-command", "true {image}",
                         "--camera-command", "echo the lens cap is on >&2; false {exposure} {output}",
                         "--projector", "16x12"});
    QCOMPARE(failed.status, 1);
    QVERIFY2(failed.errors.contains("the lens cap is on"), failed.errors.constData());
  }

  /// Law: with little memory it is refused beforehand or done, never killed.
  void littleMemoryIsRefusedOrEnough_data() {
    QTest::addColumn<int>("megabytes");
    QTest::addColumn<QString>("pixels");
    for (int megabytes : {700, 1000, 1400})
      for (const char* pixels : {"auto", "all"})
        QTest::addRow("%d MB, %s", megabytes, pixels) << megabytes << pixels;
  }
  void littleMemoryIsRefusedOrEnough() {
    if (isSanitized) QSKIP("sanitizers map more than any limit");
    QFETCH(int, megabytes);
    QFETCH(QString, pixels);
    QTemporaryDir folder;
    const QString calibrate =
        QString(
            "ulimit -v %1 && exec \"$0\" calibrate \"$1\" --venue plain --projector 48x36 --camera 400x300 "
            "--paths 8 --levels 9 --camera-pixels %2 --cache \"$2\"")
            .arg(1000 * megabytes)
            .arg(pixels);
    const Run limited = run("/bin/bash", {"-c", calibrate, tool("relucent-cli"), folder.filePath("venue"),
                                          folder.filePath("cache")});
    const bool isRefused = limited.status == 1 && limited.errors.contains("GB of memory, and");
    qInfo("%s", isRefused ? "refused" : "done");
    QVERIFY2(limited.status == 0 || isRefused, limited.errors.constData());
    if (isRefused) QVERIFY(QDir(folder.filePath("venue/shots")).isEmpty());
  }
};

QTEST_GUILESS_MAIN(TestCommands)
#include "test_commands.moc"
