// SPDX-License-Identifier: MIT
#include "wizard/cluster/cluster_page.h"

#include <limits>

#include "relucent/base/message.h"
#include "relucent/clustering/cluster_map.h"
#include "relucent/clustering/grouping.h"
#include "relucent/pipeline/pictures.h"
#include "views/number_text.h"
#include "wizard/cluster/cluster_picture.h"
#include "wizard/devices/on_measurement.h"

namespace relucent::gui {
namespace {

constexpr int paletteColours = 8;
constexpr Size filmSize{1920, 1080};

/// A camera's share of what there is of all pixels.
template <typename Value>
std::vector<Value> ofCamera(const std::vector<Value>& values, const Rasters& cameras, std::size_t camera) {
  auto begin = values.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera));
  return {begin, begin + static_cast<std::ptrdiff_t>(cameras.size(camera).count())};
}

/// The map and its numbers. `surface`: the camera's picture in full light.
std::shared_ptr<const ClusterResult> mapOf(const clustering::Grouping& grouping, const Rasters& cameras,
                                           std::size_t camera, const QImage& surface) {
  auto result = std::make_shared<ClusterResult>();
  result->device = camera;
  result->camera = cameras.size(camera);
  result->statistics = grouping.statistics;
  result->colours =
      clustering::clusterColours(grouping.cameraCluster, cameras, grouping.sizes.size(), paletteColours);
  result->borders = ofCamera(clustering::clusterBorders(grouping.cameraCluster, cameras), cameras, camera);
  result->map = ofCamera(grouping.cameraCluster, cameras, camera);
  result->sizes = grouping.sizes;
  result->picture = clusterPicture(result->map, result->colours, result->borders, surface);
  return result;
}

std::shared_ptr<const ClusterResult> withErrors(const ClusterResult& map, const Rasters& cameras,
                                                clustering::GroupingError error) {
  auto result = std::make_shared<ClusterResult>(map);
  result->exact = true;
  result->statistics = std::move(error.statistics);
  result->error = ofCamera(error.error, cameras, map.device);
  for (std::size_t i = 0; i < result->map.size(); ++i)
    if (result->map[i] == clustering::noCluster) result->error[i] = std::numeric_limits<float>::quiet_NaN();
  double high = std::max(0.1, std::min(1.0, result->statistics.errorP95 * 1.1));
  result->errorScale = {ColourMap::cividis, 0.0, high, false};
  result->errorPicture = mapped(result->error, result->camera, result->errorScale);
  return result;
}

/// Whether the clusters that are kept are of what was measured before.
bool isMeasuredSince(const Session& session) {
  const auto& measured = session.result(calibration::Stage::acquisition);
  const auto& grouped = session.result(calibration::Stage::clustering);
  return measured && grouped && measured->stored > grouped->stored;
}

}  // namespace

/// The graph refers to T.
struct ClusterPage::Prepared {
  std::shared_ptr<const transport::Acquisition> source;
  transport::TransportMatrix transport;
  std::optional<clustering::ConnectionGraph> graph;
  std::unique_ptr<clustering::Grouper> grouper;  // for computing_ alone, which asks it one thing at a time
  std::vector<QImage> surfaces;                  // a camera
};

ClusterPage::ClusterPage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      preparing_(
          [this](std::shared_ptr<const Prepared> prepared) {
            if (prepared->source != source_) return;  // it has been measured again
            prepared_ = std::move(prepared);
            compute();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("What is measured is safe.")}); }),
      computing_(
          [this](std::shared_ptr<const ClusterResult> result) { show(std::move(result)); },
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("What is measured is safe.")}); }),
      timing_(
          [this](const engine::FrameCost& cost) {
            frameCost_ = cost;
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, tr("What is measured is safe.")}); }) {
  accept_ = addCommand(Icon::next, [this] { accept(); });
  goOnMeasuring_ = addCommand(Icon::play, [this] { Q_EMIT stepWanted("acquire"); });
  if (session_.isOpen()) settings_ = session_.settings().clustering;
  connect(&session_, &Session::opened, this, [this] {
    settings_ = session_.settings().clustering;
    computing_.drop();
    forgetFrames();
    prepared_ = nullptr;
    result_ = nullptr;
    preparedFor_.clear();
  });
  connect(&session_, &Session::devicesChanged, this, &ClusterPage::tellStatus);
  for (auto signal : {&Session::stepsChanged, &Session::acquisitionChanged})
    connect(&session_, signal, this, [this] {
      if (isLookedAt_) session_.wantAcquisition();
      follow();
      tellAll();
    });
  updateCommands();
}

void ClusterPage::enter() {
  isLookedAt_ = true;
  session_.wantAcquisition();
  follow();
}

/// Groups of a measurement that is no longer the one are neither shown nor kept.
void ClusterPage::follow() {
  if (source_ != session_.acquisition()) {
    computing_.drop();
    forgetFrames();
    source_ = nullptr;
    prepared_ = nullptr;
    result_ = nullptr;
    preparedFor_.clear();
  }
  if (isLookedAt_) prepare();
}

/// The graph, once for every threshold.
void ClusterPage::prepare() {
  std::shared_ptr<const transport::Acquisition> acquisition = session_.acquisition();
  if (!acquisition || !session_.isOpen()) return;
  const transport::ThresholdSettings& cut = session_.settings().threshold;
  std::string wanted = fmt::format("{} {} {}", cut.absolute, cut.shareOfRowMax, cut.energyKept);
  if (wanted == preparedFor_ && acquisition == source_) return;
  preparedFor_ = wanted;
  source_ = acquisition;
  preparing_.ask([acquisition, cut]() -> std::shared_ptr<const Prepared> {
    auto prepared = std::make_shared<Prepared>();
    prepared->source = acquisition;
    prepared->transport = transport::thresholded(acquisition->transport, cut, acquisition->flood);
    Progress quiet;
    prepared->graph.emplace(prepared->transport, pipeline::usablePixels(*acquisition),
                            clustering::ConnectionGraphSettings(), quiet);
    prepared->grouper = std::make_unique<clustering::Grouper>(*prepared->graph);
    const Rasters& cameras = acquisition->transport.cameras();
    for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
      image::Image flood = image::imageFromStack(acquisition->flood, cameras, camera);
      prepared->surfaces.push_back(gui::pictureOf(flood, pipeline::displayWhite(flood)));
    }
    return prepared;
  });
}

void ClusterPage::compute() {
  // Sliders are waited for, frames are not: what is half timed is timed after the groups.
  if (!frameCost_) forgetFrames();
  if (prepared_)
    computing_.ask([prepared = prepared_, settings = settings_, camera = camera()](Progress& progress,
                                                                                   const auto& tellSoon) {
      Progress grouping = progress.part(0.4, RELUCENT_MESSAGE("stage.joining-clusters", "Joining clusters"));
      const clustering::Grouping& groups = prepared->grouper->group(settings, grouping);
      const Rasters& cameras = prepared->transport.cameras();
      std::shared_ptr<const ClusterResult> map = mapOf(groups, cameras, camera, prepared->surfaces[camera]);
      tellSoon(map);
      Progress scaling =
          progress.part(0.6, RELUCENT_MESSAGE("stage.scaling-to-flood-image", "Scaling to the flood image"));
      return withErrors(*map, cameras, errorOf(*prepared->graph, groups, settings, scaling));
    });
  tellSettings();
}

/// Until a map's own errors are known, those of the map before stand in for them.
void ClusterPage::show(std::shared_ptr<const ClusterResult> result) {
  if (result->device != camera()) return;
  if (!result->exact && result_) {
    auto together = std::make_shared<ClusterResult>(*result);
    together->error = result_->error;
    together->errorPicture = result_->errorPicture;
    together->errorScale = result_->errorScale;
    together->statistics.errorMedian = result_->statistics.errorMedian;
    together->statistics.errorP95 = result_->statistics.errorP95;
    result = std::move(together);
  }
  result_ = std::move(result);
  if (result_->exact) timeFrames();
  tellResult();
}

/// After the groups, which somebody waits for.
void ClusterPage::timeFrames() {
  if (!isLookedAt_ || session_.isMeasuring() || timedFor_ == preparedFor_) return;
  timedFor_ = preparedFor_;
  frameCost_.reset();
  timing_.ask([prepared = prepared_](Progress& progress, const auto&) {
    const transport::Acquisition& measured = *prepared->source;
    return engine::measureFrameCost(
        {prepared->transport, measured.black, measured.flood, pipeline::usablePixels(measured)}, filmSize,
        progress);
  });
}

void ClusterPage::forgetFrames() {
  timing_.drop();
  frameCost_.reset();
  timedFor_.clear();
}

void ClusterPage::leave() {
  isLookedAt_ = false;
  // What is half timed is timed when somebody looks again.
  if (!frameCost_) forgetFrames();
}

/// Nothing of another camera's errors stands in for this one's.
void ClusterPage::cameraChanged() {
  result_ = nullptr;
  compute();
}

void ClusterPage::setSettings(const clustering::ClusteringSettings& settings, const QString& what) {
  changeUndoably(what, settings_, settings,
                 [this](const clustering::ClusteringSettings& wanted) { adopt(wanted); });
}

void ClusterPage::adopt(const clustering::ClusteringSettings& settings) {
  settings_ = settings;
  compute();
}

bool ClusterPage::isChanged() const {
  return session_.progress(calibration::Stage::clustering) != calibration::StageProgress::open &&
         settings_ != session_.settings().clustering;
}

StepStatus ClusterPage::status() const {
  int clusters = 0;
  switch (session_.progress(calibration::Stage::clustering)) {
    case calibration::StageProgress::done:
      // A repair keeps what was decided, but not what it came to.
      if (isMeasuredSince(session_)) return {doneOn(session_), tr("Grouped anew")};
      clusters = static_cast<int>(session_.figures<calibration::Stage::clustering>()->clusters);
      return {doneOn(session_), groupedText(tr("%n cluster(s)", nullptr, clusters), clusters)};
    case calibration::StageProgress::stale:
      if (areClustersFollowed(session_)) return {doneOn(session_), tr("Grouped anew")};
      return {StepState::outOfDate, tr("Out of date")};
    case calibration::StageProgress::open:
      break;
  }
  return {};
}

QString ClusterPage::hint() const {
  if (isComputing()) return result_ ? tr("Grouping again") : tr("Grouping");
  if (!result_) return tr("Reading the light transport");
  if (const QString why = whyLocked(); !why.isEmpty()) return why;
  if (result_->sizes.empty())
    return session_.wasEndedEarly() ? tr("What was measured is too coarse to group. Go on measuring.")
                                    : tr("No light is strong enough to group.");
  if (isChanged()) return tr("Changed: it is applied as soon as you go on.");
  return sizesText();
}

QString ClusterPage::sizesText() const {
  const auto clusters = static_cast<int>(result_->sizes.size());
  return groupedText(tr("%n cluster(s), median %1 px", nullptr, clusters), clusters)
      .arg(result_->statistics.medianUnknowns);
}

void ClusterPage::updateCommands() {
  goOnMeasuring_->show(toAcquireText(session_));
  accept_->show(tr("Preview content"), result_ && result_->exact && !isComputing() && whyLocked().isEmpty());
}

std::optional<Banner> ClusterPage::banner() const {
  using calibration::Stage;
  if (session_.progress(Stage::clustering) != calibration::StageProgress::stale ||
      areClustersFollowed(session_) || (result_ && result_->sizes.empty()))
    return onMeasurement(session_, goOnMeasuring_);
  return Banner{Banner::Kind::amber,
                isMeasuredSince(session_) ? tr("The clusters that are kept belong to an earlier measurement")
                                          : tr("The clusters that are kept belong to an earlier threshold"),
                tr("What you see here has been grouped again. Going on keeps it.")};
}

void ClusterPage::accept() {
  if (keepClusters()) Q_EMIT nextWanted();
}

bool ClusterPage::keepClusters() {
  try {
    pipeline::CalibrateSettings settings = session_.settings();
    settings.clustering = settings_;
    session_.changeSettings(settings);
    session_.decide(calibration::ClusteringResult{result_->sizes.size(), result_->statistics.largest,
                                                  result_->statistics.errorMedian});
    return true;
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe.")});
    return false;
  }
}

bool isUsualError(const clustering::ClusteringStatistics& statistics) {
  constexpr double most = 0.85;
  return statistics.errorMedian <= most &&
         statistics.cutByPatches >= statistics.cutByCap + statistics.farLight;
}

}  // namespace relucent::gui
