// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

namespace relucent::venue {

/// Where a texture is evaluated: a position in the world (metres) and in texture coordinates (metres on flat
/// surfaces).
struct TexturePoint {
  Eigen::Vector3f position;
  Eigen::Vector2f map;
};

/// Diffuse reflectance as long, middle and short wavelengths; see reflectance().
using Texture = std::function<Eigen::Array3f(const TexturePoint&)>;

Texture plainColour(const Eigen::Array3f& rgb);
/// Fibrous cardboard.
Texture cardboard(const Eigen::Array3f& rgb);
/// Flowers in a half-drop repeat of `repeat` metres.
Texture wallpaper(const Eigen::Array3f& ground, const Eigen::Array3f& flower, float repeat);
/// A running bond of bricks, 0.23 x 0.075 m.
Texture bricks();
/// Veined, weathered stone.
Texture stone(const Eigen::Array3f& rgb);
/// Boards along the first texture coordinate.
Texture wood();
/// Painted diamonds in several colours on coarse plaster.
Texture harlequin(float size);
/// Off-white paint with ribs along a dome's meridians, seams along its parallels and a painted band;
/// map: longitude and latitude in radians.
Texture domePaint();

/// Smooth noise in [0, 1], one feature a unit; fractal() adds finer octaves.
float smoothNoise(const Eigen::Vector3f& place);
float fractalNoise(const Eigen::Vector3f& place, int octaves);

}  // namespace relucent::venue
