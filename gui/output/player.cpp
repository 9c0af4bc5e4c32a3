// SPDX-License-Identifier: MIT
#include "output/player.h"

#include <QScreen>
#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr ContentTime standsStill{500'000};
// For whoever looks at the figures: pictures that follow each other more slowly are stills.
constexpr ContentTime stillFor{2'000'000};
constexpr int overlayInterval = 500;      // milliseconds
constexpr double windowSeconds = 5.0;     // over which the statistics are taken
constexpr std::size_t mostRecent = 1500;  // frames in that time, at the quickest displays' rates

ContentTime microseconds(const QElapsedTimer& timer) {
  return std::chrono::duration_cast<ContentTime>(std::chrono::nanoseconds(timer.nsecsElapsed()));
}

double secondsSince(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// The shortest time between two pictures that any of the displays shows.
double refreshSeconds(const std::vector<ProjectorWindow*>& windows) {
  double rate = 60.0;
  for (const ProjectorWindow* window : windows)
    if (window->isShining() && window->screen()->refreshRate() > 1.0)
      rate = std::max(rate, window->screen()->refreshRate());
  return 1.0 / rate;
}

}  // namespace

Player::Player(std::unique_ptr<FrameRenderer> renderer, std::shared_ptr<ContentSource> content,
               std::vector<ProjectorWindow*> windows, ContentClock clock, QObject* parent)
    : QObject(parent),
      renderer_(std::move(renderer)),
      content_(std::move(content)),
      windows_(std::move(windows)),
      clock_(std::move(clock)),
      cameras_(renderer_->cameras()) {
  require(windows_.size() == renderer_->projectors().size(), "{} windows for {} projectors", windows_.size(),
          renderer_->projectors().size());
  pace_.setTimerType(Qt::PreciseTimer);
  pace_.setSingleShot(true);
  connect(&pace_, &QTimer::timeout, this, &Player::beginFrame);
  overlayed_.setInterval(overlayInterval);
  connect(&overlayed_, &QTimer::timeout, this, &Player::present);
  connect(&working_, &QFutureWatcherBase::finished, this, &Player::frameReady);
  connect(&preparing_, &QFutureWatcherBase::finished, this, &Player::setPrepared);
  for (ProjectorWindow* window : windows_) {
    connect(window, &ProjectorWindow::keyPressed, this, [this](int key) { handleKey(key); });
    connect(window, &ProjectorWindow::dragged, this,
            [this](double right, double up) { walk({right, up, 0.0}); });
    connect(window, &ProjectorWindow::displayFound, this, &Player::present);
  }
}

Player::~Player() {
  working_.disconnect(this);
  preparing_.disconnect(this);
  renderer_->interrupt();
  working_.waitForFinished();
  preparing_.waitForFinished();
}

void Player::start() {
  if (playing_) return;
  playing_ = true;
  moved_.reset();
  clock_.resume();
  running_.start();
  beginFrame();
}

void Player::stop() {
  playing_ = false;
  pace_.stop();
  renderer_->interrupt();
  clock_.pause();
  last_ = {};
  present();
}

void Player::next() {
  // Begun one refresh after the frame before it, whatever that took: the display's own wait is in its swap.
  double left = refreshSeconds(windows_) - 1e-9 * static_cast<double>(begun_.nsecsElapsed());
  pace_.start(std::max(0, static_cast<int>(std::floor(1e3 * left))));
}

void Player::beginFrame() {
  if (!playing_ || working_.isRunning()) return;
  begun_.start();
  ContentTime time = clock_.time();
  request_.seconds = refreshSeconds(windows_);
  request_.viewer = viewer();
  following_ = std::exchange(moved_, std::nullopt);
  working_.setFuture(startedInBackground([renderer = renderer_, content = chart_ ? chartContent_ : content_,
                                          request = request_, clock = clock_, time, last = last_]() -> Frame {
    ContentPicture picture = content->at(time);
    if (picture.image.isNull()) return {};
    bool same = picture.number == last.content && request.compensated == last.request.compensated &&
                request.brightness == last.request.brightness && request.viewer == last.request.viewer &&
                request.available == last.request.available && request.set == last.request.set &&
                !last.rendered.drives.empty();
    bool rests = same && last.rendered.settled;
    if (rests && request.edition == last.request.edition &&
        (last.request.thorough || time - last.since < standsStill))
      return last;
    RenderRequest wanted = request;
    wanted.thorough = rests;
    Outdated outdated = [&] { return content->at(clock.time()).number != picture.number; };
    return {picture.number, same ? last.since : time, wanted, renderer->render(picture, wanted, outdated),
            picture.arrived};
  }));
}

void Player::frameReady() {
  if (!playing_) return;
  try {
    Frame frame = resultOf(working_.future());
    bool fresh = frame.content != last_.content || frame.request != last_.request || !last_.rendered.settled;
    const bool isNew = frame.content != last_.content;
    const bool isOfAnother = frame.request.set != last_.request.set;
    last_ = std::move(frame);
    if (fresh) {
      ++frames_;
      late_ += !last_.request.thorough &&
               1e-9 * static_cast<double>(begun_.nsecsElapsed()) > refreshSeconds(windows_);
      present();
      const ContentTime now = microseconds(running_);
      const double waited = following_ ? 1e-6 * static_cast<double>((now - *following_).count()) : 0.0;
      const double live = isNew && last_.arrived ? secondsSince(*last_.arrived) : 0.0;
      recent_.push_back({now, last_.rendered.seconds, last_.content, waited, live});
      while (recent_.size() > mostRecent) recent_.pop_front();
    }
    if (const std::shared_ptr<PreparedSet> set = last_.request.set; isOfAnother && set)
      Q_EMIT setShown(set->name, set->shownFrom);
  } catch (const Error& error) {
    stop();
    Q_EMIT failed(error.sentence());
    return;
  }
  next();
}

void Player::present() {
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    if (black_ || i >= last_.rendered.drives.size()) {
      windows_[i]->blacken();
      continue;
    }
    const DrivePicture& drive = last_.rendered.drives[i];
    QImage overlay;
    if (hasOverlay())
      overlay =
          overlayPicture(drive.size(), overlayLines({statistics(), isCompensated(), isFrozen(), chart_}));
    windows_[i]->present(drive, overlay);
  }
  Q_EMIT shown();
}

PlayerStatistics Player::statistics() const {
  PlayerStatistics result;
  result.frames = frames_;
  result.late = late_;
  result.clipped = last_.rendered.clipped;
  result.steps = last_.rendered.steps;
  result.perfected = last_.rendered.perfected;
  ContentTime now = microseconds(running_);
  double seconds = 0.0;
  int count = 0, changes = 0;
  const Shown* before = nullptr;
  for (const Shown& frame : recent_) {
    if (static_cast<double>((now - frame.when).count()) > 1e6 * windowSeconds) continue;
    seconds += frame.seconds;
    result.viewerSeconds = std::max(result.viewerSeconds, frame.viewerSeconds);
    result.liveSeconds = std::max(result.liveSeconds, frame.liveSeconds);
    ++count;
    changes += before != nullptr && before->content != frame.content;
    before = &frame;
  }
  if (count > 0) result.frameSeconds = seconds / count;
  double span = std::min(windowSeconds, 1e-6 * static_cast<double>(now.count()));
  // One picture that took another's place, or is computed again, is no film.
  bool moves = changes > 1 && !clock_.isPaused() && clock_.time() - last_.since < stillFor;
  if (span > 0.0 && moves) result.framesPerSecond = count / span;
  return result;
}

void Player::setFrozen(bool frozen) {
  frozen ? clock_.pause() : clock_.resume();
}

void Player::setBlack(bool black) {
  black_ = black;
  present();
}

void Player::setCompensated(bool compensated) {
  request_.compensated = compensated;
  renderer_->interrupt();
}

void Player::setBrightness(double brightness) {
  request_.brightness = brightness;
  renderer_->interrupt();
}

bool Player::moveViewer(const compensation::Position& position) {
  if (!canFollowViewers() || !viewer_.moveTo(position, viewerTime())) return false;
  if (playing_ && !moved_) moved_ = microseconds(running_);
  renderer_->interrupt();
  return true;
}

std::optional<FrameViewer> Player::viewer() const {
  const double presence = viewer_.presence(viewerTime());
  if (presence == 0.0) return std::nullopt;
  return FrameViewer{*viewer_.last(), presence};
}

bool Player::walk(const compensation::Position& by) {
  if (!canFollowViewers()) return false;
  compensation::Position place{};
  for (const compensation::Position& camera : cameras_)
    for (std::size_t k = 0; k < place.size(); ++k)
      place[k] += camera[k] / static_cast<double>(cameras_.size());
  if (viewer()) place = *viewer_.last();
  const double across = compensation::widestDistance(cameras_);
  for (std::size_t k = 0; k < place.size(); ++k) place[k] += by[k] * across;
  return moveViewer(place);
}

void Player::setOverlay(bool shown) {
  shown ? overlayed_.start() : overlayed_.stop();
  present();
}

void Player::setAvailable(std::shared_ptr<const engine::Availability> available) {
  request_.available = std::move(available);
  renderer_->interrupt();
}

void Player::setContent(std::shared_ptr<ContentSource> content) {
  content_ = std::move(content);
  renderer_->interrupt();
}

void Player::renew() {
  ++request_.edition;
  renderer_->interrupt();
}

void Player::useSet(const std::string& name) {
  wantedSet_ = name;
  goOnWithSets();
}

void Player::prepareSet(const std::string& name) {
  laterSet_ = name;
  goOnWithSets();
}

std::optional<std::string> Player::set() const {
  return request_.set ? std::optional(request_.set->name) : std::nullopt;
}

void Player::goOnWithSets() {
  if (wantedSet_ && wantedSet_ == set()) wantedSet_.reset();
  if (wantedSet_ && preparedSet_ && preparedSet_->name == *wantedSet_) {
    request_.set = std::exchange(preparedSet_, nullptr);
    wantedSet_.reset();
    renderer_->interrupt();
  }
  if (laterSet_ && (laterSet_ == set() || (preparedSet_ && preparedSet_->name == *laterSet_)))
    laterSet_.reset();
  if (preparing_.isRunning() || (!wantedSet_ && !laterSet_)) return;
  preparedSet_.reset();  // nobody wants it: two at a time are enough
  preparingSet_ = wantedSet_ ? *wantedSet_ : *laterSet_;
  preparing_.setFuture(startedInBackground(
      [renderer = renderer_, name = preparingSet_] {
        return std::make_shared<std::shared_ptr<PreparedSet>>(renderer->prepare(name));
      },
      &preparers_));
}

void Player::setPrepared() {
  try {
    std::shared_ptr<PreparedSet> set = std::exchange(*resultOf(preparing_.future()), nullptr);
    if (wantedSet_ == preparingSet_ || laterSet_ == preparingSet_) preparedSet_ = std::move(set);
  } catch (const Error& error) {
    if (laterSet_ == preparingSet_) laterSet_.reset();  // why is told once it is wanted
    if (wantedSet_ == preparingSet_) {
      wantedSet_.reset();
      Q_EMIT setFailed(preparingSet_, error.sentence());
    }
  }
  goOnWithSets();
}

void Player::setChart(std::optional<TestChart> chart) {
  chart_ = chart;
  chartContent_ = chart ? std::make_shared<TestChartContent>(*chart, renderer_->canvas()) : nullptr;
  renderer_->interrupt();
}

void Player::nextChart() {
  auto next =
      chart_ ? std::find(allTestCharts.begin(), allTestCharts.end(), *chart_) + 1 : allTestCharts.begin();
  setChart(next == allTestCharts.end() ? std::nullopt : std::optional(*next));
}

bool Player::handleKey(int key) {
  constexpr double step = 1.0 / 20.0;
  switch (key) {
    case Qt::Key_C:
      setCompensated(!isCompensated());
      return true;
    case Qt::Key_Space:
      setFrozen(!isFrozen());
      return true;
    case Qt::Key_B:
      setBlack(!isBlack());
      return true;
    case Qt::Key_T:
      nextChart();
      return true;
    case Qt::Key_O:
      setOverlay(!hasOverlay());
      return true;
    case Qt::Key_Left:
      return walk({-step, 0.0, 0.0});
    case Qt::Key_Right:
      return walk({step, 0.0, 0.0});
    case Qt::Key_Down:
      return walk({0.0, -step, 0.0});
    case Qt::Key_Up:
      return walk({0.0, step, 0.0});
    case Qt::Key_PageDown:
      return walk({0.0, 0.0, -step});
    case Qt::Key_PageUp:
      return walk({0.0, 0.0, step});
    case Qt::Key_Home:
      if (!canFollowViewers()) return false;
      viewer_.leave();
      renderer_->interrupt();
      return true;
    default:
      return false;
  }
}

}  // namespace relucent::gui
