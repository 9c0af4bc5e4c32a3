// SPDX-License-Identifier: MIT
#include "relucent/pipeline/import.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/devices/raw/raw_photograph.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/memory_needed.h"
#include "relucent/pipeline/photograph_sequence.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/platform/process.h"
#include "relucent/reduction/choice.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

std::string endingOf(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool isPictureName(const fs::path& path) {
  static const std::set<std::string> endings{".png", ".tif",  ".tiff", ".jpg", ".jpeg",
                                             ".bmp", ".webp", ".pgm",  ".ppm", ".exr"};
  return endings.count(endingOf(path)) > 0 && !path.filename().string().starts_with(".");
}

/// The files of a folder that `isMeant` says yes to, in the order of their names.
std::vector<fs::path> picturesIn(const fs::path& folder, const char* what, bool (*isMeant)(const fs::path&)) {
  std::error_code code;
  std::vector<fs::path> pictures;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->is_regular_file(code) && isMeant(entry->path())) pictures.push_back(entry->path());
  if (code)
    throw Error(
        ErrorKind::disk,
        RELUCENT_ENGLISH_MESSAGE("import.folder-unreadable", "the folder of the {} cannot be read ({})")
            .with(what, code.message()),
        RELUCENT_ENGLISH_MESSAGE("import.check-folder-name", "check its name"), folder.string());
  if (pictures.empty())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("import.folder-without-pictures", "the folder of the {} holds no pictures")
            .with(what),
        RELUCENT_ENGLISH_MESSAGE("import.name-picture-folder",
                                 "name the folder with the PNG, TIFF, JPEG, EXR or raw files themselves"),
        folder.string());
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

bool isPhotographName(const fs::path& path) {
  return isPictureName(path) || (devices::isRawName(path) && !path.filename().string().starts_with("."));
}

/// The photographs of a folder in the order in which they were taken. Of a photograph that is there
/// twice, as cameras write them, the raw file counts.
PhotographSequence photographsIn(const fs::path& folder) {
  const std::vector<fs::path> files = picturesIn(folder, "photographs", isPhotographName);
  std::set<fs::path> raw;
  for (const fs::path& file : files)
    if (devices::isRawName(file)) raw.insert(file.stem());
  std::vector<TakenPhotograph> photographs;
  for (const fs::path& file : files)
    if (devices::isRawName(file))
      photographs.push_back({file, devices::timeTaken(file)});
    else if (!raw.contains(file.stem()))
      photographs.push_back({file, std::nullopt});
  return inOrder(std::move(photographs));
}

/// Files that cameras develop for looking at, by about the curve of sRGB.
bool isDeveloped(const fs::path& path) {
  static const std::set<std::string> endings{".jpg", ".jpeg", ".webp"};
  return endings.count(endingOf(path)) > 0;
}

void clampToDrive(image::Image& image) {
  for (float& value : image.data()) value = std::clamp(value, 0.0f, 1.0f);
}

/// A picture as the estimate takes it: drive from 0 to 1, or linear light.
image::Image readPictureAs(const fs::path& path, bool drive) {
  image::Image image =
      devices::isRawName(path) ? devices::readRawPicture(path) : image::readPicture(path).encoded;
  image::checkFinite(image, path);
  if (drive)
    clampToDrive(image);
  else if (isDeveloped(path))
    image = image::srgbDecoded(image);
  return image;
}

/// How photographs are reduced, and the file that it was chosen by.
struct PhotographReducer {
  reduction::Reducer reducer;
  std::string chosenBy;
};

/// Reads all pictures of a folder, which must be of one size. What the reducer makes of them is kept; none:
/// they are kept as they are.
importing::PictureSequence readSequence(const std::vector<fs::path>& paths, bool drive,
                                        const std::optional<PhotographReducer>& reducer,
                                        Fingerprint& fingerprint, Progress& progress) {
  importing::PictureSequence sequence;
  Size size;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    image::Image image = readPictureAs(paths[k], drive);
    if (k == 0) size = reducer ? reducer->reducer.reduction().camera : image.size();
    if (image.size() != size)
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("import.picture-size-differs", "the picture has {} pixels, but {} has {}")
              .with(as::size(image.width(), image.height()),
                    reducer ? reducer->chosenBy : paths.front().filename().string(), as::size(size)),
          RELUCENT_ENGLISH_MESSAGE("import.take-out-foreign-pictures",
                                   "take out pictures that do not belong there"),
          paths[k].string());
    fingerprint.add(image.data());
    if (reducer) image = reducer->reducer({std::move(image), 0, 1.0}).signal;
    if (k == 0) sequence = importing::PictureSequence(image.size(), static_cast<int>(paths.size()));
    sequence.set(static_cast<int>(k), image);
    progress.report(static_cast<double>(k + 1) / static_cast<double>(paths.size()));
  }
  return sequence;
}

double lightOf(const image::Image& pattern) {
  return std::accumulate(pattern.data().begin(), pattern.data().end(), 0.0);
}

/// From the photographs of the brightest and the darkest pattern; automatically, with as many pixels as there
/// is memory for. Throws: Error{memory}.
PhotographReducer reducerFor(const importing::PictureSequence& patterns,
                             const std::vector<fs::path>& photographs, const reduction::PixelUse& use,
                             const platform::MemoryUse& memory) {
  std::vector<double> lights;
  for (int k = 0; k < patterns.pictures(); ++k) lights.push_back(lightOf(patterns.picture(k)));
  const auto [darkest, brightest] = std::ranges::minmax_element(lights);
  auto photographOf = [&](auto pattern) {
    return photographs[static_cast<std::size_t>(pattern - lights.begin())];
  };
  image::Image light = readPictureAs(photographOf(brightest), false);
  const std::size_t projector = patterns.size().count();
  const auto needed = [&](Size camera) {
    return memoryOfImport(patterns.size(), camera, patterns.pictures());
  };
  const bool mayGrow = use.kind == reduction::PixelUse::Kind::automatic;
  const bool isTooMuch = mayGrow && !platform::fits(needed(light.size()), memory);
  reduction::Reduction reduction = reduction::noReduction(light.size());
  if (isTooMuch || reduction::needsLook(light.size(), projector, use)) {
    const image::Image black = readPictureAs(photographOf(darkest), false);
    // Another size is told as they are read.
    if (black.size() == light.size()) {
      for (std::size_t i = 0; i < light.data().size(); ++i) light.data()[i] -= black.data()[i];
      reduction = reduction::reductionFor(light.size(), projector, use, light);
      while (mayGrow && !platform::fits(needed(reduction.size()), memory)) {
        const auto larger = reduction::withLargerBins(reduction, projector, light, 1);
        if (!larger) break;
        reduction = *larger;
      }
    }
  }
  ensureMemoryForImport(needed(reduction.size()), memory, use);
  return {reduction::Reducer(reduction), photographOf(brightest).filename().string()};
}

/// Before minutes are spent: what CalibrationFolder::create() would refuse in the end.
void checkFolderIsFree(const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(folder, code)) return;
  if (!fs::is_directory(folder, code) || fs::directory_iterator(folder, code) != fs::directory_iterator())
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("disk.name-taken", "there is something of this name already"),
                RELUCENT_ENGLISH_MESSAGE("calibration.choose-empty-folder",
                                         "choose a new or an empty folder for the calibration"),
                folder.string());
}

struct Pictures {
  importing::PictureSequence patterns, photographs;
  bool developed = false;          // some of the photographs were not linear
  Message finding;                 // on the order of the photographs; empty: nothing to be said
  reduction::Reduction reduction;  // of the photographs
  ImportedRigSettings rig;
};

Pictures readPictures(const ImportPicturesSettings& settings, const platform::MemoryUse& memory,
                      Progress& progress) {
  const std::vector<fs::path> patterns = picturesIn(settings.patterns, "patterns", isPictureName);
  const PhotographSequence sequence = photographsIn(settings.photographs);
  if (patterns.size() != sequence.photographs.size()) {
    CountProblem problem = countProblem(sequence.photographs, patterns.size());
    throw Error(ErrorKind::input, std::move(problem.what), std::move(problem.advice),
                settings.photographs.string());
  }
  std::vector<fs::path> photographs;
  for (const TakenPhotograph& photograph : sequence.photographs) photographs.push_back(photograph.path);
  Fingerprint fingerprint;
  Pictures pictures;
  Progress first = progress.part(0.4, RELUCENT_MESSAGE("stage.reading-patterns", "Reading the patterns"));
  pictures.patterns = readSequence(patterns, true, std::nullopt, fingerprint, first);
  std::optional<PhotographReducer> reducer =
      reducerFor(pictures.patterns, photographs, settings.pixels, memory);
  pictures.reduction = reducer->reducer.reduction();
  if (pictures.reduction.isNothing()) reducer.reset();
  Progress second =
      progress.part(0.6, RELUCENT_MESSAGE("stage.reading-photographs", "Reading the photographs"));
  pictures.photographs = readSequence(photographs, false, reducer, fingerprint, second);
  pictures.finding = sequence.finding;
  pictures.developed = std::any_of(photographs.begin(), photographs.end(), isDeveloped);
  pictures.rig = {pictures.patterns.size(),
                  pictures.reduction.camera,
                  static_cast<int>(patterns.size()),
                  fs::absolute(settings.patterns).string(),
                  fs::absolute(settings.photographs).string(),
                  fingerprint.hex()};
  return pictures;
}

double flaggedShare(const transport::Acquisition& acquisition) {
  auto flagged = static_cast<double>(
      acquisition.flagged.size() -
      static_cast<std::size_t>(std::count(acquisition.flagged.begin(), acquisition.flagged.end(), 0)));
  return flagged / static_cast<double>(acquisition.flagged.size());
}

void store(const fs::path& path, const CalibrateSettings& settings, const reduction::Reduction& reduction,
           const importing::Import& import, double seconds) {
  calibration::CalibrationFolder folder = createCalibration(path, settings);
  if (!reduction.isNothing()) keepReductions(folder, {reduction});
  calibration::storeLinearization(folder,
                                  calibration::fingerprintOf(folder, calibration::Stage::linearization),
                                  import.linearization, {});
  const calibration::ImportScore score{import.heldOut, import.error.oneToOne, import.error.mix,
                                       import.error.transport};
  calibration::storeAcquisition(folder, calibration::fingerprintOf(folder, calibration::Stage::acquisition),
                                import.acquisition,
                                {seconds, import.acquisition.patterns, import.acquisition.exposures, score});
}

void storeInverse(const fs::path& path, const compensation::RidgeChoice& choice, double seconds) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::write);
  storeInverse(folder, inverseResultOf(choice, {seconds}));
}

/// What is estimated from the pictures, which are let go of. Sets the rig that they came from, and how they
/// were reduced.
importing::Import estimated(const ImportPicturesSettings& settings, const platform::MemoryUse& memory,
                            CalibrateSettings& stages, reduction::Reduction& reduction, Progress& progress) {
  Progress reading = progress.part(0.1, RELUCENT_MESSAGE("stage.reading-pictures", "Reading the pictures"));
  Pictures pictures = readPictures(settings, memory, reading);
  stages.rig = pictures.rig;
  stages.pixels = settings.pixels;
  reduction = pictures.reduction;
  Progress estimating = progress.part(
      0.7, RELUCENT_MESSAGE("stage.estimating-light-transport", "Estimating the light transport"));
  importing::Import import =
      importing::importTransport(pictures.patterns, pictures.photographs, settings.import, estimating);
  for (Message& finding : findingsOf({reduction}))
    import.linearization.findings.push_back(std::move(finding));
  if (!pictures.finding.empty()) import.linearization.findings.push_back(pictures.finding);
  if (pictures.developed)
    import.linearization.findings.emplace_back(RELUCENT_MESSAGE(
        "import.photographs-are-jpeg",
        "The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only "
        "roughly; develop them linearly, as TIFF or EXR, to measure more exactly"));
  return import;
}

ImportResult resultOf(const importing::Import& import, const ImportedRigSettings& rig) {
  ImportResult result;
  result.projector = rig.projector;
  result.camera = rig.camera;
  result.patterns = rig.pictures;
  result.heldOut = static_cast<int>(import.heldOut.size());
  result.fitted = result.patterns - result.heldOut;
  result.error = import.error;
  result.leaves = import.acquisition.transport.storedLeaves();
  result.flaggedShare = flaggedShare(import.acquisition);
  result.findings = import.linearization.findings;
  result.findings.insert(result.findings.end(), import.acquisition.findings.begin(),
                         import.acquisition.findings.end());
  return result;
}

}  // namespace

ImportResult importPictures(const fs::path& path, const ImportPicturesSettings& settings,
                            Progress& progress) {
  return importPictures(path, settings, platform::memoryLeft(), progress);
}

ImportResult importPictures(const fs::path& path, const ImportPicturesSettings& settings,
                            const platform::MemoryUse& memory, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  checkFolderIsFree(path);
  Stopwatch watch;
  ImportResult result;
  CalibrateSettings stages;
  compensation::MeasuredVenue venue;
  {
    reduction::Reduction reduction;
    const importing::Import import = estimated(settings, memory, stages, reduction, progress);
    result = resultOf(import, std::get<ImportedRigSettings>(stages.rig));
    // What was estimated is safe before it is inverted.
    store(path, stages, reduction, import, watch.seconds());
    venue = measuredVenueOf(import.acquisition, stages.threshold);
  }
  Stopwatch invertingWatch;
  Progress inverting = progress.part(
      0.2, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
  compensation::RidgeChoice choice = invert(venue, stages, inverting);
  storeInverse(path, choice, invertingWatch.seconds());
  progress.report(1.0);
  result.seconds = watch.seconds();
  result.peakMemoryBytes = platform::peakMemoryBytes();
  return result;
}

}  // namespace relucent::pipeline
