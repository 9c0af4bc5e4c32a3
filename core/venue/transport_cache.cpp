// SPDX-License-Identifier: MIT
#include "relucent/venue/transport_cache.h"

#include <cstring>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"

namespace relucent::venue {
namespace {

// The file: magic, fingerprint of the settings, counts (nodes, camera pixels, blocks), full scales, blocks
// per node, columns, codes, room light, fingerprint of all that. Machine byte order, as a cache may.
constexpr std::string_view magic = "relucent venue 1\n";
constexpr std::size_t fingerprintLength = 32;

template <typename Value>
void append(std::string& content, const Value* values, std::size_t count) {
  content.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/// Takes values from the front of a text; false once it is too short.
class Reader {
 public:
  explicit Reader(std::string_view content) : content_(content) {}

  template <typename Value>
  bool take(std::vector<Value>& values, std::size_t count) {
    if (count > content_.size() / sizeof(Value)) return false;
    values.resize(count);
    if (count == 0) return true;
    std::memcpy(values.data(), content_.data(), count * sizeof(Value));
    content_.remove_prefix(count * sizeof(Value));
    return true;
  }
  bool expect(std::string_view text) {
    if (!content_.starts_with(text)) return false;
    content_.remove_prefix(text.size());
    return true;
  }
  bool atEnd() const { return content_.empty(); }

 private:
  std::string_view content_;
};

std::string checksum(std::string_view content) {
  return Fingerprint().add(content).hex();
}

}  // namespace

std::optional<TracedTransport> readTracedTransport(const std::filesystem::path& file,
                                                   const std::string& fingerprint, std::size_t nodes,
                                                   std::size_t cameraPixels) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(file, missing)) return std::nullopt;
  std::string content;
  try {
    content = readFile(file);
  } catch (const Error&) {
    return std::nullopt;
  }
  if (content.size() < fingerprintLength) return std::nullopt;
  std::string_view body(content.data(), content.size() - fingerprintLength);
  if (!content.ends_with(checksum(body))) return std::nullopt;

  Reader reader(body);
  std::vector<std::uint64_t> counts;
  if (!reader.expect(magic) || !reader.expect(fingerprint) || !reader.take(counts, 3)) return std::nullopt;
  if (counts[0] != nodes || counts[1] != cameraPixels) return std::nullopt;
  TracedTransport traced;
  std::vector<std::uint32_t> blocksOfNode, columns;
  std::vector<std::array<std::int16_t, 9>> codes;
  if (!reader.take(traced.fullScale, nodes) || !reader.take(blocksOfNode, nodes) ||
      !reader.take(columns, counts[2]) || !reader.take(codes, counts[2]) ||
      !reader.take(traced.roomLight, 3 * cameraPixels) || !reader.atEnd())
    return std::nullopt;
  content = {};

  transport::BlockSparseBuilder builder(cameraPixels, traced.fullScale);
  std::size_t entry = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    float scale = traced.fullScale[node] / static_cast<float>(std::numeric_limits<std::int16_t>::max());
    for (std::uint32_t i = 0; i < blocksOfNode[node]; ++i, ++entry) {
      if (entry >= columns.size() || columns[entry] >= cameraPixels) return std::nullopt;
      transport::ColourBlock block;
      for (std::size_t k = 0; k < 9; ++k) block.data()[k] = scale * static_cast<float>(codes[entry][k]);
      builder.add(node, columns[entry], block);
    }
  }
  traced.cameraByNode = builder.build();
  return traced;
}

void writeTracedTransport(const std::filesystem::path& file, const std::string& fingerprint,
                          const TracedTransport& traced) {
  const transport::BlockSparse& matrix = traced.cameraByNode;
  std::uint64_t counts[3] = {matrix.rows(), matrix.columns(), matrix.blocks()};
  std::string content(magic);
  content.reserve(magic.size() + fingerprint.size() + sizeof(counts) + 8 * matrix.rows() +
                  22 * matrix.blocks() + 4 * traced.roomLight.size() + fingerprintLength);
  content += fingerprint;
  append(content, counts, 3);
  append(content, traced.fullScale.data(), traced.fullScale.size());
  for (std::size_t row = 0; row < matrix.rows(); ++row) {
    std::uint32_t blocks = static_cast<std::uint32_t>(matrix.rowBegin(row + 1) - matrix.rowBegin(row));
    append(content, &blocks, 1);
  }
  for (std::size_t entry = 0; entry < matrix.blocks(); ++entry) {
    std::uint32_t column = matrix.column(entry);
    append(content, &column, 1);
  }
  for (std::size_t entry = 0; entry < matrix.blocks(); ++entry) append(content, matrix.code(entry).data(), 9);
  append(content, traced.roomLight.data(), traced.roomLight.size());
  content += checksum(content);
  writeFileAtomically(file, content);
}

}  // namespace relucent::venue
