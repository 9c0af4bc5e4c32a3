// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>

#include "relucent/transport/transport_matrix.h"
#include "relucent/venue/projector_model.h"
#include "relucent/venue/traced_transport.h"

namespace relucent::venue {

/// What the cameras of a simulated venue measure under any picture, free of noise. Camera signal per second.
class VenueLight {
 public:
  /// `roomLight`: what `traced.roomLight` is multiplied by; none: as the settings ask for.
  VenueLight(const VenueSettings& settings, transport::NodeLayout layout, Rasters cameras,
             TracedTransport traced, std::optional<float> roomLight = {});

  const VenueSettings& settings() const { return settings_; }
  const transport::NodeLayout& layout() const { return layout_; }
  const Rasters& cameras() const { return cameras_; }
  const ProjectorModel& projectorModel() const { return projectorModel_; }

  /// Light from the projectors: their pictures and their black level.
  CameraStack fromProjectors(const std::vector<image::Image>& encodedDrive) const;
  /// Light of linear values of all projectors' pixels, which hold their black level if it is to be seen.
  CameraStack fromLight(const ProjectorStack& linear) const;
  const CameraStack& ambient() const { return ambient_; }
  float roomLight() const { return roomLight_; }
  /// e: the projectors' black level and the ambient light.
  const CameraStack& black() const { return black_; }
  /// T in row order, computed on first use.
  const transport::TransportMatrix& transport() const;

 private:
  VenueSettings settings_;
  transport::NodeLayout layout_;
  Rasters cameras_;
  ProjectorModel projectorModel_;
  transport::BlockSparse cameraByNode_;
  CameraStack projectorBlack_, ambient_, black_;
  float roomLight_ = 0.0f;
  mutable std::once_flag transportMade_;
  mutable transport::TransportMatrix transport_;
};

}  // namespace relucent::venue
