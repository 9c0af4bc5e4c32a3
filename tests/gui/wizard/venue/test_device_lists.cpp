// SPDX-License-Identifier: MIT
// A new venue of several projectors and cameras, on a desktop of four screens.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/screen_devices.h"
#include "wizard/devices/camera_rows.h"
#include "wizard/venue/device_list_view.h"
#include "wizard/venue/network_list_view.h"
#include "wizard/venue/screen_list.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"
#include "wizard/venue/venue_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::pipeline;

namespace {

devices::ListedCamera cameraOf(const char* address) {
  devices::ListedCamera camera;
  camera.address = address;
  camera.model = Message::plain(address);
  camera.usable = true;
  camera.traits.size = {640, 480};
  camera.traits.format.bits = 12;
  camera.traits.exposures = {1e-4, 4.0};
  return camera;
}

/// "HDMI-1 DP-1"
QString connectorsOf(const VenuePage& page) {
  QStringList connectors;
  for (const auto& screen : page.projectors()) connectors << QString::fromStdString(screen.display.connector);
  return connectors.join(' ');
}

ScreenChoice choiceOf(const VenuePage& page, const char* connector) {
  for (const ScreenChoice& choice : page.screensToChoose())
    if (choice.display.connector == connector) return choice;
  return {};
}

}  // namespace

class TestDeviceLists : public QObject {
  Q_OBJECT

  std::unique_ptr<SimulatedSession> own_;
  std::unique_ptr<VenuePage> page_;

 private slots:
  void init() {
    QCOMPARE(QGuiApplication::screens().size(), 4);
    QCOMPARE(QGuiApplication::primaryScreen()->name(), QString("DP-0"));
    own_ = std::make_unique<SimulatedSession>();
    page_ = std::make_unique<VenuePage>(own_->session, RecentVenues(own_->settings));
    page_->setFolder(own_->folder.path());
    page_->finder().setLister(
        [] { return devices::CameraList{{}, {cameraOf("genicam:1"), cameraOf("genicam:2")}}; });
    page_->setMode(VenuePage::Mode::devices);
    QTRY_COMPARE(page_->finder().cameras().cameras.size(), std::size_t{2});
  }
  void cleanup() {
    page_.reset();
    own_.reset();
  }

  /// Where there is no camera it is said what could be one, and how another is driven.
  void withoutACameraThereIsAWayOn() {
    page_->finder().setLister([] { return devices::CameraList(); });
    CameraRows rows(
        page_->finder(), {}, [](const devices::ListedCamera&, const QString&) { return CameraRows::Offer{}; },
        [](const devices::ListedCamera&) {});
    const auto words = [&rows] {
      QString all;
      for (const QLabel* label : rows.findChildren<QLabel*>())
        if (!label->isHidden()) all += label->text() + '\n';
      return all;
    };
    QVERIFY2(!words().contains("GigE Vision"), qPrintable(words()));
    page_->finder().look();
    QTRY_VERIFY2(words().contains("GigE Vision"), qPrintable(words()));
    QVERIFY2(words().contains(VenuePage::tr("New venue by script")), qPrintable(words()));

    const std::unique_ptr<QWidget> stage(devicesStage(*page_));
    auto* another = stage->findChild<QPushButton*>("another-camera");
    QVERIFY(another != nullptr);
    another->click();
    QCOMPARE(page_->mode(), VenuePage::Mode::script);
  }

  /// Law: Tab comes to every camera, right after what looks for them, whenever they were found.
  void camerasAreReachedByTab() {
    const std::unique_ptr<QWidget> stage(devicesStage(*page_));
    new QPushButton("behind", stage.get());
    page_->finder().look();
    QTRY_VERIFY(!page_->finder().isLooking());
    QWidget* next = stage->findChild<QPushButton*>("look-for-cameras");
    const auto reached = [&next] {
      do next = next->nextInFocusChain();
      while ((next->focusPolicy() & Qt::TabFocus) == 0 || next->isHidden() || !next->isEnabled());
      return qobject_cast<QPushButton*>(next);
    };
    for (int camera = 0; camera < 2; ++camera) {
      const QPushButton* button = reached();
      QVERIFY(button != nullptr);
      QCOMPARE(button->text(), VenuePage::tr("Add"));
    }
  }

  /// Law: a screen needs no program to show on it, and then no more is asked of the projector.
  void aScreenGoesWithACameraByCommand() {
    page_->setMode(VenuePage::Mode::script);
    page_->setRoomClear(true);
    QVERIFY2(page_->problem().contains("screen"), qPrintable(page_->problem()));
    QVERIFY(page_->remedy() == VenuePage::Remedy::screen);
    page_->chooseScriptScreen(choiceOf(*page_, "HDMI-1"));
    QVERIFY(page_->isScriptOnScreen());
    QVERIFY2(page_->problem().contains("camera"), qPrintable(page_->problem()));
    CommandRigSettings script = page_->script();
    script.cameraCommand = "shoot {exposure} {output}";
    page_->setScript(script);
    QCOMPARE(page_->problem(), QString());
    script.projectorCommand = "show {image}";
    page_->setScript(script);
    QVERIFY(!page_->isScriptOnScreen());
    script.projectorCommand = " ";
    page_->setScript(script);
    page_->primary()->trigger();
    const ScreenRigSettings* rig = own_->session.screenRig();
    QVERIFY(rig != nullptr);
    QCOMPARE(rig->display.connector, std::string("HDMI-1"));
    QCOMPARE(rig->cameraAddress, std::string("command:shoot {exposure} {output}"));
    // Its command can be changed, and its screen.
    QCOMPARE(page_->openPrograms().typed(), std::vector<std::string>{"shoot {exposure} {output}"});
    QCOMPARE(page_->openPrograms().projectors(), std::size_t{0});
  }

  /// Law: with one projector another screen takes the place of the one before.
  void oneProjectorHasTheScreenThatIsChosen() {
    QVERIFY(page_->projectors().empty() && !page_->mayAddProjector());
    page_->chooseScreen(choiceOf(*page_, "HDMI-1"));
    page_->chooseScreen(choiceOf(*page_, "DP-1"));
    QCOMPARE(connectorsOf(*page_), QString("DP-1"));
    QCOMPARE(page_->screen().projector, Size({1920, 1080}));
    QVERIFY(page_->screen().moreScreens.empty());
  }

  /// Law: every projector has a screen of its own; one that is removed frees its screen, and the others stay
  /// with their names.
  void projectorsAreAddedNamedAndRemoved() {
    page_->chooseScreen(choiceOf(*page_, "HDMI-2"));
    page_->addProjector();
    page_->addProjector();
    QCOMPARE(connectorsOf(*page_), QString("HDMI-2 DP-1 HDMI-1"));
    QVERIFY(!page_->mayAddProjector());  // the operator's own is left
    page_->addProjector();
    QCOMPARE(page_->projectors().size(), std::size_t{3});
    QCOMPARE(page_->projector(), std::size_t{2});
    QVERIFY(!choiceOf(*page_, "DP-1").refusal.isEmpty());
    page_->chooseScreen(choiceOf(*page_, "DP-1"));  // is another one's
    QVERIFY(connectorsOf(*page_).endsWith("HDMI-1"));
    page_->nameProjector(0, " Left ");
    page_->nameProjector(2, "Right");
    page_->removeProjector(1);
    QCOMPARE(connectorsOf(*page_), QString("HDMI-2 HDMI-1"));
    QCOMPARE(page_->projectors()[0].name, std::string("Left"));
    QCOMPARE(page_->projectors()[1].name, std::string("Right"));
    QVERIFY(choiceOf(*page_, "DP-1").refusal.isEmpty());
    page_->selectProjector(0);
    page_->chooseScreen(choiceOf(*page_, "DP-1"));
    QCOMPARE(connectorsOf(*page_), QString("DP-1 HDMI-1"));
    QCOMPARE(page_->projectors()[0].name, std::string("Left"));
  }

  /// Law: an address stays with its projector.
  void projectorsOnTheNetworkGoIntoTheCalibration() {
    page_->chooseScreen(choiceOf(*page_, "HDMI-2"));
    page_->addProjector();
    page_->addProjector();
    page_->network().setAddress(0, "10.0.0.1");
    page_->network().setAddress(2, " left.venue:4400 ");
    page_->network().setPassword(2, "secret");
    page_->setRoomClear(true);
    QCOMPARE(page_->problem(), QString());
    page_->removeProjector(1);
    QCOMPARE(page_->network().address(1), QString("left.venue:4400"));
    page_->network().setAddress(0, "10.0.0");
    page_->network().setAddress(0, "not an address");
    QVERIFY2(page_->problem().contains("not an address"), qPrintable(page_->problem()));
    page_->network().setAddress(0, "");
    QCOMPARE(page_->problem(), QString());
    page_->primary()->trigger();
    QVERIFY(own_->session.isOpen());
    NetworkProjectors wanted;
    wanted.addresses[1] = {"left.venue", 4400, "secret"};
    QVERIFY(own_->session.settings().network == wanted);
    QCOMPARE(page_->network().address(1), QString());
  }

  void twoProjectorsAtOneAddressAreASentence() {
    page_->chooseScreen(choiceOf(*page_, "HDMI-2"));
    page_->addProjector();
    page_->setRoomClear(true);
    page_->network().setAddress(0, "10.0.0.1");
    page_->network().setAddress(1, "10.0.0.1");
    QVERIFY2(page_->problem().contains("same address"), qPrintable(page_->problem()));
  }

  void projectorsAreFoundAndChosen() {
    page_->chooseScreen(choiceOf(*page_, "HDMI-2"));
    page_->addProjector();
    page_->network().setSearcher([] {
      return std::vector<pjlink::Found>{{{"10.0.0.7"}, "01:23:45:67:89:ab"},
                                        {{"10.0.0.8"}, "01:23:45:67:89:ac"}};
    });
    const std::unique_ptr<QWidget> list(networkList(*page_));
    list->show();
    auto* address = list->findChild<QComboBox*>("projector-address-2");
    auto* password = list->findChild<QLineEdit*>("projector-password-2");
    QVERIFY(address != nullptr && password != nullptr);
    QVERIFY(!password->isVisible() && password->echoMode() == QLineEdit::Password);
    QVERIFY(address->accessibleName().contains("2"));
    address->setEditText("10.0.0.1");
    QTRY_VERIFY(password->isVisible());
    list->findChild<QPushButton*>("find-projectors")->click();
    QTRY_COMPARE(address->count(), 2);
    QCOMPARE(address->currentText(), QString("10.0.0.1"));  // what was typed stays
    QTRY_VERIFY(list->findChild<QLabel*>("projectors-found")->text().contains("2"));
    address->setCurrentIndex(1);
    QCOMPARE(page_->network().address(1), QString("10.0.0.8"));
    QTest::keyClicks(password, "secret");
    QCOMPARE(page_->network().password(1), QString("secret"));
  }

  void camerasAreAddedNamedAndRemoved() {
    page_->addCamera("genicam:1");
    page_->addCamera("genicam:2");
    page_->addCamera("genicam:1");  // is there
    QCOMPARE(page_->cameras().size(), std::size_t{2});
    page_->nameCamera(1, "Door");
    page_->removeCamera("genicam:1");
    QCOMPARE(page_->cameras().size(), std::size_t{1});
    QCOMPARE(page_->screen().cameraAddress, std::string("genicam:2"));
    QCOMPARE(page_->screen().cameraName, std::string("Door"));
    QVERIFY(!page_->hasCamera("genicam:1") && page_->hasCamera("genicam:2"));
  }

  /// Law: more devices are more work, and a venue that is begun has them all, by their names.
  void whatIsBegunHasThem() {
    page_->chooseScreen(choiceOf(*page_, "HDMI-1"));
    const WorkLeft one = page_->expected();
    page_->addCamera("genicam:1");
    page_->addProjector();
    page_->addCamera("genicam:2");
    QVERIFY(page_->expected().shots > one.shots && page_->expected().diskBytes > one.diskBytes);
    page_->nameProjector(1, "Right");
    page_->nameCamera(1, "Door");
    page_->setRoomClear(true);
    QVERIFY2(page_->problem().isEmpty(), qPrintable(page_->problem()));
    page_->primary()->trigger();
    const Session& session = own_->session;
    QVERIFY(session.isOpen());
    QCOMPARE(session.projectors(), std::size_t{2});
    QCOMPARE(session.cameras(), std::size_t{2});
    QCOMPARE(session.projectorName(1), QString("Right"));
    QCOMPARE(session.cameraName(1), QString("Door"));
    QVERIFY(session.projectorName(0).isEmpty());
    QCOMPARE(session.screenOf(1)->display.connector, std::string("DP-1"));
    QVERIFY(!session.screenOf(2));
    QCOMPARE(page_->status().result, VenuePage::tr("%1, %2").arg(VenuePage::tr("%n projector(s)", nullptr, 2),
                                                                 VenuePage::tr("%n camera(s)", nullptr, 2)));
  }

  /// Law: rows are reached by Tab, say what they are, and the one with the focus is the one that screens are
  /// chosen for.
  void rowsAreNamedAndKeepTheFocus() {
    std::unique_ptr<QWidget> list(projectorList(*page_));
    list->show();
    page_->chooseScreen(choiceOf(*page_, "HDMI-1"));
    page_->addProjector();
    const auto lines = list->findChildren<QLineEdit*>();
    QCOMPARE(lines.size(), 2);
    for (int i = 0; i < 2; ++i) {
      const QString name = VenuePage::tr("Projector %1").arg(i + 1);
      QCOMPARE(lines[i]->accessibleName(), VenuePage::tr("Name of %1").arg(name));
      QCOMPARE(lines[i]->placeholderText(), name);
    }
    lines[0]->setFocus();
    QTRY_COMPARE(page_->projector(), std::size_t{0});
    QTest::keyClicks(lines[0], "Left wall");
    QCOMPARE(page_->projectors()[0].name, std::string("Left wall"));
    QVERIFY(lines[0]->hasFocus());
    for (const QToolButton* remove : list->findChildren<QToolButton*>())
      QVERIFY(!remove->accessibleName().isEmpty());
  }
};

QTEST_MAIN(TestDeviceLists)
#include "test_device_lists.moc"
