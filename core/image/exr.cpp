// SPDX-License-Identifier: MIT
#include "relucent/image/exr.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <ImfVersion.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <set>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/image/exr_stream.h"
#include "relucent/image/too_little_memory.h"

namespace relucent::image {
namespace fs = std::filesystem;
namespace {

/// More than any camera or projector delivers; a damaged header can ask for anything.
constexpr std::size_t largestSampleCount = std::size_t{1} << 30;
/// Pixels of a display window around next to nothing.
constexpr std::size_t largestEmptyRaster = std::size_t{1} << 25;
/// Samples to a byte of the file: more than any of OpenEXR's compressions comes to, of a picture of one
/// colour.
constexpr std::size_t mostSamplesPerByte = std::size_t{1} << 16;

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
}

Size sizeOf(const Imath::Box2i& window) {
  return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

Imath::Box2i boxOf(Pixel origin, Size size) {
  constexpr int farthest = std::numeric_limits<int>::max() / 2;  // OpenEXR's own limit
  require(std::abs(std::int64_t{origin.x}) + size.width < farthest &&
              std::abs(std::int64_t{origin.y}) + size.height < farthest,
          "OpenEXR cannot place {}x{} pixels at {}, {}", size.width, size.height, origin.x, origin.y);
  return {Imath::V2i(origin.x, origin.y), Imath::V2i(origin.x + size.width - 1, origin.y + size.height - 1)};
}

bool reservedName(const std::string& name) {
  static const std::set<std::string> reserved{"channels",
                                              "compression",
                                              "dataWindow",
                                              "displayWindow",
                                              "lineOrder",
                                              "pixelAspectRatio",
                                              "screenWindowCenter",
                                              "screenWindowWidth",
                                              "tiles",
                                              "name",
                                              "type",
                                              "version",
                                              "chunkCount",
                                              "preview",
                                              "maxSamplesPerPixel"};
  return reserved.contains(name);
}

/// Alphabetical as in the file, but R, G, B, A of a layer in the order in which everybody expects them.
std::vector<std::string> orderedNames(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) names.push_back(channel.name());
  auto key = [](const std::string& name) {
    std::size_t dot = name.rfind('.');
    std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
    std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
    std::size_t rank = last.size() == 1 ? std::string_view("RGBA").find(last) : std::string_view::npos;
    return std::tuple(layer, rank, last);
  };
  std::sort(names.begin(), names.end(),
            [&](const std::string& a, const std::string& b) { return key(a) < key(b); });
  return names;
}

std::map<std::string, ExrAttribute> attributesOf(const Imf::Header& header) {
  std::map<std::string, ExrAttribute> attributes;
  for (auto entry = header.begin(); entry != header.end(); ++entry) {
    if (reservedName(entry.name())) continue;
    const Imf::Attribute& attribute = entry.attribute();
    if (auto text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
      attributes[entry.name()] = text->value();
    else if (auto real = dynamic_cast<const Imf::DoubleAttribute*>(&attribute))
      attributes[entry.name()] = real->value();
    else if (auto single = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
      attributes[entry.name()] = static_cast<double>(single->value());
    else if (auto whole = dynamic_cast<const Imf::IntAttribute*>(&attribute))
      attributes[entry.name()] = whole->value();
  }
  return attributes;
}

[[noreturn]] void failFormat(const fs::path& path, Message what, Message advice) {
  throw Error(ErrorKind::format, std::move(what), std::move(advice), path.string());
}

[[noreturn]] void failDamaged(const fs::path& path) {
  failFormat(path, RELUCENT_ENGLISH_MESSAGE("image.exr-damaged", "the OpenEXR file is damaged or cut short"),
             RELUCENT_ENGLISH_MESSAGE("image.copy-or-write-again",
                                      "copy it again, or write it again with its program"));
}

/// Number of four bytes, the lowest first. Contract: there are as many.
std::uint32_t numberAt(std::string_view content, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8U | static_cast<unsigned char>(content[at + i]);
  return number;
}

/// Whether a list of channels ends where it is said to: names, and what each channel is.
bool channelsFit(std::string_view list) {
  constexpr std::size_t channelBytes = 16;
  while (!list.empty() && list.front() != '\0') {
    const std::size_t name = list.find('\0');
    if (name == std::string_view::npos || list.size() - name - 1 < channelBytes) return false;
    list.remove_prefix(name + 1 + channelBytes);
  }
  return list.size() == 1;
}

/// Whether a value of the type has as many bytes as it is said to: OpenEXR reads what the type has, and takes
/// what follows for the next attribute's name.
bool valueFits(std::string_view type, std::string_view value) {
  static const std::map<std::string_view, std::size_t> bytes{{"box2f", 16},
                                                             {"box2i", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33f", 36},
                                                             {"m33d", 72},
                                                             {"m44f", 64},
                                                             {"m44d", 128},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2d", 16},
                                                             {"v2f", 8},
                                                             {"v2i", 8},
                                                             {"v3d", 24},
                                                             {"v3f", 12},
                                                             {"v3i", 12}};
  constexpr std::size_t number = 4;
  if (const auto fixed = bytes.find(type); fixed != bytes.end()) return value.size() == fixed->second;
  if (type == "chlist") return channelsFit(value);
  if (type == "floatvector") return value.size() % number == 0;
  if (type == "preview")
    return value.size() >= 2 * number && value.size() % number == 0 &&
           (value.size() - 2 * number) / number ==
               std::uint64_t{numberAt(value, 0)} * numberAt(value, number);
  return true;
}

[[noreturn]] void failImplausible(const fs::path& path, Size size) {
  failFormat(
      path,
      RELUCENT_ENGLISH_MESSAGE("image.exr-size-implausible", "the OpenEXR file claims {} pixels")
          .with(as::size(size)),
      RELUCENT_ENGLISH_MESSAGE("image.check-file",
                               "check the file: it is damaged, or far larger than any camera's picture"));
}

/// What a header says of its picture, as far as OpenEXR takes memory by it.
struct Claims {
  Imath::Box2i window{{0, 0}, {0, 0}};
  std::uint64_t channels = 1, linesAtOnce = 1, tile = 1;

  void hear(std::string_view name, std::string_view type, std::string_view value) {
    constexpr std::size_t number = 4;
    if (name == "dataWindow" && type == "box2i")
      for (int i = 0; i < 2; ++i) {
        window.min[i] = static_cast<int>(numberAt(value, static_cast<std::size_t>(i) * number));
        window.max[i] = static_cast<int>(numberAt(value, static_cast<std::size_t>(i + 2) * number));
      }
    // The shortest has a letter, the end of its name, and sixteen bytes.
    if (type == "chlist") channels = std::max<std::uint64_t>(1, value.size() / 18);
    if (type == "tiledesc") tile = std::uint64_t{numberAt(value, 0)} * numberAt(value, number);
    if (type == "compression") linesAtOnce = linesOf(static_cast<unsigned char>(value.front()));
  }
  /// Throws: Error{format} for more than a file of so many bytes can hold.
  void check(std::size_t bytes, const fs::path& path) const {
    const std::uint64_t most = std::clamp(mostSamplesPerByte * bytes, largestEmptyRaster, largestSampleCount);
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                       height = std::int64_t{window.max.y} - window.min.y + 1;
    // OpenEXR refuses those.
    if (std::min(width, height) <= 0 || std::max(width, height) > std::numeric_limits<int>::max()) return;
    const std::uint64_t lines = std::max(linesAtOnce, static_cast<std::uint64_t>(height));
    if (lines > most / channels / static_cast<std::uint64_t>(width) || tile > most / channels)
      failImplausible(path, {static_cast<int>(width), static_cast<int>(height)});
  }

 private:
  static std::uint64_t linesOf(unsigned compression) {
    constexpr std::uint64_t few = 16, many = 32, most = 256;
    if (compression <= Imf::ZIPS_COMPRESSION) return 1;
    if (compression == Imf::ZIP_COMPRESSION || compression == Imf::PXR24_COMPRESSION) return few;
    return compression == Imf::DWAB_COMPRESSION ? most : many;
  }
};

/// OpenEXR takes memory by what a header says before it reads what is said: two gigabytes for a file of some
/// hundred bytes.  Throws: Error{format} for several parts, and unless the header and all of its attributes
/// end within the file, and are of a picture that it can hold.
void checkHeader(std::string_view content, const fs::path& path) {
  constexpr std::size_t number = 4;
  std::size_t at = 2 * number;  // behind magic number and version
  if (at > content.size()) failDamaged(path);
  if (Imf::isMultiPart(static_cast<int>(numberAt(content, number))))
    failFormat(path,
               RELUCENT_ENGLISH_MESSAGE("image.exr-several-parts", "the OpenEXR file has several parts"),
               RELUCENT_ENGLISH_MESSAGE("image.save-part-alone",
                                        "save the part that you want as a file of its own"));
  const auto nextText = [&] {
    const std::size_t begin = at, end = std::min(content.find('\0', at), content.size());
    at = std::min(end + 1, content.size());
    return content.substr(begin, end - begin);
  };
  Claims claims;
  while (at < content.size() && content[at] != '\0') {
    const std::string_view name = nextText(), type = nextText();
    if (content.size() - at < number) failDamaged(path);
    const std::size_t length = numberAt(content, at);
    at += number;
    const std::string_view value = content.substr(at, length);
    if (value.size() < length || !valueFits(type, value)) failDamaged(path);
    claims.hear(name, type, value);
    at += length;
  }
  if (at == content.size()) failDamaged(path);
  claims.check(content.size(), path);
}

/// Throws: Error{format} for the kinds of OpenEXR files that are no plain pictures.
void checkKind(const Imf::InputFile& file, const fs::path& path) {
  const Imf::Header& header = file.header();
  if (Imf::isNonImage(file.version()) || (header.hasType() && Imf::isDeepData(header.type())))
    failFormat(path, RELUCENT_ENGLISH_MESSAGE("image.exr-deep-data", "the OpenEXR file holds deep data"),
               RELUCENT_ENGLISH_MESSAGE("image.flatten", "flatten it to a plain picture and save it again"));
  if (!file.isComplete())
    failFormat(path, RELUCENT_ENGLISH_MESSAGE("image.exr-incomplete", "the OpenEXR file is incomplete"),
               RELUCENT_ENGLISH_MESSAGE("image.copy-or-write-again",
                                        "copy it again, or write it again with its program"));
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      failFormat(
          path,
          RELUCENT_ENGLISH_MESSAGE("image.exr-channel-subsampled",
                                   "channel {} of the OpenEXR file is subsampled (luminance and chroma)")
              .with(channel.name()),
          RELUCENT_ENGLISH_MESSAGE("image.save-as-full-resolution-rgb",
                                   "save it again as R, G, B at full resolution"));
}

ExrImage readPixels(Imf::InputFile& file, const fs::path& path) {
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const Size size = sizeOf(window);

  ExrImage image;
  image.channelNames = orderedNames(header.channels());
  const std::size_t channels = image.channelNames.size();
  if (channels == 0)
    failFormat(path,
               RELUCENT_ENGLISH_MESSAGE("image.exr-without-channels", "the OpenEXR file has no channels"),
               RELUCENT_ENGLISH_MESSAGE("image.choose-another-file", "choose another file"));
  if (size.count() > largestSampleCount / channels) failImplausible(path, size);
  image.pixels = Image(size, static_cast<int>(channels));
  image.dataOrigin = {window.min.x, window.min.y};
  image.displayOrigin = {header.displayWindow().min.x, header.displayWindow().min.y};
  image.displaySize = sizeOf(header.displayWindow());
  image.attributes = attributesOf(header);

  Imf::FrameBuffer frame;
  const std::size_t pixelBytes = channels * sizeof(float);
  for (std::size_t c = 0; c < channels; ++c)
    frame.insert(image.channelNames[c],
                 Imf::Slice::Make(Imf::FLOAT, image.pixels.data().data() + c, window, pixelBytes,
                                  pixelBytes * static_cast<std::size_t>(size.width)));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

std::vector<half> toHalf(const Image& image, const fs::path& path) {
  std::vector<half> samples(image.data().size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = half(image.data()[i]);
    if (samples[i].isInfinity() && std::isfinite(image.data()[i]))
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("image.value-exceeds-half-precision",
                                           "the value {} is too large for half precision (65504)")
                      .with(image.data()[i]),
                  RELUCENT_ENGLISH_MESSAGE("image.write-as-float", "write the picture as float"),
                  path.string());
  }
  return samples;
}

/// Of the pixels in any order of their channels.
std::string checksumOf(const ExrImage& image) {
  std::map<std::string_view, std::size_t> places;
  for (std::size_t c = 0; c < image.channelNames.size(); ++c) places.emplace(image.channelNames[c], c);
  Fingerprint fingerprint;
  std::vector<float> channel(image.pixels.pixels());
  for (const auto& [name, place] : places) {
    for (std::size_t i = 0; i < channel.size(); ++i)
      channel[i] = image.pixels.data()[i * places.size() + place];
    fingerprint.add(name).add(channel);
  }
  return fingerprint.hex();
}

/// How a file's pixels are stored.
struct Storage {
  ExrType type;
  ExrPacking packing;
};

Imf::Header headerFor(const ExrImage& image, const Storage& storage) {
  const Size display = image.displaySize.value_or(image.pixels.size());
  const Pixel displayOrigin = image.displaySize ? image.displayOrigin : image.dataOrigin;
  Imf::Header header(boxOf(displayOrigin, display), boxOf(image.dataOrigin, image.pixels.size()), 1.0f,
                     Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                     storage.packing == ExrPacking::zip ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION);
  for (const std::string& name : image.channelNames)
    header.channels().insert(name, Imf::Channel(storage.type == ExrType::half ? Imf::HALF : Imf::FLOAT));
  for (const auto& [name, attribute] : image.attributes) {
    require(!reservedName(name), "OpenEXR reserves the attribute name {}", name);
    if (auto text = std::get_if<std::string>(&attribute))
      header.insert(name, Imf::StringAttribute(*text));
    else if (auto real = std::get_if<double>(&attribute))
      header.insert(name, Imf::DoubleAttribute(*real));
    else
      header.insert(name, Imf::IntAttribute(std::get<int>(attribute)));
  }
  return header;
}

template <typename Sample>
std::string encoded(const ExrImage& image, const Storage& storage, const std::vector<Sample>& samples,
                    const fs::path& path) {
  detail::MemoryOutput stream(path.filename().string());
  {
    Imf::Header header = headerFor(image, storage);
    Imf::FrameBuffer frame;
    const std::size_t pixelBytes = image.channelNames.size() * sizeof(Sample);
    for (std::size_t c = 0; c < image.channelNames.size(); ++c)
      frame.insert(image.channelNames[c],
                   Imf::Slice::Make(storage.type == ExrType::half ? Imf::HALF : Imf::FLOAT,
                                    samples.data() + c, header.dataWindow(), pixelBytes,
                                    pixelBytes * static_cast<std::size_t>(image.pixels.width())));
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.pixels.height());
  }  // closing the file writes its table of lines
  // OpenEXR keeps to itself that there was no memory to compress the last lines: their places are empty.
  detail::MemoryInput written(stream.content(), path.filename().string());
  if (!Imf::InputFile(written).isComplete()) throw std::bad_alloc();
  return stream.content();
}

}  // namespace

bool looksLikeExr(std::string_view content) {
  return content.size() >= 4 && Imf::isImfMagic(content.data());
}

ExrImage readExr(const fs::path& path) {
  const std::string content = readFile(path);
  if (!looksLikeExr(content))
    failFormat(path, RELUCENT_ENGLISH_MESSAGE("image.not-exr", "this is not an OpenEXR file"),
               RELUCENT_ENGLISH_MESSAGE("image.choose-exr-file", "choose an .exr file"));
  checkHeader(content, path);
  try {
    detail::MemoryInput stream(content, path.filename().string());
    Imf::InputFile file(stream);
    checkKind(file, path);
    ExrImage image = readPixels(file, path);
    const auto checksum = image.attributes.extract(exr_attribute::checksum);
    if (checksum && checksum.mapped() != ExrAttribute(checksumOf(image))) failDamaged(path);
    return image;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw tooLittleMemory(path);
  } catch (const std::exception&) {
    failDamaged(path);
  }
}

void writeExr(const fs::path& path, const ExrImage& image, ExrType type, ExrPacking packing) {
  require(!image.pixels.empty(), "an OpenEXR file needs pixels");
  require(image.channelNames.size() == static_cast<std::size_t>(image.pixels.channels()),
          "{} names for {} channels", image.channelNames.size(), image.pixels.channels());
  require(std::set(image.channelNames.begin(), image.channelNames.end()).size() == image.channelNames.size(),
          "channel names are not unique: {}", joined(image.channelNames));
  const Storage storage{type, packing};
  if (packing == ExrPacking::none) {
    require(type == ExrType::floatType, "half samples are packed");
    ExrImage checked = image;
    checked.attributes[exr_attribute::checksum] = checksumOf(image);
    writeFileAtomically(path, encoded(checked, storage, checked.pixels.data(), path));
    return;
  }
  writeFileAtomically(path, type == ExrType::half ? encoded(image, storage, toHalf(image.pixels, path), path)
                                                  : encoded(image, storage, image.pixels.data(), path));
}

void writeExr(const fs::path& path, const Image& image, ExrType type,
              std::map<std::string, ExrAttribute> attributes, ExrPacking packing) {
  require(image.channels() == 3 || image.channels() == 1, "no names for {} channels", image.channels());
  ExrImage exr;
  exr.pixels = image;
  exr.channelNames =
      image.channels() == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  exr.attributes = std::move(attributes);
  writeExr(path, exr, type, packing);
}

Image readRgbExr(const fs::path& path, std::optional<Size> expected) {
  const ExrImage exr = readExr(path);
  const Size size = *exr.displaySize;
  if (expected && size != *expected)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("image.size-differs", "the picture has {} pixels where {} are needed")
            .with(as::size(size), as::size(*expected)),
        RELUCENT_ENGLISH_MESSAGE("image.choose-picture-of-size", "choose a picture of that size"),
        path.string());
  // An empty picture may lie on a large raster, but not on any.
  if (size.count() > std::clamp(64 * exr.pixels.pixels(), largestEmptyRaster, largestSampleCount / 3))
    failImplausible(path, size);

  auto placeOf = [&](const char* name) {
    return std::find(exr.channelNames.begin(), exr.channelNames.end(), name) - exr.channelNames.begin();
  };
  const auto end = std::ssize(exr.channelNames);
  std::array<std::ptrdiff_t, 3> source{placeOf("R"), placeOf("G"), placeOf("B")};
  const bool rgb = std::find(source.begin(), source.end(), end) == source.end();
  if (!rgb && exr.channelNames == std::vector<std::string>{"Y"})
    source = {0, 0, 0};
  else if (!rgb)
    failFormat(
        path,
        RELUCENT_ENGLISH_MESSAGE("image.exr-channels-unsupported", "the OpenEXR file has the channels {}")
            .with(joined(exr.channelNames)),
        RELUCENT_ENGLISH_MESSAGE("image.save-as-rgb-or-y",
                                 "save it with the channels R, G and B, or with Y alone"));

  // Display coordinates of the data window; only what both windows share is copied.
  const std::int64_t left = std::int64_t{exr.dataOrigin.x} - exr.displayOrigin.x;
  const std::int64_t top = std::int64_t{exr.dataOrigin.y} - exr.displayOrigin.y;
  Image image(size, 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const std::int64_t dataX = x - left, dataY = y - top;
      if (dataX < 0 || dataY < 0 || dataX >= exr.pixels.width() || dataY >= exr.pixels.height()) continue;
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = exr.pixels.at(static_cast<int>(dataX), static_cast<int>(dataY),
                                          static_cast<int>(source[static_cast<std::size_t>(c)]));
    }
  return image;
}

void checkFinite(const Image& image, const fs::path& path) {
  std::size_t notNumbers = 0, infinities = 0, first = 0;
  for (std::size_t i = 0; i < image.data().size(); ++i) {
    if (std::isfinite(image.data()[i])) continue;
    if (notNumbers + infinities == 0) first = i;
    ++(std::isnan(image.data()[i]) ? notNumbers : infinities);
  }
  if (notNumbers + infinities == 0) return;
  const Pixel place = pixelAt(image.size(), first / static_cast<std::size_t>(image.channels()));
  throw Error(
      ErrorKind::input,
      RELUCENT_ENGLISH_MESSAGE("image.values-not-finite",
                               "the picture holds {} NaN and {} infinite values, the first at pixel {}, {}")
          .with(notNumbers, infinities, as::label(place.x), place.y),
      RELUCENT_ENGLISH_MESSAGE("image.write-finite-values", "write it again with finite numbers only"),
      path.string());
}

}  // namespace relucent::image
