// SPDX-License-Identifier: MIT
#include "relucent/pipeline/relight.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/pictures.h"
#include "relucent/pipeline/projection.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

/// What relighting starts from, whichever way the light goes.
struct Opened {
  std::optional<image::Image> content;  // none: all white
  compensation::MeasuredVenue venue;
};

Opened opened(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("settings.name-output-file", "name the file to write"));
  pictureFormatOf(settings.out);
  Opened result;
  if (!settings.image.empty()) result.content = image::readLinearContent(settings.image);
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::read);
  result.venue = loadMeasuredVenue(folder, progress);
  return result;
}

}  // namespace

WrittenFiles relight(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  auto [content, venue] = opened(path, settings, progress);

  const Rasters& projectors = venue.transport.projectors();
  ProjectorStack pattern(projectors.count() * 3, 1.0f);
  if (content) pattern = ProjectorStack(patternFrom(*content, projectors));
  for (float& value : pattern) value = std::clamp(value, 0.0f, 1.0f);
  Stack relit = venue.transport.apply(pattern);
  for (std::size_t i = 0; i < relit.size(); ++i) relit[i] += venue.black[i];
  return writePictures(settings.out, relit, venue.transport.cameras(), "camera signal per second");
}

WrittenFiles dual(const fs::path& path, const RelightSettings& settings, Progress& progress) {
  auto [content, venue] = opened(path, settings, progress);

  const Rasters& cameras = venue.transport.cameras();
  CameraStack light(cameras.count() * 3, 1.0f);
  if (content) light = CameraStack(patternFrom(*content, cameras));
  return writePictures(settings.out, venue.transport.applyTransposed(light), venue.transport.projectors(),
                       "camera signal per second and linear projector drive");
}

}  // namespace relucent::pipeline
