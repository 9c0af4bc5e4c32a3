// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/npz.h"

namespace relucent::transport {
namespace {

constexpr std::uint64_t readBytes = 4 << 20;  // read at once: enough for several threads
/// Of a member's bytes to those of the archive: more than deflated zeros come to.
constexpr std::uint64_t largestRatio = 1100;

}  // namespace

struct NpzReader::Archive {
  zip_t* zip = nullptr;
  std::uint64_t bytes = 0;
};

/// An open member that closes itself.
class NpzReader::Member {
 public:
  Member(zip_t* archive, zip_uint64_t index) : file_(zip_fopen_index(archive, index, 0)) {}
  ~Member() {
    if (file_ != nullptr) zip_fclose(file_);
  }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  bool read(char* out, std::uint64_t bytes) {
    while (file_ != nullptr && bytes > 0) {
      zip_int64_t got = zip_fread(file_, out, bytes);
      if (got <= 0) return false;
      out += got;
      bytes -= static_cast<std::uint64_t>(got);
    }
    return bytes == 0;
  }

  /// Reading to the very end makes libzip compare the checksum.
  bool isAtEnd() {
    char beyond;
    return zip_fread(file_, &beyond, 1) == 0;
  }

 private:
  zip_file_t* file_;
};

NpzReader::NpzReader(const std::filesystem::path& path) : path_(path), archive_(std::make_unique<Archive>()) {
  int code = 0;
  archive_->zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (archive_->zip != nullptr) {
    std::error_code ignored;
    archive_->bytes = std::filesystem::file_size(path, ignored);
    return;
  }
  if (code == ZIP_ER_NOENT || code == ZIP_ER_OPEN || code == ZIP_ER_READ)
    throw Error(ErrorKind::disk,
                RELUCENT_ENGLISH_MESSAGE("transport.cannot-read-file", "cannot read the file"),
                RELUCENT_MESSAGE("disk.check-path-and-disk", "check the path and the disk"), path.string());
  fail(RELUCENT_ENGLISH_MESSAGE("transport.not-numpy-archive",
                                "is not a NumPy archive, or only a part of one"));
}

NpzReader::~NpzReader() {
  if (archive_ != nullptr && archive_->zip != nullptr) zip_discard(archive_->zip);
}

void NpzReader::fail(const Message& what) const {
  throw Error(ErrorKind::format, RELUCENT_ENGLISH_MESSAGE("transport.wrong-file", "the file {}").with(what),
              RELUCENT_ENGLISH_MESSAGE("transport.save-or-copy-again", "save it again or take another copy"),
              path_.string());
}

bool NpzReader::has(const std::string& name) const {
  return zip_name_locate(archive_->zip, (name + ".npy").c_str(), 0) >= 0;
}

NpyHeader NpzReader::headerOf(Member& member, const std::string& name, std::uint64_t announced) const {
  auto dictionary =
      readNpyDictionary([&](char* out, std::uint64_t bytes) { return member.read(out, bytes); });
  if (!dictionary)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.array-unreadable", "has an array '{}' that cannot be read")
             .with(name));
  auto header = parseNpyDictionary(*dictionary);
  if (!header)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.array-kind-unexpected",
                                  "has an array '{}' of a kind that is not expected")
             .with(name));
  // What the archive can hold must hold what the member announces, and that what the header announces, before
  // anybody takes memory for it.
  std::uint64_t room = announced / largestRatio > archive_->bytes ? 0 : announced / header->itemBytes();
  const bool empty = std::ranges::count(header->shape, 0U) > 0;
  bool fits = empty || room > 0;
  for (const std::uint64_t length : header->shape) {
    if (empty || !fits) break;
    fits = length <= room;
    room /= length;
  }
  if (!fits)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.ends-within-array", "ends within the array '{}'").with(name));
  return *header;
}

void NpzReader::read(const std::string& name, const Take& take) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(archive_->zip, (name + ".npy").c_str(), 0, &stat) != 0)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.no-array", "has no array '{}'").with(name));
  Member member(archive_->zip, stat.index);
  NpyHeader parsed = headerOf(member, name, stat.size);
  std::uint64_t itemBytes = parsed.itemBytes();
  std::uint64_t count = parsed.count(), most = std::max<std::uint64_t>(1, readBytes / itemBytes);
  std::uint64_t inner = count > 0 && !parsed.shape.empty() ? count / parsed.shape[0] : 1;
  if (inner <= most) most -= most % inner;
  // The next piece is read, and its checksum taken, while this one is looked at.
  std::vector<char> piece(std::min(count, most) * itemBytes), next(count > most ? piece.size() : 0);
  auto readAt = [&](std::uint64_t begin, std::vector<char>& into) {
    if (!member.read(into.data(), std::min(most, count - begin) * itemBytes))
      fail(RELUCENT_ENGLISH_MESSAGE("transport.damaged-array", "is damaged in the array '{}'").with(name));
  };
  if (count > 0) readAt(0, piece);
  for (std::uint64_t begin = 0; begin < count; begin += most) {
    std::uint64_t after = begin + most;
    std::function<void()> reading;
    if (after < count) reading = [&] { readAt(after, next); };
    runWithBackground(reading, [&] {
      take(begin, std::min(most, count - begin), piece.data());
      return true;
    });
    std::swap(piece, next);
  }
  if (!member.isAtEnd())
    fail(RELUCENT_ENGLISH_MESSAGE("transport.damaged-array", "is damaged in the array '{}'").with(name));
}

NpyHeader NpzReader::header(const std::string& name) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(archive_->zip, (name + ".npy").c_str(), 0, &stat) != 0)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.no-array", "has no array '{}'").with(name));
  Member member(archive_->zip, stat.index);
  return headerOf(member, name, stat.size);
}

std::vector<std::int64_t> NpzReader::integers(const std::string& name) const {
  NpyHeader kind = header(name);
  bool wide = kind.type == "<i8";
  if (!wide && kind.type != "<i4")
    fail(RELUCENT_ENGLISH_MESSAGE("transport.array-not-integers",
                                  "has an array '{}' of type {} instead of integers")
             .with(name, kind.type));
  std::vector<std::int64_t> values;
  read(name, [&](std::uint64_t begin, std::uint64_t count, const char* items) {
    if (begin == 0) values.reserve(kind.count());
    for (std::uint64_t i = 0; i < count; ++i) {
      std::int64_t value = 0;
      std::int32_t narrow = 0;
      if (wide) std::memcpy(&value, items + 8 * i, 8);
      if (!wide) std::memcpy(&narrow, items + 4 * i, 4);
      values.push_back(wide ? value : narrow);
    }
  });
  return values;
}

std::vector<float> NpzReader::floats(const std::string& name) const {
  NpyHeader kind = header(name);
  if (kind.type != "<f4")
    fail(RELUCENT_ENGLISH_MESSAGE("transport.array-not-float", "has an array '{}' of type {} instead of <f4")
             .with(name, kind.type));
  std::vector<float> values;
  read(name, [&](std::uint64_t begin, std::uint64_t count, const char* items) {
    values.resize(begin + count);
    std::memcpy(values.data() + begin, items, count * sizeof(float));
  });
  return values;
}

std::string NpzReader::text(const std::string& name) const {
  NpyHeader kind = header(name);
  if (!kind.type.starts_with("|S") || kind.count() != 1)
    fail(RELUCENT_ENGLISH_MESSAGE("transport.array-not-text", "has an array '{}' that is not text")
             .with(name));
  std::string text;
  read(name, [&](std::uint64_t, std::uint64_t, const char* items) { text.assign(items, kind.itemBytes()); });
  return text;
}

}  // namespace relucent::transport
