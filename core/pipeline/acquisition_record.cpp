// SPDX-License-Identifier: MIT
#include "relucent/pipeline/acquisition_record.h"

#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"

namespace relucent::sentinels {

// As the record calls them.
constexpr EnumName<AlarmKind> alarmNames[]{{AlarmKind::flicker, "flicker"},
                                           {AlarmKind::unsteady, "unsteady"},
                                           {AlarmKind::ambientChanged, "ambient_changed"},
                                           {AlarmKind::lampChanged, "lamp_changed"},
                                           {AlarmKind::moved, "moved"},
                                           {AlarmKind::localChange, "local_change"},
                                           {AlarmKind::mirroredScreen, "mirrored_screen"},
                                           {AlarmKind::wrongScreen, "wrong_screen"},
                                           {AlarmKind::coveredLens, "covered_lens"},
                                           {AlarmKind::projectorAsleep, "projector_asleep"}};
constexpr EnumName<RetakeReason> retakeNames[]{{RetakeReason::alarm, "alarm"},
                                               {RetakeReason::overexposed, "overexposed"},
                                               {RetakeReason::contradiction, "contradiction"},
                                               {RetakeReason::dark, "dark"}};
constexpr EnumNames<AlarmKind> namesOf(AlarmKind) {
  return {"alarm", alarmNames};
}
constexpr EnumNames<RetakeReason> namesOf(RetakeReason) {
  return {"reason", retakeNames};
}

}  // namespace relucent::sentinels

namespace relucent::pipeline {
namespace {

namespace fs = std::filesystem;

using calibration::Json;
using sentinels::AlarmKind;
using sentinels::RetakeReason;

[[noreturn]] void failUnreadableRecord(const std::string& why, const fs::path& file) {
  throw Error(ErrorKind::format,
              RELUCENT_ENGLISH_MESSAGE("acquisition.record-unreadable",
                                       "the record of how it was measured cannot be read ({})")
                  .with(why),
              RELUCENT_ENGLISH_MESSAGE("acquisition.record-remove",
                                       "remove that file: what was measured does not need it"),
              file.string());
}

Json toJson(const AcquisitionRecord::Check& check) {
  const sentinels::Reading& reading = check.reading;
  Json json{{"seconds", check.seconds},
            {"shot", reading.shot},
            {"room_light", reading.roomLight},
            {"room_light_at_first", reading.roomLightAtFirst},
            {"room_light_expected", reading.roomLightExpected},
            {"view", reading.view},
            {"lamp", reading.lamp},
            {"lamp_expected", reading.lampExpected},
            {"flicker", reading.flicker}};
  if (reading.alarm) json["alarm"] = *reading.alarm;
  return json;
}

AcquisitionRecord::Check checkFrom(const Json& json) {
  AcquisitionRecord::Check check;
  check.seconds = json.at("seconds");
  sentinels::Reading& reading = check.reading;
  reading.shot = json.at("shot");
  reading.roomLight = json.at("room_light");
  reading.roomLightAtFirst = json.at("room_light_at_first");
  reading.roomLightExpected = json.at("room_light_expected");
  reading.view = json.at("view");
  reading.lamp = json.at("lamp");
  reading.lampExpected = json.at("lamp_expected");
  reading.flicker = json.at("flicker");
  if (json.contains("alarm")) reading.alarm = json.at("alarm").get<AlarmKind>();
  return check;
}

Json toJson(const AcquisitionRecord::Again& again) {
  Json json{{"seconds", again.seconds},
            {"shot", again.retake.shot},
            {"patterns", again.retake.patterns},
            {"reason", again.retake.reason}};
  if (again.retake.alarm) json["alarm"] = *again.retake.alarm;
  return json;
}

AcquisitionRecord::Again againFrom(const Json& json) {
  AcquisitionRecord::Again again;
  again.seconds = json.at("seconds");
  again.retake.shot = json.at("shot");
  again.retake.patterns = json.at("patterns");
  again.retake.reason = json.at("reason").get<RetakeReason>();
  if (json.contains("alarm")) again.retake.alarm = json.at("alarm").get<AlarmKind>();
  return again;
}

}  // namespace

void saveAcquisitionRecord(const AcquisitionRecord& record, const fs::path& folder) {
  Json checks = Json::array(), again = Json::array();
  for (const auto& check : record.checks) checks.push_back(toJson(check));
  for (const auto& retake : record.again) again.push_back(toJson(retake));
  const Json json{
      {"seconds", record.seconds}, {"levels", record.levels}, {"checks", checks}, {"taken_again", again}};
  writeFileAtomically(folder / acquisitionRecordName, json.dump(1));
}

std::optional<AcquisitionRecord> loadAcquisitionRecord(const fs::path& folder) {
  const fs::path file = folder / acquisitionRecordName;
  if (!fs::exists(file)) return std::nullopt;
  const std::string text = readFile(file);
  try {
    const Json json = parsedJson<Json>(text);
    AcquisitionRecord record;
    record.seconds = json.at("seconds");
    record.levels = json.at("levels").get<std::vector<int>>();
    for (const Json& check : json.at("checks")) record.checks.push_back(checkFrom(check));
    for (const Json& again : json.at("taken_again")) record.again.push_back(againFrom(again));
    return record;
  } catch (const Json::exception& cause) {
    failUnreadableRecord(cause.what(), file);
  } catch (const Error& unknownName) {
    failUnreadableRecord(unknownName.what(), file);
  }
}

RecordingObserver::RecordingObserver(sentinels::AcquisitionObserver& other, AcquisitionRecord earlier)
    : other_(other), record_(std::move(earlier)) {}

double RecordingObserver::seconds() const {
  return record_.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void RecordingObserver::checked(const sentinels::Reading& reading) {
  record_.checks.push_back({seconds(), reading});
  other_.checked(reading);
}

void RecordingObserver::takenAgain(const sentinels::Retake& retake) {
  record_.again.push_back({seconds(), retake});
  other_.takenAgain(retake);
}

void RecordingObserver::grew(const std::vector<int>& levels, int through) {
  record_.levels = levels;
  if (!levels.empty()) record_.levels.back() = through;
  other_.grew(levels, through);
}

AcquisitionRecord RecordingObserver::record() const {
  AcquisitionRecord record = record_;
  record.seconds = seconds();
  return record;
}

}  // namespace relucent::pipeline
