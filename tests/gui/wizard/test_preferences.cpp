// SPDX-License-Identifier: MIT
// What the user prefers, and what follows from it for real devices.
#include "wizard/frame/preferences.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "wizard/acquire/acquire_page.h"
#include "wizard/linearize/linearize_page.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::venue;

class TestPreferences : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

 private slots:
  void theyAreThereAgain() {
    QString file = folder_.filePath("settings.ini");
    {
      QSettings settings(file, QSettings::IniFormat);
      Preferences preferences(settings);
      QVERIFY(!preferences.isLight() && !preferences.isDimmed() && preferences.hasSound());
      QCOMPARE(preferences.flashLimit(), 0);
      QVERIFY(!preferences.folder().isEmpty());
      QSignalSpy changed(&preferences, &Preferences::changed);
      preferences.setLight(true);
      preferences.setLight(true);
      QCOMPARE(changed.size(), 1);
      preferences.setSound(false);
      preferences.setFlashLimit(2);
      preferences.setFolder("/venues");
    }
    QSettings settings(file, QSettings::IniFormat);
    Preferences preferences(settings);
    QVERIFY(preferences.isLight() && !preferences.hasSound());
    QCOMPARE(preferences.flashLimit(), 2);
    QCOMPARE(preferences.folder(), QString("/venues"));
    settings.setValue("measuring/changes_per_second", 90);  // by hand
    QCOMPARE(preferences.flashLimit(), 3);
  }

  void realDevicesMeasureAfterAConsentOnly() {
    Session session{std::filesystem::path(folder_.filePath("cache").toStdString())};
    LinearizePage linearize(session);
    AcquirePage acquire(session);
    CalibrateSettings settings;
    CommandRigSettings script{"show {image}", "photograph {exposure} {output}", {64, 48}, Size{48, 36}};
    settings.rig = script;
    session.begin(folder_.filePath("real").toStdString(), settings);
    QVERIFY(session.needsConsent());
    QVERIFY(!linearize.primary()->isEnabled() && !acquire.primary()->isEnabled());
    QCOMPARE(linearize.hint(), LinearizePage::tr("Confirm that the room is clear: the patterns flash."));
    session.setRoomClear(true);
    QVERIFY(linearize.primary()->isEnabled() && acquire.primary()->isEnabled());
    // It is asked for each time.
    session.open(session.path());
    QVERIFY(!linearize.primary()->isEnabled());
    // Three changes a second harm nobody.
    session.setFlashLimit(3);
    QVERIFY(!session.needsConsent() && linearize.primary()->isEnabled());
    session.setFlashLimit(0);
    settings.rig = VenueSettings();
    session.begin(folder_.filePath("simulated").toStdString(), settings);
    QVERIFY(!session.needsConsent() && linearize.primary()->isEnabled());
  }
};

QTEST_MAIN(TestPreferences)
#include "test_preferences.moc"
