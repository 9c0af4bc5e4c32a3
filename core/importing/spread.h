// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "relucent/importing/decoding.h"
#include "relucent/importing/sequences.h"

namespace relucent::importing {

/// Which projector pixels light a camera pixel, as shares that sum to 1 (less what falls beside the
/// projector): a Gaussian, integrated over pixels, and a wide halo of evenly lit blocks.
struct Footprint {
  float x = 0.0f, y = 0.0f;            // centre, projector pixels; pixel (0, 0) is centred at (0.5, 0.5)
  float sigmaX = 0.0f, sigmaY = 0.0f;  // projector pixels; 0: none was found
  float halo = 0.0f;                   // share of the light that arrives by the halo
  bool found() const { return sigmaX > 0.0f; }
};

/// A footprint's share in one node of the projector's pyramid.
struct NodeShare {
  int level = 0;
  int x = 0;
  int y = 0;
  float share = 0.0f;
};

/// The footprint as nodes: pixels, or blocks of 2, 4, ... where it is wide, down to a hundredth of the
/// strongest and rescaled by what that drops; the halo as 3x3 nodes of haloLevel().
std::vector<NodeShare> sharesOf(const Footprint& footprint, Size projector);

/// The level whose nodes carry the halo: blocks of about 1/32 of the projector's larger side.
int haloLevel(Size projector);

/// What is known of footprints before one is fitted, and how noisy photographs are: medians over a sample.
struct FootprintPrior {
  float sigmaX = 1.0f, sigmaY = 1.0f;
  float noise = 0.01f;  // root mean square of what a fit leaves over
};

/// Fits one camera pixel's footprint from where it was decoded.
///   minimise  sum_s w_s (y_s - b - g q_s - h v_s)^2 / noise^2 + ((c - c_0) / 1)^2 + (ln(sigma / prior) /
///   0.5)^2
/// q: the patterns under the Gaussian, v: under the halo; b, g, h >= 0 are each channel's own and eliminated
/// (variable projection [GOL]); Levenberg-Marquardt over centre and widths.
class FootprintFitter {
 public:
  FootprintFitter(const SequencePyramid& pyramid, const PictureSequence& photographs,
                  const ImportFrames& frames, const FootprintPrior& prior);

  struct Fit {
    Footprint footprint;
    float residual = 0.0f;  // root mean square
  };
  Fit fit(std::size_t cameraPixel, const Decoded& start) const;

 private:
  const SequencePyramid& pyramid_;
  const PictureSequence& photographs_;
  const ImportFrames& frames_;
  FootprintPrior prior_;
};

}  // namespace relucent::importing
