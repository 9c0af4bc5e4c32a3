// SPDX-License-Identifier: MIT
#include "relucent/calibration/shot_journal.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/calibration/enum_json.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "shot files hold little endian samples");

constexpr const char* formatName = "relucent shot";
constexpr int formatVersion = 1;

/// How a frame's samples are stored: whole codes where those give back every bit.
enum class SampleCoding { codes8, codes16, floats };
constexpr EnumName<SampleCoding> sampleCodingNames[]{
    {SampleCoding::codes8, "codes8"}, {SampleCoding::codes16, "codes16"}, {SampleCoding::floats, "float"}};
constexpr EnumNames<SampleCoding> namesOf(SampleCoding) {
  return {"coding of samples", sampleCodingNames};
}

double fullScale(int bits) {
  return static_cast<double>((1U << static_cast<unsigned>(bits)) - 1U);
}

/// Appends the samples as codes. False, with nothing appended, unless the codes give back every bit.
template <typename Code>
bool appendCodes(std::string& samples, const std::vector<float>& signal, int bits) {
  double full = fullScale(bits);
  std::vector<Code> codes(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    double code = std::nearbyint(static_cast<double>(signal[i]) * full);
    if (!(code >= 0.0 && code <= full)) return false;
    codes[i] = static_cast<Code>(code);
    float decoded = static_cast<float>(code / full);
    if (std::bit_cast<std::uint32_t>(decoded) != std::bit_cast<std::uint32_t>(signal[i])) return false;
  }
  samples.append(reinterpret_cast<const char*>(codes.data()), codes.size() * sizeof(Code));
  return true;
}

/// Appends the samples of a frame in the smallest form that loses nothing; its name goes into the header.
SampleCoding appendFrame(std::string& samples, const rig::RawFrame& frame) {
  const std::vector<float>& signal = frame.signal.data();
  if (frame.bits >= 1 && frame.bits <= 8 && appendCodes<std::uint8_t>(samples, signal, frame.bits))
    return SampleCoding::codes8;
  if (frame.bits > 8 && frame.bits <= 16 && appendCodes<std::uint16_t>(samples, signal, frame.bits))
    return SampleCoding::codes16;
  samples.append(reinterpret_cast<const char*>(signal.data()), signal.size() * sizeof(float));
  return SampleCoding::floats;
}

template <typename Stored>
const char* readSamples(const char* from, std::vector<float>& signal, double full) {
  for (std::size_t i = 0; i < signal.size(); ++i, from += sizeof(Stored)) {
    Stored value;
    std::memcpy(&value, from, sizeof(value));
    if constexpr (std::is_same_v<Stored, float>)
      signal[i] = value;
    else
      signal[i] = static_cast<float>(static_cast<double>(value) / full);
  }
  return from;
}

std::string checksumOf(const Json& headerWithoutChecksum, std::string_view samples) {
  return Fingerprint().add(headerWithoutChecksum.dump()).add(samples).hex();
}

std::string serialise(const rig::Shot& shot) {
  std::size_t samplesAtMost = 0;
  for (const auto& exposure : shot.frames)
    for (const rig::RawFrame& frame : exposure) samplesAtMost += frame.signal.data().size() * sizeof(float);
  std::string samples;
  samples.reserve(samplesAtMost);

  Json frames = Json::array();
  for (const auto& exposure : shot.frames) {
    Json cameras = Json::array();
    for (const rig::RawFrame& frame : exposure) {
      SampleCoding coding = appendFrame(samples, frame);
      cameras.push_back({{"width", frame.signal.width()},
                         {"height", frame.signal.height()},
                         {"channels", frame.signal.channels()},
                         {"bits", frame.bits},
                         {"seconds", frame.seconds},
                         {"samples", coding}});
    }
    frames.push_back(std::move(cameras));
  }
  Json header = {{"format", formatName},
                 {"version", formatVersion},
                 {"stage", shot.id.stage},
                 {"number", shot.id.number},
                 {"fingerprint", shot.fingerprint},
                 {"exposures_asked", shot.exposuresAsked},
                 {"frames", std::move(frames)}};
  header["checksum"] = checksumOf(header, samples);
  return header.dump() + "\n" + samples;
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

/// Bytes that the header says a frame takes; 0 if the header makes no sense.
std::size_t bytesOf(const Json& frame) {
  auto width = frame.at("width").get<std::int64_t>();
  auto height = frame.at("height").get<std::int64_t>();
  auto channels = frame.at("channels").get<std::int64_t>();
  std::int64_t most = 1 << 16;
  if (width < 1 || height < 1 || channels < 1 || width > most || height > most || channels > 64) return 0;
  return static_cast<std::size_t>(width * height * channels) *
         bytesOf(frame.at("samples").get<SampleCoding>());
}

rig::RawFrame frameFrom(const Json& description, const char*& from) {
  Size size{description.at("width"), description.at("height")};
  rig::RawFrame frame{image::Image(size, description.at("channels")), description.at("bits"),
                      description.at("seconds")};
  switch (description.at("samples").get<SampleCoding>()) {
    case SampleCoding::codes8:
      from = readSamples<std::uint8_t>(from, frame.signal.data(), fullScale(frame.bits));
      break;
    case SampleCoding::codes16:
      from = readSamples<std::uint16_t>(from, frame.signal.data(), fullScale(frame.bits));
      break;
    case SampleCoding::floats:
      from = readSamples<float>(from, frame.signal.data(), 1.0);
      break;
  }
  return frame;
}

/// The shot in a file's content; none unless every byte is as it was written.
std::optional<rig::Shot> parse(const std::string& content) {
  std::size_t line = content.find('\n');
  if (line == std::string::npos) return std::nullopt;
  Json header =
      Json::parse(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(line), nullptr, false);
  if (!header.is_object() || header.value("format", Json()) != formatName ||
      header.value("version", Json()) != formatVersion || !header.contains("checksum"))
    return std::nullopt;
  Json checksum = header["checksum"];
  header.erase("checksum");
  std::string_view samples = std::string_view(content).substr(line + 1);
  if (checksum != checksumOf(header, samples)) return std::nullopt;

  std::size_t expected = 0;
  for (const Json& exposure : header.at("frames"))
    for (const Json& frame : exposure) expected += bytesOf(frame);
  if (expected != samples.size()) return std::nullopt;

  rig::Shot shot{
      {header.at("stage"), header.at("number")}, header.at("fingerprint"), {}, header.at("exposures_asked")};
  const char* from = samples.data();
  for (const Json& exposure : header.at("frames")) {
    std::vector<rig::RawFrame>& cameras = shot.frames.emplace_back();
    for (const Json& frame : exposure) cameras.push_back(frameFrom(frame, from));
  }
  return shot;
}

bool isPlain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

}  // namespace

ShotJournal::ShotJournal(fs::path folder) : folder_(std::move(folder)) {
  createFolder(folder_);
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    std::string name = entry.path().filename().string();
    bool leftover =
        name.starts_with(".") && name.ends_with(".shot") && name.find(".part") != std::string::npos;
    if (leftover) leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) fs::remove(path, ignored);
}

fs::path ShotJournal::pathOf(const rig::ShotId& id, const std::string& fingerprint) const {
  require(isPlain(id.stage) && isPlain(fingerprint), "'{}' and '{}' must be letters, digits, - and _",
          id.stage, fingerprint);
  return folder_ / fmt::format("{}-{:06}-{}.shot", id.stage, id.number, fingerprint.substr(0, 8));
}

std::optional<rig::Shot> ShotJournal::find(const rig::ShotId& id, const std::string& fingerprint) {
  fs::path path = pathOf(id, fingerprint);
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return std::nullopt;
  try {
    std::optional<rig::Shot> shot = parse(readFile(path));
    if (!shot || shot->id != id || shot->fingerprint != fingerprint) return std::nullopt;
    return shot;
  } catch (const Error&) {
    return std::nullopt;  // unreadable: taken again, and keep() reports what is wrong with the disk
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void ShotJournal::keep(const rig::Shot& shot) {
  writeFileAtomically(pathOf(shot.id, shot.fingerprint), serialise(shot));
}

void ShotJournal::forget(const rig::ShotId& id, const std::string& fingerprint) {
  fs::path path = pathOf(id, fingerprint);
  std::error_code code;
  fs::remove(path, code);
  if (code)
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("calibration.cannot-remove-photograph", "a photograph cannot be removed ({})")
            .with(code.message()),
        RELUCENT_MESSAGE("calibration.allow-writing-then-resume",
                         "check that the folder may be written to, then go on"),
        path.string());
}

}  // namespace relucent::calibration
