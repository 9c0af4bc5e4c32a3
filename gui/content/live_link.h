// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "content/canvas.h"
#include "content/live_source.h"
#include "relucent/base/error.h"

namespace relucent::gui {

/// A picture of something live.
struct LivePicture {
  QImage image;  // Format_RGBX8888, upright, of its own size
  /// When it was there: of a stream, when the packet that held it was there to be decoded.
  std::chrono::steady_clock::time_point arrived{};
  /// How long before that it was sent, by the sender's clock and this computer's, where it is told.
  std::optional<double> senderSeconds{};
};

/// One connection to something live, from its opening until it is lost. One thread's; its calls block.
class LiveFeed {
 public:
  virtual ~LiveFeed() = default;
  /// The next picture. Throws: Error, RarelyMended or Cancelled when there is none any more.
  virtual LivePicture next() = 0;

  /// A failure after which it is of no use to connect again soon, or at all.
  class RarelyMended : public Error {
   public:
    static constexpr std::chrono::milliseconds never = std::chrono::hours(24 * 365);
    RarelyMended(const Error& error, std::chrono::milliseconds after) : Error(error), pause(after) {}
    std::chrono::milliseconds pause;
  };
};

/// When a live picture that is lost is connected to again.
struct LivePauses {
  std::chrono::milliseconds first{1'000}, longest{30'000};  // doubled with every failure in between
  std::chrono::milliseconds forgiven{10'000};               // of playing, after which the first one is due
};

/// A live picture that may be lost and come back. It is connected to, read, and brought to the canvas on a
/// thread of its own, which nobody waits for. While it is lost its last picture stays, or black, and it is
/// connected to again and again; before its first picture it is black. One that changes its size goes on.
class LiveLink : public LiveSource {
 public:
  /// Its thread ends when it finds out.
  ~LiveLink() override;

  /// It has had a picture.
  bool isReady() const override;
  std::optional<LiveState> live() const override;

 protected:
  /// What a connection is told, and tells while it is opened.
  struct Opening {
    std::function<bool()> isUnwanted;  // nobody waits for it any more: Cancelled is to be thrown
    std::function<void()> isAsked;     // whoever sits before the desktop is asked something
  };
  /// Connects. Throws: as LiveFeed::next().
  using Open = std::function<std::unique_ptr<LiveFeed>(const Opening&)>;

  /// `address`: for people.
  LiveLink(Open open, const QString& address, bool turnsBlack, const Canvas& canvas,
           const LivePauses& pauses);
  ContentPicture newest() override;

 private:
  class Connection;
  std::shared_ptr<Connection> connection_;
};

}  // namespace relucent::gui
