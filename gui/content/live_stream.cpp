// SPDX-License-Identifier: MIT
#include "content/live_stream.h"

#include <QThreadPool>
#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "content/still_image.h"
#include "relucent/base/error.h"
#include "relucent/base/progress.h"

namespace relucent::gui {
namespace {

using Clock = std::chrono::steady_clock;

/// Of streams alone: one that waits would hold up what else the program does in Qt's. Waited for when the
/// program ends, not when a show does: a name that is looked up cannot be interrupted.
QThreadPool& threads() {
  static QThreadPool pool;
  constexpr int most = 64;
  pool.setMaxThreadCount(most);
  return pool;
}

}  // namespace

/// What a stream's thread and its user share. Lives as long as either.
class LiveStream::Connection {
 public:
  Connection(const StreamAddress& address, const Canvas& canvas, const StreamPatience& patience,
             const StreamPauses& pauses)
      : address_(address),
        canvas_(canvas),
        patience_(patience),
        pauses_(pauses),
        black_{blackOn(canvas), nextFrameNumber()} {
    state_.opening = nextFrameNumber();
    state_.address = shownStream(address.url);
    state_.turnsBlack = address.hold == StreamAddress::Hold::black;
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
    const bool isBlack =
        newest_.image.isNull() || (state_.turnsBlack && state_.phase == LiveState::Phase::lost);
    return isBlack ? black_ : newest_;
  }

  void run() {
    std::chrono::milliseconds pause = pauses_.first;
    while (!isStopped()) {
      Clock::time_point began = Clock::now();
      bool played = false;
      try {
        StreamDecoder stream(address_, patience_, [this] { return isStopped(); });
        for (;; played = true) {
          const StreamPicture picture = stream.next();
          if (!played) began = Clock::now();
          show(picture);
        }
      } catch (const Cancelled&) {
        return;
      } catch (const Error& error) {
        lose(error.sentence());
      } catch (const std::bad_alloc&) {
        lose(RELUCENT_MESSAGE("stream.no-memory", "there is not enough memory for its pictures"));
      }
      if (played && Clock::now() - began >= pauses_.forgiven) pause = pauses_.first;
      std::unique_lock lock(guard_);
      changed_.wait_for(lock, pause, [this] { return stopped_; });
      pause = std::min(2 * pause, pauses_.longest);
    }
  }

 private:
  bool isStopped() const {
    const std::lock_guard lock(guard_);
    return stopped_;
  }

  void show(const StreamPicture& picture) {
    ContentPicture shown{onCanvas(picture.image, canvas_), nextFrameNumber()};
    shown.arrived = picture.arrived;
    const std::lock_guard lock(guard_);
    newest_ = std::move(shown);
    state_.phase = LiveState::Phase::playing;
    state_.size = picture.image.size();
    state_.senderSeconds = picture.senderSeconds;
  }

  void lose(const Message& problem) {
    const std::lock_guard lock(guard_);
    if (state_.phase != LiveState::Phase::lost) ++state_.losses;
    state_.phase = LiveState::Phase::lost;
    state_.problem = problem;
    state_.senderSeconds.reset();
  }

  const StreamAddress address_;
  const Canvas canvas_;
  const StreamPatience patience_;
  const StreamPauses pauses_;
  const ContentPicture black_;
  mutable std::mutex guard_;
  std::condition_variable changed_;
  bool stopped_ = false;
  ContentPicture newest_;
  LiveState state_;
};

LiveStream::LiveStream(const StreamAddress& address, const Canvas& canvas, const StreamPatience& patience,
                       const StreamPauses& pauses)
    : connection_(std::make_shared<Connection>(address, canvas, patience, pauses)) {
  threads().start([connection = connection_] { connection->run(); });
}

LiveStream::~LiveStream() {
  connection_->stop();
}

bool LiveStream::isReady() const {
  return !connection_->state().size.isEmpty();
}

std::optional<LiveState> LiveStream::live() const {
  return connection_->state();
}

ContentPicture LiveStream::newest() {
  return connection_->newest();
}

}  // namespace relucent::gui
