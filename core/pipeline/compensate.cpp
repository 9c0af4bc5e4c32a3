// SPDX-License-Identifier: MIT
#include "relucent/pipeline/compensate.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/contradiction.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/compensation/uncorrectable.h"
#include "relucent/image/colour.h"
#include "relucent/image/colour_map.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/pictures.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/sets.h"

namespace relucent::pipeline {
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
      image::writeExr(path, image::imageFromStack(stack, rasters, device), image::ExrType::floatType,
                      {{image::exr_attribute::units, std::string(units)}});
      files_.push_back(path);
    }
  }

  void writeDrive(const std::string& stem, const std::vector<image::Image>& drive) {
    for (std::size_t device = 0; device < drive.size(); ++device) {
      fs::path path = numbered(folder_ / (stem + ".png"), device);
      image::writePng(path, drive[device], 8);
      files_.push_back(path);
    }
  }

  /// A picture to look at: as somebody sees it who is used to its white.
  void writeViewed(const std::string& stem, const CameraStack& stack, const compensation::Target& target,
                   const Rasters& cameras) {
    for (std::size_t device = 0; device < cameras.devices(); ++device) {
      fs::path path = numbered(folder_ / (stem + ".png"), device);
      image::writePng(path, image::viewed(underEvenWhite(stack, target, cameras, device), target.white), 8);
      files_.push_back(path);
    }
  }

  /// One image of a camera.
  void writeMap(const std::string& stem, const image::Image& map, const char* units) {
    files_.push_back(folder_ / (stem + ".exr"));
    image::writeExr(files_.back(), map, image::ExrType::floatType,
                    {{image::exr_attribute::units, std::string(units)}});
  }
  /// Of every camera, the colours up to a contradiction that nobody overlooks.
  void writeContradiction(const std::string& stem, const std::vector<image::Image>& worse) {
    constexpr double plain = 10.0;
    for (std::size_t camera = 0; camera < worse.size(); ++camera) {
      writeMap(numbered(stem, camera).string(), worse[camera], "CIEDE2000");
      writeColours(numbered(stem, camera).string(),
                   image::painted(worse[camera], image::ColourMap::cividis, 0.0, plain));
    }
  }
  void writeColours(const std::string& stem, const image::Image& encoded) {
    files_.push_back(folder_ / (stem + ".png"));
    image::writePng(files_.back(), encoded, 8);
  }

  const std::vector<fs::path>& files() const { return files_; }

 private:
  fs::path folder_;
  std::vector<fs::path> files_;
};

/// Reasons as colours that also differ in brightness: what can be corrected is grey, what is not asked for
/// black.
image::Image reasonColours(const std::vector<compensation::Uncorrectable>& map, Size size) {
  constexpr std::array<std::array<float, 3>, compensation::allReasons.size()> colours{{{0.55f, 0.55f, 0.55f},
                                                                                       {0.0f, 0.0f, 0.0f},
                                                                                       {0.25f, 0.15f, 0.35f},
                                                                                       {0.1f, 0.35f, 0.65f},
                                                                                       {0.15f, 0.7f, 0.5f},
                                                                                       {0.85f, 0.45f, 0.1f},
                                                                                       {1.0f, 0.95f, 0.45f}}};
  image::Image picture(size, 3);
  for (std::size_t i = 0; i < picture.pixels(); ++i)
    std::copy_n(colours[static_cast<std::size_t>(map[i])].begin(), 3, picture.pixel(i).begin());
  return picture;
}

image::Image reasonNumbers(const std::vector<compensation::Uncorrectable>& map, Size size) {
  image::Image numbers(size, 1);
  for (std::size_t i = 0; i < numbers.pixels(); ++i) numbers.data()[i] = static_cast<float>(map[i]);
  return numbers;
}

}  // namespace

CompensateResult compensate(const fs::path& path, const CompensateSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  image::Image content = image::readLinearContent(settings.image);

  const calibration::CalibrationFolder folder = openWithSet(path, settings.set);
  Progress loading =
      progress.part(0.4, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading, Held::allMeasured);
  const compensation::MeasuredVenue& venue = measured.venue;

  compensation::Target target = fitTarget(content, venue, targetIn(folder, settings.set, settings.target));
  compensation::CompensatorSettings compensatorSettings;
  compensatorSettings.optimum = compensation::defaultsOf(settings.solver);
  compensation::Compensator compensator(venue, measured.inverse, compensatorSettings);
  Progress solving = progress.part(0.5, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
  Stopwatch watch;
  compensation::Compensation compensation = compensator.solve(settings.method, target, solving);

  CompensateResult result;
  result.method = settings.method;
  result.seconds = watch.seconds();

  compensation::Prediction prediction = compensation::predict(venue, target, compensation);
  if (prediction.reachable == 0.0)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("compensation.nothing-reachable",
                                         "no part of the picture can be shown in this venue"),
                RELUCENT_ENGLISH_MESSAGE("compensation.darken-or-move-content",
                                         "make the content darker, or place it where the projector reaches"),
                settings.image.string());
  result.clipped = prediction.clipped;
  result.reachable = prediction.reachable;
  result.psnrPredicted = prediction.psnrReachable;
  result.deltaE = prediction.meanDeltaE;
  const bool hasSeveralViews = venue.transport.cameras().devices() > 1;
  compensation::Contradiction contradiction;
  if (hasSeveralViews) {
    Progress comparing =
        progress.part(0.02, RELUCENT_MESSAGE("stage.comparing-views", "Comparing what the views want"));
    contradiction = contradictionOf(compensator, target, compensation, comparing);
    result.contradiction = {contradiction.share, contradiction.shares};
  }
  result.notes = viewNotes(venue, target, contradiction);
  const compensation::ExpectedError expected =
      expectedError(venue, measured.acquisition.variance, target, compensation.projector);
  if (expected.isKnown()) result.expectedError = expected.shareOverall();
  Progress explaining = progress.part(
      0.03, RELUCENT_MESSAGE("stage.finding-uncorrectable-pixels", "Looking for what cannot be corrected"));
  std::vector<compensation::Uncorrectable> reasons =
      compensation::uncorrectableMap(venue, target, {}, explaining);
  auto shares = compensation::sharesOf(reasons);
  for (compensation::Uncorrectable reason : compensation::allReasons)
    if (reason != compensation::Uncorrectable::none && reason != compensation::Uncorrectable::outside)
      result.uncorrectable.emplace(reason, shares[static_cast<std::size_t>(reason)]);

  Progress writing = progress.part(0.05, RELUCENT_MESSAGE("stage.writing-results", "Writing the results"));
  const Rasters &cameras = venue.transport.cameras(), &projectors = venue.transport.projectors();
  Writer writer(settings.out);
  writer.writeDrive("pattern", encodedDrive(compensation.projector, projectors, measured.linearization));
  writer.writeLinear("pattern", compensation.projector, projectors, driveUnits);
  writer.writeLinear("target", target.wanted, cameras, radianceUnits);
  writer.writeLinear("predicted", prediction.camera, cameras, radianceUnits);
  writer.writeViewed("target", target.wanted, target, cameras);
  writer.writeViewed("predicted", prediction.camera, target, cameras);
  writer.writeMap("delta_e", prediction.deltaE, "CIEDE2000");
  writer.writeMap("uncorrectable", reasonNumbers(reasons, cameras.size(0)), "number of the reason");
  writer.writeColours("uncorrectable", reasonColours(reasons, cameras.size(0)));
  if (hasSeveralViews) writer.writeContradiction("contradiction", contradiction.worse);
  if (expected.isKnown()) writer.writeLinear("expected_error", expected.radiance, cameras, radianceUnits);
  result.files = writer.files();
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
