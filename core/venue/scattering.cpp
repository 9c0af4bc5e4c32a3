// SPDX-License-Identifier: MIT
#include "relucent/venue/scattering.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "relucent/venue/optics.h"
#include "relucent/venue/pi.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

Vector3f mirrored(const Vector3f& direction, const Vector3f& normal) {
  return 2.0f * normal.dot(direction) * normal - direction;
}

/// `local` with its z axis turned to `axis`.
Vector3f around(const Vector3f& axis, const Vector3f& local) {
  Vector3f helper = std::abs(axis.x()) < 0.6f ? Vector3f::UnitX() : Vector3f::UnitY();
  Vector3f x = axis.cross(helper).normalized();
  return local.x() * x + local.y() * axis.cross(x) + local.z() * axis;
}

float glossCosine(const ScatteringPoint& point, const Vector3f& incoming) {
  return std::max(0.0f, mirrored(point.outgoing, point.normal).dot(incoming));
}

}  // namespace

float ScatteringPoint::cosine(const Vector3f& incoming) const {
  return geometricNormal.dot(incoming) > 0.0f ? std::max(0.0f, normal.dot(incoming)) : 0.0f;
}

Spectrum ScatteringPoint::brdf(const Vector3f& incoming) const {
  Spectrum value = diffuse * ((1.0f - gloss) / pi);
  if (gloss > 0.0f)
    value +=
        gloss * (glossExponent + 2.0f) / (2.0f * pi) * std::pow(glossCosine(*this, incoming), glossExponent);
  return value;
}

Bounce sampleBounce(const ScatteringPoint& point, const Vector2f& sample, float choice) {
  float diffuseEnergy = (1.0f - point.gloss) * point.diffuse.mean();
  float glossShare = point.gloss > 0.0f ? point.gloss / (point.gloss + diffuseEnergy) : 0.0f;
  Bounce bounce;
  if (choice < glossShare) {
    float cosine = std::pow(1.0f - sample.x(), 1.0f / (point.glossExponent + 1.0f));
    float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    float angle = 2.0f * pi * sample.y();
    bounce.direction = around(mirrored(point.outgoing, point.normal),
                              {sine * std::cos(angle), sine * std::sin(angle), cosine});
  } else {
    Vector2f disc = discFromSquare(sample);
    bounce.direction =
        around(point.normal, {disc.x(), disc.y(), std::sqrt(std::max(0.0f, 1.0f - disc.squaredNorm()))});
  }
  float cosine = point.cosine(bounce.direction);
  bounce.density = (1.0f - glossShare) * cosine / pi;
  if (glossShare > 0.0f)
    bounce.density += glossShare * (point.glossExponent + 1.0f) / (2.0f * pi) *
                      std::pow(glossCosine(point, bounce.direction), point.glossExponent);
  bounce.weight = Spectrum::Zero();
  if (cosine > 0.0f && bounce.density > 0.0f)
    bounce.weight = point.brdf(bounce.direction) * (cosine / bounce.density);
  return bounce;
}

Vector3f throughGlass(const Vector3f& direction, const Vector3f& normal, float refractiveIndex,
                      float choice) {
  bool entering = direction.dot(normal) < 0.0f;
  Vector3f facing = entering ? normal : Vector3f(-normal);
  float ratio = entering ? 1.0f / refractiveIndex : refractiveIndex;
  float cosineIn = -direction.dot(facing);
  Vector3f reflected = direction + 2.0f * cosineIn * facing;
  float sineSquared = ratio * ratio * (1.0f - cosineIn * cosineIn);
  if (sineSquared >= 1.0f) return reflected.normalized();

  float cosineOut = std::sqrt(1.0f - sineSquared);
  float across = (ratio * cosineIn - cosineOut) / (ratio * cosineIn + cosineOut);
  float along = (cosineIn - ratio * cosineOut) / (cosineIn + ratio * cosineOut);
  float reflectance = 0.5f * (across * across + along * along);
  if (choice < reflectance) return reflected.normalized();
  return (ratio * direction + (ratio * cosineIn - cosineOut) * facing).normalized();
}

}  // namespace relucent::venue
