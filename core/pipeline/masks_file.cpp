// SPDX-License-Identifier: MIT
#include "relucent/pipeline/masks_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace {

using calibration::Json;
using compensation::Mask;

constexpr std::array<std::string_view, 4> knownKeys{"camera", "outline", "feather", "points"};

[[noreturn]] void failMasks(Message what) {
  throw Error(ErrorKind::format, std::move(what),
              RELUCENT_MESSAGE("masks.draw-again", "draw it again, or correct the file"));
}

[[noreturn]] void failUnreadable(std::size_t number) {
  failMasks(RELUCENT_MESSAGE(
                "masks.unreadable",
                "mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline "
                "and feather")
                .with(as::label(number)));
}

Mask maskFromJson(const Json& json, std::size_t number) {
  if (!json.is_object()) failUnreadable(number);
  for (const auto& [key, value] : json.items())
    if (std::ranges::find(knownKeys, key) == knownKeys.end())
      failMasks(RELUCENT_MESSAGE("masks.unknown-key", "mask {} has \"{}\", which this version does not know")
                    .with(as::label(number), key));
  Mask mask;
  try {
    const int camera = json.value("camera", 1);
    if (camera < 1) failUnreadable(number);
    mask.camera = static_cast<std::size_t>(camera - 1);
    mask.outline = json.value("outline", mask.outline);
    mask.feather = json.value("feather", mask.feather);
    mask.points = json.at("points").get<std::vector<std::array<double, 2>>>();
  } catch (const Json::exception&) {
    failUnreadable(number);
  }
  return mask;
}

}  // namespace

Json masksToJson(const std::vector<Mask>& masks) {
  Json json = Json::array();
  for (const Mask& mask : masks)
    json.push_back({{"camera", mask.camera + 1},
                    {"outline", mask.outline},
                    {"feather", mask.feather},
                    {"points", mask.points}});
  return json;
}

std::vector<Mask> masksFromJson(const Json& json) {
  std::vector<Mask> masks;
  if (!json.is_array()) failUnreadable(1);
  for (const Json& mask : json) masks.push_back(maskFromJson(mask, masks.size() + 1));
  if (std::vector<Message> wrong = compensation::problems(masks); !wrong.empty()) failMasks(wrong.front());
  return masks;
}

std::vector<Mask> readMasks(const std::filesystem::path& file) {
  try {
    const Json json = parsedJson<Json>(readFile(file));
    if (!json.is_object() || !json.contains("masks"))
      throw Error(
          ErrorKind::format, RELUCENT_ENGLISH_MESSAGE("masks.no-list", "this file holds no list of masks"),
          RELUCENT_ENGLISH_MESSAGE("masks.write-list",
                                   "write an object with a list \"masks\", as the documentation has it"));
    return masksFromJson(json.at("masks"));
  } catch (const Json::exception& cause) {
    throw Error(
        ErrorKind::format,
        RELUCENT_ENGLISH_MESSAGE("masks.no-json", "this file of masks is not JSON ({})").with(cause.what()),
        RELUCENT_ENGLISH_MESSAGE("masks.write-list",
                                 "write an object with a list \"masks\", as the documentation has it"),
        file.string());
  }
}

void writeMasks(const std::filesystem::path& file, const std::vector<Mask>& masks) {
  writeFileAtomically(file, Json{{"masks", masksToJson(masks)}}.dump(2) + "\n");
}

compensation::TargetSettings withMasks(compensation::TargetSettings target,
                                       const calibration::CalibrationFolder& folder) {
  if (!target.masks) target.masks = settingsOf(folder).content.masks;
  return target;
}

void keepMasks(calibration::CalibrationFolder& folder, const std::vector<Mask>& masks) {
  CalibrateSettings settings = settingsOf(folder);
  settings.content.masks = masks;
  if (std::vector<Message> found = problems(settings.content); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("settings.change-and-retry", "change that setting and try again"));
  changeSettings(folder, settings);
}

}  // namespace relucent::pipeline
