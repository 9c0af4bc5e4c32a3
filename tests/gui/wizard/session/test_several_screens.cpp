// SPDX-License-Identifier: MIT
// Which camera sees which projector is found out when the devices are opened.
#include <QImage>
#include <QTemporaryDir>
#include <QtConcurrent>
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/base/message.h"
#include "relucent/pipeline/screen_devices.h"
#include "wizard/session/session.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::pipeline;

namespace {

constexpr int side = 16;

/// A projector whose light is a file, for cameras to copy.
class FileScreen : public devices::ScreenProjector {
 public:
  FileScreen(std::string name, QString file) : name_(std::move(name)), file_(std::move(file)) {}
  std::string name() const override { return name_; }
  Size size() const override { return {side, side}; }
  int bits() const override { return 8; }
  void show(const image::Image& drive) override {
    QImage light(side, side, QImage::Format_RGB32);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int grey = static_cast<int>(120.0f * drive.at(x, y, 0)) + 5;
        light.setPixel(x, y, qRgb(grey, grey, grey));
      }
    light.save(file_, "PNG");
  }
  bool stayedVisible() override { return true; }
  void rest() override {}

 private:
  std::string name_;
  QString file_;
};

}  // namespace

class TestSeveralScreens : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  QString lightOf(const std::string& screen) const {
    return folder_.filePath(QString::fromStdString(screen) + ".png");
  }
  /// What opening says where the cameras see these screens; empty: it opens.
  QString said(const QStringList& seen) {
    ScreenRigSettings rig{{"A", "", "", ""}, {side, side}, 1000.0};
    rig.moreScreens = {{{"B", "", "", ""}, {side, side}, 1000.0}};
    std::vector<ScreenRigSettings::Camera> cameras;
    for (qsizetype i = 0; i < seen.size(); ++i)
      cameras.push_back(
          {QString("command:cp %1 $(dirname {output})/$(basename {output} .exr).png # {exposure} %2")
               .arg(lightOf(seen[i].toStdString()))
               .arg(i)
               .toStdString()});
    QImage dark(side, side, QImage::Format_RGB32);
    dark.fill(qRgb(5, 5, 5));
    for (const char* screen : {"A", "B", "none"}) dark.save(lightOf(screen), "PNG");
    const auto live = std::make_shared<LiveRig>();
    SessionDevices devices(
        withCameras(rig, cameras), {}, live,
        [this](const ScreenRigSettings& screen) {
          return std::make_unique<FileScreen>(screen.display.connector, lightOf(screen.display.connector));
        },
        {2, 4}, nullptr, pipeline::ProjectorWarmUp({}, rig));
    const QFuture<QString> answer = QtConcurrent::run([&devices]() -> QString {
      try {
        Progress quiet;
        devices.open(quiet);
        return {};
      } catch (const Error& error) {
        return QString::fromStdString(english(error.summary()));
      }
    });
    constexpr int patience = 120'000;
    if (!QTest::qWaitFor([&answer] { return answer.isFinished(); }, patience)) return "it takes too long";
    return answer.result();
  }

 private slots:
  /// Law: every camera sees a projector and every projector is seen, whichever sees which; else the one that
  /// does not, or is not, is named.
  void eachIsSeenAndSees_data() {
    QTest::addColumn<QStringList>("seen");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("each its own") << QStringList{"A", "B"} << QString();
    QTest::newRow("the other way round") << QStringList{"B", "A"} << QString();
    QTest::newRow("a camera in the dark") << QStringList{"A", "none"} << QString("does not see");
    QTest::newRow("a projector that nobody sees")
        << QStringList{"A", "A"} << QString("no camera sees what is shown on B");
  }
  void eachIsSeenAndSees() {
    QFETCH(QStringList, seen);
    QFETCH(QString, sentence);
    const QString told = said(seen);
    QVERIFY2(sentence.isEmpty() ? told.isEmpty() : told.contains(sentence), qPrintable(told));
  }
};

QTEST_MAIN(TestSeveralScreens)
#include "test_several_screens.moc"
