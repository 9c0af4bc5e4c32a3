// SPDX-License-Identifier: MIT
// Two poses of a real projector and a real camera, photographed by others, through the whole program.
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <opencv2/imgcodecs.hpp>

#include "support/sanitized.h"

namespace {

/// The middle of each photograph, half as wide and half as high.
void cutOutMiddles(const QString& from, const QString& to) {
  QDir().mkpath(to);
  for (const QString& name : QDir(from).entryList({"*.png"}, QDir::Files)) {
    const cv::Mat whole = cv::imread((from + "/" + name).toStdString(), cv::IMREAD_UNCHANGED);
    QVERIFY2(!whole.empty(), qPrintable(name));
    const cv::Rect middle(whole.cols / 4, whole.rows / 4, whole.cols / 2, whole.rows / 2);
    QVERIFY(cv::imwrite((to + "/" + name).toStdString(), whole(middle)));
  }
}

}  // namespace

class TestImportCaptures : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    if (relucent::isSanitized)
      QSKIP(
          "a real capture takes ten minutes under the address sanitizer; test_import runs the same code "
          "there");
  }
  void predictsWhatItWasNotShown_data() {
    QTest::addColumn<QString>("capture");
    QTest::addColumn<QString>("pixels");  // of the camera that are used
    QTest::addColumn<bool>("isCut");
    QTest::addColumn<double>("gigabytes");  // at most
    // A megapixel takes minutes: of one pose a quarter of what the camera sees, pixel by pixel, of the other
    // all of it.
    QTest::addRow("capture_0, the middle") << "capture_0"
                                           << "all" << true << 0.8;
    QTest::addRow("capture_2, binned") << "capture_2"
                                       << "1/4" << false << 3.0;
  }
  void predictsWhatItWasNotShown() {
    QFETCH(QString, capture);
    QFETCH(QString, pixels);
    QFETCH(bool, isCut);
    QFETCH(double, gigabytes);
    QString data = qEnvironmentVariable("RELUCENT_SHARED_DATA") + "/graycode-captures";
    if (!QFile::exists(data + "/graycode_pattern"))
      QSKIP(qPrintable("the real captures are not here: " + data));
    QTemporaryDir folder;
    QString photographs = data + "/" + capture;
    if (isCut) {
      photographs = folder.filePath("photographs");
      cutOutMiddles(data + "/" + capture, photographs);
    }
    QProcess process;
    process.start(QCoreApplication::applicationDirPath() + "/relucent-cli",
                  {"import", folder.filePath("calibration"), "--patterns", data + "/graycode_pattern",
                   "--photographs", photographs, "--camera-pixels", pixels, "--json"});
    // A minute on a free machine.
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
    qInfo() << document["peak_memory_bytes"].toDouble() << "bytes at most";
    QVERIFY(document["peak_memory_bytes"].toDouble() < 1e9 * gigabytes);
  }
};

QTEST_GUILESS_MAIN(TestImportCaptures)
#include "test_import_captures.moc"
