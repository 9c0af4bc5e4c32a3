// SPDX-License-Identifier: MIT
#include "jobs/live_rig.h"

#include <QScopeGuard>
#include <algorithm>
#include <utility>

namespace relucent::gui {
namespace {

template <typename Device>
Device& at(std::vector<Device>& devices, std::size_t index) {
  if (devices.size() <= index) devices.resize(index + 1);
  return devices[index];
}

constexpr std::chrono::seconds patience{3};
constexpr std::size_t rememberedArrivals = 8;

// Beyond this much of the range a sample says little; of a floodlight image some may: lamps, gloss.
constexpr float clipped = 0.98f;
constexpr double mostClipped = 0.02;

double clippedShare(const image::Image& signal) {
  const std::vector<float>& samples = signal.data();
  auto count = std::count_if(samples.begin(), samples.end(), [](float value) { return value > clipped; });
  return static_cast<double>(count) / static_cast<double>(samples.size());
}

}  // namespace

LiveRig::LiveRig(int interval) : interval_(interval) {}

void LiveRig::beforeShowing(std::size_t, rig::RigLight& light) {
  QMutexLocker lock(&guard_);
  while (paused_) pauseInTheDark(light, lock);
  // Resuming ends no wait but a pause.
  auto left = [&] { return shownLast_.isValid() ? leastBetween_ - shownLast_.elapsed() : 0; };
  for (qint64 wait = left(); wait > 0; wait = left())
    resumed_.wait(&guard_, static_cast<unsigned long>(wait));
  shownLast_.start();
}

/// Unlocked while the light changes: a window shows it once the interface's thread comes to it, which may be
/// about to read from here.
void LiveRig::pauseInTheDark(rig::RigLight& light, QMutexLocker<QMutex>& lock) {
  pausedSince_ = now_();
  const auto over = qScopeGuard([this] { pauses_ += now_() - *std::exchange(pausedSince_, std::nullopt); });
  lock.unlock();
  const auto locked = qScopeGuard([&lock] { lock.relock(); });
  light.darken();
  lock.relock();
  while (paused_) resumed_.wait(&guard_);
  lock.unlock();
  light.restore();
}

void LiveRig::setLeastInterval(int milliseconds) {
  QMutexLocker lock(&guard_);
  leastBetween_ = milliseconds;
}

void LiveRig::shown(std::size_t index, const image::Image& encodedDrive) {
  QMutexLocker lock(&guard_);
  Shown& shown = at(projectors_, index);
  at(patterns_, index) = encodedDrive;
  const std::vector<float>& drive = encodedDrive.data();
  shown.dark = std::all_of(drive.begin(), drive.end(), [](float value) { return !(value > 0.0f); });
  shown.white =
      !drive.empty() && std::all_of(drive.begin(), drive.end(), [](float value) { return value >= 1.0f; });
}

void LiveRig::beforePhotographing(std::size_t index, const rig::CaptureRequest& request) {
  QMutexLocker lock(&guard_);
  const auto exposure =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(request.seconds));
  at(asked_, index) = Asked{now_(), exposure};
}

void LiveRig::afterPhotographing(std::size_t index) noexcept {
  QMutexLocker lock(&guard_);
  arrived_ = now_() - asked_[index]->when - asked_[index]->exposure;
  asked_[index].reset();
}

void LiveRig::setClock(std::function<Clock::time_point()> now) {
  QMutexLocker lock(&guard_);
  now_ = std::move(now);
}

void LiveRig::waitAnew() {
  QMutexLocker lock(&guard_);
  for (std::optional<Asked>& asked : asked_)
    if (asked) asked->when = now_();
}

LiveRig::Clock::duration LiveRig::paused() const {
  QMutexLocker lock(&guard_);
  return pauses_ + (pausedSince_ ? now_() - *pausedSince_ : Clock::duration{});
}

std::optional<std::size_t> LiveRig::silentCamera() const {
  return silentCamera(now_());
}

std::optional<std::size_t> LiveRig::silentCamera(Clock::time_point now) const {
  QMutexLocker lock(&guard_);
  const Clock::duration usual = usualArrival();
  const auto silent = std::ranges::find_if(asked_, [&](const std::optional<Asked>& asked) {
    return asked && now - asked->when > asked->exposure + patience + 2 * usual;
  });
  if (silent == asked_.end()) return std::nullopt;
  return static_cast<std::size_t>(silent - asked_.begin());
}

/// Contract: guard_ is held.
LiveRig::Clock::duration LiveRig::usualArrival() const {
  if (arrivals_.empty()) return {};
  std::vector<Clock::duration> sorted(arrivals_.begin(), arrivals_.end());
  std::ranges::sort(sorted, std::greater());
  return sorted[sorted.size() > 1 ? 1 : 0];
}

LiveRig::Taken LiveRig::taken(const std::string& stage) const {
  QMutexLocker lock(&guard_);
  const auto found = taken_.find(stage);
  return found == taken_.end() ? Taken() : found->second;
}

int LiveRig::photographs() const {
  QMutexLocker lock(&guard_);
  return photographs_;
}

void LiveRig::photographed(std::size_t index, const rig::CaptureRequest& request,
                           const rig::RawFrame& frame) {
  {
    QMutexLocker lock(&guard_);
    ++photographs_;
    Taken& taken = taken_[request.shot.stage];
    taken = {taken.photographs + 1, request.shot.number};
    arrivals_.push_back(arrived_);
    if (arrivals_.size() > rememberedArrivals) arrivals_.pop_front();
    Photographed& photographed = at(cameras_, index);
    photographed.frame = frame;
    photographed.request = request;
    if (isFloodlit()) {
      // Where every exposure is too bright for parts of it, the least one.
      const double share = clippedShare(frame.signal);
      Floodlight& floodlight = photographed.floodlight;
      if (floodlight.number == 0 || share <= std::max(mostClipped, floodlight.clipped))
        floodlight = {frame.signal, photographs_, share};
    }
    if (index == 0) ramps_.add(patterns_, frame);
    dark_.add(index, patterns_, frame);
    if (since_.isValid() && since_.elapsed() < interval_) return;
    since_.start();
  }
  Q_EMIT seen();
}

LivePictures LiveRig::pictures(std::size_t projector, std::size_t camera) const {
  QMutexLocker lock(&guard_);
  LivePictures live;
  if (projector < patterns_.size()) live.pattern = patterns_[projector];
  if (camera < cameras_.size()) {
    live.frame = cameras_[camera].frame;
    live.request = cameras_[camera].request;
  }
  live.photographs = photographs_;
  return live;
}

/// Contract: guard_ is held.
bool LiveRig::isFloodlit() const {
  return std::any_of(projectors_.begin(), projectors_.end(), [](const Shown& s) { return s.white; }) &&
         std::all_of(projectors_.begin(), projectors_.end(),
                     [](const Shown& s) { return s.white || s.dark; });
}

LiveRig::Floodlight LiveRig::floodlight(std::size_t camera) const {
  QMutexLocker lock(&guard_);
  return camera < cameras_.size() ? cameras_[camera].floodlight : Floodlight();
}

int LiveRig::floodlightNumber(std::size_t camera) const {
  QMutexLocker lock(&guard_);
  return camera < cameras_.size() ? cameras_[camera].floodlight.number : 0;
}

std::array<std::map<double, double>, 3> LiveRig::ramps(std::size_t projector) const {
  QMutexLocker lock(&guard_);
  return ramps_.curves(projector);
}

void LiveRig::forgetRamps() {
  QMutexLocker lock(&guard_);
  ramps_ = {};
  dark_.forget();
}

bool LiveRig::isDark() const {
  QMutexLocker lock(&guard_);
  return dark_.last();
}

void LiveRig::pause() {
  QMutexLocker lock(&guard_);
  paused_ = true;
}

void LiveRig::resume() {
  QMutexLocker lock(&guard_);
  paused_ = false;
  resumed_.wakeAll();
}

bool LiveRig::isPaused() const {
  QMutexLocker lock(&guard_);
  return paused_;
}

}  // namespace relucent::gui
