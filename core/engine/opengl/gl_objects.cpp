// SPDX-License-Identifier: MIT
#include "relucent/engine/opengl/gl_objects.h"

#include <algorithm>
#include <string>

#include "relucent/base/error.h"
#include "relucent/engine/opengl/shaders.h"

namespace relucent::engine {
namespace {

constexpr auto onTheProcessor =
    RELUCENT_MESSAGE("engine.compute-on-processor", "compute on the processor instead");

GLint limitOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

std::string logOf(GLuint shader, bool program) {
  std::string log(1024, '\0');
  GLsizei length = 0;
  if (program)
    glGetProgramInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  else
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(std::max(length, 0)));
  while (!log.empty() && log.back() == '\n') log.pop_back();
  return log;
}

[[noreturn]] void refuse(const std::string& log) {
  throw Error(ErrorKind::device,
              RELUCENT_ENGLISH_MESSAGE("engine.shaders-not-compiled",
                                       "the graphics driver cannot compile the engine's programs"),
              onTheProcessor, log);
}

}  // namespace

std::size_t GlBuffer::largest() {
  return static_cast<std::size_t>(limitOf(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
}

std::size_t GlBuffer::alignment() {
  return static_cast<std::size_t>(std::max(1, limitOf(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT)));
}

GlBuffer::GlBuffer(std::size_t bytes, const void* data, bool inParts)
    : bytes_(std::max<std::size_t>((bytes + 15) / 16 * 16, 16)) {
  if (!inParts && bytes_ > largest())
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("engine.graphics-buffer-too-large",
                                 "the graphics card can hold {} MB in one piece, but {} MB are needed")
                    .with(as::megabytes(largest()), as::megabytes(bytes_)),
                onTheProcessor);
  while (glGetError() != GL_NO_ERROR) {
  }
  glGenBuffers(1, &name_);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_DYNAMIC_COPY);
  if (glGetError() != GL_NO_ERROR) {
    glDeleteBuffers(1, &name_);
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("engine.graphics-memory-exhausted", "the graphics card has no {} MB of memory left")
            .with(as::megabytes(bytes_)),
        onTheProcessor);
  }
  const std::size_t known = data == nullptr ? 0 : bytes;
  if (known > 0) write(0, data, known);
  // Not by clear(): with NVIDIA's driver (580.159) what is written next would be cleared as well.
  const std::vector<char> zeros(std::min(bytes_ - known, std::size_t{1} << 20));
  for (std::size_t at = known; at < bytes_; at += zeros.size())
    write(at, zeros.data(), std::min(zeros.size(), bytes_ - at));
}

GlBuffer::~GlBuffer() {
  if (name_ != 0) glDeleteBuffers(1, &name_);
}

void GlBuffer::bind(unsigned binding, std::size_t begin, std::size_t count) const noexcept {
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, name_, static_cast<GLintptr>(begin),
                    static_cast<GLsizeiptr>(count));
}

void GlBuffer::write(std::size_t begin, const void* data, std::size_t bytes) noexcept {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(begin), static_cast<GLsizeiptr>(bytes),
                  data);
}

void GlBuffer::read(std::size_t begin, void* data, std::size_t bytes) const noexcept {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(begin), static_cast<GLsizeiptr>(bytes),
                     data);
}

void GlBuffer::copyToTexture(GLuint texture, Size size, std::size_t begin) const noexcept {
  glMemoryBarrier(GL_PIXEL_BUFFER_BARRIER_BIT);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name_);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE,
                  // NOLINTNEXTLINE(performance-no-int-to-ptr): from the beginning of the buffer that is bound
                  reinterpret_cast<const void*>(begin));
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void GlBuffer::clear() noexcept {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glClearBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, 0, static_cast<GLsizeiptr>(bytes_), GL_RED_INTEGER,
                       GL_UNSIGNED_INT, nullptr);
}

GlProgram::GlProgram(std::string_view source, std::initializer_list<const char*> defines) {
  std::string head = "#version 430 core\n";
  for (const char* define : defines) head += fmt::format("#define {}\n", define);
  const char* texts[] = {head.data(), shaders::common.data(), source.data()};
  const GLint lengths[] = {static_cast<GLint>(head.size()), static_cast<GLint>(shaders::common.size()),
                           static_cast<GLint>(source.size())};
  GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  glShaderSource(shader, 3, texts, lengths);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_FALSE) {
    std::string log = logOf(shader, false);
    glDeleteShader(shader);
    refuse(log);
  }
  name_ = glCreateProgram();
  glAttachShader(name_, shader);
  glLinkProgram(name_);
  glDetachShader(name_, shader);
  glDeleteShader(shader);
  glGetProgramiv(name_, GL_LINK_STATUS, &good);
  if (good == GL_FALSE) {
    std::string log = logOf(name_, true);
    glDeleteProgram(name_);
    refuse(log);
  }
}

GlProgram::~GlProgram() {
  if (name_ != 0) glDeleteProgram(name_);
}

void GlProgram::run(std::size_t invocations) const noexcept {
  if (invocations == 0) return;
  // Every device takes so many groups in each dimension.
  constexpr std::size_t most = 65535;
  const std::size_t groups = (invocations + group - 1) / group;
  const std::size_t rows = (groups + most - 1) / most;
  glUseProgram(name_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glDispatchCompute(static_cast<GLuint>((groups + rows - 1) / rows), static_cast<GLuint>(rows), 1);
}

GlTimestamp GlTimestamp::make() {
  GlTimestamp stamp;
  glGenQueries(1, &stamp.name_);
  return stamp;
}

GlTimestamp::~GlTimestamp() {
  if (name_ != 0) glDeleteQueries(1, &name_);
}

double GlTimestamp::seconds() const noexcept {
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &nanoseconds);
  return 1e-9 * static_cast<double>(nanoseconds);
}

}  // namespace relucent::engine
