// SPDX-License-Identifier: MIT
#include "transport/npz.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"

namespace relucent {
namespace {

static_assert(std::endian::native == std::endian::little, "NumPy files are written in memory order");

constexpr std::uint64_t pieceBytes = 1 << 20;  // written at once
constexpr std::uint64_t readBytes = 4 << 20;   // read at once: enough for several threads
constexpr char magic[] = "\x93NUMPY";
constexpr std::size_t magicBytes = 6;
// Enough for any array of ours; a larger header is not one.
constexpr std::size_t longestHeader = 4096;

/// The .npy header, version 1.0: padded so that the data begins at a multiple of 64 bytes.
std::string npyHeaderText(const NpyHeader& header) {
  std::string shape;
  for (std::uint64_t length : header.shape) shape += fmt::format("{}, ", length);
  if (header.shape.size() > 1) shape.resize(shape.size() - 2);
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", header.type, shape);
  constexpr std::size_t prefix = magicBytes + 4;
  dictionary.append(63 - (prefix + dictionary.size()) % 64, ' ');
  dictionary += '\n';
  std::string text(magic, magicBytes);
  text += {'\x01', '\x00', static_cast<char>(dictionary.size() & 0xff),
           static_cast<char>(dictionary.size() >> 8)};
  return text + dictionary;
}

/// One .npy file as libzip wants to read it.
class NpyStream {
 public:
  NpyStream(const NpyHeader& header, NpzWriter::Items items)
      : head_(npyHeaderText(header)),
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

/// The text between `key` and the end of its value in a .npy dictionary.
std::string valueOf(const std::string& dictionary, const std::string& key, char open, char close) {
  std::size_t at = dictionary.find("'" + key + "'");
  if (at == std::string::npos) return {};
  std::size_t begin = dictionary.find(open, at + key.size() + 2);
  std::size_t end = begin == std::string::npos ? begin : dictionary.find(close, begin + 1);
  return end == std::string::npos ? std::string() : dictionary.substr(begin + 1, end - begin - 1);
}

bool parseShape(const std::string& text, std::vector<std::uint64_t>& shape) {
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    if (at == end) return true;
    std::uint64_t length = 0;
    auto [next, code] = std::from_chars(at, end, length);
    if (code != std::errc() || length > (std::uint64_t{1} << 48)) return false;
    shape.push_back(length);
    at = next;
  }
}

}  // namespace

std::uint64_t NpyHeader::count() const {
  std::uint64_t count = 1;
  for (std::uint64_t length : shape) count *= length;
  return count;
}

std::size_t NpyHeader::itemBytes() const {
  std::size_t bytes = 0;
  if (type.size() > 2) std::from_chars(type.data() + 2, type.data() + type.size(), bytes);
  return bytes;
}

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
      [ascii](std::uint64_t, std::uint64_t, char* out) { std::memcpy(out, ascii.data(), ascii.size()); });
}

void NpzWriter::save(const std::filesystem::path& path) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    auto failed = [&](const char* reason) {
      return Error(ErrorKind::disk, fmt::format("cannot write ({})", reason),
                   "check that the disk has room and that you may write there", path.string());
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

struct NpzReader::Archive {
  zip_t* zip = nullptr;
};

NpzReader::NpzReader(const std::filesystem::path& path) : path_(path), archive_(std::make_unique<Archive>()) {
  int code = 0;
  archive_->zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (archive_->zip != nullptr) return;
  if (code == ZIP_ER_NOENT || code == ZIP_ER_OPEN || code == ZIP_ER_READ)
    throw Error(ErrorKind::disk, "cannot read the file", "check the path and the disk", path.string());
  fail("is not a NumPy archive, or only a part of one");
}

NpzReader::~NpzReader() {
  if (archive_ != nullptr && archive_->zip != nullptr) zip_discard(archive_->zip);
}

void NpzReader::fail(const std::string& what) const {
  throw Error(ErrorKind::format, "the file " + what, "save it again or take another copy", path_.string());
}

bool NpzReader::has(const std::string& name) const {
  return zip_name_locate(archive_->zip, (name + ".npy").c_str(), 0) >= 0;
}

namespace {

/// An open member that closes itself.
struct Member {
  zip_file_t* file = nullptr;
  ~Member() {
    if (file != nullptr) zip_fclose(file);
  }
  bool read(char* out, std::uint64_t bytes) {
    while (bytes > 0) {
      zip_int64_t got = zip_fread(file, out, bytes);
      if (got <= 0) return false;
      out += got;
      bytes -= static_cast<std::uint64_t>(got);
    }
    return true;
  }
};

bool readHeader(Member& member, std::string& dictionary) {
  char prefix[magicBytes + 2];
  if (!member.read(prefix, sizeof(prefix)) || std::memcmp(prefix, magic, magicBytes) != 0) return false;
  unsigned char length[4] = {};
  bool first = prefix[magicBytes] == 1;
  if (!member.read(reinterpret_cast<char*>(length), first ? 2 : 4)) return false;
  std::size_t bytes = length[0] + 256u * length[1] + 65536u * length[2] + 16777216u * length[3];
  if (bytes > longestHeader) return false;
  dictionary.resize(bytes);
  return member.read(dictionary.data(), bytes);
}

}  // namespace

void NpzReader::read(const std::string& name, const Take& take) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(archive_->zip, (name + ".npy").c_str(), 0, &stat) != 0)
    fail(fmt::format("has no array '{}'", name));
  Member member{zip_fopen_index(archive_->zip, stat.index, 0)};
  std::string dictionary;
  if (member.file == nullptr || !readHeader(member, dictionary))
    fail(fmt::format("has an array '{}' that cannot be read", name));

  NpyHeader parsed;
  parsed.type = valueOf(dictionary, "descr", '\'', '\'');
  if (!parseShape(valueOf(dictionary, "shape", '(', ')'), parsed.shape) || parsed.itemBytes() == 0 ||
      dictionary.find("'fortran_order': False") == std::string::npos)
    fail(fmt::format("has an array '{}' of a kind that is not expected", name));
  std::uint64_t itemBytes = parsed.itemBytes();
  // What the zip announces must hold what the header announces, before memory is taken for it.
  std::uint64_t room = stat.size / itemBytes;
  bool empty = std::find(parsed.shape.begin(), parsed.shape.end(), 0u) != parsed.shape.end();
  for (std::uint64_t length : parsed.shape) {
    if (empty) break;
    if (length > room) fail(fmt::format("ends within the array '{}'", name));
    room /= length;
  }
  std::uint64_t count = parsed.count(), most = std::max<std::uint64_t>(1, readBytes / itemBytes);
  std::uint64_t inner = count > 0 && !parsed.shape.empty() ? count / parsed.shape[0] : 1;
  if (inner <= most) most -= most % inner;
  // The next piece is read, and its checksum taken, while this one is looked at.
  std::vector<char> piece(std::min(count, most) * itemBytes), next(count > most ? piece.size() : 0);
  auto readAt = [&](std::uint64_t begin, std::vector<char>& into) {
    if (!member.read(into.data(), std::min(most, count - begin) * itemBytes))
      fail(fmt::format("is damaged in the array '{}'", name));
  };
  if (count > 0) readAt(0, piece);
  for (std::uint64_t begin = 0; begin < count; begin += most) {
    std::uint64_t after = begin + most;
    std::function<void()> reading;
    if (after < count) reading = [&] { readAt(after, next); };
    besides(reading, [&] {
      take(begin, std::min(most, count - begin), piece.data());
      return true;
    });
    std::swap(piece, next);
  }
  // Reading to the very end makes libzip compare the checksum.
  char beyond;
  if (zip_fread(member.file, &beyond, 1) != 0) fail(fmt::format("is damaged in the array '{}'", name));
}

NpyHeader NpzReader::header(const std::string& name) const {
  zip_int64_t index = zip_name_locate(archive_->zip, (name + ".npy").c_str(), 0);
  if (index < 0) fail(fmt::format("has no array '{}'", name));
  Member member{zip_fopen_index(archive_->zip, static_cast<zip_uint64_t>(index), 0)};
  std::string dictionary;
  if (member.file == nullptr || !readHeader(member, dictionary))
    fail(fmt::format("has an array '{}' that cannot be read", name));
  NpyHeader parsed;
  parsed.type = valueOf(dictionary, "descr", '\'', '\'');
  if (!parseShape(valueOf(dictionary, "shape", '(', ')'), parsed.shape))
    fail(fmt::format("has an array '{}' of a kind that is not expected", name));
  return parsed;
}

std::vector<std::int64_t> NpzReader::integers(const std::string& name) const {
  NpyHeader kind = header(name);
  bool wide = kind.type == "<i8";
  if (!wide && kind.type != "<i4")
    fail(fmt::format("has an array '{}' of type {} instead of integers", name, kind.type));
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
  if (kind.type != "<f4") fail(fmt::format("has an array '{}' of type {} instead of <f4", name, kind.type));
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
    fail(fmt::format("has an array '{}' that is no text", name));
  std::string text;
  read(name, [&](std::uint64_t, std::uint64_t, const char* items) { text.assign(items, kind.itemBytes()); });
  return text;
}

}  // namespace relucent
