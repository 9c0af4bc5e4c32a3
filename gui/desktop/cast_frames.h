// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QString>
#include <chrono>
#include <memory>

namespace relucent::gui {

/// The pictures of a node of PipeWire, negotiated as memory that both sides can read, of one of four orders
/// of eight bits; without buffers of a graphics card. One thread's.
class CastFrames {
 public:
  /// `remote`: a connection to PipeWire, taken over. Throws: Error{device} if there is none.
  CastFrames(int remote, std::uint32_t node);
  ~CastFrames();
  CastFrames(const CastFrames&) = delete;
  CastFrames& operator=(const CastFrames&) = delete;

  /// The newest picture since the last call, Format_RGBX8888, opaque; null: none has come for as long.
  /// Throws: Error{device} if it has ended; Error{format} for pictures that are not what they claim to be.
  QImage next(std::chrono::milliseconds most);
  /// Whether both sides are joined, so that pictures would come.
  bool isFlowing() const;
  /// Whether none has come yet of the size and order last agreed on.
  bool isFirstDue() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// PipeWire's.
QString castLibraryVersion();

}  // namespace relucent::gui
