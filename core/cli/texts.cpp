// SPDX-License-Identifier: MIT
#include "relucent/cli/texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "relucent/base/message.h"
#include "relucent/cli/terminal_progress.h"

namespace relucent::cli {
namespace {

std::string lines(const std::vector<Message>& sentences) {
  std::string text;
  for (const Message& sentence : sentences) text += englishSentence(sentence) + "\n";
  return text;
}

/// Percent of a share to one decimal, and never "-0.0".
double percentOf(double share) {
  return std::round(1000.0 * share) / 10.0 + 0.0;
}

}  // namespace

std::string textOf(const pipeline::CalibrateResult& result) {
  double seconds = result.seconds.linearization + result.seconds.acquisition + result.seconds.inverse;
  return fmt::format(
             "Calibrated with {} patterns and {} photographs in {:.0f} s.\n"
             "{} connections of light in {} leaves; {:.1f} % of the light is unresolved, {:.1f} % of the "
             "camera's "
             "pixels are flagged.\n",
             result.patterns, result.exposures, seconds, result.connections, result.leaves,
             percentOf(result.unresolvedEnergy), percentOf(result.flaggedShare)) +
         lines(result.findings);
}

std::string textOf(const pipeline::WrittenFiles& result) {
  std::string text;
  for (const std::filesystem::path& file : result.files) text += "Wrote " + file.string() + "\n";
  for (const Message& note : result.notes) text += fmt::format("Note: {}.\n", note);
  return text;
}

std::string textOf(const pipeline::VerifyResult& result) {
  const acquisition::Reverification& found = result.found;
  std::string text = fmt::format("{}\nError by size of the pattern's blocks:", result.judgement.sentence);
  for (std::size_t size = 0; size < found.errorOf.size(); ++size)
    text += fmt::format("{} {} {:.1f} %", size == 0 ? "" : ",", 1 << size, 100.0 * found.errorOf[size]);
  text += fmt::format(
      ".\nThe lamp gives {:.1f} % of its light; the room's light changed by {:+.2f} % of the flood image; "
      "{} photographs in {:.0f} s.\n",
      100.0 * found.lamp, 100.0 * found.ambient, found.exposures, result.seconds);
  return text + textOf(pipeline::WrittenFiles{result.files});
}

namespace {

std::string figuresOf(const std::vector<pipeline::PictureError>& views) {
  std::string text;
  for (const pipeline::PictureError& view : views)
    text += fmt::format("{}{:.2f} ({:.1f} dB)", text.empty() ? "" : ", ", view.deltaE, view.psnr);
  return text;
}

std::string outcomeOf(const pipeline::RepairResult& result) {
  switch (result.end) {
    case pipeline::RepairEnd::nothingToDo:
      return "The venue is as it was measured: nothing to repair.\n";
    case pipeline::RepairEnd::repaired:
      return "Repaired: from now on the calibration is used as it is now; --undo goes back.\n";
    case pipeline::RepairEnd::notBetter:
      return "Not repaired: no better picture came of it, and the calibration is as it was. If the picture "
             "is "
             "not good enough, measure the light transport again.\n";
  }
  return {};
}

}  // namespace

std::string textOf(const pipeline::RepairResult& result) {
  std::string text = outcomeOf(result);
  for (const Message& what : result.what) text += fmt::format("  {}\n", what);
  text += fmt::format("Error of test patterns: {:.1f} % -> {:.1f} % ({:.1f} % when it was measured); {}.\n",
                      100.0 * result.errorBefore, 100.0 * result.errorAfter, 100.0 * result.errorThen,
                      result.measured > 0.0 ? fmt::format("{:.1f} % of the camera pixels were measured again",
                                                          100.0 * result.measured)
                                            : "no camera pixel had to be measured again");
  if (!result.after.empty())
    text += fmt::format("Colour error of a picture: {} -> {}.\n", figuresOf(result.before),
                        figuresOf(result.after));
  return text + fmt::format("{} photographs; {:.0f} s, of which the devices took {:.0f} s.\n",
                            result.exposures, result.seconds, result.photographing);
}

std::string textOf(const pipeline::NightRecord& night) {
  if (!night.skipped.empty()) return fmt::format("{}  skipped: {}\n", night.when, night.skipped);
  std::string text = fmt::format(
      "{}  {}", night.when, night.repair ? descriptionOf(*night.repair) : "what has changed is not known");
  if (night.measured)
    text += fmt::format("; colour error {:.2f} ({:.1f} dB), predicted {:.2f}{}", night.measured->deltaE,
                        night.measured->psnr, night.predicted->deltaE,
                        night.ofPerfected ? ", of a perfected picture" : "");
  if (night.perfected > 0)
    text += fmt::format("; {} {} perfected", night.perfected, night.perfected == 1 ? "picture" : "pictures");
  text += fmt::format("; {:.0f} s\n", night.seconds);
  for (const Message& what : night.what) text += fmt::format("  {}\n", what);
  if (!night.alarm.empty()) text += fmt::format("  Alarm: {}.\n", night.alarm);
  if (!night.untold.empty()) text += fmt::format("  Nobody was told of it: {}.\n", night.untold);
  return text;
}

std::string textOf(const std::vector<pipeline::NightRecord>& nights) {
  if (nights.empty()) return "There was no night yet.\n";
  std::string text;
  for (const pipeline::NightRecord& night : nights) text += textOf(night);
  return text;
}

std::string textOf(const pipeline::UndoneRepair& result) {
  return fmt::format("The measurement of {} is used again.\n", result.stored);
}

std::string textOf(const pipeline::ProveResult& result) {
  auto line = [](const char* name, const pipeline::ProvedProjection& proved) {
    return fmt::format(
        "{:<8} measured {:>5.1f} dB, colour error {:>4.1f}; predicted {:>5.1f} dB, {:>4.1f}; the photograph "
        "is "
        "{:.1f} % away from the prediction.\n",
        name, proved.measured.psnr, proved.measured.deltaE, proved.predicted.psnr, proved.predicted.deltaE,
        100.0 * proved.surprise);
  };
  const std::string moved =
      result.moved.explains && !pipeline::isAsPredicted(result)
          ? fmt::format(
                "The camera's view is shifted by {:.1f}, {:.1f} pixels and turned by {:.1f} degrees.\n",
                result.moved.x, result.moved.y, result.moved.degrees)
          : "";
  const auto patch = [](const pipeline::ProvedView& view) {
    return pipeline::changedPatch(view) > pipeline::plainPatch
               ? fmt::format(
                     "A part of the surface looks otherwise than predicted, by a colour error of {:.1f}: in "
                     "the camera's picture {:.0f} % from the left, {:.0f} % from the top.\n",
                     pipeline::changedPatch(view), 100.0 * pipeline::changedPlace(view)[0],
                     100.0 * pipeline::changedPlace(view)[1])
               : "";
  };
  std::string others;
  for (std::size_t other = 0; other < result.others.size(); ++other)
    others += fmt::format("Camera {}\n", other + 2) + line("Before:", result.others[other].before) +
              line("After:", result.others[other].after) + patch(result.others[other]);
  return (others.empty() ? "" : "Camera 1\n") + line("Before:", result.before) +
         line("After:", result.after) + moved + patch(viewOf(result, 0)) + others +
         fmt::format(
             "dB where it can be reached, which is {:.1f} % of the picture; colour error (CIEDE2000) over "
             "all of it; {} photographs in {:.0f} s.\n",
             100.0 * result.reachable, result.exposures, result.seconds) +
         textOf(pipeline::WrittenFiles{result.files});
}

namespace {

std::string figuresOf(const pipeline::PerfectingRound& round) {
  return figuresOf(round.views);
}

std::string linesOf(const pipeline::PerfectedImage& image) {
  const std::string name = image.image.string();
  if (!image.failure.empty()) return fmt::format("{}\n", image.failure);
  std::string text;
  for (std::size_t round = 0; round < image.rounds.size(); ++round)
    text += fmt::format("  photograph {}: colour error {}\n", round + 1, figuresOf(image.rounds[round]));
  if (image.end == pipeline::PerfectingEnd::disturbed)
    return fmt::format("{}: {}; the picture stays as it was.\n", name, image.disturbance) + text;
  if (!image.kept)
    return fmt::format("{}: no better picture was found; it stays as it was ({}).\n", name,
                       descriptionOf(image.end)) +
           text;
  return fmt::format("{}: colour error {} is now {}, after {} photographs ({}).\n", name,
                     figuresOf(image.before), figuresOf(image.after), image.photographs,
                     descriptionOf(image.end)) +
         text + textOf(pipeline::WrittenFiles{image.files});
}

}  // namespace

std::string textOf(const pipeline::PerfectResult& result) {
  std::string text;
  for (const pipeline::PerfectedImage& image : result.images) text += linesOf(image);
  return text + fmt::format(
                    "Colour error: mean CIEDE2000 over the content, camera after camera; dB where it can be "
                    "reached. {} photographs with all their exposures in {:.0f} s.\n",
                    result.exposures, result.seconds);
}

std::string textOf(const pipeline::ForgottenPictures& result) {
  if (result.pictures.empty()) return "None of these pictures was perfected.\n";
  std::string text;
  for (const std::string& picture : result.pictures) text += fmt::format("{} is shown as before.\n", picture);
  return text;
}

std::string textOf(const pipeline::ImportResult& result) {
  return fmt::format(
             "Imported {} photographs of a {}x{} projector in {:.0f} s; {} of them were not fitted but "
             "predicted.\n"
             "Error of the prediction, as a share of what varies: {:.1f} % by T, {:.1f} % by one colour mix "
             "a "
             "pixel, {:.1f} % by a one-to-one map.\n",
             result.patterns, result.projector.width, result.projector.height, result.seconds, result.heldOut,
             100.0 * result.error.transport, 100.0 * result.error.mix, 100.0 * result.error.oneToOne) +
         lines(result.findings);
}

std::string textOf(const pipeline::CompensateResult& result) {
  std::string text = fmt::format(
      "Predicted: {:.1f} dB where it can be reached, which is {:.1f} % of the picture; colour error {:.1f} "
      "(CIEDE2000) over all of it; {:.1f} % of the drive values are at their limits.\n",
      result.psnrPredicted, 100.0 * result.reachable, result.deltaE, 100.0 * result.clipped);
  std::map<std::string, double> shares;  // in the order of the alphabet
  for (const auto& [reason, share] : result.uncorrectable)
    if (share >= 0.0005) shares.emplace(nameOf(reason), share);
  for (const auto& [name, share] : shares) {
    std::string reason = name;
    std::replace(reason.begin(), reason.end(), '_', ' ');
    text += fmt::format("Cannot be corrected: {:.1f} % {}.\n", 100.0 * share, reason);
  }
  if (result.expectedError)
    text += fmt::format("Of what is seen 95 % should lie within {:.2f} % of white of this.\n",
                        100.0 * *result.expectedError);
  if (result.contradiction)
    text += fmt::format("Visibly worse because of other views: {:.1f} % of what the views ask for.\n",
                        100.0 * result.contradiction->share);
  return text + lines(result.notes) + textOf(pipeline::WrittenFiles{result.files});
}

namespace {

/// Of one view, an ImageScore or a ViewScore: the methods, below them projectors on their own, what others
/// do, and what photographs of the picture gained.
template <typename View>
std::string tableOf(const std::string& title, const View& view) {
  std::string text =
      fmt::format("\n{:<12} {:>14} {:>9} {:>10} {:>7} {:>8} {:>7} {:>9} {:>9}\n{:<12} {:>14} {:>9} {:>10}\n",
                  title, "reachable dB", "all dB", "encoded dB", "SSIM", "MS-SSIM", "dE2000", "dE 95 %",
                  "seconds", "", "linear", "linear", "all");
  const auto add = [&](std::string_view name, const pipeline::MethodScore& score) {
    text += fmt::format("{:<12} {:>14.2f} {:>9.2f} {:>10.2f} {:>7.3f} {:>8.3f} {:>7.2f} {:>9.2f} {:>9.4f}\n",
                        name, score.psnrReachable, score.psnrAll, score.encodedPsnrAll, score.ssim,
                        score.multiScaleSsim, score.deltaE, score.deltaEPercentile, score.seconds);
  };
  for (const pipeline::MethodScore& score : view.methods) add(nameOf(score.method), score);
  if (view.blended) add("blended", *view.blended);
  for (std::size_t k = 0; k < view.alone.size(); ++k)
    if (view.alone[k].optimum) add(fmt::format("{} alone", k + 1), *view.alone[k].optimum);
  for (const pipeline::RivalScore& rival : view.rivals) add(nameOf(rival.rival), rival.score);
  for (std::size_t k = 0; k < view.perfected.size(); ++k)
    add(k == 0 ? std::string("unperfected") : fmt::format("perfected {}", k), view.perfected[k]);
  for (std::size_t k = 0; k < view.alone.size(); ++k)
    text +=
        fmt::format("Projector {} alone reaches {:.1f} % of it.\n", k + 1, 100.0 * view.alone[k].reachable);
  return text;
}

}  // namespace

std::string textOf(const pipeline::EvaluateResult& result) {
  std::string text =
      fmt::format("{}: {:.1f} % of the pictures can be reached.\n", result.venue, 100.0 * result.reachable);
  for (const pipeline::ImageScore& image : result.images) {
    text += tableOf(image.name, image);
    for (std::size_t view = 0; view < image.others.size(); ++view)
      text += tableOf(fmt::format("camera {}", view + 2), image.others[view]);
    for (std::size_t place = 0; place < image.unseen.size(); ++place)
      text += tableOf(fmt::format("unseen {}", place + 1), image.unseen[place]);
    if (image.contradiction)
      text += fmt::format("Visibly worse because of other views: {:.1f} %.\n",
                          100.0 * image.contradiction->share);
    if (const std::optional<pipeline::MaskScore>& masked = image.masked)
      text += fmt::format(
          "Masks leave {:.1f} % of the light there, {:.1f} % of the direct; elsewhere {:.2f} dB, {:.2f} "
          "without them; "
          "white {:.2f} times as bright.\n",
          100.0 * masked->light, 100.0 * masked->direct, masked->psnr, masked->psnrWithout, masked->white);
    if (image.asExpected)
      text +=
          fmt::format("Within what the measurement expects of 95 %: {:.1f} %.\n", 100.0 * *image.asExpected);
  }
  for (const pipeline::SeamScore& seams : result.seams)
    text += fmt::format(
        "Seams at {:.0f} % grey: dE2000 {:.2f} with {}, {:.2f} blended; beside them {:.2f}, {:.2f}. 95 %: "
        "{:.2f}, "
        "{:.2f}; beside them {:.2f}, {:.2f}; of the edges alone {:.2f}, {:.2f}. 95 % "
        "where at most 70 % of all light is asked for: {:.2f}; of the edges alone {:.2f}.\n",
        100.0 * seams.grey, seams.joint.mean, nameOf(seams.method), seams.blended.mean, seams.joint.elsewhere,
        seams.blended.elsewhere, seams.joint.p95, seams.blended.p95, seams.joint.elsewhereP95,
        seams.blended.elsewhereP95, seams.joint.edgeP95, seams.blended.edgeP95, seams.roomy.p95,
        seams.roomy.edgeP95);
  if (result.blackSteps)
    text +=
        fmt::format("Edges of black: dE2000 {:.2f} (95 %) with a lift of {:.4f}; not seen from {:.4f} on.\n",
                    result.blackSteps->p95, result.blackSteps->lift, result.blackSteps->leastLift);
  for (const pipeline::WalkFrame& frame : result.walk) {
    text += fmt::format("Viewer at ({:.2f}, {:.2f}, {:.2f}): the views have {:.1f} dB", frame.viewer[0],
                        frame.viewer[1], frame.viewer[2], fmt::join(frame.psnr, ", "));
    if (!frame.unseen.empty()) text += fmt::format(", unseen places {:.1f}", fmt::join(frame.unseen, ", "));
    text += ".\n";
  }
  return text;
}

std::string textOf(const pipeline::SeparateResult& result) {
  return fmt::format("{:.1f} % of the light is direct.\n", 100.0 * result.directShare) +
         textOf(pipeline::WrittenFiles{result.files});
}

std::string textOf(const pipeline::DifferenceResult& result) {
  return fmt::format(
             "They differ by {:.4g} (root mean square), {:.2f} % of the second; shown {:.3g} times.\n",
             result.rms, 100.0 * result.relative, result.gain) +
         textOf(pipeline::WrittenFiles{result.files});
}

std::string textOf(const std::vector<compensation::Mask>& masks) {
  if (masks.empty()) return "There are no masks: all of the picture is lit.\n";
  std::string text;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const compensation::Mask& mask = masks[i];
    text += fmt::format(
        "Mask {} in the view of camera {}: {} points, {}, feathered over {:.3g} % of the view.\n", i + 1,
        mask.camera + 1, mask.points.size(),
        mask.outline == compensation::Outline::curve ? "a curve" : "straight lines", 100.0 * mask.feather);
  }
  return text;
}

std::string textOf(const pipeline::TargetSets& sets) {
  if (sets.all.empty()) return "There are no sets: what is shown, and how, has no name.\n";
  std::string text;
  for (std::size_t i = 0; i < sets.all.size(); ++i) {
    const pipeline::ContentSettings& content = sets.all[i].content;
    const std::size_t masks = content.masks.size();
    text +=
        fmt::format("{} {}: {}, brightness {}, {:.3g} % may be too dark, {}{}\n", i == sets.inUse ? '*' : ' ',
                    sets.all[i].name, nameOf(content.method), nameOf(content.brightness),
                    content.reachablePercentile, content.corners ? "placed by hand" : "placed by itself",
                    masks == 0 ? "" : fmt::format(", {} mask{}", masks, masks == 1 ? "" : "s"));
  }
  return text + "The set marked * is in use.\n";
}

std::string textOf(const pipeline::TidyResult& result) {
  const auto part = [](const pipeline::DiskShare& share, std::string_view what) {
    return share.files == 0 ? std::string()
                            : fmt::format("; {} {}, {}", share.files, what, bytesText(share.bytes));
  };
  std::string text;
  for (const pipeline::TidiedCalibration& tidied : result.calibrations) {
    const std::string freed = tidied.freed() == 0 ? "nothing to free"
                                                  : fmt::format("{} {}", bytesText(tidied.freed()),
                                                                result.dryRun ? "would be freed" : "freed");
    text += fmt::format("{}: {}{}{}{}{}{}{}.\n", tidied.folder.string(), freed,
                        part(tidied.photographs, result.dryRun ? "patterns' photographs to remove"
                                                               : "patterns' photographs removed"),
                        part(tidied.compressed, result.dryRun ? "to compress" : "compressed"),
                        part(tidied.results, "files of results that were replaced"),
                        part(tidied.perfected, "files of perfected pictures that are out of date"),
                        part(tidied.leftovers, "files left by interrupted writes"),
                        part(tidied.kept, "patterns' photographs stay"));
    if (!tidied.isComplete && tidied.kept.files > 0)
      text += "  It is not complete: its photographs are needed to go on.\n";
  }
  return text;
}

std::string textOf(const pipeline::BenchResult& result) {
  std::string text =
      fmt::format("{}, {} threads, copies {:.1f} GB/s\n",
                  result.machine.device.empty() ? result.machine.processor : result.machine.device,
                  result.machine.threads, result.machine.copyBytesPerSecond / 1e9);
  for (const pipeline::Benchmark& benchmark : result.benchmarks) {
    text += fmt::format("{:<32} {:>10.3f} ms {:>8.1f} MB {:>5.0f} % of copying", benchmark.name,
                        1e3 * benchmark.seconds, benchmark.bytes / 1e6, 100.0 * benchmark.shareOfCopy);
    for (const engine::EngineBenchRatio& ratio : benchmark.timesAsFastAs)
      text += fmt::format(", {:.1f} times {}", ratio.times, ratio.reference);
    text += "\n";
  }
  for (const Message& note : result.notes) text += fmt::format("{}\n", note);
  return text;
}

/// The last two columns are `clusters` again: inverted by truncated SVD, and in full colour.
std::string textOf(const pipeline::InverseBenchResult& result) {
  const pipeline::PaperFigures paper;
  std::string text = fmt::format(
      "paper: clustering and inversion {:.0f} to {:.0f} s, row errors {:.0f} to {:.0f} %\n\n"
      "{:<8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>12} {:>12} {:>12}\n",
      paper.leastInversionSeconds, paper.mostInversionSeconds, 100.0 * paper.leastError,
      100.0 * paper.mostError, "venue", "clusters s", "largest", "error %", "capped s", "error %", "svd s",
      "windows s", "ridge");
  for (const pipeline::VenueInversion& v : result.venues)
    text += fmt::format(
        "{:<8} {:>10.2f} {:>10} {:>10.0f} {:>10.2f} {:>10.0f} {:>12.2f} {:>12.2f} {:>12.2g}\n", v.venue,
        v.clusterSeconds, v.printed.largest, 100.0 * v.printed.errorMedian, v.cappedSeconds,
        100.0 * v.capped.errorMedian, v.truncatedSeconds, v.windowSeconds, v.ridge);
  text += fmt::format("\n{:<8}", "dB");
  for (const std::string& method : allNames<compensation::Method>()) text += fmt::format(" {:>9}", method);
  text += fmt::format(" {:>9} {:>9}", "by svd", "3x3");
  for (const pipeline::VenueInversion& v : result.venues) {
    text += fmt::format("\n{:<8}", v.venue);
    for (compensation::Method method : allValues<compensation::Method>())
      text += fmt::format(" {:>9.2f}", v.quality.at(method));
    text += fmt::format(" {:>9.2f} {:>9.2f}", v.truncatedQuality, v.fullColourQuality);
  }
  return text + "\n";
}

namespace {

std::string stopsText(const std::vector<pipeline::AcquisitionBenchStop>& stops) {
  std::string text = fmt::format("{:<8} {:>9} {:>6} {:>8} {:>8} {:>8} {:>10} {:>5}\n", "venue", "threshold",
                                 "blocks", "patterns", "expected", "refined", "in the end", "more");
  for (const pipeline::AcquisitionBenchStop& stop : stops)
    text += fmt::format("{:<8} {:>9.3g} {:>6} {:>8} {:>8.2f} {:>8.2f} {:>10.2f} {:>5}\n", stop.venue,
                        stop.threshold, stop.blocks, stop.patterns, stop.expected.now, stop.refined,
                        stop.expected.whole, stop.expected.photographs);
  return text;
}

}  // namespace

std::string textOf(const pipeline::AcquisitionBenchResult& result) {
  if (!result.stops.empty()) return stopsText(result.stops);
  std::string text =
      fmt::format("{:<8} {:<11} {:>9} {:<6} {:>9} {:>9} {:>8} {:>10} {:>9} {:>9} {:>8} {:>8} {:>8}\n",
                  "venue", "mode", "threshold", "light", "exposures", "response", "s", "frobenius",
                  "natural %", "random %", "energy", "windows", "refined");
  for (const pipeline::AcquisitionBenchRun& run : result.runs)
    text += fmt::format(
        "{:<8} {:<11} {:>9.3g} {:<6} {:>9} {:>9} {:>8.1f} {:>10.4f} {:>9.2f} {:>9.2f} {:>8.4f} {:>8.2f} "
        "{:>8.2f}\n",
        run.venue, nameOf(run.mode), run.threshold, nameOf(run.colours), run.exposures, run.linearization,
        run.seconds, run.transport.frobenius, 100.0 * run.transport.relightNatural,
        100.0 * run.transport.relightRandom, run.transport.energy, run.windows, run.refined);
  return text;
}

std::string textOf(const pipeline::ScaleBenchResult& result) {
  std::string text;
  const pipeline::ScaleBenchRun* before = nullptr;
  for (const pipeline::ScaleBenchRun& run : result.runs) {
    text +=
        fmt::format("{} {}x{} / {}x{}: {} photographs, {:.1f} million leaves, forecast {:.2f} GB of memory\n",
                    result.venue, run.sizes.projector.width, run.sizes.projector.height,
                    run.sizes.camera.width, run.sizes.camera.height, run.exposures,
                    1e-6 * static_cast<double>(run.leaves), 1e-9 * static_cast<double>(run.forecastBytes));
    text += fmt::format("  {:<14} {:>8} {:>12} {:>10} {:>13} {:>7}\n", "stage", "s", "processor, s",
                        "memory, GB", "+ mapped, GB", "growth");
    const std::vector<double> growth =
        before ? pipeline::growthOf(*before, run) : std::vector<double>(run.stages.size(), std::nan(""));
    for (std::size_t i = 0; i < run.stages.size(); ++i) {
      const pipeline::ScaleStage& stage = run.stages[i];
      text +=
          fmt::format("  {:<14} {:>8.1f} {:>12.1f} {:>10.2f} {:>13.2f} {:>7}\n", stage.name, stage.seconds,
                      stage.processorSeconds, 1e-9 * static_cast<double>(stage.memoryBytes),
                      1e-9 * static_cast<double>(stage.filesBytes),
                      std::isfinite(growth[i]) ? fmt::format("{:.2f}", growth[i]) : "");
    }
    text += fmt::format(
        "  photographs {:.2f} GB, results {:.2f} GB; {:.0f} s from the last photograph to the first still; "
        "windows {:.2f} dB, refined {:.2f} dB\n",
        1e-9 * static_cast<double>(run.photographBytes), 1e-9 * static_cast<double>(run.resultBytes),
        run.secondsToStill, run.windows, run.refined);
    before = &run;
  }
  return text;
}

}  // namespace relucent::cli
