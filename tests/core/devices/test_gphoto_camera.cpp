// SPDX-License-Identifier: MIT
// DSLR and mirrorless cameras, against scripted ones of three makers.
#include <QtTest>

#include "core/devices/scripted_gphoto.h"
#include "relucent/base/message.h"
#include "relucent/devices/gphoto/gphoto_failure.h"
#include "relucent/devices/gphoto/gphoto_setup.h"
#include "relucent/devices/listed_camera.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::rig;
using namespace std::chrono_literals;
using namespace relucent::test;
using Answer = StillScript::Answer;
using Trouble = StillScript::Trouble;

namespace {

struct Venue {
  explicit Venue(StillScript first = canon()) : script(std::make_shared<StillScript>(std::move(first))) {}
  std::shared_ptr<StillScript> script;
  std::unique_ptr<DrivenCamera> camera{};
  GphotoCameraSettings settings{"Canon EOS 80D", {}, {}};

  void open() {
    camera.reset();
    camera = std::make_unique<DrivenCamera>(
        makeGphotoDriver(std::make_unique<ScriptedPort>(script), settings, scriptedRaw), gphotoPatience());
  }
  std::string refusal() {
    return sentenceOf([&] { open(); }, ErrorKind::device);
  }
  /// The value of a photograph of what the venue shows now.
  int photograph(double seconds = 0.125) {
    ++script->shown;
    const RawFrame frame = camera->capture({{"test", script->shown}, 0, seconds});
    return static_cast<int>(std::lround(frame.signal.at(0, 0, 0) * 100.0f));
  }
  std::string failure() {
    return sentenceOf([&] { photograph(); }, ErrorKind::device);
  }
};

StillScript ofMaker(const QString& maker) {
  return maker == "Canon" ? canon() : maker == "Nikon" ? nikon() : sony();
}

bool isRemarked(const Venue& venue, const std::string& part) {
  const std::vector<Message>& remarks = venue.camera->traits().remarks;
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const Message& remark) { return english(remark).find(part) != std::string::npos; });
}

}  // namespace

class TestGphotoCamera : public QObject {
  Q_OBJECT

 private slots:
  void camerasAreSetUpForMeasuring_data() {
    QTest::addColumn<QString>("maker");
    QTest::addColumn<QString>("wanted");
    QTest::newRow("Canon") << "Canon"
                           << "autoexposuremode=Manual,imageformat=RAW,capturetarget=Internal RAM,iso=100,"
                              "drivemode=Single,focusmode=Manual,autopoweroff=0";
    QTest::newRow("Nikon")
        << "Nikon"
        << "expprogram=M,imagequality=NEF (Raw),capturetarget=Internal RAM,autoiso=0,iso=100,"
           "longexpnr=Off,flashmode=Flash off,capturemode=Single Shot";
    QTest::newRow("Sony") << "Sony"
                          << "imagequality=RAW,iso=100";
  }
  void camerasAreSetUpForMeasuring() {
    QFETCH(QString, maker);
    QFETCH(QString, wanted);
    Venue venue(ofMaker(maker));
    const std::map<std::string, std::string> before = venue.script->values();
    venue.settings.camera = venue.script->cameras.front().model;
    venue.open();
    for (const QString& pair : wanted.split(','))
      QCOMPARE(QString::fromStdString(venue.script->value(pair.section('=', 0, 0).toStdString())),
               pair.section('=', 1));
    const CameraTraits& traits = venue.camera->traits();
    QCOMPARE(traits.size, (Size{6, 4}));
    QCOMPARE(traits.gain, 100.0);
    QVERIFY(traits.triggered);
    for (int i = 1; i < 4; ++i) QCOMPARE(venue.photograph(), i);
    QVERIFY(venue.script->files.empty());  // none stays in the camera
    venue.camera.reset();
    QVERIFY(venue.script->values() == before);  // and the camera is as it was
    QCOMPARE(venue.script->closed, venue.script->opened);
  }

  /// A mode may decide what other settings can be.
  void settingsGoBackTheLastOneFirst() {
    Venue venue;
    venue.open();
    auto changed = [&](std::size_t from) {
      std::vector<std::string> names;
      for (std::size_t i = from; i < venue.script->changes.size(); ++i) {
        const std::string& change = venue.script->changes[i];
        const std::string name = change.substr(0, change.find('='));
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      }
      return names;
    };
    std::vector<std::string> there = changed(0);
    QVERIFY(there.size() > 5);
    const std::size_t changes = venue.script->changes.size();
    venue.camera.reset();
    std::reverse(there.begin(), there.end());
    QCOMPARE(changed(changes), there);
  }

  void photographsAreLinearAndSayTheirTime() {
    Venue venue;
    venue.open();
    venue.script->shown = 41;
    const RawFrame frame = venue.camera->capture({{"test", 1}, 0, 0.11});
    QCOMPARE(frame.bits, 0);
    QCOMPARE(frame.seconds, 0.125);
    QCOMPARE(venue.script->exposed, 0.125);
    QCOMPARE(frame.signal.at(3, 2, 1), 0.41f);
  }

  void theWholeListIsTheRange() {
    Venue venue(nikon());
    venue.settings.camera = "usb:002,007";
    venue.open();
    QCOMPARE(venue.camera->exposures().shortest, 0.001);
    QCOMPARE(venue.camera->exposures().longest, 10.0);  // by bulb
    venue.script->settings.erase("bulb");
    venue.open();
    QCOMPARE(venue.camera->exposures().longest, 1.0);
  }

  void longExposuresAreTakenInBulb_data() {
    QTest::addColumn<QString>("maker");
    QTest::newRow("by the release") << "Canon";
    QTest::newRow("by a switch") << "Nikon";
  }
  void longExposuresAreTakenInBulb() {
    QFETCH(QString, maker);
    Venue venue(ofMaker(maker));
    venue.settings.camera = venue.script->cameras.front().model;
    venue.open();
    QCOMPARE(venue.photograph(8.5), 1);
    QVERIFY(std::abs(venue.script->exposed - 8.5) < 1e-6);
    QCOMPARE(venue.photograph(1.0), 2);  // and back in the list
    QCOMPARE(venue.script->exposed, 1.0);
    const int triggered = venue.script->triggered;
    QCOMPARE(venue.photograph(7.0), 3);
    QCOMPARE(venue.script->triggered, triggered);
    // Open no longer: a camera is not left exposing.
    QVERIFY(!venue.script->bulbSince);
  }

  void bulbThatCannotBeSetIsTold() {
    Venue venue;
    venue.open();
    venue.script->stubborn = {"shutterspeed"};
    const std::string sentence = sentenceOf([&] { venue.photograph(8.0); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "cannot be set to bulb"));
  }

  void whatCannotBeUsedIsRefused_data() {
    QTest::addColumn<QString>("fault");
    QTest::addColumn<QString>("part");
    QTest::newRow("dial")
        << "dial"
        << "mode dial is set to AV, where the camera chooses exposures itself; turn it to M";
    QTest::newRow("no raw") << "no raw"
                            << "does not deliver raw files; switch its picture quality to RAW";
    QTest::newRow("raw refused") << "raw refused"
                                 << "does not deliver raw files";
    QTest::newRow("automatic ISO") << "automatic ISO"
                                   << "(automatic ISO); set it to ISO 100 by hand";
    QTest::newRow("other ISO")
        << "other ISO"
        << "ISO 125 is wanted and the camera does not have it; choose one of those that it has: Auto, 50";
    QTest::newRow("no shutter") << "no shutter"
                                << "exposure time cannot be set; turn its mode dial to M";
    QTest::newRow("fixed shutter") << "fixed shutter"
                                   << "whatever exposure it is asked for";
    QTest::newRow("locked shutter") << "locked shutter"
                                    << "exposure time cannot be set";
    QTest::newRow("too large") << "too large"
                               << "7x4 pixels are wanted and the camera has 6x4";
    QTest::newRow("two of a kind") << "two of a kind"
                                   << "2 cameras of this model are plugged in; name one by its port: "
                                      "gphoto2:usb:001,005 or gphoto2:usb:001,006";
    QTest::newRow("another")
        << "another"
        << "no camera of this name is plugged in, but Nikon D750 is; name that one: gphoto2:Nikon";
    QTest::newRow("none") << "none"
                          << "unplugged or switched off, or has fallen asleep; check its cable";
    QTest::newRow("desktop")
        << "desktop"
        << "another program is using the camera, usually the desktop, which mounts it like a memory "
           "stick; make the desktop release it with `gio mount -s gphoto2`";
    QTest::newRow("asleep") << "asleep"
                            << "may be asleep; press its shutter button half way";
    QTest::newRow("full") << "full"
                          << "its memory card is full; change or empty the memory card";
    QTest::newRow("no photograph")
        << "no photograph"
        << "was asked for a photograph and took none; switch its lens to manual focus";
    QTest::newRow("unreadable") << "unreadable"
                                << "the raw file cannot be read (cut short)";
  }
  void whatCannotBeUsedIsRefused() {
    QFETCH(QString, fault);
    QFETCH(QString, part);
    Venue venue;
    StillScript& script = *venue.script;
    if (fault == "dial") script.settings["autoexposuremode"].choices = {"AV"};
    if (fault == "no raw") script.settings["imageformat"].choices = {"Large Fine JPEG", "sRAW", "mRAW"};
    if (fault == "raw refused") script.refusing = {"imageformat"};
    if (fault == "automatic ISO") script.stubborn = {"iso"};
    if (fault == "other ISO") venue.settings.iso = 125;
    if (fault == "no shutter") script.settings.erase("shutterspeed");
    if (fault == "fixed shutter") script.settings["shutterspeed"].choices = {"1/60"};
    if (fault == "locked shutter") script.settings["shutterspeed"].readOnly = true;
    if (fault == "too large") venue.settings.photograph = Size{7, 4};
    if (fault == "two of a kind") script.cameras.push_back({"Canon EOS 80D", "usb:001,006"});
    if (fault == "another") script.cameras = {{"Nikon D750", "usb:001,005"}};
    if (fault == "none") script.be(Trouble::unplugged, 1h);
    if (fault == "desktop") script.be(Trouble::claimed, 1h);
    if (fault == "asleep") script.be(Trouble::asleep, 1h);
    if (fault == "full") script.be(Trouble::full, 1h);
    if (fault == "no photograph") script.answers.assign(100, Answer::nothing);
    if (fault == "unreadable") script.answers.assign(100, Answer::damaged);
    const std::map<std::string, std::string> before = script.values();
    QVERIFY(mentions(venue.refusal(), part.toStdString()));
    // Also a camera that was refused half way gets its settings back.
    QVERIFY(script.values() == before);
    QCOMPARE(script.closed, script.opened);
  }

  void whatCanDoWithoutIsRemarked() {
    StillScript script = nikon();
    script.settings["longexpnr"].choices = {"On"};
    script.stubborn = {"flashmode"};
    script.settings["focusmode"] = {"AF-S", {"AF-S", "AF-C"}, true};
    script.settings["batterylevel"] = {"25%", {}, true};
    Venue venue(script);
    venue.settings.camera = "nikon d750";
    venue.open();
    for (const char* part : {"dark frame", "flash", "lens to manual focus", "25 % left in its battery"})
      QVERIFY2(isRemarked(venue, part), part);
    QVERIFY(!isRemarked(venue, "single shots"));
    QCOMPARE(venue.photograph(), 1);
  }

  void everyFaultIsMendedByAskingAgain_data() {
    QTest::addColumn<int>("answer");
    QTest::addColumn<int>("repeats");
    QTest::addColumn<int>("reconnections");
    auto row = [](const char* name, Answer answer, int repeats, int reconnections) {
      QTest::newRow(name) << static_cast<int>(answer) << repeats << reconnections;
    };
    row("no photograph", Answer::nothing, 1, 1);
    row("only a JPEG", Answer::jpeg, 1, 1);
    row("a JPEG beside", Answer::jpegAndRaw, 0, 0);
    row("damaged file", Answer::damaged, 1, 0);
    row("another size", Answer::small, 1, 1);
    row("no focus", Answer::noFocus, 1, 1);
    row("refused", Answer::refused, 1, 1);
  }
  void everyFaultIsMendedByAskingAgain() {
    QFETCH(int, answer);
    QFETCH(int, repeats);
    QFETCH(int, reconnections);
    Venue venue;
    const std::map<std::string, std::string> before = venue.script->values();
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    venue.script->answers = {static_cast<Answer>(answer)};
    QCOMPARE(venue.photograph(), 2);
    QCOMPARE(venue.photograph(), 3);
    QCOMPARE(venue.camera->repeats(), repeats);
    QCOMPARE(venue.camera->reconnections(), reconnections);
    QVERIFY(venue.script->files.empty());
    venue.camera.reset();
    QVERIFY(venue.script->values() == before);
  }

  void aPhotographThatComesTooLateIsNotTakenForAnother_data() {
    QTest::addColumn<int>("seconds");
    QTest::addColumn<int>("reconnections");
    QTest::newRow("late") << 20 << 0;
    QTest::newRow("very late") << 41 << 1;
  }
  /// It would come while one of the next is waited for.
  void aPhotographThatComesTooLateIsNotTakenForAnother() {
    QFETCH(int, seconds);
    Venue venue;
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    venue.script->answers = {Answer::late};
    venue.script->lateBy = std::chrono::seconds(seconds);
    for (int i = 2; i < 20; ++i) QCOMPARE(venue.photograph(), i);
    QCOMPARE(venue.camera->repeats(), 1);
    QTEST(venue.camera->reconnections(), "reconnections");
    // Nothing is waited for once it has come.
    const auto begun = venue.script->clock;
    venue.script->answers = {Answer::damaged};
    QCOMPARE(venue.photograph(), 20);
    QVERIFY(venue.script->clock - begun < 5s);
    if (venue.camera->reconnections() == 0) QVERIFY(venue.script->files.empty());
  }

  void whatIsNotMendedIsTold_data() {
    QTest::addColumn<int>("answer");
    QTest::addColumn<QString>("part");
    auto row = [](const char* name, Answer answer, const char* part) {
      QTest::newRow(name) << static_cast<int>(answer) << part;
    };
    row("only a JPEG", Answer::jpeg, "and no raw file");
    row("damaged", Answer::damaged, "the raw file cannot be read (cut short) (take it again)");
    row("no focus", Answer::noFocus,
        "could not focus and took no photograph (Out of Focus); switch its lens to manual");
    row("refused", Answer::refused, "refused what it was asked for (General Error)");
  }
  void whatIsNotMendedIsTold() {
    QFETCH(int, answer);
    QFETCH(QString, part);
    Venue venue;
    venue.open();
    venue.script->answers.assign(10000, static_cast<Answer>(answer));
    const std::string sentence = venue.failure();
    QVERIFY(mentions(sentence, part.toStdString()));
    QVERIFY(mentions(sentence, "go on: every photograph so far is kept"));
    venue.script->answers.clear();
    QCOMPARE(venue.photograph(), 2);
  }

  void aCameraThatIsBusyIsWaitedFor() {
    Venue venue;
    venue.open();
    venue.script->busyFor = 20;
    QCOMPARE(venue.photograph(), 1);
    QCOMPARE(venue.camera->repeats(), 0);
    venue.script->busyFor = 1'000'000;
    QVERIFY(mentions(venue.failure(), "stays busy; close its menus"));
  }

  void photographsByHandAreNotTakenForOurs() {
    Venue venue;
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    for (int i = 0; i < 3; ++i) venue.script->make(".CR2", 0, venue.script->clock, 99);
    QCOMPARE(venue.photograph(), 2);
    QCOMPARE(venue.script->files.size(), std::size_t{3});  // whose owner wants them
  }

  /// A battery is changed, a card emptied, a cable plugged in again: the measurement waits and goes on.
  void troubleIsAPause_data() {
    QTest::addColumn<int>("trouble");
    QTest::addColumn<QString>("part");
    QTest::newRow("unplugged") << static_cast<int>(Trouble::unplugged) << "unplugged or switched off";
    QTest::newRow("asleep") << static_cast<int>(Trouble::asleep) << "may be asleep; press its shutter button";
    QTest::newRow("desktop") << static_cast<int>(Trouble::claimed) << "`gio mount -s gphoto2`";
    QTest::newRow("full") << static_cast<int>(Trouble::full) << "its memory card is full; change or empty";
    QTest::newRow("flat") << static_cast<int>(Trouble::flat)
                          << "battery seems to be empty (8 % when it was last asked); charge or change";
  }
  void troubleIsAPause() {
    QFETCH(int, trouble);
    QFETCH(QString, part);
    StillScript script = canon();
    if (static_cast<Trouble>(trouble) == Trouble::flat) script.settings["batterylevel"].value = "8%";
    Venue venue(script);
    const std::map<std::string, std::string> before = venue.script->values();
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    venue.script->be(static_cast<Trouble>(trouble), 100s);
    QCOMPARE(venue.photograph(), 2);
    QCOMPARE(venue.camera->reconnections(), 1);

    venue.script->be(static_cast<Trouble>(trouble), 1h);
    const std::string sentence = venue.failure();
    QVERIFY(mentions(sentence, part.toStdString()));
    QVERIFY(mentions(sentence, "the camera has been gone for 18"));
    QVERIFY(mentions(sentence, "then go on: every photograph so far is kept"));
    venue.script->troubleUntil = {};
    QCOMPARE(venue.photograph(), 4);
    venue.camera.reset();
    QVERIFY(venue.script->values() == before);  // of before the first connection, not of the last
  }

  /// Some cameras say nothing at all when they can no longer take photographs.
  void silenceIsExplained() {
    Venue venue;
    venue.open();
    venue.script->answers.assign(10000, Answer::nothing);
    venue.script->settings["availableshots"].value = "0";
    QVERIFY(mentions(venue.failure(), "its memory card is full"));
    venue.script->settings["batterylevel"].value = "5%";
    QVERIFY(mentions(venue.failure(), "battery seems to be empty (5 %"));
  }

  void anotherCameraIsNotGivenTheSettingsOfTheFirst() {
    Venue venue;
    venue.settings.camera = "usb:001,005";
    venue.open();
    QCOMPARE(venue.photograph(), 1);
    const StillScript other = nikon();
    venue.script->settings = other.settings;
    venue.script->cameras = {{"Nikon D750", "usb:001,005"}};
    const std::map<std::string, std::string> before = venue.script->values();
    venue.script->be(Trouble::unplugged, 10s);
    QCOMPARE(venue.photograph(), 2);  // as many pixels: it may go on
    venue.camera.reset();
    QVERIFY(venue.script->values() == before);
  }

  void aPartOfTheSensorIsItsMiddle() {
    Venue venue;
    venue.settings.photograph = Size{2, 2};
    venue.open();
    QCOMPARE(venue.camera->size(), (Size{2, 2}));
    QCOMPARE(venue.photograph(), 1);
  }

  void aListTellsWhatIsThere() {
    auto script = std::make_shared<StillScript>(canon());
    GphotoCameraSettings settings{"Canon EOS 80D", {}, {}};
    auto open = [&] {
      return makeGphotoDriver(std::make_unique<ScriptedPort>(script), settings, scriptedRaw);
    };
    const ListedCamera good =
        judged("gphoto2:Canon EOS 80D", Message::plain("Canon EOS 80D"), open, gphotoPatience());
    QVERIFY2(good.usable, english(good.problem).c_str());
    script->be(Trouble::claimed, 1h);
    const ListedCamera held =
        judged("gphoto2:Canon EOS 80D", Message::plain("Canon EOS 80D"), open, gphotoPatience());
    QVERIFY(!held.usable);
    QVERIFY(mentions(english(held.problem), "gio mount -s gphoto2"));
    const auto places = gphotoPlaces({{"A", "usb:1"}, {"B", "usb:2"}, {"a", "usb:3"}});
    QVERIFY((places == std::vector<std::string>{"usb:1", "B", "usb:3"}));
  }

  void rawIsChosenAmongQualities_data() {
    QTest::addColumn<QStringList>("choices");
    QTest::addColumn<QString>("chosen");
    auto row = [](const char* name, const QStringList& choices, const char* chosen) {
      QTest::newRow(name) << choices << QString(chosen);
    };
    row("Canon", {"L", "RAW + L", "cRAW", "RAW"}, "RAW");
    row("Canon, only lossy alone", {"RAW + L", "cRAW"}, "cRAW");
    row("Nikon", {"JPEG Fine", "NEF+Fine", "NEF (Raw)"}, "NEF (Raw)");
    row("Sony", {"RAW+JPEG", "RAW Compressed", "RAW"}, "RAW");
    row("Panasonic", {"fine", "RAW+fine"}, "RAW+fine");
    row("only small ones", {"sRAW", "mRAW", "RAW S", "L"}, "");
    row("none", {"L", "M"}, "");
    row("empty", {}, "");
  }
  void rawIsChosenAmongQualities() {
    QFETCH(QStringList, choices);
    QFETCH(QString, chosen);
    std::vector<std::string> words;
    for (const QString& choice : choices) words.push_back(choice.toStdString());
    QCOMPARE(QString::fromStdString(rawChoice(words).value_or("")), chosen);
  }

  void batteriesAreUnderstood() {
    QCOMPARE(batteryPercent("75%").value_or(-1), 75);
    QCOMPARE(batteryPercent("0%").value_or(-1), 0);
    QCOMPARE(batteryPercent("Low").value_or(-1), 5);
    QCOMPARE(batteryPercent("200").value_or(-1), 100);
    for (const char* word : {"", "Full", "3", "half", "%", "-5%x"}) QVERIFY2(!batteryPercent(word), word);
  }

  void problemsAreListed() {
    QCOMPARE(problems(GphotoCameraSettings{"x", {}, {}}).size(), std::size_t{0});
    const GphotoCameraSettings wrong{"", Size{0, 4}, 0};
    QCOMPARE(problems(wrong).size(), std::size_t{3});
    QVERIFY_EXCEPTION_THROWN(makeGphotoDriver(nullptr, wrong, scriptedRaw), std::logic_error);
    QVERIFY(problems(gphotoPatience()).empty());
  }
};

QTEST_GUILESS_MAIN(TestGphotoCamera)
#include "test_gphoto_camera.moc"
