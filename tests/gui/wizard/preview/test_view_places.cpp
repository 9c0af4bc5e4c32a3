// SPDX-License-Identifier: MIT
// A statue seen from three sides: what each view asks for, and a viewer who walks between them.
#include <QScrollArea>
#include <QSlider>
#include <QtTest>
#include <numeric>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "theme/controls.h"
#include "theme/tick.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/viewer_plan.h"
#include "wizard/preview/views_part.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

class TestViewPlaces : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  std::unique_ptr<PreviewPage> page_;

  void settle() { QTRY_VERIFY_WITH_TIMEOUT(page_->preview() && !page_->isComputing(), patience); }
  const ViewPreview& seen(std::size_t camera) const { return page_->preview()->views[camera]; }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::CalibrateSettings settings = smallVenue({48, 36}, {40, 30}, 5);
    std::get<venue::VenueSettings>(settings.rig).name = "statue3";
    settings.acquisition.scheme = acquisition::AcquisitionScheme::multiplexed;
    pipeline::calibrate(own_.path("venue"), settings, own_.path("cache"), silent);
  }
  void init() {
    page_ = std::make_unique<PreviewPage>(own_.session);
    own_.session.open(own_.path("venue"));
    page_->enter();
    settle();
  }
  void cleanup() { page_.reset(); }

  /// Law: every view is predicted; that of the first is what the page says of the content.
  void everyViewIsPredicted() {
    QCOMPARE(page_->preview()->views.size(), std::size_t{3});
    QCOMPARE(seen(0).psnr, page_->preview()->psnr);
    QCOMPARE(seen(0).deltaEMean, page_->preview()->deltaEMean);
    for (std::size_t camera = 0; camera < 3; ++camera) {
      QVERIFY(seen(camera).psnr > 10.0 && seen(camera).reachableShare > 0.3);
      QVERIFY(seen(camera).with.size() == Size({40, 30}) && seen(camera).with != seen(camera).without);
    }
    std::unique_ptr<QWidget> part(viewsPart(*page_));
    QCOMPARE(part->findChild<QWidget*>("view-quality")->findChildren<ValueRow*>().size(), 3);
  }

  /// Law: however low the window, whoever asks for one viewer sees the plan to move him in.
  void thePlanComesIntoSight() {
    QScrollArea scroll;
    scroll.setWidgetResizable(true);
    scroll.setWidget(viewsPart(*page_));
    scroll.resize(300, 220);
    scroll.show();
    QVERIFY(QTest::qWaitForWindowExposed(&scroll));
    auto* one = scroll.findChild<Tick*>("one-viewer");
    const auto* plan = scroll.findChild<ViewerPlan*>();
    QVERIFY(!plan->isVisible());
    one->click();
    QTRY_VERIFY(plan->isVisible() && scroll.viewport()->rect().contains(
                                         QRect(plan->mapTo(scroll.viewport(), QPoint()), plan->size())));
    one->click();
    QTRY_VERIFY(!plan->isVisible());
    settle();
  }

  /// Law: content lies on the surface in the other views, and has corners there only where it has a place of
  /// its own, which alone moves them.
  void cornersBelongToTheShownView() {
    const std::optional<Corners> first = page_->corners();
    QVERIFY(first.has_value());
    page_->showCamera(1);
    QVERIFY(!page_->corners());
    page_->setCorners(*first);  // there are none
    QVERIFY(page_->settings().views.empty() && !page_->settings().corners);
    ViewSettings own = page_->view(1);
    own.placement = ViewPlacement::own;
    page_->setView(1, own, "Place");
    settle();
    QVERIFY(page_->corners().has_value() && !page_->isPlacedByHand());
    Corners moved = *page_->corners();
    moved[0][0] += 1.0;
    page_->setCorners(moved);
    settle();
    QVERIFY(page_->corners() == std::optional(moved) && page_->isPlacedByHand());
    QVERIFY(!page_->settings().corners);
    page_->placeAutomatically();
    QVERIFY(!page_->isPlacedByHand());
  }

  /// Law: whoever stands at a camera's place asks for that view alone, and it is no worse for it than for
  /// all.
  void aViewerAtACameraHasItsView() {
    for (std::size_t camera = 0; camera < 3; ++camera) {
      page_->setViewer(std::nullopt);
      settle();
      QVERIFY(page_->viewerShares().empty());
      const double forAll = seen(camera).psnr;
      page_->setViewerOnPath(static_cast<double>(camera));
      settle();
      QCOMPARE(page_->viewerOnPath(), static_cast<double>(camera));
      const std::vector<double> shares = page_->viewerShares();
      QVERIFY(std::abs(shares[camera] - 1.0) < 1e-6);
      QVERIFY2(seen(camera).psnr > forAll - 0.2,
               qPrintable(QString("%1 of %2").arg(seen(camera).psnr).arg(forAll)));
    }
  }

  /// Law: between two cameras their shares sum to one and follow the way.
  void sharesFollowTheWay_data() {
    QTest::addColumn<double>("place");
    for (double place : {0.1, 0.5, 0.9, 1.25, 1.75}) QTest::addRow("%.2f", place) << place;
  }
  void sharesFollowTheWay() {
    QFETCH(double, place);
    page_->setViewerOnPath(place);
    QVERIFY(std::abs(page_->viewerOnPath() - place) < 1e-9);
    const std::vector<double> shares = page_->viewerShares();
    QVERIFY(std::abs(std::reduce(shares.begin(), shares.end()) - 1.0) < 1e-9);
    const auto before = static_cast<std::size_t>(place);
    QVERIFY(std::abs(shares[before] - (1.0 - (place - static_cast<double>(before)))) < 0.02);
  }

  /// Law: cameras and the viewer stand where they were placed, for all time, and content is for him wherever
  /// it is shown; before, cameras stand all round the surface.
  void camerasAreKeptWhereTheyWerePlaced() {
    QVERIFY(!page_->areCamerasPlaced());
    const std::vector<Position> round = page_->cameraPositions();
    page_->placeCamera(1, {0.5, 4.0, 0.0});
    QVERIFY(page_->areCamerasPlaced());
    QVERIFY(page_->cameraPositions()[0] == round[0] && page_->cameraPositions()[2] == round[2]);
    QVERIFY(page_->cameraPositions()[1] == (Position{0.5, 4.0, 0.0}));
    page_->setViewerOnPath(0.5);
    settle();
    page_->primary()->trigger();
    page_->undoStack().clear();  // as the wizard does when a venue is opened
    own_.session.open(own_.path("venue"));
    page_->enter();
    settle();
    QVERIFY(page_->areCamerasPlaced() && page_->viewer());
    QVERIFY(std::abs(page_->viewerOnPath() - 0.5) < 1e-9);
    QVERIFY(page_->cameraPositions()[1] == (Position{0.5, 4.0, 0.0}));
    const TargetSettings shown = targetOf(own_.session.settings().content);
    QVERIFY(shown.viewer == page_->viewer() && shown.views[1].position == (Position{0.5, 4.0, 0.0}));
    page_->setViewer(std::nullopt);
    page_->undoStack().undo();
    QVERIFY(page_->viewer() == shown.viewer);
    page_->setViewer(std::nullopt);
    settle();
    page_->primary()->trigger();
    QVERIFY(!own_.session.settings().content.viewer);
    page_->undoStack().clear();
    page_->setViewer(Position{std::nan(""), 0.0, 0.0});
    QVERIFY(!page_->viewer());
  }

  /// Law: what the mouse can do, the keys can: Tab goes through cameras and viewer, arrows move them.
  void thePlanIsUsedByKeys() {
    ViewerPlan plan;
    plan.resize(300, 170);
    const std::vector<Position> cameras{{-1.0, 2.0, 0.0}, {1.0, 2.0, 0.0}};
    plan.show(cameras, Position{0.0, 2.0, 0.0}, {0.5, 0.5});
    QSignalSpy camera(&plan, &ViewerPlan::cameraMoved), viewer(&plan, &ViewerPlan::viewerMoved);
    QFocusEvent byTab(QEvent::FocusIn, Qt::TabFocusReason);
    QCoreApplication::sendEvent(&plan, &byTab);
    QCOMPARE(plan.active(), 0);
    QVERIFY(plan.accessibleDescription().contains(QLocale().toString(2.0, 'f', 1)));
    QTest::keyClick(&plan, Qt::Key_Right, Qt::ShiftModifier);
    QCOMPARE(camera.size(), 1);
    QCOMPARE(camera[0][0].toInt(), 0);
    QVERIFY(camera[0][1].value<Position>() == (Position{0.0, 2.0, 0.0}));
    QTest::keyClick(&plan, Qt::Key_Tab);
    QTest::keyClick(&plan, Qt::Key_Tab);
    QCOMPARE(plan.active(), 2);
    QTest::keyClick(&plan, Qt::Key_Down);
    QCOMPARE(viewer.size(), 1);
    QVERIFY(std::abs(viewer[0][0].value<Position>()[1] - 2.1) < 1e-9);
    // By the mouse, to within a tenth of a metre.
    const QPoint from = plan.placeOf(1).toPoint();
    QTest::mousePress(&plan, Qt::LeftButton, {}, from);
    QTest::mouseMove(&plan, from + QPoint(20, 0));
    QTest::mouseRelease(&plan, Qt::LeftButton, {}, from + QPoint(20, 0));
    QVERIFY(camera.size() >= 2 && camera.back()[0].toInt() == 1);
    QVERIFY(camera.back()[1].value<Position>()[0] > 1.2);
  }
};

QTEST_MAIN(TestViewPlaces)
#include "test_view_places.moc"
