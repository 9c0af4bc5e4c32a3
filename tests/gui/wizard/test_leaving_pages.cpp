// SPDX-License-Identifier: MIT
// What is changed on a page and left by the rail: it counts on the pages after it, or the rail says that it
// does not.
#include <QTemporaryDir>
#include <QtTest>

#include "core/inverse/synthetic_transport.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/frame/wizard.h"
#include "wizard/threshold/threshold_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::transport;

namespace {

constexpr std::size_t threshold = 0, cluster = 1, after = 2;

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

class LaterPage : public PageModel {
 public:
  LaterPage() : PageModel({"later", "", "later"}) {}
  QString subtitle() const override { return {}; }
  StepStatus status() const override { return {}; }
  PageCommand* primary() const override { return nullptr; }
};

}  // namespace

class TestLeavingPages : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<Wizard> wizard_;
  std::unique_ptr<ThresholdPage> threshold_;
  std::unique_ptr<ClusterPage> cluster_;
  std::unique_ptr<LaterPage> later_;

  void begin(const QString& name) {
    const std::filesystem::path path(folder_->filePath(name).toStdString());
    session_->begin(path, CalibrateSettings());
    CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
    storeAcquisition(folder, fingerprintOf(folder, Stage::acquisition), measured(), {});
  }
  float storedCut() const { return session_->settings().threshold.absolute; }
  /// Light that leaves out a part of what there is.
  double someCut() const { return cutKeeping(threshold_->whole()->histogram, 0.9); }
  bool areClustersKnown() const {
    return cluster_->result() && cluster_->result()->exact && !cluster_->isComputing();
  }

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    session_ = std::make_unique<Session>(std::filesystem::path(folder_->filePath("cache").toStdString()));
    begin("venue");
    session_->reload();
    // Whose pages hear of a calibration first is nobody's business.
    wizard_ = std::make_unique<Wizard>(*session_);
    threshold_ = std::make_unique<ThresholdPage>(*session_);
    cluster_ = std::make_unique<ClusterPage>(*session_);
    later_ = std::make_unique<LaterPage>();
    for (PageModel* page : std::initializer_list<PageModel*>{threshold_.get(), cluster_.get(), later_.get()})
      wizard_->add(*page);
    wizard_->go(threshold);
    QTRY_VERIFY(threshold_->primary()->isEnabled() && threshold_->isExact());
    threshold_->primary()->trigger();
    QTRY_VERIFY(areClustersKnown());
    cluster_->primary()->trigger();
    session_->decide(ContentResult{1.0, 1.0});
    QCOMPARE(wizard_->current(), after);
  }
  void cleanup() {
    wizard_.reset();
    cluster_.reset();
    threshold_.reset();
    later_.reset();
    session_.reset();
  }

  /// Law: the surface is seen before T is read, which takes long, and also where T cannot be read.
  void theSurfaceIsSeenWithoutT() {
    const std::filesystem::path path = session_->path();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
      if (entry.path().filename() == "transport.npz") std::filesystem::remove(entry.path());
    session_->close();
    Session session(std::filesystem::path(folder_->filePath("cache").toStdString()));
    session.open(path);
    ThresholdPage page(session);
    QVERIFY(!page.floodlights());
    page.enter();
    QTRY_VERIFY(page.floodlights());
    QVERIFY(!page.acquisition());
    const Acquisition whole = measured();
    QCOMPARE(page.floodlights()->size(), whole.transport.cameras().devices());
    QCOMPARE(page.floodlights()->front(), image::imageFromStack(whole.flood, whole.transport.cameras(), 0));
  }

  void whatIsNotChangedIsNotKeptAnew() {
    const std::string stored = session_->result(Stage::threshold)->stored;
    for (std::size_t page : {threshold, cluster, after}) wizard_->go(page);
    QTRY_VERIFY(areClustersKnown());
    for (std::size_t page : {threshold, cluster}) {
      QVERIFY(!wizard_->page(page).isChanged());
      QCOMPARE(wizard_->statusOf(page).state, StepState::done);
    }
    QCOMPARE(session_->result(Stage::threshold)->stored, stored);
    QVERIFY(session_->progress(Stage::clustering) == StageProgress::done);
  }

  /// Law: where somebody looks at another page, the cut of this one counts there.
  void aCutThatIsLeftByTheRailCounts() {
    wizard_->go(threshold);
    const double cut = someCut();
    threshold_->setAbsolute(cut);
    QVERIFY(threshold_->isChanged());
    QCOMPARE(wizard_->statusOf(threshold).state, StepState::outOfDate);
    QCOMPARE(wizard_->statusOf(threshold).result, Wizard::tr("Not applied yet"));
    QCOMPARE(storedCut(), 0.0f);
    QVERIFY(wizard_->go(after));
    QTRY_COMPARE(storedCut(), static_cast<float>(cut));
    QVERIFY(!threshold_->isChanged());
    QCOMPARE(wizard_->statusOf(threshold).state, StepState::done);
    QCOMPARE(session_->figures<Stage::threshold>()->leaves, threshold_->kept()->leaves);
    QVERIFY(session_->figures<Stage::threshold>()->energyKept < 0.97);

    // Taken back, that is a change as well.
    wizard_->go(threshold);
    threshold_->undoStack().undo();
    QCOMPARE(wizard_->statusOf(threshold).result, Wizard::tr("Not applied yet"));
    wizard_->go(after);
    QTRY_COMPARE(storedCut(), 0.0f);
  }

  /// Law: what cannot be kept at once is kept as soon as it can; until then the rail says so.
  void whatIsAtWorkIsWaitedFor() {
    wizard_->go(cluster);
    QTRY_VERIFY(areClustersKnown());
    clustering::ClusteringSettings settings = cluster_->settings();
    settings.patchRadius = 3.0;
    {
      const DeviceLease lease = session_->leaseDevices(later_->step(), DeviceWork::measurement);
      cluster_->setSettings(settings);
      wizard_->go(after);
      QTRY_VERIFY(areClustersKnown());
      QCOMPARE(wizard_->statusOf(cluster).result, Wizard::tr("Not applied yet"));
      QVERIFY(session_->settings().clustering != settings);
    }
    QTRY_VERIFY(session_->settings().clustering == settings);
    QCOMPARE(wizard_->statusOf(cluster).state, StepState::done);
    QCOMPARE(session_->figures<Stage::clustering>()->clusters, cluster_->result()->sizes.size());
  }

  /// Law: what is not kept is nobody else's.
  void anotherCalibrationKeepsNothingOfThisOne() {
    wizard_->go(threshold);
    threshold_->setAbsolute(someCut());
    const std::filesystem::path before = session_->path();
    begin("other");
    QCOMPARE(storedCut(), 0.0f);
    QVERIFY(!threshold_->isChanged());
    session_->open(before);
    QCOMPARE(storedCut(), 0.0f);
  }

  /// Law: no state stays amber that nothing has to be done about.
  void clustersAreOfNowOnceContentIsAcceptedWithThem() {
    wizard_->go(threshold);
    threshold_->setAbsolute(someCut());
    wizard_->go(after);
    QTRY_COMPARE(storedCut(), threshold_->cut().absolute);
    QCOMPARE(cluster_->status().state, StepState::outOfDate);
    QVERIFY(cluster_->banner().has_value());
    session_->decide(ContentResult{1.0, 1.0});
    QCOMPARE(cluster_->status().state, StepState::done);
    QCOMPARE(cluster_->status().result, ClusterPage::tr("Grouped anew"));
    QVERIFY(!cluster_->banner());
  }
};

QTEST_MAIN(TestLeavingPages)
#include "test_leaving_pages.moc"
