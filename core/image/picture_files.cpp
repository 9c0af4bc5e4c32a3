// SPDX-License-Identifier: MIT
#include "relucent/image/picture_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "relucent/image/too_little_memory.h"

namespace relucent::image {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view pngSignature{"\x89PNG\r\n\x1a\n", 8};
constexpr std::string_view jpegStart{"\xff\xd8", 2};
/// Pixels to a byte of the file: more than a picture of one colour comes to.
constexpr std::size_t mostPixelsPerByte = std::size_t{1} << 16;

[[noreturn]] void failShort(const fs::path& path) {
  throw Error(
      ErrorKind::format, RELUCENT_ENGLISH_MESSAGE("image.damaged", "the picture is damaged or cut short"),
      RELUCENT_ENGLISH_MESSAGE("image.copy-or-take-again", "copy it again, or take it again"), path.string());
}

/// What `call` returns, which reads the picture.  Throws: Error{memory} where there is too little.
template <typename Call>
auto orTooLittleMemory(const fs::path& path, const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw tooLittleMemory(path);
  }
}

std::uint32_t bigEndian32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

/// Walks a PNG's chunks: length, type, data, checksum.
bool pngIsWhole(std::string_view content) {
  for (std::size_t at = pngSignature.size(); content.size() - at >= 12;) {
    const std::size_t length = bigEndian32(content.substr(at));
    if (length > content.size() - at - 12) return false;
    if (content.substr(at + 4, 4) == "IEND") return true;
    at += length + 12;
  }
  return false;
}

/// A JPEG's data ends with an end marker; a thumbnail inside has one too, but before the main scan begins.
bool jpegIsWhole(std::string_view content) {
  const std::size_t scan = content.rfind(std::string_view("\xff\xda", 2));
  const std::size_t end = content.rfind(std::string_view("\xff\xd9", 2));
  return end != std::string_view::npos && (scan == std::string_view::npos || scan < end);
}

/// Pixels that a JPEG's first frame is said to have; 0: none is found. Source: ITU T.81, B.1.1.
std::uint64_t jpegPixels(std::string_view content) {
  constexpr std::size_t frame = 9;  // marker, length, bits, height, width
  for (std::size_t at = jpegStart.size(); at + frame <= content.size();) {
    const auto marker = static_cast<unsigned char>(content[at + 1]);
    const bool isMarker = static_cast<unsigned char>(content[at]) == 0xffU && marker != 0 && marker != 0xffU;
    if (!isMarker) {  // what libjpeg passes over too
      ++at;
      continue;
    }
    const auto numberAt = [&](std::size_t place) {
      return static_cast<unsigned char>(content[place]) * 256U +
             static_cast<unsigned char>(content[place + 1]);
    };
    const bool hasLength = marker != 0x01U && (marker < 0xd0U || marker > 0xd8U);
    const bool isFrame =
        marker >= 0xc0U && marker <= 0xcfU && marker != 0xc4U && marker != 0xc8U && marker != 0xccU;
    if (isFrame) return std::uint64_t{numberAt(at + 5)} * numberAt(at + 7);
    at += 2 + (hasLength ? numberAt(at + 2) : 0);
  }
  return 0;
}

/// libpng complains on standard error and libjpeg fills what is missing with grey: both are asked only for
/// files that are whole.
void checkWhole(std::string_view content, const fs::path& path) {
  if (content.starts_with(pngSignature) && !pngIsWhole(content)) failShort(path);
  if (content.starts_with(jpegStart) && !jpegIsWhole(content)) failShort(path);
}

bool looksLikePicture(std::string_view content) {
  return content.starts_with(pngSignature) || content.starts_with(jpegStart) ||
         content.starts_with(std::string_view("II*\0", 4)) ||
         content.starts_with(std::string_view("MM\0*", 4)) ||
         content.starts_with(std::string_view("II+\0", 4)) ||
         content.starts_with(std::string_view("MM\0+", 4));
}

/// Keeps OpenCV from reporting on standard error what is thrown as an Error anyway.
void silenceOpenCv() {
  [[maybe_unused]] static const auto before =
      cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

/// Empty: it cannot be.
cv::Mat decoded(const std::string& content, int flags) {
  const std::size_t most = mostPixelsPerByte * content.size();
  // libjpeg makes up what the file does not have, and memory is taken for it first.
  if (content.starts_with(jpegStart) && jpegPixels(content) > most) return {};
  try {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8U, const_cast<char*>(content.data()));
    cv::Mat picture = cv::imdecode(bytes, flags);
    return picture.total() > most ? cv::Mat() : picture;
  } catch (const cv::Exception&) {
    return {};  // sizes beyond OpenCV's limits end here
  }
}

cv::Mat decode(const std::string& content, Orientation orientation, const fs::path& path) {
  checkWhole(content, path);
  silenceOpenCv();
  // "Unchanged" keeps transparency but turns nothing upright; JPEG has no transparency.
  int flags = cv::IMREAD_UNCHANGED;
  if (content.starts_with(jpegStart)) {
    flags = cv::IMREAD_COLOR;
    if (orientation == Orientation::asStored) flags |= cv::IMREAD_IGNORE_ORIENTATION;
  }
  const cv::Mat picture = decoded(content, flags);
  if (picture.empty() && looksLikePicture(content))
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("image.damaged-or-too-large",
                                         "the picture is damaged, cut short, or too large"),
                RELUCENT_ENGLISH_MESSAGE("image.copy-again-or-shrink", "copy it again, or save it smaller"),
                path.string());
  if (picture.empty())
    throw Error(
        ErrorKind::format, RELUCENT_ENGLISH_MESSAGE("image.not-picture", "this is not a picture"),
        RELUCENT_ENGLISH_MESSAGE("image.choose-supported-format", "choose a PNG, TIFF, JPEG or OpenEXR file"),
        path.string());
  return picture;
}

/// Full scale of the samples, or none for kinds that no picture of light has.
std::optional<double> fullScale(int depth) {
  switch (depth) {
    case CV_8U:
      return 255.0;
    case CV_16U:
      return 65535.0;
    case CV_32F:
    case CV_64F:
      return 1.0;
    default:
      return std::nullopt;
  }
}

/// One sample type's part of toRgb(): blue, green, red (, alpha) or grey -> red, green, blue.
template <typename Sample>
Image rgbOf(const cv::Mat& picture, double scale) {
  Image image({picture.cols, picture.rows}, 3);
  const int channels = picture.channels();
  for (int y = 0; y < picture.rows; ++y) {
    const Sample* row = picture.ptr<Sample>(y);
    for (int x = 0; x < picture.cols; ++x, row += channels) {
      const double cover = channels % 2 == 0 ? static_cast<double>(row[channels - 1]) / scale : 1.0;
      for (int c = 0; c < 3; ++c) {
        const Sample sample = channels >= 3 ? row[2 - c] : row[0];
        image.at(x, y, c) = static_cast<float>(static_cast<double>(sample) / scale * cover);
      }
    }
  }
  return image;
}

Image toRgb(const cv::Mat& picture, const fs::path& path) {
  const std::optional<double> scale = fullScale(picture.depth());
  if (!scale || picture.channels() > 4)
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("image.sample-format-unsupported",
                                         "the picture has {} channels of {} bytes a sample")
                    .with(picture.channels(), as::bytes(picture.elemSize1())),
                RELUCENT_ENGLISH_MESSAGE("image.save-as-grey-or-rgb",
                                         "save it as grey or RGB with 8 or 16 bits, or as float"),
                path.string());
  switch (picture.depth()) {
    case CV_8U:
      return rgbOf<std::uint8_t>(picture, *scale);
    case CV_16U:
      return rgbOf<std::uint16_t>(picture, *scale);
    case CV_32F:
      return rgbOf<float>(picture, *scale);
    default:
      return rgbOf<double>(picture, *scale);
  }
}

template <typename Sample>
cv::Mat quantised(const Image& encoded) {
  constexpr double top = std::numeric_limits<Sample>::max();
  const int channels = encoded.channels();
  cv::Mat picture(encoded.height(), encoded.width(), CV_MAKETYPE(cv::DataType<Sample>::depth, channels));
  Sample* out = picture.ptr<Sample>();
  for (std::size_t i = 0; i < encoded.pixels(); ++i) {
    const auto pixel = encoded.pixel(i);
    for (std::size_t c = pixel.size(); c-- > 0;) {  // OpenCV wants blue first
      require(!std::isnan(pixel[c]), "pixel {} is not a number", i);
      *out++ =
          static_cast<Sample>(std::floor(std::clamp(static_cast<double>(pixel[c]), 0.0, 1.0) * top + 0.5));
    }
  }
  return picture;
}

/// `ending`: of the format's files, as OpenCV knows it.
std::string encodedAs(const char* ending, const Image& encoded, int bits) {
  require(!encoded.empty() && (encoded.channels() == 1 || encoded.channels() == 3),
          "no {} of {}x{} pixels of {} channels", ending, encoded.width(), encoded.height(),
          encoded.channels());
  std::vector<std::uint8_t> bytes;
  const cv::Mat picture = bits == 8 ? quantised<std::uint8_t>(encoded) : quantised<std::uint16_t>(encoded);
  bool isDone = false;
  try {
    isDone = cv::imencode(ending, picture, bytes);
  } catch (const cv::Exception&) {
    throw std::bad_alloc();  // what such a picture of ours can fail for
  }
  require(isDone, "OpenCV cannot encode {}x{} pixels as {}", encoded.width(), encoded.height(), ending);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Picture readPicture(const fs::path& path, Orientation orientation) {
  return orTooLittleMemory(path, [&]() -> Picture {
    const std::string content = readFile(path);
    if (looksLikeExr(content)) return {readRgbExr(path), 0};
    if (content.empty()) failShort(path);
    const cv::Mat picture = decode(content, orientation, path);
    const int bits = picture.depth() == CV_8U ? 8 : picture.depth() == CV_16U ? 16 : 0;
    return {toRgb(picture, path), bits};
  });
}

Image readLinearContent(const fs::path& path) {
  return orTooLittleMemory(path, [&] {
    Picture picture = readPicture(path, Orientation::upright);
    Image linear = picture.bits == 0 ? std::move(picture.encoded) : srgbDecoded(picture.encoded);
    checkFinite(linear, path);
    for (float& value : linear.data()) value = std::max(value, 0.0f);
    return linear;
  });
}

std::string encodePng(const Image& encoded, int bits) {
  require(bits == 8 || bits == 16, "a PNG has 8 or 16 bits, not {}", bits);
  return encodedAs(".png", encoded, bits);
}

std::string encodeJpeg(const Image& encoded) {
  return encodedAs(".jpg", encoded, 8);
}

void writePng(const fs::path& path, const Image& encoded, int bits) {
  writeFileAtomically(path, encodePng(encoded, bits));
}

}  // namespace relucent::image
