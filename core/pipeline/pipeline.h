// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "acquisition/acquisition.h"
#include "acquisition/import.h"
#include "acquisition/pattern_plan.h"
#include "acquisition/reverification.h"
#include "base/progress.h"
#include "compensation/direct_light.h"
#include "compensation/method.h"
#include "compensation/methods.h"
#include "compensation/target.h"
#include "engine/bench/engine_bench.h"
#include "engine/fallback_backend.h"
#include "inverse/windows.h"
#include "linearization/linearization.h"
#include "pipeline/versions.h"
#include "rig/rig.h"
#include "venue/venue.h"

/// What can be done with a calibration, one function a deed: what the command line calls, and the window too.
/// All of them work on a calibration folder (core/calibration/calibration_folder.h), report to a Progress,
/// and throw Error for failures of the world and Cancelled when asked to stop. Results that a document on
/// standard output shows are turned into JSON by json.h.
namespace relucent {

/// External programs as devices: anybody's camera by script.
/// {image} in the projector's command is the file to show; {exposure} in the camera's command is the time
/// in seconds, {output} the file to write (float EXR, 16-bit PNG or TIFF, or 8-bit).
struct CommandRigSettings {
  std::string projectorCommand;
  std::string cameraCommand;
  Size projector;
  std::optional<Size> camera;      // none: the size of the first photograph
  double shortestExposure = 1e-3;  // seconds
  double longestExposure = 4.0;    // seconds
  /// A camera that Relucent drives itself, by its address (devices/device_address.h), in place of the
  /// camera's command and exposures.
  std::string cameraAddress{};
  double latency = 0.0;  // seconds from the end of the projector's command until its picture is out
  std::string record{};  // folder for all that is shown and photographed (devices/recording.h); empty: none
  /// Pictures a second of the projector: exposures become whole pictures (devices/whole_frames.h). 0: as they
  /// are asked for.
  double frameRate = 0.0;
};

/// A screen of the desktop as projector, and any camera by its address. Opened by whoever has windows
/// (pipeline/devices.h).
struct ScreenRigSettings {
  /// What the screen is known by after it was unplugged: its maker's names where it tells them, else where it
  /// is plugged in.
  struct Display {
    std::string connector;  // "HDMI-1"
    std::string manufacturer, model, serialNumber;
    bool operator==(const Display&) const = default;
  };
  Display display;
  Size projector;                  // the screen's own pixels
  double frameRate = 60.0;         // pictures a second: exposures are whole pictures
  std::string cameraAddress{};     // devices/device_address.h; empty: not chosen yet
  std::optional<Size> camera{};    // none: all that it has
  double shortestExposure = 1e-3;  // seconds; of external programs, which cannot be asked
  double longestExposure = 4.0;
  double latency = 0.0;  // seconds from the swap until the picture is out; 0: measured at the step Camera
};

/// A recording in place of devices (devices/recording.h).
struct ReplayRigSettings {
  std::string folder;
};

/// No devices: patterns and photographs of them that were taken elsewhere.
struct ImportedRigSettings {
  Size projector;  // of the patterns
  Size camera;     // of the photographs
  int pictures = 0;
  std::string patterns;  // folders that they were read from
  std::string photographs;
  std::string fingerprint;  // of all pictures' files
};

/// How the rig is made: a simulated venue, external programs, a screen of the desktop, a recording, or none
/// at all.
using RigSettings = std::variant<VenueSettings, CommandRigSettings, ImportedRigSettings, ReplayRigSettings,
                                 ScreenRigSettings>;

/// What is shown in a calibrated venue, and how.
struct ContentSettings {
  std::string picture;                // a file; empty: the product's own
  std::string method = "refined";     // a name from methodDescriptions
  double reachablePercentile = 15.0;  // as TargetSettings
  double blackLift = 0.0;
  Fit fit = Fit::fit;
  std::optional<Corners> corners;  // as TargetSettings

  bool operator==(const ContentSettings&) const = default;
};
std::vector<std::string> problems(const ContentSettings& settings);
/// How content is fitted that was decided on so.
TargetSettings targetOf(const ContentSettings& settings);

struct CalibrateSettings {
  RigSettings rig;
  LinearizationSettings linearization;
  AcquisitionSettings acquisition;
  ThresholdSettings threshold;  // none by default: every leaf that was measured counts
  WindowSettings windows;
  bool chooseRidge = true;  // windows.ridge is where the search for the best one starts
  ClusteringSettings clustering = CompensatorSettings().clustering;  // of the cluster maps
  ContentSettings content;
};
/// Sentences about what cannot be; sizes outside 8x8 to 8192x8192 among them.
std::vector<std::string> problems(const CalibrateSettings& settings);

struct CalibrateResult {
  int patterns = 0;   // shown, all stages
  int exposures = 0;  // photographed, all stages
  struct Seconds {    // wall time of each stage, earlier runs of a resumed calibration included
    double linearization = 0.0;
    double acquisition = 0.0;
    double inverse = 0.0;
  } seconds;
  std::uint64_t connections = 0;  // camera pixel - projector pixel pairs that T connects, expanded
  std::uint64_t leaves = 0;       // blocks stored
  double unresolvedEnergy = 0.0;  // share of the flood image that no leaf explains
  double flaggedShare = 0.0;      // share of camera pixels that verification found wrong
  double verificationError = 0.0;
  std::uint64_t peakMemoryBytes = 0;
  std::vector<std::string> findings;  // sentences of all stages
};

/// Measures a venue into a new calibration folder. A simulated venue's transport is kept in `cache`.
/// Interrupted at any instant, the folder can be resumed.
/// Stop and keep: ends acquisition after the level under way and goes on with that.
/// Throws: Error{input} if `folder` already holds a calibration or anything else; Error{device, input, disk}.
CalibrateResult calibrate(const std::filesystem::path& folder, const CalibrateSettings& settings,
                          const std::filesystem::path& cache, Progress& progress);
/// The same with somebody to ask when a sentinel finds something wrong while the light transport is measured
/// (acquisition/alarm.h); with nobody, that is Error{device}, and resume() goes on from what is safe.
CalibrateResult calibrate(const std::filesystem::path& folder, const CalibrateSettings& settings,
                          const std::filesystem::path& cache, const AlarmHandler& handler,
                          Progress& progress);

/// Goes on where an interrupted calibration stopped, with the settings it was begun with. A finished one is
/// reported as it is. Ends in the same bits as an uninterrupted run.
CalibrateResult resume(const std::filesystem::path& folder, const std::filesystem::path& cache,
                       Progress& progress);
CalibrateResult resume(const std::filesystem::path& folder, const std::filesystem::path& cache,
                       const AlarmHandler& handler, Progress& progress);

struct VerifySettings {
  std::filesystem::path out;       // folder for maps as EXR; created; empty: none
  std::optional<RigSettings> rig;  // none: the calibration's own; others must have its sizes
};
std::vector<std::string> problems(const VerifySettings& settings);

struct VerifyResult {
  Judgement judgement;
  Reverification found;
  double errorThen = 0.0;  // of the same patterns when T was measured
  double seconds = 0.0;    // reading and preparing not included
  std::vector<std::filesystem::path> files;
};

/// Whether T still predicts the venue: photographs black and the held-out patterns again, ten shots or so,
/// and compares them (acquisition/reverification.h). Changes nothing in the calibration. Writes into `out`,
/// a file a camera: residual-1-1.exr to residual-8-1.exr (block size; root mean square of measured less
/// predicted, camera signal per second) and changed-1.exr (1 where a pixel changed).
/// Throws: Error{input} if the calibration is not finished, was imported, or has other sizes than the
/// devices; Error{device, disk}; Cancelled.
VerifyResult verifyCalibration(const std::filesystem::path& folder, const VerifySettings& settings,
                               const std::filesystem::path& cache, Progress& progress);
/// The same with devices that somebody has open already.
VerifyResult verifyCalibration(const std::filesystem::path& folder, const VerifySettings& settings, Rig& rig,
                               Progress& progress);

struct ImportPicturesSettings {
  std::filesystem::path patterns;  // folder of pictures: what was projected, in the projector's own pixels
  /// Folder of pictures: linear signals, one for each pattern; JPEG is decoded by the curve of sRGB. Raw
  /// files give the sensor's own values at half its size; of a photograph that is there twice the raw file
  /// counts.
  std::filesystem::path photographs;
  ImportSettings import;
};
std::vector<std::string> problems(const ImportPicturesSettings& settings);

struct ImportResult {
  int patterns = 0;
  int fitted = 0;
  int heldOut = 0;
  HeldOutError error;  // on held-out patterns, normalised root mean square
  Size projector;
  Size camera;
  std::uint64_t leaves = 0;
  double flaggedShare = 0.0;
  double seconds = 0.0;
  std::uint64_t peakMemoryBytes = 0;
  std::vector<std::string> findings;
};

/// A new calibration out of patterns and photographs taken elsewhere, paired in the order of their names, or
/// in the order in which raw files were taken (photograph_sequence.h); files that are no pictures are passed
/// over. Nothing is written before everything is computed. Throws:
/// Error{input} if the folders hold different numbers of pictures or pictures of different sizes, if `folder`
/// holds anything already, or as importTransport(); Error{disk, format} for unreadable files.
ImportResult importPictures(const std::filesystem::path& folder, const ImportPicturesSettings& settings,
                            Progress& progress);

struct CompensateSettings {
  std::filesystem::path image;     // content, sRGB file or linear EXR
  std::string method = "refined";  // a name from methodDescriptions
  std::string solver = "fista";    // of `optimum`: a name of SolverSettings::Algorithm
  TargetSettings target;
  std::filesystem::path out;  // folder; created; files of the same names are replaced
};
std::vector<std::string> problems(const CompensateSettings& settings);

struct CompensateResult {
  std::string method;
  double psnrPredicted = 0.0;  // dB, prediction against target where reachable
  double clipped = 0.0;        // share of drive values at 0 or 1
  double reachable = 0.0;      // share of the content's camera pixels
  double seconds = 0.0;        // solving alone
  std::vector<std::filesystem::path> files;
  double deltaE = 0.0;  // mean CIEDE2000, prediction against target over the whole content
  std::map<std::string, double> uncorrectable{};  // reason -> share of the content's pixels
};

/// Computes the pattern that makes the venue look like an image, and what the camera should then see.
/// Writes pattern.png (8-bit drive), pattern.exr (linear), target.exr, predicted.exr (camera signal per
/// second), target.png, predicted.png (to look at), delta_e.exr (CIEDE2000) and uncorrectable.exr, .png (the
/// number of its reason a pixel, see Uncorrectable; colours) into `out`.
CompensateResult compensate(const std::filesystem::path& folder, const CompensateSettings& settings,
                            Progress& progress);

struct EvaluateSettings {
  std::vector<std::filesystem::path> images;  // none: the product's own test pictures
  std::vector<std::string> methods;           // none: all of them
  TargetSettings target;
  CompensatorSettings compensator;
};
std::vector<std::string> problems(const EvaluateSettings& settings);

/// How well one method did on one image, through the venue's true transport.
struct MethodScore {
  std::string method;
  double psnrReachable = 0.0;  // dB, linear light, peak = the target's white
  double psnrAll = 0.0;
  double ssim = 0.0;
  double deltaE = 0.0;   // mean CIEDE2000
  double seconds = 0.0;  // for one frame
};

struct ImageScore {
  std::string name;
  double reachable = 0.0;  // share of this image's pixels
  std::vector<MethodScore> methods;
};

/// How well T itself was measured; relative errors.
struct TransportScore {
  double frobenius = 0.0;
  double rowMedian = 0.0;
  double rowP95 = 0.0;
  double relightNatural = 0.0;
  double relightRandom = 0.0;
  double energy = 0.0;  // of T 1 over the truth's; 1: all light, and none twice
};

struct EvaluateResult {
  std::string venue;
  Size projector;
  Size camera;
  double reachable = 0.0;  // mean over images
  TransportScore transport;
  std::vector<ImageScore> images;
};

/// Compares every method through the true transport of the simulated venue that was calibrated.
/// Throws: Error{input} if the calibration is of a real venue: its truth is not known.
EvaluateResult evaluate(const std::filesystem::path& folder, const EvaluateSettings& settings,
                        const std::filesystem::path& cache, Progress& progress);

struct ExportSettings {
  std::filesystem::path transport;  // T as SciPy BSR, 3x3 blocks, expanded to pixels; empty: not wanted
  std::filesystem::path leaves;   // T as it is kept: a column for every node of the projectors' mean pyramids
  std::filesystem::path inverse;  // the inverse operator, SciPy BSR, 3x3 blocks; empty: not wanted
  std::filesystem::path maps;     // folder for black, flood, reachability, flags as EXR; empty: not wanted
  std::uint64_t mostBytes = std::uint64_t{2} << 30;  // of `transport`, see expandedToPixels()
};
std::vector<std::string> problems(const ExportSettings& settings);

/// Files that a deed wrote.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes{};  // sentences that whoever reads the files should know
};

/// Writes the measured data for other programs.
WrittenFiles exportCalibration(const std::filesystem::path& folder, const ExportSettings& settings,
                               Progress& progress);

struct RelightSettings {
  std::filesystem::path image;  // relight: linear projector pattern or sRGB file; dual: light from the camera
  std::filesystem::path out;    // EXR (linear) or PNG
};
std::vector<std::string> problems(const RelightSettings& settings);

/// What the camera sees under a pattern, e included: T p + e. The image is scaled to the projector's size.
WrittenFiles relight(const std::filesystem::path& folder, const RelightSettings& settings,
                     Progress& progress);

/// Dual photography: the venue as the projector would see it, lit from the camera: T^T c. No image: all
/// white.
WrittenFiles dual(const std::filesystem::path& folder, const RelightSettings& settings, Progress& progress);

struct SeparateSettings {
  std::filesystem::path image;  // the pattern whose light is separated; empty: all white
  std::filesystem::path out;    // folder; created; files of the same names are replaced
  DirectLightSettings direct;
};
std::vector<std::string> problems(const SeparateSettings& settings);

struct SeparateResult {
  double directShare = 0.0;  // of all light in the picture
  std::vector<std::filesystem::path> files;
};

/// Direct and indirect light at the scale of the projector's pixels, out of T: D p and (T - D) p, e in
/// neither, D as directPart() says. Writes direct and indirect as .exr (camera signal per second) and .png
/// (to look at, under one white) into `out`.
SeparateResult separate(const std::filesystem::path& folder, const SeparateSettings& settings,
                        Progress& progress);

struct DifferenceSettings {
  std::filesystem::path first;
  std::filesystem::path second;  // of the same size
  std::filesystem::path out;     // EXR: gain * (first - second); PNG: that around grey
  /// None: PNG as much as shows all but the largest half percent of the differences, EXR 1.
  std::optional<double> gain;
};
std::vector<std::string> problems(const DifferenceSettings& settings);

struct DifferenceResult {
  double rms = 0.0;       // of the difference of linear values
  double relative = 0.0;  // norm of the difference over that of the second picture
  double gain = 1.0;      // that was applied
  std::vector<std::filesystem::path> files;
};

/// Two pictures' difference in linear light with enhanced contrast (paper, fig. 2 d and g): what compensation
/// changed, or a prediction against a photograph. Values are compared as they are, unscaled.
/// Throws: Error{input} if the sizes differ or values are not finite; as readPicture().
DifferenceResult pictureDifference(const DifferenceSettings& settings, Progress& progress);

/// Writes the patterns of planPatterns() as numbered PNG files for cameras that nothing connects to the
/// projector, with plan.json (what each is) and instructions.txt (how to photograph them). The folder can be
/// given to importPictures() as it is.
/// Throws: Error{input} if `out` holds pictures already; Error{disk}; Cancelled.
WrittenFiles exportPlan(const PatternPlanSettings& settings, const std::filesystem::path& out,
                        Progress& progress);

struct ReportSettings {
  std::filesystem::path out;                  // the HTML file; empty: report.html in the calibration folder
  std::vector<std::filesystem::path> images;  // content shown before and after; none: the product's own
  bool evaluate = true;          // simulated venues: a table of methods through the true transport
  std::filesystem::path bundle;  // a .zip for whoever helps, support_bundle.h; empty: none
  bool photographs = false;      // also what shows the venue is in that
  std::vector<std::filesystem::path> attachments;  // files put into that, where they exist: logs
  std::vector<LibraryVersion> libraries;           // named in the report; none: core's
};

/// One self-contained HTML file about a calibration, see report.h.
WrittenFiles report(const std::filesystem::path& folder, const ReportSettings& settings,
                    const std::filesystem::path& cache, Progress& progress);

struct Benchmark {
  std::string name;
  double seconds = 0.0;      // one run
  double bytes = 0.0;        // memory traffic of one run that cannot be avoided
  double shareOfCopy = 0.0;  // bytes / seconds / the machine's copy bandwidth
  double best = 0.0;         // of the engine: the shortest run, by which its shares are counted
  std::vector<EngineBenchRatio> timesAsFastAs{};  // of the engine: other programs with the same operator
};

struct BenchResult {
  struct Machine {
    std::string processor;
    int threads = 0;
    double copyBytesPerSecond = 0.0;
    std::string device;  // what the engine ran on; empty: not the engine was timed
  } machine;
  std::vector<Benchmark> benchmarks;
  std::vector<std::string> notes{};  // what could not be timed, and why
};

/// Times the parts that decide how fast everything else is. `name`: only those that contain it; empty: all.
/// Throws: Error{input} if no benchmark has such a name, naming what there is.
BenchResult bench(const std::string& name, Progress& progress);

/// Times the real-time engine, see benchEngine(const EngineBenchSettings&, Progress&): at 1024x768 / 640x480
/// beside other programs' products, and without them at 1920x1080 / 1632x1224 where the memory is enough. The
/// copy bandwidth is that of the device. Throws: Error{device} if OpenGL was asked for and there is none.
BenchResult benchEngine(BackendChoice backend, Progress& progress);

}  // namespace relucent
