// SPDX-License-Identifier: MIT
#include "relucent/pipeline/viewer_walk.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/engine/cpu_backend.h"
#include "relucent/engine/view_follower.h"
#include "relucent/image/picture_files.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using compensation::Position;

std::vector<Position> positionsOf(const compensation::TargetSettings& target, std::size_t cameras) {
  std::vector<Position> positions;
  for (const compensation::ViewSettings& view : target.views)
    if (view.position) positions.push_back(*view.position);
  if (cameras < 2 || positions.size() != cameras)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("walk.positions-unknown",
                                 "a viewer walks past cameras: there must be two at least, and it must be "
                                 "known where all of them stand"),
        RELUCENT_ENGLISH_MESSAGE("walk.give-positions", "give every --camera-position"));
  return positions;
}

/// From one end to the other of the two that are furthest apart, all others as they lie between.
std::vector<Position> inOrder(std::vector<Position> cameras) {
  std::size_t first = 0, last = 1;
  const auto apart = [&](std::size_t a, std::size_t b) {
    return compensation::widestDistance(std::vector<Position>{cameras[a], cameras[b]});
  };
  for (std::size_t a = 0; a < cameras.size(); ++a)
    for (std::size_t b = a + 1; b < cameras.size(); ++b)
      if (apart(a, b) > apart(first, last)) std::tie(first, last) = std::pair(a, b);
  const Position from = cameras[first], to = cameras[last];
  const auto along = [&](const Position& place) {
    double sum = 0.0;
    for (std::size_t k = 0; k < place.size(); ++k) sum += (place[k] - from[k]) * (to[k] - from[k]);
    return sum;
  };
  std::ranges::stable_sort(cameras, {}, along);
  return cameras;
}

/// At a share of the way past all of them, in equal times from each to the next.
Position placeAt(const std::vector<Position>& cameras, double share) {
  const double along = share * static_cast<double>(cameras.size() - 1);
  const std::size_t from = std::min(static_cast<std::size_t>(along), cameras.size() - 2);
  const double part = along - static_cast<double>(from);
  Position place{};
  for (std::size_t k = 0; k < place.size(); ++k)
    place[k] = (1.0 - part) * cameras[from][k] + part * cameras[from + 1][k];
  return place;
}

/// All views side by side.
image::Image sideBySide(const std::vector<image::Image>& views) {
  int width = 0, height = 0;
  for (const image::Image& view : views) {
    width += view.width();
    height = std::max(height, view.height());
  }
  image::Image all(Size{width, height}, 3);
  int left = 0;
  for (const image::Image& view : views) {
    for (int y = 0; y < view.height(); ++y)
      for (int x = 0; x < view.width(); ++x)
        for (int c = 0; c < 3; ++c) all.at(left + x, y, c) = view.at(x, y, c);
    left += view.width();
  }
  return all;
}

}  // namespace

std::vector<Message> problems(const WalkSettings& settings) {
  std::vector<Message> found;
  if (settings.frames < 0 || settings.frames == 1 || settings.steps < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "walk.too-few-frames", "a viewer's walk has two frames or more, with one step or more each"));
  if (!settings.film.empty() && settings.frames == 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("walk.film-without-walk",
                                             "a film of a walk needs the number of its frames"));
  return found;
}

std::vector<WalkFrame> walk(const MeasuredCalibration& measured, const image::Image& content,
                            const compensation::TargetSettings& target, const WalkSettings& settings,
                            const WalkJudge& judge, Progress& progress) {
  const std::vector<Message> wrong = problems(settings);
  require(wrong.empty() && settings.frames > 0, "a walk: {}", fmt::join(wrong, "; "));
  const compensation::MeasuredVenue& venue = measured.venue;
  const std::vector<Position> cameras = positionsOf(target, venue.transport.cameras().devices());
  const std::vector<Position> way = inOrder(cameras);
  if (!settings.film.empty()) fs::create_directories(settings.film);

  engine::EngineSettings plan;
  plan.target = target;
  plan.target.viewer.reset();
  const engine::EngineVenue prepared =
      prepareVenue(venue, measured.inverse, measured.linearization.projectors, plan);
  engine::EngineContent placed = prepareContent(prepared, content.size());
  engine::ViewFollower follower(prepared, placed);
  engine::CpuBackend backend(prepared);
  backend.setContent(placed);
  const engine::ContentFrame frame{content.data().data(), content.size(),
                                   3 * sizeof(float) * static_cast<std::size_t>(content.width()),
                                   engine::ContentFrame::Format::linearFloat};
  engine::FrameRequest request;
  request.steps = static_cast<int>(plan.compensator.steps.size());
  std::vector<std::uint32_t> words(prepared.brightest.size());
  std::vector<double> home;
  for (const compensation::ViewSettings& view : target.views) home.push_back(view.weight);
  std::vector<WalkFrame> walked;
  for (int index = 0; index < settings.frames; ++index) {
    progress.checkpoint();
    WalkFrame next{placeAt(way, static_cast<double>(index) / (settings.frames - 1)), {}, {}, {}};
    next.weights = compensation::viewerWeights(cameras, next.viewer);
    const std::vector<double> asked = follower.weightsFor(cameras, home, home, next.viewer, 1.0);
    compensation::TargetSettings there = plan.target;
    for (std::size_t view = 0; view < asked.size(); ++view) there.views[view].weight = asked[view];
    if (!asked.empty()) follower.follow(asked, placed);
    backend.contentFollowed();
    engine::FrameReport report;
    backend.render(frame, request, words, report);
    request.fromLast = true;
    request.steps = settings.steps;

    compensation::Compensation shown;
    const std::span<const float> drive = backend.projector();
    shown.projector.assign(drive.begin(), drive.end());
    WalkSight sight = judge(shown, fitTarget(content, venue, there));
    next.psnr = std::move(sight.psnr);
    next.unseen = std::move(sight.unseen);
    if (!settings.film.empty())
      image::writePng(settings.film / fmt::format("frame-{:04}.png", index + 1), sideBySide(sight.views), 8);
    walked.push_back(std::move(next));
    progress.report(static_cast<double>(index + 1) / settings.frames);
  }
  return walked;
}

}  // namespace relucent::pipeline
