// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

namespace relucent::engine {

/// Buffers for the bodies of parallel loops, all allocated beforehand: a body borrows one and returns it. If
/// there are more threads than buffers, a body waits.
class ScratchPool {
 public:
  ScratchPool(std::size_t buffers, std::size_t floats)
      : buffers_(buffers, std::vector<float>(floats)), taken_(new std::atomic_flag[buffers]{}) {}

  /// Not while any is borrowed.
  void resize(std::size_t floats) {
    for (std::vector<float>& buffer : buffers_) buffer.assign(floats, 0.0f);
  }

  /// A borrowed buffer.
  class BorrowedBuffer {
   public:
    explicit BorrowedBuffer(ScratchPool& pool) noexcept : pool_(pool), index_(pool.take()) {}
    ~BorrowedBuffer() { pool_.taken_[index_].clear(std::memory_order_release); }
    BorrowedBuffer(const BorrowedBuffer&) = delete;
    BorrowedBuffer& operator=(const BorrowedBuffer&) = delete;
    float* data() const noexcept { return pool_.buffers_[index_].data(); }

   private:
    ScratchPool& pool_;
    std::size_t index_;
  };

 private:
  std::size_t take() noexcept {
    for (std::size_t i = 0;; i = (i + 1) % buffers_.size()) {
      if (!taken_[i].test_and_set(std::memory_order_acquire)) return i;
      if (i + 1 == buffers_.size()) std::this_thread::yield();
    }
  }

  std::vector<std::vector<float>> buffers_;
  std::unique_ptr<std::atomic_flag[]> taken_;
};

}  // namespace relucent::engine
