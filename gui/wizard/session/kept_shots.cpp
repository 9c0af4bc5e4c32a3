// SPDX-License-Identifier: MIT
#include "wizard/session/kept_shots.h"

#include <fmt/format.h>

#include <QDateTime>
#include <QDir>
#include <algorithm>

#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "text/written_times.h"

namespace relucent::gui {
namespace fs = std::filesystem;

int photographsKept(const fs::path& calibration, calibration::Stage stage) {
  int count = 0;
  std::error_code code;
  const std::string begin = fmt::format("{}-", nameOf(stage));
  for (const fs::directory_entry& entry : fs::directory_iterator(calibration / "shots", code))
    if (entry.path().filename().string().starts_with(begin)) ++count;
  return count;
}

int photographsSince(const fs::path& calibration, const std::optional<calibration::StageResult>& stored,
                     calibration::Stage stage) {
  if (!stored) return 0;
  // Stored to the second, in which the last photographs of before may have been taken.
  const QDateTime when = timeWritten(stored->stored).addSecs(1);
  const QString begin = QString::fromUtf8(nameOf(stage)) + '-';
  const QDir shots(QString::fromStdString((calibration / "shots").string()));
  const QFileInfoList files = shots.entryInfoList({begin + '*'}, QDir::Files);
  return static_cast<int>(std::count_if(
      files.begin(), files.end(), [&when](const QFileInfo& file) { return file.lastModified() > when; }));
}

int photographsInterrupted(const calibration::CalibrationFolder& folder) {
  constexpr calibration::Stage stage = calibration::Stage::acquisition;
  const calibration::StageProgress progress = calibration::progressOf(folder, stage);
  if (progress == calibration::StageProgress::open) return photographsKept(folder.path(), stage);
  const std::optional<calibration::StageResult> stored = calibration::resultOf(folder, stage);
  // What is complete was not interrupted, whatever the times of copied files say.
  const bool isComplete = progress == calibration::StageProgress::done && stored &&
                          calibration::resultFrom<stage>(*stored).isWhole();
  return isComplete ? 0 : photographsSince(folder.path(), stored, stage);
}

}  // namespace relucent::gui
