// SPDX-License-Identifier: MIT
#include "relucent/pipeline/prove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/colour.h"
#include "relucent/image/colour_map.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/photography/photographer.h"
#include "relucent/pipeline/aim.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/reduction/reduction.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr double brightestDeltaE = 20.0;           // of the maps: twice what nobody overlooks
constexpr int patchesAcross = 24, leastPatch = 4;  // of what is compared patch by patch; pixels
constexpr int gap = 4;                             // pixels between the pictures of the comparison

/// By one camera.
struct PhotographedView {
  ProvedProjection error;
  image::Image deltaE;
  sentinels::Movement moved;
};

struct Photographed {
  std::vector<PhotographedView> views;
  CameraStack camera;  // radiance
  image::Image whole;  // radiance, see wholePhotograph()
};

PictureError errorOf(const compensation::ViewError& seen) {
  return {seen.psnrReachable, seen.meanDeltaE};
}

/// In one camera's view.
double surpriseOf(const CameraStack& measured, const CameraStack& predicted,
                  const compensation::Target& target, const Rasters& cameras, std::size_t camera) {
  double apart = 0.0, light = 0.0;
  const std::size_t begin = 3 * cameras.offset(camera), end = begin + 3 * cameras.size(camera).count();
  for (std::size_t i = begin; i < end; ++i) {
    if (!target.inside[i / 3]) continue;
    double value = static_cast<double>(measured[i]), difference = value - static_cast<double>(predicted[i]);
    apart += difference * difference;
    light += value * value;
  }
  return light > 0.0 ? std::sqrt(apart / light) : 0.0;
}

/// See ProvedProjection.
void findWorstPatch(ProvedProjection& found, const CameraStack& measured, const CameraStack& predicted,
                    const compensation::Target& target, const Rasters& cameras, std::size_t camera) {
  const Size size = cameras.size(camera);
  const int side = std::max(leastPatch, size.width / patchesAcross);
  const Size patches{std::max(1, size.width / side), std::max(1, size.height / side)};
  const image::Image seen = underEvenWhite(measured, target, cameras, camera),
                     expected = underEvenWhite(predicted, target, cameras, camera);
  image::Image seenPatches(patches, 3), expectedPatches(patches, 3);
  std::vector<std::uint8_t> isSeen(patches.count(), 0);
  for (std::size_t patch = 0; patch < patches.count(); ++patch) {
    const Pixel place = pixelAt(patches, patch);
    int pixels = 0;
    std::array<double, 3> light{}, wanted{};
    for (int y = place.y * side; y < (place.y + 1) * side; ++y)
      for (int x = place.x * side; x < (place.x + 1) * side; ++x) {
        if (!target.inside[cameras.offset(camera) + indexOf(size, {x, y})]) continue;
        ++pixels;
        for (int c = 0; c < 3; ++c) {
          light[static_cast<std::size_t>(c)] += static_cast<double>(seen.at(x, y, c));
          wanted[static_cast<std::size_t>(c)] += static_cast<double>(expected.at(x, y, c));
        }
      }
    isSeen[patch] = 2 * pixels >= side * side;
    for (int c = 0; c < 3 && pixels > 0; ++c) {
      seenPatches.at(place.x, place.y, c) = static_cast<float>(light[static_cast<std::size_t>(c)] / pixels);
      expectedPatches.at(place.x, place.y, c) =
          static_cast<float>(wanted[static_cast<std::size_t>(c)] / pixels);
    }
  }
  const image::Image apart = image::deltaEMap(image::viewed(seenPatches, target.white),
                                              image::viewed(expectedPatches, target.white), isSeen);
  for (std::size_t patch = 0; patch < patches.count(); ++patch) {
    const auto value = static_cast<double>(apart.data()[patch]);
    if (std::isnan(value) || value <= found.worstPatch) continue;
    const Pixel place = pixelAt(patches, patch);
    found.worstPatch = value;
    found.worstPlace = {(place.x + 0.5) * side / size.width, (place.y + 0.5) * side / size.height};
  }
}

/// A pixel that saturates every exposure is no measurement: it counts in neither figure.
void leaveOut(compensation::Target& target, const hdr::HdrFrame& frame) {
  for (std::size_t i = 0; i < target.inside.size(); ++i) {
    if (frame.valid[3 * i] && frame.valid[3 * i + 1] && frame.valid[3 * i + 2]) continue;
    target.inside[i] = target.reachable[i] = 0;
  }
}

/// A projection, as the projectors are given it and as the light that this makes.
struct Projection {
  std::vector<image::Image> drive;
  compensation::Compensation light;
};

Projection projectionOf(compensation::Compensation light, const MeasuredCalibration& measured) {
  std::vector<image::Image> drive =
      encodedDrive(light.projector, measured.venue.transport.projectors(), measured.linearization);
  return {std::move(drive), std::move(light)};
}

Projection shownProjection(const std::vector<fs::path>& pictures, const MeasuredCalibration& measured) {
  const Rasters& projectors = measured.venue.transport.projectors();
  if (pictures.size() != projectors.devices())
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("proof.picture-count-differs",
                                         "{} pictures of what is shown are given for {} projectors")
                    .with(pictures.size(), projectors.devices()),
                RELUCENT_ENGLISH_MESSAGE("proof.give-picture-per-projector",
                                         "give one picture for each projector, in their order"));
  Projection result;
  for (std::size_t projector = 0; projector < pictures.size(); ++projector) {
    image::Picture picture = image::readPicture(pictures[projector]);
    // What is no display's pixels, floating-point values as `perfect` and `export` write them, is linear.
    image::Image drive = picture.bits > 0 ? std::move(picture.encoded)
                                          : measured.linearization.projectors[projector].encode(
                                                image::readLinearContent(pictures[projector]));
    Size size = projectors.size(projector);
    if (!(drive.size() == size))
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("proof.picture-size-differs",
                                   "what is shown has {} pixels, the projector {}")
              .with(as::size(drive.width(), drive.height()), as::size(size)),
          RELUCENT_ENGLISH_MESSAGE("proof.capture-projector-display-alone",
                                   "take the picture of the projector's display alone, at its own size"),
          pictures[projector].string());
    result.drive.push_back(std::move(drive));
  }
  result.light.projector = lightOf(result.drive, projectors, measured.linearization);
  return result;
}

/// As a show of this calibration has it; none: that picture was not perfected.
std::optional<compensation::Compensation> perfectedIn(const calibration::CalibrationFolder& folder,
                                                      const fs::path& file, Size picture,
                                                      const compensation::ContentCanvas& canvas,
                                                      const Rasters& projectors) {
  const std::optional<PerfectedPicture> kept =
      findPerfected(folder.path(), perfectedKeyOf(folder, file, picture, canvas));
  if (!kept) return std::nullopt;
  compensation::Compensation light;
  light.projector = driveOf(*kept, projectors);
  return light;
}

Photographed photograph(photography::Photographer& photographer, const MeasuredCalibration& measured,
                        compensation::Target target, const Projection& projection, const Progress& progress) {
  const Rasters& cameras = measured.venue.transport.cameras();
  const Rasters& projectors = measured.venue.transport.projectors();
  hdr::HdrFrame frame =
      photographer.takeAll(ProjectorStack(image::stackFromImages(projection.drive, projectors)), progress);
  leaveOut(target, frame);
  compensation::Prediction predicted = compensation::predict(measured.venue, target, projection.light);
  Photographed result;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    PhotographedView& view = result.views.emplace_back();
    view.error.surprise = surpriseOf(frame.radiance, predicted.camera, target, cameras, camera);
    findWorstPatch(view.error, frame.radiance, predicted.camera, target, cameras, camera);
    view.error.predicted = errorOf(compensation::errorIn(camera, predicted.camera, target, cameras));
    view.moved = aimOffset(image::imageFromStack(predicted.camera, cameras, camera),
                           image::imageFromStack(frame.radiance, cameras, camera),
                           std::numeric_limits<float>::infinity(),
                           comparedPixels(measured.venue.usable, frame, cameras, camera))
                     .movement;
    compensation::ViewError seen = compensation::errorIn(camera, frame.radiance, target, cameras);
    view.error.measured = errorOf(seen);
    view.deltaE = std::move(seen.deltaE);
  }
  result.camera = std::move(frame.radiance);
  return result;
}

/// The first camera's photograph of what is shown now, all that the camera delivers; empty where that is what
/// was measured with.
image::Image wholePhotograph(rig::Rig& rig, const MeasuredCalibration& measured, int number,
                             const Progress& progress) {
  if (measured.reductions.empty() || measured.reductions.front().isNothing()) return {};
  rig::Camera& camera = *rig.cameras.front();
  rig::Shot shot{{"whole", number}, {}, {}, measured.linearization.exposures};
  for (std::size_t exposure = 0; exposure < shot.exposuresAsked.size(); ++exposure) {
    progress.checkpoint();
    shot.frames.emplace_back().push_back(
        camera.capture({shot.id, static_cast<int>(exposure), shot.exposuresAsked[exposure]}));
    rig::checkFrame(shot.frames.back().front(), camera.size(), camera.name());
  }
  const hdr::CameraModel model =
      reduction::wholeModel(measured.reductions.front(), measured.linearization.cameras.front());
  const hdr::HdrFrame frame = hdr::mergeBracket(shot, {model}, Rasters(camera.size()));
  return image::imageFromStack(frame.radiance, Rasters(camera.size()), 0);
}

/// White as the camera itself sees it.
std::array<float, 3> wholeWhite(const compensation::Target& target, const MeasuredCalibration& measured) {
  std::array<float, 3> white = target.white;
  const std::array<float, 3> factor = reduction::wholeFromReduced(measured.reductions.front());
  for (std::size_t c = 0; c < 3; ++c) white[c] *= factor[c];
  return white;
}

/// Pictures of one size side by side, row by row; an empty one leaves its place dark.
image::Image sheet(const std::vector<std::vector<image::Image>>& rows, Size size) {
  int columns = static_cast<int>(rows.front().size()), lines = static_cast<int>(rows.size());
  image::Image result({columns * (size.width + gap) - gap, lines * (size.height + gap) - gap}, 3);
  for (int row = 0; row < lines; ++row)
    for (int column = 0; column < columns; ++column) {
      const image::Image& picture = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      if (picture.empty()) continue;
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          for (int c = 0; c < 3; ++c)
            result.at(column * (size.width + gap) + x, row * (size.height + gap) + y, c) =
                picture.at(x, y, c);
    }
  return result;
}

/// As one camera sees it.
std::vector<fs::path> writePictures(const fs::path& out, const compensation::Target& target,
                                    const Rasters& cameras, std::size_t camera, const Photographed& before,
                                    const Photographed& after) {
  createFolder(out);
  std::vector<fs::path> files;
  auto shown = [&](const char* name, const CameraStack& stack) {
    image::Image picture = image::viewed(underEvenWhite(stack, target, cameras, camera), target.white);
    files.push_back(proofPicture(out, name, camera, ".png"));
    image::writePng(files.back(), picture, 8);
    return picture;
  };
  auto measured = [&](const char* name, const Photographed& photographed) {
    const image::Image& deltaE = photographed.views[camera].deltaE;
    files.push_back(proofPicture(out, name, camera, ".exr"));
    image::writeExr(files.back(), image::imageFromStack(photographed.camera, cameras, camera),
                    image::ExrType::floatType,
                    {{image::exr_attribute::units, std::string("camera signal per second")}});
    files.push_back(proofPicture(out, name, camera, "_delta_e.exr"));
    image::writeExr(files.back(), deltaE, image::ExrType::floatType,
                    {{image::exr_attribute::units, std::string("CIEDE2000")}});
    return image::painted(deltaE, image::ColourMap::viridis, 0.0, brightestDeltaE);
  };
  std::vector<image::Image> pictures{shown("target", target.wanted), shown("before", before.camera),
                                     shown("after", after.camera)};
  std::vector<image::Image> maps{image::Image(), measured("before", before), measured("after", after)};
  files.push_back(proofPicture(out, "comparison", camera, ".png"));
  image::writePng(files.back(), sheet({pictures, maps}, cameras.size(camera)), 8);
  return files;
}

ProveResult proved(const fs::path& path, const ProveSettings& settings, RigSource source,
                   Progress& progress) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  image::Image content = image::readLinearContent(settings.image);
  const Size picture = content.size();
  if (settings.canvas) content = compensation::onCanvas(content, *settings.canvas);
  const calibration::CalibrationFolder folder = openWithSet(path, settings.set);
  Progress loading =
      progress.part(0.3, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
  MeasuredCalibration measured = loadCalibration(folder, loading, Held::allMeasured);
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  const transport::TransportMatrix& transport = measured.venue.transport;
  rig::Rig& rig = source.open(settings.rig.value_or(measured.rig), transport, folder, opening);

  compensation::Target target =
      fitTarget(content, measured.venue, targetIn(folder, settings.set, settings.target));
  compensation::CompensatorSettings solver;
  solver.clustering = settingsOf(folder).clustering;
  compensation::Compensator compensator(measured.venue, measured.inverse, solver);
  Progress solving = progress.part(0.2, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
  Projection plain = projectionOf(compensator.solve(compensation::Method::none, target, solving), measured);
  ProveResult result;
  const auto corrected = [&]() -> Projection {
    if (!settings.shown.empty()) return shownProjection(settings.shown, measured);
    std::optional<compensation::Compensation> perfected;
    if (settings.canvas)
      perfected = perfectedIn(folder, settings.image, picture, *settings.canvas, transport.projectors());
    result.perfected = perfected.has_value();
    return projectionOf(
        perfected ? std::move(*perfected) : compensator.solve(settings.method, target, solving), measured);
  };
  const Projection compensated = corrected();
  result.method = settings.method;
  const compensation::Prediction predicted = compensation::predict(measured.venue, target, compensated.light);
  result.reachable = predicted.reachable;
  if (result.reachable == 0.0)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("compensation.nothing-reachable",
                                         "no part of the picture can be shown in this venue"),
                RELUCENT_ENGLISH_MESSAGE("compensation.darken-or-move-content",
                                         "make the content darker, or place it where the projector reaches"),
                settings.image.string());

  Progress photographing = progress.part(
      0.25, RELUCENT_MESSAGE("stage.photographing-projections", "Photographing the projections"));
  Stopwatch watch;
  rig::NoShotLog log;
  rig::ShotTaker shots(rig, log, "prove");
  photography::Photographer photographer(shots, measured.linearization);
  Photographed before = photograph(photographer, measured, target, plain, photographing);
  before.whole = wholePhotograph(source.whole(), measured, 0, photographing);
  photographing.report(0.5);
  Photographed after = photograph(photographer, measured, target, compensated, photographing);
  after.whole = wholePhotograph(source.whole(), measured, 1, photographing);
  photographing.report(1.0);
  result.before = before.views.front().error;
  result.after = after.views.front().error;
  result.moved = before.views.front().moved;
  result.seconds = watch.seconds();
  result.exposures = shots.exposures();
  const Rasters& cameras = transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    if (camera > 0)
      result.others.push_back({before.views[camera].error, after.views[camera].error,
                               compensation::errorIn(camera, predicted.camera, target, cameras).reachable,
                               before.views[camera].moved});
    for (fs::path& file : writePictures(settings.out, target, cameras, camera, before, after))
      result.files.push_back(std::move(file));
  }
  for (const auto& [name, photographed] :
       {std::pair("before_whole", &before), std::pair("after_whole", &after)}) {
    if (photographed->whole.empty()) continue;
    result.files.push_back(settings.out / fmt::format("{}.png", name));
    image::writePng(result.files.back(), image::viewed(photographed->whole, wholeWhite(target, measured)), 8);
  }
  progress.report(1.0);
  return result;
}

}  // namespace

fs::path proofPicture(const fs::path& folder, const std::string& name, std::size_t camera,
                      const std::string& end) {
  return folder / (camera == 0 ? name + end : fmt::format("{}-{}{}", name, camera + 1, end));
}

ProvedView viewOf(const ProveResult& result, std::size_t camera) {
  require(camera <= result.others.size(), "camera {} of {}", camera, result.others.size() + 1);
  if (camera > 0) return result.others[camera - 1];
  return {result.before, result.after, result.reachable, result.moved};
}

double changedPatch(const ProvedView& view) {
  return std::min(view.before.worstPatch, view.after.worstPatch);
}

bool isAsPredicted(const ProvedView& view) {
  if (changedPatch(view) > plainPatch) return false;
  const double seen = view.after.measured.deltaE;
  const bool hasMoved = view.moved.explains && std::hypot(view.moved.x, view.moved.y) > plainShift;
  return seen <= 1.0 || (!hasMoved && seen <= 2.0 * view.after.predicted.deltaE);
}

bool isAsPredicted(const ProveResult& result) {
  return !viewThatDiffers(result).has_value();
}

std::optional<std::size_t> viewThatDiffers(const ProveResult& result) {
  for (std::size_t camera = 0; camera <= result.others.size(); ++camera)
    if (!isAsPredicted(viewOf(result, camera))) return camera;
  return std::nullopt;
}

ProveResult proveCalibration(const fs::path& path, const ProveSettings& settings, const fs::path& cache,
                             Progress& progress) {
  return proved(path, settings, RigSource(cache), progress);
}

ProveResult proveCalibration(const fs::path& path, const ProveSettings& settings, rig::Rig& rig,
                             Progress& progress) {
  return proved(path, settings, RigSource(rig), progress);
}

}  // namespace relucent::pipeline
