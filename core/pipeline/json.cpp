// SPDX-License-Identifier: MIT
#include "relucent/pipeline/json.h"

#include <map>

#include "relucent/base/message.h"
#include "relucent/pipeline/picture_error_json.h"

namespace relucent::pipeline {
namespace {

calibration::Json sentencesOf(const std::vector<Message>& messages) {
  calibration::Json list = calibration::Json::array();
  for (const Message& message : messages) list.push_back(english(message));
  return list;
}

calibration::Json sizeToJson(Size size) {
  return {size.width, size.height};
}

calibration::Json pathsToJson(const std::vector<std::filesystem::path>& paths) {
  calibration::Json json = calibration::Json::array();
  for (const std::filesystem::path& path : paths) json.push_back(path.string());
  return json;
}

calibration::Json methodToJson(const MethodScore& score) {
  return {{"psnr_reachable", score.psnrReachable},
          {"psnr_all", score.psnrAll},
          {"psnr_encoded_reachable", score.encodedPsnrReachable},
          {"psnr_encoded_all", score.encodedPsnrAll},
          {"ssim", score.ssim},
          {"ms_ssim", score.multiScaleSsim},
          {"delta_e", score.deltaE},
          {"delta_e_reachable", score.deltaEReachable},
          {"delta_e_p95", score.deltaEPercentile},
          {"seconds", score.seconds}};
}

calibration::Json methodsToJson(const std::vector<MethodScore>& scores) {
  calibration::Json methods = calibration::Json::object();
  for (const MethodScore& score : scores) methods[std::string(nameOf(score.method))] = methodToJson(score);
  return methods;
}

/// Of what projectors make of it without each other.  `Score`: of a view, or of an image in the first one.
template <typename Score>
void addApart(const Score& score, calibration::Json& json) {
  if (score.blended) json["blended"] = methodToJson(*score.blended);
  for (const AloneScore& alone : score.alone) {
    calibration::Json projector{{"reachable", alone.reachable}};
    if (alone.optimum) projector["optimum"] = methodToJson(*alone.optimum);
    json["alone"].push_back(std::move(projector));
  }
}

/// Nothing where nobody asked for them.
void addRivals(calibration::Json& json, const std::vector<RivalScore>& rivals) {
  for (const RivalScore& rival : rivals) {
    calibration::Json& entry = json["rivals"][std::string(nameOf(rival.rival))] = methodToJson(rival.score);
    entry["photographs"] = rival.photographs;
  }
}

/// Likewise.
void addPerfected(calibration::Json& json, const std::vector<MethodScore>& rounds) {
  for (const MethodScore& score : rounds) json["perfected"].push_back(methodToJson(score));
}

calibration::Json viewToJson(const ViewScore& view) {
  calibration::Json json{{"reachable", view.reachable}, {"methods", methodsToJson(view.methods)}};
  addApart(view, json);
  addRivals(json, view.rivals);
  addPerfected(json, view.perfected);
  return json;
}

calibration::Json seamsToJson(const std::vector<SeamScore>& scores) {
  const auto toJson = [](const compensation::Seams& seams) {
    return calibration::Json{{"mean", seams.mean},
                             {"p95", seams.p95},
                             {"elsewhere", seams.elsewhere},
                             {"elsewhere_p95", seams.elsewhereP95},
                             {"edge_p95", seams.edgeP95}};
  };
  calibration::Json list = calibration::Json::array();
  for (const SeamScore& score : scores)
    list.push_back({{"grey", score.grey},
                    {"method", nameOf(score.method)},
                    {"joint", toJson(score.joint)},
                    {"blended", toJson(score.blended)},
                    {"roomy", toJson(score.roomy)}});
  return list;
}

calibration::Json contradictionToJson(const ContradictionShares& contradiction) {
  return {{"share", contradiction.share}, {"views", contradiction.views}};
}

calibration::Json scoreToJson(const ImageScore& image) {
  calibration::Json json{
      {"name", image.name}, {"reachable", image.reachable}, {"methods", methodsToJson(image.methods)}};
  for (const ViewScore& view : image.others) json["other_views"].push_back(viewToJson(view));
  for (const ViewScore& view : image.unseen) json["unseen_places"].push_back(viewToJson(view));
  addApart(image, json);
  addRivals(json, image.rivals);
  addPerfected(json, image.perfected);
  if (image.contradiction) json["contradiction"] = contradictionToJson(*image.contradiction);
  if (image.asExpected) json["as_expected"] = *image.asExpected;
  if (image.masked)
    json["masks"] = {{"method", nameOf(image.masked->method)},
                     {"light", image.masked->light},
                     {"direct", image.masked->direct},
                     {"psnr", image.masked->psnr},
                     {"psnr_without", image.masked->psnrWithout},
                     {"white", image.masked->white}};
  return json;
}

calibration::Json sharesToJson(const std::map<compensation::Uncorrectable, double>& shares) {
  std::map<std::string_view, double> byName;  // documents list them in the order of the alphabet
  for (const auto& [reason, share] : shares) byName.emplace(nameOf(reason), share);
  calibration::Json json = calibration::Json::object();
  for (const auto& [name, share] : byName) json[std::string(name)] = share;
  return json;
}

calibration::Json clustersToJson(double seconds, const clustering::ClusteringStatistics& clusters) {
  return {{"seconds", seconds},
          {"connections", clusters.connections},
          {"kept", clusters.kept},
          {"largest", clusters.largest},
          {"median", clusters.medianUnknowns},
          {"lit_projector_pixels", clusters.litProjectorPixels},
          {"percolated", clusters.percolated},
          {"error_median", clusters.errorMedian},
          {"error_p95", clusters.errorP95}};
}

calibration::Json transportToJson(const TransportScore& score) {
  return {{"frobenius", score.frobenius},
          {"row_median", score.rowMedian},
          {"row_p95", score.rowP95},
          {"relight_natural", score.relightNatural},
          {"relight_random", score.relightRandom},
          {"energy", score.energy}};
}

}  // namespace

calibration::Json toJson(const CalibrateResult& result) {
  return {{"patterns", result.patterns},
          {"exposures", result.exposures},
          {"seconds",
           {{"linearization", result.seconds.linearization},
            {"acquisition", result.seconds.acquisition},
            {"inverse", result.seconds.inverse}}},
          {"connections", result.connections},
          {"leaves", result.leaves},
          {"unresolved_energy", result.unresolvedEnergy},
          {"flagged_share", result.flaggedShare},
          {"verification_error", result.verificationError},
          {"peak_memory_bytes", result.peakMemoryBytes},
          {"findings", sentencesOf(result.findings)}};
}

calibration::Json toJson(const VerifyResult& result) {
  calibration::Json errors = calibration::Json::object();
  for (int size = 0; size < acquisition::verificationSizes; ++size)
    errors[std::to_string(1 << size)] = result.found.errorOf[static_cast<std::size_t>(size)];
  return {{"verdict", toString(result.judgement.verdict)},
          {"sentence", english(result.judgement.sentence)},
          {"error", result.found.error},
          {"error_then", result.errorThen},
          {"error_by_block", errors},
          {"error_without_lamp", result.found.adapted},
          {"changed_share", result.found.changedShare},
          {"lamp", result.found.lamp},
          {"ambient", result.found.ambient},
          {"patterns", result.found.patterns},
          {"exposures", result.found.exposures},
          {"seconds", result.seconds},
          {"files", pathsToJson(result.files)}};
}

calibration::Json toJson(const RepairResult& result) {
  const auto movements = [](const std::vector<sentinels::Movement>& all) {
    calibration::Json json = calibration::Json::array();
    for (const sentinels::Movement& of : all)
      json.push_back({{"x", of.x}, {"y", of.y}, {"degrees", of.degrees}});
    return json;
  };
  calibration::Json light = calibration::Json::array();
  for (const transport::ColourBlock& of : result.change.light) {
    calibration::Json rows = calibration::Json::array();
    for (Eigen::Index row = 0; row < 3; ++row) rows.push_back({of(row, 0), of(row, 1), of(row, 2)});
    light.push_back(std::move(rows));
  }
  return {{"outcome", nameOf(result.end)},
          {"what", sentencesOf(result.what)},
          {"moved", movements(result.change.moved)},
          {"pictures_moved", movements(result.change.pictures)},
          {"light_left", light},
          {"ambient", result.change.ambient},
          {"wrong_share", result.change.wrong},
          {"scaled_share", result.change.scaled},
          {"unknown_share", result.change.unknown},
          {"measured_share", result.measured},
          {"error_then", result.errorThen},
          {"error_before", result.errorBefore},
          {"error_adapted", result.errorAdapted},
          {"error_after", result.errorAfter},
          {"before", result.before},
          {"after", result.after},
          {"exposures", result.exposures},
          {"seconds", result.seconds},
          {"photographing_seconds", result.photographing}};
}

calibration::Json toJson(const NightRecord& night) {
  const auto sentenceOf = [](const Message& sentence) {
    return sentence.empty() ? calibration::Json() : calibration::Json(english(sentence));
  };
  const auto errorOf = [](const std::optional<PictureError>& error) {
    return error ? calibration::Json(*error) : calibration::Json();
  };
  return {{"when", night.when},
          {"repair", night.repair ? calibration::Json(nameOf(*night.repair)) : calibration::Json()},
          {"what", sentencesOf(night.what)},
          {"perfected", night.perfected},
          {"measured", errorOf(night.measured)},
          {"predicted", errorOf(night.predicted)},
          {"of_perfected", night.ofPerfected},
          {"alarm", sentenceOf(night.alarm)},
          {"told", night.told},
          {"untold", sentenceOf(night.untold)},
          {"skipped", sentenceOf(night.skipped)},
          {"seconds", night.seconds}};
}

calibration::Json toJson(const std::vector<NightRecord>& nights) {
  calibration::Json list = calibration::Json::array();
  for (const NightRecord& night : nights) list.push_back(toJson(night));
  return {{"nights", std::move(list)}};
}

calibration::Json toJson(const UndoneRepair& result) {
  return {{"measurement", result.stored}};
}

calibration::Json toJson(const ProveResult& result) {
  auto projection = [](const ProvedProjection& proved) {
    return calibration::Json{{"psnr_predicted", proved.predicted.psnr},
                             {"psnr_measured", proved.measured.psnr},
                             {"delta_e_predicted", proved.predicted.deltaE},
                             {"delta_e_measured", proved.measured.deltaE},
                             {"surprise", proved.surprise},
                             {"worst_patch", proved.worstPatch},
                             {"worst_place", proved.worstPlace}};
  };
  auto movement = [](const sentinels::Movement& moved) {
    return calibration::Json{
        {"x", moved.x}, {"y", moved.y}, {"degrees", moved.degrees}, {"explains", moved.explains}};
  };
  calibration::Json json{{"method", nameOf(result.method)},   {"before", projection(result.before)},
                         {"after", projection(result.after)}, {"reachable", result.reachable},
                         {"moved", movement(result.moved)},   {"exposures", result.exposures},
                         {"seconds", result.seconds},         {"files", pathsToJson(result.files)}};
  for (const ProvedView& view : result.others)
    json["other_views"].push_back({{"before", projection(view.before)},
                                   {"after", projection(view.after)},
                                   {"reachable", view.reachable},
                                   {"moved", movement(view.moved)}});
  return json;
}

calibration::Json toJson(const PerfectResult& result) {
  const auto round = [](const PerfectingRound& seen) {
    calibration::Json json{{"error", seen.error.value},
                           {"error_deviation", seen.error.deviation},
                           {"surprise", seen.surprise},
                           {"views", calibration::Json::array()}};
    for (const PictureError& view : seen.views) json["views"].push_back(view);
    return json;
  };
  calibration::Json images = calibration::Json::array();
  for (const PerfectedImage& image : result.images) {
    calibration::Json& json = images.emplace_back(calibration::Json{{"image", image.image.string()}});
    if (!image.failure.empty()) {
      json["failure"] = sentencesOf({image.failure}).front();
      continue;
    }
    json["end"] = nameOf(image.end);
    json["kept"] = image.kept;
    json["went_on"] = image.wentOn;
    json["photographs"] = image.photographs;
    json["files"] = pathsToJson(image.files);
    json["rounds"] = calibration::Json::array();
    for (const PerfectingRound& seen : image.rounds) json["rounds"].push_back(round(seen));
    if (image.end == PerfectingEnd::disturbed) {
      json["disturbance"] = sentencesOf({image.disturbance}).front();
    } else {
      json["before"] = round(image.before);
      json["after"] = round(image.after);
    }
  }
  return {{"images", images}, {"exposures", result.exposures}, {"seconds", result.seconds}};
}

calibration::Json toJson(const ForgottenPictures& result) {
  return {{"forgotten", result.pictures}};
}

calibration::Json toJson(const CompensateResult& result) {
  calibration::Json json{
      {"method", nameOf(result.method)}, {"psnr_predicted", result.psnrPredicted},
      {"delta_e", result.deltaE},        {"clipped", result.clipped},
      {"reachable", result.reachable},   {"uncorrectable", sharesToJson(result.uncorrectable)},
      {"seconds", result.seconds},       {"files", pathsToJson(result.files)}};
  if (result.contradiction) json["contradiction"] = contradictionToJson(*result.contradiction);
  if (result.expectedError) json["expected_error"] = *result.expectedError;
  if (!result.notes.empty()) json["notes"] = sentencesOf(result.notes);
  return json;
}

calibration::Json toJson(const EvaluateResult& result) {
  calibration::Json images = calibration::Json::array();
  for (const ImageScore& image : result.images) images.push_back(scoreToJson(image));
  calibration::Json json{{"venue", result.venue},
                         {"projector", sizeToJson(result.projector)},
                         {"camera", sizeToJson(result.camera)},
                         {"reachable", result.reachable},
                         {"transport", transportToJson(result.transport)},
                         {"images", std::move(images)}};
  if (!result.seams.empty()) json["seams"] = seamsToJson(result.seams);
  if (result.blackSteps)
    json["black_steps"] = {{"lift", result.blackSteps->lift},
                           {"p95", result.blackSteps->p95},
                           {"least_lift", result.blackSteps->leastLift}};
  for (const WalkFrame& frame : result.walk)
    json["walk"].push_back({{"viewer", frame.viewer},
                            {"weights", frame.weights},
                            {"psnr", frame.psnr},
                            {"unseen", frame.unseen}});
  return json;
}

calibration::Json toJson(const WrittenFiles& result) {
  return {{"files", pathsToJson(result.files)}, {"notes", sentencesOf(result.notes)}};
}

calibration::Json toJson(const SeparateResult& result) {
  return {{"direct_share", result.directShare}, {"files", pathsToJson(result.files)}};
}

calibration::Json toJson(const DifferenceResult& result) {
  return {{"rms", result.rms},
          {"relative", result.relative},
          {"gain", result.gain},
          {"files", pathsToJson(result.files)}};
}

calibration::Json toJson(const InverseBenchResult& result) {
  const PaperFigures paper;
  calibration::Json list = calibration::Json::array();
  for (const VenueInversion& venue : result.venues) {
    calibration::Json quality = calibration::Json::object();
    for (const auto& [method, decibels] : venue.quality) quality[std::string(nameOf(method))] = decibels;
    list.push_back(
        {{"venue", venue.venue},
         {"leaves", venue.leaves},
         {"windows", {{"seconds", venue.windowSeconds}, {"ridge", venue.ridge}}},
         {"algorithm1", clustersToJson(venue.clusterSeconds, venue.printed)},
         {"capped", clustersToJson(venue.cappedSeconds, venue.capped)},
         {"inverse_seconds",
          {{"truncated_svd", venue.truncatedSeconds},
           {"ridge", venue.ridgeSeconds},
           {"ridge_full_colour", venue.fullColourSeconds}}},
         {"psnr_reachable", std::move(quality)},
         {"psnr_clusters",
          {{"truncated_svd", venue.truncatedQuality}, {"ridge_full_colour", venue.fullColourQuality}}}});
  }
  return {{"paper",
           {{"inversion_seconds", {paper.leastInversionSeconds, paper.mostInversionSeconds}},
            {"error", {paper.leastError, paper.mostError}},
            {"frames_per_second", {paper.leastFrameRate, paper.mostFrameRate}}}},
          {"venues", std::move(list)}};
}

calibration::Json toJson(const AcquisitionBenchResult& result) {
  calibration::Json runs = calibration::Json::array();
  for (const AcquisitionBenchRun& run : result.runs)
    runs.push_back({{"venue", run.venue},
                    {"mode", nameOf(run.mode)},
                    {"threshold", run.threshold},
                    {"patterns", run.patterns},
                    {"colours", nameOf(run.colours)},
                    {"exposures", run.exposures},
                    {"linearization_exposures", run.linearization},
                    {"windows", run.windows},
                    {"refined", run.refined},
                    {"seconds", run.seconds},
                    {"unresolved_energy", run.unresolvedEnergy},
                    {"transport", transportToJson(run.transport)}});
  calibration::Json stops = calibration::Json::array();
  for (const AcquisitionBenchStop& stop : result.stops)
    stops.push_back({{"venue", stop.venue},
                     {"threshold", stop.threshold},
                     {"blocks", stop.blocks},
                     {"patterns", stop.patterns},
                     {"expected_now", stop.expected.now},
                     {"expected_whole", stop.expected.whole},
                     {"expected_photographs", stop.expected.photographs},
                     {"refined", stop.refined}});
  return {{"projector", sizeToJson(result.projector)},
          {"camera", sizeToJson(result.camera)},
          {"runs", std::move(runs)},
          {"stops", std::move(stops)}};
}

calibration::Json toJson(const ScaleBenchResult& result) {
  calibration::Json runs = calibration::Json::array();
  for (const ScaleBenchRun& run : result.runs) {
    calibration::Json stages = calibration::Json::object();
    for (const ScaleStage& stage : run.stages)
      stages[stage.name] = {{"seconds", stage.seconds},
                            {"processor_seconds", stage.processorSeconds},
                            {"memory_bytes", stage.memoryBytes},
                            {"mapped_files_bytes", stage.filesBytes}};
    runs.push_back({{"projector", sizeToJson(run.sizes.projector)},
                    {"camera", sizeToJson(run.sizes.camera)},
                    {"camera_used", sizeToJson(run.used)},
                    {"exposures", run.exposures},
                    {"leaves", run.leaves},
                    {"forecast_memory_bytes", run.forecastBytes},
                    {"photograph_bytes", run.photographBytes},
                    {"result_bytes", run.resultBytes},
                    {"seconds_to_still", run.secondsToStill},
                    {"stages", std::move(stages)},
                    {"windows", run.windows},
                    {"refined", run.refined}});
  }
  calibration::Json growth = calibration::Json::array();
  for (std::size_t i = 1; i < result.runs.size(); ++i)
    growth.push_back(growthOf(result.runs[i - 1], result.runs[i]));
  return {{"venue", result.venue}, {"runs", std::move(runs)}, {"growth_of_seconds", std::move(growth)}};
}

calibration::Json toJson(const TidyResult& result) {
  const auto share = [](const DiskShare& of) {
    return calibration::Json{{"files", of.files}, {"bytes", of.bytes}};
  };
  calibration::Json calibrations = calibration::Json::array();
  std::uint64_t freed = 0;
  for (const TidiedCalibration& tidied : result.calibrations) {
    freed += tidied.freed();
    calibrations.push_back({{"folder", tidied.folder.string()},
                            {"complete", tidied.isComplete},
                            {"freed", tidied.freed()},
                            {"photographs", share(tidied.photographs)},
                            {"results", share(tidied.results)},
                            {"leftovers", share(tidied.leftovers)},
                            {"perfected", share(tidied.perfected)},
                            {"compressed", share(tidied.compressed)},
                            {"kept", share(tidied.kept)}});
  }
  return {{"calibrations", std::move(calibrations)}, {"freed", freed}, {"dry_run", result.dryRun}};
}

calibration::Json toJson(const BenchResult& result) {
  calibration::Json benchmarks = calibration::Json::array();
  for (const Benchmark& benchmark : result.benchmarks) {
    calibration::Json& line =
        benchmarks.emplace_back(calibration::Json{{"name", benchmark.name},
                                                  {"seconds", benchmark.seconds},
                                                  {"bytes", benchmark.bytes},
                                                  {"share_of_copy", benchmark.shareOfCopy}});
    if (benchmark.best > 0.0) line["best"] = benchmark.best;
    for (const engine::EngineBenchRatio& ratio : benchmark.timesAsFastAs)
      line["times_as_fast_as"][ratio.reference] = ratio.times;
  }
  calibration::Json machine{{"processor", result.machine.processor},
                            {"threads", result.machine.threads},
                            {"copy_bytes_per_second", result.machine.copyBytesPerSecond}};
  if (!result.machine.device.empty()) machine["device"] = result.machine.device;
  calibration::Json document{{"machine", std::move(machine)}, {"benchmarks", std::move(benchmarks)}};
  if (!result.notes.empty()) document["notes"] = sentencesOf(result.notes);
  return document;
}

calibration::Json toJson(const ImportResult& result) {
  return {{"patterns", result.patterns},
          {"fitted", result.fitted},
          {"held_out", result.heldOut},
          {"nrmse",
           {{"one_to_one", result.error.oneToOne},
            {"mix", result.error.mix},
            {"transport", result.error.transport}}},
          {"projector", sizeToJson(result.projector)},
          {"camera", sizeToJson(result.camera)},
          {"leaves", result.leaves},
          {"flagged_share", result.flaggedShare},
          {"seconds", result.seconds},
          {"peak_memory_bytes", result.peakMemoryBytes},
          {"findings", sentencesOf(result.findings)}};
}

calibration::Json toJson(const std::vector<venue::VenueDescription>& venues) {
  calibration::Json list = calibration::Json::array();
  for (const venue::VenueDescription& venue : venues)
    list.push_back({{"name", venue.name},
                    {"sentence", venue.sentence},
                    {"projectors", venue.projectors},
                    {"cameras", venue.cameras}});
  return {{"venues", std::move(list)}};
}

}  // namespace relucent::pipeline
