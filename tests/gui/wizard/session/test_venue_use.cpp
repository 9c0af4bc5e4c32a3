// SPDX-License-Identifier: MIT
// Who uses a venue, told among the programs of one computer.
#include "output/venue_use.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QDir>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>

#include "gui/wizard/simulated_session.h"
#include "relucent/base/error.h"
#include "wizard/session/missing_screen.h"

using namespace relucent;
using namespace relucent::gui;
namespace fs = std::filesystem;

using Way = VenueUse::Way;

class TestVenueUse : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path venue_;

  /// Another program that shows `venue`. Asked to end it does so when `isPatient` is false; it must be
  /// reaped.
  static pid_t startShow(const fs::path& venue, bool isPatient) {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t other = fork();
    if (other == 0) {
      if (isPatient) signal(SIGTERM, SIG_IGN);
      const auto use = VenueUse::take(venue, Way::show);
      const char answer = use ? 'y' : 'n';
      [[maybe_unused]] const auto written = write(ready[1], &answer, 1);
      for (;;) pause();
    }
    char answer = 0;
    const bool isShowing = read(ready[0], &answer, 1) == 1 && answer == 'y';
    close(ready[0]);
    close(ready[1]);
    return isShowing ? other : -1;
  }

 private slots:
  void initTestCase() {
    QStandardPaths::setTestModeEnabled(true);
    venue_ = folder_.filePath("venue").toStdString();
    fs::create_directory(venue_);
  }

  void oneUsesItAtATime() {
    QVERIFY(!VenueUse::isTaken(venue_, Way::wizard));
    {
      const auto first = VenueUse::take(venue_, Way::wizard);
      QVERIFY(first && !VenueUse::take(venue_, Way::wizard));
      QVERIFY(VenueUse::isTaken(venue_, Way::wizard) && VenueUse::isTaken(venue_, Way::wizard));
    }
    QVERIFY(!VenueUse::isTaken(venue_, Way::wizard));
    QVERIFY(VenueUse::take(venue_, Way::wizard).has_value());
  }

  void waysAndVenuesAreApart() {
    const auto wizard = VenueUse::take(venue_, Way::wizard);
    QVERIFY(!VenueUse::isTaken(venue_, Way::show));
    QVERIFY(VenueUse::take(venue_, Way::show).has_value());
    QVERIFY(VenueUse::take(folder_.filePath("other").toStdString(), Way::wizard).has_value());
  }

  void itIsTheSameVenueHoweverItIsNamed_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("ends in a separator") << folder_.filePath("venue/");
    QTest::newRow("by the way") << folder_.filePath("venue/../venue/.");
    QTest::newRow("from here") << QDir::current().relativeFilePath(folder_.filePath("venue"));
    QTest::newRow("by a link") << folder_.filePath("link");
  }
  void itIsTheSameVenueHoweverItIsNamed() {
    QFETCH(QString, name);
    if (!QFile::exists(folder_.filePath("link")))
      fs::create_symlink(venue_, folder_.filePath("link").toStdString());
    const auto use = VenueUse::take(venue_, Way::wizard);
    QVERIFY(VenueUse::isTaken(name.toStdString(), Way::wizard));
  }

  void whoEndsUsesNothing_data() {
    QTest::addColumn<bool>("isAsked");
    QTest::newRow("killed") << false;
    QTest::newRow("asked to end") << true;
  }
  void whoEndsUsesNothing() {
    QFETCH(bool, isAsked);
    QVERIFY(!VenueUse::end(venue_, Way::show));
    const pid_t other = startShow(venue_, false);
    QVERIFY(other > 0);
    QVERIFY(VenueUse::isTaken(venue_, Way::show));
    QVERIFY(!VenueUse::end(venue_, Way::wizard));
    QVERIFY(isAsked ? VenueUse::end(venue_, Way::show) : kill(other, SIGKILL) == 0);
    int status = 0;
    QCOMPARE(waitpid(other, &status, 0), other);
    QCOMPARE(WTERMSIG(status), isAsked ? SIGTERM : SIGKILL);
    QVERIFY(!VenueUse::isTaken(venue_, Way::show));
    QVERIFY(!VenueUse::end(venue_, Way::show));
  }

  void aSecondWizardDoesNotOpenIt() {
    SimulatedSession first;
    first.begin();
    Session second(first.path("cache"));
    const auto sentence = [&] {
      try {
        second.open(first.path("venue"));
      } catch (const Error& error) {
        return QString(error.what());
      }
      return QString();
    };
    QVERIFY2(sentence().contains("open in another window"), qPrintable(sentence()));
    QVERIFY(!second.isOpen());
    first.session.open(first.path("venue"));  // again, where it is open already
    first.session.open(first.path("venue") / calibration::CalibrationFolder::manifestName);
    QVERIFY(first.session.isOpen() && !sentence().isEmpty());
    first.begin(smallVenue(), "next");
    QCOMPARE(sentence(), QString());
    QVERIFY(second.isOpen());
    second.close();
    first.session.open(first.path("venue"));
    QVERIFY(first.session.isOpen());
  }

  void aShowBesideTheWizardIsKnown() {
    SimulatedSession venue;
    venue.begin();
    QVERIFY(!venue.session.isShownElsewhere());
    QSignalSpy told(&venue.session, &Session::devicesChanged);
    {
      const auto show = VenueUse::take(venue.path("venue"), Way::show);
      const std::weak_ptr<SessionDevices> held = venue.session.devices();
      QTRY_VERIFY_WITH_TIMEOUT(venue.session.isShownElsewhere(), patience);
      QCOMPARE(told.size(), 1);
      // The show wants its camera at night: none is held for later, nor after it was used.
      QVERIFY(held.expired());
      DeviceLease lease = venue.session.leaseDevices({"camera", "", "Camera"});
      const std::weak_ptr<SessionDevices> used = venue.session.devices();
      QVERIFY(!used.expired());
      lease.release();
      QVERIFY(used.expired() && venue.session.devices());
      told.clear();
      Session another(venue.path("cache"));
      another.begin(venue.path("next"), smallVenue());
      QVERIFY(!another.isShownElsewhere());
    }
    QTRY_VERIFY_WITH_TIMEOUT(!venue.session.isShownElsewhere(), patience);
    QCOMPARE(told.size(), 1);
  }

  /// Law: a projector has one picture, whichever venue it is measured for.
  void aShowOfAnotherVenueOnItsScreenIsKnown() {
    pipeline::ScreenRigSettings rig;
    rig.display.connector = "HDMI-7";
    rig.projector = {48, 36};
    rig.camera = {40, 30};
    rig.cameraAddress = "genicam:nowhere";
    pipeline::CalibrateSettings settings = smallVenue();
    settings.rig = rig;
    SimulatedSession venue;
    venue.begin(settings);
    QVERIFY(!venue.session.isShownElsewhere());
    {
      const auto other = VenueUse::take(VenueUse::ofScreen("HDMI-8"), Way::screen);
      const auto show = VenueUse::take(VenueUse::ofScreen("HDMI-7"), Way::screen);
      QVERIFY(other && show);
      QTRY_VERIFY_WITH_TIMEOUT(venue.session.isAnotherVenueShown(), patience);
      QVERIFY(venue.session.isShownElsewhere());
      // Nothing shines on a screen that is not there.
      QCOMPARE(missingScreen(venue.session), QString("HDMI-7"));
      // Its own show is what is said of it where both are there.
      const auto own = VenueUse::take(venue.path("venue"), Way::show);
      QTRY_VERIFY_WITH_TIMEOUT(!venue.session.isAnotherVenueShown(), patience);
      QVERIFY(venue.session.isShownElsewhere());
    }
    QTRY_VERIFY_WITH_TIMEOUT(!venue.session.isShownElsewhere(), patience);
  }

  /// Law: between being asked and having ended, a show is said to end.
  void aShowThatEndsIsSaidTo() {
    SimulatedSession venue;
    venue.begin();
    const pid_t show = startShow(venue.path("venue"), true);
    QVERIFY(show > 0);
    QTRY_VERIFY_WITH_TIMEOUT(venue.session.isShownElsewhere(), patience);
    QVERIFY(!venue.session.isOtherShowEnding());
    QSignalSpy told(&venue.session, &Session::devicesChanged);
    venue.session.endOtherShow();
    QVERIFY(venue.session.isOtherShowEnding());
    QCOMPARE(told.size(), 1);
    QCOMPARE(kill(show, SIGKILL), 0);
    QCOMPARE(waitpid(show, nullptr, 0), show);
    QTRY_VERIFY_WITH_TIMEOUT(!venue.session.isShownElsewhere(), patience);
    QVERIFY(!venue.session.isOtherShowEnding());
  }
};

QTEST_GUILESS_MAIN(TestVenueUse)
#include "test_venue_use.moc"
