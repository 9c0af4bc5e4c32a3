// SPDX-License-Identifier: MIT
#include "cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>

#include "cli/options.h"
#include "pipeline/versions.h"

namespace relucent {
namespace {

constexpr const char* programName = "relucent-cli";

std::string version() {
  std::vector<LibraryVersion> libraries = coreLibraries();
  libraries.insert(libraries.begin(), {"CLI11", CLI11_VERSION});
  return versionText(programName, libraries);
}

/// The parser with the places that its options fill. Each add...() defines one subcommand and says how its
/// command is made once the options are read.
class Parser {
 public:
  Parser() {
    app_.name(programName);
    app_.require_subcommand(1);
    app_.fallthrough();
    app_.set_version_flag("--version", version, "Print the versions of the program and of its libraries");
    app_.set_help_flag("-h,--help", "Print this help");
    app_.add_flag("--json", json_, "Print one JSON document on standard output and nothing else");
    app_.footer(
        "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n"
        "Try it with no devices at all:  relucent-cli calibrate demo --venue corner");
    addVenues();
    addDevices();
    addCheck();
    addCalibrate();
    addResume();
    addVerify();
    addProve();
    addImport();
    addPlan();
    addCompensate();
    addEvaluate();
    addExport();
    addRelight("relight", "Predict what the camera sees under a pattern", false);
    addRelight("dual", "Show the venue as the projector sees it, lit from the camera", true);
    addSeparate();
    addDifference();
    addReport();
    addBench();
  }

  Arguments parse(const std::vector<std::string>& arguments) {
    try {
      app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them so
      return {make_(), json_};
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
  /// A subcommand. `command` is what it is parsed into, `finish` completes that when all options are read.
  template <typename Made>
  CLI::App* add(
      const char* name, const char* sentence, const std::shared_ptr<Made>& command,
      std::function<void()> finish = [] {}) {
    CLI::App* sub = app_.add_subcommand(name, sentence);
    sub->callback([this, command, finish] {
      make_ = [command, finish] {
        finish();
        return Command(*command);
      };
    });
    return sub;
  }

  static void addTarget(CLI::App* sub, TargetSettings& target) {
    sub->add_option_function<std::vector<double>>(
           "--corners",
           [&target](const std::vector<double>& v) {
             target.corners = {{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}}};
           },
           "Corners of the content in the camera's view, pixels: x y, clockwise from top left")
        ->expected(8)
        ->type_name("X Y ...");
    sub->add_option_function<std::string>(
           "--fit", [&target](const std::string& name) { target.fit = fitFromName(name).value(); },
           "Content in corners of another shape: fill stretches, fit leaves bars, cover cuts off")
        ->check(CLI::IsMember({"fill", "fit", "cover"}))
        ->type_name("FIT")
        ->default_str("fill");
    sub->add_option("--dark-share", target.reachablePercentile,
                    "Percent of the pixels that may be too dark to show white: more is brighter")
        ->type_name("PERCENT")
        ->capture_default_str();
    sub->add_option("--black-lift", target.blackLift, "Share of white added to black")
        ->type_name("SHARE")
        ->capture_default_str();
  }

  void addVenues() { add("venues", "List the simulated venues", std::make_shared<ListVenues>()); }

  void addDevices() {
    add("devices", "List the cameras that are there, what each can do and what is wrong with it",
        std::make_shared<ListDevices>())
        ->footer(
            "A camera's address, KIND:PLACE, is what `calibrate --camera` takes:\n"
            "  genicam:SERIAL   GigE Vision or USB3 Vision; also its network address\n"
            "  gphoto2:MODEL    DSLR or mirrorless camera; also the port it is plugged in at\n"
            "  v4l2:PATH        a webcam with manual exposure, /dev/v4l/by-id/...\n"
            "  command:CMD      a program that photographs {exposure} seconds into {output}");
  }

  void addCheck() {
    CLI::App* sub = app_.add_subcommand("check", "Measure how projector and camera work together");
    sub->callback([this, make = addCheckOptions(sub)] { make_ = make; });
  }

  void addCalibrate() {
    CLI::App* sub = app_.add_subcommand("calibrate", "Measure a venue into a new calibration");
    sub->callback([this, make = addCalibrateOptions(sub)] { make_ = make; });
  }

  void addResume() {
    auto command = std::make_shared<Resume>();
    CLI::App* sub = add("resume", "Go on with an interrupted calibration", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    addCache(sub, command->cache);
  }

  void addVerify() {
    auto command = std::make_shared<Verify>();
    CLI::App* sub =
        add("verify", "Photograph test patterns and say whether a calibration still holds", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--out", command->settings.out, "Folder for maps of what has changed, OpenEXR; created")
        ->type_name("DIR");
    addCache(sub, command->cache);
    sub->footer("Exit status: 0 still good, 3 re-measure, 4 start again; 1, 2 and 130 as ever.");
  }

  void addProve() {
    auto command = std::make_shared<Prove>();
    ProveSettings& settings = command->settings;
    CLI::App* sub =
        add("prove", "Project a picture, photograph it, and compare it with what was wanted and predicted",
            command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--image", settings.image, "Content: PNG, JPEG or TIFF (sRGB), or EXR (linear)")
        ->type_name("FILE")
        ->required();
    sub->add_option("--method", settings.method, "How to compensate")
        ->check(CLI::IsMember(methodNames()))
        ->type_name("METHOD")
        ->capture_default_str();
    sub->add_option("--shown", settings.shown,
                    "Prove this instead, one picture a projector: what stands on its display, pixel by pixel")
        ->type_name("FILE");
    sub->add_option("--out", settings.out, "Folder for the photographs, before and after, and comparison.png")
        ->type_name("DIR")
        ->required();
    addTarget(sub, settings.target);
    addCache(sub, command->cache);
  }

  void addImport() {
    auto command = std::make_shared<ImportPictures>();
    CLI::App* sub =
        add("import", "Make a calibration out of patterns and photographs taken elsewhere", command);
    addFolder(sub, command->calibration, "Folder of the calibration; created");
    sub->add_option("--patterns", command->settings.patterns,
                    "Folder of what was projected, in the projector's own pixels")
        ->type_name("DIR")
        ->required();
    sub->add_option("--photographs", command->settings.photographs,
                    "Folder of the photographs, linear, paired with the patterns in the order of their names")
        ->type_name("DIR")
        ->required();
    sub->add_option("--hold-out", command->settings.import.holdOutEvery,
                    "Every so manieth pattern is kept out of the fit and predicted instead")
        ->type_name("N")
        ->capture_default_str();
  }

  void addPlan() {
    auto command = std::make_shared<Plan>();
    PatternPlanSettings& settings = command->settings;
    CLI::App* sub =
        add("plan", "Write patterns to be photographed without a connection, for import", command);
    sub->add_option("--export", command->out,
                    "Folder for the pictures, plan.json and instructions.txt; created")
        ->type_name("DIR")
        ->required();
    addSize(sub, "--projector", settings.projector, "Size of the projector")->required();
    sub->add_option("--levels", settings.rampLevels, "Levels of each colour's ramp")
        ->type_name("N")
        ->capture_default_str();
    sub->add_option("--random", settings.randomPatterns,
                    "Random patterns, blocks of 1, 2, 4, 8 pixels in turn")
        ->type_name("N")
        ->capture_default_str();
    sub->add_option("--seed", settings.seed, "Seed of the random patterns")
        ->type_name("N")
        ->capture_default_str();
  }

  void addCompensate() {
    auto command = std::make_shared<Compensate>();
    CompensateSettings& settings = command->settings;
    CLI::App* sub =
        add("compensate", "Compute the pattern that makes the surface look like an image", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--image", settings.image, "Content: PNG, JPEG or TIFF (sRGB), or EXR (linear)")
        ->type_name("FILE")
        ->required();
    sub->add_option("--method", settings.method, "How to compensate")
        ->check(CLI::IsMember(methodNames()))
        ->type_name("METHOD")
        ->capture_default_str();
    sub->add_option(
           "--solver", settings.solver,
           "How optimum is found: fista, spectral (Barzilai-Borwein), descent (the paper's five steps), "
           "dense (small scale)")
        ->check(CLI::IsMember({"fista", "spectral", "descent", "dense"}))
        ->type_name("SOLVER")
        ->capture_default_str();
    sub->add_option("--out", settings.out, "Folder for pattern.png, pattern.exr, target.exr, predicted.exr")
        ->type_name("DIR")
        ->required();
    addTarget(sub, settings.target);
  }

  void addEvaluate() {
    auto command = std::make_shared<Evaluate>();
    CLI::App* sub =
        add("evaluate", "Compare the methods through the true transport of a simulated venue", command);
    addFolder(sub, command->calibration, "Folder of the calibration of a simulated venue");
    sub->add_option("--image", command->settings.images, "Content; may be given several times")
        ->type_name("FILE");
    sub->add_option("--method", command->settings.methods, "Only these methods; may be given several times")
        ->check(CLI::IsMember(methodNames()))
        ->type_name("METHOD");
    addTarget(sub, command->settings.target);
    addCache(sub, command->cache);
  }

  void addExport() {
    auto command = std::make_shared<Export>();
    CLI::App* sub = add("export", "Write the measurement for other programs", command, [command] {
      for (const std::string& problem : problems(command->settings))
        throw WrongUsage(problem + ": give --transport, --leaves, --inverse or --maps");
    });
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--transport", command->settings.transport,
                    "T for scipy.sparse.load_npz: BSR, 3x3 blocks, rows = camera pixels")
        ->type_name("FILE.npz");
    sub->add_option("--leaves", command->settings.leaves,
                    "T as it is kept: a column for every node of the projector's mean pyramid")
        ->type_name("FILE.npz");
    sub->add_option("--inverse", command->settings.inverse, "Its inverse, in the same form")
        ->type_name("FILE.npz");
    sub->add_option("--maps", command->settings.maps, "Black level, flood image and masks as OpenEXR")
        ->type_name("DIR");
  }

  void addRelight(const char* name, const char* sentence, bool dual) {
    auto command = std::make_shared<Relight>();
    command->dual = dual;
    CLI::App* sub = add(name, sentence, command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    CLI::Option* image =
        sub->add_option("--image", command->settings.image,
                        dual ? "Light from the camera; all white if it is left out" : "The pattern")
            ->type_name("FILE");
    if (!dual) image->required();
    sub->add_option("--out", command->settings.out, "Result: .exr (linear) or .png")
        ->type_name("FILE")
        ->required();
  }

  void addSeparate() {
    auto command = std::make_shared<Separate>();
    CLI::App* sub = add("separate", "Tell direct from indirect light", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--image", command->settings.image, "The pattern; all white if it is left out")
        ->type_name("FILE");
    sub->add_option("--reach", command->settings.direct.reach,
                    "How far direct light spreads, as a share of the projector's larger side")
        ->type_name("SHARE")
        ->capture_default_str();
    sub->add_option("--out", command->settings.out, "Folder for direct and indirect, .exr and .png")
        ->type_name("DIR")
        ->required();
  }

  void addDifference() {
    auto command = std::make_shared<Difference>();
    DifferenceSettings& settings = command->settings;
    CLI::App* sub = add("difference", "Show how two pictures differ, with enhanced contrast", command);
    sub->add_option("A", settings.first, "A picture: PNG, JPEG or TIFF (sRGB), or EXR (linear)")->required();
    sub->add_option("B", settings.second, "What is subtracted from it; of the same size")->required();
    sub->add_option_function<std::string>(
           "--gain", [&settings](const std::string& text) { settings.gain = parseGain(text); },
           "Factor of the difference; auto uses the whole contrast of a .png")
        ->type_name("auto|N")
        ->default_str("auto");
    sub->add_option("--out", settings.out, "Result: .exr (gain * (A - B)) or .png (that around grey)")
        ->type_name("FILE")
        ->required();
  }

  void addReport() {
    auto command = std::make_shared<Report>();
    CLI::App* sub = add("report", "Write one HTML file about a calibration", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    sub->add_option("--out", command->settings.out,
                    "The file; report.html in the calibration if it is left out")
        ->type_name("FILE");
    sub->add_option("--image", command->settings.images, "Content to show; may be given several times")
        ->type_name("FILE");
    sub->add_flag("!--no-evaluate", command->settings.evaluate, "Leave out the comparison of methods");
    CLI::Option* bundle =
        sub->add_option(
               "--bundle", command->settings.bundle,
               "Also this .zip for whoever helps: report, settings, versions; nothing shows the venue")
            ->type_name("FILE");
    sub->add_flag("--photographs", command->settings.photographs, "With pictures of the venue in the bundle")
        ->needs(bundle);
    sub->add_option("--attach", command->settings.attachments, "A file to put into the bundle, a log")
        ->type_name("FILE")
        ->needs(bundle);
    addCache(sub, command->cache);
  }

  void addBench() {
    CLI::App* sub = app_.add_subcommand("bench", "Time the parts that decide how fast everything is");
    sub->callback([this, make = addBenchOptions(sub)] { make_ = make; });
  }

  /// "auto" is nothing.
  static std::optional<double> parseGain(const std::string& text) {
    if (text == "auto") return std::nullopt;
    char* end = nullptr;
    double gain = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0')
      throw WrongUsage(fmt::format("'{}' is no gain: write auto or a number, like 1.75", text));
    return gain;
  }

  static std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const MethodDescription& method : methodDescriptions) names.emplace_back(method.name);
    return names;
  }

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
  bool json_ = false;
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

}  // namespace relucent
