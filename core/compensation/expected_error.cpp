// SPDX-License-Identifier: MIT
#include "relucent/compensation/expected_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/parallel.h"
#include "relucent/base/require.h"
#include "relucent/transport/statistics.h"

namespace relucent::compensation {
namespace {

// Fitted, see the README.
constexpr float ofBlack = 0.88f, ofFlood = 0.71f, ofLeaves = 0.13f, ofInside = 24.0f;

/// What a row's leaves look at, and how much of it their errors would let through.
struct Looks {
  Eigen::Array3f light = Eigen::Array3f::Zero();       // T p, per camera channel
  Eigen::Array3f brightest = Eigen::Array3f::Zero();   // T 1
  Eigen::Array3f unresolved = Eigen::Array3f::Zero();  // sum of t^2 s^2 / n
  float spread = 0.0f;                                 // sum of (v - a)^2, all projector channels
};

class Picture {
 public:
  Picture(const transport::TransportMatrix& transport, const ProjectorStack& picture)
      : transport_(transport), nodes_(transport.layout()), mean_(transport.layout().means(picture)) {
    ProjectorStack squares(picture.size());
    parallelFor(0, picture.size(), 4096, [&](std::size_t j) { squares[j] = picture[j] * picture[j]; });
    square_ = transport.layout().means(squares);
  }

  Looks lookedAtBy(std::size_t pixel) const {
    const transport::LeafRow row = transport_.row(pixel);
    std::vector<OfColours> sums(row.colourings());
    row.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
      const std::uint32_t node = row.column(entry);
      const Eigen::Array3f within =
          (Eigen::Map<const Eigen::Array3f>(&square_[3 * std::size_t{node}]) - mean(node).square()).max(0.0f);
      sums[k].light += factor * mean(node);
      sums[k].brightest += factor;
      sums[k].unresolved += factor.square() * within / nodes_.pixels[node];
    });
    Looks looks;
    Eigen::Array3f white = Eigen::Array3f::Zero(), seen = white;  // per projector channel
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const transport::ColourBlock colours = row.colours(k);
      const Eigen::Array3f ofChannel = colours.colwise().sum().transpose().array();
      white += ofChannel * sums[k].brightest;
      seen += ofChannel * sums[k].light;
      looks.light += (colours * sums[k].light.matrix()).array();
      looks.brightest += (colours * sums[k].brightest.matrix()).array();
      looks.unresolved += (colours.cwiseAbs2() * sums[k].unresolved.matrix()).array();
    }
    const Eigen::Array3f average = (white > 0.0f).select(seen / white, 0.0f);
    for (const std::uint32_t node : row.columns()) looks.spread += (mean(node) - average).square().sum();
    return looks;
  }

 private:
  /// Of leaves that have their colours in common, per projector channel.
  struct OfColours {
    Eigen::Array3f light = Eigen::Array3f::Zero();
    Eigen::Array3f brightest = Eigen::Array3f::Zero();
    Eigen::Array3f unresolved = Eigen::Array3f::Zero();
  };

  Eigen::Map<const Eigen::Array3f> mean(std::uint32_t node) const {
    return Eigen::Map<const Eigen::Array3f>(&mean_[3 * std::size_t{node}]);
  }

  const transport::TransportMatrix& transport_;
  transport::NodeTable nodes_;
  transport::NodeStack mean_, square_;
};

}  // namespace

CameraStack expectedDeviation(const transport::TransportMatrix& transport, const TransportVariance& variance,
                              const ProjectorStack& picture) {
  const std::size_t pixels = transport.cameras().count();
  require(variance.black.size() == 3 * pixels && variance.flood.size() == 3 * pixels &&
              variance.leaf.size() == 3 * pixels && picture.size() == 3 * transport.projectors().count(),
          "variances of {}, {} and {} values and a picture of {} for {} camera and {} projector pixels",
          variance.black.size(), variance.flood.size(), variance.leaf.size(), picture.size(), pixels,
          transport.projectors().count());
  const Picture seen(transport, picture);
  CameraStack deviation(3 * pixels, 0.0f);
  parallelFor(0, pixels, 256, [&](std::size_t i) {
    const Looks looks = seen.lookedAtBy(i);
    const auto at = [i](const CameraStack& of) { return Eigen::Map<const Eigen::Array3f>(&of[3 * i]); };
    const Eigen::Array3f share = (looks.brightest > 0.0f).select(looks.light / looks.brightest, 0.0f);
    const Eigen::Array3f sum = ofBlack * at(variance.black) + ofFlood * share.square() * at(variance.flood) +
                               ofLeaves * looks.spread * at(variance.leaf) + ofInside * looks.unresolved;
    Eigen::Map<Eigen::Array3f> here(&deviation[3 * i]);
    here = sum.max(0.0f).sqrt();
  });
  return deviation;
}

namespace {

double rootMeanSquare(std::span<const float> shares) {
  double squares = 0.0, pixels = 0.0;
  for (float share : shares) {
    if (std::isnan(share)) continue;
    squares += static_cast<double>(share) * static_cast<double>(share);
    pixels += 1.0;
  }
  return pixels > 0.0 ? std::sqrt(squares / pixels) : 0.0;
}

}  // namespace

double ExpectedError::shareIn(std::size_t camera, const Rasters& cameras) const {
  return rootMeanSquare(
      std::span(shareOfWhite).subspan(cameras.offset(camera), cameras.size(camera).count()));
}

double ExpectedError::shareOverall() const {
  return rootMeanSquare(shareOfWhite);
}

ExpectedError expectedError(const MeasuredVenue& venue, const TransportVariance& variance,
                            const Target& target, const ProjectorStack& picture) {
  if (variance.leaf.empty()) return {};
  ExpectedError error;
  error.radiance = expectedDeviation(venue.transport, variance, picture);
  error.shareOfWhite.assign(target.inside.size(), std::numeric_limits<float>::quiet_NaN());
  const Eigen::Array3f white = Eigen::Map<const Eigen::Array3f>(target.white.data());
  parallelFor(0, error.shareOfWhite.size(), 4096, [&](std::size_t i) {
    Eigen::Map<Eigen::Array3f> within(&error.radiance[3 * i]);
    within *= within95;
    const float gain = target.gain.empty() ? 1.0f : target.gain[i];
    if (target.inside[i] != 0) error.shareOfWhite[i] = std::sqrt((within / (gain * white)).square().mean());
  });
  return error;
}

}  // namespace relucent::compensation
