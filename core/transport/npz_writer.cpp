// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/transport/npz.h"

namespace relucent::transport {
namespace {

static_assert(std::endian::native == std::endian::little, "NumPy files are written in memory order");

constexpr std::uint64_t pieceBytes = 1 << 20;  // written at once

/// One .npy file as libzip wants to read it.
class NpyStream {
 public:
  NpyStream(const NpyHeader& header, NpzWriter::Items items)
      : head_(npyText(header)),
        items_(std::move(items)),
        count_(header.count()),
        itemBytes_(header.itemBytes()) {
    zip_error_init(&error_);
  }
  ~NpyStream() { zip_error_fini(&error_); }
  NpyStream(const NpyStream&) = delete;
  NpyStream& operator=(const NpyStream&) = delete;

  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    return static_cast<NpyStream*>(self)->run(data, length, command);
  }

 private:
  zip_int64_t run(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_OPEN:
        piece_ = head_;
        at_ = 0;
        next_ = 0;
        return 0;
      case ZIP_SOURCE_READ:
        return read(static_cast<char*>(data), length);
      case ZIP_SOURCE_STAT: {
        auto* stat = static_cast<zip_stat_t*>(data);
        zip_stat_init(stat);
        stat->size = head_.size() + count_ * itemBytes_;
        stat->valid = ZIP_STAT_SIZE;
        return sizeof(*stat);
      }
      case ZIP_SOURCE_ERROR:
        return zip_error_to_data(&error_, data, length);
      case ZIP_SOURCE_SUPPORTS:
        return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                              ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
      default:
        return 0;
    }
  }

  zip_int64_t read(char* out, std::uint64_t length) {
    std::uint64_t written = 0;
    while (written < length) {
      if (at_ == piece_.size() && !nextPiece()) break;
      std::uint64_t part = std::min<std::uint64_t>(length - written, piece_.size() - at_);
      std::memcpy(out + written, piece_.data() + at_, part);
      at_ += part;
      written += part;
    }
    return static_cast<zip_int64_t>(written);
  }

  bool nextPiece() {
    std::uint64_t count = std::min(count_ - next_, std::max<std::uint64_t>(1, pieceBytes / itemBytes_));
    if (count == 0) return false;
    piece_.resize(count * itemBytes_);
    items_(next_, count, piece_.data());
    next_ += count;
    at_ = 0;
    return true;
  }

  std::string head_;
  NpzWriter::Items items_;
  std::uint64_t count_, itemBytes_;
  std::string piece_;
  std::size_t at_ = 0;
  std::uint64_t next_ = 0;
  zip_error_t error_;
};

template <typename Integer>
NpzWriter::Items copyOf(const std::vector<Integer>& values) {
  return [values](std::uint64_t begin, std::uint64_t count, char* out) {
    std::memcpy(out, values.data() + begin, count * sizeof(Integer));
  };
}

}  // namespace

void NpzWriter::add(const std::string& name, const NpyHeader& header, Items items) {
  arrays_.push_back({name, header, std::move(items)});
}

void NpzWriter::add(const std::string& name, const std::vector<std::int32_t>& values,
                    std::vector<std::uint64_t> shape) {
  add(name, NpyHeader{"<i4", std::move(shape)}, copyOf(values));
}

void NpzWriter::add(const std::string& name, const std::vector<std::int64_t>& values,
                    std::vector<std::uint64_t> shape) {
  add(name, NpyHeader{"<i8", std::move(shape)}, copyOf(values));
}

void NpzWriter::addText(const std::string& name, const std::string& ascii) {
  add(name, NpyHeader{fmt::format("|S{}", ascii.size()), {}},
      [ascii](std::uint64_t, std::uint64_t, char* out) { std::ranges::copy(ascii, out); });
}

void NpzWriter::save(const std::filesystem::path& path) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    auto failed = [&](const char* reason) {
      return Error(ErrorKind::disk, RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(reason),
                   RELUCENT_ENGLISH_MESSAGE("disk.check-space-and-permission",
                                            "check that the disk has room and that you may write there"),
                   path.string());
    };
    // Read by libzip while it closes the archive.
    std::vector<std::unique_ptr<NpyStream>> streams;
    int code = 0;
    zip_t* archive = zip_open(temporary.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (archive == nullptr) {
      zip_error_t error;
      zip_error_init_with_code(&error, code);
      Error failure = failed(zip_error_strerror(&error));
      zip_error_fini(&error);
      throw failure;
    }
    auto giveUp = [&](const std::string& reason) {
      zip_discard(archive);
      throw failed(reason.c_str());
    };
    for (const Array& array : arrays_) {
      streams.push_back(std::make_unique<NpyStream>(array.header, array.items));
      zip_source_t* source = zip_source_function(archive, &NpyStream::call, streams.back().get());
      if (source == nullptr) giveUp(zip_strerror(archive));
      zip_int64_t index = zip_file_add(archive, (array.name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
      if (index < 0) {
        zip_source_free(source);
        giveUp(zip_strerror(archive));
      }
      auto entry = static_cast<zip_uint64_t>(index);
      // The first of January 1980: equal matrices make equal files.
      if (zip_set_file_compression(archive, entry, ZIP_CM_STORE, 0) != 0 ||
          zip_file_set_dostime(archive, entry, 0, 0x21, 0) != 0)
        giveUp(zip_strerror(archive));
    }
    if (zip_close(archive) != 0) giveUp(zip_strerror(archive));
  });
}

}  // namespace relucent::transport
