// SPDX-License-Identifier: MIT
#include <QtTest>
#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/video/video_driver.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::rig;

namespace {

/// A camera that is black whatever it looks at.
class DarkCamera : public Camera {
 public:
  DarkCamera(std::string place, Size size) : place_(std::move(place)), size_(size) {}
  std::string name() const override { return "dark:" + place_; }
  Size size() const override { return size_; }
  ExposureRange exposures() const override { return {}; }
  RawFrame capture(const CaptureRequest&) override { return {}; }

 private:
  std::string place_;
  Size size_;
};

CameraKind darkKind() {
  return {.prefix = "dark",
          .place = "ROOM",
          .help = "a camera in the dark",
          .support = Message::plain("cameras in the dark"),
          .open =
              [](const std::string& place, const CameraWishes& wishes) {
                return std::make_unique<DarkCamera>(place, wishes.size.value_or(Size{8, 6}));
              },
          .list = [] { return std::vector<ListedCamera>{{"dark:cellar", Message::plain("Dark"), true}}; },
          .devices =
              [](std::vector<std::string> places) {
                std::ranges::replace(places, "under the stairs", "cellar");
                return places;
              }};
}

/// One that this build lacks: it is there, says so, and cannot be listed.
CameraKind missingKind() {
  return {.prefix = "light",
          .place = "LAMP",
          .help = "a camera in the light; not in this build",
          .support = Message::plain("cameras in the light: this build lacks them"),
          .isBuiltIn = false,
          .open = [](const std::string&, const CameraWishes&) -> std::unique_ptr<Camera> {
            throw Error(ErrorKind::device, Message::plain("this build does not know light"),
                        Message::plain("build again"));
          }};
}

}  // namespace

class TestCameraRegistry : public QObject {
  Q_OBJECT

 private slots:
  /// Law: an address is one device, in whatever order and beside whatever others it stands; of a kind that
  /// cannot tell, its place is.
  void eachAddressIsADevice() {
    const CameraRegistry registry({darkKind(), missingKind()});
    const std::vector<std::string> devices = registry.devicesAt(
        {{"dark", "under the stairs"}, {"light", "cellar"}, {"dark", "attic"}, {"dark", "cellar"}});
    QCOMPARE(devices, (std::vector<std::string>{"dark:cellar", "light:cellar", "dark:attic", "dark:cellar"}));
    QVERIFY(registry.devicesAt({}).empty());
  }

  void addressesComeAndGo_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("place");
    QTest::newRow("serial") << "genicam:40012345"
                            << "genicam"
                            << "40012345";
    QTest::newRow("network") << "genicam:192.168.1.20"
                             << "genicam"
                             << "192.168.1.20";
    QTest::newRow("model") << "gphoto2:Canon EOS 80D"
                           << "gphoto2"
                           << "Canon EOS 80D";
    QTest::newRow("port") << "gphoto2:usb:001,005"
                          << "gphoto2"
                          << "usb:001,005";
    QTest::newRow("path") << "v4l2:/dev/v4l/by-id/usb-x:1-index0"
                          << "v4l2"
                          << "/dev/v4l/by-id/usb-x:1-index0";
    QTest::newRow("command") << "command:./shoot {exposure} {output}"
                             << "command"
                             << "./shoot {exposure} {output}";
  }
  void addressesComeAndGo() {
    QFETCH(QString, text);
    QFETCH(QString, kind);
    QFETCH(QString, place);
    const auto address = cameraRegistry().addressFrom(text.toStdString());
    QVERIFY(address.has_value());
    QCOMPARE(address->kind, kind.toStdString());
    QCOMPARE(address->place, place.toStdString());
    QCOMPARE(toString(*address), text.toStdString());
  }

  void everythingElseIsNone() {
    for (const char* text :
         {"", ":", "genicam", "genicam:", "160x120", "usb:7", " genicam:7", "GENICAM:7", "/dev/video0"})
      QVERIFY2(!cameraRegistry().addressFrom(text) && !cameraRegistry().problems(text).empty(), text);
  }

  void whatACommandLacksIsToldWithoutRunningIt_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<QString>("sentences");
    QTest::newRow("nothing") << "command:shoot {exposure} {output}" << "";
    QTest::newRow("a command") << "command:" << "the camera's command is empty";
    QTest::newRow("its file") << "command:shoot {exposure}"
                              << "the camera's command does not contain {output}";
    QTest::newRow("both") << "command:shoot"
                          << "the camera's command does not contain {exposure}; "
                             "the camera's command does not contain {output}";
  }
  void whatACommandLacksIsToldWithoutRunningIt() {
    QFETCH(QString, address);
    QFETCH(QString, sentences);
    QStringList told;
    for (const Message& problem : cameraRegistry().problems(address.toStdString()))
      told << QString::fromStdString(english(problem));
    QCOMPARE(told.join("; "), sentences);
  }

  void theFormsOfAllKindsAreOneSentence() {
    QCOMPARE(cameraRegistry().addressForms(),
             std::string("genicam:SERIAL, gphoto2:MODEL, v4l2:PATH or command:CMD"));
  }

  /// Law: whatever kind the program has, the registry reads its addresses and has help for it.
  void everyKindIsWhole() {
    for (const CameraKind& kind : cameraRegistry().kinds()) {
      QVERIFY(cameraRegistry().addressFrom(kind.prefix + ":" + kind.place));
      QVERIFY(mentions(cameraRegistry().addressForms(), kind.prefix + ":" + kind.place));
      QVERIFY(mentions(cameraRegistry().help(), kind.help));
      QVERIFY(!kind.support.empty());
      QVERIFY(kind.isBuiltIn || !kind.list);
    }
  }

  void whatIsNotThereIsTold() {
    const std::string video =
        sentenceOf([] { cameraRegistry().open({"v4l2", "/dev/no-such-video"}, {}); }, ErrorKind::device);
    QVERIFY(mentions(video, "v4l2:/dev/no-such-video: no such video device is plugged in"));
    const std::string command =
        sentenceOf([] { cameraRegistry().open({"command", "shoot"}, {}); }, ErrorKind::usage);
    QVERIFY(mentions(command, "the camera's command does not contain {exposure}"));
  }

  void aCommandIsOpenedWithTheWishes() {
    const auto camera = cameraRegistry().open({"command", "shoot {exposure} {output}"},
                                              {Size{32, 24}, ExposureRange{0.01, 2.0}});
    QCOMPARE(camera->size(), (Size{32, 24}));
    QCOMPARE(camera->exposures().longest, 2.0);
  }

  void aListTellsWhatIsWrong() {
    const ListedCamera camera = judged(
        "v4l2:/dev/null", Message::plain("a hole"),
        [] { return makeVideoDriver(openCvVideoSource("/dev/null"), "v4l2:/dev/null", std::nullopt); },
        videoPatience());
    QVERIFY(!camera.usable);
    QVERIFY(mentions(english(camera.problem),
                     "cannot be opened: another program may be using it; check its cable"));
  }

  void aKindOfOnesOwnIsOpenedAndListed() {
    const CameraRegistry registry({darkKind(), missingKind()});
    QCOMPARE(registry.addressForms(), std::string("dark:ROOM or light:LAMP"));
    QCOMPARE(registry.help(), std::string("  dark:ROOM   a camera in the dark\n"
                                          "  light:LAMP  a camera in the light; not in this build"));
    QVERIFY(!registry.addressFrom("genicam:7"));

    const auto address = registry.addressFrom("dark:room:7");
    QVERIFY(address.has_value());
    const auto camera = registry.open(*address, {Size{4, 3}});
    QCOMPARE(camera->name(), std::string("dark:room:7"));
    QCOMPARE(camera->size(), (Size{4, 3}));

    const CameraList list = registry.list();
    QCOMPARE(list.cameras.size(), std::size_t{1});
    QCOMPARE(list.cameras.front().address, std::string("dark:cellar"));
    QCOMPARE(list.support.size(), std::size_t{2});
    QVERIFY(list.support[0].available);
    QVERIFY(!list.support[1].available);
  }

  void aKindThatIsMissingSaysSo() {
    const CameraRegistry registry({darkKind(), missingKind()});
    const std::string sentence =
        sentenceOf([&] { registry.open(*registry.addressFrom("light:1"), {}); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "this build does not know light"));
  }

  void aRegistryThatIsNotSoundIsABug() {
    QVERIFY_EXCEPTION_THROWN(CameraRegistry({darkKind(), darkKind()}), std::logic_error);
    CameraKind closed = darkKind();
    closed.open = nullptr;
    QVERIFY_EXCEPTION_THROWN(CameraRegistry({closed}), std::logic_error);
    CameraKind nameless = darkKind();
    nameless.prefix.clear();
    QVERIFY_EXCEPTION_THROWN(CameraRegistry({nameless}), std::logic_error);
    const CameraRegistry registry({darkKind()});
    QVERIFY_EXCEPTION_THROWN(registry.open({"light", "1"}, {}), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestCameraRegistry)
#include "test_camera_registry.moc"
