// SPDX-License-Identifier: MIT
#include "relucent/pipeline/monitoring_rehearsal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/methods.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/rehearsed_venue.h"

namespace relucent::pipeline {
namespace {

constexpr double framesPerSecond = RehearsedContent::framesPerSecond;
constexpr double remembered = 0.45;      // seconds of frames that a photograph is looked for in
constexpr double longestExposure = 0.1;  // seconds

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

struct MonitoringRehearsal::Parts : RehearsedVenue {
  /// A picture as the projectors get it, and as the monitor reads it.
  struct Prepared {
    venue::PlayedPictures drives;
    monitoring::FrameMeans means;
  };

  Parts(const RehearsalSettings& asked, const std::filesystem::path& cacheFolder, Progress& progress)
      : RehearsedVenue(asked.venue, cacheFolder, progress),
        settings(asked),
        cache(cacheFolder),
        shown(asked.seed) {}

  const Prepared& prepared(ShownContent content, std::int64_t frame) {
    const std::int64_t key = shown.keyOf(content, frame);
    auto [found, isNew] = kept.try_emplace({content, key});
    if (!isNew) return found->second;
    Progress quiet;
    const compensation::Target target = fitTarget(shown.at(content, key), measured.venue, {});
    const compensation::Compensation solved =
        compensator->solve(compensation::Method::windows, target, quiet);
    const Rasters& projectors = measured.venue.transport.projectors();
    // As it is sent, and read again as the show's watcher does.
    std::vector<image::Image> drives = codedDrive(solved.projector, projectors, measured.linearization);
    found->second.means = watched.transport.meansOf(lightOf(drives, projectors, measured.linearization));
    found->second.drives = std::make_shared<const std::vector<image::Image>>(std::move(drives));
    return found->second;
  }

  RehearsalSettings settings;
  std::filesystem::path cache;
  RehearsedContent shown;
  std::map<std::pair<ShownContent, std::int64_t>, Prepared> kept;
};

MonitoringRehearsal::MonitoringRehearsal(const RehearsalSettings& settings,
                                         const std::filesystem::path& cache, Progress& progress)
    : parts_(std::make_unique<Parts>(settings, cache, progress)) {}

MonitoringRehearsal::~MonitoringRehearsal() = default;

void MonitoringRehearsal::setSeed(std::uint64_t seed) {
  parts_->settings.seed = seed;
  parts_->shown.setSeed(seed);
  parts_->kept.clear();
}

RehearsalResult MonitoringRehearsal::run(ShownContent content, double duration,
                                         const RehearsedTrouble& trouble, const RehearsedDay& day,
                                         Progress& progress) {
  Parts& parts = *parts_;
  const RehearsalSettings& settings = parts.settings;
  std::shared_ptr<const venue::SimulatedVenue> changed = parts.truth;
  if (trouble.changes) {
    venue::VenueSettings after = settings.venue;
    after.changes = *trouble.changes;
    changed = std::make_shared<const venue::SimulatedVenue>(after, parts.cache, progress);
  }
  const std::size_t projectors = parts.watched.transport.projectors();
  const venue::Visitors visitors({settings.seed, std::max(settings.visitorsEvery, 5.0), projectors});

  double lightTime = 0.0, wallTime = 0.0;  // of the frames that are lit, and of everything else
  const auto venueAt = [&](double) {
    const bool isAfter = wallTime >= trouble.at && wallTime < trouble.until;
    venue::PlayedVenue now{isAfter ? changed : parts.truth, {}, 0.0f, {}};
    const auto drift = static_cast<float>(1.0 - day.lampDrift * wallTime / duration);
    now.lamps.assign(projectors, {drift, drift, drift});
    if (isAfter && !trouble.lamps.empty())
      for (std::size_t j = 0; j < projectors; ++j)
        for (std::size_t c = 0; c < 3; ++c) now.lamps[j][c] *= trouble.lamps[j][c];
    now.moreRoomLight =
        static_cast<float>(-day.dusk * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * wallTime / duration)));
    if (settings.visitorsEvery > 0.0) now.inTheWay = visitors.at(wallTime);
    if (isAfter) now.inTheWay.insert(now.inTheWay.end(), trouble.shadows.begin(), trouble.shadows.end());
    return now;
  };
  const auto camera = venue::cameraBeforeShow(
      {framesPerSecond, [&](std::int64_t frame) { return parts.prepared(content, frame).drives; }}, venueAt,
      [&] { return lightTime; });

  monitoring::Monitor monitor(parts.watched);
  RehearsalResult result;
  result.bytes = parts.watched.transport.bytes();
  std::vector<std::vector<double>> gains(projectors);
  std::vector<double> shifts, off;
  std::vector<monitoring::Finding> before;
  for (int n = 0; n * settings.interval < duration; ++n) {
    if (n % 100 == 0) progress.checkpoint();
    Random random({settings.seed, 0x1a7e, static_cast<std::uint64_t>(n)});
    wallTime = (n + 0.5 * random.uniform()) * settings.interval + 1.0;
    lightTime = wallTime - settings.latency * (1.0 + random.uniform());
    const auto newest = static_cast<std::int64_t>(std::floor(wallTime * framesPerSecond));
    Stopwatch watch;
    const double exposure =
        monitoring::suitableExposure(parts.prepared(content, newest).means,
                                     parts.measured.linearization.exposures, longestExposure, parts.watched);
    result.seconds += watch.seconds();
    const rig::RawFrame photograph = camera->capture({{"monitoring", n}, 0, exposure});
    std::vector<monitoring::PlayedFrame> frames;
    std::int64_t lastKey = -1;
    const auto first = static_cast<std::int64_t>(std::floor((wallTime - remembered) * framesPerSecond));
    const auto last = static_cast<std::int64_t>(std::floor((wallTime + exposure) * framesPerSecond));
    for (std::int64_t frame = first; frame <= last; ++frame) {
      const std::int64_t key = parts.shown.keyOf(content, frame);
      if (key == lastKey) continue;
      lastKey = key;
      frames.push_back({static_cast<double>(frame) / framesPerSecond, parts.prepared(content, frame).means});
    }
    watch = Stopwatch();
    const monitoring::Look look = monitor.look(photograph, wallTime, frames);
    result.seconds += watch.seconds();
    ++result.photographs;
    result.used += look.use == monitoring::Look::Use::told;
    result.saturated += look.use == monitoring::Look::Use::saturated;
    result.unrecognised += look.use == monitoring::Look::Use::unrecognised;
    if (look.use == monitoring::Look::Use::told) {
      for (std::size_t j = 0; j < projectors; ++j)
        if (look.light.totalDeviation[j] < 0.03) gains[j].push_back(look.light.total[j]);
      if (look.shift.deviation < 0.15) shifts.push_back(std::hypot(look.shift.x, look.shift.y));
      if (frames.size() > 5 && !look.moment.along.empty())
        off.push_back(std::abs(look.moment.since - lightTime));
    }
    for (const monitoring::Finding& finding : monitor.findings()) {
      const bool isNew = std::none_of(before.begin(), before.end(), [&](const monitoring::Finding& one) {
        return one.kind == finding.kind && one.projector == finding.projector &&
               one.channel == finding.channel;
      });
      if (isNew) result.told.push_back({wallTime, finding});
    }
    before = monitor.findings();
  }
  for (const std::vector<double>& own : gains) {
    result.gainLow.push_back(percentile(own, 0.01));
    result.gainHigh.push_back(percentile(own, 0.99));
  }
  result.lasting = before;
  result.shift = percentile(shifts, 0.99);
  result.offBy = percentile(off, 0.5);
  return result;
}

std::optional<double> RehearsalResult::toldAfter(const RehearsedTrouble& trouble) const {
  if (!trouble.expected) return std::nullopt;
  for (const ToldFinding& one : told)
    if (one.finding.kind == *trouble.expected && one.seconds >= trouble.at) return one.seconds - trouble.at;
  return std::nullopt;
}

std::vector<ToldFinding> RehearsalResult::falseAlarms(const RehearsedTrouble& trouble) const {
  std::vector<ToldFinding> found;
  for (const ToldFinding& one : told)
    if (!trouble.expected || one.seconds < trouble.at) found.push_back(one);
  return found;
}

}  // namespace relucent::pipeline
