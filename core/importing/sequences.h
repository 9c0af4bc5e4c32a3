// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/base/parallel.h"
#include "relucent/base/progress.h"
#include "relucent/importing/picture_sequence.h"
#include "relucent/linearization/linearization.h"

/// What the steps of an import share. Frames are indices of pictures.
namespace relucent::importing {

/// Which pictures serve for what.
struct ImportFrames {
  std::vector<int> fitted;   // all that are not held out
  std::vector<int> spatial;  // of these, those with content: they say where light comes from
  std::vector<int> heldOut;
  int channels = 1;  // that tell places apart: 3 only where spatial patterns and photographs have colours
  /// Values of a sequence: one for each spatial frame and channel, frame after frame.
  int samples() const { return static_cast<int>(spatial.size()) * channels; }
};
/// The pictures of an import, and which of them serve for what.
struct ImportPictures {
  const PictureSequence& patterns;
  const PictureSequence& photographs;
  const ImportFrames& frames;
};
/// Whether a pattern holds nothing between black and white.
bool isBinary(const PictureSequence& patterns, int picture);
/// Mean difference between neighbouring pixels, all channels: how fine a pattern is. 0: even all over.
double finenessOf(const PictureSequence& patterns, int picture);
/// Patterns that are not even all over, coarse ones first.
std::vector<int> byFineness(const PictureSequence& patterns);

/// `heldOut`: ascending; may be empty.
ImportFrames chooseFrames(const PictureSequence& patterns, const PictureSequence& photographs,
                          std::vector<int> heldOut);

/// Linear drive of every encoded value that a pattern can hold.
class DriveTable {
 public:
  explicit DriveTable(const linearization::ProjectorResponse& response);
  float operator()(std::uint16_t code, int channel) const {
    return table_[static_cast<std::size_t>(channel)][(code + 128u) / 257u];
  }

 private:
  std::array<std::array<float, 256>, 3> table_;
};

/// The patterns' linear sequences over the nodes of a mean pyramid, pixel level first. Level l has blocks of
/// 2^l x 2^l pixels, cut off at the border.
struct SequencePyramid {
  struct Level {
    Size grid;
    LargeVector<float> values;       // [node][sample]
    std::vector<float> inverseNorm;  // [node][channel]: of the centred sequence; 0 where it hardly varies
    const float* node(std::size_t index, int samples) const {
      return values.data() + index * static_cast<std::size_t>(samples);
    }
  };
  int samples = 0;
  int channels = 1;
  std::vector<Level> levels;
};
SequencePyramid sequencePyramid(const PictureSequence& patterns, const ImportFrames& frames,
                                const DriveTable& drive);

/// One camera pixel's sequence as photographed, and which of its values count: saturated ones do not.
struct CameraSequence {
  std::vector<float> value;
  std::vector<float> weight;  // 0 or 1
};
void readSequence(const PictureSequence& photographs, const ImportFrames& frames, std::size_t pixel,
                  CameraSequence& sequence);

/// Camera pixels whose light changes with the patterns: by a tenth or more of what the 95th percentile
/// changes by.
CameraMask litPixels(const PictureSequence& photographs, const ImportFrames& frames);

/// Signals at or above this are taken to be cut off. Full scale is 1.
inline constexpr float importSaturation = 0.995f;

/// body(i) for all of `items` on all cores, in parts between which progress is reported.
template <typename Body>
void parallelInParts(const std::vector<std::uint32_t>& items, Progress& progress, const Body& body) {
  constexpr std::size_t parts = 64;
  for (std::size_t part = 0; part < parts; ++part) {
    parallelFor(items.size() * part / parts, items.size() * (part + 1) / parts, 64,
                [&](std::size_t i) { body(items[i]); });
    progress.report(static_cast<double>(part + 1) / parts);
  }
}

}  // namespace relucent::importing
