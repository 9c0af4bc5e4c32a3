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
  /// The share of a camera pixel's light that each projector gives in its floods.
  std::vector<float> floodShares(std::size_t row) const;
  /// How a projector's light is divided in a camera pixel's floods, see multiplexing::Row::mixing.
  std::vector<transport::ColourBlock> floodMixing(std::size_t row) const;

  std::size_t size() const { return photographs_.size(); }
  /// A photograph's place on the disk.
  using Stored = std::size_t;
  /// The light is rounded to half precision, a twentieth of what photon noise leaves of it at best. What is
  /// stored is not seen before it is added, so that Rows may be read meanwhile.  Throws: Error{disk}.
  [[nodiscard]] Stored store(const hdr::LampLight& seen);
  /// How many have been stored so far, those that are forgotten included.
  std::size_t stored() const { return stored_; }
  /// As the last of the photographs.
  void add(Stored photograph) { photographs_.push_back({photograph, 1.0f}); }
  /// Forgets all but the first ones.
  void keep(std::size_t count);

  /// Camera pixels and photographs, and that these did not see those.
  using Rejections = std::vector<std::pair<std::size_t, std::uint32_t>>;
  void reject(const Rejections& unseen);
  /// Divides all light of a photograph.
  void divide(std::size_t photograph, float gain) { photographs_[photograph].scale /= gain; }
  /// As if nothing had been rejected or divided.
  void forgetJudgements();

  std::size_t parts() const { return (references_.usable.size() + rowsTogether - 1) / rowsTogether; }
  /// Whether any of a part's camera pixels is usable. Of other parts nothing is stored.
  bool isUsed(std::size_t part) const { return used_[part] != 0; }

  /// What the camera pixels of one part saw.
  class Rows {
   public:
    /// Contract: the part is used.  Throws: Error{disk}.
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
    std::vector<Eigen::half> values_;  // [stored][light, deviation][row][channel]
  };

 private:
  struct Photograph {
    Stored stored;
    float scale;  // of its light and deviation
  };

  std::uint64_t placeOf(Stored photograph, std::size_t part) const;

  const photography::References& references_;
  CameraStack flood_;
  std::vector<std::uint8_t> used_;  // per part
  ScratchFile file_;
  std::size_t stored_ = 0;
  std::vector<Photograph> photographs_;
  Rejections rejected_;  // ascending
};

}  // namespace relucent::acquisition
