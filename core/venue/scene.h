// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/venue/mesh.h"
#include "relucent/venue/optics.h"
#include "relucent/venue/scattering.h"

namespace relucent::venue {

struct Surface {
  Mesh mesh;
  Material material;
};

/// Surfaces and the devices that face them. Metres; y is up.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<ProjectorOptics> projectors;
  std::vector<CameraOptics> cameras;
  std::vector<CameraOptics> hidden;  // where viewers stand of whom no device knows
};

}  // namespace relucent::venue
