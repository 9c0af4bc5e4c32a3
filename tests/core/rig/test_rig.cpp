// SPDX-License-Identifier: MIT
#include <QtTest>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/rig/rig.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

class StillProjector : public Projector {
 public:
  explicit StillProjector(Size size) : size_(size) {}
  std::string name() const override { return "still"; }
  Size size() const override { return size_; }
  int bits() const override { return 8; }
  void show(const Image&) override {}

 private:
  Size size_;
};

class NamedCamera : public Camera {
 public:
  explicit NamedCamera(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  Size size() const override { return {4, 3}; }
  ExposureRange exposures() const override { return {0.001, 1.0}; }
  RawFrame capture(const CaptureRequest&) override { return {}; }

 private:
  std::string name_;
};

std::string sentenceOf(const RawFrame& frame, Size size) {
  return relucent::sentenceOf([&] { checkFrame(frame, size, "camera 2"); }, ErrorKind::input);
}

}  // namespace

class TestRig : public QObject {
  Q_OBJECT

 private slots:
  void devicesAreNumberedThrough() {
    Rig rig;
    QCOMPARE(rig.projectorRasters().devices(), std::size_t{0});
    rig.projectors.push_back(std::make_unique<StillProjector>(Size{4, 3}));
    rig.projectors.push_back(std::make_unique<StillProjector>(Size{2, 5}));
    QCOMPARE(rig.projectorRasters(), Rasters({{4, 3}, {2, 5}}));
    QCOMPARE(rig.cameraRasters().count(), std::size_t{0});
  }

  void oneCameraIsNotTwo() {
    Rig rig;
    for (const char* serial : {"genicam:17", "genicam:18", "genicam:17"})
      rig.cameras.push_back(std::make_unique<NamedCamera>(serial));
    const auto sentence = [&] { return relucent::sentenceOf([&] { checkDevices(rig); }, ErrorKind::input); };
    QVERIFY(mentions(sentence(), "cameras 1 and 3 are the same device: both are genicam:17"));
    rig.cameras.pop_back();
    QCOMPARE(sentence(), std::string());
  }

  void aGoodFramePasses() {
    RawFrame frame{Image({4, 3}, 3, 0.5f), 12, 0.1};
    frame.signal.at(0, 0, 0) = -0.01f;  // a black pixel's noise
    frame.signal.at(1, 0, 0) = 1.5f;
    QCOMPARE(sentenceOf(frame, {4, 3}), std::string());
  }

  void aBadFrameIsExplained_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("channels");
    QTest::addColumn<float>("value");
    QTest::addColumn<QString>("part");
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    QTest::newRow("size") << 5 << 3 << 0.0f
                          << "camera 2: the photograph has 5x3 pixels where 4x3 were announced; ";
    QTest::newRow("channels") << 4 << 1 << 0.0f << "has 1 channels; set the camera to colour";
    QTest::newRow("NaN") << 4 << 3 << nan << "holds nan at pixel 2, 1; ";
    QTest::newRow("infinity") << 4 << 3 << inf << "holds inf at pixel 2, 1; ";
  }
  void aBadFrameIsExplained() {
    QFETCH(int, width);
    QFETCH(int, channels);
    QFETCH(float, value);
    QFETCH(QString, part);
    RawFrame frame{Image({width, 3}, channels), 8, 0.1};
    frame.signal.at(2, 1, channels - 1) = value;
    const QString sentence = QString::fromStdString(sentenceOf(frame, {4, 3}));
    QVERIFY2(sentence.contains(part), qPrintable(sentence));
  }
};

QTEST_APPLESS_MAIN(TestRig)
#include "test_rig.moc"
