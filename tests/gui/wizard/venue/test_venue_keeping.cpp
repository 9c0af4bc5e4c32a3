// SPDX-License-Identifier: MIT
// Another name for a venue, and the trash: what leads to it follows, and what is in use stays.
#include "wizard/venue/venue_keeping.h"

#include <QDirIterator>
#include <QMenu>
#include <QSignalSpy>
#include <QStandardPaths>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "output/installation.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/rename_dialog.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_view.h"

using namespace relucent;
using namespace relucent::gui;
namespace fs = std::filesystem;

namespace {

RecentVenue named(const VenuePage& page, const QString& name) {
  for (const RecentVenue& venue : page.recent())
    if (venue.name == name) return venue;
  return {};
}

}  // namespace

class TestVenueKeeping : public QObject {
  Q_OBJECT

  std::unique_ptr<SimulatedSession> own_;
  std::unique_ptr<VenuePage> page_;

  QString config() const { return own_->folder.filePath("config"); }
  QString at(const QString& name) const { return own_->folder.filePath(name); }
  QStringList shownArguments(const QString& venue) const {
    return {"show", venue, "--content", venue + "/playlist.m3u8", "--log", at("Old chapel 2/log")};
  }

 private slots:
  void init() {
    // The trash is the desktop's, of a home of this test, in which nothing was ever trashed.
    own_ = std::make_unique<SimulatedSession>();
    qputenv("XDG_DATA_HOME", own_->folder.filePath("data").toUtf8());
    page_ = std::make_unique<VenuePage>(own_->session, RecentVenues(own_->settings));
    page_->keeping().setConfigFolder(config());
    own_->begin(smallVenue(), "Old chapel");
    writeFileAtomically(own_->path("Old chapel") / "thumbnail.png", "a picture");
    own_->begin(smallVenue(), "Foyer");
  }
  void cleanup() {
    page_.reset();
    own_.reset();
    qunsetenv("XDG_DATA_HOME");
  }

  void aVenueHasItsNewNameEverywhere_data() {
    QTest::addColumn<int>("start");
    QTest::newRow("service") << static_cast<int>(Start::service);
    QTest::newRow("autostart") << static_cast<int>(Start::autostart);
  }
  /// Law: list, thumbnail and installed show lead to it as before; another venue of a similar name does not.
  void aVenueHasItsNewNameEverywhere() {
    QFETCH(int, start);
    const auto kind = static_cast<Start>(start);
    install(kind, config(), "/usr/bin/relucent", shownArguments(at("Old chapel")));
    page_->rename(named(*page_, "Old chapel"), " 100 % \"new\" $ chapel ");
    const QString name = "100 % \"new\" $ chapel";
    const RecentVenue renamed = named(*page_, name);
    QCOMPARE(renamed.folder, at(name));
    QVERIFY(QFile::exists(at(name) + "/thumbnail.png") && !QFile::exists(at("Old chapel")));
    QCOMPARE(page_->recent().size(), 2);
    QCOMPARE(page_->recent().front().name, QString("Foyer"));  // it keeps its place
    QVERIFY(isInstalled(kind, config(), at(name)) &&
            isInstalled(kind, config(), at(name) + "/playlist.m3u8"));
    QVERIFY(!isInstalled(kind, config(), at("Old chapel")));
    QVERIFY(isInstalled(kind, config(), at("Old chapel 2/log")));
    page_->open(renamed.folder);
    QCOMPARE(own_->session.name(), name);
  }

  /// Law: while somebody measures in it, so that nobody may look into it, a venue keeps its picture on the
  /// list.
  void aVenueThatIsMeasuredAgainKeepsItsPicture() {
    QImage picture(24, 18, QImage::Format_RGB32);
    picture.fill(Qt::darkYellow);
    QVERIFY(picture.save(at("Old chapel") + "/thumbnail.png"));
    QCOMPARE(named(*page_, "Old chapel").picture.size(), picture.size());
    const auto measuring = calibration::CalibrationFolder::open(
        own_->path("Old chapel"), calibration::CalibrationFolder::Access::write);
    QCOMPARE(named(*page_, "Old chapel").picture.size(), picture.size());
  }

  void wrongNamesAreSaid_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("none") << " ";
    QTest::newRow("a path") << "a/b";
    QTest::newRow("hidden") << ".chapel";
    QTest::newRow("taken") << "Foyer";
  }
  void wrongNamesAreSaid() {
    QFETCH(QString, name);
    const RecentVenue venue = named(*page_, "Old chapel");
    QVERIFY(!VenueKeeping::nameProblem(venue, name).isEmpty());
    RenameDialog dialog(venue);
    auto* rename = dialog.findChild<QPushButton*>("rename-do");
    QVERIFY(!rename->isEnabled());  // it has that name, and says so in sight
    const auto* why = dialog.findChild<QLabel*>("rename-why-not");
    QVERIFY(!why->text().isEmpty() && rename->accessibleDescription() == why->text());
    dialog.findChild<QLineEdit*>("rename-name")->setText(name);
    QVERIFY(!rename->isEnabled());
    QSignalSpy told(page_.get(), &PageModel::failed);
    page_->rename(venue, name);
    QCOMPARE(told.size(), 1);
    QVERIFY(QFile::exists(venue.folder));
    QSignalSpy chosen(&dialog, &RenameDialog::chosen);
    dialog.findChild<QLineEdit*>("rename-name")->setText(" Nave ");
    QVERIFY(rename->isEnabled());
    rename->click();
    QCOMPARE(chosen.at(0).at(0).toString(), QString("Nave"));
  }

  /// Law: nothing goes before somebody has agreed, and it can be taken back.
  void aVenueGoesToTheTrashOnceSomebodyAgrees() {
    const RecentVenue venue = named(*page_, "Old chapel");
    QList<FailureReport> asked;
    connect(page_.get(), &PageModel::failed, this, [&](const FailureReport& report) { asked << report; });
    page_->askToRemove(venue);
    QCOMPARE(asked.size(), 1);
    QVERIFY(asked.front().isQuestion && !asked.front().endsWork);
    QVERIFY(asked.front().failure.what.contains("Old chapel"));
    asked.front().resume->trigger();
    QVERIFY(QFile::exists(venue.folder));
    page_->askToRemove(venue);
    asked.back().goOn->trigger();
    QCOMPARE(asked.size(), 2);
    QVERIFY(!QFile::exists(venue.folder));
    QVERIFY(named(*page_, "Old chapel").name.isEmpty());
    QStringList trashed;
    for (QDirIterator all(at("data/Trash"), QDir::Files, QDirIterator::Subdirectories); all.hasNext();)
      trashed << all.next();
    QVERIFY2(!trashed.filter("calibration.relucent").isEmpty(), qPrintable(trashed.join(' ')));
    // What came of an answer that was given is not done once more.
    QCOMPARE(page_->recent().size(), 1);
  }

  void whatIsInUseStays_data() {
    QTest::addColumn<QString>("use");
    QTest::addColumn<bool>("mayBeRenamed");
    QTest::newRow("open here") << "open" << false;
    QTest::newRow("measured here") << "measured" << false;
    QTest::newRow("its show starts at log-in") << "installed" << true;
  }
  void whatIsInUseStays() {
    QFETCH(QString, use);
    QFETCH(bool, mayBeRenamed);
    const RecentVenue venue = named(*page_, use == "installed" ? "Old chapel" : "Foyer");
    DeviceLease lease;
    if (use == "measured") lease = own_->session.leaseDevices(VenuePage::stepName, DeviceWork::measurement);
    if (use == "installed")
      install(Start::autostart, config(), "/usr/bin/relucent", shownArguments(venue.folder));
    QCOMPARE(page_->keeping().whyNotRenamed(venue).isEmpty(), mayBeRenamed);
    QVERIFY(!page_->keeping().whyNotRemoved(venue).isEmpty());
    QSignalSpy told(page_.get(), &PageModel::failed);
    page_->askToRemove(venue);
    told.at(0).at(0).value<FailureReport>().goOn->trigger();
    QCOMPARE(told.size(), 2);
    QVERIFY(QFile::exists(venue.folder));
  }

  /// Law: whoever works on it does not lose the ground under his feet.
  void anotherProgramsWorkIsLeftAlone() {
    const RecentVenue venue = named(*page_, "Old chapel");
    const calibration::CalibrationFolder theirs = calibration::CalibrationFolder::open(
        venue.folder.toStdString(), calibration::CalibrationFolder::Access::write);
    QVERIFY_EXCEPTION_THROWN(page_->keeping().rename(venue, "Nave"), Error);
    QVERIFY_EXCEPTION_THROWN(page_->keeping().remove(venue), Error);
    QVERIFY(QFile::exists(venue.folder));
  }

  void theListOffersBoth() {
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    stage->show();
    const QList<QPushButton*> more = stage->findChildren<QPushButton*>("more");
    QCOMPARE(more.size(), 2);
    for (const QPushButton* button : more) {
      Q_EMIT button->menu()->aboutToShow();
      const bool isOpen = button->accessibleName().contains("Foyer");
      for (const char* name : {"rename", "remove"}) {
        const auto* action = button->menu()->findChild<QAction*>(name);
        QCOMPARE(action->isEnabled(), !isOpen);
      }
      // In sight, once for both.
      const QList<QAction*> reasons = button->menu()->findChildren<QAction*>("reason");
      QCOMPARE(reasons.size(), isOpen ? 1 : 0);
      if (isOpen) QVERIFY(reasons.front()->text().contains("open") && !reasons.front()->isEnabled());
    }
  }
};

QTEST_MAIN(TestVenueKeeping)
#include "test_venue_keeping.moc"
