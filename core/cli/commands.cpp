// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <new>

#include "base/error.h"
#include "calibration/calibration_folder.h"
#include "cli/interruption.h"
#include "cli/terminal_progress.h"

namespace relucent {
namespace {

enum ExitStatus { done = 0, failed = 1, wrongUsage = 2, remeasure = 3, startAgain = 4, interrupted = 130 };

/// Throws: Error{input} if there are any, naming all of them.
void refuse(const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : ", and ") + problem;
  if (!all.empty()) throw Error(ErrorKind::input, all, "choose other values");
}

std::string lines(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

std::string textOf(const CalibrateResult& result) {
  double seconds = result.seconds.linearization + result.seconds.acquisition + result.seconds.inverse;
  return fmt::format(
             "Calibrated with {} patterns and {} photographs in {:.0f} s.\n"
             "{} connections of light in {} leaves; {:.1f} % of the light is unresolved, {:.1f} % of the "
             "camera's "
             "pixels are flagged.\n",
             result.patterns, result.exposures, seconds, result.connections, result.leaves,
             100.0 * result.unresolvedEnergy, 100.0 * result.flaggedShare) +
         lines(result.findings);
}

std::string textOf(const WrittenFiles& result) {
  std::string text;
  for (const std::filesystem::path& file : result.files) text += "Wrote " + file.string() + "\n";
  for (const std::string& note : result.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string textOf(const VerifyResult& result) {
  const Reverification& found = result.found;
  std::string text = fmt::format("{}\nError by size of the pattern's blocks:", result.judgement.sentence);
  for (std::size_t size = 0; size < found.errorOf.size(); ++size)
    text += fmt::format("{} {} {:.1f} %", size == 0 ? "" : ",", 1 << size, 100.0 * found.errorOf[size]);
  text += fmt::format(
      ".\nThe lamp gives {:.1f} % of its light; the room's light changed by {:+.2f} % of the flood image; "
      "{} photographs in {:.0f} s.\n",
      100.0 * found.lamp, 100.0 * found.ambient, found.exposures, result.seconds);
  return text + textOf(WrittenFiles{result.files});
}

std::string textOf(const ImportResult& result) {
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

std::string textOf(const CompensateResult& result) {
  std::string text = fmt::format(
      "Predicted: {:.1f} dB where it can be reached, which is {:.1f} % of the picture; colour error {:.1f} "
      "(CIEDE2000) over all of it; {:.1f} % of the drive values are at their limits.\n",
      result.psnrPredicted, 100.0 * result.reachable, result.deltaE, 100.0 * result.clipped);
  for (const auto& [key, share] : result.uncorrectable) {
    if (share < 0.0005) continue;
    std::string reason = key;
    std::replace(reason.begin(), reason.end(), '_', ' ');
    text += fmt::format("Cannot be corrected: {:.1f} % {}.\n", 100.0 * share, reason);
  }
  return text + textOf(WrittenFiles{result.files});
}

std::string textOf(const EvaluateResult& result) {
  std::string text =
      fmt::format("{}: {:.1f} % of the pictures can be reached.\n", result.venue, 100.0 * result.reachable);
  for (const ImageScore& image : result.images) {
    text += fmt::format("\n{:<12} {:>14} {:>9} {:>7} {:>7} {:>9}\n", image.name, "reachable dB", "all dB",
                        "SSIM", "dE2000", "seconds");
    for (const MethodScore& score : image.methods)
      text += fmt::format("{:<12} {:>14.2f} {:>9.2f} {:>7.3f} {:>7.2f} {:>9.4f}\n", score.method,
                          score.psnrReachable, score.psnrAll, score.ssim, score.deltaE, score.seconds);
  }
  return text;
}

std::string textOf(const SeparateResult& result) {
  return fmt::format("{:.1f} % of the light is direct.\n", 100.0 * result.directShare) +
         textOf(WrittenFiles{result.files});
}

std::string textOf(const DifferenceResult& result) {
  return fmt::format(
             "They differ by {:.4g} (root mean square), {:.2f} % of the second; shown {:.3g} times.\n",
             result.rms, 100.0 * result.relative, result.gain) +
         textOf(WrittenFiles{result.files});
}

std::string textOf(const BenchResult& result) {
  std::string text =
      fmt::format("{}, {} threads, copies {:.1f} GB/s\n",
                  result.machine.device.empty() ? result.machine.processor : result.machine.device,
                  result.machine.threads, result.machine.copyBytesPerSecond / 1e9);
  for (const Benchmark& benchmark : result.benchmarks)
    text += fmt::format("{:<32} {:>10.3f} ms {:>8.1f} MB {:>5.0f} % of copying\n", benchmark.name,
                        1e3 * benchmark.seconds, benchmark.bytes / 1e6, 100.0 * benchmark.shareOfCopy);
  return text;
}

std::string textOf(const InverseBenchResult& result) {
  const PaperFigures paper;
  std::string text = fmt::format(
      "paper: clustering and inversion {:.0f} to {:.0f} s, row errors {:.0f} to {:.0f} %\n\n"
      "{:<8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>12} {:>12} {:>12}\n",
      paper.leastInversionSeconds, paper.mostInversionSeconds, 100.0 * paper.leastError,
      100.0 * paper.mostError, "venue", "clusters s", "largest", "error %", "capped s", "error %", "svd s",
      "windows s", "ridge");
  for (const VenueInversion& v : result.venues)
    text += fmt::format(
        "{:<8} {:>10.2f} {:>10} {:>10.0f} {:>10.2f} {:>10.0f} {:>12.2f} {:>12.2f} {:>12.2g}\n", v.venue,
        v.clusterSeconds, v.printed.largest, 100.0 * v.printed.errorMedian, v.cappedSeconds,
        100.0 * v.capped.errorMedian, v.truncatedSeconds, v.windowSeconds, v.ridge);
  text += fmt::format("\n{:<8}", "dB");
  for (const MethodDescription& method : methodDescriptions) text += fmt::format(" {:>9}", method.name);
  for (const VenueInversion& v : result.venues) {
    text += fmt::format("\n{:<8}", v.venue);
    for (const MethodDescription& method : methodDescriptions)
      text += fmt::format(" {:>9.2f}", v.quality.at(std::string(method.name)));
  }
  return text + "\n";
}

int statusOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::stillGood:
      return done;
    case Verdict::remeasure:
      return remeasure;
    case Verdict::startAgain:
      return startAgain;
  }
  return failed;
}

template <typename Result>
Outcome outcomeOf(const Result& result) {
  return {toJson(result), textOf(result)};
}

/// One overload a command; each is one call of the pipeline.
struct Executor {
  Progress& progress;

  Outcome operator()(const PrintText& command) const { return {{}, command.text}; }

  Outcome operator()(const ListVenues&) const {
    std::string text;
    for (const VenueDescription& venue : venues())
      text += fmt::format("{:<10} {}\n", venue.name, venue.sentence);
    return {toJson(venues()), text};
  }

  Outcome operator()(const Calibrate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(calibrate(command.calibration, command.settings, command.cache, progress));
  }

  Outcome operator()(const Resume& command) const {
    return outcomeOf(resume(command.calibration, command.cache, progress));
  }

  Outcome operator()(const Verify& command) const {
    refuse(problems(command.settings));
    VerifyResult result = verifyCalibration(command.calibration, command.settings, command.cache, progress);
    Outcome outcome = outcomeOf(result);
    outcome.status = statusOf(result.judgement.verdict);
    return outcome;
  }

  Outcome operator()(const ImportPictures& command) const {
    refuse(problems(command.settings));
    return outcomeOf(importPictures(command.calibration, command.settings, progress));
  }

  Outcome operator()(const Plan& command) const {
    refuse(problems(command.settings));
    return outcomeOf(exportPlan(command.settings, command.out, progress));
  }

  Outcome operator()(const Compensate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(compensate(command.calibration, command.settings, progress));
  }

  Outcome operator()(const Evaluate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(evaluate(command.calibration, command.settings, command.cache, progress));
  }

  Outcome operator()(const Export& command) const {
    return outcomeOf(exportCalibration(command.calibration, command.settings, progress));
  }

  Outcome operator()(const Relight& command) const {
    return outcomeOf(command.dual ? dual(command.calibration, command.settings, progress)
                                  : relight(command.calibration, command.settings, progress));
  }

  Outcome operator()(const Separate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(separate(command.calibration, command.settings, progress));
  }

  Outcome operator()(const Difference& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pictureDifference(command.settings, progress));
  }

  Outcome operator()(const Report& command) const {
    return outcomeOf(report(command.calibration, command.settings, command.cache, progress));
  }

  Outcome operator()(const Bench& command) const {
    if (command.name == "inverse") return outcomeOf(benchInverse(command.cache, progress));
    if (command.name == "engine") return outcomeOf(benchEngine(command.backend, progress));
    return outcomeOf(bench(command.name, progress));
  }
};

/// The name as a shell takes it.
std::string quoted(const std::string& name) {
  bool plain = !name.empty() && name.find_first_not_of(
                                    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                    "0123456789-_./~+,:@%") == std::string::npos;
  if (plain) return name;
  std::string result = "'";
  for (char c : name) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string interruptedSentence(const Command& command) {
  const std::filesystem::path* folder = nullptr;
  if (const auto* calibrate = std::get_if<Calibrate>(&command)) folder = &calibrate->calibration;
  if (const auto* resume = std::get_if<Resume>(&command)) folder = &resume->calibration;
  std::error_code code;
  if (folder != nullptr && !std::filesystem::exists(*folder / CalibrationFolder::manifestName, code))
    return "interrupted before anything was measured; run it again.";
  if (folder == nullptr) return "interrupted; nothing on disk is damaged, run it again.";
  return fmt::format("interrupted; every photograph is safe, resume with: relucent-cli resume {}",
                     quoted(folder->string()));
}

int fail(const std::string& sentence, int status) {
  std::cerr << "relucent-cli: " << sentence << std::endl;
  return status;
}

void print(const Outcome& outcome, bool json) {
  if (json)
    std::cout << outcome.document.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  else
    std::cout << outcome.text;
  std::cout.flush();
  if (!std::cout)
    throw Error(ErrorKind::disk, "cannot write the results to standard output",
                "check where it leads and that there is space");
}

}  // namespace

Outcome execute(const Command& command, Progress& progress) {
  return std::visit(Executor{progress}, command);
}

int runCommandLine(const std::vector<std::string>& arguments) {
  Arguments parsed;
  try {
    parsed = parseArguments(arguments);
  } catch (const WrongUsage& error) {
    return fail(error.what(), wrongUsage);
  }

  try {
    Outcome outcome;
    {
      Interruption interruption;
      TerminalProgress terminal(TerminalProgress::standardError());
      Progress progress(terminal, interruption.stop());
      outcome = execute(parsed.command, progress);
    }
    print(outcome, parsed.json);
    return outcome.status;
  } catch (const Cancelled&) {
    return fail(interruptedSentence(parsed.command), interrupted);
  } catch (const Error& error) {
    return fail(error.what(), error.kind() == ErrorKind::usage ? wrongUsage : failed);
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory; close other programs or choose smaller sizes.", failed);
  } catch (const std::exception& error) {
    return fail(fmt::format("this should not have happened: {}; please report it.", error.what()), failed);
  }
}

}  // namespace relucent
