// SPDX-License-Identifier: MIT
#include "transport/files.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <regex>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"

namespace relucent {
namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

namespace {

/// The header of a .npy file, version 1.0, padded as the format asks to a multiple of 64 bytes.
/// Source: NumPy Enhancement Proposal 1.
std::string npyHeader(const std::string& type, const std::string& shape) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  constexpr std::size_t preamble = 10;
  while ((preamble + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  return bytes + header;
}

/// One array on its way into the zip file: a header and then chunks made when they are asked for, so that
/// no second copy of a large array is ever in memory.
struct ArrayStream {
  std::string header;
  std::uint64_t chunks = 0;
  std::function<std::string(std::uint64_t chunk)> chunk;
  std::uint64_t bytes = 0;  // header and chunks together

  zip_error_t error{};
  std::string pending;
  std::size_t given = 0;
  std::uint64_t next = 0;

  void rewind() {
    pending = header;
    given = 0;
    next = 0;
  }
  /// Up to `wanted` bytes; fewer only at the end.
  std::uint64_t read(char* to, std::uint64_t wanted) {
    std::uint64_t done = 0;
    while (done < wanted) {
      if (given == pending.size()) {
        if (next == chunks) break;
        pending = chunk(next++);
        given = 0;
        continue;
      }
      std::uint64_t part = std::min<std::uint64_t>(wanted - done, pending.size() - given);
      std::memcpy(to + done, pending.data() + given, part);
      given += part;
      done += part;
    }
    return done;
  }
};

zip_int64_t answerZip(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  auto* stream = static_cast<ArrayStream*>(user);
  switch (command) {
    case ZIP_SOURCE_OPEN:
      stream->rewind();
      return 0;
    case ZIP_SOURCE_READ:
      return static_cast<zip_int64_t>(stream->read(static_cast<char*>(data), length));
    case ZIP_SOURCE_CLOSE:
      return 0;
    case ZIP_SOURCE_STAT: {
      auto* stat = static_cast<zip_stat_t*>(data);
      zip_stat_init(stat);
      stat->size = stream->bytes;
      stat->valid = ZIP_STAT_SIZE;
      return sizeof(zip_stat_t);
    }
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&stream->error, data, length);
    case ZIP_SOURCE_FREE:
      return 0;
    case ZIP_SOURCE_SUPPORTS:
      return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                            ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
    default:
      return -1;
  }
}

template <typename Value>
constexpr const char* npyType() {
  if constexpr (std::is_same_v<Value, float>) return "<f4";
  if constexpr (std::is_same_v<Value, std::int32_t>) return "<i4";
  if constexpr (std::is_same_v<Value, std::int64_t>) return "<i8";
}

/// An array of `count` values, made by valueAt(i), shaped as `shape` says.
template <typename Value, typename ValueAt>
ArrayStream arrayOf(std::uint64_t count, const std::string& shape, ValueAt valueAt) {
  constexpr std::uint64_t perChunk = 1 << 16;
  ArrayStream stream;
  stream.header = npyHeader(npyType<Value>(), shape);
  stream.chunks = (count + perChunk - 1) / perChunk;
  stream.bytes = stream.header.size() + count * sizeof(Value);
  stream.chunk = [count, valueAt](std::uint64_t chunk) mutable {
    std::uint64_t begin = chunk * perChunk;
    std::uint64_t end = std::min(count, begin + perChunk);
    std::string bytes((end - begin) * sizeof(Value), '\0');
    for (std::uint64_t i = begin; i < end; ++i) {
      Value value = static_cast<Value>(valueAt(i));
      std::memcpy(bytes.data() + (i - begin) * sizeof(Value), &value, sizeof(Value));
    }
    return bytes;
  };
  return stream;
}

}  // namespace

/// Knows the inside of a BlockSparse, to write and read it without a copy.
class TransportFile {
 public:
  static void write(const fs::path& path, const BlockSparse& matrix);
  static BlockSparse read(const fs::path& path);

 private:
  struct Npy {
    std::string type;
    std::vector<std::uint64_t> shape;
    std::string content;  // after the header
  };
  static Npy readArray(zip_t* archive, const std::string& name, const fs::path& path);
  static std::vector<std::int64_t> wholeNumbers(const Npy& array, const fs::path& path);
};

namespace {

[[noreturn]] void failForeign(const fs::path& path, const std::string& what) {
  throw Error(ErrorKind::format, what, "restore the file from a copy, or calibrate again", path.string());
}

struct ZipCloser {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

using NamedArrays = std::vector<std::pair<std::string, ArrayStream>>;

std::size_t rowOf(const std::vector<std::size_t>& rowStart, std::size_t entry) {
  return static_cast<std::size_t>(std::upper_bound(rowStart.begin(), rowStart.end(), entry) -
                                  rowStart.begin()) -
         1;
}

/// The arrays of a BSR matrix of 3x3 blocks. `valueAt(i)`: value i of all blocks laid end to end.
template <typename RowStartAt, typename ColumnAt, typename ValueAt>
NamedArrays bsrArrays(std::uint64_t rows, std::uint64_t columns, std::uint64_t blocks, RowStartAt rowStartAt,
                      ColumnAt columnAt, ValueAt valueAt) {
  bool wide =
      std::max(blocks, columns) > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  auto indexArray = [&](std::uint64_t count, auto indexAt) {
    std::string shape = fmt::format("({},)", count);
    return wide ? arrayOf<std::int64_t>(count, shape, indexAt) : arrayOf<std::int32_t>(count, shape, indexAt);
  };
  NamedArrays arrays;
  arrays.emplace_back("indices", indexArray(blocks, columnAt));
  arrays.emplace_back("indptr", indexArray(rows + 1, rowStartAt));
  ArrayStream format;
  format.header = npyHeader("|S3", "()") + "bsr";
  format.bytes = format.header.size();
  arrays.emplace_back("format", std::move(format));
  auto shapeAt = [=](std::uint64_t i) { return 3 * (i == 0 ? rows : columns); };
  arrays.emplace_back("shape", arrayOf<std::int64_t>(2, "(2,)", shapeAt));
  arrays.emplace_back("data", arrayOf<float>(9 * blocks, fmt::format("({}, 3, 3)", blocks), valueAt));
  return arrays;
}

void writeArchive(const fs::path& path, NamedArrays& arrays) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    auto failZip = [&](const char* why) {
      throw Error(ErrorKind::disk, fmt::format("cannot write ({})", why),
                  "check that the disk has space and may be written to", path.string());
    };
    int code = 0;
    std::unique_ptr<zip_t, ZipCloser> archive(zip_open(temporary.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
    if (!archive) {
      zip_error_t error;
      zip_error_init_with_code(&error, code);
      std::string why = zip_error_strerror(&error);
      zip_error_fini(&error);
      failZip(why.c_str());
    }
    for (auto& [name, stream] : arrays) {
      zip_source_t* source = zip_source_function(archive.get(), answerZip, &stream);
      zip_int64_t index =
          source == nullptr ? -1
                            : zip_file_add(archive.get(), (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
      if (index < 0 ||
          zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) != 0)
        failZip(zip_strerror(archive.get()));
    }
    if (zip_close(archive.get()) != 0) failZip(zip_strerror(archive.get()));
    archive.release();
  });
}

}  // namespace

void TransportFile::write(const fs::path& path, const BlockSparse& matrix) {
  // Values come entry by entry, so the row advances with them; a look-up is needed only after a rewind.
  std::size_t row = 0;
  auto valueAt = [&matrix, row](std::uint64_t i) mutable {
    std::uint64_t entry = i / 9;
    if (entry < matrix.rowStart_[row]) row = rowOf(matrix.rowStart_, entry);
    while (entry >= matrix.rowStart_[row + 1]) ++row;
    return matrix.scale_[row] * static_cast<float>(matrix.code_[entry][i % 9]);
  };
  NamedArrays arrays = bsrArrays(
      matrix.rows(), matrix.columns(), matrix.blocks(), [&](std::uint64_t i) { return matrix.rowStart_[i]; },
      [&](std::uint64_t i) { return matrix.column_[i]; }, valueAt);
  arrays.emplace_back("scale", arrayOf<float>(matrix.rows(), fmt::format("({},)", matrix.rows()),
                                              [&](std::uint64_t i) { return matrix.scale_[i]; }));
  writeArchive(path, arrays);
}

TransportFile::Npy TransportFile::readArray(zip_t* archive, const std::string& name, const fs::path& path) {
  std::string member = name + ".npy";
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(archive, member.c_str(), 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0)
    failForeign(path, fmt::format("the file holds no array \"{}\"", name));
  // A damaged size must not ask for memory that the file cannot fill.
  if (stat.comp_method == ZIP_CM_STORE && stat.size > fs::file_size(path))
    failForeign(path, fmt::format("the array \"{}\" is cut short", name));
  std::string bytes(stat.size, '\0');
  std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(archive, member.c_str(), 0), zip_fclose);
  // The last read is what makes the library compare the checksum.
  char beyond = 0;
  if (!file || zip_fread(file.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size()) ||
      zip_fread(file.get(), &beyond, 1) != 0)
    failForeign(path, fmt::format("the array \"{}\" is damaged", name));

  constexpr std::size_t preamble = 10;
  if (bytes.size() < preamble || bytes.compare(0, 6, "\x93NUMPY") != 0 || bytes[6] != 1)
    failForeign(path, fmt::format("\"{}\" is no array of NumPy's first format", name));
  std::size_t length = static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  if (bytes.size() < preamble + length) failForeign(path, fmt::format("the array \"{}\" is cut short", name));
  std::string header = bytes.substr(preamble, length);
  static const std::regex form(
      R"(\{'descr': '([^']*)', 'fortran_order': False, 'shape': \(([0-9, ]*)\),? ?\}\s*)");
  std::smatch parts;
  if (!std::regex_match(header, parts, form))
    failForeign(path, fmt::format("the array \"{}\" is stored in a way that is not read here", name));

  Npy array;
  array.type = parts[1];
  std::string shape = parts[2];
  static const std::regex number("[0-9]+");
  for (std::sregex_iterator i(shape.begin(), shape.end(), number), end; i != end; ++i)
    array.shape.push_back(std::stoull(i->str()));
  array.content = bytes.substr(preamble + length);
  return array;
}

std::vector<std::int64_t> TransportFile::wholeNumbers(const Npy& array, const fs::path& path) {
  std::size_t width = array.type == "<i4" ? 4 : array.type == "<i8" ? 8 : 0;
  if (width == 0 || array.shape.size() != 1 || array.content.size() != array.shape[0] * width)
    failForeign(path, "an index array is inconsistent");
  std::vector<std::int64_t> values(array.shape[0]);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::int32_t narrow = 0;
    if (width == 4) {
      std::memcpy(&narrow, array.content.data() + i * 4, 4);
      values[i] = narrow;
    } else {
      std::memcpy(&values[i], array.content.data() + i * 8, 8);
    }
  }
  return values;
}

BlockSparse TransportFile::read(const fs::path& path) {
  std::error_code unreadable;
  if (!fs::is_regular_file(path, unreadable))
    throw Error(ErrorKind::disk, "the file is missing", "check the path", path.string());
  int code = 0;
  std::unique_ptr<zip_t, ZipCloser> archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) failForeign(path, "the file is no SciPy matrix, or it is cut short");

  if (readArray(archive.get(), "format", path).content != "bsr")
    failForeign(path, "the matrix is not stored as blocks (BSR)");
  std::vector<std::int64_t> shape = wholeNumbers(readArray(archive.get(), "shape", path), path);
  std::vector<std::int64_t> rowStart = wholeNumbers(readArray(archive.get(), "indptr", path), path);
  std::vector<std::int64_t> columns = wholeNumbers(readArray(archive.get(), "indices", path), path);
  Npy data = readArray(archive.get(), "data", path);

  bool consistent =
      shape.size() == 2 && shape[0] >= 0 && shape[1] >= 0 && shape[0] % 3 == 0 && shape[1] % 3 == 0;
  consistent =
      consistent && rowStart.size() == static_cast<std::size_t>(shape[0] / 3) + 1 && rowStart[0] == 0;
  consistent = consistent && std::is_sorted(rowStart.begin(), rowStart.end()) &&
               rowStart.back() == static_cast<std::int64_t>(columns.size());
  std::vector<std::uint64_t> blockShape{columns.size(), 3, 3};
  consistent = consistent && data.type == "<f4" && data.shape == blockShape &&
               data.content.size() == columns.size() * 9 * sizeof(float);
  if (consistent)
    consistent = std::all_of(columns.begin(), columns.end(),
                             [&](std::int64_t column) { return column >= 0 && column < shape[1] / 3; });
  if (!consistent) failForeign(path, "the matrix's arrays contradict each other");

  BlockSparse matrix;
  matrix.columns_ = static_cast<std::size_t>(shape[1] / 3);
  matrix.rowStart_.assign(rowStart.begin(), rowStart.end());
  matrix.column_.assign(columns.begin(), columns.end());
  columns = {};
  auto value = [&](std::size_t i) {
    float sample = 0.0f;
    std::memcpy(&sample, data.content.data() + i * sizeof(float), sizeof(float));
    return sample;
  };
  matrix.scale_.assign(matrix.rows(), 0.0f);
  if (zip_name_locate(archive.get(), "scale.npy", 0) >= 0) {
    Npy scale = readArray(archive.get(), "scale", path);
    if (scale.type != "<f4" || scale.content.size() != matrix.rows() * sizeof(float))
      failForeign(path, "the matrix's arrays contradict each other");
    std::memcpy(matrix.scale_.data(), scale.content.data(), scale.content.size());
  } else {
    for (std::size_t row = 0; row < matrix.rows(); ++row)
      for (std::size_t i = 9 * matrix.rowStart_[row]; i < 9 * matrix.rowStart_[row + 1]; ++i)
        matrix.scale_[row] = std::max(matrix.scale_[row], std::abs(value(i)) / 32767.0f);
  }
  matrix.code_.resize(matrix.column_.size());
  std::atomic<bool> finite = true;
  parallelFor(0, matrix.rows(), 256, [&](std::size_t row) {
    float scale = matrix.scale_[row];
    for (std::size_t entry = matrix.rowStart_[row]; entry < matrix.rowStart_[row + 1]; ++entry) {
      for (std::size_t i = 0; i < 9; ++i) {
        float sample = value(9 * entry + i);
        if (!std::isfinite(sample)) finite = false;
        float quotient = scale > 0.0f ? std::round(sample / scale) : 0.0f;
        matrix.code_[entry][i] = static_cast<std::int16_t>(std::clamp(quotient, -32767.0f, 32767.0f));
      }
    }
  });
  if (!finite) failForeign(path, "the matrix holds values that are not numbers");
  return matrix;
}

void writeNpz(const fs::path& path, const PixelMatrix& matrix) {
  NamedArrays arrays = bsrArrays(
      matrix.rowStart.size() - 1, matrix.columns, matrix.column.size(),
      [&](std::uint64_t i) { return matrix.rowStart[i]; }, [&](std::uint64_t i) { return matrix.column[i]; },
      [&](std::uint64_t i) { return matrix.values[i]; });
  writeArchive(path, arrays);
}

void writeNpz(const fs::path& path, const BlockSparse& matrix) {
  TransportFile::write(path, matrix);
}

BlockSparse readNpz(const fs::path& path) {
  return TransportFile::read(path);
}

}  // namespace relucent
