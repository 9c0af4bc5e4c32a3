// SPDX-License-Identifier: MIT
// The wizard driven by mouse and keyboard, from the first page to the output window, on a small simulated
// venue. Runs on two screens, see tests/support/with-two-screens.
#include <QLineEdit>
#include <QSlider>
#include <QTemporaryDir>
#include <QtTest>

#include "app/wizard_window.h"
#include "gui/output/two_screens.h"
#include "theme/controls.h"
#include "views/cut_histogram.h"
#include "views/image_view.h"
#include "views/matrix_view.h"
#include "wizard/tile.h"

using namespace relucent;

namespace {

constexpr int patience = 120000;  // milliseconds; what is waited for takes seconds

}  // namespace

class TestWizardWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<WizardWindow> wizard_;

  template <typename Widget>
  Widget* find(const char* name) {
    Widget* widget = wizard_->window().findChild<Widget*>(name);
    if (widget == nullptr) qWarning("there is no %s", name);
    return widget;
  }
  void click(const char* name) {
    auto* button = find<QAbstractButton>(name);
    QVERIFY(button != nullptr);
    QTRY_VERIFY_WITH_TIMEOUT(button->isEnabled() && button->isVisible(), patience);
    QTest::mouseClick(button, Qt::LeftButton);
  }
  /// As where there is no window manager, nobody else gives the keys back after a projector's window.
  void press(QKeySequence keys) {
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    QTest::keySequence(&wizard_->window(), keys);
  }
  std::size_t page() { return wizard_->wizard().current(); }
  void start() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    wizard_ = std::make_unique<WizardWindow>(*settings_, folder_.filePath("cache").toStdString());
    wizard_->venue().setSizes({{{64, 48}, {48, 36}, "%1"}});
    wizard_->venue().setFolder(folder_.filePath("venues"));
    wizard_->window().resize(1366, 768);
    wizard_->window().show();
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
  }

 private slots:
  void initTestCase() { start(); }

  void laterStepsAreLockedAtFirst() {
    for (std::size_t i = 1; i < wizard_->wizard().count(); ++i) QVERIFY(wizard_->wizard().isLocked(i));
    press(QKeySequence("Alt+3"));
    QCOMPARE(page(), std::size_t{0});
  }

  void aRehearsalIsChosenAndBegun() {
    auto* tile = find<Tile>("rehearse");
    QVERIFY(tile != nullptr);
    tile->setFocus();
    QTest::keyClick(tile, Qt::Key_Return);
    QVERIFY(wizard_->venue().mode() == VenuePage::Mode::rehearse);
    auto* plain = find<Tile>("venue-plain");
    QTRY_VERIFY(plain->isVisible());
    QTest::mouseClick(plain, Qt::LeftButton);
    auto* name = find<QLineEdit>("venue-name");
    name->setFocus();
    name->selectAll();
    QTest::keyClicks(name, "Test venue");
    press(QKeySequence("Ctrl+Return"));
    QTRY_COMPARE_WITH_TIMEOUT(page(), std::size_t{1}, patience);
    QCOMPARE(wizard_->session().name(), QString("Test venue"));
  }

  void theCameraIsLookedThrough() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->camera().tooDarkEverywhere().has_value(), patience);
    QVERIFY(!wizard_->camera().exposures().empty());
    QVERIFY(!find<ImageView>("camera-view")->picture().isNull());
    auto* view = find<ImageView>("camera-view");
    Region before = wizard_->camera().focusArea();
    QTest::mouseClick(view, Qt::LeftButton, {}, view->widgetFromPicture({8.5, 8.5}).toPoint());
    QVERIFY(!(wizard_->camera().focusArea() == before));
    click("primary");
    QTRY_COMPARE_WITH_TIMEOUT(page(), std::size_t{2}, patience);
  }

  void theResponseIsMeasured() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().busy().isEmpty(), patience);
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Step::linearization) == StepProgress::done,
                             patience);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->linearize().isMeasuring(), patience);
    QVERIFY(wizard_->linearize().addsUp());
    press(QKeySequence("Ctrl+Return"));
    QTRY_COMPARE(page(), std::size_t{3});
  }

  void theLightTransportIsMeasuredWithAPause() {
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->acquire().photographs() > 5, patience);
    press(QKeySequence("Ctrl+P"));
    QTRY_VERIFY(wizard_->acquire().isPaused());
    press(QKeySequence("Ctrl+P"));
    QTRY_VERIFY(!wizard_->acquire().isPaused());
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Step::acquisition) == StepProgress::done, patience);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->acquire().isMeasuring(), patience);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{4});
  }

  void theCutIsMovedByTheArrowKeys() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->threshold().kept().has_value(), patience);
    auto* histogram = find<CutHistogram>("cut-histogram");
    histogram->setFocus();
    for (int i = 0; i < 5; ++i) QTest::keyClick(histogram, Qt::Key_Right, Qt::ShiftModifier);
    QVERIFY(wizard_->threshold().cut().absolute > 0.0f);
    auto* flood = find<ImageView>("flood-view");
    QTest::mouseClick(flood, Qt::LeftButton, {}, flood->widgetFromPicture({24.5, 18.5}).toPoint());
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->threshold().footprint() != nullptr, patience);
    QVERIFY(wizard_->threshold().footprint()->pixels > 0);
    // The picked row's strongest projector pixel is followed back, and both are an entry of T.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->threshold().lit() != nullptr, patience);
    auto* matrix = find<MatrixView>("matrix-view");
    QTRY_VERIFY_WITH_TIMEOUT(matrix->isSettled() && matrix->valueAt({0, 0}), patience);
    QVERIFY(matrix->link().pick().has_value());
    QPoint entry = *matrix->link().pick();
    QCOMPARE(entry.y(), 18 * 48 + 24);
    QCOMPARE(static_cast<std::size_t>(entry.x()), wizard_->threshold().footprint()->strongest);
    matrix->setFocus();
    QTest::keyClick(matrix, entry.x() > 0 ? Qt::Key_Left : Qt::Key_Right);
    QVERIFY(*matrix->link().pick() != entry);
    QCOMPARE(wizard_->threshold().pickedProjector()->x + 64 * wizard_->threshold().pickedProjector()->y,
             matrix->link().pick()->x());
    click("primary");
    QTRY_COMPARE(page(), std::size_t{5});
  }

  void theClustersFollowTheSlider() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->cluster().result() && !wizard_->cluster().isComputing(), patience);
    auto before = wizard_->cluster().result();
    auto* distance = find<QSlider>("distance");
    distance->setFocus();
    QTest::keyClick(distance, Qt::Key_Left);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->cluster().result() != before, patience);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{6});
  }

  void thePreviewComparesMethods() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->preview().table().size() >= 5, patience);
    const std::vector<MethodPreview>& table = wizard_->preview().table();
    // The law of the product: knowing the light transport is better than not correcting at all.
    QVERIFY(table[3].psnr > table[0].psnr);
    QVERIFY(table[4].psnr >= table[3].psnr - 0.5);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{7});
  }

  void theOutputShinesOnTheSecondScreen() {
    QVERIFY(wizard_->output().chosen().has_value());
    QVERIFY(!wizard_->output().screens()[*wizard_->output().chosen()].operators);
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->output().onProjector().isNull(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(!allBlack(seenOn("DUMMY1")), patience);
    wizard_->output().setBlack(true);
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    wizard_->output().setBlack(false);
    QTRY_VERIFY(!allBlack(seenOn("DUMMY1")));
    click("primary");
    QTRY_VERIFY(!wizard_->output().isOpen());
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
  }

  void aChangedThresholdMakesLaterStepsOutOfDate() {
    press(QKeySequence("Alt+5"));
    QTRY_COMPARE(page(), std::size_t{4});
    wizard_->threshold().setAbsolute(1e-3);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->threshold().kept().has_value(), patience);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{5});
    QVERIFY(wizard_->wizard().page(5).status().state == StepState::outOfDate);
    QVERIFY(wizard_->wizard().page(6).status().state == StepState::outOfDate);
    QVERIFY(!wizard_->wizard().isLocked(7));
    QVERIFY(wizard_->wizard().page(5).banner().has_value());
  }

  void openedAgainItStandsWhereItStood() {
    wizard_->window().close();
    wizard_.reset();
    start();
    QCOMPARE(wizard_->venue().recent().size(), 1);
    wizard_->venue().open(wizard_->venue().recent().front().folder);
    QCOMPARE(page(), std::size_t{7});
  }

  void cleanupTestCase() { wizard_.reset(); }
};

QTEST_MAIN(TestWizardWindow)
#include "test_wizard_window.moc"
