// SPDX-License-Identifier: MIT
#pragma once

#include "jobs/latest.h"
#include "jobs/refining.h"
#include "relucent/clustering/clustering.h"
#include "relucent/engine/frame_cost.h"
#include "views/colour_map.h"
#include "wizard/devices/device_page.h"

namespace relucent::gui {

/// What one set of sliders gives, for the shown camera. Its map is known before its errors.
struct ClusterResult {
  bool exact = false;  // errors are this map's; until then those of the map before, or none
  clustering::ClusteringStatistics statistics;
  std::vector<std::uint32_t> map;     // per camera pixel: cluster or noCluster
  std::vector<std::uint8_t> colours;  // per cluster
  std::vector<std::uint8_t> borders;  // per camera pixel
  std::vector<float> error;           // per camera pixel, or empty; NaN where there was no cluster
  std::vector<clustering::ClusterSize> sizes;
  std::size_t device = 0;  // the camera's number
  Size camera;
  QImage picture, errorPicture;  // the maps to be seen
  ColourScale errorScale;
};

/// Step 6: clusters of pixels that can be solved on their own.
class ClusterPage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"cluster", "relucent::gui::ClusterPage",
                                     QT_TRANSLATE_NOOP("relucent::gui::ClusterPage", "Cluster")};

  explicit ClusterPage(Session& session, QObject* parent = nullptr);

  QString subtitle() const override {
    return tr(
        "See which parts of the surface light each other, and split them into groups that can be solved on "
        "their own.");
  }
  StepStatus status() const override;
  QString hint() const override;
  QString whyLocked() const override { return session_.whyLocked(step()); }
  PageCommand* primary() const override { return accept_; }
  std::optional<Banner> banner() const override;
  bool isChanged() const override;
  void enter() override;
  void leave() override;

  const clustering::ClusteringSettings& settings() const { return settings_; }
  /// `what`: changed, in the list of what can be undone.
  void setSettings(const clustering::ClusteringSettings& settings, const QString& what = tr("Clusters"));
  /// What the sliders gave last; they may have moved on. Of each set of sliders the map comes first.
  const std::shared_ptr<const ClusterResult>& result() const { return result_; }
  /// "21 480 clusters, median 12 px". Contract: there is a result.
  QString sizesText() const;
  /// T is read and its connections are known: sliders are followed.
  bool isReady() const { return prepared_ != nullptr; }
  bool isComputing() const { return computing_.isBusy() || preparing_.isBusy(); }
  /// What a frame of a film takes on this computer with the light that Threshold keeps, timed once for each
  /// cut, after the groups; none before. The groups make no difference to it.
  const std::optional<engine::FrameCost>& frameCost() const { return frameCost_; }
  /// The venue in full light.
  std::shared_ptr<const transport::Acquisition> acquisition() const { return session_.acquisition(); }

 protected:
  void updateCommands() override;
  void keepChange() override { keepClusters(); }

 private:
  struct Prepared;
  void follow();
  void prepare();
  void cameraChanged() override;
  void adopt(const clustering::ClusteringSettings& settings);
  void compute();
  void timeFrames();
  void forgetFrames();
  void show(std::shared_ptr<const ClusterResult> result);
  void accept();
  bool keepClusters();

  PageCommand *accept_, *goOnMeasuring_;
  clustering::ClusteringSettings settings_;
  std::string preparedFor_;  // fingerprint of the threshold
  std::shared_ptr<const transport::Acquisition> source_;
  std::shared_ptr<const Prepared> prepared_;
  std::shared_ptr<const ClusterResult> result_;
  Latest<std::shared_ptr<const Prepared>> preparing_;
  Refining<std::shared_ptr<const ClusterResult>> computing_;
  std::optional<engine::FrameCost> frameCost_;
  std::string timedFor_;  // as preparedFor_
  Refining<engine::FrameCost> timing_;
  bool isLookedAt_ = false;
};

/// Whether a grouping's error is what it drops on purpose: the blur of the lens, of which little is sharp and
/// much is blurred. Beyond that, or where its limits drop more, something else is off.
bool isUsualError(const clustering::ClusteringStatistics& statistics);

}  // namespace relucent::gui
