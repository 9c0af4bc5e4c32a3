// SPDX-License-Identifier: MIT
#include "relucent/transport/files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/transport/npz.h"
#include "relucent/transport/npz_rasters.h"
#include "relucent/transport/row_cursor.h"
#include "relucent/transport/shared_colours.h"

namespace relucent::transport {
namespace {

constexpr const char* codeType = "<i2";
constexpr const char* ownColours = "bsr";  // as SciPy calls it
constexpr const char* sharedColours = "relucent-shared-colours";
constexpr const char* sharedLeaves = "relucent-shared-leaves";
constexpr std::uint64_t largestInt32 = std::numeric_limits<std::int32_t>::max();

/// Writes integers in 32 bits where they all fit, else in 64.
template <typename At>
void addIndices(NpzWriter& writer, const std::string& name, std::uint64_t count, bool wide, const At& at) {
  writer.add(name, {wide ? "<i8" : "<i4", {count}}, [=](std::uint64_t begin, std::uint64_t items, char* out) {
    for (std::uint64_t i = 0; i < items; ++i) {
      std::int64_t value = at(begin + i);
      auto narrow = static_cast<std::int32_t>(value);
      if (wide) std::memcpy(out + 8 * i, &value, 8);
      if (!wide) std::memcpy(out + 4 * i, &narrow, 4);
    }
  });
}

void addFrame(NpzWriter& writer, std::size_t rows, std::size_t columns, const char* format = ownColours) {
  writer.addText("format", format);
  writer.add(
      "shape",
      std::vector<std::int64_t>{static_cast<std::int64_t>(3 * rows), static_cast<std::int64_t>(3 * columns)},
      {2});
}

}  // namespace

/// Reads and writes the private arrays of BlockSparse, so that nothing is held twice.
class TransportFile {
 public:
  static void add(NpzWriter& writer, const BlockSparse& blocks, StoredValues values,
                  const char* sharedFormat = sharedColours) {
    const bool shared = values == StoredValues::codes && blocks.sharedColours();
    addFrame(writer, blocks.rows(), blocks.columns(), shared ? sharedFormat : ownColours);
    const BlockSparse* source = &blocks;
    addPlaces(writer, "", blocks);
    if (shared) {
      addSharedColours(writer, blocks);
      return;
    }
    // Values of shared colours are not on a grid of their row's.
    if (!blocks.sharedColours())
      writer.add("scale", {"<f4", {blocks.rows()}},
                 [source](std::uint64_t begin, std::uint64_t count, char* out) {
                   std::memcpy(out, source->scale_.data() + begin, count * sizeof(float));
                 });
    if (values == StoredValues::codes) {
      writer.add("data", {codeType, {blocks.blocks(), 3, 3}},
                 [source](std::uint64_t begin, std::uint64_t count, char* out) {
                   if (count > 0)
                     std::memcpy(out, source->code_.front().data() + begin, count * sizeof(std::int16_t));
                 });
      return;
    }
    auto cursor = std::make_shared<RowCursor>();
    writer.add("data", {"<f4", {blocks.blocks(), 3, 3}},
               [source, cursor](std::uint64_t begin, std::uint64_t count, char* out) {
                 for (std::uint64_t item = begin; item < begin + count; ++item) {
                   std::uint64_t entry = item / 9;
                   std::size_t row =
                       cursor->rowOf(entry, [&](std::size_t r) { return source->rowStart_[r]; });
                   float value = source->block(row, entry).data()[item % 9];
                   std::memcpy(out + sizeof(float) * (item - begin), &value, sizeof(float));
                 }
               });
  }

  /// Groups' leaves have no colours of their own, and their rows and columns follow from the others.
  static void addGroups(NpzWriter& writer, const LeafGroups& groups) {
    addPlaces(writer, "group_", groups.leaves());
    addFactors(writer, "group_", groups.leaves());
    auto addNumbers = [&writer](const char* name, const std::vector<std::uint32_t>& numbers) {
      const std::vector<std::uint32_t>* source = &numbers;
      addIndices(writer, name, numbers.size(), false, [source](std::uint64_t i) {
        return (*source)[i] == LeafGroups::none ? std::int64_t{-1} : std::int64_t{(*source)[i]};
      });
    };
    addNumbers("group_parent", groups.parents());
    addNumbers("group_of", groups.groupsOfPixels());
  }

  static bool hasGroups(const NpzReader& reader) { return reader.text("format") == sharedLeaves; }

  static LeafGroups readGroups(const NpzReader& reader, std::size_t pixels, const NodeLayout& layout) {
    auto fail = [&] {
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.shared-leaves-invalid",
                                           "has shared leaves that do not fit its cameras and projectors"));
    };
    auto numbers = [&](const char* name) {
      std::vector<std::uint32_t> result;
      for (std::int64_t value : reader.integers(name)) {
        if (value < -1 || value > static_cast<std::int64_t>(largestInt32)) fail();
        result.push_back(value < 0 ? LeafGroups::none : static_cast<std::uint32_t>(value));
      }
      return result;
    };
    std::vector<std::uint32_t> parent = numbers("group_parent"), groupOf = numbers("group_of");
    const std::size_t projectors = layout.projectors().devices();
    if (groupOf.size() != pixels * projectors || !LeafGroups::areSound(parent, groupOf)) fail();
    BlockSparse leaves;
    leaves.columns_ = layout.count();
    leaves.rowStart_.assign(parent.size() + 1, 0);
    leaves.kinds_ = LeafGroups::withoutColours(layout.count());
    readIndices(reader, leaves, "group_");
    if (leaves.rows() != parent.size()) fail();
    readFactors(reader, leaves, "group_");
    leaves.mixing_.assign(parent.size(), ColourBlock::Identity());
    leaves.scale_.assign(parent.size(), BlockSparse::stepOf({leaves.mixing_.data(), 1}));
    if (parent.empty()) leaves.scale_.clear();
    return LeafGroups(projectors, std::move(leaves), std::move(parent), std::move(groupOf));
  }

  static BlockSparse read(const NpzReader& reader) {
    const std::string format = reader.text("format");
    if (format != ownColours && format != sharedColours && format != sharedLeaves)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.not-bsr", "holds a matrix in another form than BSR"));
    BlockSparse blocks;
    readShape(reader, blocks);
    readIndices(reader, blocks, "");
    if (format != ownColours) {
      readSharedColours(reader, blocks);
      return blocks;
    }
    const bool codes = reader.header("data").type == codeType;
    if (codes && !reader.has("scale"))
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.codes-without-scale", "has codes without a scale"));
    readScale(reader, blocks);
    if (codes)
      readCodes(reader, blocks);
    else
      readData(reader, blocks);
    return blocks;
  }

  static void addTo(Fingerprint& fingerprint, const BlockSparse& blocks) {
    fingerprint.add(blocks.columns_).add(blocks.rowStart_).add(blocks.scale_).add(blocks.kinds_.count);
    for (const ColumnKinds::Range& range : blocks.kinds_.ranges) fingerprint.add(range.end).add(range.kind);
    const auto addAll = [&](const auto& values) {
      fingerprint.addBytes(values.data(), values.size() * sizeof(values[0]));
    };
    addAll(blocks.column_);
    addAll(blocks.code_);
    addAll(blocks.factor_);
    addAll(blocks.mixing_);
  }

 private:
  static void addPlaces(NpzWriter& writer, const std::string& prefix, const BlockSparse& blocks) {
    const bool wide = blocks.blocks() > largestInt32 || blocks.columns() > largestInt32;
    const BlockSparse* source = &blocks;
    addIndices(writer, prefix + "indptr", blocks.rows() + 1, wide,
               [source](std::uint64_t i) { return static_cast<std::int64_t>(source->rowStart_[i]); });
    addIndices(writer, prefix + "indices", blocks.blocks(), wide,
               [source](std::uint64_t i) { return static_cast<std::int64_t>(source->column_[i]); });
  }

  static void addFactors(NpzWriter& writer, const std::string& prefix, const BlockSparse& blocks) {
    const BlockSparse* source = &blocks;
    writer.add(prefix + "factor", {codeType, {blocks.blocks(), 3}},
               [source](std::uint64_t begin, std::uint64_t count, char* out) {
                 if (count > 0)
                   std::memcpy(out, source->factor_.front().data() + begin, count * sizeof(std::int16_t));
               });
  }

  static void readFactors(const NpzReader& reader, BlockSparse& blocks, const std::string& prefix) {
    const NpyHeader header = reader.header(prefix + "factor");
    if (header.shape != std::vector<std::uint64_t>{blocks.blocks(), 3} || header.type != codeType)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.shared-colours-invalid",
                                           "has shared colours that do not fit its rows and columns"));
    blocks.factor_.resize(blocks.blocks());
    reader.read(prefix + "factor", [&](std::uint64_t begin, std::uint64_t items, const char* in) {
      if (items > 0) std::memcpy(blocks.factor_.front().data() + begin, in, items * sizeof(std::int16_t));
    });
  }

  static void addSharedColours(NpzWriter& writer, const BlockSparse& blocks) {
    const BlockSparse* source = &blocks;
    const ColumnKinds& kinds = *blocks.sharedColours();
    std::vector<std::int64_t> ranges;
    for (const ColumnKinds::Range& range : kinds.ranges) ranges.insert(ranges.end(), {range.end, range.kind});
    writer.add("kinds", ranges, {kinds.ranges.size(), 2});
    writer.add("mixing", {"<f4", {blocks.rows(), kinds.count, 3, 3}},
               [source](std::uint64_t begin, std::uint64_t count, char* out) {
                 if (count > 0)
                   std::memcpy(out, source->mixing_.front().data() + begin, count * sizeof(float));
               });
    addFactors(writer, "", blocks);
  }

  static void readSharedColours(const NpzReader& reader, BlockSparse& blocks) {
    auto fail = [&] {
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.shared-colours-invalid",
                                           "has shared colours that do not fit its rows and columns"));
    };
    const std::vector<std::int64_t> ranges = reader.integers("kinds");
    const std::vector<std::uint64_t> shape = reader.header("mixing").shape;
    if (ranges.empty() || ranges.size() % 2 != 0 || shape.size() != 4 || shape[0] != blocks.rows() ||
        shape[1] == 0 || shape[2] != 3 || shape[3] != 3)
      fail();
    std::int64_t end = 0;
    for (std::size_t i = 0; i < ranges.size(); i += 2) {
      if (ranges[i] <= end || ranges[i] > static_cast<std::int64_t>(blocks.columns_) || ranges[i + 1] < 0 ||
          static_cast<std::uint64_t>(ranges[i + 1]) >= shape[1])
        fail();
      end = ranges[i];
      blocks.kinds_.ranges.push_back(
          {static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(ranges[i + 1])});
    }
    if (end != static_cast<std::int64_t>(blocks.columns_)) fail();
    blocks.kinds_.count = shape[1];
    if (reader.header("mixing").type != "<f4") fail();

    blocks.mixing_.resize(blocks.rows() * shape[1]);
    reader.read("mixing", [&](std::uint64_t begin, std::uint64_t items, const char* in) {
      if (items > 0) std::memcpy(blocks.mixing_.front().data() + begin, in, items * sizeof(float));
    });
    readFactors(reader, blocks, "");
    blocks.scale_.reserve(blocks.rows());
    for (std::size_t row = 0; row < blocks.rows(); ++row) {
      blocks.scale_.push_back(BlockSparse::stepOf({&blocks.mixing_[row * shape[1]], shape[1]}));
      if (!std::isfinite(blocks.scale_.back()))
        reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.scale-not-finite",
                                             "has a scale that is not a finite number"));
    }
  }

  static void readShape(const NpzReader& reader, BlockSparse& blocks) {
    std::vector<std::int64_t> shape = reader.integers("shape");
    constexpr std::int64_t largest = 3 * static_cast<std::int64_t>(std::numeric_limits<std::uint32_t>::max());
    if (shape.size() != 2 || shape[0] < 0 || shape[1] < 0 || shape[0] > largest || shape[1] > largest ||
        shape[0] % 3 != 0 || shape[1] % 3 != 0)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.shape-not-3x3-blocks",
                                           "has a shape that is not of 3x3 blocks"));
    blocks.columns_ = static_cast<std::size_t>(shape[1] / 3);
    if (reader.header("indptr").count() != static_cast<std::uint64_t>(shape[0] / 3) + 1)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.indptr-count-differs",
                                           "has another number of rows in 'indptr' than in 'shape'"));
  }

  static void readIndices(const NpzReader& reader, BlockSparse& blocks, const std::string& prefix) {
    std::uint64_t count = reader.header(prefix + "indices").count();
    std::vector<std::int64_t> start = reader.integers(prefix + "indptr");
    bool ordered = !start.empty() && start.front() == 0 && start.back() == static_cast<std::int64_t>(count) &&
                   std::is_sorted(start.begin(), start.end());
    if (!ordered)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.indptr-invalid",
                                           "has rows in 'indptr' that do not fit its entries"));
    blocks.rowStart_.assign(start.begin(), start.end());

    NpyHeader header = reader.header(prefix + "indices");
    bool wide = header.type == "<i8";
    if (!wide && header.type != "<i4")
      reader.fail(
          RELUCENT_ENGLISH_MESSAGE("transport.indices-not-integers", "has indices that are not integers"));
    RowCursor cursor;
    reader.read(prefix + "indices", [&](std::uint64_t begin, std::uint64_t items, const char* in) {
      if (begin == 0) blocks.column_.reserve(count);
      for (std::uint64_t i = 0; i < items; ++i) {
        std::int64_t column = 0;
        std::int32_t narrow = 0;
        if (wide) std::memcpy(&column, in + 8 * i, 8);
        if (!wide) std::memcpy(&narrow, in + 4 * i, 4);
        if (!wide) column = narrow;
        if (column < 0 || column >= static_cast<std::int64_t>(blocks.columns_))
          reader.fail(
              RELUCENT_ENGLISH_MESSAGE("transport.index-outside-shape", "has an index outside its shape"));
        std::size_t row = cursor.rowOf(begin + i, [&](std::size_t r) { return blocks.rowStart_[r]; });
        if (begin + i > blocks.rowStart_[row] && column <= static_cast<std::int64_t>(blocks.column_.back()))
          reader.fail(RELUCENT_ENGLISH_MESSAGE(
              "transport.indices-not-ascending",
              "has indices that do not ascend (sum_duplicates() and sort_indices() in SciPy mend that)"));
        blocks.column_.push_back(static_cast<std::uint32_t>(column));
      }
    });
  }

  static void readScale(const NpzReader& reader, BlockSparse& blocks) {
    if (reader.has("scale")) {
      blocks.scale_ = reader.floats("scale");
      if (blocks.scale_.size() != blocks.rows())
        reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.scale-count-differs",
                                             "has another number of rows in 'scale' than in 'shape'"));
      for (float scale : blocks.scale_)
        if (!(scale >= 0.0f) || !std::isfinite(scale))
          reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.scale-not-finite",
                                               "has a scale that is not a finite number"));
      return;
    }
    blocks.scale_.assign(blocks.rows(), 0.0f);
    // One after the other: a row may lie in two parts.
    eachBlock(reader, blocks, 1, [&](std::size_t row, std::uint64_t, const NineValues& values) {
      for (float value : values)
        blocks.scale_[row] = std::max(blocks.scale_[row], std::abs(value) / largestCode);
    });
  }

  static void readCodes(const NpzReader& reader, BlockSparse& blocks) {
    requireBlockShape(reader, blocks);
    blocks.code_.resize(blocks.blocks());
    reader.read("data", [&](std::uint64_t begin, std::uint64_t items, const char* in) {
      if (items > 0) std::memcpy(blocks.code_.front().data() + begin, in, items * sizeof(std::int16_t));
    });
    for (const auto& code : blocks.code_)
      if (std::ranges::find(code, std::numeric_limits<std::int16_t>::min()) != code.end())
        reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.values-exceed-scale",
                                             "has values in 'data' that do not fit their row's scale"));
  }

  static void requireBlockShape(const NpzReader& reader, const BlockSparse& blocks) {
    if (reader.header("data").shape != std::vector<std::uint64_t>{blocks.blocks(), 3, 3})
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.block-count-differs",
                                           "has another number of 3x3 blocks in 'data' than in 'indices'"));
  }

  static void readData(const NpzReader& reader, BlockSparse& blocks) {
    blocks.code_.resize(blocks.blocks());
    constexpr std::size_t parts = 16;
    eachBlock(reader, blocks, parts, [&](std::size_t row, std::uint64_t entry, const NineValues& values) {
      float scale = blocks.scale_[row], largest = 0.0f;
      NineValues steps;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        steps[k] = scale > 0.0f ? values[k] / scale : values[k] == 0.0f ? 0.0f : 2.0f * largestCode;
        largest = std::max(largest, std::abs(steps[k]));
      }
      if (!(largest < largestCode + 0.5f))
        reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.values-exceed-scale",
                                             "has values in 'data' that do not fit their row's scale"));
      // To the nearest, in a form that compilers have instructions for.
      for (std::size_t k = 0; k < steps.size(); ++k)
        blocks.code_[entry][k] =
            static_cast<std::int16_t>(static_cast<std::int32_t>(steps[k] + (steps[k] < 0.0f ? -0.5f : 0.5f)));
    });
  }

  using NineValues = std::array<float, 9>;

  /// Gives all blocks to `take`, those of `parts` parts at once.
  template <typename Take>
  static void eachBlock(const NpzReader& reader, const BlockSparse& blocks, std::size_t parts,
                        const Take& take) {
    NpyHeader header = reader.header("data");
    if (header.type != "<f4" && header.type != "<f8")
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.values-not-float",
                                           "has values that are not floating-point numbers"));
    requireBlockShape(reader, blocks);
    bool wide = header.type == "<f8";
    reader.read("data", [&](std::uint64_t begin, std::uint64_t items, const char* in) {
      std::uint64_t firstBlock = begin / 9;
      parallelChunks(firstBlock, (begin + items) / 9, parts,
                     [&](std::size_t, std::uint64_t first, std::uint64_t last) {
                       auto after = std::upper_bound(blocks.rowStart_.begin(), blocks.rowStart_.end(), first);
                       auto row = static_cast<std::size_t>(after - blocks.rowStart_.begin()) - 1;
                       for (std::uint64_t entry = first; entry < last; ++entry) {
                         while (entry >= blocks.rowStart_[row + 1]) ++row;
                         take(row, entry, valuesAt(in, entry - firstBlock, wide, reader));
                       }
                     });
    });
  }

  static NineValues valuesAt(const char* in, std::uint64_t block, bool wide, const NpzReader& reader) {
    NineValues values;
    if (wide) {
      std::array<double, 9> doubles;
      std::memcpy(doubles.data(), in + block * sizeof(doubles), sizeof(doubles));
      std::copy(doubles.begin(), doubles.end(), values.begin());
    } else {
      std::memcpy(values.data(), in + block * sizeof(values), sizeof(values));
    }
    float nothing = 0.0f;
    for (float value : values) nothing += 0.0f * value;  // NaN where one is not finite
    if (nothing != 0.0f)
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.values-not-finite",
                                           "has a value in 'data' that is not a finite number"));
    return values;
  }
};

namespace {

/// A damaged header may ask for any amount of memory.
template <typename Load>
auto withinMemory(const std::filesystem::path& path, const Load& load) {
  try {
    return load();
  } catch (const std::bad_alloc&) {     // said below
  } catch (const std::length_error&) {  // more than any memory holds
  }
  throw Error(
      ErrorKind::memory,
      RELUCENT_ENGLISH_MESSAGE("transport.not-enough-memory", "the file needs more memory than there is"),
      RELUCENT_MESSAGE("device.close-other-programs", "close other programs and try again"), path.string());
}

}  // namespace

void saveBlocks(const std::filesystem::path& path, const BlockSparse& blocks) {
  NpzWriter writer;
  TransportFile::add(writer, blocks, StoredValues::floats);
  writer.save(path);
}

BlockSparse loadBlocks(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return TransportFile::read(NpzReader(path)); });
}

void saveTransport(const std::filesystem::path& path, const TransportMatrix& transport, StoredValues values) {
  NpzWriter writer;
  addRasters(writer, "cameras", transport.cameras());
  addRasters(writer, "projectors", transport.projectors());
  // Other programs know no groups.
  if (!transport.groups().empty() && values == StoredValues::floats) {
    const TransportMatrix flat = transport.flattened();
    TransportFile::add(writer, flat.ownLeaves(), values);
    writer.save(path);
    return;
  }
  const bool grouped = !transport.groups().empty();
  TransportFile::add(writer, transport.ownLeaves(), values, grouped ? sharedLeaves : sharedColours);
  if (grouped) TransportFile::addGroups(writer, transport.groups());
  writer.save(path);
}

void addTo(Fingerprint& fingerprint, const TransportMatrix& transport) {
  for (const Rasters* rasters : {&transport.cameras(), &transport.projectors()})
    for (Size size : rasters->sizes()) fingerprint.add(size.width).add(size.height);
  TransportFile::addTo(fingerprint, transport.ownLeaves());
  TransportFile::addTo(fingerprint, transport.groups().leaves());
  fingerprint.add(transport.groups().parents()).add(transport.groups().groupsOfPixels());
}

TransportMatrix loadTransport(const std::filesystem::path& path) {
  return withinMemory(path, [&] {
    NpzReader reader(path);
    Rasters cameras = readRasters(reader, "cameras"), projectors = readRasters(reader, "projectors");
    BlockSparse leaves = TransportFile::read(reader);
    const NodeLayout layout(projectors);
    const bool grouped = TransportFile::hasGroups(reader);
    if (leaves.rows() != cameras.count() || leaves.columns() != layout.count() ||
        (grouped && leaves.sharedColours()->count != 2 * projectors.devices()))
      reader.fail(RELUCENT_ENGLISH_MESSAGE("transport.shape-not-of-devices",
                                           "has a shape that does not fit its cameras and projectors"));
    LeafGroups groups = grouped ? TransportFile::readGroups(reader, cameras.count(), layout) : LeafGroups();
    return TransportMatrix(std::move(cameras), std::move(projectors), std::move(leaves), std::move(groups));
  });
}

void saveExpanded(const std::filesystem::path& path, const PixelExpansion& expansion) {
  const TransportMatrix& transport = expansion.transport();
  std::size_t rows = transport.cameras().count(), columns = transport.projectors().count();
  bool wide = expansion.blocks() > largestInt32;
  const PixelExpansion* source = &expansion;

  NpzWriter writer;
  addRasters(writer, "cameras", transport.cameras());
  addRasters(writer, "projectors", transport.projectors());
  addFrame(writer, rows, columns);
  addIndices(writer, "indptr", rows + 1, wide,
             [source](std::uint64_t i) { return static_cast<std::int64_t>(source->rowBegin(i)); });

  // The row under way, made once for indices and once more for data.
  struct Row {
    RowCursor cursor;
    std::size_t made = std::numeric_limits<std::size_t>::max();
    std::vector<PixelExpansion::Entry> entries;
    const PixelExpansion::Entry& entry(const PixelExpansion& expansion, std::uint64_t index) {
      std::size_t row = cursor.rowOf(index, [&](std::size_t r) { return expansion.rowBegin(r); });
      if (row != made) expansion.row(row, entries);
      made = row;
      return entries[index - expansion.rowBegin(row)];
    }
  };
  auto row = std::make_shared<Row>();
  addIndices(writer, "indices", expansion.blocks(), wide, [source, row](std::uint64_t i) {
    return static_cast<std::int64_t>(row->entry(*source, i).column);
  });
  writer.add("data", {"<f4", {expansion.blocks(), 3, 3}},
             [source, row](std::uint64_t begin, std::uint64_t count, char* out) {
               for (std::uint64_t item = begin; item < begin + count; ++item) {
                 float value = row->entry(*source, item / 9).value.data()[item % 9];
                 std::memcpy(out + sizeof(float) * (item - begin), &value, sizeof(float));
               }
             });
  writer.save(path);
}

}  // namespace relucent::transport
