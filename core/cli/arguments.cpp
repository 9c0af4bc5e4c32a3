// SPDX-License-Identifier: MIT
#include "cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>

#ifndef RELUCENT_VERSION
#define RELUCENT_VERSION "development"
#endif

namespace relucent {
namespace {

constexpr const char* programName = "relucent-cli";

/// The parser with the places that its options fill. Each add...() defines one subcommand and says how its
/// command is made once the options are read.
class Parser {
 public:
  Parser() {
    app_.name(programName);
    app_.require_subcommand(1);
    app_.fallthrough();
    app_.set_version_flag("--version", std::string("relucent-cli ") + RELUCENT_VERSION, "Print the version");
    app_.set_help_flag("-h,--help", "Print this help");
    app_.add_flag("--json", json_, "Print one JSON document on standard output and nothing else");
    app_.footer(
        "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n"
        "Try it with no devices at all:  relucent-cli calibrate demo --venue corner");
    addVenues();
    addCalibrate();
    addResume();
    addCompensate();
    addEvaluate();
    addExport();
    addRelight("relight", "Predict what the camera sees under a pattern", false);
    addRelight("dual", "Show the venue as the projector sees it, lit from the camera", true);
    addReport();
    addBench();
  }

  Arguments parse(const std::vector<std::string>& arguments) {
    try {
      app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them so
      return {make_(), json_};
    } catch (const CLI::CallForVersion& version) {
      return {PrintText{std::string(version.what()) + "\n"}, false};
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

  static CLI::Option* addFolder(CLI::App* sub, std::filesystem::path& folder, const char* what) {
    return sub->add_option("CALIBRATION", folder, what)->required();
  }

  static void addCache(CLI::App* sub, std::filesystem::path& cache) {
    cache = defaultCache();
    sub->add_option("--cache", cache, "Folder where simulated venues are kept once they are traced")
        ->type_name("DIR")
        ->capture_default_str();
  }

  static CLI::Option* addSize(CLI::App* sub, const char* name, Size& size, const char* what) {
    return sub
        ->add_option_function<std::string>(
            name, [&size](const std::string& text) { size = parseSize(text); }, what)
        ->type_name("WxH");
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
    sub->add_option("--dark-share", target.reachablePercentile,
                    "Percent of the pixels that may be too dark to show white: more is brighter")
        ->type_name("PERCENT")
        ->capture_default_str();
    sub->add_option("--black-lift", target.blackLift, "Share of white added to black")
        ->type_name("SHARE")
        ->capture_default_str();
  }

  void addVenues() { add("venues", "List the simulated venues", std::make_shared<ListVenues>()); }

  void addCalibrate();
  void addResume() {
    auto command = std::make_shared<Resume>();
    CLI::App* sub = add("resume", "Go on with an interrupted calibration", command);
    addFolder(sub, command->calibration, "Folder of the calibration");
    addCache(sub, command->cache);
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
    addCache(sub, command->cache);
  }

  void addBench() {
    auto command = std::make_shared<Bench>();
    CLI::App* sub = add("bench", "Time the parts that decide how fast everything is", command);
    sub->add_option("NAME", command->name, "Only benchmarks with this in their name");
  }

  static std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const MethodDescription& method : methods()) names.push_back(method.name);
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

void Parser::addCalibrate() {
  struct Places {
    VenueSettings venue;
    CommandRigSettings commands;
    Size projector{256, 192};
    Size camera{160, 120};
    std::uint64_t seed = 1;
  };
  auto command = std::make_shared<Calibrate>();
  auto places = std::make_shared<Places>();
  CalibrateSettings& settings = command->settings;

  CLI::App* sub = app_.add_subcommand("calibrate", "Measure a venue into a new calibration");
  addFolder(sub, command->calibration, "Folder of the calibration; created");
  CLI::Option* venue = sub->add_option("--venue", places->venue.name, "A simulated venue, see `venues`")
                           ->type_name("NAME")
                           ->capture_default_str();
  CLI::Option* projector =
      addSize(sub, "--projector", places->projector, "Size of the projector")->default_str("256x192");
  CLI::Option* camera =
      addSize(sub, "--camera", places->camera, "Size of the camera")->default_str("160x120");
  sub->add_option("--seed", places->seed, "Seed of everything random: the same seed gives the same bits")
      ->type_name("N")
      ->capture_default_str();
  // Before all that changes single settings: a mode sets all of them.
  sub->add_option_function<std::string>(
         "--acquisition",
         [&settings](const std::string& mode) { settings.acquisition = acquisitionMode(mode); },
         "How the light transport is measured: adaptive; sen, the reference; fast, a first look")
      ->check(CLI::IsMember(acquisitionModes()))
      ->type_name("MODE")
      ->default_str("adaptive");
  sub->add_option_function<std::string>(
         "--colour",
         [&settings](const std::string& colour) {
           settings.acquisition.colours = colour == "white" ? LitColours::white : LitColours::rgb;
         },
         "Colours that are lit: red, green and blue in turn (rgb) or at once (white); fast lights white")
      ->check(CLI::IsMember({"rgb", "white"}))
      ->type_name("MODE");
  sub->add_flag("--mirrored", settings.acquisition.mayBeMirrored,
                "Pictures are meant to appear mirrored: rear projection, a mirror");
  sub->add_option("--threshold", settings.acquisition.relativeThreshold,
                  "Faintest light that is followed, as a share of the flood image: 0.006 fine, 0.02 fast")
      ->type_name("SHARE")
      ->capture_default_str();
  sub->add_option("--levels", settings.linearization.levels, "Levels measured per projector colour")
      ->type_name("N")
      ->capture_default_str();
  addCache(sub, command->cache);

  CLI::Option_group* real = sub->add_option_group("External programs", "Any projector and camera by script");
  CLI::Option* show =
      real->add_option("--projector-command", places->commands.projectorCommand,
                       "Command that shows the file {image} and returns when the light is out");
  CLI::Option* photograph =
      real->add_option("--camera-command", places->commands.cameraCommand,
                       "Command that photographs {exposure} seconds into the file {output}");
  show->type_name("CMD");
  photograph->type_name("CMD");
  real->add_option("--shortest", places->commands.shortestExposure, "Shortest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();
  real->add_option("--longest", places->commands.longestExposure, "Longest exposure of the camera")
      ->type_name("SECONDS")
      ->capture_default_str();

  DeviceModelSettings& devices = places->venue.devices;
  CLI::Option_group* simulated = sub->add_option_group("Simulated devices", "Imperfections to rehearse with");
  auto simulate = [&](const char* name, auto& value, const char* what) {
    simulated->add_option(name, value, what)->capture_default_str();
  };
  simulate("--paths", places->venue.pathsPerPixel, "Light paths traced for each camera pixel");
  simulate("--projector-bits", devices.projectorBits, "Bits of the projector's drive values");
  simulate("--camera-bits", devices.cameraBits, "Bits of the camera");
  simulate("--contrast", devices.contrast, "White of the projector over its black");
  simulate("--ambient", devices.ambient, "Room light, as a share of the mean flood image");
  simulate("--drift", devices.drift, "Relative change of the lamp over 1000 photographs");
  simulate("--flicker", devices.flicker, "Relative deviation of the lamp between photographs");
  simulate("--camera-gamma", devices.cameraGamma, "Response of the camera; 1 is linear");
  simulated->add_flag("--white-segment", devices.whiteSegment, "White is brighter than red + green + blue");

  auto external = [=] {
    if (show->count() + photograph->count() == 0) return false;
    if (show->count() == 0 || photograph->count() == 0 || projector->count() == 0)
      throw WrongUsage("external programs need --projector-command, --camera-command and --projector");
    if (venue->count() > 0) throw WrongUsage("give --venue or external programs, not both");
    for (const CLI::Option* option : simulated->get_options())
      if (option->count() > 0) throw WrongUsage(option->get_name() + " is for simulated venues only");
    return true;
  };
  sub->callback([this, command, places, external, camera] {
    make_ = [command, places, external, camera] {
      if (external()) {
        places->commands.projector = places->projector;
        if (camera->count() > 0) places->commands.camera = places->camera;
        command->settings.rig = places->commands;
      } else {
        places->venue.projector = places->projector;
        places->venue.camera = places->camera;
        places->venue.seed = places->seed;
        command->settings.rig = places->venue;
      }
      command->settings.linearization.seed = places->seed;
      command->settings.acquisition.seed = places->seed;
      return Command(*command);
    };
  });
}

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
