// SPDX-License-Identifier: MIT
// What measurements leave: light transport, operators, photographs, recordings.
#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "core/transport/random_blocks.h"
#include "fuzz/sample_calibration.h"
#include "fuzz/scratch.h"
#include "fuzz/targets.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parsed_json.h"
#include "relucent/base/zip_file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/shot_file.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/devices/recording/recording_files.h"
#include "relucent/inverse/window_file.h"
#include "relucent/transport/files.h"
#include "relucent/venue/traced_transport.h"
#include "relucent/venue/transport_cache.h"
#include "support/stored_zip.h"

namespace relucent::fuzz {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

transport::TransportMatrix someTransport() {
  const Rasters cameras(std::vector<Size>{{5, 3}, {2, 2}}), projectors(std::vector<Size>{{9, 7}, {1, 5}});
  return {cameras, projectors,
          randomBlocks(cameras.count(), transport::NodeLayout(projectors).count(), 0.1, 9).sparse};
}

std::vector<std::string> transportSeeds() {
  const fs::path path = scratch() / "seed.npz";
  std::vector<std::string> seeds;
  for (const auto values : {transport::StoredValues::codes, transport::StoredValues::floats}) {
    transport::saveTransport(path, someTransport(), values);
    seeds.push_back(readFile(path));
  }
  return seeds;
}

void fuzzTransportFile(Bytes input) {
  transport::loadTransport(scratchFile("input.npz", textOf(input)));
}

/// The members of an archive one after the other, so that changes of them need no new checksums.
std::string membersOf(const fs::path& archive) {
  std::string text;
  for (const auto& [name, content] : test::zipMembers(readFile(archive)))
    text += name + '\n' + std::to_string(content.size()) + '\n' + content;
  return text;
}

/// The archive of what membersOf() made, or of what became of it.
std::string archiveOf(std::string_view text) {
  std::vector<std::pair<std::string, std::string>> members;
  while (!text.empty()) {
    const std::size_t name = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(std::min(name + 1, text.size()));
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    const std::size_t bytes = std::strtoul(std::string(rest.substr(0, length)).c_str(), nullptr, 10);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    const std::string_view content = rest.substr(0, bytes);
    members.emplace_back(text.substr(0, std::min<std::size_t>(name, 100)), content);
    text = rest.substr(content.size());
  }
  return test::storedZip(members);
}

std::vector<std::string> arraySeeds() {
  std::vector<std::string> seeds;
  const fs::path path = scratch() / "seed.npz";
  for (const auto values : {transport::StoredValues::codes, transport::StoredValues::floats}) {
    transport::saveTransport(path, someTransport(), values);
    seeds.push_back(membersOf(path));
  }
  transport::saveBlocks(path, randomSharedBlocks(7, 9, 0.3, 4).sparse);
  seeds.push_back(membersOf(path));
  seeds.push_back(membersOf(sampleFile("transport.npz")));
  return seeds;
}

void fuzzTransportArrays(Bytes input) {
  transport::loadTransport(scratchFile("input.npz", archiveOf(textOf(input))));
}

void fuzzBlocks(Bytes input) {
  transport::loadBlocks(scratchFile("input.npz", archiveOf(textOf(input))));
}

constexpr const char* windowKey = "k";

std::vector<std::string> windowSeeds() {
  const fs::path path = scratch() / "seed.npz";
  inverse::saveWindows(path, sampleWindows(), windowKey);
  return {membersOf(path)};
}

void fuzzWindows(Bytes input) {
  inverse::loadWindows(scratchFile("input.npz", archiveOf(textOf(input))), windowKey);
}

constexpr std::size_t tracedNodes = 6, tracedPixels = 5, fingerprintLength = 32;
constexpr const char* tracedKey = "0123456789abcdef0123456789abcdef";

std::vector<std::string> tracedSeeds() {
  const fs::path path = scratch() / "seed.venue";
  venue::TracedTransport traced;
  traced.cameraByNode = randomBlocks(tracedNodes, tracedPixels, 0.4, 3).sparse;
  traced.fullScale.assign(tracedNodes, 1.0f);
  traced.roomLight = CameraStack(Stack(3 * tracedPixels, 0.5f));
  venue::writeTracedTransport(path, tracedKey, traced);
  return {readFile(path)};
}

/// Whatever was changed, with its fingerprint.
void fuzzTracedVenue(Bytes input) {
  std::string content(textOf(input));
  if (content.size() >= fingerprintLength) content.resize(content.size() - fingerprintLength);
  content += Fingerprint().add(std::string_view(content)).hex();
  venue::readTracedTransport(scratchFile("input.venue", content), tracedKey, tracedNodes, tracedPixels);
}

rig::Shot someShot(int bits) {
  rig::Shot shot{{"acquisition", 17}, "0123abcd", {}, {0.02, 0.005}};
  Random random{20071028, static_cast<std::uint64_t>(bits)};
  for (int exposure = 0; exposure < 2; ++exposure) {
    std::vector<rig::RawFrame>& cameras = shot.frames.emplace_back();
    for (int camera = 0; camera < 2; ++camera) {
      rig::RawFrame frame{image::Image({6, 4}, 3), bits, 0.02};
      const double full = bits > 0 ? static_cast<double>((1U << static_cast<unsigned>(bits)) - 1U) : 0.0;
      for (float& value : frame.signal.data())
        value =
            bits > 0 ? static_cast<float>(std::floor(random.uniform() * full) / full) : random.uniformFloat();
      cameras.push_back(std::move(frame));
    }
  }
  return shot;
}

std::vector<std::string> shotSeeds() {
  std::vector<std::string> seeds{calibration::shotFileOf(someShot(8)), calibration::shotFileOf(someShot(12)),
                                 calibration::shotFileOf(someShot(0))};
  // Of the first version: as the samples are.
  seeds.push_back(
      R"({"format":"relucent shot","version":1,"stage":"a","number":1,"fingerprint":"f","exposures_asked":[0.1],)"
      R"("frames":[[{"width":2,"height":1,"channels":3,"bits":8,"seconds":0.1,"samples":"codes8"}]],"checksum":""})"
      "\nabcdef");
  return seeds;
}

/// Whatever was changed, with its checksum.
void fuzzShot(Bytes input) {
  std::string content(textOf(input));
  const std::size_t line = std::min(content.find('\n'), content.size());
  try {
    Json header = parsedJson<Json>(std::string_view(content).substr(0, line));
    header.erase("checksum");
    const std::string samples = content.substr(std::min(line + 1, content.size()));
    header["checksum"] =
        Fingerprint().add(std::string_view(header.dump())).add(std::string_view(samples)).hex();
    content = header.dump() + "\n" + samples;
  } catch (const Json::exception&) {  // as it is
  }
  calibration::isPlainShotFile(content);
  calibration::shotFrom(content);
}

std::vector<std::string> recordingSeeds() {
  devices::RecordedDevices devices;
  devices.projectors = {{"first", {16, 12}, 8}, {"second", {8, 8}, 8}};
  devices.cameras = {{"camera", {12, 9}, 0.001, 2.0}};
  devices::writeRecordedDevices(scratch(), devices);
  return {readFile(scratch() / "recording.json")};
}

void fuzzRecording(Bytes input) {
  scratchFile("recording.json", textOf(input));
  devices::readRecordedDevices(scratch());
}

std::vector<std::string> recordedSeeds() {
  const fs::path file = scratch() / "photographs.jsonl";
  fs::remove(file);
  devices::RecordedPhotograph photograph;
  photograph.shot = rig::ShotId{"acquisition", 3};
  photograph.exposure = 1;
  photograph.asked = photograph.seconds = 0.02;
  photograph.bits = 12;
  photograph.file = "a.exr";
  photograph.patterns = {"ab", "cd"};
  devices::appendPhotograph(scratch(), photograph);
  photograph.camera = 1;
  photograph.shot = rig::ShotId{"linearization", 0};
  photograph.file = "b.exr";
  photograph.patterns.pop_back();
  devices::appendPhotograph(scratch(), photograph);
  return {readFile(file)};
}

void fuzzRecorded(Bytes input) {
  scratchFile("photographs.jsonl", textOf(input));
  devices::readPhotographs(scratch());
}

/// The first byte says which of an acquisition's files the others are.
std::vector<std::string> acquisitionSeeds() {
  std::vector<std::string> seeds;
  char number = 0;
  for (const std::string& name : sampleFiles())
    seeds.push_back(std::string(1, number++) + readFile(sampleFile(name)));
  return seeds;
}

void fuzzAcquisitionFile(Bytes input) {
  if (input.empty()) return;
  const std::vector<std::string>& names = sampleFiles();
  const std::string& name = names[std::to_integer<std::size_t>(input[0]) % names.size()];
  const std::string_view content = textOf(input.subspan(1));
  calibration::StageResult result = sampleAcquisition();
  const fs::path folder = scratch() / "acquisition";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  for (const std::string& other : names) {
    fs::remove(folder / other, ignored);
    if (other != name) fs::create_symlink(sampleFile(other), folder / other);
  }
  scratchFile(folder / name, content);
  result.folder = folder;
  for (calibration::ResultFile& file : result.files)
    if (file.name == name) file.bytes = content.size();
  calibration::loadAcquisition(result);
}

}  // namespace

std::vector<FuzzTarget> measurementTargets() {
  const std::vector<std::string> npyWords{"'descr': '<f4'",
                                          "'descr': '<i8'",
                                          "'descr': '<i2'",
                                          "'descr': '|S999999999999'",
                                          "'shape': ()",
                                          "'shape': (0,)",
                                          "'shape': (4294967296, 4294967296)",
                                          "'fortran_order': True",
                                          "relucent-shared-colours",
                                          "relucent-shared-leaves",
                                          "bsr",
                                          "group_parent.npy",
                                          "group_of.npy",
                                          "\x93NUMPY\x02"};
  const std::vector<std::string> shotWords{"\"codes16\"", "\"float\"", "\"bits\":0", "\"bits\":64",
                                           "\"bytes\":18446744073709551615"};
  return {
      {"transport file", fuzzTransportFile, transportSeeds, Form::bytes, 600, {"PK\x01\x02", "PK\x05\x06"}},
      {"transport arrays", fuzzTransportArrays, arraySeeds, Form::bytes, 150, npyWords},
      {"blocks", fuzzBlocks, arraySeeds, Form::bytes, 800, npyWords},
      {"windows", fuzzWindows, windowSeeds, Form::bytes, 500, npyWords},
      {"acquisition file", fuzzAcquisitionFile, acquisitionSeeds, Form::bytes, 300, {}},
      {"traced venue", fuzzTracedVenue, tracedSeeds, Form::bytes, 1000, {}},
      {"shot", fuzzShot, shotSeeds, Form::jsonLine, 1500, shotWords},
      {"recording", fuzzRecording, recordingSeeds, Form::json, 1000, {}},
      {"recorded photographs", fuzzRecorded, recordedSeeds, Form::bytes, 1000, {}}};
}

}  // namespace relucent::fuzz
