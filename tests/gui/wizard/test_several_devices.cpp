// SPDX-License-Identifier: MIT
// Pages, without their views, of a calibration with two projectors and two cameras.
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::transport;
using namespace relucent::venue;

namespace {

const Rasters cameras({{8, 6}, {5, 4}}), projectors({{10, 7}, {6, 5}});

/// The projector pixels that light a camera pixel; the second camera's last line sees the second projector
/// only.
std::size_t litBy(std::size_t row, std::size_t projector) {
  return projectors.offset(projector) + row % projectors.size(projector).count();
}
bool seesFirst(std::size_t row) {
  return row < cameras.count() - 5;
}

Acquisition measured() {
  NodeLayout layout(projectors);
  BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
  for (std::size_t row = 0; row < cameras.count(); ++row) {
    if (seesFirst(row)) builder.add(row, litBy(row, 0), ColourBlock(ColourBlock::Identity()));
    builder.add(row, litBy(row, 1), ColourBlock(0.5f * ColourBlock::Identity()));
  }
  Acquisition acquisition;
  acquisition.transport = TransportMatrix(cameras, projectors, builder.build());
  acquisition.flood = acquisition.transport.floodlight();
  acquisition.black.assign(acquisition.flood.size(), 0.001f);
  acquisition.floodVariance.assign(acquisition.flood.size(), 1e-12f);
  acquisition.blackVariance.assign(acquisition.flood.size(), 1e-12f);
  acquisition.flagged.assign(cameras.count(), 0);
  return acquisition;
}

/// The second projector's light rises later than the first one's.
Linearization linearized() {
  Linearization linearization;
  for (double middle : {0.3, 0.1}) {
    ResponseCurve curve({0.0, 0.5, 1.0}, {0.0, middle, 1.0});
    linearization.projectors.push_back({{curve, curve, curve}});
  }
  linearization.cameras.resize(2);
  linearization.exposures = {0.01};
  linearization.additivityError = {0.001, 0.002};
  return linearization;
}

}  // namespace

class TestSeveralDevices : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<Session> session_;

  std::filesystem::path path(const char* name) const { return folder_->filePath(name).toStdString(); }
  void finishPicking(ThresholdPage& page) {
    QTRY_VERIFY(page.footprint() && page.lit());
    QCOMPARE(page.footprint()->luminance.size(), projectors.count());
  }

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    session_ = std::make_unique<Session>(path("cache"));
    session_->begin(path("venue"), CalibrateSettings());
    CalibrationFolder folder = CalibrationFolder::open(path("venue"), CalibrationFolder::Access::write);
    storeLinearization(folder, fingerprintOf(folder, Stage::linearization), linearized(), {});
    storeAcquisition(folder, fingerprintOf(folder, Stage::acquisition), measured(), {});
  }
  void cleanup() { session_.reset(); }

  void aRigIsCountedAsItIsDescribedUntilItIsMeasured() {
    VenueSettings venue;
    venue.name = "relief";
    CalibrateSettings settings;
    settings.rig = venue;
    session_->begin(path("relief"), settings);
    QCOMPARE(session_->projectors(), std::size_t{2});
    QCOMPARE(session_->cameras(), std::size_t{1});
    QCOMPARE(session_->projectorSize(1), venue.projector);
    venue.name = "statue3";
    settings.rig = venue;
    session_->begin(path("statue3"), settings);
    QCOMPARE(session_->cameras(), std::size_t{3});
    session_->open(path("venue"));
    QCOMPARE(session_->projectors(), std::size_t{2});
    QCOMPARE(session_->cameras(), std::size_t{2});
    QCOMPARE(session_->projectorSize(1), Size({6, 5}));
  }

  void everyVenueIsOfferedWithTheWorkOfItsProjectors() {
    QSettings settings(folder_->filePath("settings.ini"), QSettings::IniFormat);
    VenuePage page(*session_, RecentVenues(settings));
    page.setMode(VenuePage::Mode::rehearse);
    std::map<std::string, int> shots;
    for (std::size_t i = 0; i < page.venues().size(); ++i) {
      page.chooseVenue(i);
      shots[page.venues()[i].id] = page.expected().shots;
    }
    QCOMPARE(shots.size(), venues().size());
    for (const VenueDescription& venue : venues())
      QVERIFY2((shots.at(venue.name) > shots.at("plain")) == (venue.projectors > 1), venue.name.c_str());
  }

  void whatIsShownIsChosenAndBeginsAnew() {
    session_->reload();
    ThresholdPage page(*session_);
    QSignalSpy changed(&page, &PageModel::settingsChanged);
    QCOMPARE(page.projector(), std::size_t{0});
    page.showProjector(1);
    page.showCamera(1);
    QCOMPARE(changed.size(), 2);
    page.showProjector(1);
    page.showProjector(2);  // there is none
    QCOMPARE(changed.size(), 2);
    QCOMPARE(page.projector(), std::size_t{1});
    session_->open(path("venue"));
    QCOMPARE(page.projector(), std::size_t{0});
    QCOMPARE(page.camera(), std::size_t{0});
  }

  void eachProjectorHasItsResponse() {
    LinearizePage page(*session_);
    session_->open(path("venue"));
    QCOMPARE(page.response()->channels[0](0.5), 0.3);
    page.showProjector(1);
    QCOMPARE(page.response()->channels[0](0.5), 0.1);
  }

  void theForecastCountsThemAll() {
    AcquirePage page(*session_);
    session_->reload();
    auto of = [](const Rasters& seen, const Rasters& lit) {
      return forecast({seen, lit, 1, 0.01}, CalibrateSettings().acquisition, {}, {});
    };
    const std::optional<WorkLeft> expected = page.expected();
    QVERIFY(expected.has_value());
    QCOMPARE(expected->shots, of(cameras, projectors).shots);
    QCOMPARE(expected->exposures, of(cameras, projectors).exposures);
    QVERIFY(expected->shots > of(cameras.size(0), projectors.size(0)).shots);
  }

  void eachDeviceHasItsLivePicture() {
    session_->reload();
    LinearizePage linearize(*session_);
    AcquirePage acquire(*session_);
    LiveRig& live = session_->live();
    Image white({6, 5}, 3, 1.0f);
    live.shown(0, Image({10, 7}, 3, 0.0f));
    live.shown(1, white);
    live.photographed(0, {}, {Image({8, 6}, 3, 0.25f), 12, 0.5});
    live.photographed(1, {}, {Image({5, 4}, 3, 0.75f), 12, 0.5});
    for (DevicePage* page : {static_cast<DevicePage*>(&linearize), static_cast<DevicePage*>(&acquire)}) {
      page->showProjector(1);
      page->showCamera(1);
    }
    QCOMPARE(linearize.pictures().pattern, white);
    QCOMPARE(acquire.pictures().pattern, white);
    QCOMPARE(acquire.pictures().frame.signal, Image({5, 4}, 3, 0.75f));
    acquire.showProjector(0);
    QCOMPARE(acquire.pictures().pattern.size(), Size({10, 7}));
  }

  /// The camera's pixel stays, and what it sees of the other projector is looked at.
  void aPickIsFollowedIntoTheProjectorThatIsShown() {
    ThresholdPage page(*session_);
    session_->reload();
    session_->wantAcquisition();
    QTRY_VERIFY(page.acquisition());
    const Pixel camera{3, 2};
    std::size_t row = indexOf(cameras.size(0), camera);
    page.pick(camera);
    finishPicking(page);
    for (std::size_t projector : {std::size_t{1}, std::size_t{0}}) {
      page.showProjector(projector);
      QCOMPARE(page.picked(), std::optional(camera));
      QCOMPARE(page.pickedRow(), std::optional(row));
      QTRY_COMPARE(page.pickedColumn(), std::optional(litBy(row, projector)));
      QTRY_VERIFY(page.lit() && page.lit()->at(row) > 0.0f);
    }
  }

  /// Both projectors light each camera's pixels with other pixels of theirs.
  void anEntryOfTheMatrixShowsItsDevices() {
    ThresholdPage page(*session_);
    session_->reload();
    session_->wantAcquisition();
    QTRY_VERIFY(page.acquisition());
    std::size_t row = cameras.offset(1) + 6, column = litBy(row, 1);
    page.pickEntry(row, column);
    QCOMPARE(page.camera(), std::size_t{1});
    QCOMPARE(page.projector(), std::size_t{1});
    QCOMPARE(page.picked(), std::optional(Pixel{1, 1}));
    QCOMPARE(page.pickedProjector(), std::optional(pixelAt({6, 5}, row % 30)));
    QCOMPARE(page.pickedRow(), std::optional(row));
    QCOMPARE(page.pickedColumn(), std::optional(column));
    finishPicking(page);
    QCOMPARE(page.lit()->size(), cameras.count());
    QVERIFY(page.lit()->at(row) > 0.0f);
    page.pickEntry(cameras.count(), 0);  // there is none
    QCOMPARE(page.pickedRow(), std::optional(row));
    // A pixel of one camera is none of the other's; what the projector's pixel lights is the same.
    page.showCamera(0);
    QVERIFY(!page.picked() && !page.footprint() && !page.pickedRow());
    QCOMPARE(page.pickedColumn(), std::optional(column));
    QVERIFY(page.lit());
  }

  void aProjectorThatLightsNothingThereHasNoPick() {
    ThresholdPage page(*session_);
    session_->reload();
    session_->wantAcquisition();
    QTRY_VERIFY(page.acquisition());
    page.showCamera(1);
    page.showProjector(1);
    page.pick({2, 3});  // of the last line
    finishPicking(page);
    std::size_t row = *page.pickedRow();
    QVERIFY(!seesFirst(row));
    QCOMPARE(page.pickedColumn(), std::optional(litBy(row, 1)));
    page.showProjector(0);
    QVERIFY(page.picked() && !page.pickedProjector() && !page.lit());
  }

  void theClusterMapIsOfTheShownCamera() {
    ClusterPage page(*session_);
    session_->reload();
    page.enter();
    auto isExact = [&page] { return page.result() && page.result()->exact && !page.isComputing(); };
    QTRY_VERIFY(isExact());
    QCOMPARE(page.result()->camera, cameras.size(0));
    std::vector<std::uint32_t> first = page.result()->map;
    page.showCamera(1);
    QVERIFY(!page.result());  // not the other camera's
    QTRY_VERIFY(isExact());
    const ClusterResult& result = *page.result();
    QCOMPARE(result.camera, cameras.size(1));
    QCOMPARE(result.map.size(), cameras.size(1).count());
    QCOMPARE(result.borders.size(), result.map.size());
    QCOMPARE(result.error.size(), result.map.size());
    QCOMPARE(result.picture.size(), QSize(5, 4));
    QCOMPARE(result.errorPicture.size(), QSize(5, 4));
    // Clusters go across cameras: of the second projector's 30 pixels these two see the same.
    std::size_t row = cameras.offset(1) + 12;
    QCOMPARE(result.map[12], first[row - 30]);
    page.showCamera(0);
    QTRY_VERIFY(isExact());
    QVERIFY(page.result()->map == first);
  }
};

QTEST_MAIN(TestSeveralDevices)
#include "test_several_devices.moc"
