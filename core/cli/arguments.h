// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "relucent/pipeline/acquisition_bench.h"
#include "relucent/pipeline/bench.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/check.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/difference.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/export.h"
#include "relucent/pipeline/import.h"
#include "relucent/pipeline/night.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/plan.h"
#include "relucent/pipeline/projector_statuses.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/relight.h"
#include "relucent/pipeline/repair.h"
#include "relucent/pipeline/scale_bench.h"
#include "relucent/pipeline/separate.h"
#include "relucent/pipeline/storage.h"
#include "relucent/pipeline/tidy.h"
#include "relucent/pipeline/verify.h"
#include "relucent/rehearsal/venue_days.h"
#include "relucent/report/report.h"

namespace relucent::cli {

/// What the command line asks for, one struct a subcommand.
struct PrintText {  // --help, --version
  std::string text;
};
struct ListVenues {};
/// The cameras that are there.
struct ListDevices {};
/// How projector and camera work together.
struct CheckRig {
  pipeline::CheckSettings settings;
  std::filesystem::path cache;
};
/// What a measurement does where the disk is full.
enum class FullDiskAction { wait, stop };
inline constexpr EnumName<FullDiskAction> fullDiskActionNames[]{
    {FullDiskAction::wait, "wait", "until there is room"},
    {FullDiskAction::stop, "stop", "with exit status 1, to be resumed"}};
constexpr EnumNames<FullDiskAction> namesOf(FullDiskAction) {
  return {"action", fullDiskActionNames};
}
struct Calibrate {
  std::filesystem::path calibration;
  pipeline::CalibrateSettings settings;
  pipeline::KeptPhotographs kept = pipeline::KeptPhotographs::everything;
  FullDiskAction fullDisk = FullDiskAction::wait;
  std::filesystem::path cache;
};
struct Resume {
  std::filesystem::path calibration;
  FullDiskAction fullDisk = FullDiskAction::wait;
  std::filesystem::path cache;
};
struct Verify {
  std::filesystem::path calibration;
  pipeline::VerifySettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  std::filesystem::path cache;
};
struct Prove {
  std::filesystem::path calibration;
  pipeline::ProveSettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  std::filesystem::path cache;
};
struct Perfect {
  std::filesystem::path calibration;
  std::vector<std::filesystem::path> content;  // pictures, folders, playlists
  pipeline::PerfectSettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  bool forget = false;     // what was perfected, instead
  std::filesystem::path cache;
};
struct Repair {
  std::filesystem::path calibration;
  pipeline::RepairSettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  bool undo = false;       // the last repair, instead
  std::filesystem::path cache;
};
struct TendNight {
  std::filesystem::path calibration;
  std::vector<std::filesystem::path> content;  // pictures, folders, playlists
  pipeline::NightSettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  bool history = false;    // of the nights so far, instead
  std::filesystem::path cache;
};
/// Days of a venue around the program relucent.
struct RehearseDays {
  rehearsal::DaysSettings settings;
};
struct ImportPictures {
  std::filesystem::path calibration;
  pipeline::ImportPicturesSettings settings;
};
struct Plan {
  importing::PatternPlanSettings settings;
  std::filesystem::path out;
};
struct Compensate {
  std::filesystem::path calibration;
  pipeline::CompensateSettings settings;
};
struct Evaluate {
  std::filesystem::path calibration;
  pipeline::EvaluateSettings settings;
  venue::Changes changes;  // of a simulated venue, to rehearse
  std::filesystem::path cache;
};
struct Export {
  std::filesystem::path calibration;
  pipeline::ExportSettings settings;
};
struct Relight {
  std::filesystem::path calibration;
  pipeline::RelightSettings settings;
  bool dual = false;
};
struct Separate {
  std::filesystem::path calibration;
  pipeline::SeparateSettings settings;
};
struct Difference {
  pipeline::DifferenceSettings settings;
};
struct Report {
  std::filesystem::path calibration;
  report::ReportSettings settings;
  std::filesystem::path cache;
};
struct Tidy {
  std::vector<std::filesystem::path> calibrations;
  pipeline::TidySettings settings;
};
/// Sets of a calibration: listed, or one of them saved, used, renamed or removed.
enum class SetAction { list, save, use, rename, remove };
inline constexpr EnumName<SetAction> setActionNames[]{{SetAction::list, "list"},
                                                      {SetAction::save, "save"},
                                                      {SetAction::use, "use"},
                                                      {SetAction::rename, "rename"},
                                                      {SetAction::remove, "remove"}};
constexpr EnumNames<SetAction> namesOf(SetAction) {
  return {"action", setActionNames};
}
struct Sets {
  std::filesystem::path calibration;
  SetAction action = SetAction::list;
  std::vector<std::string> names;  // that the action takes: none, one, or rename's two
};
/// Masks of a calibration: shown, replaced or written.
struct Masks {
  std::filesystem::path calibration;
  std::optional<std::vector<compensation::Mask>> masks{};  // to be kept from now on; none: as they are
  std::filesystem::path exported;                          // a file to write them to; empty: none
};
/// Where projectors are on the network, as the command line says it.
struct NetworkOptions {
  std::vector<std::string> addresses;      // "[N=]HOST[:PORT]"
  std::vector<std::string> passwordFiles;  // "[N=]FILE"
  std::optional<pipeline::WarmUp> warmUp;

  bool empty() const;
  /// Changes what a calibration keeps of it.  Throws: Error{usage, disk, input}; WrongUsage.
  void apply(pipeline::NetworkProjectors& projectors, const pipeline::RigSettings& rig) const;
};
/// Projectors on the network: what they say, and what a calibration knows of them.
struct Projectors {
  std::filesystem::path calibration;  // empty: none
  pipeline::ProjectorStatusSettings settings;
  NetworkOptions network;
  bool forget = false;
};
/// What `bench` times: programs of their own, or single parts of core.
enum class BenchSuite { parts, inverse, engine, acquisition, scale };
inline constexpr EnumName<BenchSuite> benchSuiteNames[]{{BenchSuite::inverse, "inverse"},
                                                        {BenchSuite::engine, "engine"},
                                                        {BenchSuite::acquisition, "acquisition"},
                                                        {BenchSuite::scale, "scale"}};
constexpr EnumNames<BenchSuite> namesOf(BenchSuite) {
  return {"benchmark", benchSuiteNames};
}
struct Bench {
  BenchSuite suite = BenchSuite::parts;
  std::string name;  // of parts: only those that contain it
  pipeline::AcquisitionBenchSettings acquisition;
  pipeline::ScaleBenchSettings scale;
  std::filesystem::path chart;  // of `acquisition`: where to; empty: none
  engine::BackendChoice backend = engine::BackendChoice::automatic;  // of `engine`
  bool oneThread = false;                                            // of these devices
  std::optional<engine::EngineBenchSettings> engine{};               // these devices alone
  std::filesystem::path cache;
};
using Command =
    std::variant<PrintText, ListVenues, ListDevices, CheckRig, Calibrate, Resume, Verify, Prove, Repair,
                 TendNight, RehearseDays, Perfect, ImportPictures, Plan, Compensate, Evaluate, Export,
                 Relight, Separate, Difference, Report, Tidy, Masks, Sets, Projectors, Bench>;

struct Arguments {
  Command command;
  bool json = false;           // one JSON document on standard output and nothing else
  bool allowCommands = false;  // those of the calibration, from now on
};

/// The command line cannot be understood; the sentence says how to write it.
class WrongUsage : public std::exception {
 public:
  explicit WrongUsage(std::string sentence) : sentence_(std::move(sentence)) {}
  const char* what() const noexcept override { return sentence_.c_str(); }

 private:
  std::string sentence_;
};

/// `arguments`: without the program's name. Says nothing about whether files exist or sizes are possible.
/// Throws: WrongUsage.
Arguments parseArguments(const std::vector<std::string>& arguments);

/// "256x192". Throws: WrongUsage unless it is two whole numbers.
Size parseSize(const std::string& text);

/// Where simulated venues are kept: $XDG_CACHE_HOME/relucent, or .cache/relucent in the home folder; empty,
/// which means no cache, where there is neither.
std::filesystem::path defaultCache();

}  // namespace relucent::cli
