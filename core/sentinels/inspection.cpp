// SPDX-License-Identifier: MIT
#include "relucent/sentinels/inspection.h"

#include <fmt/format.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "relucent/base/message.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/sentinels/movement.h"

namespace relucent::sentinels {
namespace {

constexpr std::uint64_t referenceKey = 0x7265666572ULL;

// Beyond what drift does between two checks; more of them in observer.h.
constexpr std::size_t mostCompared = 60000;  // camera pixels whose sum tells whether a pattern is dark
constexpr double nothingShare = 0.05;  // a camera that sees a corner may see one colour of the picture alone
constexpr double localLimit = 0.25;    // of a pixel's own and the typical light: something is in the way
constexpr double localShare = 0.003;   // of the camera pixels
constexpr double sigmas = 6.0;
constexpr double clearly = 4.0;        // squared difference in units of the noise's
constexpr double movementLimit = 0.5;  // pixels: what alarms say that a camera may be off by

struct Sum {
  double value = 0.0, variance = 0.0;
  bool isSignificant() const { return std::abs(value) > sigmas * std::sqrt(variance); }
};

Sum sumOf(const Stack& values, const CameraStack& variance, const photography::References& references) {
  Sum sum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!references.usable[i / 3]) continue;
    sum.value += static_cast<double>(values[i]);
    sum.variance += static_cast<double>(variance[i]);
  }
  return sum;
}

Alarm alarm(AlarmKind kind, Message what, Message advice) {
  return {kind, std::move(what),
          RELUCENT_MESSAGE("alarm.safe-before-check", "every photograph up to the previous check is safe"),
          std::move(advice)};
}

constexpr auto putItBack =
    RELUCENT_MESSAGE("alarm.put-it-back", "put it back to within half a pixel, then try again");
constexpr auto uncoverLens = RELUCENT_MESSAGE(
    "alarm.uncover-lens", "uncover the lens, check that the projector is on, then try again");

Alarm mayStay(Alarm alarm) {
  alarm.mayStay = true;
  return alarm;
}

Alarm gone(Alarm alarm) {
  alarm.isGone = true;
  return mayStay(std::move(alarm));
}

std::optional<Alarm> inspectDarkness(const Check& now, const Baseline& baseline, double power) {
  if (power > darkShare) return std::nullopt;
  CameraStack seen = now.light.radiance;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += now.black.radiance[i];
  Sum black = sumOf(baseline.black.radiance, baseline.black.variance, baseline.references);
  Sum all = sumOf(seen, now.light.variance, baseline.references);
  if (black.isSignificant() && all.value > 0.5 * black.value)
    return alarm(
        AlarmKind::projectorAsleep,
        RELUCENT_MESSAGE("alarm.projector-shows-nothing",
                         "the projector shows nothing, though the room's own light is still seen"),
        RELUCENT_MESSAGE("alarm.wake-projector",
                         "wake the projector, switch off its and the screen's power saving, then try again"));
  return alarm(AlarmKind::coveredLens,
               RELUCENT_MESSAGE("alarm.camera-sees-nothing", "the camera sees nothing at all"), uncoverLens);
}

/// In units of the typical flood.
double roomLight(const hdr::BlackLevel& black, const photography::References& references) {
  double light = sumOf(black.radiance, black.variance, references).value;
  double whole = static_cast<double>(references.typical) * static_cast<double>(black.radiance.size());
  return whole > 0.0 ? light / whole : 0.0;
}

Alarm roomLightAlarm(bool isBrighter) {
  if (isBrighter)
    return mayStay(alarm(
        AlarmKind::ambientChanged,
        RELUCENT_MESSAGE("alarm.room-brighter", "the light of the room became brighter"),
        RELUCENT_MESSAGE("alarm.restore-room-light",
                         "restore the light of the room, keep doors and curtains closed, then try again")));
  return gone(alarm(
      AlarmKind::ambientChanged, RELUCENT_MESSAGE("alarm.room-darker", "the light of the room became darker"),
      RELUCENT_MESSAGE("alarm.light-room-or-measure-again",
                       "switch on again what shone when measuring began, then try again; or stop, and "
                       "measure again in the light as it is now")));
}

std::optional<Alarm> inspectAmbient(const Check& now, const Baseline& baseline) {
  const photography::References& references = baseline.references;
  Sum change;
  for (std::size_t i = 0; i < now.black.radiance.size(); ++i) {
    if (!references.usable[i / 3]) continue;
    change.value += static_cast<double>(now.black.radiance[i] - baseline.black.radiance[i]);
    change.variance += static_cast<double>(now.black.variance[i] + baseline.black.variance[i]);
  }
  double limit = reading_limit::roomLight * static_cast<double>(references.typical) *
                 static_cast<double>(now.black.radiance.size());
  if (std::abs(change.value) < limit || !change.isSignificant()) return std::nullopt;
  return roomLightAlarm(change.value > 0.0);
}

/// One camera's view of one picture, before and now, the lamp's power taken out.
struct Views {
  image::Image before, after;
  std::vector<std::uint8_t> compared;
  double apart = 0.0, whole = 0.0, noise = 0.0;  // squared
  std::size_t changed = 0;                       // pixels off by a share of their own light
  std::size_t brighter = 0;                      // those of them that have more of it now
};

/// The light of one picture at two times.
struct Pictures {
  const hdr::HdrFrame& first;
  const hdr::HdrFrame& now;
  const CameraMask& compared;  // rows
  float typical;               // see References
};

/// The colours [begin, end), summed.
struct Colours {
  std::size_t begin = 0, end = 3;
};

Views viewsOf(const Rasters& cameras, std::size_t camera, const Pictures& pictures, double power,
              const Colours& colours = {}) {
  const auto& [first, now, compared, typical] = pictures;
  Size size = cameras.size(camera);
  Views views{image::Image(size, 1), image::Image(size, 1), std::vector<std::uint8_t>(size.count())};
  for (std::size_t i = 0; i < size.count(); ++i) {
    std::size_t row = cameras.offset(camera) + i;
    if (!compared[row]) continue;
    views.compared[i] = 1;
    double was = 0.0, is = 0.0, variance = 0.0;
    for (std::size_t c = colours.begin; c < colours.end; ++c) {
      was += static_cast<double>(first.radiance[3 * row + c]);
      is += static_cast<double>(now.radiance[3 * row + c]) / power;
      variance += static_cast<double>(now.variance[3 * row + c] + first.variance[3 * row + c]);
    }
    views.before.data()[i] = static_cast<float>(was);
    views.after.data()[i] = static_cast<float>(is);
    views.apart += (is - was) * (is - was);
    views.whole += was * was;
    views.noise += variance;
    double large = localLimit * std::max(was, static_cast<double>(typical));
    if (std::abs(is - was) <= std::max(large, sigmas * std::sqrt(variance))) continue;
    ++views.changed;
    views.brighter += is > was;
  }
  return views;
}

Views viewsOf(std::size_t camera, const Check& now, const Baseline& baseline, double power) {
  const photography::References& references = baseline.references;
  return viewsOf(references.cameras, camera,
                 {baseline.first.light, now.light, references.usable, references.typical}, power);
}

Movement movementOf(const Views& views) {
  return movementBetween({{views.before, views.after, views.compared}});
}

bool isLocal(const Views& views) {
  return static_cast<double>(views.changed) > localShare * static_cast<double>(views.before.size().count());
}

Alarm movedAlarm(std::size_t camera, const Movement& movement) {
  return mayStay(alarm(
      AlarmKind::moved,
      RELUCENT_MESSAGE("alarm.moved",
                       "a camera or projector has moved: the view of camera {} is shifted by {}, {} "
                       "pixels and turned by {} degrees")
          .with(as::label(camera + 1), as::pixels(movement.x, as::decimals(1)),
                as::pixels(movement.y, as::decimals(1)), as::degrees(movement.degrees, as::decimals(1))),
      putItBack));
}

/// Beside another light: putting that right alone would leave what moved where it is.
Alarm movedBesides(const Alarm& moved, const Alarm& ambient) {
  return mayStay(
      alarm(AlarmKind::moved,
            RELUCENT_MESSAGE("alarm.moved-besides", "{}; besides, {}").with(moved.what, ambient.what),
            RELUCENT_MESSAGE(
                "alarm.put-it-back-and-restore-light",
                "put it back to within half a pixel and restore the light of the room, then try again")));
}

Alarm changedAlarm(std::size_t camera, const Views& views) {
  const double share = static_cast<double>(views.changed) / static_cast<double>(views.before.size().count());
  // What stands in the light takes it away.
  if (2 * views.brighter > views.changed)
    return gone(alarm(
        AlarmKind::localChange,
        RELUCENT_MESSAGE("alarm.something-gone",
                         "{} % of the view of camera {} are brighter than before: what stood there is gone")
            .with(as::share(share, as::decimals(1)), as::label(camera + 1)),
        RELUCENT_MESSAGE("alarm.put-back-or-measure-again",
                         "put it back, then try again; or stop, and measure again without it")));
  return alarm(
      AlarmKind::localChange,
      RELUCENT_MESSAGE("alarm.view-changed", "{} % of the view of camera {} look different from before")
          .with(as::share(share, as::decimals(1)), as::label(camera + 1)),
      RELUCENT_MESSAGE("alarm.clear-the-view",
                       "take away what is in the light or in the view, then try again"));
}

std::optional<Alarm> inspectView(const Check& now, const Baseline& baseline, double power) {
  const Rasters& cameras = baseline.references.cameras;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    Views views = viewsOf(camera, now, baseline, power);
    bool different = views.apart > reading_limit::view * reading_limit::view * views.whole &&
                     views.apart > clearly * views.noise;
    if (!different && !isLocal(views)) continue;

    const Movement movement = movementOf(views);
    if (movement.explains) return movedAlarm(camera, movement);
    if (isLocal(views)) return changedAlarm(camera, views);
  }
  return std::nullopt;
}

/// Rows whose light neither picture saturates.
CameraMask comparable(const hdr::HdrFrame& first, const hdr::HdrFrame& now, const CameraMask& usable) {
  CameraMask rows = usable;
  for (std::size_t i = 0; i < first.valid.size(); ++i)
    if (!first.valid[i] || !now.valid[i]) rows[i / 3] = 0;
  return rows;
}

/// One colour's light now, relative to before, in one camera's view.
double colourPower(const Rasters& cameras, std::size_t camera, std::size_t colour, const Pictures& pictures) {
  double was = 0.0, is = 0.0;
  for (std::size_t i = 0; i < cameras.size(camera).count(); ++i) {
    const std::size_t row = cameras.offset(camera) + i;
    if (!pictures.compared[row]) continue;
    was += static_cast<double>(pictures.first.radiance[3 * row + colour]);
    is += static_cast<double>(pictures.now.radiance[3 * row + colour]);
  }
  return was > 0.0 && is > 0.0 ? is / was : 1.0;
}

/// The farthest that a movement takes a corner of the view.
double reachOf(const Movement& movement, const Size& size) {
  const double turn = std::abs(movement.degrees) * std::numbers::pi / 180.0;
  return std::hypot(movement.x, movement.y) + 0.5 * turn * std::hypot(size.width, size.height);
}

/// One camera's view at full light.
std::optional<Alarm> inspectFullLight(const Rasters& cameras, std::size_t camera, const Pictures& pictures) {
  const Size size = cameras.size(camera);
  Movement farthest;
  std::optional<Alarm> changed;
  for (std::size_t c = 0; c < 3; ++c) {
    const double power = colourPower(cameras, camera, c, pictures);
    const Views views = viewsOf(cameras, camera, pictures, power, {c, c + 1});
    if (views.apart <= clearly * views.noise) continue;
    const Movement movement = movementOf(views);
    const bool isFar = reachOf(movement, size) > movementLimit || isLocal(views);
    if (movement.explains && isFar && reachOf(movement, size) > reachOf(farthest, size)) farthest = movement;
    if (isLocal(views) && !changed) changed = changedAlarm(camera, views);
  }
  if (farthest.explains) return movedAlarm(camera, farthest);
  return changed;
}

/// The sum of the floods of the rounds after the first, their mean: what is left of that of all.
hdr::ProjectedLight laterRounds(const photography::References& references) {
  hdr::ProjectedLight sum(references.firstRound);
  const auto rounds = static_cast<float>(references.floodRounds), later = rounds - 1.0f;
  parallelFor(0, references.usable.size(), 4096, [&](std::size_t row) {
    for (std::size_t c = 0; c < 3; ++c) {
      float light = 0.0f, variance = 0.0f;
      for (std::size_t projector = 0; projector < references.root.size(); ++projector) {
        light += references.root[projector][row].row(static_cast<Eigen::Index>(c)).sum();
        variance += references.rootVariance[projector][row].row(static_cast<Eigen::Index>(c)).sum();
      }
      float& first = sum.radiance[3 * row + c];
      first = (rounds * light - first) / later;
      sum.variance[3 * row + c] += variance * rounds * rounds / (later * later);
    }
  });
  return sum;
}

/// All views at full light, as the floods told it.
std::optional<Alarm> inspectFullLight(const hdr::HdrFrame& floods, const hdr::ProjectedLight& white,
                                      const photography::References& references) {
  const CameraMask compared = comparable(floods, white, references.usable);
  const Pictures pictures{floods, white, compared, references.typical};
  for (std::size_t camera = 0; camera < references.cameras.devices(); ++camera)
    if (auto found = inspectFullLight(references.cameras, camera, pictures)) return found;
  return std::nullopt;
}

/// Sums over 8x6 places of a view, whose noise is little.
using Places = Eigen::Array<double, 8 * 6, 1>;

/// `lightOf`: of a pixel. Where the longer exposure is saturated nothing is summed.
template <typename LightOf>
Places placesOf(const photography::ContradictoryViews& views, const LightOf& lightOf) {
  constexpr int across = 8, down = 6;
  const Size size = views.longer.size();
  Places places = Places::Zero();
  for (std::size_t i = 0; i < size.count(); ++i) {
    if (views.saturated[i]) continue;
    const Pixel at = pixelAt(size, i);
    places[at.y * down / size.height * across + at.x * across / size.width] += lightOf(i);
  }
  return places;
}

/// How much of a change is one share of some light.
struct Explanation {
  double share = 0.0;  // of that light, least squares
  double left = 1.0;   // what it leaves of the change, squared
  bool holds() const { return left < 0.25; }
};

Explanation explained(const Places& change, const Places& light) {
  const double square = light.square().sum(), all = change.square().sum();
  if (!(square > 0.0 && all > 0.0)) return {};
  const double share = (change * light).sum() / square;
  return {share, (change - share * light).square().sum() / all};
}

/// By the light of the pattern itself, or by what comes to it from the room: as the projectors' full light
/// does, or the same everywhere, astray in the lens.
struct Change {
  bool isShorterDarker = false;  // the shorter exposure says less light
  Explanation brightness, room;
};

Change changeBetween(const photography::ContradictoryViews& views,
                     const photography::References& references) {
  const auto lightIn = [](const image::Image& view) {
    return [&view](std::size_t i) { return static_cast<double>(view.data()[i]); };
  };
  const Places longer = placesOf(views, lightIn(views.longer)),
               shorter = placesOf(views, lightIn(views.shorter));
  const Places& before = views.isLongerFirst ? longer : shorter;
  const Places& after = views.isLongerFirst ? shorter : longer;
  const std::size_t first = references.cameras.offset(views.camera);
  const Places flood = placesOf(views, [&](std::size_t i) {
    double light = 0.0;
    for (const auto& root : references.root) light += static_cast<double>(root[first + i].sum());
    return light;
  });
  const Places change = after - before, even = placesOf(views, [](std::size_t) { return 1.0; });
  const Explanation byFlood = explained(change, flood), byEven = explained(change, even);
  return {shorter.sum() < longer.sum(), explained(change, before),
          byFlood.left < byEven.left ? byFlood : byEven};
}

/// Light-weighted centres of what is lit in one colour of the reference picture, and of what is not.
struct Halves {
  Eigen::Vector2d lit = Eigen::Vector2d::Zero(), dark = Eigen::Vector2d::Zero();
  double litWeight = 0.0, darkWeight = 0.0;

  void add(const Eigen::Vector2d& place, double weight, double drive) {
    lit += weight * drive * place;
    litWeight += weight * drive;
    dark += weight * (1.0 - drive) * place;
    darkWeight += weight * (1.0 - drive);
  }
  Eigen::Vector2d fromLitToDark() const {
    if (litWeight <= 0.0 || darkWeight <= 0.0) return Eigen::Vector2d::Zero();
    return dark / darkWeight - lit / litWeight;
  }
};

}  // namespace

ProjectorStack referencePattern(const Rasters& projectors, std::size_t projector) {
  ProjectorStack pattern(3 * projectors.count(), 0.0f);
  Size size = projectors.size(projector);
  int side = std::max(2, std::min(size.width, size.height) / 12);
  for (std::size_t i = 0; i < size.count(); ++i) {
    Pixel at = pixelAt(size, i);
    Random random{referenceKey, projector, static_cast<std::uint64_t>(at.x / side),
                  static_cast<std::uint64_t>(at.y / side)};
    float* value = &pattern[3 * (projectors.offset(projector) + i)];
    value[0] = static_cast<float>(random.next() >> 63);
    value[1] = 2 * at.x < size.width ? 1.0f : 0.0f;
    value[2] = 2 * at.y < size.height ? 1.0f : 0.0f;
  }
  return pattern;
}

ProjectorStack referencePattern(const Rasters& projectors) {
  ProjectorStack all(3 * projectors.count(), 0.0f);
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    ProjectorStack one = referencePattern(projectors, projector);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += one[i];
  }
  return all;
}

double lampPower(const Check& now, const FirstCheck& first, const photography::References& references) {
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < now.light.radiance.size(); ++i) {
    if (!references.usable[i / 3] || !now.light.valid[i] || !first.light.valid[i]) continue;
    before += static_cast<double>(first.light.radiance[i]);
    after += static_cast<double>(now.light.radiance[i]);
  }
  return before > 0.0 ? after / before : 1.0;
}

Reading readingOf(const Check& now, const Baseline& baseline) {
  const photography::References& references = baseline.references;
  Reading reading;
  reading.roomLight = roomLight(now.black, references);
  reading.roomLightAtFirst = roomLight(baseline.first.black, references);
  reading.roomLightExpected = roomLight(baseline.black, references);
  reading.lamp = lampPower(now, baseline.first, references);
  reading.lampExpected = baseline.power;
  for (std::size_t camera = 0; camera < references.cameras.devices(); ++camera) {
    Views views = viewsOf(camera, now, baseline, reading.lamp);
    if (views.whole > 0.0)
      reading.view =
          std::max(reading.view, std::sqrt(std::max(0.0, views.apart - views.noise) / views.whole));
  }
  return reading;
}

double lightShare(const hdr::LampLight& seen, const ProjectorStack& pattern,
                  const photography::References& references) {
  const Rasters& projectors = references.projectors;
  std::vector<Eigen::Vector3f> means;
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    const std::size_t begin = projectors.offset(projector), count = projectors.size(projector).count();
    std::array<Eigen::Vector3f, fixedParts> sums;
    parallelChunks(begin, begin + count, fixedParts,
                   [&](std::size_t part, std::size_t first, std::size_t last) {
                     sums[part].setZero();
                     for (std::size_t j = first; j < last; ++j)
                       sums[part] += Eigen::Map<const Eigen::Vector3f>(&pattern[3 * j]);
                   });
    means.push_back(std::accumulate(sums.begin(), sums.end(), Eigen::Vector3f(0.0f, 0.0f, 0.0f)) /
                    static_cast<float>(count));
  }
  const Rasters& cameras = references.cameras;
  double least = 1.0;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), count = cameras.size(camera).count();
    const std::size_t step = (count + mostCompared - 1) / mostCompared;
    double shown = 0.0, expected = 0.0;
    for (std::size_t row = begin; row < begin + count; row += step) {
      if (!references.usable[row]) continue;
      Eigen::Vector3f light = Eigen::Vector3f::Zero();
      for (std::size_t projector = 0; projector < means.size(); ++projector)
        light += references.root[projector][row].matrix() * means[projector];
      for (std::size_t c = 0; c < 3; ++c) {
        if (!seen.valid[3 * row + c]) continue;
        shown += static_cast<double>(seen.radiance[3 * row + c]);
        expected += static_cast<double>(light[static_cast<Eigen::Index>(c)]);
      }
    }
    if (expected > 0.0) least = std::min(least, shown / expected);
  }
  return least;
}

std::optional<Alarm> inspect(const Check& now, const Baseline& baseline) {
  double power = lampPower(now, baseline.first, baseline.references);
  if (auto dark = inspectDarkness(now, baseline, power)) return dark;
  std::optional<Alarm> ambient = inspectAmbient(now, baseline);
  std::optional<Alarm> view = inspectView(now, baseline, power);
  if (ambient && view && view->kind == AlarmKind::moved) return movedBesides(*view, *ambient);
  if (ambient) return ambient;  // light that came between the two pictures looks like a change of the view
  if (view) return view;
  if (std::abs(power / baseline.power - 1.0) > reading_limit::lamp)
    return alarm(AlarmKind::lampChanged,
                 RELUCENT_MESSAGE("alarm.lamp-changed",
                                  "the projector's light changed by {} % within a few photographs")
                     .with(as::share((power / baseline.power - 1.0), as::decimals(0))),
                 RELUCENT_MESSAGE(
                     "alarm.switch-off-eco-modes",
                     "switch off its automatic brightness and eco modes, let it warm up, then try again"));
  return std::nullopt;
}

Alarm flickerAlarm(double apart) {
  return alarm(
      AlarmKind::flicker,
      RELUCENT_MESSAGE("alarm.light-flickers",
                       "the light flickers or was switched: photographs of one pattern differ by {} %")
          .with(as::share(apart, as::decimals(1))),
      RELUCENT_MESSAGE("alarm.switch-off-dimmed-lamps",
                       "switch off dimmed and fluorescent lamps and the projector's power saving, "
                       "then try again"));
}

Alarm inspectContradiction(double apart, const photography::ContradictoryViews& views,
                           const photography::References& references) {
  // The longer one has less noise, which moving it must not smooth away.
  Movement movement = movementBetween(std::vector<ViewPair>{{views.longer, views.shorter}});
  if (!views.isLongerFirst) movement = {-movement.x, -movement.y, -movement.degrees, movement.explains};
  if (movement.explains && reachOf(movement, views.longer.size()) > movementLimit)
    return movedAlarm(views.camera, movement);
  const auto [isShorterDarker, brightness, room] = changeBetween(views, references);
  if (isShorterDarker && apart > 1.0 - darkShare)
    return alarm(AlarmKind::coveredLens,
                 RELUCENT_MESSAGE("alarm.photograph-dark",
                                  "one of two photographs of a pattern is dark: the lens was covered, or the "
                                  "projector's picture gone"),
                 uncoverLens);
  if (room.holds() && room.left < brightness.left) return roomLightAlarm(room.share > 0.0);
  if (brightness.holds()) return flickerAlarm(apart);
  return alarm(
      AlarmKind::unsteady,
      RELUCENT_MESSAGE("alarm.photographs-differ",
                       "photographs of one pattern differ by {} %: the light flickers, or something moved "
                       "between them")
          .with(as::share(apart, as::decimals(1))),
      RELUCENT_MESSAGE(
          "alarm.steady-all",
          "see that camera, projector and surface stand still, switch off dimmed and fluorescent "
          "lamps and the projector's power saving, then try again"));
}

std::optional<Alarm> inspectFloods(const hdr::ProjectedLight& white,
                                   const photography::References& references) {
  if (auto found = inspectFullLight(references.firstRound, white, references)) return found;
  if (references.floodRounds < 2) return std::nullopt;
  return inspectFullLight(laterRounds(references), white, references);
}

std::optional<Alarm> inspectDarkness(const Check& seen, const ProjectorStack& pattern,
                                     const photography::References& references) {
  const hdr::LampLight light(seen.light, 1.0);
  const double share = lightShare(light, pattern, references);
  if (share > nothingShare) return std::nullopt;
  const FirstCheck itself{seen.black, light};
  return inspectDarkness(seen, Baseline{references, seen.black, itself}, share);
}

std::optional<Alarm> inspectOrientation(const hdr::ProjectedLight& light, std::size_t projector,
                                        const photography::References& references, bool mayBeMirrored) {
  const Rasters& cameras = references.cameras;
  Halves leftRight, upperLower;
  double turned = 0.0, span = 0.0;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    Size size = cameras.size(camera);
    for (std::size_t i = 0; i < size.count(); ++i) {
      std::size_t row = cameras.offset(camera) + i;
      const transport::ColourBlock& flood = references.root[projector][row];
      double weight = static_cast<double>(flood.sum());
      if (!references.usable[row] || !(weight > static_cast<double>(references.typical))) continue;
      Eigen::Vector3f seen(light.radiance[3 * row], light.radiance[3 * row + 1], light.radiance[3 * row + 2]);
      Eigen::Vector3f drive = flood.colPivHouseholderQr().solve(seen);
      Pixel at = pixelAt(size, i);
      Eigen::Vector2d place(at.x, at.y);
      leftRight.add(place, weight, static_cast<double>(std::clamp(drive[1], 0.0f, 1.0f)));
      upperLower.add(place, weight, static_cast<double>(std::clamp(drive[2], 0.0f, 1.0f)));
    }
    Eigen::Vector2d across = leftRight.fromLitToDark(), down = upperLower.fromLitToDark();
    turned += across.x() * down.y() - across.y() * down.x();
    span += across.norm() * down.norm();
    leftRight = upperLower = {};
  }
  double view = static_cast<double>(cameras.count()) / 1600.0;  // (2.5 % of the camera's width and height)^2
  if (span < view)
    return alarm(
        AlarmKind::wrongScreen,
        RELUCENT_MESSAGE("alarm.wrong-picture", "projector {} does not show the picture that it is given")
            .with(as::label(projector + 1)),
        RELUCENT_MESSAGE(
            "alarm.check-screen",
            "check that the right screen is chosen and nothing covers the picture, then try again"));
  if (turned < -0.3 * span && !mayBeMirrored)
    return alarm(
        AlarmKind::mirroredScreen,
        RELUCENT_MESSAGE("alarm.picture-mirrored", "the picture of projector {} appears mirrored")
            .with(as::label(projector + 1)),
        RELUCENT_MESSAGE(
            "alarm.switch-off-rear-projection",
            "switch off the projector's rear or ceiling mode, or allow a mirrored picture, then try again"));
  return std::nullopt;
}

}  // namespace relucent::sentinels
