// SPDX-License-Identifier: MIT
#include "pipeline/compensate.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "compensation/methods.h"
#include "compensation/prediction.h"
#include "compensation/uncorrectable.h"
#include "image/colour.h"
#include "image/exr.h"
#include "image/picture_files.h"
#include "pipeline/measured_venue.h"
#include "pipeline/pictures.h"
#include "pipeline/projection.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

constexpr const char* radianceUnits = "camera signal per second";
constexpr const char* driveUnits = "linear projector drive";

/// Writes the images that compensation makes, remembering their names.
class Writer {
 public:
  explicit Writer(fs::path folder) : folder_(std::move(folder)) { createFolder(folder_); }

  void writeLinear(const std::string& stem, const Stack& stack, const Rasters& rasters, const char* units) {
    for (std::size_t device = 0; device < rasters.devices(); ++device) {
      fs::path path = numbered(folder_ / (stem + ".exr"), device);
      writeExr(path, imageFromStack(stack, rasters, device), ExrType::floatType,
               {{exr_attribute::units, std::string(units)}});
      files_.push_back(path);
    }
  }

  void writeDrive(const std::string& stem, const std::vector<Image>& drive) {
    for (std::size_t device = 0; device < drive.size(); ++device) {
      fs::path path = numbered(folder_ / (stem + ".png"), device);
      writePng(path, drive[device], 8);
      files_.push_back(path);
    }
  }

  /// A picture to look at: as somebody sees it who is used to `white`.
  void writeViewed(const std::string& stem, const Stack& stack, const Rasters& rasters,
                   const std::array<float, 3>& white) {
    for (std::size_t device = 0; device < rasters.devices(); ++device) {
      fs::path path = numbered(folder_ / (stem + ".png"), device);
      writePng(path, viewed(imageFromStack(stack, rasters, device), white), 8);
      files_.push_back(path);
    }
  }

  /// One image of the first camera.
  void writeMap(const std::string& stem, const Image& map, const char* units) {
    files_.push_back(folder_ / (stem + ".exr"));
    writeExr(files_.back(), map, ExrType::floatType, {{exr_attribute::units, std::string(units)}});
  }
  void writeColours(const std::string& stem, const Image& encoded) {
    files_.push_back(folder_ / (stem + ".png"));
    writePng(files_.back(), encoded, 8);
  }

  const std::vector<fs::path>& files() const { return files_; }

 private:
  fs::path folder_;
  std::vector<fs::path> files_;
};

/// Reasons as colours that also differ in brightness: what can be corrected is grey, what is not asked for
/// black.
Image reasonColours(const std::vector<Uncorrectable>& map, Size size) {
  constexpr std::array<std::array<float, 3>, allReasons.size()> colours{{{0.55f, 0.55f, 0.55f},
                                                                         {0.0f, 0.0f, 0.0f},
                                                                         {0.25f, 0.15f, 0.35f},
                                                                         {0.1f, 0.35f, 0.65f},
                                                                         {0.15f, 0.7f, 0.5f},
                                                                         {0.85f, 0.45f, 0.1f},
                                                                         {1.0f, 0.95f, 0.45f}}};
  Image picture(size, 3);
  for (std::size_t i = 0; i < picture.pixels(); ++i)
    std::copy_n(colours[static_cast<std::size_t>(map[i])].begin(), 3, picture.pixel(i).begin());
  return picture;
}

Image reasonNumbers(const std::vector<Uncorrectable>& map, Size size) {
  Image numbers(size, 1);
  for (std::size_t i = 0; i < numbers.pixels(); ++i) numbers.data()[i] = static_cast<float>(map[i]);
  return numbers;
}

}  // namespace

CompensateResult compensate(const fs::path& path, const CompensateSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("calibration.change-setting-start-again",
                                         "change that setting and start again"));
  Image content = readLinearContent(settings.image);

  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  Progress loading =
      progress.part(0.4, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading);
  const MeasuredVenue& venue = measured.venue;

  Target target = fitTarget(content, venue, settings.target);
  CompensatorSettings compensatorSettings;
  compensatorSettings.optimum = defaultsOf(settings.solver);
  Compensator compensator(venue, measured.inverse, compensatorSettings);
  Progress solving = progress.part(0.5, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
  Stopwatch watch;
  Compensation compensation = compensator.solve(settings.method, target, solving);

  CompensateResult result;
  result.method = settings.method;
  result.seconds = watch.seconds();

  Prediction prediction = predict(venue, target, compensation);
  if (prediction.reachable == 0.0)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.no-part-picture-can-shown",
                                         "no part of the picture can be shown in this venue"),
                RELUCENT_ENGLISH_MESSAGE("calibration.make-content-darker-place-projector",
                                         "make the content darker, or place it where the projector reaches"),
                settings.image.string());
  result.clipped = prediction.clipped;
  result.reachable = prediction.reachable;
  result.psnrPredicted = prediction.psnrReachable;
  result.deltaE = prediction.meanDeltaE;
  Progress explaining = progress.part(
      0.05, RELUCENT_MESSAGE("stage.finding-uncorrectable-pixels", "Looking for what cannot be corrected"));
  std::vector<Uncorrectable> reasons = uncorrectableMap(venue, target, {}, explaining);
  auto shares = sharesOf(reasons);
  for (Uncorrectable reason : allReasons)
    if (reason != Uncorrectable::none && reason != Uncorrectable::outside)
      result.uncorrectable.emplace(reason, shares[static_cast<std::size_t>(reason)]);

  Progress writing = progress.part(0.05, RELUCENT_MESSAGE("stage.writing-results", "Writing the results"));
  const Rasters &cameras = venue.transport.cameras(), &projectors = venue.transport.projectors();
  Writer writer(settings.out);
  writer.writeDrive("pattern", encodedDrive(compensation.projector, projectors, measured.linearization));
  writer.writeLinear("pattern", compensation.projector, projectors, driveUnits);
  writer.writeLinear("target", target.wanted, cameras, radianceUnits);
  writer.writeLinear("predicted", prediction.camera, cameras, radianceUnits);
  writer.writeViewed("target", target.wanted, cameras, target.white);
  writer.writeViewed("predicted", prediction.camera, cameras, target.white);
  writer.writeMap("delta_e", prediction.deltaE, "CIEDE2000");
  writer.writeMap("uncorrectable", reasonNumbers(reasons, cameras.size(0)), "number of the reason");
  writer.writeColours("uncorrectable", reasonColours(reasons, cameras.size(0)));
  result.files = writer.files();
  progress.report(1.0);
  return result;
}

}  // namespace relucent
