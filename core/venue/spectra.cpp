// SPDX-License-Identifier: MIT
#include "relucent/venue/spectra.h"

#include <cmath>

namespace relucent::venue {
namespace {

float wavelength(int band) {
  return 410.0f + 25.0f * static_cast<float>(band);
}

Spectrum bell(float centre, float deviation) {
  Spectrum result;
  for (int band = 0; band < bandCount; ++band) {
    float distance = (wavelength(band) - centre) / deviation;
    result[band] = std::exp(-0.5f * distance * distance);
  }
  return result;
}

/// Rises from 0 to 1 around `edge`.
Spectrum step(float edge, float width) {
  Spectrum result;
  for (int band = 0; band < bandCount; ++band)
    result[band] = 1.0f / (1.0f + std::exp((edge - wavelength(band)) / width));
  return result;
}

std::array<Spectrum, 3> makePrimaries() {
  // A lamp behind colour filters: each lets a little of everything through.
  return {bell(622.0f, 26.0f) + 0.25f * bell(585.0f, 14.0f) + 0.010f, bell(538.0f, 27.0f) + 0.012f,
          1.15f * bell(456.0f, 19.0f) + 0.015f};
}

std::array<Spectrum, 3> makeSensitivities() {
  std::array<Spectrum, 3> channels = {bell(603.0f, 33.0f) + 0.04f * bell(450.0f, 25.0f),
                                      bell(534.0f, 38.0f) + 0.03f, bell(462.0f, 27.0f) + 0.02f};
  Spectrum white = projectorPrimaries()[0] + projectorPrimaries()[1] + projectorPrimaries()[2];
  for (Spectrum& channel : channels) channel /= (channel * white).sum();
  return channels;
}

}  // namespace

Spectrum reflectance(const Eigen::Array3f& rgb) {
  // A partition of unity: the three shares add up to 1 in every band.
  static const Spectrum red = step(585.0f, 12.0f);
  static const Spectrum blue = 1.0f - step(492.0f, 12.0f);
  static const Spectrum green = 1.0f - red - blue;
  return rgb[0] * red + rgb[1] * green + rgb[2] * blue;
}

const std::array<Spectrum, 3>& projectorPrimaries() {
  static const std::array<Spectrum, 3> primaries = makePrimaries();
  return primaries;
}

const std::array<Spectrum, 3>& cameraSensitivities() {
  static const std::array<Spectrum, 3> sensitivities = makeSensitivities();
  return sensitivities;
}

transport::ColourBlock colourBlock(const Spectrum& transport) {
  transport::ColourBlock block;
  for (std::size_t c = 0; c < 3; ++c) {
    Spectrum seen = cameraSensitivities()[c] * transport;
    for (std::size_t p = 0; p < 3; ++p)
      block(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(p)) =
          (seen * projectorPrimaries()[p]).sum();
  }
  return block;
}

Eigen::Array3f underRoomLight(const Spectrum& reflectance) {
  static const Spectrum room = 0.35f + step(560.0f, 80.0f);
  static const float green = (cameraSensitivities()[1] * room).sum();
  Eigen::Array3f seen;
  for (std::size_t c = 0; c < 3; ++c)
    seen[static_cast<Eigen::Index>(c)] = (cameraSensitivities()[c] * room * reflectance).sum() / green;
  return seen;
}

}  // namespace relucent::venue
