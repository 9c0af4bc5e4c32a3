// SPDX-License-Identifier: MIT
#include "content/live_link.h"

#include <QThreadPool>
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "content/still_image.h"
#include "relucent/base/error.h"
#include "relucent/base/progress.h"

namespace relucent::gui {
namespace {

using Clock = std::chrono::steady_clock;

/// Of live pictures alone: one that waits would hold up what else the program does in Qt's. Waited for when
/// the program ends, not when a show does: a name that is looked up cannot be interrupted.
QThreadPool& threads() {
  static QThreadPool pool;
  constexpr int most = 64;
  pool.setMaxThreadCount(most);
  return pool;
}

}  // namespace

/// What its thread and its user share. Lives as long as either.
class LiveLink::Connection {
 public:
  Connection(Open open, const QString& address, bool turnsBlack, const Canvas& canvas,
             const LivePauses& pauses)
      : open_(std::move(open)), canvas_(canvas), pauses_(pauses), black_{blackOn(canvas), nextFrameNumber()} {
    state_.opening = nextFrameNumber();
    state_.address = address;
    state_.turnsBlack = turnsBlack;
  }

  void stop() {
    const std::lock_guard lock(guard_);
    stopped_ = true;
    changed_.notify_all();
  }
  LiveState state() const {
    const std::lock_guard lock(guard_);
    return state_;
  }
  ContentPicture newest() const {
    const std::lock_guard lock(guard_);
    const bool isBlack = newest_.image.isNull() || (state_.turnsBlack && isLost_);
    return isBlack ? black_ : newest_;
  }

  void run() {
    std::chrono::milliseconds pause = pauses_.first, atLeast{0};
    while (!isStopped()) {
      Clock::time_point began = Clock::now();
      bool played = false;
      atLeast = {};
      try {
        const std::unique_ptr<LiveFeed> feed =
            open_({[this] { return isStopped(); }, [this] { turnTo(LiveState::Phase::asking); }});
        settle();
        for (;; played = true) {
          const LivePicture picture = feed->next();
          if (!played) began = Clock::now();
          show(picture);
        }
      } catch (const Cancelled&) {
        return;
      } catch (const LiveFeed::RarelyMended& error) {
        lose(error.sentence());
        atLeast = error.pause;
      } catch (const Error& error) {
        lose(error.sentence());
      } catch (const std::bad_alloc&) {
        lose(RELUCENT_MESSAGE("stream.no-memory", "there is not enough memory for its pictures"));
      }
      if (played && Clock::now() - began >= pauses_.forgiven) pause = pauses_.first;
      std::unique_lock lock(guard_);
      changed_.wait_for(lock, std::max(pause, atLeast), [this] { return stopped_; });
      pause = std::min(2 * pause, pauses_.longest);
    }
  }

 private:
  bool isStopped() const {
    const std::lock_guard lock(guard_);
    return stopped_;
  }

  void show(const LivePicture& picture) {
    ContentPicture shown{onCanvas(picture.image, canvas_), nextFrameNumber()};
    shown.arrived = picture.arrived;
    const std::lock_guard lock(guard_);
    newest_ = std::move(shown);
    state_.phase = LiveState::Phase::playing;
    isLost_ = false;
    state_.size = picture.image.size();
    state_.senderSeconds = picture.senderSeconds;
  }

  void turnTo(LiveState::Phase phase) {
    const std::lock_guard lock(guard_);
    state_.phase = phase;
  }

  /// Whoever was asked has answered.
  void settle() {
    const std::lock_guard lock(guard_);
    if (state_.phase == LiveState::Phase::asking)
      state_.phase = isLost_ ? LiveState::Phase::lost : LiveState::Phase::connecting;
  }

  void lose(const Message& problem) {
    const std::lock_guard lock(guard_);
    if (!std::exchange(isLost_, true)) ++state_.losses;
    state_.phase = LiveState::Phase::lost;
    state_.problem = problem;
    state_.senderSeconds.reset();
  }

  const Open open_;
  const Canvas canvas_;
  const LivePauses pauses_;
  const ContentPicture black_;
  mutable std::mutex guard_;
  std::condition_variable changed_;
  bool stopped_ = false;
  bool isLost_ = false;  // also while it is asked for again
  ContentPicture newest_;
  LiveState state_;
};

LiveLink::LiveLink(Open open, const QString& address, bool turnsBlack, const Canvas& canvas,
                   const LivePauses& pauses)
    : connection_(std::make_shared<Connection>(std::move(open), address, turnsBlack, canvas, pauses)) {
  threads().start([connection = connection_] { connection->run(); });
}

LiveLink::~LiveLink() {
  connection_->stop();
}

bool LiveLink::isReady() const {
  return !connection_->state().size.isEmpty();
}

std::optional<LiveState> LiveLink::live() const {
  return connection_->state();
}

ContentPicture LiveLink::newest() {
  return connection_->newest();
}

}  // namespace relucent::gui
