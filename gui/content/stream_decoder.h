// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "content/live_link.h"
#include "content/stream_address.h"

namespace relucent::gui {

/// How long a stream is waited for.
struct StreamPatience {
  std::chrono::milliseconds opening{10'000};  // from the call to its first picture
  std::chrono::milliseconds stalled{5'000};   // from one picture to the next
};

/// One connection to a stream, its video decoded by FFmpeg, whose libraries no other file knows. All calls
/// block, but no longer than their patience, names that are looked up apart; from one thread.
/// Pictures are given as they come. What comes in advance, as films and HLS do, is given by its own times.
/// What the other side says is opened by protocols of the network alone, never a file.
class StreamDecoder : public LiveFeed {
 public:
  /// Looks whether somebody waits for it still, many times a second.
  using IsUnwanted = std::function<bool()>;

  /// Connects. Throws: Error{device} if the host is not found, refuses, does not answer, or wants a password;
  /// Error{format} if what comes is no video that can be decoded; Cancelled once it is unwanted.
  StreamDecoder(const StreamAddress& address, const StreamPatience& patience, IsUnwanted isUnwanted);
  ~StreamDecoder() override;
  StreamDecoder(const StreamDecoder&) = delete;
  StreamDecoder& operator=(const StreamDecoder&) = delete;

  /// The next picture. Throws: Error{device} if the stream ends or stalls; Error{format} for samples of an
  /// unknown kind; as encodingOf(); Cancelled.
  LivePicture next() override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// FFmpeg's, of the library that reads streams.
QString streamLibraryVersion();

}  // namespace relucent::gui
