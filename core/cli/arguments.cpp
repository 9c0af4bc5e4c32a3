// SPDX-License-Identifier: MIT
#include "relucent/cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "relucent/cli/options.h"
#include "relucent/pipeline/versions.h"

namespace relucent::cli {
namespace {

constexpr const char* programName = "relucent-cli";

std::string version() {
  std::vector<pipeline::LibraryVersion> libraries = pipeline::coreLibraries();
  libraries.insert(libraries.begin(), {"CLI11", CLI11_VERSION});
  return pipeline::versionText(programName, libraries);
}

std::function<Command()> addVenuesOptions(CLI::App*) {
  return [] { return Command(ListVenues{}); };
}

/// A subcommand; addOptions defines its options and returns what makes its command once they are read.
struct Subcommand {
  const char* name;
  const char* sentence;
  std::function<Command()> (*addOptions)(CLI::App* sub);
};

constexpr Subcommand subcommands[] = {
    {"venues", "List the simulated venues", addVenuesOptions},
    {"devices", "List the connected cameras, their abilities and their problems", addDevicesOptions},
    {"check", "Measure how projector and camera work together", addCheckOptions},
    {"calibrate", "Measure a venue into a new calibration", addCalibrateOptions},
    {"resume", "Continue an interrupted calibration", addResumeOptions},
    {"verify", "Photograph test patterns and decide whether a calibration is still valid", addVerifyOptions},
    {"prove", "Project a picture, photograph it, and compare it with target and prediction", addProveOptions},
    {"perfect", "Correct still pictures by photographs of themselves, for shows of them", addPerfectOptions},
    {"repair", "Make a calibration fit what has become of its venue, or go back to what it was",
     addRepairOptions},
    {"night", "Repair, perfect and prove a calibration between two shows, unattended", addNightOptions},
    {"rehearse-day", "Rehearse days of a simulated venue around the show, from power on to power off",
     addRehearseOptions},
    {"import", "Make a calibration from patterns and photographs taken elsewhere", addImportOptions},
    {"plan", "Write patterns to photograph without a connection, for import", addPlanOptions},
    {"compensate", "Compute the pattern that makes the surface look like an image", addCompensateOptions},
    {"evaluate", "Compare the methods through the true transport of a simulated venue", addEvaluateOptions},
    {"export", "Write the measurement for other programs", addExportOptions},
    {"relight", "Predict what the camera sees under a pattern", addRelightOptions},
    {"dual", "Show the venue as the projector sees it, lit from the camera", addDualOptions},
    {"separate", "Separate direct and indirect light", addSeparateOptions},
    {"difference", "Show how two pictures differ, with enhanced contrast", addDifferenceOptions},
    {"report", "Write one HTML file about a calibration", addReportOptions},
    {"tidy", "Free the disk of what calibrations do not need", addTidyOptions},
    {"sets", "List, save, use, rename or remove the sets of a calibration: for the day, for the night",
     addSetsOptions},
    {"masks", "Show or change the parts of a venue that are not to be lit", addMasksOptions},
    {"projectors", "Ask projectors on the network, find them, and tell a calibration of them",
     addProjectorsOptions},
    {"bench", "Time the parts that determine the speed", addBenchOptions}};

class Parser {
 public:
  Parser() {
    app_.name(programName);
    app_.require_subcommand(1);
    app_.fallthrough();
    app_.set_version_flag("--version", version, "Print the versions of the program and of its libraries");
    app_.set_help_flag("-h,--help", "Print this help");
    app_.add_flag("--json", json_, "Print one JSON document on standard output and nothing else");
    app_.add_flag(
        "--allow-commands", allowCommands_,
        "Run the programs that the calibration names as its devices, now and from now on; not needed for "
        "those named here");
    app_.footer(
        "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n"
        "To try it without devices:  relucent-cli calibrate demo --venue corner");
    for (const Subcommand& subcommand : subcommands) {
      CLI::App* sub = app_.add_subcommand(subcommand.name, subcommand.sentence);
      sub->callback([this, make = subcommand.addOptions(sub)] { make_ = make; });
    }
  }

  Arguments parse(const std::vector<std::string>& arguments) {
    try {
      app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them so
      return {make_(), json_, allowCommands_};
    } catch (const CLI::CallForVersion& version) {
      return {PrintText{version.what()}, false};
    } catch (const CLI::Success&) {
      return {PrintText{app_.help()}, false};
    } catch (const CLI::ParseError& error) {
      if (app_.get_subcommands().empty()) throw WrongUsage(subcommandHint(arguments));
      throw WrongUsage(std::string(error.what()) + helpHint());
    } catch (const WrongUsage& error) {
      throw WrongUsage(error.what() + helpHint());
    }
  }

 private:
  std::string subcommandHint(const std::vector<std::string>& arguments) const {
    std::string names;
    for (const CLI::App* sub : app_.get_subcommands([](const CLI::App*) { return true; }))
      names += (names.empty() ? "" : ", ") + sub->get_name();
    auto isWord = [](const std::string& argument) { return !argument.starts_with("-"); };
    auto word = std::find_if(arguments.begin(), arguments.end(), isWord);
    std::string wrong =
        word == arguments.end() ? "say what to do" : fmt::format("'{}' cannot be done", *word);
    return fmt::format("{}: there are {}; see `{} --help`.", wrong, names, programName);
  }

  std::string helpHint() const {
    std::string line = programName;
    for (const CLI::App* sub : app_.get_subcommands()) line += " " + sub->get_name();
    return "; see `" + line + " --help`.";
  }

  CLI::App app_{
      "Measures how light travels from a projector to a camera, inverts it, and computes projections\n"
      "that look on any surface as if they fell on a white screen."};
  bool json_ = false, allowCommands_ = false;
  std::function<Command()> make_;
};

}  // namespace

Arguments parseArguments(const std::vector<std::string>& arguments) {
  return Parser().parse(arguments);
}

Size parseSize(const std::string& text) {
  Size size;
  const char* end = text.data() + text.size();
  auto [afterWidth, widthError] = std::from_chars(text.data(), end, size.width);
  bool separated =
      widthError == std::errc() && afterWidth != end && (*afterWidth == 'x' || *afterWidth == 'X');
  if (separated) {
    auto [afterHeight, heightError] = std::from_chars(afterWidth + 1, end, size.height);
    if (heightError == std::errc() && afterHeight == end) return size;
  }
  throw WrongUsage(fmt::format("'{}' is no size: write width x height in pixels, like 256x192", text));
}

std::filesystem::path defaultCache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return std::filesystem::path(cache) / "relucent";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::filesystem::path(home) / ".cache" / "relucent";
  return {};
}

}  // namespace relucent::cli
