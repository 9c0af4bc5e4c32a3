// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/base/message.h"
#include "relucent/clustering/clustering.h"
#include "relucent/compensation/methods.h"
#include "relucent/inverse/windows.h"
#include "relucent/linearization/linearization.h"
#include "relucent/pipeline/content_settings.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::pipeline {

struct CalibrateSettings {
  RigSettings rig;
  reduction::PixelUse pixels;  // of the cameras; what follows from it is in reductions.h
  linearization::LinearizationSettings linearization;
  acquisition::AcquisitionSettings acquisition = settingsOf(acquisition::AcquisitionMode::multiplexed);
  transport::ThresholdSettings threshold;  // none by default: every leaf that was measured counts
  inverse::WindowSettings windows;
  bool chooseRidge = true;  // windows.ridge is where the search for the best one starts
  clustering::ClusteringSettings clustering =
      compensation::CompensatorSettings().clustering;  // of the cluster maps
  ContentSettings content;
  NetworkProjectors network{};  // where the rig's projectors are on the network
};
/// Sentences about what cannot be; sizes outside 8x8 to 8192x8192 among them.
std::vector<Message> problems(const CalibrateSettings& settings);

}  // namespace relucent::pipeline
