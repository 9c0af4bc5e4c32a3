// SPDX-License-Identifier: MIT
// A venue of a stranger names programs as its devices: none of them runs before somebody has agreed.
#include <QLineEdit>
#include <QSignalSpy>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/measuring.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_view.h"

using namespace relucent;
using namespace relucent::gui;
namespace fs = std::filesystem;

class TestVenuePrograms : public QObject {
  Q_OBJECT

  std::unique_ptr<SimulatedSession> own_;
  std::unique_ptr<VenuePage> page_;

  /// As the wizard asks, when it is started.
  void askAsStarted() const { devices::askForConsent({own_->path("kept") / "commands", {}, {}}); }
  pipeline::CommandRigSettings script() const {
    pipeline::CommandRigSettings rig;
    rig.projectorCommand = "show\u202e {image}";
    rig.cameraCommand = "touch " + own_->path("trace").string() + "; shoot {exposure} {output}";
    rig.projector = {16, 12};
    rig.camera = Size{12, 9};
    return rig;
  }

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    page_ = std::make_unique<VenuePage>(own_->session, RecentVenues(own_->settings));
    pipeline::CalibrateSettings settings;
    settings.rig = script();
    pipeline::beginCalibration(own_->path("Stranger's"), settings);
    askAsStarted();
  }
  void cleanup() {
    devices::askForNoConsent();
    page_.reset();
    own_.reset();
  }

  void asksBeforeItOpens_data() {
    QTest::addColumn<bool>("allowed");
    QTest::newRow("allowed") << true;
    QTest::newRow("opened without") << false;
  }
  /// Law: the question names what would run, hiding nothing; opened without, it asks again the next time.
  void asksBeforeItOpens() {
    QFETCH(bool, allowed);
    const QString venue = own_->folder.filePath("Stranger's");
    QSignalSpy asked(page_.get(), &PageModel::failed);
    page_->open(venue);
    QCOMPARE(asked.size(), 1);
    QVERIFY(!own_->session.isOpen());
    const auto question = asked.front().front().value<FailureReport>();
    QVERIFY(question.isQuestion && question.goOn != nullptr && question.resume != nullptr);
    QVERIFY(question.failure.what.contains("touch ") && question.failure.what.contains("show\ufffd {image}"));
    (allowed ? question.goOn : question.resume)->trigger();
    QVERIFY(own_->session.isOpen());
    QCOMPARE(own_->session.name(), QString("Stranger's"));
    QCOMPARE(devices::withoutConsent(pipeline::commandsOf(script())).empty(), allowed);
    QVERIFY(!fs::exists(own_->path("trace")));
    askAsStarted();
    page_->open(venue);
    QCOMPARE(asked.size(), allowed ? 1 : 2);
  }

  /// Law: whoever types a command for a venue of his own is not asked.
  void whoTypesItAgrees() {
    own_->session.setFlashLimit(3);
    page_->setFolder(own_->folder.filePath("own"));
    page_->setMode(VenuePage::Mode::script);
    page_->setScript(script());
    page_->primary()->trigger();
    QVERIFY(own_->session.isOpen());
    askAsStarted();
    QSignalSpy asked(page_.get(), &PageModel::failed);
    page_->open(own_->folder.filePath("Stranger's"));
    QCOMPARE(asked.size(), 0);
  }

  /// Law: another command takes the place of one that fails, whatever was measured; who types it agrees.
  void commandsAreChangedLater() {
    page_->open(own_->folder.filePath("Stranger's"));
    devices::giveConsent(pipeline::commandsOf(script()));
    page_->open(own_->folder.filePath("Stranger's"));
    QVERIFY(own_->session.isOpen());
    QVERIFY(page_->secondary().size() == 1 && page_->secondary().front()->isEnabled());
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    page_->secondary().front()->trigger();
    QVERIFY(page_->mode() == VenuePage::Mode::programs && page_->isOfOpenVenue());
    QVERIFY(!page_->primary()->isEnabled());
    auto* shows = stage->findChild<QLineEdit*>("program-1");
    auto* photographs = stage->findChild<QLineEdit*>("program-2");
    QVERIFY(shows != nullptr && photographs != nullptr);
    QCOMPARE(photographs->text(), QString::fromStdString(script().cameraCommand));
    photographs->clear();
    QTest::keyClicks(photographs, "shoot {exposure}");
    QVERIFY2(page_->problem().contains("{output}"), qPrintable(page_->problem()));
    QTest::keyClicks(photographs, " {output}");
    QCOMPARE(page_->problem(), QString());
    page_->primary()->trigger();
    QVERIFY(page_->mode() == VenuePage::Mode::start);
    const std::vector<std::string> now{script().projectorCommand, "shoot {exposure} {output}"};
    QCOMPARE(pipeline::commandsOf(own_->session.settings().rig), now);
    QVERIFY(devices::withoutConsent(now).empty());
    DeviceLease lease = own_->session.leaseDevices(VenuePage::stepName);
    QVERIFY(page_->secondary().empty());
  }

  void aVenueWithoutProgramsOffersNone() {
    own_->begin();
    QVERIFY(page_->secondary().empty());
  }

  void commandsOfRigs() {
    QVERIFY(pipeline::commandsOf(smallVenue().rig).empty());
    pipeline::CommandRigSettings rig = script();
    rig.cameraAddress = "command:other {exposure} {output}";
    rig.moreCameras.push_back({.command = {}, .address = "genicam:40012345"});
    rig.moreProjectors.push_back({"second {image}", {8, 8}});
    QCOMPARE(pipeline::commandsOf(rig),
             (std::vector<std::string>{rig.projectorCommand, "second {image}", "other {exposure} {output}"}));
    pipeline::ScreenRigSettings screen;
    screen.cameraAddress = "command:third {exposure} {output}";
    QCOMPARE(pipeline::commandsOf(screen), std::vector<std::string>{"third {exposure} {output}"});
  }
};

QTEST_MAIN(TestVenuePrograms)
#include "test_venue_programs.moc"
