// SPDX-License-Identifier: MIT
#include "relucent/pipeline/shadow_rehearsal.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "relucent/base/stopwatch.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/engine/cpu_backend.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/rehearsed_venue.h"

namespace relucent::pipeline {
namespace {

constexpr double lookedBack = 0.3;     // seconds of frames that a photograph is looked for in
constexpr double mostExposure = 0.05;  // seconds
constexpr double shadowedFrom = 0.9;   // of the light that would be there
constexpr double nobody = 0.98;        // of a cell's light that arrives, so that nobody stands in it

}  // namespace

struct ShadowRehearsal::Parts : RehearsedVenue {
  /// Of a picture that nobody stands in.
  struct Content {
    image::Image linear;
    ProjectorStack solved;  // of a still; else empty
  };
  /// An engine with its content; what it shows last.
  struct Show {
    explicit Show(const engine::EngineVenue& venue)
        : content(engine::prepareContent(venue, RehearsedContent::canvas)), backend(venue), follower(venue) {
      backend.setContent(content);
      words.resize(venue.brightest.size());
    }
    engine::EngineContent content;
    engine::CpuBackend backend;
    engine::AvailabilityFollower follower;
    std::vector<std::uint32_t> words;
    std::int64_t key = -1;
    venue::PlayedPictures drives;
    std::shared_ptr<const monitoring::FrameMeans> means;
  };

  Parts(const ShadowRehearsalSettings& asked, const std::filesystem::path& cache, Progress& progress)
      : RehearsedVenue(asked.venue, cache, progress), settings(asked), shown(asked.seed) {
    prepared.emplace(prepareVenue(measured.venue, measured.inverse, measured.linearization.projectors,
                                  engine::EngineSettings()));
  }

  const Content& contentOf(ShownContent content, std::int64_t key) {
    auto [found, isNew] = contents.try_emplace({content, key});
    if (!isNew) return found->second;
    found->second.linear = shown.at(content, key);
    if (content == ShownContent::still) {
      Progress quiet;
      const compensation::Target target = fitTarget(found->second.linear, measured.venue, {});
      found->second.solved = compensator->solve(compensation::Method::refined, target, quiet).projector;
    }
    return found->second;
  }

  /// The frame, as a show has it: a still from its own solution on, a film from the windows.
  void render(Show& show, ShownContent content, std::int64_t key) {
    const Content& picture = contentOf(content, key);
    engine::FrameRequest request;
    request.steps = settings.steps;
    request.fromLast = !picture.solved.empty();
    if (request.fromLast) show.backend.startFrom(picture.solved);
    const engine::ContentFrame frame{picture.linear.data().data(), picture.linear.size(),
                                     3 * sizeof(float) * static_cast<std::size_t>(picture.linear.width()),
                                     engine::ContentFrame::Format::linearFloat};
    engine::FrameReport report;
    show.backend.render(frame, request, show.words, report);
    const Rasters& projectors = measured.venue.transport.projectors();
    std::vector<image::Image> drives;
    for (std::size_t j = 0; j < projectors.devices(); ++j) {
      image::Image& drive = drives.emplace_back(projectors.size(j), 3);
      for (std::size_t i = 0; i < projectors.size(j).count(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          drive.data()[3 * i + c] =
              static_cast<float>(show.words[projectors.offset(j) + i] >> (8 * c) & 0xffu) / 255.0f;
    }
    show.means = std::make_shared<const monitoring::FrameMeans>(
        watched.transport.meansOf(lightOf(drives, projectors, measured.linearization)));
    show.drives = std::make_shared<const std::vector<image::Image>>(std::move(drives));
    show.key = key;
  }

  ShadowedPicture judge(const std::vector<image::Image>& drives, const std::vector<image::Image>& reference,
                        const std::vector<image::Image>& possible, const image::Image& content,
                        const venue::PlayedVenue& now) const {
    const compensation::Target target = fitTarget(content, measured.venue, {});
    venue::PlayedVenue empty = now;
    empty.inTheWay.clear();
    const CameraStack alone = venue::trueLight(reference, empty);
    const CameraStack dark = venue::trueLight(reference, now);
    const auto errorOf = [&](const CameraStack& view) {
      const Rasters& cameras = measured.venue.transport.cameras();
      CameraStack all(target.wanted);
      std::copy(view.begin(), view.end(), all.begin());
      return compensation::errorIn(0, all, target, cameras).deltaE;
    };
    const image::Image filled = errorOf(venue::trueLight(drives, now)), unfilled = errorOf(dark),
                       unshadowed = errorOf(alone), best = errorOf(venue::trueLight(possible, now));
    ShadowedPicture picture;
    std::size_t beside = 0;
    for (std::size_t i = 0; i < filled.data().size(); ++i) {
      if (std::isnan(filled.data()[i])) continue;
      picture.all += static_cast<double>(filled.data()[i]);
      picture.allUnfilled += static_cast<double>(unfilled.data()[i]);
      double with = 0.0, without = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        with += static_cast<double>(dark[3 * i + c]);
        without += static_cast<double>(alone[3 * i + c]);
      }
      if (with > shadowedFrom * without) {
        ++beside;
        picture.beside += static_cast<double>(filled.data()[i]);
        picture.besideUnshadowed += static_cast<double>(unshadowed.data()[i]);
        continue;
      }
      ++picture.shadowed;
      picture.filled += static_cast<double>(filled.data()[i]);
      picture.unfilled += static_cast<double>(unfilled.data()[i]);
      picture.unshadowed += static_cast<double>(unshadowed.data()[i]);
      picture.possible += static_cast<double>(best.data()[i]);
    }
    const auto every = static_cast<double>(std::max<std::size_t>(1, picture.shadowed + beside));
    picture.all /= every;
    picture.allUnfilled /= every;
    const auto shadowed = static_cast<double>(std::max<std::size_t>(1, picture.shadowed));
    picture.filled /= shadowed;
    picture.unfilled /= shadowed;
    picture.unshadowed /= shadowed;
    picture.possible /= shadowed;
    picture.beside /= static_cast<double>(std::max<std::size_t>(1, beside));
    picture.besideUnshadowed /= static_cast<double>(std::max<std::size_t>(1, beside));
    return picture;
  }

  /// What is not blocked, pixel by pixel.
  engine::Availability availableOf(const std::vector<venue::Silhouette>& inTheWay) const {
    engine::Availability available;
    const Rasters& projectors = measured.venue.transport.projectors();
    for (std::size_t j = 0; j < projectors.devices(); ++j) {
      const Size size = projectors.size(j);
      engine::Availability::Grid& grid = available.projectors.emplace_back(engine::completeGrid(size, 1));
      for (std::size_t i = 0; i < size.count(); ++i)
        if (std::any_of(inTheWay.begin(), inTheWay.end(), [&](const venue::Silhouette& one) {
              return one.projector == j && one.holds(size, pixelAt(size, i));
            }))
          grid.share[i] = 0.0f;
    }
    return available;
  }

  /// Whether any cell is filled in and around which nobody stands in the projector's light.
  bool isFalse(const monitoring::ShadowTracker& tracker,
               const std::vector<venue::Silhouette>& inTheWay) const {
    const monitoring::ShadowMap& map = tracker.map();
    for (std::size_t j = 0; j < map.projectors(); ++j) {
      const monitoring::ShadowMap::Grid& grid = map.grids()[j];
      const Size raster = measured.venue.transport.projectors().size(j);
      const auto isBlocked = [&](int x, int y) {
        return std::any_of(inTheWay.begin(), inTheWay.end(), [&](const venue::Silhouette& one) {
          return one.projector == j && one.holds(raster, {x, y});
        });
      };
      for (std::size_t local = 0; local < grid.cells.count(); ++local) {
        if (static_cast<double>(tracker.available().projectors[j].share[local]) >= 0.4) continue;
        const Pixel at = pixelAt(grid.cells, local);
        bool isNear = false;
        for (int y = (at.y - 2) * grid.side; y < (at.y + 3) * grid.side && !isNear; ++y)
          for (int x = (at.x - 2) * grid.side; x < (at.x + 3) * grid.side && !isNear; ++x)
            isNear = isBlocked(x, y);
        if (!isNear) return true;
      }
    }
    return false;
  }

  ShadowRehearsalSettings settings;
  RehearsedContent shown;
  std::optional<engine::EngineVenue> prepared;
  std::map<std::pair<ShownContent, std::int64_t>, Content> contents;
};

ShadowRehearsal::ShadowRehearsal(const ShadowRehearsalSettings& settings, const std::filesystem::path& cache,
                                 Progress& progress)
    : parts_(std::make_unique<Parts>(settings, cache, progress)) {}

ShadowRehearsal::~ShadowRehearsal() = default;

void ShadowRehearsal::setSeed(std::uint64_t seed) {
  parts_->settings.seed = seed;
  parts_->shown.setSeed(seed);
  parts_->contents.clear();
}

ShadowRehearsalResult ShadowRehearsal::run(const Run& run, Progress& progress) {
  Parts& parts = *parts_;
  const double frameSeconds = 1.0 / RehearsedContent::framesPerSecond;
  Parts::Show show(*parts.prepared), reference(*parts.prepared), possible(*parts.prepared);
  engine::Availability possibleNow;
  monitoring::ShadowTracker tracker(parts.watched, parts.settings.shadows);
  const auto venueAt = [&](double seconds) {
    venue::PlayedVenue now{parts.truth, {}, 0.0f, {}};
    if (run.inTheWay) now.inTheWay = run.inTheWay(seconds);
    return now;
  };
  struct Lit {
    std::int64_t frame = 0;
    venue::PlayedPictures drives;
    std::shared_ptr<const monitoring::FrameMeans> means;
  };
  std::deque<Lit> lit;
  double photographed = 0.0;
  const auto camera = venue::cameraBeforeShow(
      {RehearsedContent::framesPerSecond,
       [&](std::int64_t frame) {
         return std::find_if(lit.begin(), lit.end(), [&](const Lit& one) { return one.frame == frame; })
             ->drives;
       }},
      venueAt, [&] { return photographed; });

  struct Asked {
    double from = 0.0;
    engine::Availability available;
  };
  std::deque<Asked> asked;
  ShadowRehearsalResult result;
  int taken = 0;
  for (std::int64_t frame = 0; static_cast<double>(frame) * frameSeconds < run.duration; ++frame) {
    progress.checkpoint();
    const double now = static_cast<double>(frame) * frameSeconds;
    const std::int64_t key = parts.shown.keyOf(run.content, frame);
    Stopwatch watch;
    for (; !asked.empty() && asked.front().from <= now; asked.pop_front())
      show.follower.aim(asked.front().available, show.content);
    const bool follows = show.follower.advance(std::chrono::duration<double>(frameSeconds), show.content);
    if (follows) {
      show.backend.availabilityFollowed();
      result.followSeconds += watch.seconds();
      ++result.followed;
    }
    if (follows || key != show.key) parts.render(show, run.content, key);
    if (run.keepsWords) result.words.push_back(show.words);
    lit.push_back({frame, show.drives, show.means});
    while (static_cast<double>(frame - lit.front().frame) * frameSeconds > lookedBack) lit.pop_front();

    // A photograph that began when this frame's exposure can be seen as a whole.
    const double begins = (taken + 0.5) / parts.settings.photographs;
    if (now < begins + mostExposure) continue;
    ++taken;
    photographed = begins;
    const double exposure = monitoring::suitableExposure(*show.means, parts.measured.linearization.exposures,
                                                         mostExposure, parts.watched);
    const rig::RawFrame photograph = camera->capture({{"shadows", taken}, 0, exposure});
    const auto atBegin = static_cast<std::int64_t>(std::floor(begins / frameSeconds));
    ShadowedPicture picture;
    if (run.judges) {
      const std::int64_t wasKey = parts.shown.keyOf(run.content, atBegin);
      if (reference.key != wasKey) parts.render(reference, run.content, wasKey);
      const venue::PlayedVenue who = venueAt(begins);
      if (const engine::Availability known = parts.availableOf(who.inTheWay);
          possible.key != wasKey || !(known == possibleNow)) {
        possibleNow = known;
        possible.follower.aim(known, possible.content);
        possible.follower.advance(std::chrono::duration<double>(10.0), possible.content);
        possible.backend.availabilityFollowed();
        parts.render(possible, run.content, wasKey);
      }
      const auto then =
          std::find_if(lit.begin(), lit.end(), [&](const Lit& one) { return one.frame == atBegin; });
      picture = parts.judge(*then->drives, *reference.drives, *possible.drives,
                            parts.contentOf(run.content, wasKey).linear, who);
    }
    picture.seconds = begins;
    if (run.fills) {
      watch = Stopwatch();
      const monitoring::Observed seen = monitoring::observedOf(photograph, parts.watched);
      std::vector<monitoring::PlayedFrame> frames;
      const monitoring::FrameMeans* before = nullptr;
      for (const Lit& one : lit)
        if (one.means.get() != std::exchange(before, one.means.get()))
          frames.push_back({static_cast<double>(one.frame) * frameSeconds, *one.means});
      monitoring::KnownLight known;
      known.gains.assign(3 * parts.watched.transport.projectors(), 1.0);
      const monitoring::Moment moment =
          momentOf(seen, frames, hdr::trueSeconds(parts.watched.camera, photograph.seconds), parts.watched,
                   known.gains);
      picture.isOther = tracker.look(seen, moment, known, begins);
      result.seconds += watch.seconds();
      if (picture.isOther) asked.push_back({begins + exposure + parts.settings.latency, tracker.available()});
      for (const monitoring::FilledShadow& shadow : tracker.filled()) picture.cells += shadow.cells;
      std::vector<venue::Silhouette> lately;
      for (int back = 0; back <= 15; ++back)
        for (const venue::Silhouette& one : venueAt(begins - 0.1 * back).inTheWay) lately.push_back(one);
      result.falseFills += parts.isFalse(tracker, lately);
    }
    result.pictures.push_back(picture);
  }
  return result;
}

}  // namespace relucent::pipeline
