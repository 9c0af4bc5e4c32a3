// SPDX-License-Identifier: MIT
#include "output/engine_renderer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "output/drive_pictures.h"
#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/base/tbb.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::gui {
namespace {

/// Of a frame's time, what computing may take: the rest is for upload, swap and whatever else runs.
constexpr double shareOfBudget = 0.7;
/// After a pause, a shadow does not come or go at once.
constexpr std::chrono::duration<double> mostOfAFade{0.05};
/// Of a still whose shadows are filled: what is missing is given by the first of them, and evened out by the
/// next.
constexpr int leastSteps = 2;

/// Empty if not all are known, or there are no two.
std::vector<compensation::Position> positionsOf(const std::vector<compensation::ViewSettings>& views,
                                                std::size_t cameras) {
  std::vector<compensation::Position> positions;
  for (const compensation::ViewSettings& view : views)
    if (view.position) positions.push_back(*view.position);
  if (positions.size() != cameras || cameras < 2) positions.clear();
  return positions;
}

Size canvasSize(const Canvas& canvas) {
  return {canvas.size.width(), canvas.size.height()};
}

void checkCount(const std::vector<compensation::Position>& positions, std::size_t cameras) {
  if (positions.empty() || positions.size() == cameras) return;
  throw Error(ErrorKind::input,
              RELUCENT_ENGLISH_MESSAGE("show.camera-positions-differ",
                                       "{} positions are given, and the calibration has {} cameras")
                  .with(positions.size(), cameras),
              RELUCENT_ENGLISH_MESSAGE("show.give-position-of-every-camera",
                                       "give the position of every camera, from the first on"));
}

}  // namespace

EngineRenderer::EngineRenderer(const RendererSettings& wanted, Progress& progress,
                               const engine::FallbackBackend::Notify& notify, const engine::MakeGlHost& host)
    : settings_(wanted), notify_(notify) {
  Chosen chosen;
  {
    const calibration::CalibrationFolder folder = pipeline::openWithSet(wanted.calibration, wanted.set);
    calibration_ = pipeline::loadCalibration(folder, progress);
    chosen = chosenIn(folder);
  }
  correctedFrom_ = chosen.correctedFrom;
  const engine::EngineSettings settings = settingsOf(chosen.settings.content);
  venue_.emplace(engine::prepareVenue(calibration_.venue, calibration_.inverse,
                                      calibration_.linearization.projectors, settings));
  const std::size_t views = calibration_.venue.transport.cameras().devices();
  checkCount(wanted.cameras, views);
  if (views > 1)
    cameras_ = wanted.cameras.empty() ? positionsOf(settings.target.views, views) : wanted.cameras;
  set_ = setOf(chosen);
  set_->name = wanted.set;
  backend_ = engine::makeBackend(*venue_, wanted.backend, notify, host);
  backend_->setContent(set_->content);
  words_.resize(calibration_.venue.transport.projectors().count());
  cards_ = CardPictures(EngineRenderer::projectors());
}

engine::EngineSettings EngineRenderer::settingsOf(const pipeline::ContentSettings& content) const {
  engine::EngineSettings settings;
  settings.target = targetOf(content);
  if (settings_.brightness) settings.target.brightness = *settings_.brightness;
  // Both at once would brighten twice.
  if (settings_.adaptiveRange) settings.target.brightness = compensation::Brightness::even;
  return settings;
}

EngineRenderer::Chosen EngineRenderer::chosenIn(const calibration::CalibrationFolder& folder) {
  return {pipeline::settingsOf(folder), pipeline::fingerprintOfShown(folder),
          pipeline::fingerprintOfCorrection(folder)};
}

std::shared_ptr<EngineRenderer::Set> EngineRenderer::setOf(const Chosen& chosen) const {
  const pipeline::ContentSettings& content = chosen.settings.content;
  const compensation::TargetSettings target = settingsOf(content).target;
  auto set = std::make_shared<Set>();
  set->shownFrom = chosen.shownFrom;
  set->content = engine::prepareContent(*venue_, canvasSize(settings_.canvas), target);
  if (settings_.adaptiveRange) set->range.emplace(*venue_, set->content);
  if (target.brightness != compensation::Brightness::even)
    set->whites.emplace(*venue_, set->content, target.brightness);
  for (std::size_t view = 0; view < calibration_.venue.transport.cameras().devices(); ++view)
    set->home.push_back(view < target.views.size() ? target.views[view].weight : 1.0);
  set->rest.assign(set->content.viewWeight.begin(), set->content.viewWeight.end());
  if (!cameras_.empty()) set->follower.emplace(*venue_, set->content);
  if (settings_.fillsShadows) set->shadows.emplace(*venue_);
  const compensation::Method method = content.method;
  // A range that follows the content is the engine's.
  if (!settings_.adaptiveRange || method != compensation::Method::refined)
    set->still = std::make_unique<StillSolver>(calibration_, target, chosen.settings.clustering, method);
  const bool isOfThis = chosen.correctedFrom == correctedFrom_;
  if (set->still && isOfThis && target.brightness == content.brightness)
    set->perfected.emplace(settings_.calibration, set->shownFrom, calibration_.venue.transport.projectors(),
                           notify_);
  return set;
}

std::shared_ptr<PreparedSet> EngineRenderer::prepare(const std::string& name) {
  std::shared_ptr<Set> set;
  // Frames come first.
  tbb::task_arena arena(tbb::task_arena::automatic, 1, tbb::task_arena::priority::low);
  const Chosen chosen = chosenIn(pipeline::openWithSet(settings_.calibration, name));
  arena.execute([&] { set = setOf(chosen); });
  set->name = name;
  return set;
}

void EngineRenderer::take(const std::shared_ptr<PreparedSet>& wanted) {
  before_.reset();
  auto set = std::static_pointer_cast<Set>(wanted);
  if (!set || set == set_) return;
  backend_->setContent(set->content);
  {
    const std::scoped_lock lock(guard_);
    before_ = std::exchange(set_, std::move(set));
  }
  // Nothing to go on from.
  number_ = solvedNumber_ = 0;
  solved_ = {};
}

std::vector<QSize> EngineRenderer::projectors() const {
  std::vector<QSize> sizes;
  for (const Size& size : calibration_.venue.transport.projectors().sizes())
    sizes.emplace_back(size.width, size.height);
  return sizes;
}

QString EngineRenderer::name() const {
  std::string_view name = backend_->name();
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

int EngineRenderer::stepsFor(const RenderRequest& request) {
  int all = static_cast<int>(venue_->settings.compensator.steps.size());
  if (request.thorough) return all;
  if (!budget_ || budgetSeconds_ != request.seconds) {
    budgetSeconds_ = request.seconds;
    budget_.emplace(std::chrono::duration<double>(shareOfBudget * request.seconds), all);
  }
  return budget_->steps();
}

RenderedFrame EngineRenderer::render(const ContentPicture& content, const RenderRequest& request,
                                     const Outdated& outdated) {
  take(request.set);
  // Light that does not arrive is the engine's: no still is solved without it.
  if (request.compensated && followShadows(request)) {
    if (set_->still && request.thorough && request.brightness == 1.0 && !isSolved(content, request))
      solve(content, request, outdated);
    return framed(content, request);
  }
  // Brightness is the engine's. After a shadow a still is at once what it was before.
  if (!set_->still || !(request.thorough || isSolved(content, request)) || !request.compensated ||
      request.brightness != 1.0)
    return framed(content, request);
  if (std::optional<RenderedFrame> rendered = thorough(content, request, outdated))
    return *std::move(rendered);
  RenderRequest inHaste = request;
  inHaste.thorough = false;
  return framed(content, inHaste);
}

std::optional<RenderedFrame> EngineRenderer::thorough(const ContentPicture& content,
                                                      const RenderRequest& request,
                                                      const Outdated& outdated) {
  Stopwatch watch;
  const auto [solved, isPerfected] = solve(content, request, outdated);
  if (solved == nullptr) return std::nullopt;
  if (set_->follower) {
    follow(request.viewer);
    backend_->startFrom(solved->projector);
    number_ = content.number;
    last_ = request;
  }
  RenderedFrame rendered = encoded(*solved, watch.seconds());
  rendered.perfected = isPerfected;
  return rendered;
}

EngineRenderer::Solved EngineRenderer::solve(const ContentPicture& content, const RenderRequest& request,
                                             const Outdated& outdated) {
  // For whoever looks from where the content is for.
  Solved found;
  if (set_->perfected && !request.viewer) found.solved = set_->perfected->of(content, request.edition);
  found.isPerfected = found.solved != nullptr;
  if (!found.isPerfected) found.solved = set_->still->solve(content, outdated, weightsFor(request.viewer));
  if (set_->shadows && found.solved != nullptr) {
    solved_ = found.solved->projector;
    solvedNumber_ = content.number;
    solvedFor_ = request;
  }
  return found;
}

bool EngineRenderer::isSolved(const ContentPicture& content, const RenderRequest& request) const {
  return set_->shadows && !solved_.empty() && solvedNumber_ == content.number &&
         solvedFor_.edition == request.edition && solvedFor_.viewer == request.viewer &&
         request.brightness == 1.0;
}

bool EngineRenderer::followShadows(const RenderRequest& request) {
  if (!set_->shadows) return false;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = now - std::exchange(shadowsAsked_, now);
  if (request.available != set_->available) {
    set_->available = request.available;
    engine::Availability all;
    for (const Size& size : calibration_.venue.transport.projectors().sizes())
      all.projectors.push_back(engine::completeGrid(size, std::max(size.width, size.height)));
    set_->shadows->aim(set_->available ? *set_->available : all, set_->content);
  }
  if (set_->shadows->advance(std::min(elapsed, mostOfAFade), set_->content)) backend_->availabilityFollowed();
  return !set_->shadows->isComplete();
}

void EngineRenderer::interrupt() {
  std::shared_ptr<Set> set;
  {
    const std::scoped_lock lock(guard_);
    set = set_;
  }
  if (set->still) set->still->interrupt();
}

std::vector<double> EngineRenderer::weightsFor(const std::optional<FrameViewer>& viewer) const {
  if (!set_->follower || !viewer) return {};
  return set_->follower->weightsFor(cameras_, set_->home, set_->rest, viewer->position, viewer->presence);
}

void EngineRenderer::follow(const std::optional<FrameViewer>& viewer) {
  if (!set_->follower || viewer == set_->followed) return;
  const std::vector<double> weights = weightsFor(viewer);
  set_->follower->follow(weights.empty() ? set_->rest : weights, set_->content);
  backend_->contentFollowed();
  set_->followed = viewer;
}

RenderedFrame EngineRenderer::framed(const ContentPicture& content, const RenderRequest& request) {
  Size size{content.image.width(), content.image.height()};
  require(size == set_->content.warp.content(), "content of {}x{} on a canvas of {}x{}", size.width,
          size.height, set_->content.warp.content().width, set_->content.warp.content().height);
  std::vector<float> linear;
  engine::ContentFrame frame{content.image.constBits(), size,
                             static_cast<std::size_t>(content.image.bytesPerLine()),
                             engine::ContentFrame::Format::rgba8};
  if (content.image.format() == QImage::Format_RGBX32FPx4) {
    linear.resize(3 * size.count());
    for (int y = 0; y < size.height; ++y) {
      auto* line = reinterpret_cast<const float*>(content.image.constScanLine(y));
      for (int x = 0; x < size.width; ++x) std::copy_n(line + 4 * x, 3, &linear[3 * indexOf(size, {x, y})]);
    }
    frame = {linear.data(), size, 12 * static_cast<std::size_t>(size.width),
             engine::ContentFrame::Format::linearFloat};
  }

  engine::FrameRequest wanted;
  wanted.compensated = request.compensated;
  wanted.steps = stepsFor(request);
  wanted.brightness = static_cast<float>(request.brightness);
  follow(request.viewer);
  // The same picture for somebody who has walked on: not from the beginning.
  wanted.fromLast = set_->follower && request.compensated && !request.thorough && content.number == number_ &&
                    last_.compensated &&
                    (request.viewer != last_.viewer || request.brightness != last_.brightness);
  if (wanted.fromLast) wanted.steps = std::max(wanted.steps, 1);
  const bool isShadowed = request.compensated && set_->shadows && !set_->shadows->isComplete();
  if (isShadowed && isSolved(content, request)) {
    // From the picture as it is without a shadow on: elsewhere it stays what it was.
    backend_->startFrom(solved_);
    wanted.fromLast = true;
    wanted.steps = std::max(wanted.steps, leastSteps);
  }
  const bool settled = !request.compensated || lightFor(frame, wanted);
  engine::FrameReport report;
  RenderedFrame rendered;
  rendered.drives = computed(frame, wanted, report);
  if (request.compensated && !request.thorough) budget_->add(report);
  number_ = content.number;
  last_ = request;

  rendered.clipped = report.clipped;
  rendered.steps = report.steps;
  rendered.settled = settled && (!set_->shadows || set_->shadows->settled());
  rendered.seconds = report.seconds.count();
  return rendered;
}

bool EngineRenderer::lightFor(const engine::ContentFrame& frame, engine::FrameRequest& request) {
  if (!set_->range && !set_->whites) return true;
  const auto now = std::chrono::steady_clock::now();
  const auto elapsed = now - std::exchange(lightAsked_, now);
  if (set_->whites) {
    request.field = &set_->whites->follow(frame, elapsed);
    return set_->whites->settled();
  }
  const engine::DisplayRange range = set_->range->follow(frame, elapsed);
  request.brightness *= range.brightness;
  request.blackLift = range.blackLift;
  return set_->range->settled();
}

std::vector<DrivePicture> EngineRenderer::computed(const engine::ContentFrame& frame,
                                                   const engine::FrameRequest& request,
                                                   engine::FrameReport& report) {
  if (backend_->sharesTextures()) {
    const std::vector<std::shared_ptr<CardPicture>> cards = cards_.next();
    std::vector<std::uint32_t> textures;
    for (const auto& card : cards) textures.push_back(card->texture());
    if (!cards.empty() && backend_->renderToTextures(frame, request, textures, report))
      return {cards.begin(), cards.end()};
  }
  // No room for textures, or the graphics card was lost in this frame.
  if (!backend_->render(frame, request, words_, report))
    throw Error(
        ErrorKind::device, RELUCENT_MESSAGE("show.engine-lost-device", "the engine lost its graphics card"),
        RELUCENT_MESSAGE("show.start-show-again", "start the show again"), std::string(backend_->name()));
  return drives();
}

RenderedFrame EngineRenderer::encoded(const compensation::Compensation& solved, double seconds) {
  const Rasters& projectors = calibration_.venue.transport.projectors();
  const std::vector<QImage> pictures = drivePictures(solved.projector, projectors, venue_->encoders);
  return {{pictures.begin(), pictures.end()}, solved.clipped, solved.iterations, seconds};
}

std::vector<DrivePicture> EngineRenderer::drives() const {
  const Rasters& projectors = calibration_.venue.transport.projectors();
  std::vector<DrivePicture> images;
  for (std::size_t i = 0; i < projectors.devices(); ++i) {
    Size drive = projectors.size(i);
    QImage image(drive.width, drive.height, QImage::Format_RGBX8888);
    for (int y = 0; y < drive.height; ++y)
      std::memcpy(image.scanLine(y), &words_[projectors.offset(i) + indexOf(drive, {0, y})],
                  4 * static_cast<std::size_t>(drive.width));
    images.emplace_back(std::move(image));
  }
  return images;
}

}  // namespace relucent::gui
