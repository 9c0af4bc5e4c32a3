// SPDX-License-Identifier: MIT
// What was found of the show, by photographs, test patterns and repairs: what stands, and what is to be done
// next. On two screens, see tests/support/with-two-screens: DUMMY1 is the projector's.
#include <QLabel>
#include <QSignalSpy>
#include <QtTest>

#include "gui/wizard/output/output_on_venue.h"
#include "wizard/output/output_inspector.h"
#include "wizard/output/proof_file.h"

using namespace relucent;
using namespace relucent::gui;

class TestWhatWasFound : public QObject, private OutputOnVenue {
  Q_OBJECT

  using Next = OutputProof::Next;
  static void paint(venue::Changes& changes) { changes.painted.push_back({{0.45, 0.5}, 0.3}); }
  static void clean(venue::Changes& changes) { changes.painted.clear(); }
  /// Until the next second: records of different works are told apart by seconds.
  static void letASecondPass() {
    const qint64 now = QDateTime::currentSecsSinceEpoch();
    QTRY_VERIFY(QDateTime::currentSecsSinceEpoch() > now + 1);
  }
  void photograph() {
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
  }
  void repair() {
    page_->repair();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().repair() && isIdle(), patience);
  }
  /// As if a check for drift had found nothing, now.
  void patternsFit() {
    page_->close();
    const std::filesystem::path path = session().path();
    pipeline::saveDriftRecord({.checked = QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString(),
                               .measurement = session().result(calibration::Stage::acquisition)->stored,
                               .verdict = acquisition::Verdict::stillGood,
                               .error = 0.008,
                               .errorThen = 0.007,
                               .changedShare = 0.001},
                              proofFolder(path));
    session().close();
    session().open(path);
    page_->choose(screen("DUMMY1"));
    openOutput();
  }
  QString driftRemark() { return remark("drift-remark"); }
  QString remark(const char* name) {
    const std::unique_ptr<QWidget> inspector(outputInspector(*page_));
    const auto* remark = inspector->findChild<QWidget*>(name);
    if (remark->isHidden()) return {};
    QStringList texts;
    for (const QLabel* label : remark->findChildren<QLabel*>()) texts << label->text();
    return texts.join('\n');
  }

 private slots:
  void initTestCase() { measureOnce(); }
  void init() { begin(); }
  void cleanup() { end(); }

  /// Law: whatever few test patterns say, a photograph that is not as predicted stays so, and photographs and
  /// checks that contradict each other lead to the repair, not round in a circle.
  void aCheckThatHoldsSettlesNoPhotograph() {
    becomes(paint);
    openOutput();
    photograph();
    QVERIFY(!page_->proof().proof()->isAsPredicted());
    QCOMPARE(page_->proof().next(), Next::checkDrift);
    letASecondPass();
    patternsFit();
    // Perhaps somebody stood there.
    QCOMPARE(page_->proof().next(), Next::photograph);
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    const QString contradiction = OutputPage::tr("The test patterns fit, the photograph does not");
    QVERIFY2(driftRemark().contains(contradiction), qPrintable(driftRemark()));
    letASecondPass();
    photograph();
    QCOMPARE(page_->proof().next(), Next::repair);
    QCOMPARE(page_->primary()->text(), OutputPage::tr("Repair the calibration"));
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    QVERIFY2(driftRemark().contains(contradiction), qPrintable(driftRemark()));
    repair();
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::repaired);
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen() && !page_->playsEarlier(), patience);
    // What that check had missed is not held against the measurement from before, nor praised.
    QSignalSpy asked(page_.get(), &PageModel::failed);
    page_->askToUndoRepair();
    QCOMPARE(asked.size(), 1);
    asked.front().front().value<FailureReport>().goOn->trigger();
    QVERIFY(!page_->proof().repairNote() && !page_->proof().drift());
    QVERIFY(driftRemark().isEmpty());
  }

  /// Law: a photograph from before a picture was perfected is no proof of it as it is shown since.
  void aPictureThatWasPerfectedSinceIsSaid() {
    openOutput();
    photograph();
    const QString since = OutputPage::tr("This picture was perfected after the photograph.");
    QVERIFY(!remark("proof-remark").contains(since));
    letASecondPass();
    page_->perfect();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->perfecting().isRunning(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(page_->perfecting().known().has_value(), patience);
    QVERIFY2(remark("proof-remark").contains(since), qPrintable(remark("proof-remark")));
    letASecondPass();
    photograph();
    QVERIFY2(!remark("proof-remark").contains(since), qPrintable(remark("proof-remark")));
  }

  /// Law: a repair that finds nothing asks for a photograph, which settles what was found before.
  void aRepairThatFindsNothingIsPhotographed() {
    becomes(paint);
    openOutput();
    photograph();
    page_->close();
    becomes(clean);
    openOutput();
    QCOMPARE(page_->proof().next(), Next::checkDrift);
    letASecondPass();
    repair();
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::nothingToDo);
    QCOMPARE(page_->proof().next(), Next::photograph);
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    photograph();
    QCOMPARE(page_->proof().next(), Next::install);
  }

  /// Law: what was tried in vain is of the view that it was tried of: put back, or looked at once more, it
  /// may be tried again.
  void aRepairInVainIsOfWhatItSaw() {
    // What photographs of a picture do not tell apart.
    becomes([](venue::Changes& changes) { changes.lamps = {0.98, 0.98, 0.975}; });
    openOutput();
    page_->repair();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().repair() && isIdle(), patience);
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::notBetter);
    QVERIFY(page_->proof().isBeyondRepair());
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().drift() && isIdle(), patience);
    QVERIFY(!page_->proof().isBeyondRepair() && !page_->proof().repair());
  }

  /// Law: a check that finds a change leads to the repair, which is photographed, shown at once, and taken
  /// back by one button. What is measured again is not what was proved before.
  void aVenueThatChangedIsRepaired() {
    becomes(paint);
    openOutput();
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().drift() && isIdle(), patience);
    QCOMPARE(page_->proof().next(), Next::repair);
    QCOMPARE(page_->primary()->text(), OutputPage::tr("Repair the calibration"));
    QVERIFY(page_->primary()->isEnabled() && !page_->proof().repairNote());
    QVERIFY(page_->isOpen() && page_->status().isHeldUp);
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    const std::string before = session().correction();
    page_->primary()->trigger();
    QCOMPARE(page_->proof().work(), OutputProof::Work::repair);
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().repair() && isIdle(), patience);
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::repaired);
    QVERIFY(session().correction() != before && page_->proof().repairNote());
    QVERIFY(!page_->proof().drift() && page_->proof().isOutOfDate());
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen() && !page_->playsEarlier(), patience);
    QCOMPARE(page_->proof().next(), Next::photograph);
    // Of the repaired one, which is not in use after going back.
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->proof().isOutOfDate() && isIdle(), patience);
    QSignalSpy asked(page_.get(), &PageModel::failed);
    page_->askToUndoRepair();
    QCOMPARE(asked.size(), 1);
    const auto question = asked.front().front().value<FailureReport>();
    QVERIFY(question.isQuestion && question.reason && page_->proof().repairNote());
    question.goOn->trigger();
    QVERIFY(!question.reason);
    QCOMPARE(session().correction(), before);
    QVERIFY(!page_->proof().repairNote() && page_->proof().isOutOfDate());
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen() && !page_->playsEarlier(), patience);
    // What was found of it before holds of it again, and is said.
    QVERIFY(page_->proof().drift().has_value() && page_->proof().newestDrift() != nullptr);
    QCOMPARE(page_->proof().next(), Next::repair);
  }

  /// Law: a camera that never looked elsewhere explains nothing of what was found; one that was pushed back
  /// does.
  void aCameraThatNeverMovedExplainsNothing() {
    becomes(paint);
    openOutput();
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().newestDrift() != nullptr && isIdle(), patience);
    QCOMPARE(page_->proof().next(), Next::repair);
    NudgeSight atItsPlace;
    atItsPlace.offset.isRecognised = true;
    page_->pushedBack(atItsPlace, false);
    QVERIFY(page_->proof().newestDrift() != nullptr && !driftRemark().isEmpty());
    QCOMPARE(page_->proof().next(), Next::repair);
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    page_->pushedBack(atItsPlace, true);
    QVERIFY(page_->proof().newestDrift() == nullptr && driftRemark().isEmpty());
    QCOMPARE(page_->proof().next(), Next::photograph);
    QVERIFY2(remark("proof-remark").contains("What was found before may have come of that"),
             qPrintable(remark("proof-remark")));
  }

  /// Law: a photograph that was as predicted settles an earlier check, for another set and other content,
  /// too: where camera and projector stand is not theirs.
  void whatWasProvedSettlesAnEarlierCheck() {
    becomes(paint);
    openOutput();
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().newestDrift() != nullptr && isIdle(), patience);
    QCOMPARE(page_->proof().next(), Next::repair);
    letASecondPass();
    page_->close();
    becomes(clean);
    openOutput();
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
    QVERIFY(page_->proof().proof()->isAsPredicted() && page_->proof().newestDrift() == nullptr);
    change([](pipeline::CalibrateSettings& settings) { settings.content.reachablePercentile = 40.0; });
    QVERIFY(page_->proof().isOutOfDate() && page_->proof().newestDrift() == nullptr);
    QCOMPARE(page_->proof().next(), Next::photograph);
  }

  /// Law: a photograph from before a check that found a change is no praise beside it, and both say when they
  /// were taken.
  void whatWasProvedBeforeIsMarked() {
    const std::unique_ptr<QWidget> inspector(outputInspector(*page_));
    const auto said = [&](const char* remark) {
      QStringList texts;
      for (const QLabel* label : inspector->findChild<QWidget*>(remark)->findChildren<QLabel*>())
        texts << label->text();
      return texts.join('\n');
    };
    openOutput();
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
    QVERIFY(page_->proof().proof()->isAsPredicted());
    const QString praise = OutputPage::tr("The surface looks as predicted");
    const QString taken = QLocale().toString(page_->proof().proof()->taken, QLocale::ShortFormat);
    QVERIFY2(said("proof-remark").contains(taken), qPrintable(said("proof-remark")));
    becomes(paint);
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().newestDrift() != nullptr && isIdle(), patience);
    QVERIFY(page_->proof().drift()->verdict == acquisition::Verdict::remeasure);
    QVERIFY2(!said("proof-remark").contains(praise), qPrintable(said("proof-remark")));
    QVERIFY2(said("proof-remark")
                 .contains(OutputPage::tr("Photographed %1, before the last check for drift.").arg(taken)),
             qPrintable(said("proof-remark")));
    QVERIFY2(said("drift-remark").contains("Checked "), qPrintable(said("drift-remark")));
  }

  /// Law: what a photograph found stands, whether or not the output is open.
  void whatDoesNotLookAsPredictedIsSaidWhileClosed() {
    becomes([](venue::Changes& changes) { changes.cameras.push_back({0, 2.0, 2.0, 0.0}); });
    openOutput();
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
    QVERIFY(!page_->proof().proof()->isAsPredicted());
    page_->close();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->isOpen(), patience);
    QCOMPARE(page_->status().state, StepState::doubtful);
    QCOMPARE(page_->status().result, QString("Not as predicted"));
    QVERIFY2(page_->hint().contains("did not look as predicted"), qPrintable(page_->hint()));
  }
};

QTEST_MAIN(TestWhatWasFound)
#include "test_what_was_found.moc"
