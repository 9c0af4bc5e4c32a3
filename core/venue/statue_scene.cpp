// SPDX-License-Identifier: MIT
#include "venue/scenes.h"

namespace relucent {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// How far rough-hewn stone stands out at a place on the unit sphere, metres.
auto hewn(float depth, float seed) {
  return [=](const Vector3f& p) {
    return depth * (fractalNoise(5.0f * p + Vector3f::Constant(seed), 4) - 0.5f);
  };
}

/// Hair in waves over the back and the top of the head.
float hair(const Vector3f& p) {
  float covered = std::max(0.0f, std::min(1.0f, 4.0f * (p.y() - 0.45f * p.z() - 0.1f)));
  return covered * (0.012f + 0.007f * std::sin(26.0f * p.x() + 10.0f * fractalNoise(4.0f * p, 3)));
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
  add({0.0f, -0.30f, -0.06f}, {0.30f, 0.20f, 0.16f}, hewn(0.035f, 3.0f));     // shoulders
  add({0.0f, -0.36f, 0.02f}, {0.19f, 0.17f, 0.14f}, hewn(0.03f, 9.0f));       // chest
  add({0.0f, -0.10f, -0.04f}, {0.078f, 0.15f, 0.080f}, hewn(0.008f, 5.0f));   // neck
  add({0.0f, 0.13f, 0.0f}, {0.125f, 0.175f, 0.15f}, hair);                    // head
  add({0.0f, 0.055f, 0.045f}, {0.085f, 0.105f, 0.095f}, hewn(0.006f, 7.0f));  // jaw
  add({0.0f, 0.105f, 0.150f}, {0.018f, 0.044f, 0.034f}, {});                  // nose
  add({0.0f, 0.195f, 0.105f}, {0.095f, 0.028f, 0.046f}, {});                  // brow
  add({0.0f, 0.035f, 0.134f}, {0.034f, 0.011f, 0.016f}, {});                  // mouth
  for (float side : {-1.0f, 1.0f}) {
    add({0.045f * side, 0.150f, 0.118f}, {0.024f, 0.016f, 0.018f}, {});  // eyes
    add({0.128f * side, 0.115f, -0.01f}, {0.016f, 0.042f, 0.030f}, {});  // ears
    add({0.055f * side, 0.075f, 0.100f}, {0.036f, 0.036f, 0.034f}, {});  // cheeks
  }
  Vector2f plinth[] = {{0.0f, 0.0f},   {0.26f, 0.0f},  {0.26f, 0.05f}, {0.21f, 0.07f}, {0.15f, 0.09f},
                       {0.13f, 0.12f}, {0.15f, 0.16f}, {0.20f, 0.18f}, {0.20f, 0.20f}, {0.0f, 0.20f}};
  scene.surfaces.push_back({lathe({0.0f, -0.68f, -0.04f}, plinth, 96), {stone({0.58f, 0.56f, 0.54f})}});
  scene.surfaces.push_back(
      {rectangle({-2.5f, -0.68f, 3.5f}, {5.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -5.0f}), {wood()}});
  placeDevices(scene, settings, {0.0f, -0.10f, -0.15f}, 8.0f);
  return scene;
}

}  // namespace relucent
