// SPDX-License-Identifier: MIT
#include "relucent/venue/texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "relucent/venue/pi.h"

namespace relucent::venue {
namespace {

using Eigen::Array3f;
using Eigen::Vector2f;
using Eigen::Vector3f;

float hash(int x, int y, int z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(y) * 0xd8163841u ^ static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * 0x1.0p-24f;
}

float smoothStep(float from, float to, float x) {
  float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

Array3f mix(const Array3f& a, const Array3f& b, float share) {
  return a + share * (b - a);
}

/// Nothing in a room is blacker or whiter than this.
Array3f plausible(const Array3f& rgb) {
  return rgb.max(0.08f).min(0.86f);
}

/// The place within a cell of a regular grid, and which cell.
struct Cell {
  int column, row;
  float x, y;  // [0, 1)
};
Cell cellAt(float x, float y) {
  float column = std::floor(x), row = std::floor(y);
  return {static_cast<int>(column), static_cast<int>(row), x - column, y - row};
}

float diamond(const Cell& cell) {
  return std::abs(cell.x - 0.5f) + std::abs(cell.y - 0.5f);
}

}  // namespace

float smoothNoise(const Vector3f& place) {
  Vector3f base = place.array().floor();
  int x = static_cast<int>(base.x()), y = static_cast<int>(base.y()), z = static_cast<int>(base.z());
  Vector3f t = place - base;
  t = t.array() * t.array() * (3.0f - 2.0f * t.array());
  auto lerp = [](float a, float b, float share) { return a + share * (b - a); };
  auto row = [&](int dy, int dz) {
    return lerp(hash(x, y + dy, z + dz), hash(x + 1, y + dy, z + dz), t.x());
  };
  return lerp(lerp(row(0, 0), row(1, 0), t.y()), lerp(row(0, 1), row(1, 1), t.y()), t.z());
}

float fractalNoise(const Vector3f& place, int octaves) {
  float sum = 0.0f, weight = 0.5f, total = 0.0f;
  Vector3f at = place;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * smoothNoise(at);
    total += weight;
    weight *= 0.5f;
    at = 2.03f * at + Vector3f(17.1f, 31.7f, 5.3f);
  }
  return sum / total;
}

Texture plainColour(const Array3f& rgb) {
  return [rgb](const TexturePoint&) { return rgb; };
}

Texture cardboard(const Array3f& rgb) {
  return [rgb](const TexturePoint& point) {
    float fibres = fractalNoise({18.0f * point.map.x(), 90.0f * point.map.y(), 1.0f}, 3);
    float stains = smoothNoise({5.0f * point.map.x(), 5.0f * point.map.y(), 9.0f});
    return plausible(rgb * (0.80f + 0.22f * fibres + 0.16f * stains));
  };
}

Texture wallpaper(const Array3f& ground, const Array3f& flower, float repeat) {
  return [=](const TexturePoint& point) {
    float x = point.map.x() / repeat, y = point.map.y() / repeat;
    float stripes = smoothStep(0.40f, 0.46f, std::abs(x - std::round(x)));
    Cell cell = cellAt(x, y + 0.5f * std::fmod(std::abs(std::floor(x)), 2.0f));
    float dx = cell.x - 0.5f, dy = cell.y - 0.5f;
    float radius = std::hypot(dx, dy), angle = std::atan2(dy, dx);
    float petals = 0.20f + 0.09f * std::cos(6.0f * angle);
    float inFlower = 1.0f - smoothStep(petals - 0.02f, petals + 0.02f, radius);
    float inHeart = 1.0f - smoothStep(0.06f, 0.08f, radius);
    float sprig = std::abs(dx - 0.05f * std::sin(14.0f * dy));
    float inStem = (1.0f - smoothStep(0.015f, 0.03f, sprig)) * smoothStep(0.22f, 0.26f, radius);
    Array3f colour = mix(ground, 0.80f * ground, stripes);
    colour = mix(colour, {0.30f, 0.42f, 0.24f}, inStem * (1.0f - stripes));
    colour = mix(colour, flower, inFlower);
    colour = mix(colour, {0.78f, 0.60f, 0.22f}, inHeart);
    return plausible(colour * (0.90f + 0.16f * fractalNoise(60.0f * point.position, 2)));
  };
}

Texture bricks() {
  return [](const TexturePoint& point) {
    constexpr float width = 0.23f, height = 0.075f, joint = 0.012f;
    float row = std::floor(point.map.y() / height);
    Cell cell = cellAt(point.map.x() / width + 0.5f * std::fmod(std::abs(row), 2.0f), point.map.y() / height);
    float rough = fractalNoise(45.0f * point.position, 3);
    float edgeX = std::min(cell.x, 1.0f - cell.x) * width, edgeY = std::min(cell.y, 1.0f - cell.y) * height;
    float edge = std::min(edgeX, edgeY) + 0.006f * (rough - 0.5f);
    float inBrick = smoothStep(0.4f * joint, 0.65f * joint, edge);
    float shade = hash(cell.column, cell.row, 3), hue = hash(cell.column, cell.row, 7);
    Array3f brick = mix({0.60f, 0.30f, 0.20f}, {0.46f, 0.30f, 0.25f}, hue) * (0.72f + 0.5f * shade);
    Array3f mortar(0.60f, 0.57f, 0.52f);
    return plausible(mix(mortar, brick, inBrick) * (0.75f + 0.5f * rough));
  };
}

Texture stone(const Array3f& rgb) {
  return [rgb](const TexturePoint& point) {
    float bend = fractalNoise(6.0f * point.position, 3);
    float vein = std::abs(std::sin(9.0f * (point.position.x() + point.position.y()) + 7.0f * bend));
    float grain = fractalNoise(70.0f * point.position, 2);
    float darkening = 0.30f * (1.0f - smoothStep(0.0f, 0.25f, vein)) + 0.30f * (grain - 0.5f);
    return plausible(mix(rgb, {0.42f, 0.36f, 0.28f}, 0.45f * bend) * (1.0f - darkening));
  };
}

Texture wood() {
  return [](const TexturePoint& point) {
    float x = point.map.x(), y = point.map.y();
    Cell board = cellAt(0.35f * x, y / 0.14f);
    float offset = 10.0f * hash(board.row, 0, 5);
    float rings = fractalNoise({2.5f * x + offset, 28.0f * y + offset, offset}, 4);
    float line = 0.5f + 0.5f * std::sin(40.0f * rings);
    float gap = smoothStep(0.0f, 0.03f, std::min(board.y, 1.0f - board.y));
    Array3f colour = mix({0.36f, 0.23f, 0.14f}, {0.56f, 0.40f, 0.25f}, 0.35f * line + 0.65f * rings);
    return plausible(colour * (0.55f + 0.45f * gap));
  };
}

Texture harlequin(float size) {
  return [size](const TexturePoint& point) {
    static const Array3f colours[] = {{0.70f, 0.64f, 0.50f},
                                      {0.62f, 0.30f, 0.24f},
                                      {0.30f, 0.46f, 0.56f},
                                      {0.66f, 0.56f, 0.28f},
                                      {0.40f, 0.52f, 0.34f}};
    float u = (point.map.x() + 0.6f * point.map.y()) / size,
          v = (point.map.x() - 0.6f * point.map.y()) / size;
    Cell cell = cellAt(u, v);
    const Array3f& colour = colours[static_cast<std::size_t>(4.999f * hash(cell.column, cell.row, 11))];
    float edge = std::min(std::min(cell.x, 1.0f - cell.x), std::min(cell.y, 1.0f - cell.y));
    float line = 1.0f - smoothStep(0.02f, 0.035f, edge);
    float plaster = fractalNoise(35.0f * point.position, 4);
    return plausible(mix(colour, {0.74f, 0.72f, 0.66f}, line) * (0.70f + 0.6f * plaster));
  };
}

Texture domePaint() {
  return [](const TexturePoint& point) {
    float longitude = point.map.x(), latitude = point.map.y();
    float meridians = longitude * 16.0f / pi, parallels = latitude * 12.0f / pi;
    float rib = smoothStep(0.012f, 0.03f, std::abs(meridians - std::round(meridians)));
    float seam = smoothStep(0.012f, 0.03f, std::abs(parallels - std::round(parallels)));
    float band = smoothStep(0.20f, 0.21f, latitude) * (1.0f - smoothStep(0.39f, 0.40f, latitude));
    Cell cell = cellAt(longitude * 12.0f / pi, (latitude - 0.20f) / 0.19f);
    float tile = 1.0f - smoothStep(0.30f, 0.34f, diamond(cell));
    Array3f paint = mix({0.86f, 0.85f, 0.82f}, {0.62f, 0.52f, 0.34f}, band);
    paint = mix(paint, {0.34f, 0.42f, 0.60f}, band * tile);
    float dirt = fractalNoise(4.0f * point.position, 4);
    return plausible(paint * (0.72f + 0.28f * rib * seam) * (0.86f + 0.26f * dirt));
  };
}

}  // namespace relucent::venue
