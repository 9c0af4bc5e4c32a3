// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>

#include "transport/transport_matrix.h"
#include "venue/projector_model.h"
#include "venue/traced_transport.h"

namespace relucent {

/// What the camera of a simulated venue measures under any picture, free of noise. Camera signal per second.
class VenueLight {
 public:
  VenueLight(const VenueSettings& settings, NodeLayout layout, TracedTransport traced);

  const VenueSettings& settings() const { return settings_; }
  const NodeLayout& layout() const { return layout_; }
  const ProjectorModel& projectorModel() const { return projectorModel_; }

  /// Light from the projectors: their pictures and their black level.
  Stack fromProjectors(const std::vector<Image>& encodedDrive) const;
  const Stack& ambient() const { return ambient_; }
  /// e: the projectors' black level and the ambient light.
  const Stack& black() const { return black_; }
  /// T in row order, computed on first use.
  const TransportMatrix& transport() const;

 private:
  VenueSettings settings_;
  NodeLayout layout_;
  ProjectorModel projectorModel_;
  BlockSparse cameraByNode_;
  Stack projectorBlack_, ambient_, black_;
  mutable std::once_flag transportMade_;
  mutable TransportMatrix transport_;
};

}  // namespace relucent
