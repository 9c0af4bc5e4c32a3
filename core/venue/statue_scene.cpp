// SPDX-License-Identifier: MIT
#include "relucent/venue/scenes.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// How far rough-hewn stone stands out at a place on the unit sphere, metres.
auto roughStone(float depth, float seed) {
  return [=](const Vector3f& p) {
    return depth * (fractalNoise(5.0f * p + Vector3f::Constant(seed), 4) - 0.5f);
  };
}

/// Hair in waves over the back and the top of the head.
float hair(const Vector3f& p) {
  float covered = std::max(0.0f, std::min(1.0f, 4.0f * (p.y() - 0.45f * p.z() - 0.1f)));
  return covered * (0.010f + 0.006f * std::sin(34.0f * p.x() + 9.0f * fractalNoise(4.0f * p, 3)));
}

}  // namespace

Scene statueScene(const VenueSettings& settings) {
  Scene scene;
  scene.surfaces.push_back(
      {rectangle({-2.5f, -1.5f, -0.55f}, {5.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}), {bricks()}});
  Material marble{stone({0.80f, 0.77f, 0.70f}), 0.03f, 25.0f};
  auto add = [&](const Vector3f& centre, const Vector3f& radii,
                 const std::function<float(const Vector3f&)>& shape) {
    scene.surfaces.push_back({ellipsoid(centre, radii, 160, shape), marble});
  };
  add({0.0f, -0.32f, -0.06f}, {0.31f, 0.17f, 0.15f}, roughStone(0.020f, 3.0f));     // shoulders
  add({0.0f, -0.36f, 0.00f}, {0.22f, 0.20f, 0.15f}, roughStone(0.018f, 9.0f));      // chest
  add({0.0f, -0.09f, -0.03f}, {0.082f, 0.17f, 0.080f}, roughStone(0.006f, 5.0f));   // neck
  add({0.0f, 0.14f, -0.01f}, {0.128f, 0.175f, 0.155f}, hair);                       // head
  add({0.0f, 0.060f, 0.040f}, {0.090f, 0.115f, 0.100f}, roughStone(0.004f, 7.0f));  // face
  add({0.0f, -0.020f, 0.100f}, {0.038f, 0.030f, 0.034f}, {});                       // chin
  add({0.0f, 0.125f, 0.138f}, {0.017f, 0.052f, 0.022f}, {});                        // nose
  add({0.0f, 0.090f, 0.146f}, {0.025f, 0.017f, 0.028f}, {});
  add({0.0f, 0.034f, 0.132f}, {0.032f, 0.0075f, 0.016f}, {});  // lips
  add({0.0f, 0.022f, 0.128f}, {0.026f, 0.0085f, 0.016f}, {});
  for (float side : {-1.0f, 1.0f}) {
    add({0.045f * side, 0.168f, 0.112f}, {0.044f, 0.013f, 0.030f}, {});  // brows
    add({0.045f * side, 0.137f, 0.108f}, {0.026f, 0.017f, 0.022f}, {});  // eyes
    add({0.129f * side, 0.110f, -0.01f}, {0.014f, 0.040f, 0.028f}, {});  // ears
    add({0.048f * side, 0.070f, 0.088f}, {0.046f, 0.050f, 0.044f}, {});  // cheeks
  }
  Vector2f plinth[] = {{0.0f, 0.0f},   {0.26f, 0.0f},  {0.26f, 0.05f}, {0.21f, 0.07f}, {0.15f, 0.09f},
                       {0.13f, 0.12f}, {0.15f, 0.16f}, {0.20f, 0.18f}, {0.20f, 0.20f}, {0.0f, 0.20f}};
  scene.surfaces.push_back({lathe({0.0f, -0.68f, -0.04f}, plinth, 96), {stone({0.58f, 0.56f, 0.54f})}});
  scene.surfaces.push_back(
      {rectangle({-2.5f, -0.68f, 3.5f}, {5.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -5.0f}), {wood()}});
  placeDevices(scene, settings, {0.0f, -0.10f, -0.15f}, 8.0f);
  return scene;
}

}  // namespace relucent::venue
