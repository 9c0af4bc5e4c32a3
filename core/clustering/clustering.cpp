// SPDX-License-Identifier: MIT
#include "relucent/clustering/clustering.h"

#include "relucent/base/message.h"
#include "relucent/clustering/approximation.h"

namespace relucent::clustering {

std::vector<Message> problems(const ClusteringSettings& settings) {
  std::vector<Message> found;
  if (!(settings.leastLuminance >= 0.0f))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("clusters.least-luminance-negative",
                                             "the least luminance must not be negative"));
  if (!(settings.leastShare >= 0.0 && settings.leastShare <= 1.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("clusters.row-share-out-of-range",
                                 "the share of a row's brightest connection must lie between 0 and 1"));
  if (!(settings.patchRadius >= 0.0 && settings.patchRadius <= 10000.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("clusters.patch-radius-out-of-range",
                                 "the radius of a patch must lie between 0 and 10000 projector pixels"));
  if (!(settings.patchCut >= 0.0 && settings.patchCut < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("clusters.patch-cut-out-of-range",
                                             "the cut of a patch must be at least 0 and below 1"));
  if (settings.mostUnknowns < 1 || settings.mostUnknowns > 4096)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("clusters.cap-out-of-range",
                                             "a capped cluster must have 1 to 4096 projector pixels"));
  return found;
}

Clustering clustered(const ConnectionGraph& graph, const ClusteringSettings& settings, Progress& progress) {
  Progress grouping = progress.part(0.7, RELUCENT_MESSAGE("stage.joining-clusters", "Joining clusters"));
  // What the grouper keeps for a next time is not held beside T~.
  Grouping groups = Grouper(graph).group(settings, grouping);

  Progress scaling =
      progress.part(0.3, RELUCENT_MESSAGE("stage.scaling-to-flood-image", "Scaling to the flood image"));
  Approximation approximation = scaledToFloodlight(graph, groups, settings, scaling);
  summariseErrors(groups, approximation.error, groups.statistics);
  Clustering result{std::move(groups.cameraCluster), std::move(groups.projectorCluster),
                    std::move(groups.sizes),         std::move(approximation.transport),
                    std::move(approximation.error),  std::move(groups.statistics)};
  progress.report(1.0);
  return result;
}

}  // namespace relucent::clustering
