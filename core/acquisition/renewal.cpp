// SPDX-License-Identifier: MIT
#include "relucent/acquisition/renewal.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "relucent/acquisition/mixed_rows.h"
#include "relucent/acquisition/multiplexed.h"
#include "relucent/acquisition/near_far_fit.h"
#include "relucent/acquisition/repair.h"
#include "relucent/acquisition/test_photographs.h"
#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/sentinels/black_following.h"
#include "relucent/transport/leaf_sharing.h"
#include "relucent/transport/moved_rows.h"

namespace relucent::acquisition {
namespace {

using transport::ColourBlock;
using transport::TransportMatrix;

// Shares of the time.
constexpr double referenceShare = 0.2, lookShare = 0.15, adaptShare = 0.1, measureShare = 0.45;

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
// Squares of a row's differences, beyond so many times what noise makes of them: 24 values or more, whose
// squares are off by a third of their mean at one standard deviation.
constexpr double beyondNoise = 2.5;
// A row's light from one projector says what became of it where it is this share of the typical flood.
constexpr float enoughLight = 0.05f;
// Rows around wrong ones are measured with them, pixels: an edge that moved is wrong by halves beside it.
constexpr int around = 1;

double shareOf(const CameraMask& flags, const CameraMask& among) {
  std::size_t set = 0, all = 0;
  for (std::size_t row = 0; row < flags.size(); ++row) {
    if (!among[row]) continue;
    ++all;
    set += flags[row] ? 1 : 0;
  }
  return all > 0 ? static_cast<double>(set) / static_cast<double>(all) : 0.0;
}

/// What each projector's channels give each camera pixel: [projector][row], the sums of T's blocks.
using Roots = std::vector<std::vector<ColourBlock>>;

Roots rootsOf(const TransportMatrix& transport) {
  const Rasters& projectors = transport.projectors();
  const std::size_t rows = transport.cameras().count();
  Roots roots(projectors.devices(), std::vector<ColourBlock>(rows, ColourBlock::Zero()));
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      ProjectorStack pattern(3 * projectors.count(), 0.0f);
      for (std::size_t pixel = 0; pixel < projectors.size(projector).count(); ++pixel)
        pattern[3 * (projectors.offset(projector) + pixel) + channel] = 1.0f;
      const CameraStack light = transport.apply(pattern);
      parallelFor(0, rows, 4096, [&](std::size_t row) {
        roots[projector][row].col(static_cast<Eigen::Index>(channel)) =
            Eigen::Map<const Eigen::Vector3f>(&light[3 * row]);
      });
    }
  return roots;
}

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

/// The same flags, and those of pixels around.
CameraMask widened(const CameraMask& flags, const Rasters& cameras) {
  CameraMask wide = flags;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const Size size = cameras.size(camera);
    const std::size_t offset = cameras.offset(camera);
    for (std::size_t i = 0; i < size.count(); ++i) {
      if (!flags[offset + i]) continue;
      const Pixel at = pixelAt(size, i);
      for (int y = std::max(0, at.y - around); y <= std::min(size.height - 1, at.y + around); ++y)
        for (int x = std::max(0, at.x - around); x <= std::min(size.width - 1, at.x + around); ++x)
          wide[offset + indexOf(size, {x, y})] = 1;
    }
  }
  return wide;
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

double sumOf(const Stack& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class Renewing {
 public:
  Renewing(const AcquisitionRun& run, const transport::Acquisition& former, const RenewalSettings& settings,
           sentinels::Supervision& supervision)
      : run_(run),
        former_(former),
        settings_(settings),
        supervision_(supervision),
        shotsBefore_(run.shots.shots()),
        exposuresBefore_(run.shots.exposures()),
        photographer_(run.shots, run.linearization) {}

  sentinels::Interruptible<Renewal> renew(Progress& progress) {
    Progress referencePart =
        progress.part(referenceShare, RELUCENT_MESSAGE("stage.black-and-full-light", "black and full light"));
    const photography::References references = photography::measureReferences(
        photographer_, referenceRounds(run_.settings, run_.shots.rig().projectors.size()),
        run_.settings.dimShare, referencePart);
    requireLight(references);
    const Scheme scheme = schemeOf(run_.settings, references);
    sentinels::Watch watch(photographer_, references,
                           {run_.settings.checkInterval, run_.settings.mayBeMirrored}, supervision_);
    if (auto interrupted = watch.begin(referencePart)) return *interrupted;
    const TreeContext context{watch, scheme, supervision_.observer};

    Progress looking = progress.part(lookShare, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
    TestPhotographs tests(context, patternSettings(), 0);
    const CameraMask counted = countedRows(references);
    auto before = tests.compared(former_.transport, counted, looking);
    if (!before) return before.interruption();

    Renewal renewal;
    renewal.errorBefore = errorOf(before->rows);
    renewal.change.wrong = shareOf(wrongRows(*before), counted);
    Progress adapting = progress.part(
        adaptShare,
        RELUCENT_MESSAGE("stage.adapting-light-transport", "fitting the light transport to what is seen"));
    unknown_.assign(counted.size(), 0);
    TransportMatrix adapted = moved(renewal.change, references, tests, adapting);
    adapted = nearAndFarFitted(scaled(renewal.change, adapted, references), references, tests);
    auto fitted = comparedAgain(*before, renewal.change, adapted, counted, tests, adapting);
    if (!fitted) return fitted.interruption();
    const bool isBetter = renewal.errorBefore > 0.0 && errorOf(fitted->rows) < renewal.errorBefore;
    if (!isBetter && !isLightOther(renewal.change)) {
      // Nothing that was thought of explains what is seen better than the former T does.
      adapted = former_.transport;
      fitted = std::move(before);
      renewal.change.moved.assign(renewal.change.moved.size(), {});
      renewal.change.pictures = renewal.change.moved;
      unknown_.assign(counted.size(), 0);
    }
    renewal.errorAdapted = errorOf(fitted->rows);
    renewal.change.unknown = shareOf(unknown_, references.usable);

    VerifiedTransport verified{std::move(adapted), former_.leafVariance,  former_.flagged,
                               fitted->residual,   errorOf(fitted->rows), 0};
    Progress measuring = progress.part(
        measureShare,
        RELUCENT_MESSAGE("stage.measuring-what-changed", "measuring what is no longer as it was"));
    const CameraMask wrong = toMeasure(*fitted, references, counted);
    if (auto interrupted =
            measureAgain(renewal, verified, *std::move(fitted), wrong, context, references, measuring))
      return *interrupted;
    if (auto interrupted = watch.check(progress)) return *interrupted;
    renewal.change.ambient =
        sumOf(former_.flood) > 0.0
            ? (sumOf(watch.black().radiance) - sumOf(former_.black)) / sumOf(former_.flood)
            : 0.0;
    renewal.acquisition = finished(std::move(verified), watch);
    progress.report(1.0);
    return renewal;
  }

 private:
  const AcquisitionSettings& patternSettings() {
    patterns_ = run_.settings;
    patterns_.verificationPatterns = std::max(verificationSizes, patterns_.verificationPatterns);
    return patterns_;
  }

  void requireLight(const photography::References& references) const {
    const double then = sumOf(former_.flood), now = sumOf(floodsOf(references).light);
    if (now > settings_.leastLight * then) return;
    throw Error(
        ErrorKind::device,
        RELUCENT_ENGLISH_MESSAGE("renewal.no-light", "the camera sees almost none of the projectors' light"),
        RELUCENT_ENGLISH_MESSAGE("renewal.look-for-light",
                                 "look whether the lens is covered or the projector off, then try again"));
  }

  CameraMask countedRows(const photography::References& references) const {
    CameraMask counted = references.usable;
    for (std::size_t row = 0; row < counted.size(); ++row)
      if (former_.flagged[row]) counted[row] = 0;
    return counted;
  }

  /// The relative error of a row when it was measured: its test patterns show it about half of its light.
  double errorThen(std::size_t row) const {
    double squared = 0.0, light = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto flood = static_cast<double>(former_.flood[3 * row + c]);
      light += 0.25 * flood * flood;
      for (const CameraStack& map : former_.residual)
        squared += std::pow(static_cast<double>(map[3 * row + c]), 2.0) /
                   static_cast<double>(former_.residual.size());
    }
    return light > 0.0 ? std::sqrt(squared / light) : 0.0;
  }

  CameraMask wrongRows(const Verification& verification) const {
    CameraMask wrong(verification.rows.size(), 0);
    for (std::size_t row = 0; row < wrong.size(); ++row) {
      const Residual& found = verification.rows[row];
      const double limit = std::max(settings_.wrongFrom, settings_.timesBefore * errorThen(row));
      wrong[row] = found.squared > beyondNoise * found.noise && found.squared > limit * limit * found.light;
    }
    return wrong;
  }

  /// The share of all rows' squared errors that wrong ones have, beyond noise and what they had when they
  /// were measured: at most that is to be gained by measuring them.
  double errorOfWrong(const Verification& verification, const CameraMask& wrong) const {
    double gained = 0.0, all = 0.0;
    for (std::size_t row = 0; row < wrong.size(); ++row) {
      const Residual& found = verification.rows[row];
      all += found.squared;
      if (wrong[row])
        gained += std::max(0.0, found.squared - found.noise - std::pow(errorThen(row), 2.0) * found.light);
    }
    return all > 0.0 ? gained / all : 0.0;
  }

  static bool isLightOther(const VenueChange& change) {
    return change.scaled > 0.0 || std::ranges::any_of(change.light, [](const ColourBlock& light) {
             return light != ColourBlock::Ones();
           });
  }

  /// What was looked at moves in the floods and in the patterns; a picture that was moved in the patterns
  /// alone. On an even surface both look alike, and are.
  TransportMatrix moved(VenueChange& change, const photography::References& references,
                        const TestPhotographs& tests, Progress& progress) {
    const Rasters& cameras = references.cameras;
    // Of many pixels few patterns tell enough; the first have blocks of all sizes.
    const std::size_t patterns = std::min(
        tests.patterns().size(), std::max<std::size_t>(verificationSizes, comparedPixels / cameras.count()));
    std::vector<CameraStack> predicted;
    for (std::size_t number = 0; number < patterns; ++number)
      predicted.push_back(former_.transport.apply(tests.patterns()[number]));
    const Floods floods = floodsOf(references);
    change.moved.resize(cameras.devices());
    change.pictures.resize(cameras.devices());
    bool any = false;
    for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
      std::vector<sentinels::ViewPair> views{
          {brightnessOf(former_.flood, cameras, camera), brightnessOf(floods.light, cameras, camera)}};
      for (std::size_t i = 0; i < predicted.size(); ++i)
        views.push_back({brightnessOf(predicted[i], cameras, camera),
                         brightnessOf(tests.light()[i]->radiance, cameras, camera)});
      const sentinels::Movement ofAll = sentinels::movementBetween(views);
      progress.checkpoint();
      if (!isMovement(ofAll, cameras.size(camera))) continue;
      views.resize(1);
      const sentinels::Movement ofSurface = sentinels::movementBetween(views);
      const bool isCamera = isMovement(ofSurface, cameras.size(camera)) && areAlike(ofSurface, ofAll);
      (isCamera ? change.moved : change.pictures)[camera] = ofAll;
      any = true;
    }
    if (!any) return former_.transport;
    std::vector<sentinels::Movement> views = change.moved;
    for (std::size_t camera = 0; camera < views.size(); ++camera)
      if (!views[camera].explains) views[camera] = change.pictures[camera];
    transport::MovedRows rows = transport::movedRows(former_.transport, formerPlaces(views, cameras));
    unknown_ = std::move(rows.unknown);
    return transport::withSharedLeaves(rows.transport, transport::sharingTolerance, progress);
  }

  TransportMatrix scaled(VenueChange& change, const TransportMatrix& transport,
                         const photography::References& references) {
    const Roots then = rootsOf(transport);
    for (std::size_t projector = 0; projector < then.size(); ++projector)
      change.light.push_back(
          lightLeft(then[projector], references.root[projector], references.usable, references.typical));
    Roots factor(then.size(), std::vector<ColourBlock>(references.usable.size(), ColourBlock::Ones()));
    CameraMask& own = ofItsOwn_;
    own.assign(references.usable.size(), 0);
    for (std::size_t projector = 0; projector < then.size(); ++projector)
      parallelFor(0, own.size(), 1024, [&](std::size_t row) {
        const ColourBlock expected = change.light[projector].cwiseProduct(then[projector][row]);
        const Eigen::Array3f before = expected.rowwise().sum(),
                             now = references.root[projector][row].rowwise().sum(),
                             variance = references.rootVariance[projector][row].rowwise().sum();
        ColourBlock left = ColourBlock::Ones();
        for (Eigen::Index c = 0; c < 3; ++c) {
          const float apart = std::abs(now[c] - before[c]);
          if (!references.usable[row] || !(before[c] > enoughLight * references.typical) ||
              apart < leastOwnChange * before[c] ||
              static_cast<double>(apart) < ownSigmas * std::sqrt(static_cast<double>(variance[c])))
            continue;
          left.row(c) = leftOfChannels(references.root[projector][row].row(c),
                                       references.rootVariance[projector][row].row(c), expected.row(c));
          own[row] = 1;
        }
        factor[projector][row] = left.cwiseProduct(change.light[projector]);
      });
    own = together(own, references.cameras);
    change.scaled = shareOf(own, references.usable);
    if (!isLightOther(change)) return transport;
    return transport.withLightScaled([&](std::size_t row, std::size_t projector) -> ColourBlock {
      return own[row] ? factor[projector][row] : change.light[projector];
    });
  }

  /// Where a surface has become another: what it scatters and what it mirrors changed by different shares.
  TransportMatrix nearAndFarFitted(TransportMatrix transport, const photography::References& references,
                                   const TestPhotographs& tests) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (std::ranges::count(ofItsOwn_, 1) == 0) return transport;
    const Rasters& projectors = references.projectors;
    std::vector<ProjectorStack> white(projectors.devices(), ProjectorStack(3 * projectors.count(), 0.0f));
    std::vector<SeenPattern> seen;
    for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
      std::fill_n(white[projector].begin() + static_cast<std::ptrdiff_t>(3 * projectors.offset(projector)),
                  3 * projectors.size(projector).count(), 1.0f);
      seen.push_back({white[projector], [&references, projector](std::size_t value) -> SeenPattern::Light {
                        const auto channel = static_cast<Eigen::Index>(value % 3);
                        return {references.root[projector][value / 3].row(channel).sum(),
                                references.rootVariance[projector][value / 3].row(channel).sum()};
                      }});
    }
    for (std::size_t number = 0; number < tests.patterns().size(); ++number)
      seen.push_back({tests.patterns()[number],
                      [&light = *tests.light()[number]](std::size_t value) -> SeenPattern::Light {
                        return {light.radiance[value], light.valid[value] ? light.variance[value] : infinity};
                      }});
    return acquisition::nearAndFarFitted(std::move(transport), ofItsOwn_, seen);
  }

  /// What test patterns say of the adapted T. Where neither a view nor a lamp has changed, they say of most
  /// rows what they said `before`.
  sentinels::Interruptible<Verification> comparedAgain(const Verification& before, const VenueChange& change,
                                                       const TransportMatrix& adapted,
                                                       const CameraMask& counted, TestPhotographs& tests,
                                                       Progress& progress) const {
    const auto isMoved = [](const sentinels::Movement& movement) { return movement.explains; };
    const bool isOfSurfaces =
        std::ranges::none_of(change.moved, isMoved) && std::ranges::none_of(change.pictures, isMoved) &&
        std::ranges::all_of(change.light,
                            [](const ColourBlock& left) { return left == ColourBlock::Ones(); });
    if (!isOfSurfaces) return tests.compared(adapted, counted, progress);
    CameraMask rows = counted;
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (!ofItsOwn_[row]) rows[row] = 0;
    auto found = tests.compared(adapted, rows, progress);
    if (!found) return found.interruption();
    Verification all = before;
    for (std::size_t size = 0; size < all.residual.size(); ++size)
      replaceRows(all.residual[size], found->residual[size], rows);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (!rows[row]) continue;
      all.rows[row] = found->rows[row];
      all.flagged[row] = found->flagged[row];
    }
    return all;
  }

  /// Which rows are to be measured; none: it is not worth while.
  CameraMask toMeasure(const Verification& fitted, const photography::References& references,
                       const CameraMask& counted) const {
    CameraMask wrong = wrongRows(fitted);
    for (std::size_t row = 0; row < wrong.size(); ++row)
      if (unknown_[row] && references.usable[row]) wrong[row] = 1;
    const double share = shareOf(wrong, references.usable);
    if (share < settings_.measuredFrom || (shareOf(unknown_, references.usable) < settings_.measuredFrom &&
                                           errorOfWrong(fitted, wrong) < settings_.worthMeasuring))
      return CameraMask(wrong.size(), 0);
    if (share > settings_.allFrom) return references.usable;
    wrong = widened(wrong, references.cameras);
    for (std::size_t row = 0; row < wrong.size(); ++row)
      // What was flagged may have become well since.
      wrong[row] = references.usable[row] && (wrong[row] || !counted[row]) ? 1 : 0;
    return wrong;
  }

  /// `found`: what test patterns say of `verified`. Only the rows that are measured again see others.
  std::optional<sentinels::Interruption> measureAgain(Renewal& renewal, VerifiedTransport& verified,
                                                      Verification found, const CameraMask& rows,
                                                      const TreeContext& context,
                                                      const photography::References& all,
                                                      Progress& progress) {
    renewal.errorAfter = renewal.errorAdapted;
    if (std::ranges::count(rows, 1) == 0) return std::nullopt;
    photography::References references = all;
    references.usable = rows;
    MeasuredTransport measured;
    Progress part = progress.part(0.8, RELUCENT_MESSAGE("stage.light-transport", "light transport"));
    if (auto interrupted =
            measureMultiplexed(measured, context, references, photographer_, run_.settings, false, part))
      return interrupted;
    Progress testing = progress.part(0.2, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
    TestPhotographs tests(context, patterns_, patterns_.verificationPatterns);
    auto before = tests.compared(verified.transport, rows, testing);
    if (!before) return before.interruption();
    auto after = tests.compared(measured.transport, rows, testing);
    if (!after) return after.interruption();

    CameraMask better(rows.size(), 0);
    for (std::size_t row = 0; row < rows.size(); ++row)
      better[row] = rows[row] && !measured.unknown[row] &&
                            (unknown_[row] || after->rows[row].relative() < before->rows[row].relative())
                        ? 1
                        : 0;
    renewal.measured = shareOf(better, all.usable);
    const bool isAll = better == all.usable;
    verified.transport =
        isAll ? std::move(measured.transport) : mixedRows(verified.transport, measured.transport, better);
    if (isAll || verified.transport.groups().empty())
      verified.transport =
          transport::withSharedLeaves(verified.transport, transport::sharingTolerance, testing);
    replaceRows(verified.leafVariance, measured.leafVariance, better);
    measuredRows_ = better;
    measuredFloods_ = std::move(measured.floods);
    for (std::size_t size = 0; size < verified.residual.size(); ++size)
      replaceRows(verified.residual[size], after->residual[size], better);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (!rows[row]) continue;
      const Verification& now = better[row] ? *after : *before;
      found.rows[row] = now.rows[row];
      verified.flagged[row] = now.flagged[row];
    }
    verified.remeasured = static_cast<int>(std::ranges::count(better, 1));
    verified.error = renewal.errorAfter = errorOf(found.rows);
    return std::nullopt;
  }

  /// e as it is now; where it is what it was, the former measurement tells of it too.
  hdr::BlackLevel blackOf(const sentinels::Watch& watch) const {
    hdr::BlackLevel former(hdr::HdrFrame{former_.black, former_.blackVariance,
                                         std::vector<std::uint8_t>(former_.black.size(), 1)});
    hdr::BlackLevel now = watch.black();
    if (!sentinels::hasChanged(now, former)) sentinels::join(now, former);
    return now;
  }

  /// Of the rows that were measured as dense patterns tell; of others what they were, times what became of
  /// their T, of which more is known than their floods say: what has not changed stays the same to the bit.
  Floods floodsNow(const VerifiedTransport& verified, const photography::References& references) const {
    Floods floods = floodsOf(references);
    const CameraStack now = verified.transport.floodlight(), then = former_.transport.floodlight();
    for (std::size_t row = 0; row < verified.flagged.size(); ++row) {
      if (!references.usable[row]) continue;
      const bool isMeasured = !measuredRows_.empty() && measuredRows_[row];
      for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) {
        const float known = then[i] > 0.0f ? former_.flood[i] * (now[i] / then[i]) : now[i];
        floods.light[i] = isMeasured ? measuredFloods_.light[i] : known;
        floods.variance[i] =
            isMeasured ? measuredFloods_.variance[i] : std::min(floods.variance[i], former_.floodVariance[i]);
      }
    }
    return floods;
  }

  transport::Acquisition finished(VerifiedTransport verified, const sentinels::Watch& watch) const {
    const photography::References& references = watch.references();
    Floods floods = floodsNow(verified, references);
    hdr::BlackLevel black = blackOf(watch);
    for (std::size_t row = 0; row < verified.flagged.size(); ++row)
      if (!references.usable[row]) verified.flagged[row] = 1;
    return {.transport = std::move(verified.transport),
            .black = std::move(black.radiance),
            .blackVariance = std::move(black.variance),
            .flood = std::move(floods.light),
            .floodVariance = std::move(floods.variance),
            .flagged = std::move(verified.flagged),
            .residual = std::move(verified.residual),
            .leafVariance = std::move(verified.leafVariance),
            .remeasured = verified.remeasured,
            .unresolvedEnergy = former_.unresolvedEnergy,
            .verificationError = verified.error,
            .patterns = run_.shots.shots() - shotsBefore_,
            .exposures = run_.shots.exposures() - exposuresBefore_,
            .stoppedAt = former_.stoppedAt,
            .expected = former_.expected,
            .findings = former_.findings,  // of how that was measured which stays
            .overexposed = former_.overexposed};
  }

  const AcquisitionRun& run_;
  const transport::Acquisition& former_;
  const RenewalSettings& settings_;
  sentinels::Supervision& supervision_;
  int shotsBefore_, exposuresBefore_;
  photography::Photographer photographer_;
  AcquisitionSettings patterns_;
  CameraMask unknown_;
  CameraMask ofItsOwn_;      // rows whose light has become another than that of all
  CameraMask measuredRows_;  // empty: none
  Floods measuredFloods_;
};

}  // namespace

Renewal renew(const AcquisitionRun& run, const transport::Acquisition& former,
              const RenewalSettings& settings, Progress& progress) {
  sentinels::AcquisitionObserver nobody;
  sentinels::Supervision supervision{run.handler, run.observer ? *run.observer : nobody};
  const int shotsBefore = run.shots.shots();
  while (true) {
    sentinels::Interruptible<Renewal> renewed = Renewing(run, former, settings, supervision).renew(progress);
    if (renewed) return *std::move(renewed);
    run.shots.goBackTo(shotsBefore);
  }
}

}  // namespace relucent::acquisition
