// SPDX-License-Identifier: MIT
#include "relucent/calibration/shot_file.h"

#include <blosc.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"

namespace relucent::calibration {
namespace {

static_assert(std::endian::native == std::endian::little, "shot files hold little endian samples");

constexpr const char* shotFormat = "relucent shot";
constexpr int formatVersion = 2;
constexpr int plainVersion = 1;  // samples as they are, of earlier programs: read, not written

/// How a frame's samples are stored: whole codes where those give back every bit.
enum class SampleCoding { codes8, codes16, floats };
constexpr EnumName<SampleCoding> sampleCodingNames[]{
    {SampleCoding::codes8, "codes8"}, {SampleCoding::codes16, "codes16"}, {SampleCoding::floats, "float"}};
constexpr EnumNames<SampleCoding> namesOf(SampleCoding) {
  return {"coding of samples", sampleCodingNames};
}

std::size_t bytesOf(SampleCoding coding) {
  switch (coding) {
    case SampleCoding::codes8:
      return 1;
    case SampleCoding::codes16:
      return 2;
    case SampleCoding::floats:
      break;
  }
  return sizeof(float);
}

double fullScale(int bits) {
  return static_cast<double>((std::uint64_t{1} << static_cast<unsigned>(bits)) - 1U);
}

/// Samples of one frame as they are stored, before they are compressed.
using Bytes = std::vector<char>;

/// The samples as codes; none unless the codes give back every bit.
template <typename Code>
std::optional<Bytes> codesOf(const std::vector<float>& signal, int bits) {
  double full = fullScale(bits);
  std::vector<Code> codes(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    double code = std::nearbyint(static_cast<double>(signal[i]) * full);
    if (!(code >= 0.0 && code <= full)) return std::nullopt;
    codes[i] = static_cast<Code>(code);
    float decoded = static_cast<float>(code / full);
    if (std::bit_cast<std::uint32_t>(decoded) != std::bit_cast<std::uint32_t>(signal[i])) return std::nullopt;
  }
  Bytes bytes(codes.size() * sizeof(Code));
  std::memcpy(bytes.data(), codes.data(), bytes.size());
  return bytes;
}

struct CodedFrame {
  SampleCoding coding;
  Bytes bytes;
};

/// In the smallest form that loses nothing.
CodedFrame coded(const rig::RawFrame& frame) {
  const std::vector<float>& signal = frame.signal.data();
  if (frame.bits >= 1 && frame.bits <= 8)
    if (auto codes = codesOf<std::uint8_t>(signal, frame.bits))
      return {SampleCoding::codes8, *std::move(codes)};
  if (frame.bits > 8 && frame.bits <= 16)
    if (auto codes = codesOf<std::uint16_t>(signal, frame.bits))
      return {SampleCoding::codes16, *std::move(codes)};
  Bytes bytes(signal.size() * sizeof(float));
  std::memcpy(bytes.data(), signal.data(), bytes.size());
  return {SampleCoding::floats, std::move(bytes)};
}

/// Replaces codes by what they differ from those one pixel before, as numbers without a sign: 0, -1, 1, -2,
/// 2 ... become 0, 1, 2, 3, 4: what neighbours have in common takes no bits then.
template <typename Code>
void toDifferences(Bytes& bytes, std::size_t channels) {
  constexpr unsigned top = 8 * sizeof(Code) - 1;
  std::vector<Code> codes(bytes.size() / sizeof(Code));
  std::memcpy(codes.data(), bytes.data(), bytes.size());
  for (std::size_t i = codes.size(); i-- > channels;) {
    auto apart = static_cast<Code>(codes[i] - codes[i - channels]);
    codes[i] = static_cast<Code>((apart << 1U) ^ ((apart >> top) != 0 ? ~Code{0} : Code{0}));
  }
  std::memcpy(bytes.data(), codes.data(), bytes.size());
}

template <typename Code>
void fromDifferences(Bytes& bytes, std::size_t channels) {
  std::vector<Code> codes(bytes.size() / sizeof(Code));
  std::memcpy(codes.data(), bytes.data(), bytes.size());
  for (std::size_t i = channels; i < codes.size(); ++i) {
    auto apart = static_cast<Code>((codes[i] >> 1U) ^ ((codes[i] & 1U) != 0 ? ~Code{0} : Code{0}));
    codes[i] = static_cast<Code>(codes[i - channels] + apart);
  }
  std::memcpy(bytes.data(), codes.data(), bytes.size());
}

/// Differences of codes, their bits sorted by value, through LZ4: takes a sixth of the time that writing
/// what it saves would.
std::string compressed(CodedFrame frame, std::size_t channels) {
  if (frame.coding == SampleCoding::codes8) toDifferences<std::uint8_t>(frame.bytes, channels);
  if (frame.coding == SampleCoding::codes16) toDifferences<std::uint16_t>(frame.bytes, channels);
  std::string packed(frame.bytes.size() + BLOSC_MAX_OVERHEAD, '\0');
  const int size = blosc_compress_ctx(1, BLOSC_BITSHUFFLE, bytesOf(frame.coding), frame.bytes.size(),
                                      frame.bytes.data(), packed.data(), packed.size(), "lz4", 0, 1);
  require(size > 0, "Blosc returns {} for {} bytes", size, frame.bytes.size());
  packed.resize(static_cast<std::size_t>(size));
  return packed;
}

/// None unless it gives exactly `size` bytes.
std::optional<Bytes> decompressed(std::string_view packed, SampleCoding coding, std::size_t size,
                                  std::size_t channels) {
  std::size_t whole = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &whole) < 0 || whole != size) return std::nullopt;
  Bytes bytes(size);
  const int got = blosc_decompress_ctx(packed.data(), bytes.data(), bytes.size(), 1);
  if (got < 0 || static_cast<std::size_t>(got) != size) return std::nullopt;
  if (coding == SampleCoding::codes8) fromDifferences<std::uint8_t>(bytes, channels);
  if (coding == SampleCoding::codes16) fromDifferences<std::uint16_t>(bytes, channels);
  return bytes;
}

template <typename Stored>
void readSamples(const char* from, std::vector<float>& signal, double full) {
  for (std::size_t i = 0; i < signal.size(); ++i, from += sizeof(Stored)) {
    Stored value;
    std::memcpy(&value, from, sizeof(value));
    if constexpr (std::is_same_v<Stored, float>)
      signal[i] = value;
    else
      signal[i] = static_cast<float>(static_cast<double>(value) / full);
  }
}

std::string checksumOf(const Json& headerWithoutChecksum, std::string_view samples) {
  return Fingerprint().add(headerWithoutChecksum.dump()).add(samples).hex();
}

}  // namespace

std::string shotFileOf(const rig::Shot& shot) {
  std::string samples;
  Json frames = Json::array();
  for (const auto& exposure : shot.frames) {
    Json cameras = Json::array();
    for (const rig::RawFrame& frame : exposure) {
      CodedFrame stored = coded(frame);
      const SampleCoding coding = stored.coding;
      const std::string packed =
          compressed(std::move(stored), static_cast<std::size_t>(frame.signal.channels()));
      samples += packed;
      cameras.push_back({{"width", frame.signal.width()},
                         {"height", frame.signal.height()},
                         {"channels", frame.signal.channels()},
                         {"bits", frame.bits},
                         {"seconds", frame.seconds},
                         {"samples", coding},
                         {"bytes", packed.size()}});
    }
    frames.push_back(std::move(cameras));
  }
  Json header = {{"format", shotFormat},
                 {"version", formatVersion},
                 {"stage", shot.id.stage},
                 {"number", shot.id.number},
                 {"fingerprint", shot.fingerprint},
                 {"exposures_asked", shot.exposuresAsked},
                 {"frames", std::move(frames)}};
  header["checksum"] = checksumOf(header, samples);
  return header.dump() + "\n" + samples;
}

namespace {

/// Bytes that the header says a frame's samples take; 0 if the header makes no sense.
std::size_t bytesOf(const Json& frame) {
  auto width = frame.at("width").get<std::int64_t>();
  auto height = frame.at("height").get<std::int64_t>();
  auto channels = frame.at("channels").get<std::int64_t>();
  std::int64_t most = 1 << 16;
  if (width < 1 || height < 1 || channels < 1 || width > most || height > most || channels > 64) return 0;
  return static_cast<std::size_t>(width * height * channels) *
         bytesOf(frame.at("samples").get<SampleCoding>());
}

/// The same of what lies in the file.
std::size_t storedBytesOf(const Json& frame) {
  return frame.contains("bytes") ? frame["bytes"].get<std::size_t>() : bytesOf(frame);
}

/// The frame of which `stored` are the samples; none if they are not.
std::optional<rig::RawFrame> frameFrom(const Json& description, std::string_view stored) {
  const auto coding = description.at("samples").get<SampleCoding>();
  const std::size_t size = bytesOf(description);
  const int bits = description.at("bits");
  constexpr int most = 32;
  if (size == 0 || bits < 0 || bits > most || (bits == 0 && coding != SampleCoding::floats))
    return std::nullopt;
  std::optional<Bytes> unpacked;
  if (description.contains("bytes")) {
    unpacked = decompressed(stored, coding, size, description.at("channels").get<std::size_t>());
    if (!unpacked) return std::nullopt;
  }
  const char* from = unpacked ? unpacked->data() : stored.data();
  rig::RawFrame frame{
      image::Image({description.at("width"), description.at("height")}, description.at("channels")), bits,
      description.at("seconds")};
  switch (coding) {
    case SampleCoding::codes8:
      readSamples<std::uint8_t>(from, frame.signal.data(), fullScale(frame.bits));
      break;
    case SampleCoding::codes16:
      readSamples<std::uint16_t>(from, frame.signal.data(), fullScale(frame.bits));
      break;
    case SampleCoding::floats:
      readSamples<float>(from, frame.signal.data(), 1.0);
      break;
  }
  return frame;
}

bool isKnownVersion(const Json& version) {
  return version == formatVersion || version == plainVersion;
}

/// The line before the samples; null unless it is one of ours.
Json headerOf(std::string_view content) try {
  const std::size_t line = content.find('\n');
  if (line == std::string_view::npos) return {};
  const std::string_view text = content.substr(0, line);
  Json header = parsedJson<Json>(text);
  const bool isOurs = header.is_object() && header.value("format", Json()) == shotFormat &&
                      isKnownVersion(header.value("version", Json())) && header.contains("checksum");
  return isOurs ? std::move(header) : Json();
} catch (const Json::exception&) {
  return {};
}

/// Throws: Json::exception for a header that lacks something.
std::optional<rig::Shot> parse(std::string_view content) {
  Json header = headerOf(content);
  if (header.is_null()) return std::nullopt;
  Json checksum = header["checksum"];
  header.erase("checksum");
  std::string_view samples = content.substr(content.find('\n') + 1);
  if (checksum != checksumOf(header, samples)) return std::nullopt;

  std::size_t expected = 0;
  for (const Json& exposure : header.at("frames"))
    for (const Json& frame : exposure) expected += storedBytesOf(frame);
  if (expected != samples.size()) return std::nullopt;

  rig::Shot shot{
      {header.at("stage"), header.at("number")}, header.at("fingerprint"), {}, header.at("exposures_asked")};
  for (const Json& exposure : header.at("frames")) {
    std::vector<rig::RawFrame>& cameras = shot.frames.emplace_back();
    for (const Json& description : exposure) {
      const std::size_t bytes = storedBytesOf(description);
      std::optional<rig::RawFrame> frame = frameFrom(description, samples.substr(0, bytes));
      if (!frame) return std::nullopt;
      cameras.push_back(*std::move(frame));
      samples.remove_prefix(bytes);
    }
  }
  return shot;
}

}  // namespace

std::optional<rig::Shot> shotFrom(std::string_view content) try {
  return parse(content);
} catch (const Json::exception&) {
  return std::nullopt;
}

bool isPlainShotFile(std::string_view content) {
  const Json header = headerOf(content);
  return !header.is_null() && header.at("version") == plainVersion;
}

}  // namespace relucent::calibration
