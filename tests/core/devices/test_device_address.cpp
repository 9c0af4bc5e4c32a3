// SPDX-License-Identifier: MIT
#include <QtTest>

#include "base/error.h"
#include "devices/device_address.h"
#include "devices/device_list.h"
#include "devices/open_camera.h"
#include "devices/video_driver.h"
#include "support/sentences.h"

using namespace relucent;
using Kind = DeviceAddress::Kind;

class TestDeviceAddress : public QObject {
  Q_OBJECT

 private slots:
  void addressesComeAndGo_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("place");
    QTest::newRow("serial") << "genicam:40012345" << static_cast<int>(Kind::genicam) << "40012345";
    QTest::newRow("network") << "genicam:192.168.1.20" << static_cast<int>(Kind::genicam) << "192.168.1.20";
    QTest::newRow("model") << "gphoto2:Canon EOS 80D" << static_cast<int>(Kind::gphoto2) << "Canon EOS 80D";
    QTest::newRow("port") << "gphoto2:usb:001,005" << static_cast<int>(Kind::gphoto2) << "usb:001,005";
    QTest::newRow("path") << "v4l2:/dev/v4l/by-id/usb-x:1-index0" << static_cast<int>(Kind::v4l2)
                          << "/dev/v4l/by-id/usb-x:1-index0";
    QTest::newRow("command") << "command:./shoot {exposure} {output}" << static_cast<int>(Kind::command)
                             << "./shoot {exposure} {output}";
  }
  void addressesComeAndGo() {
    QFETCH(QString, text);
    QFETCH(int, kind);
    QFETCH(QString, place);
    const auto address = deviceAddressFrom(text.toStdString());
    QVERIFY(address.has_value());
    QCOMPARE(static_cast<int>(address->kind), kind);
    QCOMPARE(address->place, place.toStdString());
    QCOMPARE(toString(*address), text.toStdString());
  }

  void everythingElseIsNone() {
    for (const char* text :
         {"", ":", "genicam", "genicam:", "160x120", "usb:7", " genicam:7", "GENICAM:7", "/dev/video0"})
      QVERIFY2(!deviceAddressFrom(text), text);
  }

  void whatIsNotThereIsTold() {
    const std::string video = sentenceOf(
        [] {
          openCamera({Kind::v4l2, "/dev/no-such-video"}, {});
        },
        ErrorKind::device);
    QVERIFY(mentions(video, "v4l2:/dev/no-such-video: no such video device is plugged in"));
    const std::string command = sentenceOf(
        [] {
          openCamera({Kind::command, "shoot"}, {});
        },
        ErrorKind::usage);
    QVERIFY(mentions(command, "the camera's command does not say {exposure}"));
  }

  void aCommandIsOpenedWithTheWishes() {
    const auto camera =
        openCamera({Kind::command, "shoot {exposure} {output}"}, {Size{32, 24}, ExposureRange{0.01, 2.0}});
    QCOMPARE(camera->size(), (Size{32, 24}));
    QCOMPARE(camera->exposures().longest, 2.0);
  }

  void aListTellsWhatIsWrong() {
    const ListedCamera camera = judged(
        "v4l2:/dev/null", "a hole",
        [] { return makeVideoDriver(openCvVideoSource("/dev/null"), "v4l2:/dev/null", std::nullopt); },
        videoPatience());
    QVERIFY(!camera.usable);
    QVERIFY(mentions(camera.problem, "cannot be opened: another program may be using it; check its cable"));
  }
};

QTEST_GUILESS_MAIN(TestDeviceAddress)
#include "test_device_address.moc"
