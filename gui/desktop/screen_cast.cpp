// SPDX-License-Identifier: MIT
#include "desktop/screen_cast.h"

#include <fcntl.h>

#include "desktop/cast_failure.h"
#include "desktop/cast_frames.h"
#include "desktop/screen_cast_session.h"
#include "relucent/base/progress.h"

namespace relucent::gui {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds tick{50};

/// PipeWire closes what it is given, and so does Qt.
int copyOf(const QDBusUnixFileDescriptor& descriptor) {
  const int copy = fcntl(descriptor.fileDescriptor(), F_DUPFD_CLOEXEC, 0);
  if (copy < 0) throw castWithoutPipeWire();
  return copy;
}

}  // namespace

class ScreenCast::Impl {
 public:
  Impl(const ScreenCastWish& wish, const ScreenCastVisitor& visitor)
      : wish_(wish), visitor_(visitor), session_(wish, visitor) {
    connect();
  }

  const QString& token() const { return session_.token(); }

  Picture next() {
    for (;;) {
      if (visitor_.isUnwanted && visitor_.isUnwanted()) throw Cancelled();
      QImage image = frames_->next(tick);
      if (!image.isNull()) {
        hasPlayed_ = true;
        settled_ = Clock::now();
        return {std::move(image), settled_};
      }
      if (session_.isClosed()) throw castEnded();
      insist();
    }
  }

 private:
  void connect() {
    frames_.reset();
    frames_ = std::make_unique<CastFrames>(copyOf(session_.remote()), session_.node());
    settled_ = Clock::now();
    hasPlayed_ = false;
  }

  /// A desktop that stands sends one picture when both sides are joined, and one when the size changes, which
  /// PipeWire loses where this side is not ready yet.
  void insist() {
    const auto now = Clock::now();
    if (!frames_->isFirstDue()) settled_ = now;
    const auto waited = now - settled_;
    if (frames_->isFlowing() && waited > wish_.first)
      connect();
    else if (!frames_->isFlowing() && !hasPlayed_ && waited > wish_.connection)
      throw castSilent(wish_.connection);
  }

  const ScreenCastWish wish_;
  const ScreenCastVisitor visitor_;
  ScreenCastSession session_;
  std::unique_ptr<CastFrames> frames_;
  Clock::time_point settled_;  // when nothing was due for the last time
  bool hasPlayed_ = false;     // since both sides were last joined
};

ScreenCast::ScreenCast(const ScreenCastWish& wish, const ScreenCastVisitor& visitor)
    : impl_(std::make_unique<Impl>(wish, visitor)) {}

ScreenCast::~ScreenCast() = default;

const QString& ScreenCast::token() const {
  return impl_->token();
}

ScreenCast::Picture ScreenCast::next() {
  return impl_->next();
}

bool isGivenByPortal() {
  return !qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY");
}

}  // namespace relucent::gui
