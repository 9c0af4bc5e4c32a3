// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <vector>

#include "relucent/rig/rig.h"

namespace relucent::linearization {

/// Approximate responses of projectors while they are being measured, drive -> light, without the drift, the
/// noise and the smoothness of the fit. For display only.
class RampPreview {
 public:
  /// Adds one photograph of what all projectors show: black, one of the lights of one projector's mosaic
  /// at full, or, once these and black are known, mosaics of one or more. Least squares over pixels tell how
  /// much of each light it shows. Other patterns, and pixels that are saturated, are ignored.
  void add(const std::vector<image::Image>& encodedPatterns, const rig::RawFrame& frame);

  /// Per channel: drive -> light relative to full. Empty until a mosaic of this projector was photographed.
  std::array<std::map<double, double>, 3> curves(std::size_t projector = 0) const;

 private:
  /// Signal per second of some of a photograph's pixels; not a number where it is saturated.
  using Light = std::vector<double>;
  /// One of the lights: some of the places where it falls on the projector's picture.
  struct Known {
    std::size_t channel = 0;
    std::vector<std::size_t> places;
    Light light;
  };
  struct Mean {
    double sum = 0.0;
    int photographs = 0;
  };
  struct Measured {
    std::vector<Known> known;
    std::array<std::map<double, Mean>, 3> levels;
  };
  /// How much of a known light a photograph should show.
  struct Shown {
    const Known* known;
    Mean* mean;  // of its level
  };

  static Light lightOf(const rig::RawFrame& frame);
  static void addKnown(Measured& projector, Known known);
  /// Of every light that `pattern` shows; none if it is not a mosaic of known lights.
  static std::vector<Shown> shownBy(Measured& projector, const image::Image& pattern);
  void addMosaics(const std::vector<Shown>& shown, const Light& light) const;

  Light black_;
  std::vector<Measured> projectors_;
};

}  // namespace relucent::linearization
