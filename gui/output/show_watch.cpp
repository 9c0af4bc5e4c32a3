// SPDX-License-Identifier: MIT
#include "output/show_watch.h"

#include <QJsonArray>
#include <algorithm>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"

namespace relucent::gui {
namespace {

constexpr std::size_t mostSent = 20;     // frames: each may be 8 MB a projector
constexpr double longestExposure = 0.1;  // seconds
constexpr std::chrono::milliseconds mostBetweenTries{60'000};

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class CalibratedSource : public WatchSource {
 public:
  CalibratedSource(std::filesystem::path calibration, pipeline::WatchSettings settings)
      : calibration_(std::move(calibration)), settings_(std::move(settings)) {}
  pipeline::WatchingCamera read(Progress& progress) override {
    return readWatchedVenue(calibration_, settings_, progress);
  }
  void open(pipeline::WatchingCamera& watching) override { openCamera(calibration_, settings_, watching); }

 private:
  std::filesystem::path calibration_;
  pipeline::WatchSettings settings_;
};

/// The light of a frame at the pixels that T's rows need. Empty: a picture is gone, or of another size.
monitoring::FrameMeans meansOf(const std::vector<DrivePicture>& drives, const pipeline::CodeLights& lights,
                               const monitoring::SampledTransport& transport) {
  const Rasters& rasters = transport.rasters();
  if (drives.size() != rasters.devices()) return {};
  std::vector<float> light;
  light.reserve(3 * transport.pixels().size());
  std::size_t next = 0;
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const QImage picture = drives[j].image().convertToFormat(QImage::Format_RGBX8888);
    const Size size = rasters.size(j);
    if (picture.width() != size.width || picture.height() != size.height) return {};
    for (; next < transport.pixels().size() && transport.pixels()[next] < rasters.offset(j) + size.count();
         ++next) {
      const Pixel at = pixelAt(size, transport.pixels()[next] - rasters.offset(j));
      const uchar* const code = picture.constScanLine(at.y) + 4 * at.x;
      for (std::size_t c = 0; c < 3; ++c) light.push_back(lights[j][c][code[c]]);
    }
  }
  return transport.meansOf(std::span<const float>(light));
}

bool isSame(const monitoring::Finding& a, const monitoring::Finding& b) {
  return a.kind == b.kind && a.projector == b.projector && a.channel == b.channel;
}

bool holds(const std::vector<monitoring::Finding>& findings, const monitoring::Finding& finding) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const monitoring::Finding& one) { return isSame(one, finding); });
}

}  // namespace

void PlayedTap::put(const std::vector<DrivePicture>& drives) {
  const std::lock_guard lock(guard_);
  last_ = {steadySeconds(), drives};
  if (!keeps_) return;
  if (sent_.size() == mostSent) sent_.erase(sent_.begin());
  sent_.push_back(last_);
}

void PlayedTap::begin() {
  const std::lock_guard lock(guard_);
  keeps_ = true;
  sent_.clear();
  if (!last_.drives.empty()) sent_.push_back(last_);
}

std::vector<PlayedTap::Sent> PlayedTap::sentSoFar() {
  const std::lock_guard lock(guard_);
  return sent_;
}

std::vector<PlayedTap::Sent> PlayedTap::end() {
  const std::lock_guard lock(guard_);
  keeps_ = false;
  return std::exchange(sent_, {});
}

std::unique_ptr<WatchSource> watchSourceOf(const std::filesystem::path& calibration,
                                           const pipeline::WatchSettings& settings) {
  return std::make_unique<CalibratedSource>(calibration, settings);
}

/// The watching thread.
class ShowWatch::Watcher {
 public:
  using Take = std::function<void(const WatchStatus&)>;

  Watcher(std::unique_ptr<WatchSource> source, std::shared_ptr<PlayedTap> tap,
          std::shared_ptr<CameraUse> camera, WatchPace pace, Take take, std::function<void()> cannotFill)
      : source_(std::move(source)),
        tap_(std::move(tap)),
        camera_(std::move(camera)),
        pace_(std::move(pace)),
        take_(std::move(take)),
        cannotFill_(std::move(cannotFill)),
        thread_([this] { work(); }) {}
  ~Watcher() {
    {
      const std::lock_guard lock(guard_);
      ends_ = true;
    }
    stop_.ask(StopRequest::Kind::cancel);
    changed_.notify_all();
    thread_.join();
  }
  void setPlaying(bool playing) {
    {
      const std::lock_guard lock(guard_);
      playing_ = playing;
    }
    changed_.notify_all();
  }
  void readAgain() {
    {
      const std::lock_guard lock(guard_);
      isOutOfDate_ = true;
    }
    changed_.notify_all();
  }

 private:
  struct Photograph {
    double begun = 0.0;  // seconds
    rig::RawFrame frame;
    std::vector<PlayedTap::Sent> sent;
  };
  struct NoSink : ProgressSink {
    void progressed(double, const Message&) override {}
  };

  /// Until then, or until something else is asked for.
  void wait(std::chrono::milliseconds pause) {
    std::unique_lock lock(guard_);
    changed_.wait_for(lock, pause, [&] { return ends_ || isOutOfDate_ || !playing_; });
  }
  /// False: another venue is to be read, or none any more.
  bool waitForPlay() {
    std::unique_lock lock(guard_);
    if (!playing_ && !ends_ && !isOutOfDate_) {
      lock.unlock();
      tell(WatchState::paused);
      lock.lock();
    }
    changed_.wait(lock, [&] { return playing_ || ends_ || isOutOfDate_; });
    return !ends_ && !isOutOfDate_;
  }
  /// False: it is to end.
  bool waitForAnother() {
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return isOutOfDate_ || ends_; });
    return !ends_;
  }
  bool isPlaying() {
    const std::lock_guard lock(guard_);
    return playing_;
  }
  void tell(WatchState state, const Message& problem = {}) {
    status_.state = state;
    status_.problem = problem;
    take_(status_);
  }

  void work() {
    do {
      {
        const std::lock_guard lock(guard_);
        isOutOfDate_ = false;
      }
      pipeline::WatchingCamera watching;
      try {
        Progress progress(sink_, stop_);
        watching = source_->read(progress);
      } catch (const Cancelled&) {
        return;
      } catch (const Error& error) {
        tell(WatchState::noCalibration, error.sentence());
        continue;
      }
      monitoring::Monitor monitor(std::move(watching.venue));
      if (pace_.fillsShadows) tracker_.emplace(monitor.venue());
      status_.fillsShadows = tracker_ && tracker_->canFill();
      if (tracker_ && !status_.fillsShadows) {
        tracker_.reset();
        cannotFill_();
      }
      status_.findings.clear();
      exposure_ = 0.0;
      watch(watching, monitor);
      letGo(watching);
      tracker_.reset();
    } while (waitForAnother());
  }

  /// Until another venue is to be read, or none any more.
  void watch(pipeline::WatchingCamera& watching, monitoring::Monitor& monitor) {
    std::chrono::milliseconds pause = pace_.again;
    while (true) {
      if (!isPlaying()) letGo(watching);  // others may need it now
      if (!waitForPlay()) return;
      try {
        if (!isOpen_) {
          tell(WatchState::opening);
          camera_->begin();
          isOpen_ = true;
          if (!isPlaying()) continue;  // who found it free has it
          source_->open(watching);
        }
        look(watching, monitor);
        pause = pace_.again;
        wait(tracker_ ? pace_.betweenShadows : pace_.between);
      } catch (const Error& error) {
        // Only until it answers again; what it told stays told.
        letGo(watching);
        tell(WatchState::noCamera, error.sentence());
        wait(pause);
        pause = std::min(2 * pause, mostBetweenTries);
      }
    }
  }

  void letGo(pipeline::WatchingCamera& watching) {
    if (!isOpen_) return;
    if (tracker_) tracker_->forget();
    known_ = {};
    means_.clear();
    tap_->end();
    status_.filled.clear();
    status_.available.reset();
    watching.used = {};
    watching.devices.reset();
    isOpen_ = false;
    camera_->end();
  }

  /// A photograph; false: none that could be evidence.
  bool photograph(pipeline::WatchingCamera& watching, const monitoring::WatchedVenue& venue,
                  Photograph& taken) {
    if (exposure_ == 0.0) exposure_ = watching.exposures.back();
    taken.begun = pace_.clock ? pace_.clock() : steadySeconds();
    taken.frame = watching.camera().capture({{"watch", status_.photographs}, 0, exposure_});
    taken.sent = tracker_ ? tap_->sentSoFar() : tap_->end();
    if (taken.sent.empty() || !isPlaying())
      return false;  // a picture that went black meanwhile is no evidence
    rig::checkFrame(taken.frame, venue.sampling.camera, watching.camera().name());
    return true;
  }

  /// Frames that were read for the photograph before are not read again.
  std::vector<monitoring::PlayedFrame> framesOf(const std::vector<PlayedTap::Sent>& sent,
                                                const pipeline::CodeLights& lights,
                                                const monitoring::WatchedVenue& venue) {
    std::vector<monitoring::PlayedFrame> frames;
    for (const PlayedTap::Sent& one : sent) {
      const auto known =
          std::find_if(means_.begin(), means_.end(),
                       [&](const monitoring::PlayedFrame& frame) { return frame.since == one.seconds; });
      monitoring::FrameMeans means =
          known != means_.end() ? std::move(known->means) : meansOf(one.drives, lights, venue.transport);
      if (!means.empty()) frames.push_back({one.seconds, std::move(means)});
    }
    return frames;
  }

  void look(pipeline::WatchingCamera& watching, monitoring::Monitor& monitor) {
    if (!tracker_ || means_.empty()) {
      tap_->begin();
      wait(pace_.before);
      if (!isPlaying()) return;
    }
    const monitoring::WatchedVenue& venue = monitor.venue();
    Photograph taken;
    if (!photograph(watching, venue, taken)) return;
    Stopwatch watch;
    std::vector<monitoring::PlayedFrame> frames = framesOf(taken.sent, watching.lights, venue);
    if (frames.empty()) return;
    exposure_ = monitoring::suitableExposure(frames.back().means, watching.exposures, longestExposure, venue);
    if (tracker_) lookForShadows(taken, frames, venue);
    if (!tracker_ || taken.begun - lastLook_ >= std::chrono::duration<double>(pace_.between).count()) {
      lastLook_ = taken.begun;
      const monitoring::Look look = monitor.look(taken.frame, taken.begun, frames);
      if (look.use == monitoring::Look::Use::told) known_ = {monitor.gains(), look.light.room};
      ++status_.photographs;
      status_.used += look.use == monitoring::Look::Use::told;
      status_.informed = monitor.informed();
      status_.findings = monitor.findings();
    }
    means_ = tracker_ ? std::move(frames) : std::vector<monitoring::PlayedFrame>();
    status_.milliseconds = 1e3 * watch.seconds();
    tell(WatchState::watching);
  }

  void lookForShadows(const Photograph& taken, const std::vector<monitoring::PlayedFrame>& frames,
                      const monitoring::WatchedVenue& venue) {
    if (known_.gains.empty()) known_.gains.assign(3 * venue.transport.projectors(), 1.0);
    const monitoring::Observed seen = monitoring::observedOf(taken.frame, venue);
    const monitoring::Moment moment = monitoring::momentOf(
        seen, frames, hdr::trueSeconds(venue.camera, taken.frame.seconds), venue, known_.gains);
    if (!tracker_->look(seen, moment, known_, taken.begun)) return;
    status_.filled = tracker_->filled();
    status_.available = status_.filled.empty()
                            ? nullptr
                            : std::make_shared<const engine::Availability>(tracker_->available());
  }

  std::unique_ptr<WatchSource> source_;
  std::shared_ptr<PlayedTap> tap_;
  std::shared_ptr<CameraUse> camera_;
  WatchPace pace_;
  Take take_;
  std::function<void()> cannotFill_;
  WatchStatus status_;
  double exposure_ = 0.0;                             // seconds, of the next photograph; 0: none yet
  std::optional<monitoring::ShadowTracker> tracker_;  // none: no shadows are filled
  monitoring::KnownLight known_;                      // of the last look at what lasts
  std::vector<monitoring::PlayedFrame> means_;        // of the last photograph
  double lastLook_ = -1e30;                           // seconds
  NoSink sink_;
  StopRequest stop_;
  std::mutex guard_;
  std::condition_variable changed_;
  bool playing_ = false, ends_ = false, isOutOfDate_ = false;
  bool isOpen_ = false;  // of the watching thread
  std::thread thread_;   // last: it uses the others
};

ShowWatch::ShowWatch(std::unique_ptr<WatchSource> source, std::shared_ptr<PlayedTap> tap, WatchPace pace,
                     QObject* parent)
    : QObject(parent) {
  watcher_ = std::make_unique<Watcher>(
      std::move(source), std::move(tap), camera_, std::move(pace),
      [this](WatchStatus status) {
        QMetaObject::invokeMethod(
            this, [this, status = std::move(status)] { take(status); }, Qt::QueuedConnection);
      },
      [this] {
        const Message sentence = RELUCENT_ENGLISH_MESSAGE(
            "monitoring.nothing-to-fill",
            "Shadows cannot be filled: the camera sees no place that two projectors light.");
        QMetaObject::invokeMethod(
            this, [this, sentence] { Q_EMIT cannotFill(sentence); }, Qt::QueuedConnection);
      });
}

ShowWatch::~ShowWatch() = default;

void ShowWatch::setPlaying(bool playing) {
  watcher_->setPlaying(playing);
}

void ShowWatch::readAgain() {
  watcher_->readAgain();
}

void ShowWatch::take(const WatchStatus& status) {
  const WatchStatus before = std::exchange(status_, status);
  if (!status.problem.empty() && english(status.problem) != english(before.problem))
    Q_EMIT failed(status.problem);
  // A camera that is opened again fails with the same words.
  if (status.state == WatchState::opening) status_.problem = before.problem;
  for (const monitoring::Finding& finding : status.findings)
    if (!holds(before.findings, finding)) Q_EMIT found(finding);
  for (const monitoring::Finding& finding : before.findings)
    if (!holds(status.findings, finding)) Q_EMIT over(finding);
  if (status.available != before.available) Q_EMIT shadowsChanged();
  Q_EMIT changed();
}

QJsonObject toJson(const WatchStatus& status) {
  QJsonArray findings;
  for (const monitoring::Finding& finding : status.findings) {
    QJsonObject json{{"kind", QString::fromStdString(std::string(nameOf(finding.kind)))},
                     {"amount", finding.amount},
                     {"what", QString::fromStdString(english(sentenceOf(finding)))},
                     {"advice", QString::fromStdString(english(adviceOf(finding)))}};
    if (finding.projector) json["projector"] = static_cast<qint64>(*finding.projector) + 1;
    findings.append(json);
  }
  QJsonObject json{{"state", QString::fromStdString(std::string(nameOf(status.state)))},
                   {"photographs", status.photographs},
                   {"used", status.used},
                   {"informed", status.informed},
                   {"milliseconds", status.milliseconds},
                   {"findings", findings}};
  if (status.fillsShadows) {
    QJsonArray filled;
    for (const monitoring::FilledShadow& shadow : status.filled)
      filled.append(QJsonObject{{"projector", static_cast<qint64>(shadow.projector) + 1},
                                {"x", shadow.x},
                                {"y", shadow.y},
                                {"what", QString::fromStdString(english(sentenceOf(shadow)))}});
    json["filled"] = filled;
  }
  if (!status.problem.empty()) json["problem"] = QString::fromStdString(english(status.problem));
  return json;
}

}  // namespace relucent::gui
