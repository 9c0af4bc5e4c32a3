// SPDX-License-Identifier: MIT
#include "relucent/inverse/window_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "relucent/transport/npz.h"
#include "relucent/transport/npz_rasters.h"

namespace relucent::inverse {
namespace fs = std::filesystem;
namespace {

constexpr const char* format = "relucent-windows";

/// The bytes of values that stay where they are until the file is written.
template <typename Values>
transport::NpzWriter::Items bytesOf(const Values& values) {
  return [source = &values](std::uint64_t begin, std::uint64_t count, char* out) {
    if (count > 0) std::memcpy(out, source->data() + begin, count * sizeof(values[0]));
  };
}

}  // namespace

/// Reads and writes the private arrays of a WindowInverse, so that nothing is held twice.
class WindowFile {
 public:
  static void add(transport::NpzWriter& writer, const WindowInverse& windows) {
    const std::uint64_t rows = windows.row_.size(), pixels = static_cast<std::uint64_t>(windows.tile_) *
                                                             static_cast<std::uint64_t>(windows.tile_);
    transport::addRasters(writer, "cameras", windows.cameras_);
    transport::addRasters(writer, "projectors", windows.projectors_);
    writer.add("tile", std::vector<std::int32_t>{windows.tile_}, {1});
    writer.add("unmix", {"<f4", {windows.cameras_.count(), 3, 3}}, bytesOf(windows.unmix_));
    writer.add("tile_start", std::vector<std::int64_t>(windows.tileStart_.begin(), windows.tileStart_.end()),
               {windows.tileStart_.size()});
    writer.add("row", {"<i4", {rows}}, bytesOf(windows.row_));
    writer.add("weight", {"<i2", {rows, 3, pixels}}, bytesOf(windows.weight_));
    writer.add("scale", {"<f4", {windows.tiles_.count(), 3}}, bytesOf(windows.scale_));
  }

  static WindowInverse read(const transport::NpzReader& reader) {
    auto fail = [&] {
      reader.fail(RELUCENT_ENGLISH_MESSAGE("inverse.windows-inconsistent",
                                           "has windows that do not fit its cameras and projectors"));
    };
    WindowInverse windows;
    windows.cameras_ = transport::readRasters(reader, "cameras");
    windows.projectors_ = transport::readRasters(reader, "projectors");
    const std::vector<std::int64_t> tile = reader.integers("tile");
    if (tile.size() != 1 || (tile[0] != 4 && tile[0] != 8)) fail();
    windows.tile_ = static_cast<int>(tile[0]);
    windows.tiles_ = WindowInverse::gridOf(windows.projectors_, windows.tile_);
    const std::uint64_t tiles = windows.tiles_.count(), cameras = windows.cameras_.count(),
                        pixels = static_cast<std::uint64_t>(tile[0] * tile[0]);

    windows.unmix_ = reader.floats("unmix");
    windows.scale_ = reader.floats("scale");
    for (std::int64_t start : reader.integers("tile_start")) {
      if (start < 0) fail();
      windows.tileStart_.push_back(static_cast<std::size_t>(start));
    }
    const std::vector<std::int64_t> rows = reader.integers("row");
    if (windows.unmix_.size() != 9 * cameras || windows.scale_.size() != 3 * tiles ||
        windows.tileStart_.size() != tiles + 1 || windows.tileStart_.front() != 0 ||
        windows.tileStart_.back() != rows.size() || !std::ranges::is_sorted(windows.tileStart_))
      fail();
    const auto isFinite = [](float value) { return std::isfinite(value); };
    if (!std::ranges::all_of(windows.unmix_, isFinite) || !std::ranges::all_of(windows.scale_, isFinite))
      fail();
    windows.row_.reserve(rows.size());
    for (std::int64_t row : rows) {
      if (row < 0 || row >= static_cast<std::int64_t>(cameras)) fail();
      windows.row_.push_back(static_cast<std::uint32_t>(row));
    }
    const transport::NpyHeader weight = reader.header("weight");
    if (weight.type != "<i2" || weight.shape != std::vector<std::uint64_t>{rows.size(), 3, pixels}) fail();
    windows.weight_.resize(weight.count());
    reader.read("weight", [&](std::uint64_t begin, std::uint64_t count, const char* in) {
      if (count > 0) std::memcpy(windows.weight_.data() + begin, in, count * sizeof(std::int16_t));
    });
    return windows;
  }
};

void saveWindows(const fs::path& path, const WindowInverse& windows, const std::string& key) {
  transport::NpzWriter writer;
  writer.addText("format", format);
  writer.addText("key", key);
  WindowFile::add(writer, windows);
  writer.save(path);
}

std::optional<WindowInverse> loadWindows(const fs::path& path, const std::string& key) {
  const transport::NpzReader reader(path);
  if (reader.text("format") != format)
    reader.fail(RELUCENT_ENGLISH_MESSAGE("inverse.no-windows", "holds no windows"));
  if (reader.text("key") != key) return std::nullopt;
  return WindowFile::read(reader);
}

}  // namespace relucent::inverse
