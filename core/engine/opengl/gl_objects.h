// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::engine {

/// A shader storage buffer. Like all objects of OpenGL it is made, used and destroyed while the context that
/// it belongs to is current.
class GlBuffer {
 public:
  GlBuffer() = default;
  /// Zeros, or a copy of `data`. Throws: Error{device} if the device's memory is too small, or the size
  /// exceeds what a shader can bind: `inParts` is for buffers of which only parts are bound.
  explicit GlBuffer(std::size_t bytes, const void* data = nullptr, bool inParts = false);
  template <typename T>
  explicit GlBuffer(const std::vector<T>& values, bool inParts = false)
      : GlBuffer(values.size() * sizeof(T), values.data(), inParts) {}
  ~GlBuffer();
  GlBuffer(GlBuffer&& other) noexcept { *this = std::move(other); }
  GlBuffer& operator=(GlBuffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  std::size_t bytes() const { return bytes_; }
  void bind(unsigned binding) const noexcept { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_); }
  /// Bytes [begin, begin + count). Contract: `begin` is a multiple of alignment().
  void bind(unsigned binding, std::size_t begin, std::size_t count) const noexcept;
  void write(std::size_t begin, const void* data, std::size_t bytes) noexcept;
  void read(std::size_t begin, void* data, std::size_t bytes) const noexcept;
  /// Words from byte `begin` on, after all previous writes of shaders, become the pixels of an RGBA8 texture.
  void copyToTexture(GLuint texture, Size size, std::size_t begin) const noexcept;
  /// For what shaders write next. Contract: write() does not, see the constructor.
  void clear() noexcept;
  /// Declares the old content unused, which avoids waiting for shaders that still read it.
  void forget() noexcept { glInvalidateBufferData(name_); }

  /// Bytes of a buffer that a shader can bind, and the alignment of a bound part.
  static std::size_t largest();
  static std::size_t alignment();

 private:
  GLuint name_ = 0;
  std::size_t bytes_ = 0;
};

/// A compute shader of 64 invocations a group.
class GlProgram {
 public:
  static constexpr std::size_t group = 64;

  GlProgram() = default;
  /// `defines`: preprocessor symbols. Throws: Error{device} with the compiler's message.
  explicit GlProgram(std::string_view source, std::initializer_list<const char*> defines = {});
  ~GlProgram();
  GlProgram(GlProgram&& other) noexcept { *this = std::move(other); }
  GlProgram& operator=(GlProgram&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }

  void set(int location, std::uint32_t value) const noexcept { glProgramUniform1ui(name_, location, value); }
  void set(int location, std::size_t value) const noexcept {
    set(location, static_cast<std::uint32_t>(value));
  }
  void set(int location, bool value) const noexcept { glProgramUniform1i(name_, location, value); }
  void set(int location, float value) const noexcept { glProgramUniform1f(name_, location, value); }
  void set(int location, std::uint32_t x, std::uint32_t y) const noexcept {
    glProgramUniform2ui(name_, location, x, y);
  }
  void set(int location, const std::array<float, 3>& value) const noexcept {
    glProgramUniform3f(name_, location, value[0], value[1], value[2]);
  }
  void setPairs(int location, std::span<const std::uint32_t> values) const noexcept {
    glProgramUniform2uiv(name_, location, static_cast<GLsizei>(values.size() / 2), values.data());
  }
  void setFloats(int location, std::span<const float> values) const noexcept {
    glProgramUniform1fv(name_, location, static_cast<GLsizei>(values.size()), values.data());
  }
  void setMatrix(int location, const float* rowMajor) const noexcept {
    glProgramUniformMatrix3fv(name_, location, 1, GL_TRUE, rowMajor);
  }

  /// Runs at least that many invocations, after all previous writes.
  void run(std::size_t invocations) const noexcept;

 private:
  GLuint name_ = 0;
};

/// A time stamp of the device's clock, taken when its queue reaches this point.
class GlTimestamp {
 public:
  GlTimestamp() = default;
  static GlTimestamp make();
  ~GlTimestamp();
  GlTimestamp(GlTimestamp&& other) noexcept { *this = std::move(other); }
  GlTimestamp& operator=(GlTimestamp&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  void take() const noexcept { glQueryCounter(name_, GL_TIMESTAMP); }
  /// Waits for it.
  double seconds() const noexcept;

 private:
  GLuint name_ = 0;
};

}  // namespace relucent::engine
