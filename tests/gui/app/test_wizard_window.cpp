// SPDX-License-Identifier: MIT
// The wizard driven by mouse and keyboard, from the first page to the output window, on a small simulated
// venue. Runs on two screens, see tests/support/with-two-screens.
#include <QCheckBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QLineEdit>
#include <QMimeData>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>

#include "app/help_window.h"
#include "app/wizard_command.h"
#include "app/wizard_window.h"
#include "gui/output/two_screens.h"
#include "output/installation.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/cut_histogram.h"
#include "views/image_view.h"
#include "views/matrix_view.h"
#include "views/vtk_view.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/devices/nudge_dialog.h"
#include "wizard/frame/failure_dialog.h"
#include "wizard/frame/step_rail.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/output_page.h"
#include "wizard/output/playlist_view.h"
#include "wizard/output/proof_file.h"
#include "wizard/preview/corner_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::pipeline;

namespace {

constexpr int patience = 120000;  // milliseconds; what is waited for takes seconds

}  // namespace

class TestWizardWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<WizardWindow> wizard_;
  QUrl shown_;
  decltype(CalibrateSettings::threshold) thresholdOfProof_;

  /// Stages of a page share names: what is in sight is meant.
  template <typename Widget>
  Widget* find(const char* name) {
    const QList<Widget*> widgets = wizard_->window().findChildren<Widget*>(name);
    if (widgets.isEmpty()) qWarning("there is no %s", name);
    const auto inSight =
        std::find_if(widgets.begin(), widgets.end(), [](Widget* widget) { return widget->isVisible(); });
    return inSight != widgets.end() ? *inSight : widgets.value(0);
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
  /// Of the rail's buttons.
  void wordsHaveRoom() {
    for (const char* name : {"open-settings", "open-help"}) {
      const auto* button = find<QPushButton>(name);
      QVERIFY2(!button->text().isEmpty(), name);
      QVERIFY2(button->width() >= button->sizeHint().width(), name);
    }
  }
  void start() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    wizard_ = std::make_unique<WizardWindow>(*settings_, folder_.filePath("cache").toStdString());
    wizard_->page<VenuePage>().setSizes({{{64, 48}, {48, 36}, "%1"}});
    wizard_->page<VenuePage>().setFolder(folder_.filePath("venues"));
    wizard_->window().resize(1366, 768);
    wizard_->window().show();
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
  }
  void shineOnTheSecondScreen() {
    OutputPage& output = wizard_->page<OutputPage>();
    for (std::size_t i = 0; i < output.screens().size(); ++i)
      if (output.screens()[i].identity.connector == "DUMMY1") output.choose(i);
  }
  void pickInTheMatrix() {
    auto* matrix = find<MatrixView>("matrix-view");
    QTRY_VERIFY_WITH_TIMEOUT(matrix->isSettled() && matrix->valueAt({0, 0}), patience);
    QVERIFY(matrix->link().pick().has_value());
    QPoint entry = *matrix->link().pick();
    QCOMPARE(entry.y(), 18 * 48 + 24);
    QCOMPARE(static_cast<std::size_t>(entry.x()), wizard_->page<ThresholdPage>().footprint()->strongest);
    matrix->setFocus();
    QTest::keyClick(matrix, entry.x() > 0 ? Qt::Key_Left : Qt::Key_Right);
    QVERIFY(*matrix->link().pick() != entry);
    QCOMPARE(wizard_->page<ThresholdPage>().pickedProjector()->x +
                 64 * wizard_->page<ThresholdPage>().pickedProjector()->y,
             matrix->link().pick()->x());
  }

 public:
  /// In place of the desktop, which would show a report.
  Q_INVOKABLE void show(const QUrl& url) { shown_ = url; }

  void theCutIsTypedOrPicked() {
    ThresholdPage& threshold = wizard_->page<ThresholdPage>();
    const auto before = static_cast<double>(threshold.cut().absolute);
    auto* typed = find<QLineEdit>("cut-value");
    typed->setFocus();
    typed->selectAll();
    QTest::keyClicks(typed, "0.002");
    QTest::keyClick(typed, Qt::Key_Return);
    QCOMPARE(threshold.cut().absolute, 0.002f);
    typed->selectAll();
    QTest::keyClicks(typed, "two");
    QTest::keyClick(typed, Qt::Key_Return);
    QCOMPARE(threshold.cut().absolute, 0.002f);
    QCOMPARE(typed->text(), QString("0.002"));
    QVERIFY(threshold.pickedLight().has_value());
    click("use-picked");
    QCOMPARE(threshold.cut().absolute, static_cast<float>(*threshold.pickedLight()));
    threshold.setAbsolute(2.0 * threshold.suggested() + 1e-3);
    click("use-suggested");
    QCOMPARE(threshold.cut().absolute, static_cast<float>(threshold.suggested()));
    threshold.setAbsolute(before);
    QTRY_VERIFY_WITH_TIMEOUT(threshold.isExact(), patience);
  }

 private slots:
  void initTestCase() { start(); }

  void aWindowThatHasNoRoomIsMaximized_data() {
    QTest::addColumn<QSize>("screen");
    QTest::addColumn<bool>("fits");
    QTest::newRow("a laptop's, without its panel") << QSize(1366, 740) << false;
    QTest::newRow("a laptop's, without any panel") << QSize(1366, 768) << false;
    QTest::newRow("larger") << QSize(1920, 1040) << true;
  }
  void aWindowThatHasNoRoomIsMaximized() {
    QFETCH(QSize, screen);
    QFETCH(bool, fits);
    QCOMPARE(hasRoom({1366, 768}, screen), fits);
  }

  void theFirstChoiceHasTheFocus() {
    QTRY_VERIFY(wizard_->window().focusWidget() != nullptr);
    QCOMPARE(wizard_->window().focusWidget()->objectName(), QString("rehearse"));
  }

  void aClickOnTheReasonLeadsToItsCause() {
    wizard_->page<VenuePage>().setMode(VenuePage::Mode::devices);
    wizard_->page<VenuePage>().chooseScreen({{"DUMMY1", "", "", ""}, {64, 48}, 60.0, "Screen 1", {}});
    QCOMPARE(wizard_->page<VenuePage>().problem(), VenuePage::tr("Confirm that the room is clear."));
    auto* tick = find<QAbstractButton>("room-is-clear");
    wizard_->window().resize(1100, 560);
    auto inSight = [tick] { return tick->visibleRegion().boundingRect() == tick->rect(); };
    QTRY_VERIFY(inSight());
    // Somebody has scrolled to what stands below it.
    const QScrollArea* scroll = nullptr;
    for (QWidget* around = tick; around != nullptr && scroll == nullptr; around = around->parentWidget())
      scroll = qobject_cast<QScrollArea*>(around);
    QVERIFY(scroll != nullptr);
    scroll->verticalScrollBar()->setValue(scroll->verticalScrollBar()->maximum());
    QTRY_VERIFY(!inSight());
    QTest::mouseClick(find<QLabel>("hint"), Qt::LeftButton);
    QVERIFY(tick->hasFocus());
    QTRY_VERIFY(inSight());
    wizard_->window().resize(1366, 768);
    wizard_->page<VenuePage>().setMode(VenuePage::Mode::start);
  }

  /// Law: what goes when it is pressed leaves the next key to nobody: the room is said to be clear by whoever
  /// means it.
  void whatGoesLeavesItsKeyToNobody() {
    auto& venue = wizard_->page<VenuePage>();
    devices::ListedCamera camera;
    camera.address = "genicam:1";
    camera.model = Message::plain("Camera");
    camera.usable = true;
    camera.traits.size = {64, 48};
    venue.finder().setLister([camera] { return devices::CameraList{{}, {camera}}; });
    venue.setMode(VenuePage::Mode::devices);
    // Those of this computer may still be looked for.
    QTRY_VERIFY_WITH_TIMEOUT(!venue.finder().isLooking(), patience);
    venue.finder().look();
    QTRY_VERIFY_WITH_TIMEOUT(!venue.finder().isLooking(), patience);
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    const auto* tick = find<QAbstractButton>("room-is-clear");
    for (int times = 0; times < 2; ++times) {  // added, removed
      QTRY_VERIFY(find<QAbstractButton>("choose-camera")->isVisible());
      auto* choose = find<QAbstractButton>("choose-camera");
      choose->setFocus();
      QVERIFY(choose->hasFocus());
      for (int presses = 0; presses < 2; ++presses) {
        QWidget* focus = wizard_->window().focusWidget();
        QTest::keyClick(focus != nullptr ? focus : &wizard_->window(), Qt::Key_Space);
        QVERIFY(!tick->isChecked() && !tick->hasFocus());
      }
      QCoreApplication::processEvents();
      QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
      QVERIFY(!tick->hasFocus());
    }
    venue.setMode(VenuePage::Mode::start);
  }

  void enterOnTheOpenStepLeadsIntoIt() {
    auto* step = find<QAbstractButton>("step-1");
    step->setFocus();
    QTRY_VERIFY(step->hasFocus());
    QTest::keyClick(step, Qt::Key_Return);
    QCOMPARE(page(), std::size_t{0});
    QTRY_COMPARE(wizard_->window().focusWidget(), find<QWidget>("rehearse"));
  }

  void laterStepsAreLockedAtFirst() {
    for (std::size_t i = 1; i < wizard_->wizard().count(); ++i) QVERIFY(wizard_->wizard().isLocked(i));
    press(QKeySequence("Alt+3"));
    QCOMPARE(page(), std::size_t{0});
  }

  /// A press that opens nothing says why.
  void aLockedStepSaysWhatOpensIt() {
    auto* step = find<StepButton>("step-5");
    QVERIFY(!step->isEnabled());
    QTest::mouseClick(step, Qt::LeftButton);
    QCOMPARE(page(), std::size_t{0});
    QCOMPARE(find<QLabel>("strip-saved")->accessibleName(), step->accessibleDescription());
    QVERIFY(!step->accessibleDescription().isEmpty());
  }

  void theGuideIsSearched() {
    QTest::keyClick(&wizard_->window(), Qt::Key_F1);
    auto* help = find<HelpWindow>("help");
    QVERIFY(help != nullptr && QTest::qWaitForWindowExposed(help));
    auto* pages = find<QListWidget>("help-pages");
    // A page a step, and what belongs to no step.
    QVERIFY(pages->count() > static_cast<int>(wizard_->wizard().count()));
    auto* text = find<QTextBrowser>("help-text");
    QVERIFY(text->toPlainText().contains("Venue"));
    QTest::keyClicks(find<QLineEdit>("help-search"), "playlist repeats");
    QCOMPARE(pages->count(), 1);
    QVERIFY(text->toPlainText().contains("verification photograph"));
    QTest::keyClick(help, Qt::Key_Escape);
    QTRY_VERIFY(!help->isVisible());
    // Asked for by the mouse, it leaves the focus where it was: Enter still does what the page says.
    find<Tile>("rehearse")->setFocus();
    click("open-help");
    QTRY_VERIFY(help->isVisible());
    help->close();
    QCOMPARE(wizard_->window().focusWidget(), find<QWidget>("rehearse"));
  }

  void settingsActAtOnceAndAreKept() {
    click("open-settings");
    QTRY_VERIFY(find<QDialog>("settings") != nullptr);
    auto* look = find<Segmented>("settings-look");
    QTest::mouseClick(look->findChildren<QAbstractButton*>()[1], Qt::LeftButton);
    QVERIFY(Theme::instance().look() == Look::light);
    QVERIFY(Preferences(*settings_).isLight());
    QTest::mouseClick(look->findChildren<QAbstractButton*>()[0], Qt::LeftButton);
    QVERIFY(Theme::instance().look() == Look::dark);
    auto* dim = find<QCheckBox>("settings-dim");
    dim->setFocus();
    QTest::keyClick(dim, Qt::Key_Space);
    QVERIFY(Theme::instance().isDimmed());
    QTest::keyClick(dim, Qt::Key_Space);
    QVERIFY(!Theme::instance().isDimmed());
    click("close-settings");
    QTRY_VERIFY(wizard_->window().findChild<QDialog*>("settings") == nullptr);
  }

  void theProjectorsScreenIsIdentified() {
    wizard_->page<VenuePage>().setMode(VenuePage::Mode::script);
    click("identify");
    QTRY_VERIFY(!allBlack(seenOn("DUMMY1")));
    // Its outermost pixels are lit: nothing is cut off.
    auto lit = [](const QImage& seen, int x, int y) { return (seen.pixel(x, y) & 0xffffffu) != 0; };
    QTRY_VERIFY(lit(seenOn("DUMMY1"), 0, 0));
    QImage seen = seenOn("DUMMY1");
    QVERIFY(lit(seen, seen.width() - 1, seen.height() - 1) && !lit(seen, 1, 1));
    press(QKeySequence(Qt::Key_Escape));
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));

    // A chosen screen that is unplugged keeps its card.
    click("venue-screen-DUMMY1");
    QVERIFY((wizard_->page<VenuePage>().script().projector == Size{1024, 768}));
    QVERIFY(find<Tile>("venue-screen-DUMMY1")->accessibleName().endsWith("chosen"));
    auto gone = [&] {
      QList<Tile*> tiles = wizard_->window().findChildren<Tile*>();
      return std::count_if(tiles.begin(), tiles.end(), [](Tile* tile) { return tile->isDashed(); });
    };
    QCOMPARE(gone(), 0);
    unplug();
    QTRY_COMPARE(gone(), 1);
    plug();
    QTRY_COMPARE(gone(), 0);
    QTRY_VERIFY(find<Tile>("venue-screen-DUMMY1")->isChecked());
    wizard_->page<VenuePage>().setMode(VenuePage::Mode::start);
  }

  void aRehearsalIsChosenAndBegun() {
    auto* tile = find<Tile>("rehearse");
    QVERIFY(tile != nullptr);
    tile->setFocus();
    QTest::keyClick(tile, Qt::Key_Return);
    QVERIFY(wizard_->page<VenuePage>().mode() == VenuePage::Mode::rehearse);
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
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<CameraPage>().tooDarkEverywhere().has_value(), patience);
    QVERIFY(!wizard_->page<CameraPage>().exposures().empty());
    QVERIFY(!find<ImageView>("camera-view")->picture().isNull());
    auto* view = find<ImageView>("camera-view");
    Region before = wizard_->page<CameraPage>().focusArea();
    QTest::mouseClick(view, Qt::LeftButton, {}, view->widgetFromPicture({8.5, 8.5}).toPoint());
    QVERIFY(!(wizard_->page<CameraPage>().focusArea() == before));
    // What the hatches mean is said where there are any, and the lens is not blamed for an exposure.
    wizard_->page<CameraPage>().chooseExposure(0);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<CameraPage>().look()->check.tooBright > 0.0, patience);
    QTRY_VERIFY(find<QLabel>("too-bright")->isVisible());
    click("primary");
    QTRY_COMPARE_WITH_TIMEOUT(page(), std::size_t{2}, patience);
  }

  void theResponseIsMeasured() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().areDevicesFree(), patience);
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Stage::linearization) == StageProgress::done,
                             patience);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->page<LinearizePage>().isMeasuring(), patience);
    QVERIFY(wizard_->page<LinearizePage>().addsUp());
    // Enter leads on after a job, not back.
    QTRY_COMPARE(wizard_->window().focusWidget(), find<QWidget>("primary"));
    QTest::keyClick(wizard_->window().focusWidget(), Qt::Key_Return);
    QTRY_COMPARE(page(), std::size_t{3});
  }

  void theLightTransportIsMeasuredWithAPause() {
    const std::optional<WorkLeft> expected = wizard_->page<AcquirePage>().expected();
    QVERIFY(expected && expected->shots > 0 && expected->seconds > 0.0);
    QVERIFY(!wizard_->page<AcquirePage>().verificationError());
    QVERIFY(find<ImageView>("pattern-view")->picture().isNull());  // of the step before
    QVERIFY(!find<QLabel>("room-light")->isVisible());
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<AcquirePage>().photographs() > 5, patience);
    press(QKeySequence("Ctrl+P"));
    QTRY_VERIFY(wizard_->page<AcquirePage>().isPaused());
    // It is not ended by the way.
    QVERIFY(!wizard_->window().close());
    auto* question = find<FailureDialog>("failure");
    QVERIFY(question != nullptr && question->isVisible());
    QVERIFY(question->windowTitle().contains("under way"));
    QTest::keyClick(question, Qt::Key_Escape);
    QTRY_VERIFY(wizard_->window().findChild<FailureDialog*>() == nullptr);
    QVERIFY(wizard_->window().isVisible() && wizard_->page<AcquirePage>().isPaused());
    press(QKeySequence("Ctrl+P"));
    QTRY_VERIFY(!wizard_->page<AcquirePage>().isPaused());
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Stage::acquisition) == StageProgress::done,
                             patience);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->page<AcquirePage>().isMeasuring(), patience);
    QVERIFY(wizard_->page<AcquirePage>().verificationError().has_value());
    QVERIFY(wizard_->session().roomLight().has_value());
    QVERIFY(find<QLabel>("room-light")->isVisible());
    QVERIFY(find<QLabel>("room-light")->text().contains("steady"));
    click("primary");
    QTRY_COMPARE(page(), std::size_t{4});
  }

  void theCutIsMovedByTheArrowKeys() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<ThresholdPage>().kept().has_value(), patience);
    auto* histogram = find<CutHistogram>("cut-histogram");
    histogram->setFocus();
    for (int i = 0; i < 5; ++i) QTest::keyClick(histogram, Qt::Key_Right, Qt::ShiftModifier);
    QVERIFY(wizard_->page<ThresholdPage>().cut().absolute > 0.0f);
    auto* flood = find<ImageView>("flood-view");
    QTest::mouseClick(flood, Qt::LeftButton, {}, flood->widgetFromPicture({24.5, 18.5}).toPoint());
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<ThresholdPage>().footprint() != nullptr, patience);
    QVERIFY(wizard_->page<ThresholdPage>().footprint()->pixels > 0);
    // The picked row's strongest projector pixel is followed back, and both are an entry of T.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<ThresholdPage>().lit() != nullptr, patience);
    if (VtkView::isPossible())
      pickInTheMatrix();
    else
      QVERIFY(find<MatrixView>("matrix-view")->findChild<QLabel*>()->isVisible());
    theCutIsTypedOrPicked();
    QVERIFY(!wizard_->page<VenuePage>().recent().front().picture.isNull());  // it is measured
    click("primary");
    QTRY_COMPARE(page(), std::size_t{5});
  }

  void theClustersFollowTheSlider() {
    QTRY_VERIFY_WITH_TIMEOUT(
        wizard_->page<ClusterPage>().result() && !wizard_->page<ClusterPage>().isComputing(), patience);
    auto before = wizard_->page<ClusterPage>().result();
    auto* distance = find<QSlider>("distance");
    distance->setFocus();
    QTest::keyClick(distance, Qt::Key_Left);
    // The map comes before its errors, and only with these it can be gone on.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<ClusterPage>().result() != before, patience);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->page<ClusterPage>().isComputing(), patience);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{6});
  }

  void thePreviewComparesMethods() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<PreviewPage>().table().size() >= 5, patience);
    const std::vector<MethodPreview>& table = wizard_->page<PreviewPage>().table();
    // The law of the product: knowing the light transport is better than not correcting at all.
    QVERIFY(table[3].psnr > table[0].psnr);
    QVERIFY(table[4].psnr >= table[3].psnr - 0.5);
    auto* methods = find<QTableWidget>("methods");
    QTest::mouseClick(methods->viewport(), Qt::LeftButton, {},
                      methods->visualItemRect(methods->item(4, 0)).center());
    QVERIFY(wizard_->page<PreviewPage>().settings().method == Method::optimum);
  }

  /// Whoever has only keys gets past everything on a page: from the stage to the button that leads on and to
  /// the rail.
  void tabLeadsAroundEveryPage() {
    const std::size_t before = page();
    for (std::size_t i = 0; i < wizard_->wizard().count(); ++i) {
      if (wizard_->wizard().isLocked(i)) continue;
      wizard_->wizard().go(i);
      wizard_->window().activateWindow();
      QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
      QStringList met;
      constexpr int enough = 80;
      for (int key = 0; key < enough; ++key) {
        QWidget* focus = wizard_->window().focusWidget();
        QVERIFY(focus != nullptr);
        met << focus->objectName();
        QTest::keyClick(focus, Qt::Key_Tab);
      }
      const QByteArray told = wizard_->wizard().page(i).name().toUtf8() + ": " + met.join(", ").toUtf8();
      QVERIFY2(met.contains("step-1"), told.constData());
      const auto* primary = find<QWidget>("primary");
      QVERIFY2(!primary->isVisible() || !primary->isEnabled() || met.contains("primary"), told.constData());
    }
    wizard_->wizard().go(before);
  }

  void theContentIsPlacedByMouseAndKeyboard() {
    PreviewPage& preview = wizard_->page<PreviewPage>();
    auto* view = find<CornerView>("preview-view");
    Corners before = *preview.corners();
    auto at = [&](double x, double y) { return view->widgetFromPicture({x, y}).toPoint(); };
    QPoint grip = at(before[0][0], before[0][1]), to = at(before[0][0] + 4.0, before[0][1] + 3.0);
    QTest::mousePress(view, Qt::LeftButton, {}, grip);
    QTest::mouseMove(view, to);
    QTest::mouseRelease(view, Qt::LeftButton, {}, to);
    QVERIFY(preview.settings().corners.has_value());
    Corners dragged = *preview.corners();
    QVERIFY(std::abs(dragged[0][0] - before[0][0] - 4.0) < 0.5);
    QCOMPARE(dragged[2], before[2]);

    // The last corner of the Tab order, by the keys.
    view->setFocus(Qt::TabFocusReason);
    QCOMPARE(view->active(), 0);
    QTest::keyClick(view, Qt::Key_Tab);
    QTest::keyClick(view, Qt::Key_Tab);
    QCOMPARE(view->active(), 2);
    QTest::keyClick(view, Qt::Key_Left);
    QCOMPARE((*preview.corners())[2][0], dragged[2][0] - 1.0);
    QTest::keyClick(view, Qt::Key_Up, Qt::ShiftModifier);
    QVERIFY((*preview.corners())[2][1] < dragged[2][1]);
    QCOMPARE(view->accessibleDescription(), view->cornerText(2));
    QVERIFY(view->accessibleDescription().startsWith("Bottom right corner, "));

    // Crossed corners are said, and refused.
    Corners good = *preview.corners();
    preview.setCorners({good[1], good[0], good[2], good[3]});
    QVERIFY(!preview.problem().isEmpty());
    QCOMPARE(*preview.corners(), good);

    double divider = view->divider();
    QTest::keyClick(view, Qt::Key_D);
    QVERIFY(view->divider() != divider);

    press(QKeySequence("Ctrl+Z"));
    QVERIFY(!(*preview.corners() == good));
    press(QKeySequence("Ctrl+Shift+Z"));
    QCOMPARE(*preview.corners(), good);
    QTRY_VERIFY_WITH_TIMEOUT(!preview.isComputing() && preview.problem().isEmpty(), patience);
    click("place-automatically");
    QVERIFY(!preview.settings().corners);
    QTRY_VERIFY_WITH_TIMEOUT(!preview.isComputing(), patience);
    click("primary");
    QTRY_COMPARE(page(), std::size_t{7});
  }

  void theOutputShinesOnTheSecondScreen() {
    OutputPage& output = wizard_->page<OutputPage>();
    QVERIFY(output.chosen().has_value());
    // A rehearsal shines nowhere until somebody says where.
    QVERIFY(output.screens()[*output.chosen()].isPageOnly);
    find<QComboBox>("output-screen")->setFocus();
    QTest::keyClick(find<QComboBox>("output-screen"), Qt::Key_D);  // which DUMMY1 begins with
    QVERIFY(output.screens()[*output.chosen()].isPageOnly);
    shineOnTheSecondScreen();
    QVERIFY(!output.screens()[*output.chosen()].operators && !output.screens()[*output.chosen()].isPageOnly);
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    click("primary");
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->page<OutputPage>().projection().onProjector().isNull(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(!allBlack(seenOn("DUMMY1")), patience);
    auto* view = find<ImageView>("output-view");
    // The operator sees it too, no larger than there is room.
    QTRY_VERIFY_WITH_TIMEOUT(!view->picture().isNull(), patience);
    QVERIFY(!allBlack(view->picture()));
    QVERIFY(view->picture().width() <= view->width() * view->devicePixelRatioF());
    // The projector's window left the keys where they were.
    QVERIFY(wizard_->window().isActiveWindow());
    // While A is held, wherever on the page the focus is, but where letters are typed.
    for (QWidget* where : {static_cast<QWidget*>(view), find<QWidget>("verify")}) {
      where->setFocus();
      QTest::keyPress(where, Qt::Key_A);
      QVERIFY(!wizard_->page<OutputPage>().isCompensated());
      // As some X servers repeat it.
      for (int repeat = 0; repeat < 3; ++repeat) {
        QTest::keyRelease(where, Qt::Key_A);
        QTest::keyPress(where, Qt::Key_A);
        QCoreApplication::processEvents();
        QVERIFY(!wizard_->page<OutputPage>().isCompensated());
      }
      QTest::keyRelease(where, Qt::Key_A);
      QTRY_VERIFY(wizard_->page<OutputPage>().isCompensated());
      QTest::keyClick(where, Qt::Key_B);
      QVERIFY(wizard_->page<OutputPage>().isBlack());
      QTest::keyClick(where, Qt::Key_B);
      QVERIFY(!wizard_->page<OutputPage>().isBlack());
    }
    // In a closed list they are meant no less, and no screen is chosen by them.
    auto* screens = find<QComboBox>("output-screen");
    const std::optional<std::size_t> screen = output.chosen();
    screens->setFocus();
    QTest::keyClick(screens, Qt::Key_T);
    QVERIFY(output.isOpen() && output.chosen() == screen && output.projection().showsChart());
    for (std::size_t i = 0; i < allTestCharts.size(); ++i) QTest::keyClick(screens, Qt::Key_T);
    QVERIFY(!output.projection().showsChart());
    // Nor in the playlist, where a letter would choose what begins with it.
    auto* list = find<QWidget>("playlist");
    list->setFocus();
    QTest::keyClick(list, Qt::Key_B);
    QVERIFY(output.isBlack());
    QTest::keyClick(list, Qt::Key_B);
    QVERIFY(!output.isBlack());
    view->setFocus();
    QTest::keyClick(view, Qt::Key_Space);
    QVERIFY(wizard_->page<OutputPage>().isFrozen());
    QTest::keyClick(view, Qt::Key_Space);
    QTest::keyClick(view, Qt::Key_B);
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QTRY_VERIFY(allBlack(view->picture()));
    QTest::keyClick(view, Qt::Key_B);
    QTRY_VERIFY(!allBlack(seenOn("DUMMY1")));
  }

  void thePlaylistIsEditedByMouseAndKeyboard() {
    OutputPage& output = wizard_->page<OutputPage>();
    QImage picture(40, 30, QImage::Format_RGB32);
    picture.fill(Qt::darkGreen);
    QString file = folder_.filePath("green.png");
    QVERIFY(picture.save(file));
    auto* list = find<PlaylistView>("playlist");
    QCOMPARE(list->count(), 1);
    QMimeData files;
    files.setUrls({QUrl::fromLocalFile(file)});
    QDragEnterEvent enter(QPoint(5, 5), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(list->viewport(), &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(QPointF(5, 5), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(list->viewport(), &drop);
    QCOMPARE(list->count(), 2);
    QCOMPARE(output.playlist().settings().items[1].path, file);
    list->setFocus();
    list->setCurrentRow(1);
    QTest::keyClick(list, Qt::Key_Up, Qt::ControlModifier);
    QCOMPARE(output.playlist().settings().items[0].path, file);
    QCOMPARE(list->currentRow(), 0);
    QTRY_COMPARE_WITH_TIMEOUT(output.projection().playing(), qsizetype{0}, patience);
    click("playlist-down");
    QCOMPARE(output.playlist().settings().items[1].path, file);
    QTest::keyClick(list, Qt::Key_Delete);
    QCOMPARE(list->count(), 1);
    press(QKeySequence("Ctrl+Z"));
    QCOMPARE(list->count(), 2);
    // What was taken back is said, and what it was.
    const QString said = find<QLabel>("strip-saved")->accessibleName();
    QVERIFY2(said.startsWith("Undone: ") && said.size() > QString("Undone: ").size(), qPrintable(said));
    QVERIFY(QFileInfo::exists(output.playlist().file()));
    list->setCurrentRow(1);
    click("playlist-remove");
    QCOMPARE(list->count(), 1);
  }

  /// Law: a show that plays is ended by an answer only.
  void thePlayingShowEndsOnlyWhenToldTo() {
    OutputPage& output = wizard_->page<OutputPage>();
    const auto answer = [this](const char* words) {
      auto* question = find<FailureDialog>("failure");
      QVERIFY(question != nullptr && question->isVisible());
      QCOMPARE(question->windowTitle(), QString("A show is playing"));
      for (QPushButton* button : question->findChildren<QPushButton*>())
        if (button->text() == words) return QTest::mouseClick(button, Qt::LeftButton);
      QFAIL(words);
    };
    const auto isAnswered = [this] { return wizard_->window().findChild<FailureDialog*>() == nullptr; };
    QVERIFY(output.isOpen());
    QVERIFY(!wizard_->window().close());
    answer("Go on playing");
    QTRY_VERIFY(isAnswered());
    QVERIFY(wizard_->window().isVisible() && output.isOpen());
    // Nor does a rehearsal end it, nor another venue.
    VenuePage& venue = wizard_->page<VenuePage>();
    const QString name = wizard_->session().name();
    venue.setMode(VenuePage::Mode::rehearse);
    venue.primary()->trigger();
    answer("Go on playing");
    QTRY_VERIFY(isAnswered());
    wizard_->open(QString::fromStdString(wizard_->session().path().string()));
    answer("Go on playing");
    QTRY_VERIFY(isAnswered());
    QVERIFY(output.isOpen() && wizard_->session().name() == name);
    venue.setMode(VenuePage::Mode::start);
  }

  void aPhotographProvesIt() {
    OutputPage& output = wizard_->page<OutputPage>();
    // The proof comes first.
    QCOMPARE(output.primary()->text(), OutputPage::tr("Take verification photograph"));
    press(QKeySequence("Ctrl+Shift+V"));
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().proof() != nullptr, patience);
    const Proof& proof = *output.proof().proof();
    // What was chosen at Preview reaches the projector.
    QVERIFY(proof.figures.method == Method::optimum);
    QVERIFY(find<QWidget>("method-note")->isVisible());
    const ProofView& view = proof.view(0);
    QVERIFY(!view.photograph.isNull() && view.photograph.size() == view.wanted.size());
    QVERIFY(proof.figures.after.measured.deltaE < proof.figures.before.measured.deltaE);
    QVERIFY(!find<ImageView>("photograph-view")->picture().isNull());
    QVERIFY(output.isOpen());  // a simulated camera is in nobody's way
    // Where a rehearsal ends, and why, is said.
    QCOMPARE(output.primary()->text(), OutputPage::tr("Install show"));
    QVERIFY(!output.primary()->isEnabled() && output.hint().contains("not installed"));
    QCOMPARE(output.secondary().size(), std::size_t{3});
    // What cannot be pressed while it works leaves its key to no other button, and has it again.
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    auto* check = find<QWidget>("check-drift");
    check->setFocus();
    QTest::keyClick(check, Qt::Key_Space);
    QTRY_VERIFY(!check->isEnabled());
    QTRY_VERIFY(qobject_cast<QAbstractButton*>(wizard_->window().focusWidget()) == nullptr);
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().drift().has_value(), patience);
    QTRY_COMPARE(wizard_->window().focusWidget(), check);
    QVERIFY(output.proof().drift()->verdict == Verdict::stillGood);
  }

  void chartsAndFiguresAreShown() {
    OutputProjection& projection = wizard_->page<OutputPage>().projection();
    click("next-chart");
    QVERIFY(projection.showsChart());
    for (std::size_t i = 0; i < allTestCharts.size(); ++i) click("next-chart");
    QVERIFY(!projection.showsChart());
    click("figures");
    QVERIFY(projection.hasOverlay());
    click("figures");
    QVERIFY(!projection.hasOverlay());
  }

  void theVenueIsHandedOver() {
    OutputPage& output = wizard_->page<OutputPage>();
    output.setConfigFolder(folder_.filePath("config"));
    // Where no program opens it, it is written all the same, which is no failure, and said where it lies.
    QDesktopServices::setUrlHandler("file", this, "nobody");
    click("report");
    const auto* written = find<QLabel>("report-written");
    QTRY_VERIFY_WITH_TIMEOUT(written->isVisible(), patience);
    QVERIFY(wizard_->window().findChild<FailureDialog*>() == nullptr);
    QVERIFY(written->text().contains("report.html") && written->text().contains("No program here opens it"));
    QDesktopServices::setUrlHandler("file", this, "show");
    click("report");
    QTRY_VERIFY_WITH_TIMEOUT(shown_.isValid(), patience);
    QTRY_VERIFY(!written->text().contains("No program"));
    QDesktopServices::unsetUrlHandler("file");
    QFileInfo page(shown_.toLocalFile());
    QVERIFY(page.size() > 1000);
    for (const char* beside : {"report.pdf", "support.zip"})
      QVERIFY2(QFileInfo(page.dir().filePath(beside)).size() > 1000, beside);
    QVERIFY(find<QLabel>("report-written")->text().contains("report.html"));
    // A real venue's show that was installed before.
    QVERIFY(!find<QWidget>("remove-installed")->isVisible());
    install(Start::autostart, folder_.filePath("config"), "relucent", {"show", "/venues/another"});
    output.setConfigFolder(folder_.filePath("config"));
    // Asked first, and not removed by whoever presses Enter.
    for (const char* answer : {"Keep", "Remove"}) {
      QVERIFY(gui::isInstalled(Start::autostart, folder_.filePath("config")));
      click("remove-installed");
      auto* question = wizard_->window().findChild<FailureDialog*>();
      QVERIFY(question != nullptr && question->windowTitle() == "Remove installed show");
      const QList<QLabel*> labels = question->findChildren<QLabel*>();
      QVERIFY(std::ranges::any_of(
          labels, [](const QLabel* label) { return label->text().contains("another venue"); }));
      for (QPushButton* button : question->findChildren<QPushButton*>()) {
        if (button->isDefault()) QCOMPARE(button->text(), QString("Keep"));
        if (button->text() == answer) button->click();
      }
      QTRY_VERIFY(wizard_->window().findChild<FailureDialog*>() == nullptr);
    }
    QVERIFY(!gui::isInstalled(Start::autostart, folder_.filePath("config")));
    QVERIFY(!find<QWidget>("remove-installed")->isVisible());
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    // What a banner offers goes with it, and leaves the focus on nothing that the next Enter would do
    // unasked.
    output.projection().nextChart();
    QTRY_VERIFY(find<QWidget>("banner-primary")->isVisible());
    find<QWidget>("banner-primary")->setFocus();
    click("banner-primary");
    QTRY_VERIFY(!find<QWidget>("banner-primary")->isVisible());
    QTRY_VERIFY(find<QWidget>("output-stage")->isAncestorOf(wizard_->window().focusWidget()));
    find<QWidget>("secondary-2")->setFocus();
    click("secondary-2");
    QTRY_VERIFY(!output.isOpen());
    // Not to the rail or to Back, which would lead elsewhere: to what the page does next.
    const auto hasFocus = [this] {
      QWidget* focus = wizard_->window().focusWidget();
      return focus == find<QWidget>("primary") || find<QWidget>("output-stage")->isAncestorOf(focus);
    };
    QTRY_VERIFY(hasFocus());
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
  }

  void theGuideOpensAtEveryStepsPage() {
    auto* text = find<QTextBrowser>("help-text");
    for (std::size_t i = 0; i < wizard_->wizard().count(); ++i) {
      wizard_->wizard().go(i);
      QCOMPARE(page(), i);
      press(QKeySequence("F1"));
      QString heading = QString("%1 %2").arg(i + 1).arg(wizard_->wizard().currentPage().name());
      QTRY_VERIFY2(text->toPlainText().startsWith(heading + '\n'), qPrintable(heading));
      find<HelpWindow>("help")->close();
    }
  }

  /// Law: F11 and Esc leave the whole screen, and the window is as it was.
  void theWholeScreenIsLeftAsItWasEntered_data() {
    QTest::addColumn<bool>("wasMaximized");
    QTest::addColumn<int>("key");
    for (bool wasMaximized : {false, true})
      for (int key : {int(Qt::Key_F11), int(Qt::Key_Escape)})
        QTest::addRow("%s, %s", wasMaximized ? "maximized" : "a window",
                      qPrintable(QKeySequence(key).toString()))
            << wasMaximized << key;
  }
  void theWholeScreenIsLeftAsItWasEntered() {
    QFETCH(bool, wasMaximized);
    QFETCH(int, key);
    MainWindow& window = wizard_->window();
    window.setWindowState(wasMaximized ? Qt::WindowMaximized : Qt::WindowNoState);
    find<QWidget>("primary")->setFocus();
    press(QKeySequence(Qt::Key_F11));
    QVERIFY(window.isFullScreen());
    press(QKeySequence(key));
    QVERIFY(!window.isFullScreen());
    QCOMPARE(window.isMaximized(), wasMaximized);
    window.setWindowState(Qt::WindowNoState);
  }

  void anotherLanguageMakesTheWindowAnew() {
    QPointer<MainWindow> before = &wizard_->window();
    QRect place = before->geometry();
    std::size_t step = page();
    click("open-settings");
    // No part of a page is seen as a window of its own while it is made.
    struct Windows : QObject {
      QStringList shown;
      bool eventFilter(QObject* watched, QEvent* event) override {
        auto* widget = qobject_cast<QWidget*>(watched);
        if (event->type() == QEvent::Show && widget != nullptr && widget->isWindow() &&
            !widget->testAttribute(Qt::WA_DontShowOnScreen))
          shown << QString(widget->metaObject()->className()) + ' ' + widget->objectName();
        return false;
      }
    } windows;
    qApp->installEventFilter(&windows);
    wizard_->preferences().setLanguage("xx");
    qApp->removeEventFilter(&windows);
    windows.shown.removeAll("relucent::gui::MainWindow ");
    windows.shown.removeAll("relucent::gui::SettingsDialog settings");
    QVERIFY2(windows.shown.isEmpty(), qPrintable(windows.shown.join(", ")));
    QVERIFY(&wizard_->window() != before && wizard_->window().isVisible());
    QTRY_VERIFY(before.isNull());
    QCOMPARE(wizard_->window().geometry(), place);
    QCOMPARE(page(), step);
    // Where the choice was made, it may be made again.
    QTRY_VERIFY(find<QDialog>("settings")->isVisible());
    click("close-settings");
    QTRY_VERIFY(wizard_->window().findChild<QDialog*>("settings") == nullptr);
    wizard_->preferences().setLanguage({});
    QTRY_VERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
  }

  void theGuideFollowsTheLanguage() {
    press(QKeySequence("F1"));
    auto* help = find<HelpWindow>("help");
    QTRY_VERIFY(help->isVisible());
    const int shown = 8;  // a page of no step: where one reads, one stays
    help->showPage(shown);
    QString english = find<QTextBrowser>("help-text")->toPlainText().trimmed();
    wizard_->preferences().setLanguage("de");
    help = find<HelpWindow>("help");
    QVERIFY(help != nullptr && help->isVisible());
    QCOMPARE(find<QListWidget>("help-pages")->currentRow(), shown);
    wordsHaveRoom();
    QString title = guidePages(":/help", "de")[shown].title;
    QVERIFY(!english.startsWith(title));
    QVERIFY2(find<QTextBrowser>("help-text")->toPlainText().trimmed().startsWith(title),
             qPrintable(title +
                        " is not at the top of: " + find<QTextBrowser>("help-text")->toPlainText().left(60)));
    help->close();
    for (const char* language : {"fr", "ar"}) {
      wizard_->preferences().setLanguage(language);
      wordsHaveRoom();
    }
    wizard_->preferences().setLanguage({});
    QTRY_VERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
  }

  void aChangedThresholdMakesLaterStepsOutOfDate() {
    press(QKeySequence("Alt+5"));
    QTRY_COMPARE(page(), std::size_t{4});
    thresholdOfProof_ = wizard_->session().settings().threshold;
    wizard_->page<ThresholdPage>().setAbsolute(1e-3);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<ThresholdPage>().kept().has_value(), patience);
    const auto proof = wizard_->page<OutputPage>().proof().proof();
    QVERIFY(proof != nullptr && !wizard_->page<OutputPage>().proof().isOutOfDate());
    click("primary");
    QTRY_COMPARE(page(), std::size_t{5});
    QVERIFY(wizard_->wizard().page(5).status().state == StepState::outOfDate);
    QVERIFY(wizard_->wizard().page(6).status().state == StepState::outOfDate);
    // A photograph of what was shown before proves nothing of what is shown now, and is still there.
    OutputPage& output = wizard_->page<OutputPage>();
    QVERIFY(output.proof().proof() == proof && output.proof().isOutOfDate());
    QCOMPARE(output.status().state, StepState::outOfDate);
    QCOMPARE(output.banner()->sentence, OutputPage::tr("The verification photograph is out of date"));
    QVERIFY(output.proof().next() == OutputProof::Next::photograph);
    QVERIFY(!wizard_->wizard().isLocked(7));
    QVERIFY(wizard_->wizard().page(5).banner().has_value());
  }

  void openedAgainItStandsWhereItStood() {
    wizard_->window().close();
    wizard_.reset();
    start();
    QCOMPARE(wizard_->page<VenuePage>().recent().size(), 1);
    // Enter opens the last one.
    QTRY_VERIFY(wizard_->window().focusWidget() != nullptr);
    QTest::keyClick(wizard_->window().focusWidget(), Qt::Key_Return);
    QTRY_COMPARE(page(), std::size_t{7});
  }

  void aProofIsRememberedAsLongAsItHolds() {
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().isOpen(), patience);
    const OutputPage& output = wizard_->page<OutputPage>();
    QVERIFY(output.proof().proof() != nullptr && output.proof().isOutOfDate());
    QVERIFY(!find<ImageView>("photograph-view")->picture().isNull());
    // As it was when the photograph was taken, and changed again: by the clusters, and by the content.
    CalibrateSettings before = wizard_->session().settings();
    before.threshold = thresholdOfProof_;
    for (bool isContent : {false, true}) {
      wizard_->session().changeSettings(before);
      QVERIFY(!output.proof().isOutOfDate());
      QVERIFY(output.status().state != StepState::outOfDate);
      CalibrateSettings other = before;
      if (isContent)
        other.content.blackLift = 0.01;
      else
        other.clustering.patchRadius += 1.0;
      wizard_->session().changeSettings(other);
      QVERIFY(output.proof().isOutOfDate());
      QCOMPARE(output.status().state, StepState::outOfDate);
    }
  }

  /// Law: a camera that was bumped is pushed back before anything else, and then photographed through again.
  void aMovedCameraIsPushedBack() {
    OutputPage& output = wizard_->page<OutputPage>();
    const std::filesystem::path folder = proofFolder(wizard_->session().path());
    Proof proof = *loadProof(folder);
    proof.content = wizard_->session().settings().content;
    proof.shownFrom = wizard_->session().shownFrom();
    proof.figures.after.measured.deltaE = 1.0 + 2.0 * proof.figures.after.predicted.deltaE;
    proof.figures.moved = {3.0, 4.0, 0.0, true};
    proof.taken = QDateTime::currentDateTime();
    saveProof(proof, folder);
    wizard_->session().open(wizard_->session().path());
    output.open();
    QTRY_VERIFY_WITH_TIMEOUT(output.isOpen(), patience);
    QCOMPARE(output.primary()->text(), OutputPage::tr("Put the camera back"));
    QVERIFY2(output.hint().contains("has moved"), qPrintable(output.hint()));
    QTRY_VERIFY_WITH_TIMEOUT(output.primary()->isEnabled(), patience);
    output.primary()->trigger();
    QPointer<NudgeDialog> dialog = wizard_->window().findChild<NudgeDialog*>();
    QVERIFY(dialog);
    const auto* nudge = dialog->findChild<Nudge*>();
    QTRY_VERIFY_WITH_TIMEOUT(nudge->sight().has_value(), patience);
    QVERIFY(nudge->sight()->isAtItsPlace());  // somebody did it
    dialog->reject();
    QTRY_VERIFY_WITH_TIMEOUT(dialog.isNull(), patience);
    QCOMPARE(output.primary()->text(), OutputPage::tr("Take verification photograph"));

    // Left elsewhere, that is not forgotten; nor does it stand once it was put right.
    NudgeSight seen;
    seen.offset.isRecognised = true;
    seen.offset.movement.x = 2.0;
    output.pushedBack(seen, true);
    QCOMPARE(output.primary()->text(), OutputPage::tr("Put the camera back"));
    QVERIFY(output.status().isHeldUp);
    QCOMPARE(output.proof().leftElsewhere(), std::optional(2.0));
    seen.offset.movement.x = 0.1;
    output.pushedBack(seen, false);
    QCOMPARE(output.primary()->text(), OutputPage::tr("Take verification photograph"));
    output.close();
  }

  /// Law: what is not as predicted is looked into before it is installed.
  void aFailedProofLeadsToItsCause() {
    OutputPage& output = wizard_->page<OutputPage>();
    const std::filesystem::path folder = proofFolder(wizard_->session().path());
    QVERIFY(loadProof(folder) != nullptr);
    Proof proof = *loadProof(folder);
    proof.content = wizard_->session().settings().content;
    proof.shownFrom = wizard_->session().shownFrom();
    proof.figures.after.measured.deltaE = 1.0 + 2.0 * proof.figures.after.predicted.deltaE;
    proof.figures.moved = {};
    proof.taken = QDateTime::currentDateTime();
    saveProof(proof, folder);
    wizard_->session().open(wizard_->session().path());
    QVERIFY(output.proof().proof() && !output.proof().proof()->isAsPredicted());
    shineOnTheSecondScreen();
    output.open();
    QTRY_VERIFY_WITH_TIMEOUT(output.isOpen(), patience);
    QCOMPARE(output.primary()->text(), OutputPage::tr("Check for drift"));
    QVERIFY2(output.hint().contains("not look as predicted"), qPrintable(output.hint()));
    QTRY_VERIFY_WITH_TIMEOUT(output.primary()->isEnabled(), patience);
    output.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().drift().has_value(), patience);
    // Nothing has moved: that photograph was spoilt, perhaps, which another one tells.
    QCOMPARE(output.primary()->text(), OutputPage::tr("Take verification photograph"));
    const QString unsettled = OutputPage::tr("Not as predicted");
    QCOMPARE(output.status().result, unsettled);
    // A lost screen is said wherever the show is.
    unplug();
    QTRY_COMPARE(output.status().result, OutputPage::tr("Screen unplugged"));
    QVERIFY(output.status().isHeldUp && output.banner().has_value());
    plug();
    QTRY_COMPARE(output.status().result, unsettled);
    // Of the screen nothing is left to say; that steps were decided on other measurements is.
    QVERIFY(output.isOpen() && output.banner() && output.banner()->sentence.contains("decided"));
    output.close();
  }

  /// Law: the window is not gone before its work is, says why, and then goes by itself.
  void theWindowStaysUntilItsWorkHasEnded() {
    const StepName step{"camera", "", "Camera"};
    DeviceLease lease = wizard_->session().leaseDevices(step, DeviceWork::measurement);
    wizard_->window().closeWithoutAsking();
    auto* ending = find<QDialog>("ending");
    QVERIFY(ending != nullptr && ending->isVisible() && wizard_->window().isVisible());
    QTest::keyClick(ending, Qt::Key_Escape);
    QVERIFY(!wizard_->window().close());
    QVERIFY(ending->isVisible() && wizard_->window().isVisible());
    QCOMPARE(wizard_->window().findChildren<QDialog*>("ending").size(), 1);
    lease.release();
    QTRY_VERIFY(!wizard_->window().isVisible());
  }

  void cleanupTestCase() { wizard_.reset(); }
};

QTEST_MAIN(TestWizardWindow)
#include "test_wizard_window.moc"
