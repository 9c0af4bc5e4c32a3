// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/transport/npy.h"

namespace relucent::transport {

/// Writes a NumPy .npz archive (an uncompressed zip of .npy files) whose arrays are produced in pieces while
/// they are written, so that no array has to be in memory as a whole.
class NpzWriter {
 public:
  /// Writes the items [begin, begin + count) of an array to `out`. Called in ascending order.
  using Items = std::function<void(std::uint64_t begin, std::uint64_t count, char* out)>;

  /// `name` without ".npy". Whatever `items` refers to must live until save().
  void add(const std::string& name, const NpyHeader& header, Items items);
  /// Copies the values, with the corresponding NumPy type.
  void add(const std::string& name, const std::vector<std::int32_t>& values,
           std::vector<std::uint64_t> shape);
  void add(const std::string& name, const std::vector<std::int64_t>& values,
           std::vector<std::uint64_t> shape);
  void addText(const std::string& name, const std::string& ascii);

  /// Atomically, see base/file.h. Throws: Error{disk}.
  void save(const std::filesystem::path& path);

 private:
  struct Array {
    std::string name;
    NpyHeader header;
    Items items;
  };
  std::vector<Array> arrays_;
};

/// Reads the arrays of a .npz archive, uncompressed or deflated.
/// Throws: Error{disk} if it cannot be opened, Error{format} for anything invalid.
class NpzReader {
 public:
  explicit NpzReader(const std::filesystem::path& path);
  ~NpzReader();
  NpzReader(const NpzReader&) = delete;
  NpzReader& operator=(const NpzReader&) = delete;

  bool has(const std::string& name) const;
  NpyHeader header(const std::string& name) const;

  /// Passes all items in order to `take`, in pieces of whole items of the first axis unless these are huge,
  /// while the next piece is read on another thread.
  using Take = std::function<void(std::uint64_t begin, std::uint64_t count, const char* items)>;
  void read(const std::string& name, const Take& take) const;
  /// A whole array of "<i4" or "<i8".
  std::vector<std::int64_t> integers(const std::string& name) const;
  /// A whole array of "<f4".
  std::vector<float> floats(const std::string& name) const;
  /// A single byte string.
  std::string text(const std::string& name) const;

  /// Throws: Error{format} that names the file.
  [[noreturn]] void fail(const Message& what) const;

 private:
  struct Archive;
  class Member;
  /// `bytes`: that the archive announces of the member.
  NpyHeader headerOf(Member& member, const std::string& name, std::uint64_t bytes) const;

  std::filesystem::path path_;
  std::unique_ptr<Archive> archive_;
};

}  // namespace relucent::transport
