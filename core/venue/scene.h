// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "venue/mesh.h"
#include "venue/optics.h"
#include "venue/scattering.h"

namespace relucent {

struct Surface {
  Mesh mesh;
  Material material;
};

/// Surfaces and the devices that face them. Metres; y is up.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<ProjectorOptics> projectors;
  CameraOptics camera;
};

}  // namespace relucent
