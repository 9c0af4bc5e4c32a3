// SPDX-License-Identifier: MIT
#include "relucent/acquisition/fitted_transport.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "relucent/acquisition/near_far_fit.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/leaf_sharing.h"
#include "relucent/transport/moved_rows.h"

namespace relucent::acquisition {
namespace {

using transport::ColourBlock;
using transport::TransportMatrix;

// A view that moved by less, pixels anywhere in it, is none that rows had better be interpolated for.
constexpr double leastMovement = 0.05;
// Pixels, all patterns together, that tell whether a view moved.
constexpr std::size_t comparedPixels = 4'000'000;
// A change of all light by less is seen by nobody, and where something was painted light that bounced off it
// is missing everywhere: all rows would be others for it.
constexpr double leastLightChange = 0.01;
// A row's own change: beyond so many standard deviations and this share.
constexpr double ownSigmas = 4.0;
constexpr float leastOwnChange = 0.01f;
// A row changes of its own where so many of the eight beside it do: of single rows that noise lifts beyond
// that, one in a hundred, hardly any has them.
constexpr int leastBeside = 2;
// How far what a surface leaves of one projector channel's light may be from what it leaves of all, relative.
constexpr float colourSpread = 0.2f;
// A row's light from one projector says what became of it where it is this share of the typical flood.
constexpr float enoughLight = 0.05f;

/// What each projector's channels give each camera pixel: [projector][row], the sums of T's blocks.
using Roots = std::vector<std::vector<ColourBlock>>;

float medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What the light of a projector has become, as a share of what it was: the median over rows that have
/// enough of it, value by value; 1 where nothing can be said or nothing has changed.
ColourBlock lightLeft(const std::vector<ColourBlock>& then, const std::vector<ColourBlock>& now,
                      const CameraMask& rows, float typical) {
  ColourBlock left = ColourBlock::Ones();
  parallelFor(0, static_cast<std::size_t>(left.size()), 1, [&](std::size_t value) {
    const auto camera = static_cast<Eigen::Index>(value / 3), channel = static_cast<Eigen::Index>(value % 3);
    std::vector<float> ratio;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const float before = then[row](camera, channel);
      if (rows[row] && then[row].sum() > enoughLight * typical && before > 0.0f)
        ratio.push_back(now[row](camera, channel) / before);
    }
    if (ratio.empty()) return;
    const float median = std::max(0.0f, medianOf(ratio));
    if (std::abs(static_cast<double>(median) - 1.0) > leastLightChange) left(camera, channel) = median;
  });
  return left;
}

/// What is left of a projector channel's light in one camera channel, of a surface with other colours: of all
/// channels' together, and of each by itself as far as noise lets it be known.
Eigen::RowVector3f leftOfChannels(const Eigen::RowVector3f& now, const Eigen::RowVector3f& variance,
                                  const Eigen::RowVector3f& expected) {
  const float all = std::max(0.0f, now.sum() / expected.sum());
  Eigen::RowVector3f left;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const float known = colourSpread * all * expected[k], squared = known * known;
    const float ratio = expected[k] > 0.0f ? std::max(0.0f, now[k] / expected[k]) : all;
    left[k] = squared > 0.0f ? all + (ratio - all) * squared / (squared + variance[k]) : all;
  }
  return left;
}

image::Image brightnessOf(const Stack& light, const Rasters& cameras, std::size_t camera) {
  image::Image picture(cameras.size(camera), 1);
  const std::size_t offset = cameras.offset(camera);
  parallelFor(0, picture.data().size(), 16384, [&](std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c) picture.data()[i] += light[3 * (offset + i) + c];
  });
  return picture;
}

bool isMovement(const sentinels::Movement& movement, Size size) {
  const double turned = std::abs(movement.degrees) * std::numbers::pi / 180.0 * 0.5 *
                        static_cast<double>(std::max(size.width, size.height));
  return movement.explains && std::hypot(movement.x, movement.y) + turned > leastMovement;
}

bool areAlike(const sentinels::Movement& a, const sentinels::Movement& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < 0.5 * std::hypot(b.x, b.y);
}

/// Where what pixels see now was in the picture before it moved.
transport::FormerPlace formerPlaces(const std::vector<sentinels::Movement>& moved, const Rasters& cameras) {
  return [&moved, &cameras](std::size_t camera, const Pixel& place) -> Eigen::Vector2d {
    const sentinels::Movement& movement = moved[camera];
    const Size size = cameras.size(camera);
    const Eigen::Vector2d centre(0.5 * (size.width - 1), 0.5 * (size.height - 1));
    const Eigen::Rotation2D<double> turned(movement.degrees * std::numbers::pi / 180.0);
    return turned.inverse() *
               (Eigen::Vector2d(place.x, place.y) - centre - Eigen::Vector2d(movement.x, movement.y)) +
           centre;
  };
}

/// Flags that hang together: what is seen of a surface is wider than a pixel, what noise changes is not.
CameraMask together(const CameraMask& flags, const Rasters& cameras) {
  CameraMask kept(flags.size(), 0);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t offset = cameras.offset(camera);
    parallelFor(0, size.count(), 4096, [&](std::size_t i) {
      if (!flags[offset + i]) return;
      const Pixel at = pixelAt(size, i);
      int beside = -1;  // it counts itself
      for (int y = std::max(0, at.y - 1); y <= std::min(size.height - 1, at.y + 1); ++y)
        for (int x = std::max(0, at.x - 1); x <= std::min(size.width - 1, at.x + 1); ++x)
          beside += flags[offset + indexOf(size, {x, y})] ? 1 : 0;
      kept[offset + i] = beside >= leastBeside ? 1 : 0;
    });
  }
  return kept;
}

class Fitting {
 public:
  Fitting(const transport::Acquisition& former, const photography::References& references,
          const TestPhotographs& tests, VenueChange& change)
      : former_(former), references_(references), tests_(tests), change_(change) {
    fitted_.unknown.assign(references.usable.size(), 0);
    fitted_.ofItsOwn.assign(references.usable.size(), 0);
  }

  FittedTransport fitted(Progress& progress) {
    const std::optional<TransportMatrix> elsewhere = moved(progress);
    fitted_.transport = nearAndFar(scaled(elsewhere ? *elsewhere : former_.transport));
    return std::move(fitted_);
  }

 private:
  /// What was looked at moves in the floods and in the patterns; a picture that was moved in the patterns
  /// alone. On an even surface both look alike, and are.
  std::optional<TransportMatrix> moved(Progress& progress) {
    const Rasters& cameras = references_.cameras;
    // Of many pixels few patterns tell enough; the first have blocks of all sizes.
    const std::size_t patterns = std::min(
        tests_.patterns().size(), std::max<std::size_t>(verificationSizes, comparedPixels / cameras.count()));
    std::vector<CameraStack> predicted;
    for (std::size_t number = 0; number < patterns; ++number)
      predicted.push_back(former_.transport.apply(tests_.patterns()[number]));
    const Floods floods = floodsOf(references_);
    change_.moved.resize(cameras.devices());
    change_.pictures.resize(cameras.devices());
    bool any = false;
    for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
      std::vector<sentinels::ViewPair> views{
          {brightnessOf(former_.flood, cameras, camera), brightnessOf(floods.light, cameras, camera)}};
      for (std::size_t i = 0; i < predicted.size(); ++i)
        views.push_back({brightnessOf(predicted[i], cameras, camera),
                         brightnessOf(tests_.light()[i]->radiance, cameras, camera)});
      const sentinels::Movement ofAll = sentinels::movementBetween(views);
      progress.checkpoint();
      if (!isMovement(ofAll, cameras.size(camera))) continue;
      views.resize(1);
      const sentinels::Movement ofSurface = sentinels::movementBetween(views);
      const bool isCamera = isMovement(ofSurface, cameras.size(camera)) && areAlike(ofSurface, ofAll);
      (isCamera ? change_.moved : change_.pictures)[camera] = ofAll;
      any = true;
    }
    if (!any) return std::nullopt;
    std::vector<sentinels::Movement> views = change_.moved;
    for (std::size_t camera = 0; camera < views.size(); ++camera)
      if (!views[camera].explains) views[camera] = change_.pictures[camera];
    transport::MovedRows rows = transport::movedRows(former_.transport, formerPlaces(views, cameras));
    fitted_.unknown = std::move(rows.unknown);
    return transport::withSharedLeaves(rows.transport, transport::sharingTolerance, progress);
  }

  TransportMatrix scaled(const TransportMatrix& transport) {
    const Roots then = transport.rowSumsOfProjectors();
    for (std::size_t projector = 0; projector < then.size(); ++projector)
      change_.light.push_back(
          lightLeft(then[projector], references_.root[projector], references_.usable, references_.typical));
    Roots factor(then.size(), std::vector<ColourBlock>(references_.usable.size(), ColourBlock::Ones()));
    CameraMask& own = fitted_.ofItsOwn;
    for (std::size_t projector = 0; projector < then.size(); ++projector)
      parallelFor(0, own.size(), 1024, [&](std::size_t row) {
        const ColourBlock expected = change_.light[projector].cwiseProduct(then[projector][row]);
        const Eigen::Array3f before = expected.rowwise().sum(),
                             now = references_.root[projector][row].rowwise().sum(),
                             variance = references_.rootVariance[projector][row].rowwise().sum();
        ColourBlock left = ColourBlock::Ones();
        for (Eigen::Index c = 0; c < 3; ++c) {
          const float apart = std::abs(now[c] - before[c]);
          if (!references_.usable[row] || !(before[c] > enoughLight * references_.typical) ||
              apart < leastOwnChange * before[c] ||
              static_cast<double>(apart) < ownSigmas * std::sqrt(static_cast<double>(variance[c])))
            continue;
          left.row(c) = leftOfChannels(references_.root[projector][row].row(c),
                                       references_.rootVariance[projector][row].row(c), expected.row(c));
          own[row] = 1;
        }
        factor[projector][row] = left.cwiseProduct(change_.light[projector]);
      });
    own = together(own, references_.cameras);
    change_.scaled = flaggedShareOf(own, references_.usable);
    if (!change_.isOfLight()) return transport;
    return transport.withLightScaled([&](std::size_t row, std::size_t projector) -> ColourBlock {
      return own[row] ? factor[projector][row] : change_.light[projector];
    });
  }

  /// Where a surface has become another: what it scatters and what it mirrors changed by different shares.
  TransportMatrix nearAndFar(TransportMatrix transport) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (std::ranges::count(fitted_.ofItsOwn, 1) == 0) return transport;
    const Rasters& projectors = references_.projectors;
    std::vector<ProjectorStack> white(projectors.devices(), ProjectorStack(3 * projectors.count(), 0.0f));
    std::vector<SeenPattern> seen;
    for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
      std::fill_n(white[projector].begin() + static_cast<std::ptrdiff_t>(3 * projectors.offset(projector)),
                  3 * projectors.size(projector).count(), 1.0f);
      seen.push_back(
          {white[projector], [&references = references_, projector](std::size_t value) -> SeenPattern::Light {
             const auto channel = static_cast<Eigen::Index>(value % 3);
             return {references.root[projector][value / 3].row(channel).sum(),
                     references.rootVariance[projector][value / 3].row(channel).sum()};
           }});
    }
    for (std::size_t number = 0; number < tests_.patterns().size(); ++number)
      seen.push_back({tests_.patterns()[number],
                      [&light = *tests_.light()[number]](std::size_t value) -> SeenPattern::Light {
                        return {light.radiance[value], light.valid[value] ? light.variance[value] : infinity};
                      }});
    return nearAndFarFitted(std::move(transport), fitted_.ofItsOwn, seen);
  }

  const transport::Acquisition& former_;
  const photography::References& references_;
  const TestPhotographs& tests_;
  VenueChange& change_;
  FittedTransport fitted_;
};

}  // namespace

FittedTransport fittedTransport(const transport::Acquisition& former,
                                const photography::References& references, const TestPhotographs& tests,
                                VenueChange& change, Progress& progress) {
  return Fitting(former, references, tests, change).fitted(progress);
}

}  // namespace relucent::acquisition
