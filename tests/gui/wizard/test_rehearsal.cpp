// SPDX-License-Identifier: MIT
// Surprises of a rehearsal: each leads to what the wizard says of it, and leaves no trace once it is put
// right.
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/calibration/results.h"
#include "text/message_text.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/devices/nudge.h"
#include "wizard/devices/on_measurement.h"
#include "wizard/frame/wizard.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::sentinels;
using namespace relucent::transport;
using relucent::venue::Surprise;

namespace {

constexpr int patience = 120'000;  // ms for a small measurement on a busy machine

}  // namespace

class TestRehearsal : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<VenuePage> venue_;
  std::unique_ptr<AcquirePage> acquire_;
  std::unique_ptr<Wizard> wizard_;
  std::unique_ptr<QSignalSpy> told_;
  std::optional<TransportMatrix> calm_;
  int patterns_ = 0;               // it took
  std::vector<double> exposures_;  // that it chose

  /// As somebody does who chooses it on the page.
  void rehearse(const std::vector<Surprise>& surprises) {
    venue_->setMode(VenuePage::Mode::rehearse);
    for (std::size_t i = 0; i < venue_->venues().size(); ++i)
      if (venue_->venues()[i].id == "plain") venue_->chooseVenue(i);
    for (Surprise kind : allValues<Surprise>())
      venue_->setSurprise(kind, std::ranges::find(surprises, kind) != surprises.end());
    venue_->setSurpriseSeed(5);
    venue_->primary()->trigger();
    QVERIFY(session_->isSimulated());
    QCOMPARE(session_->surprises() != nullptr, !surprises.empty());
    // As Camera keeps them.
    if (!exposures_.empty()) session_->decide(CameraCheckResult{exposures_, std::nullopt, {}});
    acquire_->primary()->trigger();
    QVERIFY(acquire_->isMeasuring());
  }
  /// What is asked next.
  FailureReport question() {
    const bool isAsked = QTest::qWaitFor([this] { return !told_->isEmpty(); }, patience);
    return isAsked ? told_->takeFirst().front().value<FailureReport>() : FailureReport();
  }
  TransportMatrix measured() { return loadAcquisition(*session_->result(Stage::acquisition)).transport; }
  /// It has come, is over, and the measurement is the one of a calm rehearsal, to the bit.
  void endsAsIfNothingHadHappened(Surprise kind) {
    QTRY_VERIFY_WITH_TIMEOUT(!acquire_->isMeasuring(), patience);
    QCOMPARE(session_->progress(Stage::acquisition), StageProgress::done);
    QVERIFY(session_->surprises()->hasHappened(kind) && !session_->surprises()->lasts(kind));
    QVERIFY(told_->isEmpty());
    QVERIFY(measured() == *calm_);
  }

 private slots:
  void init() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    session_ = std::make_unique<Session>(std::filesystem::path(folder_.filePath("cache").toStdString()));
    venue_ = std::make_unique<VenuePage>(*session_, RecentVenues(*settings_));
    venue_->setSizes({{{64, 48}, {48, 36}, "%1"}});
    venue_->setFolder(folder_.filePath("venues"));
    acquire_ = std::make_unique<AcquirePage>(*session_);
    wizard_ = std::make_unique<Wizard>(*session_);
    wizard_->add(*venue_);
    wizard_->add(*acquire_);
    told_ = std::make_unique<QSignalSpy>(acquire_.get(), &PageModel::failed);
    if (calm_) return;
    rehearse({});
    QTRY_VERIFY_WITH_TIMEOUT(!acquire_->isMeasuring(), patience);
    QVERIFY(told_->isEmpty());
    calm_ = measured();
    patterns_ = acquire_->cost().value().patterns;
    exposures_ = loadLinearization(*session_->result(Stage::linearization)).exposures;
  }
  void cleanup() {
    told_.reset();
    wizard_.reset();
    acquire_.reset();
    venue_.reset();
    session_.reset();
  }

  /// Of every venue somebody sees how long it takes and how hard it is; more pixels take longer.
  void venuesSayWhatTheyTake() {
    QSet<QString> said;
    for (const RehearsalVenue& venue : venue_->venues()) said << venue_->effortOf(venue);
    QVERIFY(said.size() >= 3);
    venue_->setSizes({{{512, 384}, {320, 240}, "%1"}});
    for (const RehearsalVenue& venue : venue_->venues())
      QVERIFY2(!said.contains(venue_->effortOf(venue)), qPrintable(venue_->effortOf(venue)));
  }

  /// Law: what is promised before is about what is taken.
  void expectedPatternsAreThoseThatAreMeasured() {
    venue_->setMode(VenuePage::Mode::rehearse);
    const double expected = venue_->expected().shots, taken = patterns_;
    QVERIFY2(taken > 0.5 * expected && taken < 2.0 * expected,
             qPrintable(QString("%1 of %2").arg(taken).arg(expected)));
  }

  void anInterruptionEndsNoSurprise_data() {
    QTest::addColumn<bool>("hasBegun");
    QTest::newRow("before it comes") << false;
    QTest::newRow("while it lasts") << true;
  }
  /// Law: a rehearsal that is closed and opened again goes on as a room does: what was to come comes, and a
  /// light that was switched on is on.
  void anInterruptionEndsNoSurprise() {
    QFETCH(bool, hasBegun);
    rehearse({Surprise::roomLight});
    session_->live().setLeastInterval(30);
    const auto ending = connect(acquire_.get(), &AcquirePage::progressChanged, acquire_.get(), [&] {
      const bool isAt =
          hasBegun ? session_->surprises()->hasHappened(Surprise::roomLight) : acquire_->photographs() > 0;
      if (acquire_->isMeasuring() && isAt) acquire_->finish();
    });
    QTRY_VERIFY_WITH_TIMEOUT(!acquire_->isMeasuring(), patience);
    disconnect(ending);
    QVERIFY(told_->isEmpty());
    const std::filesystem::path path = session_->path();
    cleanup();
    init();
    session_->open(path);
    QVERIFY(session_->surprises() != nullptr);
    QCOMPARE(session_->surprises()->hasHappened(Surprise::roomLight), hasBegun);
    acquire_->primary()->trigger();
    const FailureReport asked = question();
    QCOMPARE(asked.failure.heading, AcquisitionTrace::headingOf(AlarmKind::ambientChanged));
    asked.resume->trigger();
    endsAsIfNothingHadHappened(Surprise::roomLight);
    session_->open(path);
    QVERIFY(!session_->surprises()->lasts(Surprise::roomLight));
  }

  void aLightThatIsSwitchedOn() {
    rehearse({Surprise::roomLight});
    const FailureReport asked = question();
    QCOMPARE(asked.failure.heading, AcquisitionTrace::headingOf(AlarmKind::ambientChanged));
    QVERIFY(!asked.safe.isEmpty() && !asked.failure.advice.isEmpty() && asked.keep && asked.goOn);
    QVERIFY(session_->surprises()->lasts(Surprise::roomLight));
    asked.resume->trigger();
    QVERIFY(!acquire_->isHeldUp() && !wizard_->banner());
    endsAsIfNothingHadHappened(Surprise::roomLight);
    // What happened stays on record, with how many patterns were taken again.
    const QString found = acquire_->findings().join(' ');
    QVERIFY2(found.contains("brighter") && found.contains("photographed again"), qPrintable(found));
  }

  void aCameraThatIsBumped() {
    rehearse({Surprise::bump});
    FailureReport asked = question();
    QCOMPARE(asked.failure.heading, AcquisitionTrace::headingOf(AlarmKind::moved));
    // Measured again without having been pushed back, it is asked again.
    asked.resume->trigger();
    asked = question();
    QCOMPARE(asked.failure.heading, AcquisitionTrace::headingOf(AlarmKind::moved));
    // In the words of its buttons; nothing runs on meanwhile, and the page has the question as well.
    for (const PageCommand* answer : {asked.resume, asked.goOn})
      QVERIFY2(asked.failure.advice.contains("“" + answer->text() + "”"), qPrintable(asked.failure.advice));
    QVERIFY(asked.failure.advice.contains("try again") && asked.resume->text() == "Try again");
    QVERIFY(acquire_->isAsking() && acquire_->isHeldUp() && asked.reason != nullptr);
    for (const PageCommand* command : acquire_->secondary())
      QCOMPARE(command->isEnabled(), command->text() != "Pause");
    const std::optional<double> left = acquire_->secondsLeft();
    const int photographs = acquire_->photographs();
    QVERIFY(acquire_->banner() && acquire_->banner()->command);
    acquire_->banner()->command->trigger();
    QCOMPARE(question().failure.heading, asked.failure.heading);
    QVERIFY(asked.repair && asked.repair->text() == "Put the camera back");
    QSignalSpy wanted(acquire_.get(), &AcquirePage::nudgeWanted);
    asked.repair->trigger();
    QCOMPARE(wanted.size(), 1);
    // Somebody pushes while the wizard shows where to.
    Nudge nudge(*session_, acquire_->viewBefore());
    QSignalSpy ended(&nudge, &Nudge::ended);
    nudge.start();
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight().has_value(), patience);
    QVERIFY2(nudge.sight()->offset.isRecognised && nudge.sight()->distance() > 1.0,
             qPrintable(QString::number(nudge.sight()->distance())));
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight()->isAtItsPlace(), patience);
    nudge.stop();
    QTRY_VERIFY_WITH_TIMEOUT(!ended.isEmpty(), patience);
    QCOMPARE(acquire_->secondsLeft(), left);
    QCOMPARE(acquire_->photographs(), photographs);
    // Put right, only the answer is missing.
    acquire_->askAgain(true);
    asked = question();
    QVERIFY(asked.isPutRight && !asked.repair && !asked.goOn);
    QCOMPARE(asked.failure.heading, QString("The camera is back at its place"));
    QVERIFY2(!asked.failure.what.contains("shifted"), qPrintable(asked.failure.what));
    asked.resume->trigger();
    QVERIFY(!acquire_->isAsking() && asked.reason == nullptr);
    endsAsIfNothingHadHappened(Surprise::bump);
    const QString found = acquire_->findings().join(' ');
    QVERIFY2(found.contains("moved") && found.contains("photographed again"), qPrintable(found));
  }

  /// Law: a measurement that waits for an answer says so, and asks again whoever has closed the question.
  void aQuestionThatWasClosedIsAskedAgain() {
    rehearse({Surprise::bump});
    const FailureReport asked = question();
    QVERIFY(acquire_->isHeldUp() && wizard_->statusOf(1).isHeldUp);
    QVERIFY2(wizard_->statusOf(1).result.startsWith("Waits for an answer"),
             qPrintable(wizard_->statusOf(1).result));
    QCOMPARE(acquire_->hint(), QString("Waiting for your answer."));
    const std::optional<Banner> banner = wizard_->banner();
    QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->command);
    QCOMPARE(banner->sentence, asked.failure.heading);
    QCOMPARE(banner->more, asked.failure.what);
    banner->command->trigger();
    QCOMPARE(question().failure.what, asked.failure.what);
    // And the page's own command is an answer.
    acquire_->stopAndKeep();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire_->isMeasuring(), patience);
    QVERIFY(!acquire_->isHeldUp() && told_->isEmpty());
  }

  void whatHappensWhileItIsToEnd_data() {
    QTest::addColumn<Surprise>("surprise");
    QTest::addColumn<QString>("onwards");
    QTest::addColumn<QString>("besides");
    QTest::newRow("a bump") << Surprise::bump << "Measure again"
                            << "Go on measuring";
    QTest::newRow("light") << Surprise::roomLight << "Go on measuring"
                           << "Measure again";
  }
  /// Law: stopped while something has just happened, nobody is asked. What is kept is named as stopped early
  /// and as changed, on every page; what leads on is what can be right, and put right it ends as if nothing
  /// had happened.
  void whatHappensWhileItIsToEnd() {
    QFETCH(Surprise, surprise);
    QFETCH(QString, onwards);
    QFETCH(QString, besides);
    rehearse({surprise});
    session_->live().setLeastInterval(30);
    const auto stopping = connect(acquire_.get(), &AcquirePage::progressChanged, acquire_.get(), [&] {
      if (acquire_->isMeasuring() && !acquire_->isStopping() && session_->surprises()->hasHappened(surprise))
        acquire_->stopAndKeep();
    });
    QTRY_VERIFY_WITH_TIMEOUT(!acquire_->isMeasuring(), patience);
    disconnect(stopping);
    session_->live().setLeastInterval(0);
    QVERIFY(told_->isEmpty() && acquire_->isDone() && acquire_->wasEndedEarly());
    const auto change = session_->foundChange();
    QVERIFY(change && change->moved == (surprise == Surprise::bump));
    QCOMPARE(acquire_->status().state, StepState::coarse);
    QCOMPARE(acquire_->primary()->text(), onwards);
    QVERIFY(acquire_->primary()->isEnabled() && !acquire_->hint().isEmpty());
    QCOMPARE(acquire_->secondary().front()->text(), besides);
    const std::optional<Banner> banner = acquire_->banner();
    QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->command == nullptr);
    QVERIFY2(banner->sentence.contains("changed"), qPrintable(banner->sentence));
    QVERIFY2(banner->more.contains(fullSentence(change->what)), qPrintable(banner->more));
    QVERIFY2(acquire_->findings().join(' ').contains("left out"), qPrintable(acquire_->findings().join('|')));
    const std::optional<Banner> elsewhere = onMeasurement(*session_, acquire_->primary());
    QVERIFY(elsewhere && elsewhere->sentence.contains("changed"));
    QCOMPARE(doneOn(*session_), StepState::coarse);
    if (surprise == Surprise::bump) return;
    // The light is off again.
    session_->putRight();
    acquire_->primary()->trigger();
    endsAsIfNothingHadHappened(surprise);
    QVERIFY(!session_->foundChange() && !acquire_->banner());
  }

  void aCableThatComesOut() {
    rehearse({Surprise::unplugged});
    QTRY_VERIFY_WITH_TIMEOUT(session_->isCameraSilent(), patience);
    QVERIFY(acquire_->isMeasuring() && acquire_->insteadOfWaiting() != nullptr);
    const std::optional<Banner> banner = wizard_->banner();
    QVERIFY(banner && banner->kind == Banner::Kind::amber && banner->command);
    QCOMPARE(banner->sentence, QString("The camera does not answer"));
    QVERIFY2(banner->more.contains("cable is out"), qPrintable(banner->more));
    QCOMPARE(wizard_->statusOf(1).result, QString("Camera silent"));
    QVERIFY(wizard_->statusOf(1).isHeldUp);
    // It goes on by itself.
    QTRY_VERIFY_WITH_TIMEOUT(!session_->isCameraSilent(), patience);
    endsAsIfNothingHadHappened(Surprise::unplugged);
  }
};

QTEST_MAIN(TestRehearsal)
#include "test_rehearsal.moc"
