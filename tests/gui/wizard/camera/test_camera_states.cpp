// SPDX-License-Identifier: MIT
// What the camera's page says of what was found, before, while and after somebody looks.
#include <QtTest>
#include <algorithm>
#include <cmath>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "theme/controls.h"
#include "wizard/camera/camera_page.h"
#include "wizard/camera/checks_view.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

QString textsOf(const QWidget& part) {
  QStringList texts;
  for (const QLabel* label : part.findChildren<QLabel*>())
    if (label->isVisibleTo(&part)) texts << label->text();
  return texts.join('\n');
}

}  // namespace

class TestCameraStates : public QObject {
  Q_OBJECT

  std::unique_ptr<SimulatedSession> own_;
  std::unique_ptr<CameraPage> page_;
  std::unique_ptr<QWidget> checks_;

  void look() {
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(page_->look() && !page_->isChecking() && page_->tooDarkEverywhere(), patience);
  }
  void keep() {
    page_->primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->isLooking(), patience);
  }

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    page_ = std::make_unique<CameraPage>(own_->session);
    checks_.reset(checksPart(*page_));
    own_->begin();
  }
  void cleanup() {
    checks_.reset();
    page_.reset();
  }

  /// Law: what was measured by the command line, where nobody looks first, is not locked behind a look.
  void whatIsMeasuredNeedsNoLook() {
    QCOMPARE(page_->status().state, StepState::open);
    Progress silent;
    pipeline::calibrate(own_->path("elsewhere"), smallVenue({48, 36}, {40, 30}, 5), own_->path("cache"),
                        silent);
    own_->session.open(own_->path("elsewhere"));
    QCOMPARE(page_->status().state, StepState::done);
    QVERIFY(!own_->session.result(calibration::Stage::camera));
    QCOMPARE(page_->status().result, CameraPage::tr("Exposures as measured"));
  }

  /// Law: nothing is said to be looked for while nobody looks; what was kept is shown as kept.
  void aPageThatIsOpenedAgainSaysWhatIsKept() {
    QVERIFY(textsOf(*checks_).contains(CameraPage::tr("Not checked yet")));
    look();
    QVERIFY(textsOf(*checks_).contains(CameraPage::tr("The camera sees the projector")));
    QCOMPARE(page_->primary()->text(), CameraPage::tr("Keep exposures"));
    const std::vector<double> found = page_->exposures();
    keep();
    own_->session.open(own_->path("venue"));
    page_->enter();
    QVERIFY(!page_->isLooking() && page_->isKept());
    QVERIFY(page_->exposures() == found);
    const QString said = textsOf(*checks_);
    QVERIFY2(said.contains(CameraPage::tr("Checked before")), qPrintable(said));
    QVERIFY(!said.contains(CameraPage::tr("Checks under way")));
    QCOMPARE(page_->primary()->text(), CameraPage::tr("Continue"));
    QVERIFY(page_->primary()->isEnabled());
  }

  /// Law: the rail says that devices are being checked until every check has its verdict, and no longer.
  void theRailSaysWhetherChecksAreDone() {
    QStringList said;
    connect(page_.get(), &PageModel::statusChanged, page_.get(), [this, &said] {
      if (!page_->isLooking()) return;
      const bool isJudged = page_->tooBrightEverywhere() && page_->tooDarkEverywhere();
      QCOMPARE(page_->status().result, isJudged ? CameraPage::tr("Checks done") : CameraPage::tr("Checking"));
      if (said.isEmpty() || said.last() != page_->status().result) said << page_->status().result;
    });
    look();
    QCOMPARE(said, QStringList({CameraPage::tr("Checking"), CameraPage::tr("Checks done")}));
    keep();
    QVERIFY2(page_->status().result != CameraPage::tr("Checks done"), qPrintable(page_->status().result));
  }

  /// Law: while checks are made anew, what they came to before is neither ticked nor chosen from.
  void checksMadeAnewHaveNoVerdictYet() {
    look();
    page_->finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->isLooking(), patience);
    QVERIFY(textsOf(*checks_).contains(CameraPage::tr("Bright parts are covered")));
    page_->secondary().front()->trigger();
    QVERIFY(page_->isLooking() && page_->exposures().empty() && page_->coverage().empty());
    const QString said = textsOf(*checks_);
    QVERIFY2(said.contains(CameraPage::tr("Checks under way")), qPrintable(said));
    QVERIFY2(!said.contains(CameraPage::tr("Bright parts are covered")), qPrintable(said));
    QTRY_VERIFY_WITH_TIMEOUT(page_->tooDarkEverywhere() && !page_->exposures().empty(), patience);
  }

  /// Law: the best focus is that of this venue and this exposure; what arrives of another venue counts not.
  void theBestFocusIsOfThisVenue() {
    look();
    QTRY_VERIFY_WITH_TIMEOUT(page_->focus() > 0.0, patience);
    own_->begin(smallVenue(), "another");  // while it is still being looked through the first one's
    QCOMPARE(page_->focus(), 0.0);
    QTRY_VERIFY_WITH_TIMEOUT(!page_->isLooking(), patience);
    QCOMPARE(page_->focus(), 0.0);
    QVERIFY(!page_->look() && page_->exposures().empty() && page_->coverage().empty());
  }

  /// Law: in a pause the chosen exposure is the one of the picture that stays, and no other can be chosen.
  void aPauseShowsTheExposureOfItsPicture() {
    look();
    QVERIFY(page_->exposures().size() > 1);
    const std::size_t chosen = page_->exposure() == 0 ? 1 : 0;
    page_->chooseExposure(chosen);
    QTRY_VERIFY_WITH_TIMEOUT(page_->look()->exposure == chosen, patience);
    page_->chooseExposure(1 - chosen);  // and paused before it is looked with
    page_->finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->isLooking(), patience);
    QVERIFY(page_->look()->exposure == page_->exposure());
    const std::size_t shown = page_->exposure();
    page_->chooseExposure(1 - shown);
    QCOMPARE(page_->exposure(), shown);
  }

  void whatIsMissingIsSaid_data() {
    QTest::addColumn<QString>("cells");
    QTest::addColumn<QString>("said");
    QTest::newRow("an edge") << "-+++ -+++ -+++"
                             << "Missing: at the left.";
    QTest::newRow("within") << "++++ +-++ ++++"
                            << "Missing are places within it";
    QTest::newRow("an edge, and within") << "-+++ -+-+ -+++"
                                         << "Missing: at the left, places within it.";
    QTest::newRow("two edges that meet") << "---- -+++ -+++"
                                         << "Missing: at the left, at the top.";
  }
  /// Law: all that the map shows as missing is said.
  void whatIsMissingIsSaid() {
    QFETCH(QString, cells);
    QFETCH(QString, said);
    linearization::Coverage coverage{{4, 3}, {}};
    for (const QChar cell : cells)
      if (cell != ' ') coverage.seen.push_back(cell == '+' ? 1 : 0);
    const QString text = missingText(coverage, false);
    QVERIFY2(text.startsWith(said), qPrintable(text));
  }

  /// Law: how much of the picture is seen is known after the check, and said.
  void coverageIsSaid() {
    look();
    QCOMPARE(page_->coverage().size(), std::size_t{1});
    QVERIFY(page_->coverage().front().share() > 0.9);
    auto* map = checks_->findChild<QWidget*>("coverage-map");
    QVERIFY(map != nullptr && !map->accessibleName().isEmpty());
  }

  /// Law: whole periods are decided once, found again with, kept with the venue, and taken back by undo.
  void exposuresOfWholePeriods() {
    look();
    constexpr double period = 1.0 / 60.0;
    page_->setExposureUnit(period);
    QCOMPARE(own_->session.settings().linearization.exposureUnit, period);
    const auto areWhole = [this] {
      const std::vector<double> exposures = page_->exposures();
      return !exposures.empty() && std::ranges::all_of(exposures, [](double seconds) {
        return std::abs(seconds / period - std::round(seconds / period)) < 1e-6;
      });
    };
    QTRY_VERIFY_WITH_TIMEOUT(page_->isLooking() && !page_->isChecking() && areWhole(), patience);
    QVERIFY(checks_->findChild<QPushButton*>("whole-periods")->isVisibleTo(checks_.get()));
    page_->undoStack().undo();
    QCOMPARE(own_->session.settings().linearization.exposureUnit, 0.0);
    QTRY_VERIFY_WITH_TIMEOUT(page_->isLooking() && !page_->isChecking() && !areWhole(), patience);
  }
};

QTEST_MAIN(TestCameraStates)
#include "test_camera_states.moc"
