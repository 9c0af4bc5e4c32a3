// SPDX-License-Identifier: MIT
#include "relucent/pipeline/perfect.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/base/utc.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/projection_photographs.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

void requireReachable(const compensation::Target& target, const fs::path& image) {
  if (std::ranges::count(target.reachable, 0) < std::ssize(target.reachable)) return;
  throw Error(ErrorKind::input,
              RELUCENT_ENGLISH_MESSAGE("compensation.nothing-reachable",
                                       "no part of the picture can be shown in this venue"),
              RELUCENT_ENGLISH_MESSAGE("compensation.darken-or-move-content",
                                       "make the content darker, or place it where the projector reaches"),
              image.string());
}

/// A calibration whose pictures are perfected one after the other.
class Perfecter {
 public:
  Perfecter(const fs::path& path, const PerfectSettings& settings, RigSource source, Progress& progress)
      : folder_(openWithSet(path, settings.set)),
        settings_(settings),
        chosen_(settingsOf(folder_)),
        source_(std::move(source)) {
    Progress loading =
        progress.part(0.2, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
    measured_ = loadCalibration(folder_, loading);
    Progress opening =
        progress.part(0.1, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
    source_.open(settings.rig.value_or(measured_.rig), measured_.venue.transport, folder_, opening);
    compensation::CompensatorSettings solver;
    solver.clustering = chosen_.clustering;
    compensator_.emplace(measured_.venue, measured_.inverse, solver);
    photographs_.emplace(source_.whole(), measured_, "perfect");
  }

  int exposures() const { return photographs_->exposures(); }

  /// Throws: as perfectPictures(); Error of what is wrong with this picture.
  PerfectedImage perfect(const fs::path& file, const std::function<void(const PerfectingRound&)>& observer,
                         Progress& progress) {
    const image::Image picture = image::readLinearContent(file);
    const Rasters& projectors = measured_.venue.transport.projectors();
    const std::string key = perfectedKeyOf(folder_, file, picture.size(), settings_.canvas);
    const compensation::Target target =
        fitTarget(onCanvas(picture, settings_.canvas), measured_.venue, targetOf(chosen_.content));
    requireReachable(target, file);
    PerfectedImage result;
    result.image = file;
    Progress solving = progress.part(0.1, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
    compensation::Compensation start;
    if (const std::optional<PerfectedPicture> earlier = findPerfected(folder_.path(), key)) {
      start.projector = driveOf(*earlier, projectors);
      result.wentOn = true;
    } else {
      start = compensator_->solve(chosen_.content.method, target, solving);
    }
    Progress photographing = progress.part(
        0.9, RELUCENT_MESSAGE("stage.perfecting", "Correcting the picture by photographs of itself"));
    const PerfectingCamera camera{
        [&] { return photographs_->black(photographing); },
        [&](const ProjectorStack& drive) { return photographs_->of(drive, photographing); }};
    PerfectingResult found = perfected(
        *compensator_, target, std::move(start), camera, settings_.photographs,
        [&](const PerfectingRound& round, const ProjectorStack&) { observer(round); }, photographing);
    result.end = found.end;
    result.disturbance = std::move(found.disturbance);
    result.rounds = std::move(found.rounds);
    result.before = std::move(found.before);
    result.after = std::move(found.after);
    result.photographs = found.photographs;
    result.kept = found.better;
    if (result.kept)
      result.files = savePerfected({key,
                                    folder_.path(),
                                    file.string(),
                                    utcNow(),
                                    {result.before.views, result.after.views, result.photographs},
                                    {},
                                    fingerprintOfShown(folder_),
                                    settings_.canvas},
                                   found.picture.projector, projectors);
    return result;
  }

 private:
  calibration::CalibrationFolder folder_;
  const PerfectSettings& settings_;
  CalibrateSettings chosen_;
  RigSource source_;
  MeasuredCalibration measured_;
  std::optional<compensation::Compensator> compensator_;
  std::optional<ProjectionPhotographs> photographs_;
};

/// Of the picture itself: others can be perfected all the same.
bool isOfThePicture(const Error& error) {
  return error.kind() != ErrorKind::device && error.kind() != ErrorKind::memory;
}

PerfectResult perfectedBy(const fs::path& path, const PerfectSettings& settings, RigSource source,
                          const PerfectingObserver& observer, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  Perfecter perfecter(path, settings, std::move(source), progress);
  PerfectResult result;
  Stopwatch watch;
  const double share = 0.7 / static_cast<double>(settings.images.size());
  for (std::size_t image = 0; image < settings.images.size(); ++image) {
    Progress one = progress.part(
        share, RELUCENT_MESSAGE("stage.perfecting", "Correcting the picture by photographs of itself"));
    const auto told = [&](const PerfectingRound& round) {
      if (observer) observer(image, round);
    };
    try {
      result.images.push_back(perfecter.perfect(settings.images[image], told, one));
    } catch (const Error& error) {
      if (!isOfThePicture(error)) throw;
      PerfectedImage& failed = result.images.emplace_back();
      failed.image = settings.images[image];
      failed.failure = error.sentence();
    }
    if (progress.stopAndKeep()) break;
  }
  result.exposures = perfecter.exposures();
  result.seconds = watch.seconds();
  progress.report(1.0);
  return result;
}

}  // namespace

std::vector<Message> problems(const PerfectSettings& settings) {
  std::vector<Message> found;
  if (settings.images.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("perfect.no-pictures", "there is no still picture to perfect"));
  std::ranges::move(problems(settings.canvas), std::back_inserter(found));
  if (settings.photographs < 2 || settings.photographs > mostPerfectingPhotographs)
    found.push_back(perfectingPhotographsOutOfRange());
  return found;
}

PerfectResult perfectPictures(const fs::path& path, const PerfectSettings& settings, const fs::path& cache,
                              const PerfectingObserver& observer, Progress& progress) {
  return perfectedBy(path, settings, RigSource(cache), observer, progress);
}

PerfectResult perfectPictures(const fs::path& path, const PerfectSettings& settings, rig::Rig& rig,
                              const PerfectingObserver& observer, Progress& progress) {
  return perfectedBy(path, settings, RigSource(rig), observer, progress);
}

bool isPerfect(const PerfectResult& result) {
  return std::ranges::all_of(result.images, [](const PerfectedImage& image) {
    return image.failure.empty() && image.end != PerfectingEnd::disturbed;
  });
}

bool isPerfected(const fs::path& path, const fs::path& image, const compensation::ContentCanvas& canvas,
                 const std::string& set) {
  const calibration::CalibrationFolder folder = openWithSet(path, set);
  return findPerfected(path, perfectedKeyOf(folder, image, image::readLinearContent(image).size(), canvas))
      .has_value();
}

bool isOutOfDate(const PerfectedPicture& picture, const calibration::CalibrationFolder& folder) {
  const std::vector<std::string> shown = fingerprintsOfSets(folder);
  if (!picture.shownFrom.empty() && std::ranges::count(shown, picture.shownFrom) == 0) return true;
  std::error_code code;
  // A name that depends on where somebody was then may be another file's now.
  const fs::path file(picture.picture);
  if (!picture.canvas || !file.is_absolute() || !fs::is_regular_file(file, code)) return false;
  try {
    const Size size = image::readLinearContent(file).size();
    const std::string content = compensation::contentIdentity(readFile(file), size, *picture.canvas);
    return std::ranges::none_of(
        shown, [&](const std::string& from) { return perfectedKey(from, content) == picture.key; });
  } catch (const Error&) {
    return false;  // nobody knows what it is
  }
}

ForgottenPictures forgetPerfected(const fs::path& path, const std::vector<fs::path>& images,
                                  const compensation::ContentCanvas& canvas, const std::string& set) {
  const calibration::CalibrationFolder folder = openWithSet(path, set);
  std::vector<std::string> keys;
  for (const fs::path& image : images)
    keys.push_back(perfectedKeyOf(folder, image, image::readLinearContent(image).size(), canvas));
  ForgottenPictures forgotten;
  for (const PerfectedPicture& picture : allPerfected(folder.path())) {
    if (!images.empty() && std::ranges::count(keys, picture.key) == 0) continue;
    removePerfected(picture);
    forgotten.pictures.push_back(picture.picture);
  }
  return forgotten;
}

}  // namespace relucent::pipeline
