// SPDX-License-Identifier: MIT
#include "relucent/venue/optics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "relucent/venue/pi.h"
#include "relucent/venue/texture.h"

namespace relucent::venue {

using Eigen::Vector2f;
using Eigen::Vector3f;

Pose Pose::lookingAt(const Vector3f& position, const Vector3f& target) {
  Pose pose;
  pose.position = position;
  pose.forward = (target - position).normalized();
  pose.right = pose.forward.cross(Vector3f::UnitY()).normalized();
  pose.up = pose.right.cross(pose.forward);
  return pose;
}

Vector2f discFromSquare(const Vector2f& square) {
  Vector2f centred = 2.0f * square - Vector2f::Ones();
  if (centred.x() == 0.0f && centred.y() == 0.0f) return Vector2f::Zero();
  bool wide = std::abs(centred.x()) > std::abs(centred.y());
  float radius = wide ? centred.x() : centred.y();
  float angle =
      wide ? 0.25f * pi * centred.y() / centred.x() : 0.5f * pi - 0.25f * pi * centred.x() / centred.y();
  return radius * Vector2f(std::cos(angle), std::sin(angle));
}

Ray CameraOptics::ray(const Vector2f& place) const {
  float width = static_cast<float>(raster.width), height = static_cast<float>(raster.height);
  float x = (place.x() - 0.5f * width) / (throwRatio * width);
  float y = (0.5f * height - place.y()) / (throwRatio * width);
  return {pose.position, (pose.forward + x * pose.right + y * pose.up).normalized()};
}

Vector3f ProjectorOptics::onLens(const Vector2f& lens) const {
  Vector2f disc = 0.5f * aperture * discFromSquare(lens);
  return pose.position + disc.x() * pose.right + disc.y() * pose.up;
}

float ProjectorOptics::strength(const Vector2f& tangents) const {
  float aspect = static_cast<float>(raster.height) / static_cast<float>(raster.width);
  float corner = 0.25f * (1.0f + aspect * aspect) / (throwRatio * throwRatio);
  float squared = tangents.squaredNorm();
  float cosineSquared = 1.0f / (1.0f + squared);
  const float clear =
      focus * focus * (1.0f - vignetting * squared / corner) / (cosineSquared * cosineSquared);
  if (dust == 0.0f) return clear;
  // Out of focus: blotches of about a sixth of the picture.
  const Vector3f blotches(6.0f * throwRatio * tangents.x(), 6.0f * throwRatio * tangents.y(), 0.5f);
  const float thick = std::clamp(3.0f * smoothNoise(blotches) - 1.5f, 0.0f, 1.0f);
  return clear * (1.0f - dust * thick);
}

std::optional<LensConnection> ProjectorOptics::connect(const Vector3f& point, const Vector2f& lens) const {
  Vector3f from = onLens(lens);
  Vector3f path = point - from;
  float depth = path.dot(pose.forward);
  if (depth <= 1e-3f) return std::nullopt;

  // The picture that decides is where the path crosses the focal plane.
  Vector3f focal = from - pose.position + path * (focus / depth);
  Vector2f tangents(focal.dot(pose.right) / focus, focal.dot(pose.up) / focus);
  float width = static_cast<float>(raster.width), height = static_cast<float>(raster.height);
  Vector2f place(0.5f * width + tangents.x() * throwRatio * width,
                 0.5f * height - tangents.y() * throwRatio * width);
  if (place.x() < 0.0f || place.y() < 0.0f || place.x() >= width || place.y() >= height) return std::nullopt;

  LensConnection connection;
  connection.distance = path.norm();
  connection.direction = -path / connection.distance;
  connection.place = place;
  float cosine = depth / connection.distance;
  connection.irradiance = strength(tangents) * cosine / (connection.distance * connection.distance);
  float pitch = depth / (throwRatio * width);
  connection.pixelArea = pitch * pitch * cosine;
  return connection;
}

Emission ProjectorOptics::emission(const Vector2f& place, const Vector2f& lens) const {
  float width = static_cast<float>(raster.width), height = static_cast<float>(raster.height);
  Vector2f tangents((place.x() - 0.5f * width) / (throwRatio * width),
                    (0.5f * height - place.y()) / (throwRatio * width));
  Vector3f from = onLens(lens);
  Vector3f focal =
      pose.position + focus * (pose.forward + tangents.x() * pose.right + tangents.y() * pose.up);
  Vector3f path = focal - from;
  float distance = path.norm(), cosine = focus / distance;
  float pixel = pixelPitch() * pixelPitch();
  return {{from, path / distance}, strength(tangents) * pixel * cosine * cosine / (distance * distance)};
}

}  // namespace relucent::venue
