// SPDX-License-Identifier: MIT
// The program itself, in a process of its own, from a new venue to an installed show: a real second screen
// and a real GigE Vision camera that photographs it through a simulated venue, with a cable pulled, a bump,
// a full disk and a kill on the way. Used by mouse and keys, and judged by what stands on its windows, on the
// projector's screen and on the disk at each moment: nothing here knows the program's inside. Each act begins
// where the one before it ended.
#include <QDirIterator>
#include <QGuiApplication>
#include <QTemporaryDir>
#include <QtTest>
#include <map>

#include "gui/wizard/gige_room.h"
#include "relucent/devices/camera_registry.h"
#include "support/driven_program.h"
#include "support/own_network.h"
#include "support/screen_light.h"
#include "support/small_disk.h"
#include "theme/tokens.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::test;

namespace {

constexpr int patience = 60'000;                // milliseconds on a busy machine; most takes a second
constexpr qint64 soon = 5'000;                  // within which a lost device is said
constexpr std::chrono::milliseconds calm{120};  // between photographs while something is to happen
constexpr std::uint64_t diskBytes = 64 << 20, nearlyFull = 2 << 20;
constexpr std::size_t beforePatterns = 30;  // photographs of black, full light and the view; no fewer
constexpr int safePatterns = 8;             // that a kill must not cost
constexpr int leastArrow = 200;             // pixels of a window that is seen from a ladder
constexpr int steps = 8;

QString step(int number) {
  return QString("step-%1").arg(number);
}

/// Longer than a test's message may be.
void tellWhatIsShown(const Seen& seen) {
  for (const QString& line : seen.text().split('\n')) qInfo("%s", qPrintable(line));
}

}  // namespace

/// Waits until that is to be seen; `seen` is what is shown then.
#define TRY_SEEN(condition)                                                   \
  do {                                                                        \
    Seen seen;                                                                \
    const auto isSeen = [&] { return seen = program_->look(), (condition); }; \
    if (!QTest::qWaitFor(isSeen, patience)) {                                 \
      tellWhatIsShown(seen);                                                  \
      QFAIL("not seen: " #condition);                                         \
    }                                                                         \
  } while (false)

/// Does something as soon as it can be done.
#define TRY_DO(action)                                                               \
  do {                                                                               \
    QString why;                                                                     \
    if (!QTest::qWaitFor([&] { return why = (action), why.isEmpty(); }, patience)) { \
      tellWhatIsShown(program_->look());                                             \
      QFAIL(qPrintable(#action ": " + why));                                         \
    }                                                                                \
  } while (false)

/// At once.
#define SEEN(condition)                 \
  do {                                  \
    const Seen seen = program_->look(); \
    if (!(condition)) {                 \
      tellWhatIsShown(seen);            \
      QFAIL("not seen: " #condition);   \
    }                                   \
  } while (false)

class TestAcceptanceWalk : public QObject {
  Q_OBJECT

  SmallDisk& disk_;  // that the venue lies on
  QTemporaryDir home_;
  std::unique_ptr<Room> room_;
  std::unique_ptr<DrivenProgram> program_;
  std::unique_ptr<ScreenLight> screen_;
  bool hasFailed_ = false;
  QElapsedTimer act_;
  std::size_t beforeAcquiring_ = 0, putBackAt_ = 0, killedAt_ = 0;  // photographs by then

  QString diskFolder() const { return QString::fromStdString(disk_.folder().string()); }
  QString venue() const { return diskFolder() + "/Walk"; }
  QString config() const { return home_.filePath("config"); }
  image::Image shining() const { return screen_->look(wantedSizes().projector); }
  bool isDark() const {
    const image::Image light = shining();
    return std::ranges::all_of(light.data(), [](float value) { return value == 0.0f; });
  }
  /// A still picture is first shown as quickly as it can be, then as well: once it stays as it is.
  image::Image settledLight() const {
    constexpr int equalLooks = 8;
    image::Image light;
    int equal = 0;
    const auto isSettled = [&] {
      const image::Image now = shining();
      equal = now.data() == light.data() ? equal + 1 : 0;
      light = now;
      return equal >= equalLooks;
    };
    return QTest::qWaitFor(isSettled, patience) ? light : image::Image();
  }
  int amber(const QString& part) { return program_->pixels(part, colours(Look::dark).amber); }

  void startProgram() {
    QProcessEnvironment own = QProcessEnvironment::systemEnvironment();
    own.insert("HOME", home_.path());
    for (const char* kind : {"CONFIG", "CACHE", "DATA"})
      own.insert(QString("XDG_%1_HOME").arg(kind), home_.filePath(QString(kind).toLower()));
    own.insert("LC_ALL", "C.UTF-8");
    program_ = std::make_unique<DrivenProgram>(RELUCENT_TEST_PLUGINS, own);
    program_->start(qEnvironmentVariable("RELUCENT_PROGRAM"));
    QVERIFY(program_->isRunning());
  }

  /// Files of the desktop by which a show starts at log-in.
  QStringList installed() const {
    QStringList files;
    for (QDirIterator each(config(), QDir::Files | QDir::System, QDirIterator::Subdirectories);
         each.hasNext();) {
      QFile file(each.next());
      if (file.open(QIODevice::ReadOnly) && file.readAll().contains(venue().toUtf8()))
        files << file.fileName();
    }
    files.removeIf([](const QString& file) { return file.endsWith(".conf"); });  // recently opened
    return files;
  }
  /// How often each pattern was photographed from one photograph to another.
  std::map<std::size_t, int> taken(std::size_t first, std::size_t last) const {
    const std::vector<std::size_t> all = room_->patterns();
    std::map<std::size_t, int> times;
    for (std::size_t i = first; i < std::min(last, all.size()); ++i) ++times[all[i]];
    return times;
  }
  void takesPhotographs() {
    const int now = room_->photographs();
    QTRY_VERIFY_WITH_TIMEOUT(room_->photographs() > now + 2, patience);
  }

  /// Law: a lost device is said soon, in amber in banner, rail and strip, on every page, with what is safe;
  /// and when it is back the work goes on by itself and nothing is amber. `other`, which is there, is not
  /// said to be lost.
  void isLostAndFound(const std::function<void()>& lose, const std::function<void()>& find,
                      const QString& sentence, const QString& inTheRail, const QString& strip,
                      const QString& other) {
    QElapsedTimer since;
    since.start();
    lose();
    TRY_SEEN(seen.part("banner-sentence").text == sentence);
    qInfo("said after %.1f s", 1e-3 * static_cast<double>(since.elapsed()));
    QVERIFY(since.elapsed() < soon);
    for (int page : {1, 2, 3, 4}) {
      TRY_DO(program_->click(step(page)));
      TRY_SEEN(seen.part("banner-sentence").text == sentence &&
               seen.part("banner-more").text.contains("Everything so far is safe") &&
               seen.part(step(4)).more == inTheRail && seen.part(strip).role == "amber" &&
               seen.part(other).role == "note");
      QVERIFY(amber("banner") > 0 && amber(step(4)) > 0 && amber(strip) > 0);
      SEEN(seen.dialog().isEmpty());
    }
    find();
    TRY_SEEN(seen.part("banner-sentence").text.isEmpty());
    TRY_SEEN(seen.part(step(4)).more.startsWith("Measuring") && seen.part(strip).role == "note");
    QVERIFY(amber(step(4)) == 0 && amber(strip) == 0);
    takesPhotographs();
  }

 public:
  explicit TestAcceptanceWalk(SmallDisk& disk) : disk_(disk) {}

 private slots:
  void initTestCase() {
    if (!devices::cameraRegistry().find("genicam")->isBuiltIn)
      QSKIP("this build has no Aravis, which both ends of this test need");
    QVERIFY(screenOn("DUMMY1") != nullptr);
    room_ = std::make_unique<Room>(std::get<venue::VenueSettings>(simulatedSettings().rig),
                                   home_.filePath("cache").toStdString());
    if (!room_->isRunning()) QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
    screen_ = std::make_unique<ScreenLight>("DUMMY1");
    startProgram();
  }
  void init() {
    if (hasFailed_) QSKIP("an act before this one failed");
    act_.start();
  }
  void cleanup() {
    hasFailed_ = hasFailed_ || QTest::currentTestFailed();
    qInfo("%.1f s, %d photographs", 1e-3 * static_cast<double>(act_.elapsed()), room_->photographs());
  }
  void cleanupTestCase() {
    program_.reset();
    room_.reset();
  }

  void aNewVenueIsBegun() {
    TRY_SEEN(seen.says("No venues yet"));
    for (int later = 2; later <= steps; ++later) SEEN(seen.part(step(later)).spoken.endsWith("locked"));
    TRY_DO(program_->click("new-venue"));
    TRY_SEEN(seen.part("hint").text == "Choose the screen that shines on the surface.");
    TRY_DO(program_->type("venue-name", "Walk"));
    TRY_DO(program_->type("venue-folder", diskFolder()));
    TRY_DO(program_->press("Return"));
    SEEN(!seen.part("primary").isEnabled);
    TRY_DO(program_->click("venue-screen-DUMMY1"));
    // There is no way on before somebody says that the room is clear, and that is what is said.
    TRY_SEEN(seen.part("hint").text == "Confirm that the room is clear." && !seen.part("primary").isEnabled);
    TRY_DO(program_->click("room-is-clear"));
    TRY_SEEN(seen.part("primary").isEnabled && !seen.says("Confirm that the room is clear."));
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(1)).spoken.endsWith("done") && seen.part(step(2)).spoken.endsWith("current"));
    QVERIFY(QFileInfo::exists(venue() + "/calibration.relucent"));
  }

  void theCameraIsChosenAndChecked() {
    TRY_SEEN(!seen.part("primary").isEnabled && seen.button("Choose").isEnabled);
    TRY_DO(program_->clickText("Choose"));
    // A picture comes first.
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("camera-view"), patience);
    SEEN(!seen.part("primary").isEnabled);
    TRY_SEEN(seen.part("primary").isEnabled && seen.says("The camera sees DUMMY1"));
    TRY_SEEN(seen.part("hint").text == "Next: test patterns for the projector's response");
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(2)).spoken.endsWith("done") && seen.part(step(3)).spoken.endsWith("current"));
  }

  void theResponseIsMeasured() {
    TRY_DO(program_->click("levels"));
    TRY_DO(program_->press("9"));
    TRY_DO(program_->press("Return"));
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(3)).spoken.endsWith("done") && seen.part("primary").isEnabled);
    SEEN(seen.part(step(3)).more.startsWith("Colours within") && seen.dialog().isEmpty());
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(4)).spoken.endsWith("current"));
  }

  void measuringBegins() {
    TRY_DO(program_->clickText("Fast"));
    beforeAcquiring_ = room_->patterns().size();
    room_->setLeastInterval(calm);
    TRY_DO(program_->click("primary"));
    // There is time to leave the room, which nobody needs here.
    TRY_SEEN(seen.part("primary").text == "Start now" && seen.part(step(4)).more.startsWith("Begins in"));
    QCOMPARE(room_->patterns().size(), beforeAcquiring_);
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(4)).more.startsWith("Measuring") && !seen.part("primary").isEnabled);
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("photograph-view"), patience);
  }

  void theCameraIsUnplugged() {
    isLostAndFound([this] { room_->camera().unplug(); }, [this] { room_->camera().plug(); },
                   "The camera does not answer", "Camera silent", "strip-camera", "strip-projector");
  }

  void theScreenIsUnplugged() {
    isLostAndFound([] { switchScreen(false); }, [] { switchScreen(true); },
                   "The projector's screen is unplugged", "Screen unplugged", "strip-projector",
                   "strip-camera");
  }

  /// Law: while it is paused nothing is projected, and the window answers.
  void itIsPaused() {
    TRY_DO(program_->click(step(4)));
    TRY_DO(program_->clickText("Pause"));
    TRY_SEEN(seen.part("hint").text == "Waiting for you. Nothing is being projected." && isDark());
    TRY_DO(program_->clickText("Resume"));
    TRY_SEEN(seen.part(step(4)).more.startsWith("Measuring"));
    takesPhotographs();
    // Somebody comes in: the light ends at once, and comes back only when the room is clear again.
    TRY_DO(program_->click("room-is-clear"));
    TRY_SEEN(seen.part("hint").text == "To go on measuring, confirm that the room is clear." &&
             !seen.button("Resume").isEnabled && isDark());
    TRY_DO(program_->click("room-is-clear"));
    TRY_DO(program_->clickText("Resume"));
    TRY_SEEN(seen.part(step(4)).more.startsWith("Measuring"));
    takesPhotographs();
  }

  /// Law: a bump is said with what is safe and what to do, in the dark; the nudge view shows live which way
  /// to push and how far; pushed back, the measurement goes on.
  void theCameraIsBumped() {
    // Full light and the first look at the view, by which all is compared, are behind it.
    QTRY_VERIFY_WITH_TIMEOUT(room_->patterns().size() > beforeAcquiring_ + beforePatterns, patience);
    room_->bump(3.0);
    TRY_SEEN(!seen.dialog().isEmpty());
    const QString moved = "The camera or the projector moved";
    SEEN(seen.dialog() == moved && seen.says("What happened") && seen.says("What is safe") &&
         seen.says("What to do"));
    SEEN(seen.button("Try again").isDefault && seen.button("Stop and keep").isEnabled);
    QVERIFY(isDark());
    // Until somebody answers it waits, says so, and asks again whoever has closed the question.
    TRY_SEEN(seen.part(step(4)).more.startsWith("Waits for an answer") && amber(step(4)) > 0);
    TRY_DO(program_->press("Escape"));
    TRY_SEEN(seen.dialog().isEmpty() && seen.part("banner-sentence").text == moved &&
             seen.part("hint").text == "Waiting for your answer.");
    TRY_DO(program_->click("banner-primary"));
    TRY_SEEN(seen.dialog() == moved);
    TRY_DO(program_->clickText("Put the camera back"));
    TRY_SEEN(seen.dialog() == "Put the camera back" && seen.says(" px to the "));
    const QString far = program_->look().text();
    QVERIFY(program_->holdsPicture("nudge-view"));
    const QColor arrow = colours(Look::dark).accent;
    QVERIFY(program_->pixels("nudge-view", arrow) > leastArrow);
    room_->bump(1.5);
    TRY_SEEN(seen.says(" px to the ") && seen.text() != far);
    room_->bump(0.0);
    TRY_SEEN(seen.says("The camera looks where it looked."));
    QCOMPARE(program_->pixels("nudge-view", arrow), 0);
    TRY_DO(program_->click("nudge-close"));
    TRY_SEEN(seen.dialog() == "The camera is back at its place");
    putBackAt_ = room_->patterns().size();
    TRY_DO(program_->clickText("Try again"));
    TRY_SEEN(seen.dialog().isEmpty() && seen.part(step(4)).more.startsWith("Measuring"));
    takesPhotographs();
  }

  /// Law: measuring pauses, dark, with a sentence, and goes on by itself once there is room.
  void theDiskIsFull() {
    if (!disk_.isMounted()) QSKIP("nobody may mount a small disk here (unshare, mount)");
    TRY_DO(program_->click(step(4)));
    disk_.fillUpTo(nearlyFull);
    TRY_SEEN(seen.part("banner-sentence").text == "The disk is full. Measuring has paused.");
    SEEN(seen.part("banner-more").text.contains("Every photograph is safe") &&
         seen.part(step(4)).more.startsWith("Paused") &&
         seen.part("hint").text == "Waiting for room on the disk. Nothing is being projected.");
    QVERIFY(amber("banner") > 0 && amber(step(4)) > 0);
    TRY_SEEN(seen.part("strip-disk").role == "amber");
    QVERIFY(amber("strip-disk") > 0);
    QTRY_VERIFY_WITH_TIMEOUT(isDark(), patience);
    const int paused = room_->photographs();
    SEEN(seen.dialog().isEmpty());
    disk_.makeRoom();
    TRY_SEEN(seen.part("banner-sentence").text.isEmpty() && seen.part(step(4)).more.startsWith("Measuring"));
    QTRY_VERIFY_WITH_TIMEOUT(room_->photographs() > paused + 2, patience);
    TRY_SEEN(seen.part("strip-disk").role == "note");
  }

  /// Law: whatever was photographed before the program was killed is safe, and it says so.
  void theProgramIsKilled() {
    // Bumped before a second look had confirmed the first, it was measured from the start.
    QTRY_VERIFY_WITH_TIMEOUT(room_->patterns().size() > putBackAt_ + beforePatterns + 2 * safePatterns,
                             patience);
    program_->kill();
    killedAt_ = room_->patterns().size();
    startProgram();
    TRY_SEEN(seen.says("Walk") && seen.says("Interrupted: "));
    TRY_DO(program_->clickText("Resume"));
    TRY_SEEN(seen.part(step(4)).spoken.endsWith("current") && seen.part(step(4)).more.endsWith("kept"));
    SEEN(seen.part("banner-sentence").text == "The last session ended before it was finished" &&
         seen.says("patterns are safe"));
    SEEN(seen.part("primary").text == "Resume" && !seen.part("primary").isEnabled &&
         seen.part("hint").text == "Confirm that the room is clear: the patterns flash.");
    TRY_DO(program_->click("room-is-clear"));
    room_->setLeastInterval({});
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part("primary").text == "Start now");
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(4)).spoken.endsWith("done") && seen.part("primary").isEnabled);
    SEEN(seen.dialog().isEmpty() && seen.part("banner-sentence").text.isEmpty());
    // No photograph is taken again but the one in flight, by the camera's count. Those before the camera was
    // put back were dropped; what was photographed more than once is light that others are compared with.
    std::map<std::size_t, int> before = taken(0, putBackAt_),
                               after = taken(killedAt_, room_->patterns().size());
    int once = 0, again = 0;
    for (const auto& [pattern, times] : taken(putBackAt_, killedAt_)) {
      if (times > 1 || before[pattern] > 1) continue;
      ++once;
      again += after.contains(pattern);
    }
    qInfo("%d patterns photographed once before, %d of them again", once, again);
    QVERIFY(once >= safePatterns && again <= 1);
  }

  void whatIsWeakIsCut() {
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(5)).spoken.endsWith("current"));
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("flood-view"), patience);
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(5)).spoken.endsWith("done") && seen.part(step(6)).spoken.endsWith("current"));
  }

  void pixelsAreGrouped() {
    TRY_SEEN(seen.part("primary").isEnabled);
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(6)).spoken.endsWith("done") && seen.part(step(7)).spoken.endsWith("current"));
  }

  void thePictureIsPredicted() {
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("preview-view"), patience);
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(7)).spoken.endsWith("done") && seen.part(step(8)).spoken.endsWith("current"));
  }

  void theShowPlays() {
    QVERIFY(isDark());
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(8)).more == "Playing");
    QTRY_VERIFY_WITH_TIMEOUT(!isDark(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("output-view"), patience);
    // What shines is corrected: the original is another picture.
    const image::Image corrected = settledLight();
    TRY_DO(program_->clickText("Original"));
    QTRY_VERIFY_WITH_TIMEOUT(shining().data() != corrected.data() && !isDark(), patience);
    TRY_DO(program_->clickText("Corrected"));
    QTRY_VERIFY_WITH_TIMEOUT(shining().data() == corrected.data(), patience);
  }

  /// Law: the proof comes first, and only one that passes makes installing the way on.
  void aPhotographProvesIt() {
    SEEN(seen.part("primary").text == "Take verification photograph");
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part("primary").text == "Install show" && seen.part("primary").isEnabled);
    SEEN(seen.says("The surface looks as predicted"));
    QVERIFY(program_->holdsPicture("photograph-view") && program_->holdsPicture("proof-difference"));
    // The show is back.
    TRY_SEEN(seen.part(step(8)).more == "Playing");
    QTRY_VERIFY_WITH_TIMEOUT(!isDark(), patience);
  }

  /// Law: while patterns flash instead of the show, rail, bar and picture say so; then it is back.
  void driftIsCheckedFor() {
    TRY_DO(program_->clickText("Check for drift"));
    TRY_SEEN(seen.part(step(8)).more == "Checking for drift" &&
             !seen.part("hint").text.contains("Nothing is projected") && seen.button("Stop").isEnabled);
    TRY_SEEN(seen.part(step(8)).more == "Playing" && seen.part("primary").text == "Install show");
    QTRY_VERIFY_WITH_TIMEOUT(!isDark(), patience);
  }

  /// Law: a measurement over the show is said where the show is, and not called the show; what is kept of
  /// before goes on.
  void theShowIsMeasuredOver() {
    TRY_DO(program_->click(step(4)));
    TRY_SEEN(seen.part("banner-sentence").text == "A show is playing");
    TRY_DO(program_->clickText("Measure again"));
    TRY_SEEN(seen.part("primary").text == "Start now");
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part(step(4)).more.startsWith("Measuring") &&
             seen.part(step(8)).more == "Covered by Acquire");
    TRY_DO(program_->click(step(8)));
    TRY_SEEN(seen.part("banner-sentence").text == "The projector shows the light of another step: Acquire");
    QVERIFY(!program_->holdsPicture("output-view"));
    TRY_DO(program_->click(step(4)));
    TRY_DO(program_->clickText("Keep the earlier one"));
    TRY_SEEN(seen.dialog() == "Keep the earlier measurement?");
    TRY_DO(program_->clickText("Keep the earlier one"));
    TRY_SEEN(seen.part(step(8)).more == "Playing");
    TRY_DO(program_->click(step(8)));
    TRY_SEEN(seen.part("banner-sentence").text.isEmpty() && seen.part("primary").isEnabled);
    QTRY_VERIFY_WITH_TIMEOUT(program_->holdsPicture("output-view"), patience);
  }

  void theShowIsInstalled() {
    QCOMPARE(installed(), QStringList());
    TRY_DO(program_->click("primary"));
    TRY_SEEN(seen.part("hint").text.startsWith("Installed at ") &&
             seen.part("hint").text.contains("the show starts at the next log-in."));
    QVERIFY(!installed().isEmpty());
    // Done is done: doing it again is not what is offered first.
    SEEN(seen.part("primary").text.isEmpty());
    TRY_DO(program_->clickText("Close output"));
    TRY_SEEN(seen.part(step(8)).spoken.endsWith("done") && seen.part(step(8)).more == "Show installed");
    QTRY_VERIFY_WITH_TIMEOUT(isDark(), patience);
    for (int page = 1; page <= steps; ++page) {
      SEEN(seen.part(step(page)).spoken.endsWith("done"));
      TRY_DO(program_->click(step(page)));
      SEEN(seen.dialog().isEmpty() && seen.part("banner-sentence").text.isEmpty());
      for (int other = 1; other <= steps; ++other) QCOMPARE(amber(step(other)), 0);
      for (const char* part : {"strip-projector", "strip-camera"}) QCOMPARE(amber(part), 0);
    }
    TRY_DO(program_->click("remove-installed"));
    TRY_DO(program_->clickText("Remove"));
    TRY_SEEN(seen.part("install-state").text.startsWith("Once installed"));
    QCOMPARE(installed(), QStringList());
  }

  void theProgramEnds() {
    program_->terminate();
    QVERIFY(program_->hasEnded(patience));
    QCOMPARE(program_->exitCode(), 0);
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork();
  const QTemporaryDir folder;
  SmallDisk disk(folder.filePath("disk").toStdString(), diskBytes);
  QGuiApplication application(argc, argv);
  TestAcceptanceWalk test(disk);
  return QTest::qExec(&test, argc, argv);
}
#include "test_acceptance_walk.moc"
