// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "relucent/base/scratch_file.h"
#include "relucent/hdr/hdr.h"
#include "relucent/multiplexing/regression.h"
#include "relucent/photography/references.h"

namespace relucent::acquisition {

/// What all camera pixels showed under the floods and under dense patterns, ready to be solved row by row:
/// relative to each pixel's floods F_c, all projectors and their channels summed. The photographs of patterns
/// lie on the disk (12 bytes a camera pixel each: 4 GB for 180 of 2 megapixels); Rows has those of a few
/// camera pixels in memory.
class DensePhotographs {
 public:
  /// Camera pixels that lie together on the disk.
  static constexpr std::size_t rowsTogether = 256;

  /// Keeps a reference, which outlives it.  Throws: Error{disk}.
  explicit DensePhotographs(const photography::References& references);

  /// F of a camera pixel; where it is next to nothing, what counts as that.
  Eigen::Array3f flood(std::size_t row) const { return Eigen::Map<const Eigen::Array3f>(&flood_[3 * row]); }
  /// How a projector's light is divided in a camera pixel's floods, see multiplexing::Row::mixing.
  std::vector<transport::ColourBlock> floodMixing(std::size_t row) const;

  std::size_t size() const { return scale_.size(); }
  /// The light is rounded to half precision, a twentieth of what photon noise leaves of it at best.
  /// Throws: Error{disk}.
  void add(const hdr::LampLight& seen);
  /// Forgets all but the first ones.
  void keep(std::size_t count);

  /// Camera pixels and photographs, and that these did not see those.
  using Rejections = std::vector<std::pair<std::size_t, std::uint32_t>>;
  void reject(const Rejections& unseen);
  /// Divides all light of a photograph.
  void divide(std::size_t photograph, float gain) { scale_[photograph] /= gain; }
  /// As if nothing had been rejected or divided.
  void forgetJudgements();

  std::size_t parts() const { return (references_.usable.size() + rowsTogether - 1) / rowsTogether; }

  /// What the camera pixels of one part saw.
  class Rows {
   public:
    /// Throws: Error{disk}.
    Rows(const DensePhotographs& photographs, std::size_t part);

    std::size_t begin() const { return begin_; }
    std::size_t end() const { return end_; }
    /// A camera pixel's equations. The last `heldOut` photographs count as not seen.
    void read(std::size_t row, std::size_t heldOut, multiplexing::RowLight& seen) const;
    /// What a photograph showed of a camera pixel, and its variance: infinite where it was saturated.
    std::pair<Eigen::Array3f, Eigen::Array3f> shown(std::size_t photograph, std::size_t row) const;
    /// Whether a camera pixel was saturated too often to be known.
    bool hardlySeen(std::size_t row) const;

   private:
    const DensePhotographs& photographs_;
    std::size_t begin_, end_;
    std::vector<Eigen::half> values_;  // [photograph][light, deviation][row][channel]
  };

 private:
  std::uint64_t placeOf(std::size_t photograph, std::size_t part) const;

  const photography::References& references_;
  CameraStack flood_;
  ScratchFile file_;
  std::vector<float> scale_;  // of a photograph's light and deviation
  Rejections rejected_;       // ascending
};

}  // namespace relucent::acquisition
