// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "acquisition/settings.h"
#include "base/message.h"
#include "clustering/clustering.h"
#include "compensation/methods.h"
#include "inverse/windows.h"
#include "linearization/linearization.h"
#include "pipeline/content_settings.h"
#include "pipeline/rig_settings.h"
#include "transport/transport_matrix.h"

namespace relucent {

struct CalibrateSettings {
  RigSettings rig;
  LinearizationSettings linearization;
  AcquisitionSettings acquisition;
  ThresholdSettings threshold;  // none by default: every leaf that was measured counts
  WindowSettings windows;
  bool chooseRidge = true;  // windows.ridge is where the search for the best one starts
  ClusteringSettings clustering = CompensatorSettings().clustering;  // of the cluster maps
  ContentSettings content;
};
/// Sentences about what cannot be; sizes outside 8x8 to 8192x8192 among them.
std::vector<Message> problems(const CalibrateSettings& settings);

}  // namespace relucent
