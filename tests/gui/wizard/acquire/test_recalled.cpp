// SPDX-License-Identifier: MIT
// What Acquire shows of a measurement of another session: its picture, and how it went.
#include <QSignalSpy>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/calibration/results.h"
#include "relucent/pipeline/acquisition_record.h"
#include "views/image_view.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/acquire/acquire_view.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;

class TestRecalled : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  image::Image flood_;
  std::vector<BlockLevel> levels_;
  std::vector<AcquisitionTrace::Point> points_;
  double seconds_ = 0.0;

  std::filesystem::path venue_, measured_;  // closed, to be opened again

  std::filesystem::path result() const { return measured_ / acquisitionRecordName; }

 private slots:
  void initTestCase() {
    own_.begin();
    AcquirePage page(own_.session);
    page.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), patience);
    QVERIFY(page.isDone());
    QCoreApplication::processEvents();  // what the checks said is told by the way
    flood_ = loadFlood(*own_.session.result(Stage::acquisition)).front();
    levels_ = page.levels();
    points_ = page.trace().points();
    seconds_ = page.trace().seconds();
    QVERIFY(!levels_.empty() && !points_.empty());
    venue_ = own_.session.path();
    measured_ = own_.session.result(Stage::acquisition)->folder;
    own_.session.close();
  }

  /// Law: opened again it is shown as it was, without T, which takes long to read.
  void whatWasMeasuredIsShownAsItWas() {
    Session again{std::filesystem::path()};
    AcquirePage page(again);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    QSignalSpy failed(&page, &PageModel::failed);
    again.open(venue_);
    const auto* picture = stage->findChild<ImageView*>("floodlight-view");
    QVERIFY(page.floodlight().empty() && picture->picture().isNull() && page.levels().empty());
    page.enter();
    QVERIFY(page.isFloodlightComing());
    QTRY_VERIFY(!page.floodlight().empty());
    QVERIFY(page.floodlight() == flood_ && !page.isFloodlightComing());
    QTRY_COMPARE(picture->picture().size(), QSize(flood_.size().width, flood_.size().height));
    QVERIFY(!again.acquisition());

    QCOMPARE(page.levels().size(), levels_.size());
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      QCOMPARE(page.levels()[i].block, levels_[i].block);
      QCOMPARE(page.levels()[i].through, levels_[i].through);
      QVERIFY(page.levels()[i].isComplete());
    }
    QVERIFY(page.isTraceCurrent());
    QCOMPARE(page.trace().points().size(), points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
      QCOMPARE(page.trace().points()[i].reading.roomLight, points_[i].reading.roomLight);
    // The devices are opened before anything is recorded.
    QVERIFY(page.trace().seconds() > 0.0 && page.trace().seconds() <= seconds_);
    QVERIFY(stage->findChild<QWidget*>("block-sizes")->parentWidget()->isVisibleTo(stage.get()));
    QVERIFY(stage->findChild<QWidget*>("room-light-chart")->isVisibleTo(stage.get()));
    QVERIFY(!page.trace().roomLight());  // nobody knows how bright it is now
    QCOMPARE(failed.size(), 0);

    // A view that is made later, as in another language, has it at once.
    const PageView later = viewOf(page);
    const std::unique_ptr<QWidget> laterStage(later.stage), laterInspector(later.inspector);
    QTRY_VERIFY(!laterStage->findChild<ImageView*>("floodlight-view")->picture().isNull());
  }

  /// Law: what is of another calibration is not shown in this one.
  void anotherCalibrationShowsNothingOfIt() {
    Session again{std::filesystem::path()};
    AcquirePage page(again);
    again.open(venue_);
    page.enter();
    QTRY_VERIFY(!page.floodlight().empty());
    again.begin(own_.path("another"), smallVenue());
    page.enter();
    QVERIFY(page.floodlight().empty() && !page.isFloodlightComing() && page.trace().points().empty());
  }

  /// Law: what cannot be read is said where it would be seen, and leads to what helps.
  void whatCannotBeReadIsSaid() {
    const std::filesystem::path flood = measured_ / "flood-1.exr", aside = own_.path("flood.exr");
    std::filesystem::rename(flood, aside);
    const auto back = qScopeGuard([&] { std::filesystem::rename(aside, flood); });
    Session again{std::filesystem::path()};
    AcquirePage page(again);
    const PageView view = viewOf(page);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    QSignalSpy failed(&page, &PageModel::failed);
    again.open(venue_);
    QVERIFY(!page.isUnreadable() && !page.banner());
    page.enter();
    QTRY_COMPARE(failed.size(), 1);
    QVERIFY(page.isUnreadable() && !page.isFloodlightComing());
    QVERIFY(page.banner() && page.banner()->sentence.contains("cannot be read"));
    QCOMPARE(page.primary()->text(), AcquirePage::tr("Measure again"));
  }

  /// Of earlier versions nothing is on record but the picture.
  void calibrationsWithoutARecordShowTheirPicture() {
    QVERIFY(std::filesystem::remove(result()));
    Session again{std::filesystem::path()};
    AcquirePage page(again);
    QSignalSpy failed(&page, &PageModel::failed);
    again.open(venue_);
    page.enter();
    QTRY_VERIFY(!page.floodlight().empty());
    QVERIFY(page.levels().empty() && page.trace().points().empty());
    QCOMPARE(failed.size(), 0);
  }
};

QTEST_MAIN(TestRecalled)
#include "test_recalled.moc"
