// SPDX-License-Identifier: MIT
// What pages say of a measurement: of one measurement only, and the same wherever it is said.
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QtTest>
#include <algorithm>

#include "gui/wizard/simulated_session.h"
#include "relucent/calibration/results.h"
#include "views/cut_histogram.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/step_rail.h"
#include "wizard/frame/wizard.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/linearize/linearize_view.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/threshold/threshold_view.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;

class TestReadouts : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    session_ = &own_->session;
  }

  /// Law: what a forecast says of a venue before it is begun, it says of it when the response is known.
  void thereIsOneForecast() {
    VenuePage venue(*session_, RecentVenues(own_->settings));
    venue.setSizes({{{64, 48}, {48, 36}, "%1"}, {{512, 384}, {320, 240}, "%1"}});
    venue.setMode(VenuePage::Mode::rehearse);
    for (bool isSmall : {true, false}) {
      venue.chooseSize(isSmall ? 0 : 1);
      const QString effort = venue.effortOf(venue.venues().front());
      QCOMPARE(effort.contains("under a minute"), isSmall);
    }
    // Fewer pixels of the camera than of the projector, which has no part in computing.
    venue.setSizes({{{256, 192}, {48, 36}, "%1"}});
    const double before = venue.expected().seconds;
    own_->begin(smallVenue({256, 192}, {48, 36}));
    LinearizePage linearize(*session_);
    AcquirePage page(*session_);
    linearize.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!linearize.isMeasuring() && linearize.result(), patience);
    const double after = page.expected()->seconds;
    QVERIFY2(isUnderAMinute(before) && isUnderAMinute(after) && after < 5.0 * before && before < 5.0 * after,
             qPrintable(QString("%1 and %2").arg(before).arg(after)));
  }

  /// Law: contrast and black level are those of the response's photographs, whatever is looked at later.
  void contrastIsOfOneMeasurement() {
    own_->begin();
    AcquirePage acquire(*session_);
    LinearizePage page(*session_);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring() && acquire.isDone(), patience);
    const std::optional<double> black = page.blackShare();
    QVERIFY(black.has_value());
    session_->setRoomLight(RoomLight{10.0 * *black + 0.1, true});
    QCOMPARE(page.blackShare(), black);
    session_->wantAcquisition();
    QTRY_VERIFY_WITH_TIMEOUT(session_->acquisition() != nullptr, patience);
    QCOMPARE(page.blackShare(), black);
  }

  /// Law: photographs are counted by the measurement that takes them; those of whoever looked before are not.
  void photographsAreOfOneMeasurement() {
    own_->begin(smallVenue({96, 72}, {80, 60}));
    CameraPage camera(*session_);
    LinearizePage page(*session_);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    camera.enter();
    QTRY_VERIFY_WITH_TIMEOUT(camera.areChecksDone(), patience);
    camera.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session_->areDevicesFree(), patience);
    const int before = session_->live().photographs();
    QVERIFY(before > 0);
    int most = 0;
    connect(&page, &PageModel::progressChanged, &page, [&] {
      const int least = session_->live().photographs() - before, counted = page.photographs();
      QVERIFY(counted >= least && counted <= session_->live().photographs() - before);
      most = std::max(most, counted);
      QStringList texts;
      for (const QLabel* label : stage->findChildren<QLabel*>()) texts << label->text();
      const QString here = texts.filter("photograph ").join('\n');
      const int shown = here.section("photograph ", 1).toInt();
      QVERIFY2(shown <= counted, qPrintable(here));
    });
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && page.result(), patience);
    QVERIFY(most > 0);
    QCOMPARE(page.photographs(), 0);
  }

  /// Exposures that were kept are those that are shown, until the response has its own.
  void keptExposuresAreShown() {
    own_->begin();
    LinearizePage page(*session_);
    QVERIFY(page.exposures().empty());
    session_->decide(CameraCheckResult{{0.25, 0.5}, std::nullopt, {}});
    QCOMPARE(page.exposures(), (std::vector<double>{0.25, 0.5}));
  }

  /// Law: colours that do not add up are no plain tick, and where no projector is why, measuring again is
  /// what is to be done next.
  void coloursThatDoNotAddUpAreDoubtful_data() {
    QTest::addColumn<double>("off");
    QTest::addColumn<StepState>("state");
    QTest::addColumn<bool>("isNext");
    QTest::newRow("they do") << 0.003 << StepState::done << true;
    QTest::newRow("a white segment") << 0.8 << StepState::doubtful << true;
    QTest::newRow("the lens was covered") << 4.75 << StepState::doubtful << false;
    QTest::newRow("covered for a while, levels far off") << -1.01 << StepState::doubtful << false;
  }
  void coloursThatDoNotAddUpAreDoubtful() {
    QFETCH(double, off);
    QFETCH(StepState, state);
    QFETCH(bool, isNext);
    own_->begin();
    LinearizePage page(*session_);
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring() && page.result(), patience);
    {
      CalibrationFolder folder = CalibrationFolder::open(session_->path(), CalibrationFolder::Access::write);
      const StageResult stored = *folder.latest(Stage::linearization);
      linearization::Linearization measured = loadLinearization(stored);
      measured.additivityError.assign(measured.additivityError.size(), std::abs(off));
      if (off < 0.0) measured.projectors.front().residuals[0].front().light = 0.4;
      storeLinearization(folder, stored.inputs, measured, {});
    }
    session_->open(session_->path());
    QTRY_COMPARE(page.status().state, state);
    const QString again = LinearizePage::tr("Measure again");
    QCOMPARE(page.primary()->text() != again, isNext);
    QCOMPARE(page.secondary().front()->text() == again, isNext);
    QVERIFY(page.primary()->isEnabled() && page.secondary().front()->isEnabled());
    // Neither camera nor projector is praised or blamed for photographs that contradict each other.
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    for (const char* name : {"linear-camera", "rising-curves"})
      QCOMPARE(inspector->findChild<QWidget*>(name)->isHidden(), !isNext);
    QVERIFY(isNext || inspector->findChild<QWidget*>("findings")->isHidden());
  }

  /// Law: a view of which no exposure shows much is no plain tick, whoever has kept them.
  void aViewThatIsTooBrightIsDoubtful_data() {
    QTest::addColumn<double>("share");
    QTest::addColumn<StepState>("state");
    QTest::newRow("none of it") << 0.0 << StepState::done;
    QTest::newRow("a lamp") << 0.04 << StepState::done;
    QTest::newRow("most of it") << 0.72 << StepState::doubtful;
  }
  void aViewThatIsTooBrightIsDoubtful() {
    QFETCH(double, share);
    own_->begin();
    CameraPage page(*session_);
    session_->decide(CameraCheckResult{{0.25}, std::nullopt, {}, share});
    QTEST(page.status().state, "state");
    QCOMPARE(page.status().result.contains(percentText(share)), share > 0.05);
  }

  /// Law: the histogram's bars are of what the readouts count; beyond everything, the strongest stay.
  void aCutIsTheSameEverywhere() {
    measure();
    ThresholdPage page(*session_);
    page.enter();
    QTRY_VERIFY_WITH_TIMEOUT(page.whole().has_value() && page.isExact(), patience);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    auto* histogram = stage->findChild<CutHistogram*>("cut-histogram");
    auto* strongest = inspector->findChild<QLabel*>("strongest-stay");
    QVERIFY(histogram != nullptr && strongest != nullptr);
    const auto barsOf = [histogram](const char* style) {
      double sum = 0.0;
      for (const charts::Column& column : histogram->columns())
        if (column.style == style) sum += column.height;
      return sum;
    };
    for (double cut : {0.0, 1e-3, 1e9}) {
      page.setAbsolute(cut);
      QTRY_VERIFY_WITH_TIMEOUT(page.isExact(), patience);
      QCOMPARE(barsOf("kept"), static_cast<double>(page.kept()->connections));
      QCOMPARE(barsOf("dropped") > 0.0, page.kept()->leaves < page.whole()->leaves);
    }
    QVERIFY(page.kept()->leaves > 0 && page.isStrongestKept());
    QVERIFY(strongest->isVisibleTo(inspector.get()) && !strongest->text().isEmpty());
    page.setAbsolute(0.0);
    QTRY_VERIFY_WITH_TIMEOUT(!strongest->isVisibleTo(inspector.get()), patience);
  }

  /// Law: nothing is cut unasked; what is suggested keeps 99.5 % of the light; three times the noise is
  /// suggested where it does, and where it does not, what it would keep is said.
  void whatIsSuggestedCostsNoLight_data() {
    QTest::addColumn<double>("noise");  // of what was measured
    QTest::newRow("as measured") << 1.0;
    QTest::newRow("little") << 1e-6;
    QTest::newRow("not known") << 0.0;
  }
  void whatIsSuggestedCostsNoLight() {
    QFETCH(double, noise);
    measure();
    {
      CalibrationFolder folder = CalibrationFolder::open(session_->path(), CalibrationFolder::Access::write);
      const StageResult stored = *folder.latest(Stage::acquisition);
      transport::Acquisition measured = loadAcquisition(stored);
      std::vector<float> variance;
      for (std::size_t i = 0; noise > 0.0 && i < measured.leafVariance.size(); ++i)
        variance.push_back(measured.leafVariance[i] * static_cast<float>(noise * noise));
      measured.leafVariance = CameraStack(std::move(variance));
      storeAcquisition(folder, stored.inputs, measured, resultFrom<Stage::acquisition>(stored).cost.value());
    }
    session_->reload();
    ThresholdPage page(*session_);
    page.enter();
    QTRY_VERIFY_WITH_TIMEOUT(page.whole().has_value() && page.isExact(), patience);
    QCOMPARE(page.cut().absolute, 0.0f);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    auto* suggest = inspector->findChild<QPushButton*>("use-suggested");
    const QString why = inspector->findChild<QLabel*>("why-suggested")->text();
    QCOMPARE(page.noise().has_value(), noise > 0.0);
    const bool isCostly = page.noise() && page.noise()->keeps < 0.995;
    QCOMPARE(isCostly, noise == 1.0);
    QCOMPARE(page.isNoiseSuggested(), noise > 0.0 && !isCostly);
    QCOMPARE(page.suggested() > 0.0, !isCostly);
    QCOMPARE(suggest->isEnabled(), !isCostly);
    if (isCostly)
      QVERIFY2(why.contains(percentText(page.noise()->keeps)) && why.contains(numberText(page.noise()->cut)),
               qPrintable(why));
    if (page.isNoiseSuggested()) QCOMPARE(page.suggested(), page.noise()->cut);
    page.setAbsolute(1e-3);
    QVERIFY(suggest->isEnabled());
    suggest->click();
    QTRY_VERIFY_WITH_TIMEOUT(page.isExact(), patience);
    QCOMPARE(page.cut().absolute, static_cast<float>(page.suggested()));
    QVERIFY2(page.kept()->energyKept > 0.99, qPrintable(QString::number(page.kept()->energyKept)));
  }

  /// Law: what is no cut changes nothing and is said; what was typed is taken back by the page's undo.
  void nonsenseIsRefused() {
    measure();
    ThresholdPage page(*session_);
    page.enter();
    QTRY_VERIFY_WITH_TIMEOUT(page.whole().has_value(), patience);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    auto* typed = inspector->findChild<QLineEdit*>("cut-value");
    auto* refused = inspector->findChild<QLabel*>("cut-refused");
    const auto type = [typed](const QString& text) {
      typed->selectAll();
      QTest::keyClicks(typed, text);
      QTest::keyClick(typed, Qt::Key_Return);
    };
    const auto isRefused = [&] { return refused->isVisibleTo(inspector.get()); };
    QVERIFY(!isRefused());
    type("0.002");
    QCOMPARE(page.cut().absolute, 0.002f);
    QVERIFY(!isRefused());
    type("abc,-5");
    QCOMPARE(page.cut().absolute, 0.002f);
    QVERIFY2(isRefused() && refused->text().contains("abc,-5"), qPrintable(refused->text()));
    QCOMPARE(typed->text(), QString("0.002"));
    type("0.004");
    QVERIFY(!isRefused());
    for (bool isTyping : {false, true}) {
      if (isTyping) QTest::keyClicks(typed, "7");
      QKeyEvent undo(QEvent::ShortcutOverride, Qt::Key_Z, Qt::ControlModifier);
      undo.ignore();
      QCoreApplication::sendEvent(typed, &undo);
      QCOMPARE(undo.isAccepted(), isTyping);
    }
    // Changes in quick succession are one.
    page.undoStack().undo();
    QCOMPARE(page.cut().absolute, 0.0f);
  }

  /// Law: what was interrupted is told on the list, with what there is besides, and opened again it is where
  /// one goes on.
  void anInterruptedMeasurementIsToldAndGoneOnWith_data() {
    QTest::addColumn<bool>("again");
    QTest::newRow("the first") << false;
    QTest::newRow("measured again") << true;
  }
  void anInterruptedMeasurementIsToldAndGoneOnWith() {
    QFETCH(bool, again);
    own_->begin();
    VenuePage venue(*session_, RecentVenues(own_->settings));
    AcquirePage acquire(*session_);
    ThresholdPage threshold(*session_);
    Wizard wizard(*session_);
    for (PageModel* page : std::initializer_list<PageModel*>{&venue, &acquire, &threshold}) wizard.add(*page);
    const std::filesystem::path path = session_->path();
    session_->open(path);
    if (again) {
      acquire.primary()->trigger();
      QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring() && acquire.isDone(), patience);
      QVERIFY(!venue.recent().front().isInterrupted && !acquire.wasInterrupted());
      QTest::qWait(1100);  // results are dated to the second
      acquire.secondary().front()->trigger();
    } else {
      acquire.primary()->trigger();
    }
    QTRY_VERIFY_WITH_TIMEOUT(acquire.photographs() > 8, patience);
    acquire.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring(), patience);
    const int safe = again ? session_->photographsSince(Stage::acquisition)
                           : session_->photographsKept(Stage::acquisition);
    QVERIFY(safe > 0);
    session_->close();
    const RecentVenue listed = venue.recent().front();
    QVERIFY(listed.isInterrupted);
    QVERIFY2(listed.state.startsWith(again ? "Measured; " : "Interrupted: ") &&
                 listed.state.contains(QString::number(safe)),
             qPrintable(listed.state));
    session_->open(path);
    QCOMPARE(wizard.current(), std::size_t{1});
    // What is kept is read first, which is said: not before the devices are open, whose checks are shown.
    connect(&acquire, &AcquirePage::progressChanged, &acquire, [&] {
      if (!acquire.isReading() || acquire.isPaused() || acquire.reading().taken == 0) return;
      QVERIFY(acquire.reading().taken <= acquire.reading().expected);
      QVERIFY2(acquire.status().result.startsWith("Reading"), qPrintable(acquire.status().result));
      QVERIFY2(acquire.hint().contains(QString::number(acquire.reading().expected)),
               qPrintable(acquire.hint()));
    });
    session_->live().pause();  // before the first new pattern
    acquire.primary()->trigger();
    QVERIFY(acquire.isMeasuring() && !acquire.isReading());
    QTRY_VERIFY_WITH_TIMEOUT(acquire.isReading(), patience);
    session_->live().resume();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring() && acquire.isDone(), patience);
    QVERIFY(!acquire.wasInterrupted() && !venue.recent().front().isInterrupted);
    // Nor is what was copied, whose photographs are newer than their result.
    for (const auto& shot : std::filesystem::directory_iterator(path / "shots"))
      std::filesystem::last_write_time(shot,
                                       std::filesystem::last_write_time(shot) + std::chrono::minutes(1));
    session_->open(path);
    QVERIFY(session_->photographsSince(Stage::acquisition) > 0);
    QVERIFY(!acquire.wasInterrupted() && !venue.recent().front().isInterrupted);
    QCOMPARE(wizard.current(), std::size_t{2});
  }

  /// Law: while another venue is only thought of, the rail is of the open one: named, and open.
  void theRailIsOfTheOpenVenue() {
    own_->begin();
    session_->decide(CameraCheckResult{{1.0}, std::nullopt, {}});
    VenuePage venue(*session_, RecentVenues(own_->settings));
    AcquirePage acquire(*session_);
    Wizard wizard(*session_);
    wizard.add(venue);
    wizard.add(acquire);
    StepRail rail(wizard, *session_);
    auto* step = rail.findChild<QAbstractButton*>("step-2");
    const auto names = [&rail] {
      QStringList texts;
      for (const QLabel* label : rail.findChildren<QLabel*>()) texts << label->accessibleName();
      return texts;
    };
    const QStringList before = names();
    QVERIFY(before.contains(session_->name()) && step->isEnabled());
    for (VenuePage::Mode mode : {VenuePage::Mode::rehearse, VenuePage::Mode::devices}) {
      venue.setMode(mode);
      QCOMPARE(names(), before);
      QVERIFY(step->isEnabled());
    }
  }

 private:
  void measure() {
    own_->begin();
    AcquirePage acquire(*session_);
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!acquire.isMeasuring() && acquire.isDone(), patience);
  }

  std::unique_ptr<SimulatedSession> own_;
  Session* session_ = nullptr;
};

QTEST_MAIN(TestReadouts)
#include "test_readouts.moc"
