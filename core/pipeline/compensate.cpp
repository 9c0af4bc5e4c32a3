// SPDX-License-Identifier: MIT
#include <chrono>

#include "base/error.h"
#include "base/file.h"
#include "compensation/methods.h"
#include "image/color.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "image/picture_files.h"
#include "pipeline/measured_venue.h"
#include "pipeline/pipeline.h"
#include "pipeline/projection.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

constexpr const char* radianceUnits = "camera signal per second";
constexpr const char* driveUnits = "linear projector drive";

/// "pattern.exr" for the only or first device, "pattern-2.exr" for the second.
fs::path numbered(const fs::path& folder, const std::string& stem, std::size_t device,
                  const std::string& extension) {
  std::string number = device == 0 ? "" : fmt::format("-{}", device + 1);
  return folder / (stem + number + extension);
}

/// Writes the images that compensation makes, remembering their names.
class Writer {
 public:
  explicit Writer(fs::path folder) : folder_(std::move(folder)) { createFolder(folder_); }

  void writeLinear(const std::string& stem, const Stack& stack, const Rasters& rasters, const char* units) {
    for (std::size_t device = 0; device < rasters.devices(); ++device) {
      fs::path path = numbered(folder_, stem, device, ".exr");
      writeExr(path, imageFromStack(stack, rasters, device), ExrType::floatType,
               {{exr_attribute::units, std::string(units)}});
      files_.push_back(path);
    }
  }

  void writeDrive(const std::string& stem, const std::vector<Image>& drive) {
    for (std::size_t device = 0; device < drive.size(); ++device) {
      fs::path path = numbered(folder_, stem, device, ".png");
      writePng(path, drive[device], 8);
      files_.push_back(path);
    }
  }

  /// A picture to look at: as somebody sees it who is used to `white`.
  void writeViewed(const std::string& stem, const Stack& stack, const Rasters& rasters,
                   const std::array<float, 3>& white) {
    for (std::size_t device = 0; device < rasters.devices(); ++device) {
      fs::path path = numbered(folder_, stem, device, ".png");
      writePng(path, viewed(imageFromStack(stack, rasters, device), white), 8);
      files_.push_back(path);
    }
  }

  const std::vector<fs::path>& files() const { return files_; }

 private:
  fs::path folder_;
  std::vector<fs::path> files_;
};

}  // namespace

CompensateResult compensate(const fs::path& path, const CompensateSettings& settings, Progress& progress) {
  if (std::vector<std::string> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(), "change that setting and start again");
  Image content = readLinearContent(settings.image);
  Method method = methodFromName(settings.method).value();

  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
  Progress loading = progress.part(0.4, "Reading the calibration");
  MeasuredCalibration measured = loadCalibration(folder, loading);
  const MeasuredVenue& venue = measured.venue;

  Target target = fitTarget(content, venue, settings.target);
  Compensator compensator(venue, measured.inverse);
  Progress solving = progress.part(0.5, "Compensating");
  auto begin = std::chrono::steady_clock::now();
  Compensation compensation = compensator.solve(method, target, solving);

  CompensateResult result;
  result.method = settings.method;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.clipped = compensation.clipped;

  Stack predicted = venue.transport.apply(compensation.projector);
  for (std::size_t i = 0; i < predicted.size(); ++i) predicted[i] += venue.black[i];
  const Rasters& cameras = venue.transport.cameras();
  std::size_t pixels = cameras.size(0).count();
  std::size_t inside = 0;
  std::size_t reachable = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    inside += target.inside[i] != 0;
    reachable += target.reachable[i] != 0;
  }
  if (reachable == 0)
    throw Error(ErrorKind::input, "no part of the picture can be shown in this venue",
                "make the content darker, or place it where the projector reaches", settings.image.string());
  result.reachable = static_cast<double>(reachable) / static_cast<double>(inside);
  result.psnrPredicted =
      psnr(imageFromStack(predicted, cameras, 0), imageFromStack(target.wanted, cameras, 0), target.white,
           std::span<const std::uint8_t>(target.reachable.data(), pixels));

  Progress writing = progress.part(0.1, "Writing the results");
  const Rasters& projectors = venue.transport.projectors();
  Writer writer(settings.out);
  writer.writeDrive("pattern", encodedDrive(compensation.projector, projectors, measured.linearization));
  writer.writeLinear("pattern", compensation.projector, projectors, driveUnits);
  writer.writeLinear("target", target.wanted, cameras, radianceUnits);
  writer.writeLinear("predicted", predicted, cameras, radianceUnits);
  writer.writeViewed("target", target.wanted, cameras, target.white);
  writer.writeViewed("predicted", predicted, cameras, target.white);
  result.files = writer.files();
  progress.report(1.0);
  return result;
}

}  // namespace relucent
