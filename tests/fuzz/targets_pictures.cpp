// SPDX-License-Identifier: MIT
// Pictures: EXR, PNG, TIFF, JPEG, raw files, and those to import.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <half.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>

#include "fuzz/scratch.h"
#include "fuzz/targets.h"
#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/devices/raw/raw_photograph.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/import.h"
#include "relucent/pipeline/plan.h"
#include "support/dng.h"

namespace relucent::fuzz {
namespace fs = std::filesystem;
namespace {

image::Image noise(Size size, int channels) {
  Random random{20071028, static_cast<std::uint64_t>(channels)};
  image::Image image(size, channels);
  for (float& value : image.data()) value = random.uniformFloat();
  return image;
}

std::string exrOf(Imf::Compression compression, Imf::PixelType type, bool isTiled) {
  const Size size{9, 7};
  const image::Image image = noise(size, 3);
  std::vector<half> halves(image.data().begin(), image.data().end());
  Imf::Header header(size.width, size.height);
  header.compression() = compression;
  const std::size_t sample = type == Imf::HALF ? sizeof(half) : sizeof(float);
  const char* samples = type == Imf::HALF ? reinterpret_cast<const char*>(halves.data())
                                          : reinterpret_cast<const char*>(image.data().data());
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice(type, const_cast<char*>(samples) + c * sample, 3 * sample,
                                  3 * sample * static_cast<std::size_t>(size.width)));
  }
  const fs::path path = scratch() / "seed.exr";
  if (isTiled) {
    header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(size.height);
  }
  return readFile(path);
}

std::vector<std::string> exrSeeds() {
  std::vector<std::string> seeds;
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
        Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION})
    seeds.push_back(exrOf(compression, Imf::HALF, false));
  seeds.push_back(exrOf(Imf::ZIP_COMPRESSION, Imf::FLOAT, true));
  const fs::path path = scratch() / "seed.exr";
  image::ExrImage own{noise({5, 4}, 4), {"R", "G", "B", "A"}, {-2, 3}, {0, 0}, Size{6, 8}, {}};
  own.attributes = {{"relucent:units", std::string("linear")}, {"a", 0.5}, {"b", 3}};
  image::writeExr(path, own, image::ExrType::half);
  seeds.push_back(readFile(path));
  image::writeExr(path, noise({3, 3}, 1), image::ExrType::floatType);
  seeds.push_back(readFile(path));
  return seeds;
}

void fuzzExr(Bytes input) {
  const fs::path path = scratchFile("input.exr", textOf(input));
  image::checkFinite(image::readRgbExr(path), path);
}

std::string encoded(const char* ending, int type, const std::vector<int>& how = {}) {
  cv::Mat picture(7, 9, type);
  Random random{20071028, static_cast<std::uint64_t>(type)};
  const std::size_t row = picture.elemSize() * 9;
  for (int y = 0; y < picture.rows; ++y)
    for (std::size_t i = 0; i < row; ++i) picture.ptr(y)[i] = static_cast<std::uint8_t>(random.below(120));
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, picture, bytes, how);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::string> pngSeeds() {
  return {encoded(".png", CV_8UC3), encoded(".png", CV_8UC1), encoded(".png", CV_16UC3),
          encoded(".png", CV_8UC4), encoded(".png", CV_16UC1)};
}

std::vector<std::string> pictureSeeds() {
  std::vector<std::string> seeds = pngSeeds();
  for (const int type : {CV_8UC3, CV_8UC1, CV_16UC3, CV_32FC3, CV_8UC4})
    for (const int compression : {1, 5, 8})
      seeds.push_back(encoded(".tiff", type, {cv::IMWRITE_TIFF_COMPRESSION, compression}));
  seeds.push_back(encoded(".jpg", CV_8UC3));
  seeds.push_back(encoded(".jpg", CV_8UC1));
  seeds.push_back(encoded(".jpg", CV_8UC3, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
  seeds.push_back(encoded(".bmp", CV_8UC3));
  return seeds;
}

void fuzzPicture(Bytes input) {
  image::readLinearContent(scratchFile("input.png", textOf(input)));
}

/// A PNG whose checksums are right, whatever was changed.
std::string checkedPng(std::string png) {
  constexpr std::size_t signature = 8, frame = 12;
  const auto byteAt = [&png](std::size_t at) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(png[at]));
  };
  for (std::size_t at = signature; at + frame <= png.size();) {
    const std::size_t length =
        byteAt(at) << 24U | byteAt(at + 1) << 16U | byteAt(at + 2) << 8U | byteAt(at + 3);
    if (length > png.size() - at - frame) break;
    const auto sum = static_cast<std::uint32_t>(
        ::crc32(0, reinterpret_cast<const Bytef*>(png.data()) + at + 4, static_cast<uInt>(length + 4)));
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xffU);
    at += frame + length;
  }
  return png;
}

void fuzzPng(Bytes input) {
  image::readPicture(scratchFile("input.png", checkedPng(std::string(textOf(input)))));
}

std::vector<std::string> rawSeeds() {
  test::Dng plain, dated, linear;
  dated.seconds = 0.25;
  dated.taken = "2026:11:21 19:30:05";
  dated.black = {512, 512, 512, 512};
  linear.isLinear = true;
  linear.codes.resize(3 * linear.size.count(), 100);
  return {test::bytesOf(plain), test::bytesOf(dated), test::bytesOf(linear)};
}

void fuzzRaw(Bytes input) {
  const std::string_view text = textOf(input);
  const devices::RawPhotograph photograph =
      devices::rawPhotograph({text.begin(), text.end()}, "photograph.dng");
  devices::photographOf(photograph.frame, "photograph.dng");
}

constexpr Size importedProjector{8, 8};

const fs::path& plan() {
  static const fs::path folder = [] {
    fs::path path = scratch() / "plan";
    importing::PatternPlanSettings settings;
    settings.projector = importedProjector;
    Progress quiet;
    pipeline::exportPlan(settings, path, quiet);
    return path;
  }();
  return folder;
}

std::vector<fs::path> planned() {
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(plan()))
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  std::ranges::sort(pictures);
  return pictures;
}

std::vector<std::string> importSeeds() {
  std::vector<std::string> seeds;
  for (const fs::path& picture : planned()) {
    seeds.push_back(readFile(picture));
    if (seeds.size() == 4) break;
  }
  seeds.push_back(encoded(".png", CV_16UC3));
  return seeds;
}

/// One of the patterns, and of the photographs, which are the patterns themselves.
void fuzzImport(Bytes input) {
  static const std::vector<fs::path> pictures = planned();
  const std::string png = checkedPng(std::string(textOf(input)));
  const fs::path folder = scratch() / "to-import";
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  fs::create_directories(folder / "photographs");
  fs::create_directories(folder / "patterns");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const fs::path name = pictures[i].filename();
    fs::create_symlink(pictures[i], folder / "photographs" / name);
    if (i == 1)
      scratchFile(folder / "patterns" / name, png);
    else
      fs::create_symlink(pictures[i], folder / "patterns" / name);
  }
  pipeline::ImportPicturesSettings settings;
  settings.patterns = folder / "patterns";
  settings.photographs = folder / "photographs";
  Progress quiet;
  pipeline::importPictures(folder / "calibration", settings, quiet);
}

}  // namespace

std::vector<FuzzTarget> pictureTargets() {
  const std::vector<std::string> exrWords{std::string("channels\0chlist\0", 16),
                                          std::string("dataWindow\0box2i\0", 17),
                                          std::string("displayWindow\0box2i\0", 20),
                                          std::string("tiles\0tiledesc\0", 15),
                                          std::string("lineOrder\0", 10),
                                          std::string("chunkCount\0int\0", 15),
                                          "type",
                                          "deepscanline",
                                          "compression",
                                          std::string("\xff\xff\xff\x7f", 4),
                                          std::string("\0\0\0\x80", 4)};
  const std::vector<std::string> pngWords{"IHDR", "IDAT", "PLTE",     "tRNS",     "IEND",     "gAMA", "iCCP",
                                          "eXIf", "acTL", "\xff\xd8", "\xff\xda", "\xff\xd9", "II*",  "MM"};
  return {{"exr", fuzzExr, exrSeeds, Form::bytes, 1500, exrWords},
          {"picture", fuzzPicture, pictureSeeds, Form::bytes, 400, pngWords},
          {"png", fuzzPng, pngSeeds, Form::bytes, 1000, pngWords},
          {"raw", fuzzRaw, rawSeeds, Form::bytes, 300, {}},
          {"import", fuzzImport, importSeeds, Form::bytes, 20, pngWords}};
}

}  // namespace relucent::fuzz
