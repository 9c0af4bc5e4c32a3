// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/devices/command/command_camera.h"
#include "relucent/devices/command/command_projector.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/rig/shot.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

Image codes(Size size, int bits, std::uint64_t seed) {
  Random random{seed};
  Image image(size, 3);
  for (float& value : image.data())
    value = static_cast<float>(static_cast<double>(random.below(1u << bits)) / ((1 << bits) - 1));
  return image;
}

template <typename Action>
std::string deviceSentenceOf(const Action& action) {
  return sentenceOf(action, ErrorKind::device);
}

}  // namespace

class TestCommandDevices : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path file(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }

  /// A shell script that is run with the placeholders as its arguments.
  std::string script(const std::string& name, const std::string& body, const std::string& arguments) const {
    std::ofstream(file(name)) << "#!/bin/sh\n" << body << "\n";
    return "sh " + file(name).string() + " " + arguments;
  }
  CommandCameraSettings cameraSettings(const std::string& body) const {
    CommandCameraSettings settings;
    settings.command = script("camera.sh", body, "{exposure} {output} {shot}");
    settings.size = Size{8, 6};
    return settings;
  }
  static CaptureRequest request() { return {{"acquisition", 17}, 1, 0.125}; }

 private slots:
  void theProjectorsCommandGetsTheDriveValues_data() {
    QTest::addColumn<int>("bits");
    QTest::newRow("8 bits") << 8;
    QTest::newRow("16 bits") << 16;
  }
  void theProjectorsCommandGetsTheDriveValues() {
    QFETCH(int, bits);
    CommandProjectorSettings settings;
    settings.command = script("show.sh", "cp \"$1\" " + file("shown.png").string(), "{image}");
    settings.size = {16, 12};
    settings.bits = bits;
    CommandProjector projector(settings);
    QCOMPARE(projector.size(), (Size{16, 12}));
    QCOMPARE(projector.bits(), bits);
    for (std::uint64_t seed : {1, 2}) {
      const Image drive = codes({16, 12}, bits, seed);
      projector.show(drive);
      const Picture shown = readPicture(file("shown.png"));
      QCOMPARE(shown.bits, bits);
      QCOMPARE(shown.encoded, drive);
    }
    QVERIFY_THROWS_EXCEPTION(std::logic_error, projector.show(Image({12, 16}, 3)));
  }

  void theProjectorsFailureIsTold() {
    CommandProjectorSettings settings;
    settings.command = script("broken.sh", "echo 'lamp is off' >&2; exit 2", "{image}");
    settings.size = {2, 2};
    settings.name = "left projector";
    CommandProjector projector(settings);
    const std::string sentence = deviceSentenceOf([&] { projector.show(Image({2, 2}, 3)); });
    QVERIFY(mentions(sentence, "left projector: the command failed with status 2, saying \"lamp is off\"; "));
    QVERIFY(mentions(sentence, "broken.sh"));
  }

  void theCamerasCommandIsToldWhatIsWanted() {
    writeExr(file("scene.exr"), Image({8, 6}, 3, 0.5f), ExrType::floatType);
    CommandCamera camera(cameraSettings("printf '%s %s' \"$1\" \"$3\" > " + file("asked").string() + "; cp " +
                                        file("scene.exr").string() + " \"$2\""));
    const RawFrame frame = camera.capture(request());
    QCOMPARE(readFile(file("asked")), std::string("0.125 acquisition-17-1"));
    QCOMPARE(frame.seconds, 0.125);
    camera.capture({{"x", 0}, 0, 1.0 / 3.0});
    QCOMPARE(std::stod(readFile(file("asked"))), 1.0 / 3.0);  // every digit of the time arrives
  }

  void everyKindOfPhotographIsRead_data() {
    QTest::addColumn<QString>("source");
    QTest::addColumn<QString>("suffix");
    QTest::addColumn<int>("bits");
    QTest::newRow("float EXR") << "scene.exr"
                               << "exr" << 0;
    QTest::newRow("16-bit PNG") << "scene16.png"
                                << "png" << 16;
    QTest::newRow("8-bit PNG") << "scene8.png"
                               << "png" << 8;
    QTest::newRow("capitals") << "scene8.png"
                              << "PNG" << 8;
    QTest::newRow("appended") << "scene16.png"
                              << "exr.png" << 16;
    QTest::newRow("PNG called EXR") << "scene16.png"
                                    << "exr" << 16;
  }
  void everyKindOfPhotographIsRead() {
    QFETCH(QString, source);
    QFETCH(QString, suffix);
    QFETCH(int, bits);
    const Image scene = codes({8, 6}, 8, 3);  // whole codes of 8 bits are whole codes of 16 bits
    writeExr(file("scene.exr"), scene, ExrType::floatType);
    writePng(file("scene16.png"), scene, 16);
    writePng(file("scene8.png"), scene, 8);
    CommandCamera camera(cameraSettings("cp " + file(source.toStdString()).string() + " \"${2%.exr}." +
                                        suffix.toStdString() + "\""));
    const RawFrame frame = camera.capture(request());
    QCOMPARE(frame.bits, bits);
    QCOMPARE(frame.signal, scene);
  }

  void theBetterOfTwoFilesIsRead() {
    writeExr(file("scene.exr"), Image({8, 6}, 3, 0.5f), ExrType::floatType);
    writePng(file("preview.png"), Image({8, 6}, 3), 8);
    CommandCamera camera(cameraSettings("cp " + file("preview.png").string() + " \"${2%.exr}.png\"; cp " +
                                        file("scene.exr").string() + " \"$2\""));
    QCOMPARE(camera.capture(request()).bits, 0);
  }

  void theExtensionCanBeChosen() {
    writePng(file("scene.png"), Image({8, 6}, 3, 1.0f), 16);
    CommandCameraSettings settings =
        cameraSettings("case \"$2\" in *.png) cp " + file("scene.png").string() + " \"$2\";; esac");
    settings.extension = "png";
    QCOMPARE(CommandCamera(settings).capture(request()).bits, 16);
  }

  void anUnknownSizeIsThatOfAFirstPhotograph() {
    writePng(file("scene.png"), Image({5, 3}, 3, 1.0f), 8);
    CommandCameraSettings settings = cameraSettings("cp " + file("scene.png").string() + " \"$2\"");
    settings.size.reset();
    CommandCamera camera(settings);
    QCOMPARE(camera.size(), (Size{5, 3}));
    camera.capture(request());
  }

  void anOldPhotographIsNeverTakenForANewOne() {
    writeExr(file("scene.exr"), Image({8, 6}, 3, 0.5f), ExrType::floatType);
    CommandCamera camera(cameraSettings("test -e " + file("once").string() + " || cp " +
                                        file("scene.exr").string() + " \"$2\"; touch " +
                                        file("once").string()));
    camera.capture(request());
    const std::string sentence = deviceSentenceOf([&] { camera.capture(request()); });
    QVERIFY(mentions(sentence, "the command ended well but wrote nothing, not photograph.exr; let it write"));
  }

  void whatTheCameraDoesWrongIsTold_data() {
    QTest::addColumn<QString>("body");
    QTest::addColumn<ErrorKind>("kind");
    QTest::addColumn<QString>("part");
    QTest::newRow("failure") << "echo 'usb gone' >&2; exit 1" << ErrorKind::device << "saying \"usb gone\"";
    QTest::newRow("another file") << "touch \"$(dirname \"$2\")/IMG_1.CR2\"" << ErrorKind::device
                                  << "wrote IMG_1.CR2, not photograph.exr";
    QTest::newRow("wrong size") << "cp FOLDER/small.png \"$2\"" << ErrorKind::device
                                << "has 4x3 pixels where 8x6 were announced; let the command write that size";
    QTest::newRow("no picture") << "echo text > \"$2\"" << ErrorKind::format << "camera command: ";
    QTest::newRow("empty file") << ": > \"$2\"" << ErrorKind::format << "cut short";
    QTest::newRow("NaN") << "cp FOLDER/nan.exr \"$2\"" << ErrorKind::input << "holds nan at pixel 3, 2";
  }
  void whatTheCameraDoesWrongIsTold() {
    QFETCH(QString, body);
    QFETCH(ErrorKind, kind);
    QFETCH(QString, part);
    writePng(file("small.png"), Image({4, 3}, 3), 8);
    Image scene({8, 6}, 3);
    scene.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    writeExr(file("nan.exr"), scene, ExrType::floatType);
    CommandCamera camera(cameraSettings(body.replace("FOLDER", folder_.path()).toStdString()));
    QVERIFY(mentions(sentenceOf([&] { camera.capture(request()); }, kind), part.toStdString()));
  }

  void aHiccupIsNotTheEnd() {
    writeExr(file("scene.exr"), Image({8, 6}, 3, 0.5f), ExrType::floatType);
    // Every second call fails.
    const std::string flaky = "if test -e " + file("hiccup").string() + "; then rm " +
                              file("hiccup").string() + "; else touch " + file("hiccup").string() +
                              "; exit 1; fi; ";
    CommandCameraSettings settings = cameraSettings(flaky + "cp " + file("scene.exr").string() + " \"$2\"");
    CommandCamera camera(settings);
    for (int i = 0; i < 3; ++i) QCOMPARE(camera.capture(request()).signal.at(0, 0, 0), 0.5f);
    settings.attempts = 1;
    CommandCamera impatient(settings);
    QVERIFY(mentions(deviceSentenceOf([&] { impatient.capture(request()); }), "failed with status 1"));
    impatient.capture(request());

    CommandProjectorSettings show;
    show.command = script("flaky.sh", flaky, "{image}");
    show.size = {2, 2};
    CommandProjector projector(show);
    for (int i = 0; i < 3; ++i) projector.show(Image({2, 2}, 3));
    show.attempts = 1;
    CommandProjector hasty(show);
    QVERIFY(mentions(deviceSentenceOf([&] { hasty.show(Image({2, 2}, 3)); }), "failed with status 1"));
  }

  void aSlowCameraIsNotWaitedForForever() {
    CommandCameraSettings settings = cameraSettings("sleep 30");
    settings.timeout = 100ms;
    CommandCamera camera(settings);
    // The exposure time comes on top of the time allowed.
    const std::string sentence = deviceSentenceOf([&] { camera.capture({{"x", 0}, 0, 0.1}); });
    QVERIFY(mentions(sentence, "took longer than 0.2 s"));
  }

  void temporaryFilesInAwkwardPlacesWork() {
    const fs::path awkward = file("it's a \"place\" $HOME");
    createFolder(awkward);
    writeExr(file("scene.exr"), Image({8, 6}, 3, 0.25f), ExrType::floatType);
    const QByteArray before = qgetenv("TMPDIR");
    qputenv("TMPDIR", QByteArray::fromStdString(awkward.string()));
    {
      CommandCamera camera(cameraSettings("cp " + file("scene.exr").string() + " \"$2\""));
      QCOMPARE(camera.capture(request()).signal.at(0, 0, 0), 0.25f);
      QVERIFY(!fs::is_empty(awkward));
    }
    before.isEmpty() ? qunsetenv("TMPDIR") : qputenv("TMPDIR", before);
    QVERIFY(fs::is_empty(awkward));  // nothing is left behind
  }

  void problemsAreListed() {
    CommandProjectorSettings projector;
    projector.command = "show";
    projector.bits = 12;
    projector.timeout = 0s;
    QCOMPARE(problems(projector).size(), std::size_t{4});
    QVERIFY_THROWS_EXCEPTION(std::logic_error, CommandProjector{projector});

    CommandCameraSettings camera;
    camera.command = "take";
    camera.size = Size{0, 4};
    camera.extension = "cr2";
    camera.exposures = {0.0, 1.0};
    camera.timeout = -1s;
    QCOMPARE(problems(camera).size(), std::size_t{6});
    QVERIFY_THROWS_EXCEPTION(std::logic_error, CommandCamera{camera});
  }

  void aShotRunsThroughBothCommands() {
    // The "camera" photographs what the "projector" shows.
    CommandProjectorSettings projector;
    projector.command = script("show.sh", "cp \"$1\" " + file("wall.png").string(), "{image}");
    projector.size = {8, 6};
    Rig rig;
    rig.projectors.push_back(std::make_unique<CommandProjector>(projector));
    rig.cameras.push_back(
        std::make_unique<CommandCamera>(cameraSettings("cp " + file("wall.png").string() + " \"$2\"")));
    NoShotLog log;
    ShotTaker shots(rig, log, "linearization");
    const Image drive = codes({8, 6}, 8, 4);
    const Shot shot = shots.take({drive}, {0.1, 0.2}, Progress());
    QCOMPARE(shot.frames.size(), std::size_t{2});
    QCOMPARE(shot.frames[1][0].signal, drive);
  }
};

QTEST_GUILESS_MAIN(TestCommandDevices)
#include "test_command_devices.moc"
