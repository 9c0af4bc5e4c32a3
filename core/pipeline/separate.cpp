// SPDX-License-Identifier: MIT
#include "relucent/pipeline/separate.h"

#include <algorithm>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/compensation/direct_light.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/pictures.h"
#include "relucent/pipeline/projection.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr const char* radianceUnits = "camera signal per second";

/// The two pictures of one camera, EXR and PNG. Both PNG share one white, so that they can be compared.
void writePair(const fs::path& folder, std::size_t camera, const image::Image& direct,
               const image::Image& indirect, WrittenFiles& written) {
  image::Image both = direct;
  for (std::size_t i = 0; i < both.data().size(); ++i) both.data()[i] += indirect.data()[i];
  float white = displayWhite(both);
  for (const char* extension : {".exr", ".png"}) {
    written.files.push_back(numbered(folder / (std::string("direct") + extension), camera));
    writePicture(written.files.back(), direct, radianceUnits, white);
    written.files.push_back(numbered(folder / (std::string("indirect") + extension), camera));
    writePicture(written.files.back(), indirect, radianceUnits, white);
  }
}

}  // namespace

std::vector<Message> problems(const SeparateSettings& settings) {
  std::vector<Message> found = problems(settings.direct);
  if (settings.out.empty())
    found.emplace_back(
        RELUCENT_ENGLISH_MESSAGE("settings.no-output-folder", "no folder for the results is given"));
  return found;
}

SeparateResult separate(const fs::path& path, const SeparateSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  std::optional<image::Image> content;
  if (!settings.image.empty()) content = image::readLinearContent(settings.image);
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  Progress loading =
      progress.part(0.7, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  compensation::MeasuredVenue venue = loadMeasuredVenue(folder, loading);

  const Rasters &projectors = venue.transport.projectors(), &cameras = venue.transport.cameras();
  ProjectorStack pattern(3 * projectors.count(), 1.0f);
  if (content) pattern = ProjectorStack(patternFrom(*content, projectors));
  for (float& value : pattern) value = std::clamp(value, 0.0f, 1.0f);
  Progress separating = progress.part(0.2, RELUCENT_MESSAGE("stage.separating-direct-and-indirect-light",
                                                            "Separating direct and indirect light"));
  CameraStack direct = compensation::directPart(venue.transport, settings.direct, separating).apply(pattern);
  CameraStack indirect = venue.transport.apply(pattern);
  double whole = 0.0, directLight = 0.0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    whole += static_cast<double>(indirect[i]);
    directLight += static_cast<double>(direct[i]);
    indirect[i] -= direct[i];
  }

  SeparateResult result;
  result.directShare = whole > 0.0 ? directLight / whole : 0.0;
  createFolder(settings.out);
  WrittenFiles written;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    writePair(settings.out, camera, image::imageFromStack(direct, cameras, camera),
              image::imageFromStack(indirect, cameras, camera), written);
  result.files = std::move(written.files);
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
