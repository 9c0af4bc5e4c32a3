// SPDX-License-Identifier: MIT
// Sets in Preview: saved, used, renamed and removed; what is changed is changed in one of them alone.
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/sets.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/preview_view.h"
#include "wizard/preview/set_name_dialog.h"

using namespace relucent;
using namespace relucent::gui;

class TestPreviewSets : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  std::unique_ptr<PreviewPage> page_;
  PageView shown_{};

  template <typename Widget>
  Widget* part(const char* name) const {
    return shown_.inspector->findChild<Widget*>(name);
  }
  void settle() { QTRY_VERIFY_WITH_TIMEOUT(page_->preview() && !page_->isComputing(), patience); }
  void setDarkShare(double percent) {
    pipeline::ContentSettings after = page_->settings();
    after.reachablePercentile = percent;
    page_->setSettings(after);
    settle();
  }
  /// Of the calibration, as it is on disk.
  pipeline::TargetSets kept() const {
    return pipeline::setsOf(calibration::CalibrationFolder::open(
        own_.session.path(), calibration::CalibrationFolder::Access::read));
  }
  double keptDarkShare(const std::string& set) const {
    for (const pipeline::TargetSet& one : kept().all)
      if (one.name == set) return one.content.reachablePercentile;
    return -1.0;
  }
  /// By the dialog, as somebody types it.
  void nameBy(const char* action, const QString& name) {
    part<QAction>(action)->trigger();
    auto* dialog = shown_.inspector->window()->findChild<SetNameDialog*>();
    QVERIFY(dialog != nullptr);
    dialog->findChild<QLineEdit*>("set-name")->setText(name);
    dialog->findChild<QPushButton*>("set-do")->click();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({32, 24}, {28, 21}, 5), own_.path("cache"), silent);
    page_ = std::make_unique<PreviewPage>(own_.session);
    shown_ = viewOf(*page_);
    shown_.inspector->show();
    own_.session.open(own_.path("venue"));
    page_->enter();
    settle();
  }
  void cleanupTestCase() {
    delete shown_.stage;
    delete shown_.inspector;
    page_.reset();
  }

  void setsAreMadeUsedAndLeftAlone() {
    auto* box = part<QComboBox>("set");
    QCOMPARE(box->currentIndex(), -1);
    QVERIFY(!part<QAction>("rename-set")->isEnabled() && !part<QAction>("remove-set")->isEnabled());
    nameBy("save-set", " day ");
    QCOMPARE(box->currentText(), QString("day"));
    // What is changed before another is saved is the other's alone.
    setDarkShare(40.0);
    nameBy("save-set", "night");
    QCOMPARE(box->currentText(), QString("night"));
    QCOMPARE(keptDarkShare("day"), 15.0);
    QCOMPARE(keptDarkShare("night"), 40.0);
    // What is changed before another is used stays in the one before.
    setDarkShare(30.0);
    Q_EMIT box->activated(box->findText("day"));
    QCOMPARE(page_->settings().reachablePercentile, 15.0);
    QVERIFY(!page_->undoStack().canUndo());
    settle();
    QCOMPARE(keptDarkShare("night"), 30.0);
    QCOMPARE(kept().nameInUse(), std::string("day"));
    // Whoever changes it elsewhere changes it here.
    own_.session.changeSets(
        [](calibration::CalibrationFolder& folder) { pipeline::useSet(folder, "night"); });
    QCOMPARE(page_->settings().reachablePercentile, 30.0);
    QCOMPARE(box->currentText(), QString("night"));
    settle();
    nameBy("rename-set", "late");
    QCOMPARE(kept().names(), (std::vector<std::string>{"day", "late"}));
    QCOMPARE(page_->settings().reachablePercentile, 30.0);
    part<QAction>("remove-set")->trigger();
    QCOMPARE(kept().names(), std::vector<std::string>{"day"});
    QCOMPARE(page_->settings().reachablePercentile, 15.0);
    settle();
    part<QAction>("remove-set")->trigger();
    QCOMPARE(kept().names().size(), std::size_t{0});
    QCOMPARE(page_->settings().reachablePercentile, 15.0);
    QCOMPARE(box->currentIndex(), -1);
  }

  /// A set that is made of an accepted one is as far as that one.
  void whoHasPlacedContentNeedNotDoItAgain() {
    page_->primary()->trigger();
    QCOMPARE(own_.session.progress(calibration::Stage::content), calibration::StageProgress::done);
    page_->saveSet("day");
    setDarkShare(25.0);
    page_->saveSet("night");
    QTRY_COMPARE(own_.session.progress(calibration::Stage::content), calibration::StageProgress::done);
    page_->useSet("day");
    settle();
    QTRY_COMPARE(own_.session.progress(calibration::Stage::content), calibration::StageProgress::done);
    QVERIFY(!page_->isChanged());
  }

  void namesThatCannotBeAreNotTaken_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("said");
    QTest::newRow("none") << "" << false;
    QTest::newRow("spaces") << "   " << false;
    QTest::newRow("that in use") << "night" << false;
    QTest::newRow("another's") << "day" << true;
    QTest::newRow("too long") << QString(61, 'x') << true;
  }
  void namesThatCannotBeAreNotTaken() {
    QFETCH(QString, name);
    QFETCH(bool, said);
    pipeline::TargetSets sets{{{"day", {}}, {"night", {}}}, 1};
    for (const auto kind : {SetNameDialog::Kind::save, SetNameDialog::Kind::rename}) {
      SetNameDialog dialog(kind, sets);
      dialog.findChild<QLineEdit*>("set-name")->setText(name);
      QVERIFY(!dialog.findChild<QPushButton*>("set-do")->isEnabled());
      QCOMPARE(dialog.findChild<Note*>("set-wrong")->isHidden(), !said);
    }
  }

  /// As a repair does: the page would put it back where it was.
  void whatElseMovesItIsFollowed() {
    const pipeline::CalibrateSettings before = own_.session.settings();
    pipeline::CalibrateSettings moved = before;
    moved.content.corners = compensation::Corners{{{5, 4}, {22, 5}, {21, 16}, {6, 15}}};
    setDarkShare(25.0);
    QVERIFY(page_->undoStack().canUndo());
    own_.session.changeSettings(moved);
    QVERIFY(page_->settings() == moved.content);
    QVERIFY(!page_->isChanged() && !page_->undoStack().canUndo());
    settle();
    // Of other changes, what was chosen here stays.
    setDarkShare(30.0);
    pipeline::CalibrateSettings other = own_.session.settings();
    other.clustering.patchRadius += 1.0;
    own_.session.changeSettings(other);
    QCOMPARE(page_->settings().reachablePercentile, 30.0);
    own_.session.changeSettings(before);
    QVERIFY(page_->settings() == before.content);
    settle();
  }
};

QTEST_MAIN(TestPreviewSets)
#include "test_preview_sets.moc"
