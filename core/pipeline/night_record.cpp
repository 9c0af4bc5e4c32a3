// SPDX-License-Identifier: MIT
#include "relucent/pipeline/night_record.h"

#include <string_view>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/calibration/message_json.h"
#include "relucent/pipeline/picture_error_json.h"

namespace relucent::pipeline {
namespace {

namespace fs = std::filesystem;
using calibration::Json;

Json toJson(const NightRecord& night) {
  Json json{
      {"when", night.when}, {"what", night.what}, {"perfected", night.perfected}, {"seconds", night.seconds}};
  if (night.repair) json["repair"] = *night.repair;
  if (night.measured) json["measured"] = *night.measured;
  if (night.predicted) json["predicted"] = *night.predicted;
  if (!night.alarm.empty()) json["alarm"] = night.alarm;
  if (!night.skipped.empty()) json["skipped"] = night.skipped;
  if (night.ofPerfected) json["of_perfected"] = true;
  if (night.told) json["told"] = true;
  if (!night.untold.empty()) json["untold"] = night.untold;
  return json;
}

NightRecord nightFrom(const Json& json) {
  NightRecord night;
  night.when = json.at("when").get<std::string>();
  if (json.contains("repair")) night.repair = json.at("repair").get<RepairEnd>();
  night.what = json.at("what").get<std::vector<Message>>();
  night.perfected = json.at("perfected").get<int>();
  if (json.contains("measured")) night.measured = json.at("measured").get<PictureError>();
  if (json.contains("predicted")) night.predicted = json.at("predicted").get<PictureError>();
  if (json.contains("alarm")) night.alarm = json.at("alarm").get<Message>();
  night.seconds = json.at("seconds").get<double>();
  // Not in histories of earlier versions.
  if (json.contains("skipped")) night.skipped = json.at("skipped").get<Message>();
  night.ofPerfected = json.value("of_perfected", false);
  night.told = json.value("told", false);
  if (json.contains("untold")) night.untold = json.at("untold").get<Message>();
  return night;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end > begin) lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

}  // namespace

std::vector<NightRecord> nightsOf(const fs::path& calibration) {
  const fs::path file = calibration / nightsName;
  std::error_code code;
  if (!fs::exists(file, code)) return {};
  std::vector<NightRecord> nights;
  try {
    for (const std::string& line : linesOf(readFile(file)))
      nights.push_back(nightFrom(parsedJson<Json>(line)));
  } catch (const Json::exception& cause) {
    throw Error(
        ErrorKind::format,
        RELUCENT_ENGLISH_MESSAGE("night.history-unreadable", "the history of the nights cannot be read ({})")
            .with(cause.what()),
        RELUCENT_ENGLISH_MESSAGE("night.history-advice",
                                 "the next night begins a new one and keeps this file beside it"),
        file.string());
  }
  return nights;
}

void addNight(const fs::path& calibration, const NightRecord& night) {
  const fs::path file = calibration / nightsName;
  std::vector<std::string> lines;
  try {
    nightsOf(calibration);
    std::error_code code;
    if (fs::exists(file, code)) lines = linesOf(readFile(file));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::format) throw;
    std::error_code ignored;  // then it is overwritten
    fs::rename(file, file.string() + ".unreadable", ignored);
  }
  lines.push_back(toJson(night).dump());
  std::string text;
  for (std::size_t i = lines.size() > mostNights ? lines.size() - mostNights : 0; i < lines.size(); ++i)
    text += lines[i] + '\n';
  writeFileAtomically(file, text);
}

}  // namespace relucent::pipeline
