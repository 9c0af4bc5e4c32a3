// SPDX-License-Identifier: MIT

#include <chrono>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/utc.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/compensation/expected_error.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/pipeline/evaluation.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/report/report.h"
#include "relucent/report/support_bundle.h"

namespace relucent::report {
namespace fs = std::filesystem;
namespace {

std::string venueSentence(const pipeline::RigSettings& rig) {
  if (const auto* imported = std::get_if<pipeline::ImportedRigSettings>(&rig))
    return fmt::format("Imported from {} photographs taken elsewhere", imported->pictures);
  if (std::holds_alternative<pipeline::ReplayRigSettings>(rig)) return "Computed from recorded photographs";
  if (std::holds_alternative<pipeline::CommandRigSettings>(rig)) return "Measured with external programs";
  const auto* simulated = std::get_if<venue::VenueSettings>(&rig);
  if (simulated == nullptr) return "Measured in the venue";
  for (const venue::VenueDescription& venue : venue::venues())
    if (venue.name == simulated->name)
      return fmt::format("Simulated venue {}: {}", venue.name, venue.sentence);
  return fmt::format("Simulated venue {}", simulated->name);
}

std::vector<std::uint64_t> leavesPerLevel(const transport::TransportMatrix& transport) {
  const transport::NodeLayout& layout = transport.layout();
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(layout.levels()));
  for (const transport::BlockSparse* leaves : {&transport.ownLeaves(), &transport.groups().leaves()})
    for (std::size_t entry = 0; entry < leaves->blocks(); ++entry)
      ++counts[static_cast<std::size_t>(layout.node(leaves->column(entry)).level)];
  return counts;
}

ReportComparison comparisonOf(const pipeline::EvaluatedPictures& pictures) {
  return {pictures.name,
          compensation::Method::refined,
          pictures.wanted,
          pictures.seen.at(compensation::Method::none),
          pictures.seen.at(compensation::Method::refined),
          pictures.white,
          pictures.inside,
          pictures.reachable,
          true};
}

/// What T predicts, where the truth is not known.
ReportComparison predictedComparison(const pipeline::NamedImage& image,
                                     const pipeline::MeasuredCalibration& measured,
                                     const compensation::TargetSettings& settings, Progress& progress) {
  const compensation::MeasuredVenue& venue = measured.venue;
  compensation::Target target = compensation::fitTarget(image.linear, venue, settings);
  compensation::Compensator compensator(venue, measured.inverse);
  const Rasters& cameras = venue.transport.cameras();
  auto seen = [&](const ProjectorStack& picture) {
    CameraStack light = venue.transport.apply(picture);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += venue.black[i];
    return underEvenWhite(light, target, cameras, 0);
  };
  const ProjectorStack warped = compensator.solve(compensation::Method::none, target, progress).projector,
                       refined = compensator.solve(compensation::Method::refined, target, progress).projector;
  const compensation::ExpectedError expected =
      expectedError(venue, measured.acquisition.variance, target, refined);
  std::size_t pixels = cameras.size(0).count();
  CameraMask inside(target.inside.begin(), target.inside.begin() + static_cast<std::ptrdiff_t>(pixels));
  double covered = 0.0;
  double reachable = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    covered += target.inside[i];
    reachable += target.reachable[i];
  }
  return {image.name,
          compensation::Method::refined,
          underEvenWhite(target.wanted, target, cameras, 0),
          seen(warped),
          seen(refined),
          target.white,
          std::move(inside),
          covered > 0.0 ? reachable / covered : 0.0,
          false,
          expected.isKnown() ? std::optional(expected.shareIn(0, cameras)) : std::nullopt,
          compensation::unreachableShares(venue, target)};
}

/// Mean of a map of CIEDE2000, where there is content.
double meanDeltaE(const fs::path& map) {
  image::Image values = image::readExr(map).pixels;
  double sum = 0.0, count = 0.0;
  for (float value : values.data())
    if (!std::isnan(value)) {
      sum += static_cast<double>(value);
      count += 1.0;
    }
  return count > 0.0 ? sum / count : 0.0;
}

/// How the photograph was judged; what nobody kept is left open, as is what is of something else than is
/// shown now.
void addJudgement(ReportVerification& verification, const fs::path& folder,
                  const calibration::CalibrationFolder& calibration,
                  const calibration::StageResult& acquired) {
  const std::optional<pipeline::ProofRecord> record = pipeline::loadProofRecord(folder);
  if (!record) return;
  verification.taken = record->taken;
  const bool isOwn = record->picture.starts_with(':');  // the wizard's
  if (!isOwn) verification.picture = fs::path(record->picture).filename().string();
  verification.isOutOfDate =
      record->measurement != acquired.stored || !pipeline::isOfShown(*record, calibration);
  if (verification.isOutOfDate) return;
  verification.deltaEPredicted = record->figures.after.predicted.deltaE;
  verification.isAsPredicted = pipeline::isAsPredicted(record->figures);
  verification.viewThatDiffers = pipeline::viewThatDiffers(record->figures);
  const std::size_t known = std::min(verification.others.size(), record->figures.others.size());
  for (std::size_t other = 0; other < known; ++other)
    verification.others[other].deltaEPredicted = record->figures.others[other].after.predicted.deltaE;
}

/// What proveCalibration() left in the calibration, unless something is missing; of versions that kept no
/// record, only what is younger than the light transport.
std::optional<ReportVerification> verificationIn(const calibration::CalibrationFolder& calibration,
                                                 const calibration::StageResult& acquired,
                                                 std::size_t cameras) {
  fs::path folder = calibration.path() / "verification", photograph = folder / "after.png";
  std::error_code missing;
  fs::file_time_type taken = fs::last_write_time(photograph, missing);
  if (missing) return std::nullopt;
  try {
    if (!pipeline::loadProofRecord(folder) &&
        taken < fs::last_write_time(calibration::fileOf(acquired, "transport.npz"), missing))
      return std::nullopt;
    auto read = [&](const char* name) { return image::readPicture(folder / name).encoded; };
    ReportVerification verification{read("target.png"),
                                    read("before.png"),
                                    read("after.png"),
                                    meanDeltaE(folder / "before_delta_e.exr"),
                                    meanDeltaE(folder / "after_delta_e.exr"),
                                    utcText(std::chrono::time_point_cast<std::chrono::system_clock::duration>(
                                        std::chrono::file_clock::to_sys(taken)))};
    for (std::size_t camera = 1; camera < cameras; ++camera) {
      const auto file = [&](const char* name, const char* end) {
        return pipeline::proofPicture(folder, name, camera, end);
      };
      // Versions that proved the first view only left none of the others.
      if (!fs::exists(file("after", ".png"))) break;
      const auto picture = [&](const char* name) { return image::readPicture(file(name, ".png")).encoded; };
      verification.others.push_back({picture("target"), picture("before"), picture("after"),
                                     meanDeltaE(file("before", "_delta_e.exr")),
                                     meanDeltaE(file("after", "_delta_e.exr")), std::nullopt});
    }
    addJudgement(verification, folder, calibration, acquired);
    return verification;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The last check for drift of this measurement, unless a photograph has answered it since.
std::optional<ReportDrift> driftIn(const calibration::CalibrationFolder& calibration,
                                   const calibration::StageResult& acquired) {
  try {
    const fs::path folder = calibration.path() / "verification";
    const auto record = pipeline::loadDriftRecord(folder);
    if (!record || record->measurement != acquired.stored) return std::nullopt;
    const auto proof = pipeline::loadProofRecord(folder);
    if (proof && pipeline::answers(*proof, pipeline::isOfShown(*proof, calibration), *record))
      return std::nullopt;
    return ReportDrift{record->verdict, record->error, record->errorThen, record->changedShare,
                       record->checked};
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// As they are shown now.
std::vector<ReportPerfected> perfectedIn(const calibration::CalibrationFolder& folder) {
  std::vector<ReportPerfected> perfected;
  for (const pipeline::PerfectedPicture& picture : pipeline::allPerfected(folder.path()))
    if (!pipeline::isOutOfDate(picture, folder))
      perfected.push_back(
          {fs::path(picture.picture).filename().string(), picture.perfected, picture.figures});
  return perfected;
}

/// The last two weeks; none where the history cannot be read.
std::vector<pipeline::NightRecord> lastNights(const fs::path& calibration) {
  constexpr std::ptrdiff_t most = 14;
  try {
    std::vector<pipeline::NightRecord> nights = pipeline::nightsOf(calibration);
    if (std::ssize(nights) > most) nights.erase(nights.begin(), nights.end() - most);
    return nights;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

pipeline::WrittenFiles makeReport(const fs::path& path, const ReportSettings& settings, const fs::path& cache,
                                  Progress& progress) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  Progress loading =
      progress.part(0.3, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  pipeline::MeasuredCalibration measured = pipeline::loadCalibration(folder, loading);
  const transport::TransportMatrix& transport = measured.venue.transport;

  ReportData data;
  data.title = fs::weakly_canonical(folder.path()).filename().string();
  data.venue = venueSentence(measured.rig);
  data.isSimulated = std::holds_alternative<venue::VenueSettings>(measured.rig);
  data.software = folder.software();
  data.measured = folder.created();  // where nobody knows better
  data.projector = transport.projectors().size(0);
  data.camera = transport.cameras().size(0);
  data.projectors = transport.projectors().devices();
  data.cameras = transport.cameras().devices();
  data.result = pipeline::summaryOf(folder, measured);
  if (const auto linearized = calibration::resultOf(folder, calibration::Stage::linearization))
    if (const auto cost = calibration::resultFrom<calibration::Stage::linearization>(*linearized).cost)
      data.linearizationPatterns = cost->patterns;
  data.responses = measured.linearization.projectors;
  data.additivityError = measured.linearization.additivityError;
  data.exposures = measured.linearization.exposures;
  data.flood = image::imageFromStack(measured.venue.flood, transport.cameras(), 0);
  data.black = image::imageFromStack(measured.venue.black, transport.cameras(), 0);
  data.flagged.assign(
      measured.acquisition.flagged.begin(),
      measured.acquisition.flagged.begin() + static_cast<std::ptrdiff_t>(data.flood.pixels()));
  data.leavesPerLevel = leavesPerLevel(transport);
  data.ridge = measured.ridge;
  data.ridgeCurve = measured.ridgeCurve;
  data.settings = settingsInWords(pipeline::settingsOf(folder));
  data.libraries = settings.libraries.empty() ? pipeline::coreLibraries() : settings.libraries;
  if (auto acquired = calibration::resultOf(folder, calibration::Stage::acquisition)) {
    data.measured = acquired->stored;
    const auto found = calibration::resultFrom<calibration::Stage::acquisition>(*acquired);
    data.stoppedAt = found.stoppedAt;
    if (const auto& repair = found.repair)
      data.repaired = {acquired->stored, repair->what, repair->deltaEBefore, repair->deltaEAfter,
                       repair->cost};
    data.verification = verificationIn(folder, *acquired, transport.cameras().devices());
    data.drift = driftIn(folder, *acquired);
  }

  data.perfected = perfectedIn(folder);
  data.nights = lastNights(folder.path());

  // As the calibration's own content is shown: by its objective, brightness, clipping, views and masks.
  const compensation::TargetSettings target = targetOf(pipeline::settingsOf(folder).content);
  Progress comparing = progress.part(0.6, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
  if (settings.evaluate && std::holds_alternative<venue::VenueSettings>(measured.rig)) {
    pipeline::EvaluateSettings evaluation;
    evaluation.images = settings.images;
    evaluation.fewImages = true;  // whose pictures are on the page
    evaluation.target = target;
    pipeline::Evaluation judged = pipeline::evaluated(measured, evaluation, cache, comparing);
    for (const pipeline::EvaluatedPictures& pictures : judged.pictures)
      data.comparisons.push_back(comparisonOf(pictures));
    data.evaluation = std::move(judged.result);
  } else {
    std::vector<pipeline::NamedImage> content;
    for (const fs::path& image : settings.images)
      content.push_back({image.stem().string(), image::readLinearContent(image)});
    if (content.empty()) content = pipeline::standardImages();
    for (const pipeline::NamedImage& image : content)
      data.comparisons.push_back(predictedComparison(image, measured, target, comparing));
  }

  fs::path out = settings.out.empty() ? folder.path() / "report.html" : settings.out;
  writeReport(out, data);
  std::vector<fs::path> files{out};
  if (!settings.bundle.empty()) {
    writeSupportBundle(folder.path(), data, settings);
    files.push_back(settings.bundle);
  }
  progress.report(1.0);
  return {files};
}

}  // namespace relucent::report
