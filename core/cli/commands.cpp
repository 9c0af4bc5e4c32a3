// SPDX-License-Identifier: MIT
#include "relucent/cli/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <new>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/terminal_text.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/cli/day_document.h"
#include "relucent/cli/devices_document.h"
#include "relucent/cli/interruption.h"
#include "relucent/cli/projectors_document.h"
#include "relucent/cli/terminal_progress.h"
#include "relucent/cli/terminal_room.h"
#include "relucent/cli/texts.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/masks_file.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stills.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/platform/process.h"
#include "relucent/report/acquisition_chart.h"

namespace relucent::cli {
namespace {

enum ExitStatus { done = 0, failed = 1, wrongUsage = 2, remeasure = 3, startAgain = 4, interrupted = 130 };

/// Throws: Error{input} if there are any, naming all of them.
void refuse(const std::vector<Message>& problems) {
  Message all;
  for (const Message& problem : problems)
    all = all.empty() ? problem : RELUCENT_ENGLISH_MESSAGE("command.and", "{}, and {}").with(all, problem);
  if (!all.empty())
    throw Error(ErrorKind::input, all,
                RELUCENT_ENGLISH_MESSAGE("command.choose-other-values", "choose other values"));
}

int statusOf(acquisition::Verdict verdict) {
  switch (verdict) {
    case acquisition::Verdict::stillGood:
      return done;
    case acquisition::Verdict::remeasure:
      return remeasure;
    case acquisition::Verdict::startAgain:
      return startAgain;
  }
  return failed;
}

std::vector<std::filesystem::path> stillsOf(const std::vector<std::filesystem::path>& contents) {
  std::vector<std::filesystem::path> stills;
  for (const std::filesystem::path& content : contents)
    for (std::filesystem::path& still : pipeline::stillsOf(content)) stills.push_back(std::move(still));
  return stills;
}

/// The calibration's venue as it has become; none: as it was.
std::optional<pipeline::RigSettings> rehearsedRig(const std::filesystem::path& calibration,
                                                  const venue::Changes& changes) {
  if (!changes.any()) return std::nullopt;
  const calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(calibration, calibration::CalibrationFolder::Access::read);
  return pipeline::changedRig(pipeline::settingsOf(folder).rig, changes);
}

template <typename Result>
CommandResult outcomeOf(const Result& result) {
  return {toJson(result), textOf(result)};
}

/// One overload a command; each is one call of the pipeline.
struct Executor {
  Progress& progress;
  calibration::RoomWaiter* room;

  calibration::RoomWaiter* waiterOf(FullDiskAction action) const {
    return action == FullDiskAction::wait ? room : nullptr;
  }

  CommandResult operator()(const PrintText& command) const { return {{}, command.text}; }

  CommandResult operator()(const ListVenues&) const {
    std::string text;
    for (const venue::VenueDescription& venue : venue::venues())
      text += fmt::format("{:<10} {}\n", venue.name, venue.sentence);
    return {pipeline::toJson(venue::venues()), text};
  }

  CommandResult operator()(const ListDevices&) const { return outcomeOf(devices::cameraRegistry().list()); }

  CommandResult operator()(const CheckRig& command) const {
    refuse(problems(command.settings));
    const pipeline::RigCheck found = pipeline::checkRig(command.settings, command.cache, progress);
    return {toJson(found), textOf(found)};
  }

  CommandResult operator()(const Calibrate& command) const {
    refuse(problems(command.settings));
    const pipeline::Storage storage{command.kept, waiterOf(command.fullDisk)};
    return outcomeOf(
        pipeline::calibrate(command.calibration, command.settings, storage, command.cache, {}, progress));
  }

  CommandResult operator()(const Resume& command) const {
    return outcomeOf(
        pipeline::resume(command.calibration, waiterOf(command.fullDisk), command.cache, {}, progress));
  }

  CommandResult operator()(const Verify& command) const {
    refuse(problems(command.settings));
    pipeline::VerifySettings settings = command.settings;
    settings.rig = rehearsedRig(command.calibration, command.changes);
    pipeline::VerifyResult result =
        pipeline::verifyCalibration(command.calibration, settings, command.cache, progress);
    CommandResult outcome = outcomeOf(result);
    outcome.status = statusOf(result.judgement.verdict);
    return outcome;
  }

  CommandResult operator()(const Prove& command) const {
    refuse(problems(command.settings));
    pipeline::ProveSettings settings = command.settings;
    settings.rig = rehearsedRig(command.calibration, command.changes);
    return outcomeOf(pipeline::proveCalibration(command.calibration, settings, command.cache, progress));
  }

  CommandResult operator()(const Perfect& command) const {
    pipeline::PerfectSettings settings = command.settings;
    refuse(problems(settings.canvas));
    settings.images = stillsOf(command.content);
    if (command.forget)
      return outcomeOf(
          pipeline::forgetPerfected(command.calibration, settings.images, settings.canvas, settings.set));
    refuse(problems(settings));
    settings.rig = rehearsedRig(command.calibration, command.changes);
    const pipeline::PerfectResult result =
        pipeline::perfectPictures(command.calibration, settings, command.cache, {}, progress);
    CommandResult outcome = outcomeOf(result);
    if (!isPerfect(result)) outcome.status = failed;
    return outcome;
  }

  CommandResult operator()(const Repair& command) const {
    if (command.undo) return outcomeOf(pipeline::undoRepair(command.calibration));
    pipeline::RepairSettings settings = command.settings;
    settings.rig = rehearsedRig(command.calibration, command.changes);
    const pipeline::RepairResult result =
        pipeline::repairCalibration(command.calibration, settings, command.cache, progress);
    CommandResult outcome = outcomeOf(result);
    if (result.end == pipeline::RepairEnd::notBetter) outcome.status = remeasure;
    return outcome;
  }

  CommandResult operator()(const TendNight& command) const {
    if (command.history) return outcomeOf(pipeline::nightsOf(command.calibration));
    pipeline::NightSettings settings = command.settings;
    settings.images = stillsOf(command.content);
    refuse(problems(settings));
    settings.rig = rehearsedRig(command.calibration, command.changes);
    const pipeline::NightRecord night =
        pipeline::tendCalibration(command.calibration, settings, command.cache, progress);
    CommandResult outcome = outcomeOf(night);
    if (isAlarm(night)) outcome.status = remeasure;
    return outcome;
  }

  CommandResult operator()(const RehearseDays& command) const {
    refuse(problems(command.settings));
    rehearsal::DaysSettings settings = command.settings;
    const bool isTemporary = settings.out.empty();
    if (isTemporary)
      settings.out =
          std::filesystem::temp_directory_path() / fmt::format("relucent-day-{}", platform::processNumber());
    rehearsal::DaysResult result = rehearsal::rehearseDays(settings, progress);
    const bool held = allHeld(result);
    if (isTemporary && held) {
      std::error_code ignored;
      std::filesystem::remove_all(settings.out, ignored);
      result.out.clear();
    }
    CommandResult outcome = outcomeOf(result);
    if (!held) outcome.status = remeasure;
    return outcome;
  }

  CommandResult operator()(const ImportPictures& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pipeline::importPictures(command.calibration, command.settings, progress));
  }

  CommandResult operator()(const Plan& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pipeline::exportPlan(command.settings, command.out, progress));
  }

  CommandResult operator()(const Compensate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pipeline::compensate(command.calibration, command.settings, progress));
  }

  CommandResult operator()(const Evaluate& command) const {
    refuse(problems(command.settings));
    pipeline::EvaluateSettings settings = command.settings;
    settings.rig = rehearsedRig(command.calibration, command.changes);
    return outcomeOf(evaluate(command.calibration, settings, command.cache, progress));
  }

  CommandResult operator()(const Export& command) const {
    return outcomeOf(pipeline::exportCalibration(command.calibration, command.settings, progress));
  }

  CommandResult operator()(const Relight& command) const {
    return outcomeOf(command.dual ? dual(command.calibration, command.settings, progress)
                                  : pipeline::relight(command.calibration, command.settings, progress));
  }

  CommandResult operator()(const Separate& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pipeline::separate(command.calibration, command.settings, progress));
  }

  CommandResult operator()(const Difference& command) const {
    refuse(problems(command.settings));
    return outcomeOf(pipeline::pictureDifference(command.settings, progress));
  }

  CommandResult operator()(const Report& command) const {
    return outcomeOf(report::makeReport(command.calibration, command.settings, command.cache, progress));
  }

  CommandResult operator()(const Tidy& command) const {
    return outcomeOf(pipeline::tidy(command.calibrations, command.settings, progress));
  }

  CommandResult operator()(const Masks& command) const {
    using calibration::CalibrationFolder;
    CalibrationFolder folder =
        CalibrationFolder::open(command.calibration, command.masks ? CalibrationFolder::Access::write
                                                                   : CalibrationFolder::Access::read);
    if (command.masks) pipeline::keepMasks(folder, *command.masks);
    const std::vector<compensation::Mask> masks = pipeline::settingsOf(folder).content.masks;
    if (!command.exported.empty()) pipeline::writeMasks(command.exported, masks);
    return {{{"masks", pipeline::masksToJson(masks)}}, textOf(masks)};
  }

  CommandResult operator()(const Sets& command) const {
    using calibration::CalibrationFolder;
    CalibrationFolder folder = CalibrationFolder::open(
        command.calibration, command.action == SetAction::list ? CalibrationFolder::Access::read
                                                               : CalibrationFolder::Access::write);
    switch (command.action) {
      case SetAction::list:
        break;
      case SetAction::save:
        pipeline::saveSet(folder, command.names.at(0));
        break;
      case SetAction::use:
        pipeline::useSet(folder, command.names.at(0));
        break;
      case SetAction::rename:
        pipeline::renameSet(folder, command.names.at(0), command.names.at(1));
        break;
      case SetAction::remove:
        pipeline::removeSet(folder, command.names.at(0));
        break;
    }
    const pipeline::TargetSets sets = pipeline::setsOf(folder);
    return {pipeline::toJson(sets), textOf(sets)};
  }

  CommandResult operator()(const Projectors& command) const {
    pipeline::ProjectorStatusSettings settings = command.settings;
    if (settings.search) refuse(problems(*settings.search));
    if (!command.calibration.empty()) {
      const bool changes = command.forget || !command.network.empty();
      using calibration::CalibrationFolder;
      CalibrationFolder folder = CalibrationFolder::open(
          command.calibration, changes ? CalibrationFolder::Access::write : CalibrationFolder::Access::read);
      const pipeline::CalibrateSettings known = pipeline::settingsOf(folder);
      pipeline::NetworkProjectors network = command.forget ? pipeline::NetworkProjectors() : known.network;
      command.network.apply(network, known.rig);
      refuse(problems(network, known.rig));
      if (changes) keepNetworkProjectors(folder, network);
      for (const auto& [projector, address] : network.addresses) settings.addresses.push_back(address);
    }
    const std::vector<pipeline::ProjectorStatus> statuses = pipeline::projectorStatuses(settings, progress);
    CommandResult outcome{toJson(statuses), textOf(statuses)};
    if (std::ranges::any_of(statuses, [](const auto& status) { return !status.report; }))
      outcome.status = failed;
    return outcome;
  }

  CommandResult benchAcquisition(const Bench& command) const {
    pipeline::AcquisitionBenchResult result =
        pipeline::benchAcquisition(command.acquisition, command.cache, progress);
    if (!command.chart.empty()) writeFileAtomically(command.chart, report::acquisitionChart(result));
    return outcomeOf(result);
  }

  CommandResult benchScale(const Bench& command) const {
    pipeline::ScaleBenchSettings settings = command.scale;
    settings.after.push_back({"report", [&](const std::filesystem::path& calibration,
                                            const std::filesystem::path& out, Progress& part) {
                                report::ReportSettings wanted;
                                wanted.out = out;
                                wanted.out += ".html";
                                wanted.evaluate = false;
                                report::makeReport(calibration, wanted, command.cache, part);
                              }});
    return outcomeOf(pipeline::benchScale(settings, command.cache, progress));
  }

  CommandResult operator()(const Bench& command) const {
    switch (command.suite) {
      case BenchSuite::inverse:
        return outcomeOf(pipeline::benchInverse(command.cache, progress));
      case BenchSuite::engine:
        return outcomeOf(command.engine ? pipeline::benchEngine(*command.engine, progress)
                                        : pipeline::benchEngine(command.backend, progress));
      case BenchSuite::acquisition:
        refuse(problems(command.acquisition));
        return benchAcquisition(command);
      case BenchSuite::scale:
        refuse(problems(command.scale));
        return benchScale(command);
      case BenchSuite::parts:
        break;
    }
    return outcomeOf(pipeline::bench(command.name, progress));
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
  if (folder != nullptr &&
      !std::filesystem::exists(*folder / calibration::CalibrationFolder::manifestName, code))
    return "interrupted before anything was measured; run it again.";
  if (folder == nullptr) return "interrupted; nothing on disk is damaged, run it again.";
  return fmt::format("interrupted; every photograph is safe, resume with: relucent-cli resume {}",
                     quoted(folder->string()));
}

int fail(const std::string& sentence, int status) {
  std::cerr << "relucent-cli: " << forTerminal(sentence) << '\n';
  return status;
}

/// Calibrations come from strangers: programs that they name are run if somebody agreed or named them
/// himself.
void askForConsent(const std::vector<std::string>& arguments, bool allowCommands) {
  devices::askForConsent({devices::usualConsentFile(),
                          [arguments, allowCommands](const std::string& command) {
                            return allowCommands || devices::isNamedBy(arguments, command);
                          },
                          RELUCENT_ENGLISH_MESSAGE("command.allow-commands",
                                                   "look at what it does, then give --allow-commands")});
}

void print(const CommandResult& outcome, bool json) {
  if (json)
    std::cout << outcome.document.dump(2, ' ', false, calibration::Json::error_handler_t::replace) << "\n";
  else
    std::cout << forTerminal(outcome.text);
  std::cout.flush();
  if (!std::cout)
    throw Error(ErrorKind::disk,
                RELUCENT_ENGLISH_MESSAGE("command.cannot-write-output",
                                         "cannot write the results to standard output"),
                RELUCENT_ENGLISH_MESSAGE("command.check-output-and-space",
                                         "check where it leads and that there is space"));
}

}  // namespace

CommandResult execute(const Command& command, Progress& progress, calibration::RoomWaiter* room) {
  return std::visit(Executor{progress, room}, command);
}

int runCommandLine(const std::vector<std::string>& arguments) {
  Arguments parsed;
  try {
    parsed = parseArguments(arguments);
  } catch (const WrongUsage& error) {
    return fail(error.what(), wrongUsage);
  }

  askForConsent(arguments, parsed.allowCommands);
  try {
    CommandResult outcome;
    {
      Interruption interruption;
      TerminalProgress terminal(TerminalProgress::standardError());
      Progress progress(terminal, interruption.stop());
      TerminalRoom room(terminal);
      outcome = execute(parsed.command, progress, &room);
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

}  // namespace relucent::cli
