// SPDX-License-Identifier: MIT
// Four projectors that overlap, looked at through two cameras.
#include <QLabel>
#include <QtTest>
#include <algorithm>
#include <numeric>

#include "gui/wizard/simulated_session.h"
#include "theme/controls.h"
#include "views/image_view.h"
#include "wizard/camera/camera_page.h"
#include "wizard/camera/camera_view.h"
#include "wizard/camera/checks_view.h"
#include "wizard/devices/device_selector.h"

using namespace relucent;
using namespace relucent::gui;

class TestSeveralCameras : public QObject {
  Q_OBJECT

  std::unique_ptr<SimulatedSession> own_;
  std::unique_ptr<CameraPage> page_;
  std::unique_ptr<QWidget> stage_;

 private slots:
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    page_ = std::make_unique<CameraPage>(own_->session);
    stage_.reset(viewOf(*page_).stage);
    pipeline::CalibrateSettings settings = smallVenue({48, 36}, {40, 30}, 5);
    std::get<venue::VenueSettings>(settings.rig).name = "dome4";
    own_->begin(settings);
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(page_->look(0) && page_->look(1) && !page_->isChecking() &&
                                 page_->tooDarkEverywhere(0) && page_->tooDarkEverywhere(1),
                             patience);
  }
  void cleanup() {
    stage_.reset();
    page_.reset();
    own_.reset();
  }

  /// Law: every camera is looked through, and what is shown is chosen.
  void eachCameraIsLookedThrough() {
    QVERIFY(page_->look(0)->frame.signal != page_->look(1)->frame.signal);
    QCOMPARE(&page_->look(), &page_->look(0));
    page_->showCamera(1);
    QCOMPARE(&page_->look(), &page_->look(1));
    QVERIFY(!page_->look(2) && page_->focus(2) == 0.0);
    for (const char* name : {"camera-view", "camera-view-2"}) {
      const auto* view = stage_->findChild<ImageView*>(name);
      QVERIFY(view != nullptr && !view->picture().isNull());
    }
    QVERIFY(stage_->findChild<ImageView*>("camera-view")->accessibleName() !=
            stage_->findChild<ImageView*>("camera-view-2")->accessibleName());
  }

  /// Law: a focus area belongs to its camera.
  void eachCameraHasItsFocusArea() {
    const image::Region first = page_->focusArea(0);
    page_->showCamera(1);
    page_->setFocusArea({1, 2, first.width, first.height});
    QCOMPARE(page_->focusArea(0), first);
    QCOMPARE(page_->focusArea(1).x, 1);
    page_->undoStack().undo();
    QVERIFY(page_->focusArea(1).x != 1);
  }

  /// Law: what any camera sees is at least what each sees; where projectors overlap is shown for every
  /// camera.
  void whatTheyCoverAndWhereTheyOverlap() {
    const linearization::RigCoverage& seen = page_->rigCoverage();
    QCOMPARE(page_->coverage().size(), std::size_t{4});
    QCOMPARE(seen.coverages.size(), std::size_t{4});
    for (std::size_t projector = 0; projector < 4; ++projector)
      for (std::size_t camera = 0; camera < 2; ++camera)
        QVERIFY(page_->coverage()[projector].share() >= seen.coverages[projector][camera].share());
    for (std::size_t camera = 0; camera < 2; ++camera) {
      const std::vector<double> overlaps = seen.overlaps(camera);
      QCOMPARE(overlaps.size(), std::size_t{4});
      QVERIFY(std::abs(std::reduce(overlaps.begin(), overlaps.end()) - 1.0) < 1e-9);
      QVERIFY(overlaps[0] > 0.1 && overlaps[1] > 0.05);
    }
    auto* kind = stage_->findChild<Segmented*>("camera-overlap");
    QVERIFY(kind != nullptr && kind->isVisibleTo(stage_.get()));
    const QImage light = stage_->findChild<ImageView*>("camera-view-2")->picture();
    kind->setCurrent(1);
    Q_EMIT kind->chosen(1);
    QVERIFY(stage_->findChild<ImageView*>("camera-view-2")->picture() != light);
    QVERIFY(stage_->findChild<ImageView*>("camera-view-2")
                ->accessibleDescription()
                .contains(CameraPage::tr("%n projector(s): %1", nullptr, 2).section(':', 0, 0)));
  }

  /// Where each is seen, all are spoken of, not the one that is seen least.
  void allProjectorsAreSaidToBeSeen() {
    for (const linearization::Coverage& coverage : page_->coverage()) QVERIFY(coverage.share() >= 0.98);
    const std::unique_ptr<QWidget> checks(checksPart(*page_));
    const QList<QLabel*> labels = checks->findChild<Remark*>("coverage")->findChildren<QLabel*>();
    QVERIFY(std::ranges::any_of(
        labels, [](const QLabel* label) { return label->text().contains("of every picture is seen"); }));
  }
};

QTEST_MAIN(TestSeveralCameras)
#include "test_several_cameras.moc"
