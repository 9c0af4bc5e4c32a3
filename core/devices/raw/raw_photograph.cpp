// SPDX-License-Identifier: MIT
#include "relucent/devices/raw/raw_photograph.h"

#include <libraw/libraw.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

/// Values above 14 bits are rare, but codes are stored in 16 anyway.
constexpr int storedBits = 16;

/// What one raw file's colour filter is, by the colours of the first 2x2 cell; none: another one.
std::optional<SensorLayout> layoutOf(LibRaw& raw) {
  const libraw_iparams_t& about = raw.imgdata.idata;
  if (about.filters == 0) return about.colors == 1 ? std::optional(SensorLayout::mono) : std::nullopt;
  if (about.filters < 1000) return std::nullopt;  // X-Trans and Leaf's have small numbers of their own
  std::string cell;
  for (int place = 0; place < 4; ++place) cell += about.cdesc[raw.COLOR(place / 2, place % 2)];
  if (cell == "RGGB") return SensorLayout::bayerRG;
  if (cell == "GRBG") return SensorLayout::bayerGR;
  if (cell == "GBRG") return SensorLayout::bayerGB;
  if (cell == "BGGR") return SensorLayout::bayerBG;
  return std::nullopt;
}

/// Black is kept in three parts: one for all, one a colour, and a pattern that repeats from the corner on.
/// Patterns of more than 2x2 places are averaged over the pixels that fall on the same place of a cell.
SensorLevels levelsOf(LibRaw& raw, bool isMono) {
  const libraw_colordata_t& color = raw.imgdata.color;
  const unsigned rows = color.cblack[4], columns = color.cblack[5];
  SensorLevels levels;
  levels.white = static_cast<float>(color.maximum);
  for (unsigned place = 0; place < 4; ++place) {
    const unsigned y0 = place / 2, x0 = place % 2;
    const int own = isMono ? 0 : raw.COLOR(static_cast<int>(y0), static_cast<int>(x0));
    double black = color.black + color.cblack[own];
    if (rows > 0 && columns > 0 && rows * columns <= LIBRAW_CBLACK_SIZE - 6) {
      double sum = 0.0;
      for (unsigned y = y0; y < y0 + 2 * rows; y += 2)
        for (unsigned x = x0; x < x0 + 2 * columns; x += 2)
          sum += color.cblack[6 + y % rows * columns + x % columns];
      black += sum / (rows * columns);
    }
    levels.black[place] = static_cast<float>(black);
  }
  return levels;
}

[[noreturn]] void failDamaged(const Message& reason, const std::string& name) {
  throw Error(
      ErrorKind::format,
      RELUCENT_MESSAGE("device.raw-file-unreadable", "the raw file cannot be read ({})").with(reason),
      RELUCENT_MESSAGE(
          "device.copy-or-retake-photograph",
          "copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files"),
      name);
}

std::vector<std::uint8_t> visiblePart(const LibRaw& raw, Size size) {
  const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
  const std::size_t pitch = sizes.raw_pitch > 0 ? sizes.raw_pitch / sizeof(ushort) : sizes.raw_width;
  std::vector<std::uint8_t> bytes(2 * size.count());
  std::uint8_t* to = bytes.data();
  for (int y = 0; y < size.height; ++y) {
    const ushort* from = raw.imgdata.rawdata.raw_image +
                         (sizes.top_margin + static_cast<std::size_t>(y)) * pitch + sizes.left_margin;
    for (int x = 0; x < size.width; ++x) {
      *to++ = static_cast<std::uint8_t>(from[x] & 0xffu);
      *to++ = static_cast<std::uint8_t>(from[x] >> 8u);
    }
  }
  return bytes;
}

}  // namespace

bool hasRawPhotographs() {
  return true;
}

std::optional<std::time_t> timeTaken(const std::filesystem::path& rawFile) {
  const auto raw = std::make_unique<LibRaw>();
  if (raw->open_file(rawFile.c_str()) != LIBRAW_SUCCESS || raw->imgdata.other.timestamp <= 0)
    return std::nullopt;
  return raw->imgdata.other.timestamp;
}

RawPhotograph rawPhotograph(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (bytes.empty()) failDamaged(RELUCENT_MESSAGE("device.raw-file-empty", "it is empty"), name);
  const auto raw = std::make_unique<LibRaw>();  // several hundred kilobytes
  // LibRaw reports damage on standard error unless somebody listens; error_count() tells it as well. Releases
  // disagree about the type of the place.
  raw->set_dataerror_handler([](void*, const char*, auto) {}, nullptr);
  int result = raw->open_buffer(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  if (result == LIBRAW_SUCCESS) result = raw->unpack();
  if (result != LIBRAW_SUCCESS) failDamaged(Message::plain(libraw_strerror(result)), name);
  if (raw->error_count() > 0)
    failDamaged(RELUCENT_MESSAGE("device.raw-file-incomplete", "parts of it are missing"), name);

  const libraw_data_t& data = raw->imgdata;
  if (data.rawdata.raw_image == nullptr)
    throw Error(ErrorKind::format,
                RELUCENT_MESSAGE("device.raw-file-without-sensor-values",
                                 "the raw file does not hold the sensor's own values"),
                RELUCENT_MESSAGE("device.switch-to-full-size-raw",
                                 "switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)"),
                name);
  const std::optional<SensorLayout> layout = layoutOf(*raw);
  if (!layout || raw->is_fuji_rotated() != 0)
    throw Error(ErrorKind::format,
                RELUCENT_MESSAGE("device.colour-filter-not-bayer",
                                 "the camera's colour filter is not a Bayer filter"),
                RELUCENT_MESSAGE("device.develop-linearly",
                                 "develop the files linearly, as 16-bit TIFF, or use another camera"),
                name);

  RawPhotograph photograph;
  const Size size{data.sizes.width & ~1, data.sizes.height & ~1};
  if (size.empty())
    failDamaged(RELUCENT_ENGLISH_MESSAGE("device.raw-file-without-pixels", "it has no pixels"), name);
  if (data.sizes.top_margin + size.height > data.sizes.raw_height ||
      data.sizes.left_margin + size.width > data.sizes.raw_width)
    failDamaged(
        RELUCENT_ENGLISH_MESSAGE("device.raw-file-sizes-contradict", "its sizes contradict each other"),
        name);
  photograph.frame = {
      size, {*layout, storedBits}, visiblePart(*raw, size), levelsOf(*raw, *layout == SensorLayout::mono)};
  for (float black : photograph.frame.levels->black)
    if (!(photograph.frame.levels->white > black))
      failDamaged(
          RELUCENT_ENGLISH_MESSAGE("device.raw-file-white-below-black", "its white is not above its black"),
          name);
  photograph.model = fmt::format("{} {}", data.idata.make, data.idata.model);
  photograph.seconds = static_cast<double>(data.other.shutter);
  if (data.other.timestamp > 0) photograph.taken = data.other.timestamp;
  return photograph;
}

}  // namespace relucent::devices
