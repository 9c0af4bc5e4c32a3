// SPDX-License-Identifier: MIT
#include "wizard/threshold_page.h"

#include "views/number_text.h"

namespace relucent {
namespace {

constexpr double suggestedShare = 0.995;
constexpr double leastKept = 0.95;

}  // namespace

ThresholdPage::ThresholdPage(Session& session, QObject* parent)
    : PageModel(parent),
      session_(session),
      statistics_(
          [this](TransportStatistics statistics) {
            kept_ = statistics;
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, {}, {}, {}});
          }),
      first_(
          [this](TransportStatistics statistics) {
            whole_ = statistics;
            suggested_ = cutKeeping(statistics.histogram, suggestedShare);
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, {}, {}, {}});
          }),
      looking_(
          [this](std::shared_ptr<const PixelFootprint> footprint) {
            footprint_ = std::move(footprint);
            Q_EMIT changed();
          },
          [this](const Failure& failure) {
            Q_EMIT failed({failure, {}, {}, {}});
          }) {
  connect(&session_, &Session::opened, this, [this] {
    cut_ = session_.settings().threshold;
    shareOfRow_ = cut_.shareOfRowMax > 0.0f;
    picked_.reset();
    footprint_ = nullptr;
  });
  connect(&session_, &Session::changed, this, [this] {
    adopt();
    Q_EMIT changed();
  });
}

void ThresholdPage::adopt() {
  if (session_.acquisition() == adopted_) return;
  adopted_ = session_.acquisition();
  whole_.reset();
  kept_.reset();
  if (!adopted_) return;
  first_.ask([acquisition = adopted_] { return statisticsOf(acquisition->transport); });
  compute();
}

void ThresholdPage::compute() {
  if (adopted_)
    statistics_.ask(
        [acquisition = adopted_, cut = cut_] { return statisticsOf(acquisition->transport, cut); });
  Q_EMIT changed();
}

StepStatus ThresholdPage::status() const {
  switch (session_.progress(Step::threshold)) {
    case StepProgress::done:
      return {StepState::done,
              tr("%1 of light kept")
                  .arg(percentText(session_.result(Step::threshold)->values.value("kept", 1.0)))};
    case StepProgress::stale:
      return {StepState::outOfDate, tr("Out of date")};
    case StepProgress::open:
      break;
  }
  return {};
}

QString ThresholdPage::hint() const {
  if (session_.acquisitionFailure()) return session_.acquisitionFailure()->what;
  if (!whole_ || !kept_) return tr("Reading the light transport");
  if (kept_->energyKept < leastKept) return tr("Below 95 % of the light, bounces are lost.");
  return tr("Next: groups of pixels that can be solved on their own");
}

Command ThresholdPage::primary() const {
  auto* self = const_cast<ThresholdPage*>(this);
  return {tr("Group into clusters"), Icon::next, kept_.has_value(), {}, [self] { self->accept(); }};
}

std::optional<Banner> ThresholdPage::banner() const {
  if (session_.progress(Step::threshold) != StepProgress::stale) return std::nullopt;
  return Banner{Banner::Kind::amber,
                tr("The threshold was chosen for an earlier measurement"),
                tr("Look at it again, then go on."),
                {},
                {}};
}

void ThresholdPage::setShareOfRow(bool share) {
  shareOfRow_ = share;
  // One way at a time; the other one drops nothing.
  if (share)
    cut_.absolute = 0.0f;
  else
    cut_.shareOfRowMax = 0.0f;
  compute();
}

void ThresholdPage::setAbsolute(double cut) {
  shareOfRow_ = false;
  cut_.shareOfRowMax = 0.0f;
  cut_.absolute = static_cast<float>(cut);
  compute();
}

void ThresholdPage::setShare(double share) {
  shareOfRow_ = true;
  cut_.absolute = 0.0f;
  cut_.shareOfRowMax = static_cast<float>(share);
  compute();
}

void ThresholdPage::pick(Pixel pixel) {
  if (!adopted_) return;
  picked_ = pixel;
  std::size_t row = indexOf(adopted_->transport.cameras().size(0), pixel);
  looking_.ask([acquisition = adopted_, row]() -> std::shared_ptr<const PixelFootprint> {
    return std::make_shared<PixelFootprint>(footprintOf(acquisition->transport, row));
  });
  Q_EMIT changed();
}

void ThresholdPage::accept() {
  try {
    CalibrateSettings settings = session_.settings();
    settings.threshold = cut_;
    session_.changeSettings(settings);
    session_.decide(Step::threshold, Json{{"kept", kept_->energyKept}, {"leaves", kept_->leaves}});
    Q_EMIT nextWanted();
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe."), {}, {}});
  }
}

}  // namespace relucent
