// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include "relucent/sentinels/observer.h"

namespace relucent::pipeline {

/// What was seen while the light transport was measured: of how it went, not of what it came to. Seconds
/// count from the beginning; sessions of a measurement that was stopped and gone on with follow each other.
struct AcquisitionRecord {
  struct Check {
    double seconds = 0.0;
    sentinels::Reading reading;
  };
  struct Again {
    double seconds = 0.0;
    sentinels::Retake retake;
  };
  double seconds = 0.0;     // in all
  std::vector<int> levels;  // patterns of each block size, coarsest first
  std::vector<Check> checks;
  std::vector<Again> again;
};

inline constexpr const char* acquisitionRecordName = "record.json";

/// Writes it into the folder of the measurement's result. Throws: Error{disk}.
void saveAcquisitionRecord(const AcquisitionRecord& record, const std::filesystem::path& folder);

/// None where the folder holds none, as those of earlier versions. Throws: Error{disk, format} if it cannot
/// be read.
std::optional<AcquisitionRecord> loadAcquisitionRecord(const std::filesystem::path& folder);

/// Looks on for another, and remembers what it is told, after what is on record already.
class RecordingObserver : public sentinels::AcquisitionObserver {
 public:
  /// `other` outlives this.
  RecordingObserver(sentinels::AcquisitionObserver& other, AcquisitionRecord earlier);

  void checked(const sentinels::Reading& reading) override;
  void takenAgain(const sentinels::Retake& retake) override;
  void grew(const std::vector<int>& levels, int through) override;
  bool wantsDrafts() const override { return other_.wantsDrafts(); }
  void drafted(const transport::Draft& draft) override { other_.drafted(draft); }

  AcquisitionRecord record() const;

 private:
  double seconds() const;

  sentinels::AcquisitionObserver& other_;
  AcquisitionRecord record_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace relucent::pipeline
