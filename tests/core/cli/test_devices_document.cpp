// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/message.h"
#include "relucent/cli/devices_document.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::cli;
using namespace relucent::devices;

namespace {

CameraList twoCameras() {
  CameraList devices;
  devices.support = {{"genicam", true, Message::plain("cameras of machines")},
                     {"v4l2", false, Message::plain("not built in")}};
  ListedCamera good{"genicam:7", Message::plain("Maker Model"), true};
  good.traits.size = {1024, 768};
  good.traits.format = {SensorLayout::bayerRG, 12};
  good.traits.exposures = {0.0001, 2.0};
  good.traits.triggered = true;
  good.traits.remarks = {Message::plain("claims exposures up to 10 s but reaches only 2 s")};
  devices.cameras = {good,
                     {"v4l2:/dev/video0", Message::plain("Webcam"), false,
                      Message::plain("it is in use; close the other program")}};
  return devices;
}

}  // namespace

class TestDevicesDocument : public QObject {
  Q_OBJECT

 private slots:
  void theDocumentSaysWhatEachCameraCan() {
    const Json document = toJson(twoCameras());
    QCOMPARE(
        QString::fromStdString(document.dump()),
        QString(R"({"support":[{"kind":"genicam","available":true,"sentence":"cameras of machines"},)"
                R"({"kind":"v4l2","available":false,"sentence":"not built in"}],)"
                R"("cameras":[{"address":"genicam:7","model":"Maker Model","usable":true,"size":[1024,768],)"
                R"("format":"BayerRG12","bits":12,"exposures":[0.0001,2.0],"gain":0.0,)"
                R"("software_trigger":true,"remarks":["claims exposures up to 10 s but reaches only 2 s"]},)"
                R"({"address":"v4l2:/dev/video0","model":"Webcam","usable":false,)"
                R"("problem":"it is in use; close the other program"}]})"));
  }

  void theTextSaysTheSame() {
    const std::string text = textOf(twoCameras());
    for (const char* part :
         {"genicam:7  Maker Model\n", "1024x768 pixels of 12 bits (BayerRG12)", "0.0001 s to 2 s",
          "reaches only 2 s", "cannot be used: it is in use; close", "v4l2     no not built in"})
      QVERIFY2(text.find(part) != std::string::npos, part);
  }

  void noCamerasAreNoError() {
    QVERIFY(textOf(CameraList{}).starts_with("No cameras answer."));
    QCOMPARE(toJson(CameraList{}).dump(), std::string(R"({"support":[],"cameras":[]})"));
  }
};

QTEST_GUILESS_MAIN(TestDevicesDocument)
#include "test_devices_document.moc"
