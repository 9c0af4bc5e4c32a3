// SPDX-License-Identifier: MIT
#include "wizard/threshold/threshold_page.h"

#include <algorithm>
#include <cmath>

#include "relucent/calibration/results.h"
#include "relucent/transport/cut_estimate.h"
#include "relucent/transport/noise_cut.h"
#include "views/number_text.h"
#include "wizard/devices/on_measurement.h"

namespace relucent::gui {
namespace {

constexpr double suggestedShare = 0.995;
constexpr double leastKept = 0.95;

bool isSame(const transport::ThresholdSettings& a, const transport::ThresholdSettings& b) {
  return a.absolute == b.absolute && a.shareOfRowMax == b.shareOfRowMax && a.energyKept == b.energyKept;
}

bool keepsEverything(const transport::ThresholdSettings& cut) {
  return !(cut.absolute > 0.0f) && !(cut.shareOfRowMax > 0.0f) && !(cut.energyKept < 1.0f);
}

}  // namespace

ThresholdPage::ThresholdPage(Session& session, QObject* parent)
    : DevicePage(stepName, session, parent),
      statistics_(
          [this](transport::TransportStatistics statistics) {
            // Lowered to nothing meanwhile, the cut leaves everything.
            if (!keepsEverything(cut_)) kept_ = statistics;
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }),
      first_(
          [this](transport::TransportStatistics statistics) {
            whole_ = statistics;
            if (keepsEverything(cut_)) kept_ = statistics;
            suggest(statistics);
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }),
      looking_(
          [this](std::shared_ptr<const transport::PixelFootprint> footprint) {
            if (!adopted_ || !picked_ ||
                footprint->luminance.size() != adopted_->transport.projectors().count())
              return;
            footprint_ = std::move(footprint);
            // Not the answer of before, while a newer one is on its way.
            if (!looking_.isBusy() && std::exchange(follows_, false)) followFootprint();
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }),
      lighting_(
          [this](std::shared_ptr<const std::vector<float>> lit) {
            if (!adopted_ || !pickedProjector_ || lit->size() != adopted_->transport.cameras().count())
              return;
            lit_ = std::move(lit);
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }),
      picturing_(
          [this](std::shared_ptr<const transport::MatrixPictures> matrix) {
            if (!adopted_ || &matrix->transport() != &adopted_->transport) return;
            matrix_ = std::move(matrix);
            tellResult();
          },
          [this](const Failure& failure) { Q_EMIT failed({failure, {}}); }),
      lightening_(
          [this](Floodlights read) {
            if (read.first != floodlights_.first) return;
            floodlights_ = std::move(read);
            tellResult();
          },
          // The whole measurement, which is read as well, tells what is wrong.
          [](const Failure&) {}) {
  accept_ = addCommand(Icon::next, [this] { accept(); });
  goOnMeasuring_ = addCommand(Icon::play, [this] { Q_EMIT stepWanted("acquire"); });
  if (session_.isOpen()) takeSettings();
  connect(&session_, &Session::opened, this, [this] {
    takeSettings();
    forget();
  });
  connect(&session_, &Session::devicesChanged, this, &ThresholdPage::tellStatus);
  for (auto signal : {&Session::stepsChanged, &Session::acquisitionChanged})
    connect(&session_, signal, this, [this] {
      if (isLookedAt_) wantMeasurement();
      adopt();
      tellAll();
    });
  updateCommands();
}

void ThresholdPage::enter() {
  isLookedAt_ = true;
  wantMeasurement();
}

void ThresholdPage::wantMeasurement() {
  session_.wantAcquisition();
  if (session_.measurement() == floodlights_.first) return;
  floodlights_ = {session_.measurement(), nullptr};
  if (floodlights_.first.empty()) return;
  lightening_.ask([name = floodlights_.first,
                   stored = *session_.result(calibration::Stage::acquisition)]() -> Floodlights {
    return {name, std::make_shared<const std::vector<image::Image>>(calibration::loadFlood(stored))};
  });
}

bool ThresholdPage::isChanged() const {
  return session_.progress(calibration::Stage::threshold) != calibration::StageProgress::open &&
         !isSame(cut_, session_.settings().threshold);
}

void ThresholdPage::takeSettings() {
  cut_ = session_.settings().threshold;
  shareOfPixel_ = cut_.shareOfRowMax > 0.0f;
  absoluteBefore_ = shareBefore_ = 0.0f;
}

void ThresholdPage::adopt() {
  if (session_.acquisition() == adopted_) return;
  adopted_ = session_.acquisition();
  whole_.reset();
  kept_.reset();
  matrix_ = nullptr;
  forget();
  if (!adopted_) return;
  first_.ask([acquisition = adopted_] { return transport::statisticsOf(acquisition->transport); });
  compute();
}

void ThresholdPage::compute() {
  if (adopted_) {
    if (whole_ && keepsEverything(cut_)) kept_ = whole_;
    if (!keepsEverything(cut_)) {
      if (whole_ && !shareOfPixel_)
        kept_ = transport::estimatedAfterCut(*whole_, static_cast<double>(cut_.absolute));
      statistics_.ask([acquisition = adopted_, cut = cut_] {
        return transport::statisticsOf(acquisition->transport, cut);
      });
    }
    picturing_.ask(
        [acquisition = adopted_, cut = cut_]() -> std::shared_ptr<const transport::MatrixPictures> {
          std::shared_ptr<const transport::TransportMatrix> transport(acquisition, &acquisition->transport);
          return std::make_shared<transport::MatrixPictures>(transport, cut);
        });
  }
  tellAll();
}

bool ThresholdPage::isStrongestKept() const {
  if (!isExact() || shareOfPixel_) return false;
  for (std::size_t bin = 0; bin < transport::StrengthHistogram::bins; ++bin)
    if (kept_->histogram.leaves[bin] > 0 &&
        transport::strengthOfBin(bin + 1) <= static_cast<double>(cut_.absolute))
      return true;
  return false;
}

StepStatus ThresholdPage::status() const {
  switch (session_.progress(calibration::Stage::threshold)) {
    case calibration::StageProgress::done:
      return {doneOn(session_),
              tr("%1 of light kept")
                  .arg(percentText(session_.figures<calibration::Stage::threshold>()->energyKept))};
    case calibration::StageProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case calibration::StageProgress::open:
      break;
  }
  return {};
}

QString ThresholdPage::whyNothing() const {
  const auto& failure = session_.acquisitionFailure();
  return failure ? failure->what : tr("Reading the light transport");
}

QString ThresholdPage::hint() const {
  if (session_.acquisitionFailure() || !whole_ || !kept_) return whyNothing();
  if (const QString why = whyLocked(); !why.isEmpty()) return why;
  if (kept_->energyKept < leastKept) return tr("Below 95 % of the light, bounces are lost.");
  if (isChanged()) return tr("Changed: it is applied as soon as you go on.");
  return tr("Next: groups of pixels that can be solved on their own");
}

void ThresholdPage::updateCommands() {
  goOnMeasuring_->show(toAcquireText(session_));
  accept_->show(tr("Group into clusters"), kept_.has_value() && whyLocked().isEmpty());
}

std::optional<Banner> ThresholdPage::banner() const {
  if (session_.progress(calibration::Stage::threshold) != calibration::StageProgress::stale)
    return onMeasurement(session_, goOnMeasuring_);
  return Banner{Banner::Kind::amber, tr("The threshold was chosen for an earlier measurement"),
                tr("Look at it again, then go on.")};
}

/// One way at a time; the other one drops nothing, and is found again as it was left.
void ThresholdPage::setShareOfPixel(bool share) {
  if (share == shareOfPixel_) return;
  Choice after{cut_, share};
  if (share) {
    absoluteBefore_ = std::exchange(after.cut.absolute, 0.0f);
    after.cut.shareOfRowMax = shareBefore_;
  } else {
    shareBefore_ = std::exchange(after.cut.shareOfRowMax, 0.0f);
    after.cut.absolute = absoluteBefore_;
  }
  change(tr("Kind of cut"), after);
}

void ThresholdPage::setAbsolute(double cut) {
  Choice after{cut_, false};
  after.cut.shareOfRowMax = 0.0f;
  after.cut.absolute = static_cast<float>(cut);
  change(tr("Cut"), after);
}

void ThresholdPage::change(const QString& what, const Choice& after) {
  if (isSame(after.cut, cut_) && after.isShareOfPixel == shareOfPixel_) return tellSettings();
  changeUndoably(what, Choice{cut_, shareOfPixel_}, after, [this](const Choice& choice) { take(choice); });
}

void ThresholdPage::take(const Choice& choice) {
  cut_ = choice.cut;
  shareOfPixel_ = choice.isShareOfPixel;
  compute();
}

/// Noise is left out, light is not.
void ThresholdPage::suggest(const transport::TransportStatistics& whole) {
  const double most = transport::cutKeeping(whole.histogram, suggestedShare),
               noise = adopted_ ? transport::noiseCut(*adopted_) : 0.0;
  noise_.reset();
  if (noise > 0.0) noise_ = {noise, transport::estimatedAfterCut(whole, noise).energyKept};
  suggested_ = noise > most ? 0.0 : noise > 0.0 ? noise : most;
}

std::optional<double> ThresholdPage::pickedLight() const {
  const std::optional<std::size_t> column = pickedColumn();
  if (!footprint_ || !column || *column >= footprint_->luminance.size()) return std::nullopt;
  const auto light = static_cast<double>(footprint_->luminance[*column]);
  return light > 0.0 ? std::optional(light) : std::nullopt;
}

void ThresholdPage::usePicked() {
  if (const std::optional<double> light = pickedLight()) setAbsolute(*light);
}

void ThresholdPage::setShare(double share) {
  Choice after{cut_, true};
  after.cut.absolute = 0.0f;
  after.cut.shareOfRowMax = static_cast<float>(share);
  change(tr("Cut"), after);
}

void ThresholdPage::forget() {
  picked_.reset();
  pickedProjector_.reset();
  footprint_ = nullptr;
  lit_ = nullptr;
  follows_ = false;
}

void ThresholdPage::pick(Pixel pixel) {
  if (!adopted_) return;
  picked_ = pixel;
  follows_ = true;
  lookAtRow();
  tellResult();
}

void ThresholdPage::pickProjector(Pixel pixel) {
  if (!adopted_) return;
  pickedProjector_ = pixel;
  follows_ = false;
  lookAtColumn();
  tellResult();
}

void ThresholdPage::pickEntry(std::size_t row, std::size_t column) {
  if (!adopted_) return;
  const Rasters &cameras = adopted_->transport.cameras(), &projectors = adopted_->transport.projectors();
  if (row >= cameras.count() || column >= projectors.count()) return;
  showCamera(transport::deviceOfPixel(cameras, row));
  showProjector(transport::deviceOfPixel(projectors, column));
  picked_ = pixelAt(cameras.size(camera()), row - cameras.offset(camera()));
  pickedProjector_ = pixelAt(projectors.size(projector()), column - projectors.offset(projector()));
  follows_ = false;
  lookAtRow();
  lookAtColumn();
  tellResult();
}

std::optional<std::size_t> ThresholdPage::pickedRow() const {
  if (!adopted_ || !picked_) return std::nullopt;
  const Rasters& cameras = adopted_->transport.cameras();
  return cameras.offset(camera()) + indexOf(cameras.size(camera()), *picked_);
}

std::optional<std::size_t> ThresholdPage::pickedColumn() const {
  if (!adopted_ || !pickedProjector_) return std::nullopt;
  const Rasters& projectors = adopted_->transport.projectors();
  return projectors.offset(projector()) + indexOf(projectors.size(projector()), *pickedProjector_);
}

void ThresholdPage::lookAtRow() {
  looking_.ask([acquisition = adopted_,
                row = *pickedRow()]() -> std::shared_ptr<const transport::PixelFootprint> {
    return std::make_shared<transport::PixelFootprint>(transport::footprintOf(acquisition->transport, row));
  });
}

void ThresholdPage::lookAtColumn() {
  lighting_.ask(
      [acquisition = adopted_, column = *pickedColumn()]() -> std::shared_ptr<const std::vector<float>> {
        return std::make_shared<std::vector<float>>(transport::lightOfPixel(acquisition->transport, column));
      });
}

/// The pixel of the shown projector that lights the picked camera pixel most, if any does.
void ThresholdPage::followFootprint() {
  const Rasters& projectors = adopted_->transport.projectors();
  const std::optional<std::size_t> strongest =
      transport::strongestPixel(*footprint_, projectors, projector());
  if (!strongest) return;
  pickedProjector_ = pixelAt(projectors.size(projector()), *strongest);
  lookAtColumn();
}

/// The camera pixel stays, and is looked at from the other projector.
void ThresholdPage::projectorChanged() {
  pickedProjector_.reset();
  lit_ = nullptr;
  if (footprint_ && !looking_.isBusy()) followFootprint();
}

/// What the projector's pixel lights is seen by the other camera as well; the camera's pixel is not there.
void ThresholdPage::cameraChanged() {
  picked_.reset();
  footprint_ = nullptr;
  follows_ = false;
}

void ThresholdPage::accept() {
  if (keepCut()) Q_EMIT nextWanted();
}

bool ThresholdPage::keepCut() {
  try {
    pipeline::CalibrateSettings settings = session_.settings();
    settings.threshold = cut_;
    session_.changeSettings(settings);
    session_.decide(calibration::ThresholdResult{kept_->energyKept, kept_->leaves});
    return true;
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe.")});
    return false;
  }
}

}  // namespace relucent::gui
