// SPDX-License-Identifier: MIT
#include "relucent/pipeline/drift_record.h"

#include <array>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/json.h"

namespace relucent::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::array verdicts{acquisition::Verdict::stillGood, acquisition::Verdict::remeasure,
                              acquisition::Verdict::startAgain};

[[noreturn]] void failUnreadable(const std::string& why, const fs::path& file) {
  throw Error(ErrorKind::format,
              RELUCENT_ENGLISH_MESSAGE("drift.record-unreadable",
                                       "the record of the check for drift cannot be read ({})")
                  .with(why),
              RELUCENT_ENGLISH_MESSAGE("drift.check-again", "check for drift again"), file.string());
}

acquisition::Verdict verdictFrom(const std::string& name, const fs::path& file) {
  for (acquisition::Verdict verdict : verdicts)
    if (acquisition::toString(verdict) == name) return verdict;
  failUnreadable(name, file);
}

}  // namespace

void saveDriftRecord(const DriftRecord& record, const fs::path& folder) {
  createFolder(folder);
  const calibration::Json json{{"checked", record.checked},
                               {"measurement", record.measurement},
                               {"verdict", acquisition::toString(record.verdict)},
                               {"error", record.error},
                               {"error_then", record.errorThen},
                               {"changed_share", record.changedShare},
                               {"ambient", record.ambient},
                               {"lamp", record.lamp}};
  writeFileAtomically(folder / driftRecordName, json.dump(2));
}

std::optional<DriftRecord> loadDriftRecord(const fs::path& folder) {
  const fs::path file = folder / driftRecordName;
  if (!fs::exists(file)) return std::nullopt;
  try {
    const calibration::Json json = parsedJson<calibration::Json>(readFile(file));
    return DriftRecord{json.at("checked").get<std::string>(),
                       json.at("measurement").get<std::string>(),
                       verdictFrom(json.at("verdict").get<std::string>(), file),
                       json.at("error").get<double>(),
                       json.at("error_then").get<double>(),
                       json.at("changed_share").get<double>(),
                       json.value("ambient", 0.0),
                       json.value("lamp", 1.0)};
  } catch (const calibration::Json::exception& cause) {
    failUnreadable(cause.what(), file);
  }
}

}  // namespace relucent::pipeline
