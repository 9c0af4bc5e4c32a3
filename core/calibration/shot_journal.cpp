// SPDX-License-Identifier: MIT
#include "relucent/calibration/shot_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/shot_file.h"

namespace relucent::calibration {
namespace fs = std::filesystem;
namespace {

bool isPlain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

}  // namespace

bool isShotLeftover(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".") && name.ends_with(".shot") && name.find(".part") != std::string::npos;
}

ShotJournal::ShotJournal(fs::path folder) : folder_(std::move(folder)) {
  createFolder(folder_);
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
    if (isShotLeftover(entry.path())) leftovers.push_back(entry.path());
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
    std::optional<rig::Shot> shot = shotFrom(readFile(path));
    if (!shot || shot->id != id || shot->fingerprint != fingerprint) return std::nullopt;
    return shot;
  } catch (const Error&) {
    return std::nullopt;  // unreadable: taken again, and keep() reports what is wrong with the disk
  }
}

std::optional<fs::file_time_type> ShotJournal::keptAt(const rig::ShotId& id,
                                                      const std::string& fingerprint) const {
  std::error_code code;
  const fs::file_time_type when = fs::last_write_time(pathOf(id, fingerprint), code);
  return code ? std::nullopt : std::optional(when);
}

void ShotJournal::keep(const rig::Shot& shot) {
  const std::string content = shotFileOf(shot);
  writeFileAtomically(pathOf(shot.id, shot.fingerprint), content);
  bytesOfLast_ = content.size();
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
