// SPDX-License-Identifier: MIT
// The page where pixels are grouped, without its view.
#include "wizard/cluster/cluster_page.h"

#include <QTemporaryDir>
#include <QThreadPool>
#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/clustering/grouping.h"
#include "relucent/pipeline/calibrate_settings.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::clustering;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::transport;

namespace {

Acquisition measured() {
  synthetic::SceneSettings settings;
  settings.softest = 2.0;
  synthetic::Scene scene = synthetic::makeScene(settings);
  Acquisition acquisition;
  acquisition.flood = scene.transport.floodlight();
  acquisition.black = scene.black;
  acquisition.floodVariance.assign(acquisition.flood.size(), 1e-12f);
  acquisition.blackVariance.assign(acquisition.flood.size(), 1e-12f);
  acquisition.flagged.assign(acquisition.flood.size() / 3, 0);
  acquisition.transport = std::move(scene.transport);
  return acquisition;
}

}  // namespace

class TestClusterPage : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<ClusterPage> page_;
  std::vector<std::shared_ptr<const ClusterResult>> shown_;

  void begin() {
    std::filesystem::path path(folder_->filePath("venue").toStdString());
    session_->begin(path, CalibrateSettings());
    CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
    storeAcquisition(folder, fingerprintOf(folder, Stage::acquisition), measured(), {});
  }
  bool isExact() const { return page_->result() && page_->result()->exact && !page_->isComputing(); }

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    session_ = std::make_unique<Session>(std::filesystem::path(folder_->filePath("cache").toStdString()));
    begin();
    session_->reload();
    page_ = std::make_unique<ClusterPage>(*session_);
    shown_.clear();
    connect(page_.get(), &PageModel::resultChanged, this, [this] {
      if (page_->result() && (shown_.empty() || shown_.back() != page_->result()))
        shown_.push_back(page_->result());
    });
    page_->enter();
    QTRY_VERIFY(isExact());
  }
  void cleanup() {
    page_.reset();
    session_.reset();
  }

  void errorsThatAreMeantAreUsual_data() {
    QTest::addColumn<double>("median");
    QTest::addColumn<double>("cutByPatches");
    QTest::addColumn<double>("cutByLimits");
    QTest::addColumn<bool>("isUsual");
    QTest::newRow("sharp") << 0.29 << 0.2 << 0.05 << true;
    QTest::newRow("blurred") << 0.75 << 0.6 << 0.1 << true;
    QTest::newRow("nothing is dropped") << 0.0 << 0.0 << 0.0 << true;
    QTest::newRow("next to nothing is kept") << 0.95 << 0.8 << 0.1 << false;
    QTest::newRow("a limit drops more") << 0.29 << 0.05 << 0.2 << false;
  }
  void errorsThatAreMeantAreUsual() {
    QFETCH(double, median);
    QFETCH(double, cutByPatches);
    QFETCH(double, cutByLimits);
    ClusteringStatistics statistics;
    statistics.errorMedian = median;
    statistics.cutByPatches = cutByPatches;
    statistics.cutByCap = statistics.farLight = 0.5 * cutByLimits;
    QTEST(isUsualError(statistics), "isUsual");
  }

  void theMapComesBeforeItsErrors() {
    QCOMPARE(shown_.size(), std::size_t{2});
    QVERIFY(!shown_[0]->exact && shown_[1]->exact);
    QVERIFY(shown_[0]->map == shown_[1]->map && !shown_[0]->picture.isNull());
    QVERIFY(shown_[0]->error.empty() && shown_[0]->errorPicture.isNull());

    // Meanwhile the errors of the map before stand in for them.
    ClusteringSettings settings = page_->settings();
    settings.patchCut = 0.2;
    page_->setSettings(settings);
    QVERIFY(page_->isComputing() && !page_->primary()->isEnabled());
    QCOMPARE(page_->hint(), ClusterPage::tr("Grouping again"));
    QTRY_VERIFY(isExact());
    QVERIFY(page_->primary()->isEnabled());
    QCOMPARE(shown_.size(), std::size_t{4});
    QVERIFY(!shown_[2]->exact && shown_[3]->exact);
    QVERIFY(shown_[2]->map == shown_[3]->map && shown_[2]->map != shown_[1]->map);
    QCOMPARE(shown_[2]->errorPicture, shown_[1]->errorPicture);
    QCOMPARE(shown_[2]->statistics.errorMedian, shown_[1]->statistics.errorMedian);
    QVERIFY(shown_[3]->statistics.errorMedian != shown_[1]->statistics.errorMedian);
    QCOMPARE(shown_[2]->statistics.keptLight, shown_[3]->statistics.keptLight);
  }

  void whatIsShownInTheEndIsTheDirectComputation_data() {
    QTest::addColumn<double>("radius");
    QTest::addColumn<double>("cut");
    QTest::addColumn<int>("most");
    QTest::newRow("the cap moved") << 8.0 << 0.5 << 32;
    QTest::newRow("the distance moved") << 3.0 << 0.5 << 256;
    QTest::newRow("the share moved") << 8.0 << 0.15 << 256;
  }
  void whatIsShownInTheEndIsTheDirectComputation() {
    QFETCH(double, radius);
    QFETCH(double, cut);
    QFETCH(int, most);
    ClusteringSettings settings = page_->settings();
    settings.cap = SizeCap::always;
    // A slider that moves: what is asked for on the way is given up for what comes after it.
    for (double way : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      settings.patchRadius = radius + 5.0 * (1.0 - way);
      settings.patchCut = cut + 0.1 * (1.0 - way);
      settings.mostUnknowns = most + static_cast<int>(100.0 * (1.0 - way));
      page_->setSettings(settings);
    }
    shown_.clear();
    QTRY_VERIFY(isExact());
    auto exact =
        std::count_if(shown_.begin(), shown_.end(), [](const auto& result) { return result->exact; });
    QVERIFY2(exact <= 2, qPrintable(QString::number(exact)));

    Progress quiet;
    std::shared_ptr<const Acquisition> acquisition = session_->acquisition();
    ConnectionGraph graph(acquisition->transport, usablePixels(*acquisition), {}, quiet);
    Clustering direct = clustered(graph, settings, quiet);
    const ClusterResult& result = *page_->result();
    QVERIFY(result.map == direct.cameraCluster && result.sizes == direct.sizes);
    QCOMPARE(result.statistics.errorMedian, direct.statistics.errorMedian);
    QCOMPARE(result.statistics.keptLight, direct.statistics.keptLight);
    for (std::size_t i = 0; i < direct.error.size(); ++i)
      if (direct.cameraCluster[i] == noCluster)
        QVERIFY(std::isnan(result.error[i]));
      else
        QVERIFY(result.error[i] == direct.error[i]);
  }

  /// Law: what was chosen is taken back, and grouped again as before.
  void theSlidersAreUndone() {
    const std::vector<std::uint32_t> map = page_->result()->map;
    const int most = page_->settings().mostUnknowns;
    ClusteringSettings settings = page_->settings();
    settings.mostUnknowns = most / 8;
    page_->setSettings(settings, "Largest cluster");
    QTRY_VERIFY(isExact() && page_->result()->map != map);
    page_->undoStack().undo();
    QCOMPARE(page_->settings().mostUnknowns, most);
    QTRY_VERIFY(isExact() && page_->result()->map == map);
  }

  /// Law: the time of a frame is measured once the groups are known, and forgotten with the calibration.
  void framesAreTimedAfterTheGroups() {
    QTRY_VERIFY_WITH_TIMEOUT(page_->frameCost().has_value(), 60'000);
    QVERIFY(page_->frameCost()->seconds > 0.0 && !page_->frameCost()->device.empty());
    session_->begin(std::filesystem::path(folder_->filePath("other").toStdString()), CalibrateSettings());
    QVERIFY(!page_->frameCost());
  }

  void anotherCalibrationForgetsWhatWasAskedForThisOne() {
    ClusteringSettings settings = page_->settings();
    settings.patchRadius = 3.0;
    page_->setSettings(settings);
    shown_.clear();
    session_->begin(std::filesystem::path(folder_->filePath("other").toStdString()), CalibrateSettings());
    QVERIFY(!page_->result());
    QThreadPool::globalInstance()->waitForDone();
    QCoreApplication::processEvents();
    QVERIFY(!page_->result() && shown_.empty() && !page_->isComputing());
  }
};

QTEST_MAIN(TestClusterPage)
#include "test_cluster_page.moc"
