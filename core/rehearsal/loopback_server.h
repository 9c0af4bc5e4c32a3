// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace relucent::rehearsal {

/// Somebody on this computer who has connected.
class Visitor {
 public:
  virtual ~Visitor() = default;
  /// Appends what comes next. False: he is gone, or the server ends.
  virtual bool receive(std::string& bytes) = 0;
  /// False: likewise.
  virtual bool send(std::string_view bytes) = 0;
  /// Waits. False: likewise, at once.
  virtual bool pause(std::chrono::milliseconds time) = 0;
};

/// A port of the loopback network, each visitor on a thread of his own.
class LoopbackServer {
 public:
  using Serve = std::function<void(Visitor&)>;

  /// `port`: 0: any that is free. `serve` returns when it has nothing more to say, and must when a call of
  /// the visitor's says false. Throws: Error{device} if the port cannot be had.
  LoopbackServer(int port, Serve serve);
  /// Drops everybody.
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  int port() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace relucent::rehearsal
