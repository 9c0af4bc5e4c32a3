// SPDX-License-Identifier: MIT
#include "wizard/cluster_page.h"

#include <limits>

#include "clustering/cluster_map.h"
#include "pipeline/pictures.h"
#include "views/number_text.h"
#include "wizard/cluster_picture.h"

namespace relucent {
namespace {

constexpr int paletteColours = 8;

/// `surface`: the first camera's picture in full light.
std::shared_ptr<const ClusterResult> resultOf(const ConnectionGraph& graph,
                                              const ClusteringSettings& settings, const QImage& surface) {
  Progress quiet;
  Clustering clustering = clustered(graph, settings, quiet);
  const Rasters& cameras = graph.transport().cameras();
  auto result = std::make_shared<ClusterResult>();
  result->camera = cameras.size(0);
  std::size_t pixels = result->camera.count();
  result->statistics = clustering.statistics;
  result->colours =
      clusterColours(clustering.cameraCluster, cameras, clustering.sizes.size(), paletteColours);
  result->borders = clusterBorders(clustering.cameraCluster, cameras);
  result->map = std::move(clustering.cameraCluster);
  result->error = std::move(clustering.error);
  result->sizes = std::move(clustering.sizes);
  for (std::size_t i = 0; i < pixels; ++i)
    if (result->map[i] == noCluster) result->error[i] = std::numeric_limits<float>::quiet_NaN();
  result->borders.resize(pixels);
  result->map.resize(pixels);
  result->error.resize(pixels);
  result->picture = clusterPicture(result->map, result->colours, result->borders, surface);
  double high = std::max(0.1, std::min(1.0, result->statistics.errorP95 * 1.1));
  result->errorScale = {ColourMap::cividis, 0.0, high, false};
  result->errorPicture = mapped(result->error, result->camera, result->errorScale);
  return result;
}

}  // namespace

/// The graph refers to T.
struct ClusterPage::Prepared {
  TransportMatrix transport;
  std::optional<ConnectionGraph> graph;
  QImage surface;
};

ClusterPage::ClusterPage(Session& session, QObject* parent)
    : PageModel(parent),
      session_(session),
      preparing_(
          [this](std::shared_ptr<const Prepared> prepared) {
            prepared_ = std::move(prepared);
            compute();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, tr("What is measured is safe."), {}, {}});
          }),
      computing_(
          [this](std::shared_ptr<const ClusterResult> result) {
            result_ = std::move(result);
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, tr("What is measured is safe."), {}, {}});
          }) {
  connect(&session_, &Session::opened, this, [this] {
    settings_ = session_.settings().clustering;
    prepared_ = nullptr;
    result_ = nullptr;
    preparedFor_.clear();
    looked_ = false;
  });
  connect(&session_, &Session::changed, this, [this] {
    if (looked_) prepare();
    Q_EMIT changed();
  });
}

void ClusterPage::enter() {
  looked_ = true;
  session_.wantAcquisition();
  prepare();
}

/// The graph, once for every threshold.
void ClusterPage::prepare() {
  std::shared_ptr<const Acquisition> acquisition = session_.acquisition();
  if (!acquisition || !session_.isOpen()) return;
  const ThresholdSettings& cut = session_.settings().threshold;
  std::string wanted = fmt::format("{} {} {}", cut.absolute, cut.shareOfRowMax, cut.energyKept);
  if (wanted == preparedFor_ && acquisition == source_) return;
  preparedFor_ = wanted;
  source_ = acquisition;
  preparing_.ask([acquisition, cut]() -> std::shared_ptr<const Prepared> {
    auto prepared = std::make_shared<Prepared>();
    prepared->transport = thresholded(acquisition->transport, cut, acquisition->flood);
    Progress quiet;
    prepared->graph.emplace(prepared->transport, usablePixels(*acquisition), ConnectionGraphSettings(),
                            quiet);
    Image flood = imageFromStack(acquisition->flood, acquisition->transport.cameras(), 0);
    prepared->surface = relucent::pictureOf(flood, displayWhite(flood));
    return prepared;
  });
}

void ClusterPage::compute() {
  if (prepared_)
    computing_.ask([prepared = prepared_, settings = settings_] {
      return resultOf(*prepared->graph, settings, prepared->surface);
    });
  Q_EMIT changed();
}

void ClusterPage::setSettings(const ClusteringSettings& settings) {
  settings_ = settings;
  compute();
}

StepStatus ClusterPage::status() const {
  int clusters = 0;
  switch (session_.progress(Step::clustering)) {
    case StepProgress::done:
      clusters = session_.result(Step::clustering)->values.value("clusters", 0);
      return {StepState::done, groupedText(tr("%n cluster(s)", nullptr, clusters), clusters)};
    case StepProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case StepProgress::open:
      break;
  }
  return {};
}

QString ClusterPage::hint() const {
  if (isComputing()) return result_ ? tr("Grouping again") : tr("Grouping");
  if (!result_) return tr("Reading the light transport");
  return sizesText();
}

QString ClusterPage::sizesText() const {
  const auto clusters = static_cast<int>(result_->sizes.size());
  return groupedText(tr("%n cluster(s), median %1 px", nullptr, clusters), clusters)
      .arg(result_->statistics.medianUnknowns);
}

Command ClusterPage::primary() const {
  auto* self = const_cast<ClusterPage*>(this);
  return {tr("Preview content"), Icon::next, result_ && !isComputing(), {}, [self] { self->accept(); }};
}

std::optional<Banner> ClusterPage::banner() const {
  if (session_.progress(Step::clustering) != StepProgress::stale) return std::nullopt;
  return Banner{Banner::Kind::amber,
                tr("The clusters that are kept belong to an earlier threshold"),
                tr("What you see here is grouped anew. Going on keeps it."),
                {},
                {}};
}

void ClusterPage::accept() {
  try {
    CalibrateSettings settings = session_.settings();
    settings.clustering = settings_;
    session_.changeSettings(settings);
    session_.decide(Step::clustering, Json{{"clusters", result_->sizes.size()},
                                           {"largest", result_->statistics.largest},
                                           {"error_median", result_->statistics.errorMedian}});
    Q_EMIT nextWanted();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe."), {}, {}});
  }
}

}  // namespace relucent
