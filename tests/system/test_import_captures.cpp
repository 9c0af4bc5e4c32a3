// SPDX-License-Identifier: MIT
// Two poses of a real projector and a real camera, photographed by others, through the whole program.
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

class TestImportCaptures : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
#ifdef __SANITIZE_ADDRESS__
    QSKIP(
        "a real capture takes ten minutes under the address sanitizer; test_import runs the same code there");
#endif
  }
  void predictsWhatItWasNotShown_data() {
    QTest::addColumn<QString>("capture");
    QTest::addColumn<QString>("pixels");  // of the camera that are used
    QTest::addRow("capture_0") << "capture_0"
                               << "all";
    QTest::addRow("capture_2, binned") << "capture_2"
                                       << "1/4";
  }
  void predictsWhatItWasNotShown() {
    QFETCH(QString, capture);
    QFETCH(QString, pixels);
    QString data = qEnvironmentVariable("RELUCENT_SHARED_DATA") + "/graycode-captures";
    if (!QFile::exists(data + "/graycode_pattern"))
      QSKIP(qPrintable("the real captures are not here: " + data));
    QTemporaryDir folder;
    QProcess process;
    process.start(QCoreApplication::applicationDirPath() + "/relucent-cli",
                  {"import", folder.filePath("calibration"), "--patterns", data + "/graycode_pattern",
                   "--photographs", data + "/" + capture, "--camera-pixels", pixels, "--json"});
    // A minute or two on a free machine.
    QVERIFY(process.waitForFinished(1'500'000));
    QVERIFY2(process.exitCode() == 0, process.readAllStandardError().constData());
    QJsonObject document = QJsonDocument::fromJson(process.readAllStandardOutput()).object();
    QJsonObject nrmse = document["nrmse"].toObject();
    QCOMPARE(document["patterns"].toInt(), 42);
    QCOMPARE(document["fitted"].toInt() + document["held_out"].toInt(), 42);
    // A Gray code can spare its finest stripes alone, across and down, with their negatives.
    QCOMPARE(document["held_out"].toInt(), 4);
    double ratio = nrmse["transport"].toDouble() / nrmse["one_to_one"].toDouble();
    qInfo() << "transport" << nrmse["transport"].toDouble() << "of one to one"
            << nrmse["one_to_one"].toDouble();
    // The product's promise, for stripes of which no phase was fitted.
    QVERIFY2(ratio < 0.6, qPrintable(QString::number(ratio)));
    QVERIFY(document["peak_memory_bytes"].toDouble() < 3.0e9);
  }
};

QTEST_GUILESS_MAIN(TestImportCaptures)
#include "test_import_captures.moc"
