// SPDX-License-Identifier: MIT
#include "relucent/pipeline/night.h"

#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/base/utc.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/kept_photographs.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace {

namespace fs = std::filesystem;

/// The devices of all three steps: opened by each, or somebody's.
struct Devices {
  const fs::path* cache = nullptr;
  rig::Rig* rig = nullptr;

  template <typename Operation, typename... Arguments>
  auto with(const Operation& operation, const Arguments&... arguments) const {
    return rig != nullptr ? operation(*rig, arguments...) : operation(*cache, arguments...);
  }
};

/// Whether there is anything to tend, which no morning changes.
void requireFinished(const fs::path& path) {
  const auto folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  if (!isComplete(folder))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("night.not-finished", "the calibration is not finished"),
                RELUCENT_ENGLISH_MESSAGE("night.finish-first",
                                         "finish it with resume or the wizard, then let it be tended"),
                path.string());
  if (std::holds_alternative<ImportedRigSettings>(settingsOf(folder).rig))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("night.imported", "the calibration was imported and knows of no devices"),
        RELUCENT_ENGLISH_MESSAGE("night.measure-here", "measure the venue here to have it tended"),
        path.string());
}

/// Those that are not perfected as they are shown now, or cannot be read, which perfecting tells of.
std::vector<fs::path> unperfected(const fs::path& folder, const NightSettings& settings) {
  const auto isKept = [&](const fs::path& image) {
    try {
      return isPerfected(folder, image, settings.canvas, settings.set);
    } catch (const Error&) {
      return false;
    }
  };
  std::vector<fs::path> images;
  for (const fs::path& image : settings.images)
    if (!isKept(image)) images.push_back(image);
  return images;
}

/// The first still that can be read; empty: none can.
fs::path firstReadable(const std::vector<fs::path>& images) {
  for (const fs::path& image : images) {
    try {
      image::readLinearContent(image);
      return image;
    } catch (const Error&) {  // which perfecting tells of
    }
  }
  return {};
}

/// A picture that everybody has.
fs::path standardPicture(const fs::path& folder) {
  const fs::path standard = folder / "night" / "picture.png";
  std::error_code code;
  if (!fs::exists(standard, code)) {
    fs::create_directories(standard.parent_path(), code);
    image::writePng(standard, image::srgbEncoded(standardImages().front().linear), 8);
  }
  return standard;
}

Message notAsPredicted(const ProveResult& proof) {
  if (const double patch = changedPatch(viewOf(proof, *viewThatDiffers(proof))); patch > plainPatch)
    return RELUCENT_MESSAGE(
               "night.part-not-as-predicted",
               "a part of the surface looks otherwise than predicted, by a colour error of {}, and no "
               "repair helped")
        .with(as::number(patch, as::decimals(1)));
  return RELUCENT_MESSAGE("night.not-as-predicted",
                          "the picture has a colour error of {} where {} was predicted, and no repair helped")
      .with(as::number(proof.after.measured.deltaE, as::decimals(1)),
            as::number(proof.after.predicted.deltaE, as::decimals(1)));
}

class Night {
 public:
  Night(const fs::path& folder, const NightSettings& settings, Devices devices)
      : folder_(folder), settings_(settings), devices_(devices) {
    record_.when = settings.when.empty() ? utcNow() : settings.when;
    proved_ = firstReadable(settings.images);
  }

  NightRecord run(Progress& progress) {
    Stopwatch watch;
    try {
      repair(progress);
      perfect(progress);
      prove(progress);
    } catch (const Error& error) {  // of devices, of the disk, of a picture, or of what was measured
      record_.alarm = error.sentence();
    }
    record_.seconds = watch.seconds();
    closeNight(folder_, record_, settings_.alarmCommand);
    progress.report(1.0);
    return record_;
  }

 private:
  void repair(Progress& progress) {
    Progress part =
        progress.part(0.5, RELUCENT_MESSAGE("stage.looking-for-changes", "Looking for what has changed"));
    RepairSettings settings;
    settings.image = proved_;
    settings.rig = settings_.rig;
    const RepairResult result =
        devices_.with([&](auto& devices) { return repairCalibration(folder_, settings, devices, part); });
    record_.repair = result.end;
    record_.what = result.what;
  }

  void perfect(Progress& progress) {
    PerfectSettings settings;
    settings.images = unperfected(folder_, settings_);
    if (settings.images.empty()) return;
    settings.canvas = settings_.canvas;
    settings.photographs = settings_.photographs;
    settings.rig = settings_.rig;
    settings.set = settings_.set;
    Progress part = progress.part(
        0.3, RELUCENT_MESSAGE("stage.perfecting", "Correcting the picture by photographs of itself"));
    const PerfectResult result =
        devices_.with([&](auto& devices) { return perfectPictures(folder_, settings, devices, {}, part); });
    for (const PerfectedImage& image : result.images) {
      record_.perfected += image.kept ? 1 : 0;
      if (!image.failure.empty() && record_.alarm.empty()) record_.alarm = image.failure;
    }
  }

  void prove(Progress& progress) {
    const ContentSettings content = settingsOf(openWithSet(folder_, settings_.set)).content;
    ProveSettings settings;
    settings.image = proved_.empty() ? standardPicture(folder_) : proved_;
    settings.canvas = settings_.canvas;
    settings.method = content.method;
    settings.target = targetOf(content);
    settings.set = settings_.set;
    settings.out = folder_ / "night";
    settings.rig = settings_.rig;
    Progress part = progress.part(
        0.2, RELUCENT_MESSAGE("stage.photographing-projections", "Photographing the projections"));
    const ProveResult proof =
        devices_.with([&](auto& devices) { return proveCalibration(folder_, settings, devices, part); });
    record_.measured = proof.after.measured;
    record_.predicted = proof.after.predicted;
    record_.ofPerfected = proof.perfected;
    if (!isAsPredicted(proof)) record_.alarm = notAsPredicted(proof);
  }

  const fs::path& folder_;
  const NightSettings& settings_;
  Devices devices_;
  fs::path proved_;  // of the stills; empty: there is none
  NightRecord record_;
};

NightRecord tended(const fs::path& folder, const NightSettings& settings, Devices devices,
                   Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  requireFinished(folder);
  return Night(folder, settings, devices).run(progress);
}

}  // namespace

std::vector<Message> problems(const NightSettings& settings) {
  std::vector<Message> found = problems(settings.canvas);
  if (settings.photographs < 2 || settings.photographs > mostPerfectingPhotographs)
    found.push_back(perfectingPhotographsOutOfRange());
  return found;
}

NightRecord tendCalibration(const fs::path& folder, const NightSettings& settings, const fs::path& cache,
                            Progress& progress) {
  return tended(folder, settings, {&cache, nullptr}, progress);
}

NightRecord tendCalibration(const fs::path& folder, const NightSettings& settings, rig::Rig& rig,
                            Progress& progress) {
  return tended(folder, settings, {nullptr, &rig}, progress);
}

}  // namespace relucent::pipeline
