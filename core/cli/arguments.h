// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/acquisition_bench.h"
#include "pipeline/bench.h"
#include "pipeline/calibrate.h"
#include "pipeline/check.h"
#include "pipeline/compensate.h"
#include "pipeline/difference.h"
#include "pipeline/evaluate.h"
#include "pipeline/export.h"
#include "pipeline/import.h"
#include "pipeline/plan.h"
#include "pipeline/prove.h"
#include "pipeline/relight.h"
#include "pipeline/report.h"
#include "pipeline/separate.h"
#include "pipeline/verify.h"

namespace relucent {

/// What the command line asks for, one struct a subcommand.
struct PrintText {  // --help, --version
  std::string text;
};
struct ListVenues {};
/// The cameras that are there.
struct ListDevices {};
/// How projector and camera work together.
struct CheckRig {
  CheckSettings settings;
  std::filesystem::path cache;
};
struct Calibrate {
  std::filesystem::path calibration;
  CalibrateSettings settings;
  std::filesystem::path cache;
};
struct Resume {
  std::filesystem::path calibration;
  std::filesystem::path cache;
};
struct Verify {
  std::filesystem::path calibration;
  VerifySettings settings;
  std::filesystem::path cache;
};
struct Prove {
  std::filesystem::path calibration;
  ProveSettings settings;
  std::filesystem::path cache;
};
struct ImportPictures {
  std::filesystem::path calibration;
  ImportPicturesSettings settings;
};
struct Plan {
  PatternPlanSettings settings;
  std::filesystem::path out;
};
struct Compensate {
  std::filesystem::path calibration;
  CompensateSettings settings;
};
struct Evaluate {
  std::filesystem::path calibration;
  EvaluateSettings settings;
  std::filesystem::path cache;
};
struct Export {
  std::filesystem::path calibration;
  ExportSettings settings;
};
struct Relight {
  std::filesystem::path calibration;
  RelightSettings settings;
  bool dual = false;
};
struct Separate {
  std::filesystem::path calibration;
  SeparateSettings settings;
};
struct Difference {
  DifferenceSettings settings;
};
struct Report {
  std::filesystem::path calibration;
  ReportSettings settings;
  std::filesystem::path cache;
};
/// What `bench` times: programs of their own, or single parts of core.
enum class BenchSuite { parts, inverse, engine, acquisition };
inline constexpr EnumName<BenchSuite> benchSuiteNames[]{{BenchSuite::inverse, "inverse"},
                                                        {BenchSuite::engine, "engine"},
                                                        {BenchSuite::acquisition, "acquisition"}};
constexpr EnumNames<BenchSuite> namesOf(BenchSuite) {
  return {"benchmark", benchSuiteNames};
}
struct Bench {
  BenchSuite suite = BenchSuite::parts;
  std::string name;  // of parts: only those that contain it
  AcquisitionBenchSettings acquisition;
  BackendChoice backend = BackendChoice::automatic;  // of `engine`
  std::filesystem::path cache;
};
using Command = std::variant<PrintText, ListVenues, ListDevices, CheckRig, Calibrate, Resume, Verify, Prove,
                             ImportPictures, Plan, Compensate, Evaluate, Export, Relight, Separate,
                             Difference, Report, Bench>;

struct Arguments {
  Command command;
  bool json = false;  // one JSON document on standard output and nothing else
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

}  // namespace relucent
