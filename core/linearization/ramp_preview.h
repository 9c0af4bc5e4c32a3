// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <vector>

#include "relucent/rig/rig.h"

namespace relucent::linearization {

/// Approximate response of a projector while it is being measured, drive -> light, without the drift, the
/// noise and the smoothness of the fit. For display only.
class RampPreview {
 public:
  /// Adds one photograph: of black, of one of a mosaic's nine lights at full, or, once these and black are
  /// known, of a mosaic. Least squares over pixels tell how much of each light it shows. Other patterns, and
  /// pixels that are saturated, are ignored.
  void add(const image::Image& encodedPattern, const rig::RawFrame& frame);

  /// Per channel: drive -> light relative to full. Empty until a mosaic has been photographed.
  std::array<std::map<double, double>, 3> curves() const;

 private:
  /// Signal per second of some of a photograph's pixels; not a number where it is saturated.
  using Light = std::vector<double>;
  /// One of the nine lights: some of the places where it falls on the projector's picture.
  struct Known {
    std::size_t channel = 0;
    std::vector<std::size_t> places;
    Light light;
  };
  struct Mean {
    double sum = 0.0;
    int photographs = 0;
  };

  static Light lightOf(const rig::RawFrame& frame);
  void addKnown(Known known);
  void addMosaic(const image::Image& pattern, const Light& light);

  Light black_;
  std::vector<Known> known_;
  std::array<std::map<double, Mean>, 3> levels_;
};

}  // namespace relucent::linearization
