// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "relucent/importing/sequences.h"
#include "relucent/importing/spread.h"
#include "relucent/transport/block_sparse.h"

namespace relucent::importing {

/// What one camera pixel showed in all fitted frames, and what its footprint saw of the patterns there.
struct PixelFrames {
  Eigen::Matrix<float, Eigen::Dynamic, 3> drive;   // linear, under the footprint
  Eigen::Matrix<float, Eigen::Dynamic, 3> signal;  // photographed
  Eigen::Matrix<float, Eigen::Dynamic, 3> mean;    // linear, over the whole projector
  Eigen::VectorXf weight;                          // 0 where the photograph is cut off
};

/// Reads PixelFrames for the fitted frames.
class FrameReader {
 public:
  /// Keeps references: pictures and pyramid outlive it.
  FrameReader(const ImportPictures& pictures, const SequencePyramid& pyramid, const DriveTable& drive);

  PixelFrames read(std::size_t cameraPixel, const std::vector<NodeShare>& shares) const;
  /// For camera pixels whose light comes from everywhere: the patterns' means.
  PixelFrames readEverywhere(std::size_t cameraPixel) const;

 private:
  PixelFrames photographed(std::size_t cameraPixel) const;

  const PictureSequence& photographs_;
  const ImportFrames& frames_;
  const SequencePyramid& pyramid_;
  Eigen::Matrix<float, Eigen::Dynamic, 3> mean_;  // of every fitted pattern, linear
  std::vector<int> spatialPlace_;                 // of a fitted frame among the spatial ones; -1: even
};

/// signal = black + block * drive + far * mean.
struct PixelColour {
  Eigen::Vector3f black = Eigen::Vector3f::Zero();
  transport::ColourBlock block = transport::ColourBlock::Zero();
  transport::ColourBlock far =
      transport::ColourBlock::Zero();  // light that arrives from all over the projector
};

/// Least squares with black free and the block drawn towards diag(a) M, M the common mixing and a the pixel's
/// gains, where the patterns do not decide: with grey patterns alone the block is diag(a) M.
/// `withFar`: far is fitted too, drawn towards zero; else it is zero. Contract: weights are not all zero.
PixelColour fitColour(const PixelFrames& frames, const transport::ColourBlock& mixing, float noise,
                      bool withFar);

/// The same with diagonal blocks, for grey patterns: a black, a gain and a far light for each channel.
PixelColour fitGains(const PixelFrames& frames, float noise, bool withFar);

/// Whether at least three quarters of the variation of what was fitted is explained.
bool isExplained(const PixelFrames& seen, const PixelColour& colour);

/// The one 3x3 that, with a gain for each pixel and camera channel, explains a sample best; rows sum to 1.
/// What grey patterns leave open stays the identity.
transport::ColourBlock commonMixing(const std::vector<PixelFrames>& sample);

}  // namespace relucent::importing
