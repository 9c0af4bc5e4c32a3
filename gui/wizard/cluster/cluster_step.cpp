// SPDX-License-Identifier: MIT
#include "wizard/cluster/cluster_step.h"

#include "wizard/cluster/cluster_view.h"

namespace relucent::gui {

WizardStep clusterStep() {
  return stepOf<ClusterPage>();
}

}  // namespace relucent::gui
