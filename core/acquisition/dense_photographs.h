// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/multiplexing/regression.h"
#include "relucent/photography/references.h"

namespace relucent::acquisition {

/// What all camera pixels showed under the floods and under dense patterns, ready to be solved row by row:
/// relative to each pixel's floods F_c, all projectors and their channels summed.
class DensePhotographs {
 public:
  /// Keeps a reference, which outlives it.
  explicit DensePhotographs(const photography::References& references);

  /// F of a camera pixel; where it is next to nothing, what counts as that.
  Eigen::Array3f flood(std::size_t row) const { return Eigen::Map<const Eigen::Array3f>(&flood_[3 * row]); }
  /// How a projector's light is divided in a camera pixel's floods, see multiplexing::Row::mixing.
  std::vector<transport::ColourBlock> floodMixing(std::size_t row) const;

  std::size_t size() const { return photographs_.size(); }
  /// The light is rounded to half precision, a twentieth of what photon noise leaves of it at best.
  void add(const hdr::LampLight& seen);
  /// Forgets all but the first ones.
  void keep(std::size_t count) { photographs_.resize(count); }

  /// Takes what a photograph shows of a camera pixel for unseen.
  void reject(std::size_t photograph, std::size_t row);
  /// Divides all light of a photograph.
  void divide(std::size_t photograph, float gain) { photographs_[photograph].scale /= gain; }

  /// A camera pixel's equations.  The last `heldOut` photographs count as not seen.
  void read(std::size_t row, std::size_t heldOut, multiplexing::RowLight& seen) const;
  /// What a photograph showed of a camera pixel, and its variance: infinite where it was saturated.
  std::pair<Eigen::Array3f, Eigen::Array3f> shown(std::size_t photograph, std::size_t row) const;
  /// Whether a camera pixel was saturated too often to be known.
  bool hardlySeen(std::size_t row) const;

 private:
  struct Photograph {
    std::vector<Eigen::half> light;
    std::vector<Eigen::half> deviation;  // infinite: saturated
    float scale = 1.0f;                  // of both
  };

  const photography::References& references_;
  CameraStack flood_;
  std::vector<Photograph> photographs_;
};

}  // namespace relucent::acquisition
