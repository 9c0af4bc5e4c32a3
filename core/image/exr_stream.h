// SPDX-License-Identifier: MIT
#pragma once

#include <ImfIO.h>

#include <string>
#include <string_view>

namespace relucent::image::detail {

/// Lets OpenEXR read from memory, so that base/file.h handles missing and unreadable files.
class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::string_view content, const std::string& name);
  bool read(char bytes[], int count) override;
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view content_;
  std::uint64_t position_ = 0;
};

/// Lets OpenEXR write to memory: its file streams do not report a full disk when they are closed.
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& name) : OStream(name.c_str()) {}
  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  const std::string& content() const { return content_; }

 private:
  std::string content_;
  std::uint64_t position_ = 0;
};

}  // namespace relucent::image::detail
