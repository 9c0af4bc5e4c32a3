// SPDX-License-Identifier: MIT
#include <array>

#include "relucent/venue/scenes.h"

namespace relucent::venue {

/// A wine glass, filled to two thirds. Glass and wine are one solid: their refractive indices are close.
Scene glassScene(const VenueSettings& settings) {
  using Eigen::Vector2f;
  Scene scene;
  scene.surfaces.push_back({rectangle({-2.5f, -1.5f, -0.45f}, {5.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}),
                            {wallpaper({0.66f, 0.60f, 0.42f}, {0.28f, 0.42f, 0.62f}, 0.24f)}});
  scene.surfaces.push_back(
      {rectangle({-2.5f, -0.56f, 3.5f}, {5.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -5.0f}), {wood()}});
  std::array profile = {
      Vector2f(0.0f, 0.0f),     Vector2f(0.195f, 0.0f),   Vector2f(0.200f, 0.006f), Vector2f(0.195f, 0.012f),
      Vector2f(0.110f, 0.024f), Vector2f(0.050f, 0.042f), Vector2f(0.026f, 0.075f), Vector2f(0.022f, 0.130f),
      Vector2f(0.022f, 0.260f), Vector2f(0.026f, 0.310f), Vector2f(0.060f, 0.345f), Vector2f(0.115f, 0.380f),
      Vector2f(0.165f, 0.430f), Vector2f(0.200f, 0.500f), Vector2f(0.218f, 0.580f), Vector2f(0.220f, 0.660f),
      Vector2f(0.212f, 0.740f), Vector2f(0.196f, 0.820f), Vector2f(0.182f, 0.880f), Vector2f(0.179f, 0.884f),
      Vector2f(0.176f, 0.880f), Vector2f(0.189f, 0.820f), Vector2f(0.204f, 0.745f), Vector2f(0.206f, 0.712f),
      Vector2f(0.202f, 0.702f), Vector2f(0.190f, 0.700f), Vector2f(0.0f, 0.700f)};
  Material glass;
  glass.texture = plainColour({0.0f, 0.0f, 0.0f});
  glass.refractiveIndex = 1.4f;
  scene.surfaces.push_back({lathe({0.0f, -0.56f, 0.05f}, profile, 128), glass});
  placeDevices(scene, settings, {0.0f, -0.08f, -0.40f}, 8.0f);
  return scene;
}

}  // namespace relucent::venue
