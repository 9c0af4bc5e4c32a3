// SPDX-License-Identifier: MIT
#include "output/engine_renderer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "output/drive_pictures.h"
#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/proof_record.h"
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
    : canvas_(wanted.canvas) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(wanted.calibration, calibration::CalibrationFolder::Access::read);
  calibration_ = pipeline::loadCalibration(folder, progress);
  engine::EngineSettings settings;
  pipeline::CalibrateSettings chosen = pipeline::settingsOf(folder);
  settings.target = targetOf(chosen.content);
  if (wanted.brightness) settings.target.brightness = *wanted.brightness;
  // Both at once would brighten twice.
  if (wanted.adaptiveRange) settings.target.brightness = compensation::Brightness::even;
  venue_.emplace(engine::prepareVenue(calibration_.venue, calibration_.inverse,
                                      calibration_.linearization.projectors, settings));
  content_ = engine::prepareContent(*venue_, {canvas_.size.width(), canvas_.size.height()});
  backend_ = engine::makeBackend(*venue_, wanted.backend, notify, host);
  backend_->setContent(*content_);
  if (wanted.adaptiveRange) range_.emplace(*venue_, *content_);
  if (settings.target.brightness != compensation::Brightness::even)
    whites_.emplace(*venue_, *content_, settings.target.brightness);
  const std::size_t views = calibration_.venue.transport.cameras().devices();
  checkCount(wanted.cameras, views);
  if (views > 1)
    cameras_ = wanted.cameras.empty() ? positionsOf(settings.target.views, views) : wanted.cameras;
  for (std::size_t view = 0; view < views; ++view)
    home_.push_back(view < settings.target.views.size() ? settings.target.views[view].weight : 1.0);
  rest_.assign(content_->viewWeight.begin(), content_->viewWeight.end());
  if (!cameras_.empty()) follower_.emplace(*venue_, *content_);
  if (wanted.fillsShadows) shadows_.emplace(*venue_);
  const compensation::Method method = chosen.content.method;
  // A range that follows the content is the engine's.
  if (!wanted.adaptiveRange || method != compensation::Method::refined)
    still_ = std::make_unique<StillSolver>(calibration_, settings.target, chosen.clustering, method);
  if (still_ && settings.target.brightness == chosen.content.brightness)
    perfected_.emplace(wanted.calibration, pipeline::fingerprintOfShown(folder),
                       calibration_.venue.transport.projectors(), notify);
  words_.resize(calibration_.venue.transport.projectors().count());
  cards_ = CardPictures(EngineRenderer::projectors());
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
  // Light that does not arrive is the engine's: no still is solved without it.
  if (request.compensated && followShadows(request)) {
    if (still_ && request.thorough && request.brightness == 1.0 && !isSolved(content, request))
      solve(content, request, outdated);
    return framed(content, request);
  }
  // Brightness is the engine's. After a shadow a still is at once what it was before.
  if (!still_ || !(request.thorough || isSolved(content, request)) || !request.compensated ||
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
  if (follower_) {
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
  if (perfected_ && !request.viewer) found.solved = perfected_->of(content, request.edition);
  found.isPerfected = found.solved != nullptr;
  if (!found.isPerfected) found.solved = still_->solve(content, outdated, weightsFor(request.viewer));
  if (shadows_ && found.solved != nullptr) {
    solved_ = found.solved->projector;
    solvedNumber_ = content.number;
    solvedFor_ = request;
  }
  return found;
}

bool EngineRenderer::isSolved(const ContentPicture& content, const RenderRequest& request) const {
  return shadows_ && !solved_.empty() && solvedNumber_ == content.number &&
         solvedFor_.edition == request.edition && solvedFor_.viewer == request.viewer &&
         request.brightness == 1.0;
}

bool EngineRenderer::followShadows(const RenderRequest& request) {
  if (!shadows_) return false;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = now - std::exchange(shadowsAsked_, now);
  if (request.available != available_) {
    available_ = request.available;
    engine::Availability all;
    for (const Size& size : calibration_.venue.transport.projectors().sizes())
      all.projectors.push_back(engine::completeGrid(size, std::max(size.width, size.height)));
    shadows_->aim(available_ ? *available_ : all, *content_);
  }
  if (shadows_->advance(std::min(elapsed, mostOfAFade), *content_)) backend_->availabilityFollowed();
  return !shadows_->isComplete();
}

void EngineRenderer::interrupt() {
  if (still_) still_->interrupt();
}

std::vector<double> EngineRenderer::weightsFor(const std::optional<FrameViewer>& viewer) const {
  if (!follower_ || !viewer) return {};
  return follower_->weightsFor(cameras_, home_, rest_, viewer->position, viewer->presence);
}

void EngineRenderer::follow(const std::optional<FrameViewer>& viewer) {
  if (!follower_ || viewer == followed_) return;
  const std::vector<double> weights = weightsFor(viewer);
  follower_->follow(weights.empty() ? rest_ : weights, *content_);
  backend_->contentFollowed();
  followed_ = viewer;
}

RenderedFrame EngineRenderer::framed(const ContentPicture& content, const RenderRequest& request) {
  Size size{content.image.width(), content.image.height()};
  require(size == content_->warp.content(), "content of {}x{} on a canvas of {}x{}", size.width, size.height,
          content_->warp.content().width, content_->warp.content().height);
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
  wanted.fromLast = follower_ && request.compensated && !request.thorough && content.number == number_ &&
                    last_.compensated &&
                    (request.viewer != last_.viewer || request.brightness != last_.brightness);
  if (wanted.fromLast) wanted.steps = std::max(wanted.steps, 1);
  const bool isShadowed = request.compensated && shadows_ && !shadows_->isComplete();
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
  rendered.settled = settled && (!shadows_ || shadows_->settled());
  rendered.seconds = report.seconds.count();
  return rendered;
}

bool EngineRenderer::lightFor(const engine::ContentFrame& frame, engine::FrameRequest& request) {
  if (!range_ && !whites_) return true;
  const auto now = std::chrono::steady_clock::now();
  const auto elapsed = now - std::exchange(lightAsked_, now);
  if (whites_) {
    request.field = &whites_->follow(frame, elapsed);
    return whites_->settled();
  }
  const engine::DisplayRange range = range_->follow(frame, elapsed);
  request.brightness *= range.brightness;
  request.blackLift = range.blackLift;
  return range_->settled();
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
