// SPDX-License-Identifier: MIT
#include "relucent/pipeline/repair.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/compensation/methods.h"
#include "relucent/compensation/prediction.h"
#include "relucent/image/picture_files.h"
#include "relucent/inverse/prepared_windows.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/kept_windows.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/moved_content.h"
#include "relucent/pipeline/not_finished.h"
#include "relucent/pipeline/projection_photographs.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

using calibration::CalibrationFolder;
using calibration::Stage;

// Something that passes by is gone at the third try; what is not has to be put right.
constexpr int mostAlarms = 3;
// A change of e or of the light that nobody sees, as shares of the mean flood and of the light itself.
constexpr double leastAmbient = 0.0005, leastLight = 0.01;
// Photographs tell pictures apart from this on: a fiftieth of what is wrong with its colours, or a tenth of a
// decibel.
constexpr double betterDeltaE = 0.98, betterPsnr = 0.1;
// Test patterns are predicted better: half of their error is gone.
constexpr double betterPrediction = 0.5;
// Light of the room alone from this on, of full light: two L* of black. It is photographed as it is, and
// weighs more on darker pictures than on the one that is proved: any gain of that one is enough.
constexpr double leastRoom = 0.002;

/// Goes back over what was disturbed, until it has been disturbed too often.
class Patience {
 public:
  sentinels::Answer operator()(const sentinels::Alarm& alarm) {
    if (++alarms_ <= mostAlarms) return sentinels::Answer::retry;
    throw Error(ErrorKind::device, alarm.what,
                RELUCENT_ENGLISH_MESSAGE("repair.alarm-advice",
                                         "{}; then repair once more, the calibration is as it was")
                    .with(alarm.advice));
  }

 private:
  int alarms_ = 0;
};

double strongest(const transport::ColourBlock& light, const std::function<double(double)>& of) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < light.size(); ++i) most = std::max(most, of(light.data()[i]));
  return most;
}

/// What follows from a change that is told already is not told again.
std::vector<Message> sentencesOf(const acquisition::VenueChange& change) {
  std::vector<Message> what;
  for (std::size_t camera = 0; camera < change.moved.size(); ++camera) {
    const sentinels::Movement &view = change.moved[camera], &picture = change.pictures[camera];
    if (view.explains)
      what.push_back(
          RELUCENT_MESSAGE("repair.camera-moved",
                           "the view of camera {} has moved by {} and {} pixels and turned by {} degrees")
              .with(as::label(camera + 1), as::number(view.x, as::decimals(1)),
                    as::number(view.y, as::decimals(1)), as::number(view.degrees, as::decimals(2))));
    if (picture.explains)
      what.push_back(
          RELUCENT_MESSAGE("repair.picture-moved",
                           "the projected picture has moved by {} and {} pixels as camera {} sees it")
              .with(as::number(picture.x, as::decimals(1)), as::number(picture.y, as::decimals(1)),
                    as::label(camera + 1)));
  }
  const bool isMoved = !what.empty();
  for (std::size_t projector = 0; projector < change.light.size(); ++projector) {
    const transport::ColourBlock& light = change.light[projector];
    if (strongest(light, [](double left) { return std::abs(left - 1.0); }) < leastLight) continue;
    what.push_back(RELUCENT_MESSAGE("repair.light-changed",
                                    "projector {} gives {} % of the red, {} % of the green and {} % of the "
                                    "blue light that it gave")
                       .with(as::label(projector + 1),
                             as::share(static_cast<double>(light(0, 0)), as::decimals(0)),
                             as::share(static_cast<double>(light(1, 1)), as::decimals(0)),
                             as::share(static_cast<double>(light(2, 2)), as::decimals(0))));
  }
  if (std::abs(change.ambient) >= leastAmbient)
    what.push_back(change.ambient > 0.0
                       ? RELUCENT_MESSAGE("repair.room-brighter",
                                          "the room is brighter by {} % of the projectors' full light")
                             .with(as::share(change.ambient, as::decimals(2)))
                       : RELUCENT_MESSAGE("repair.room-darker",
                                          "the room is darker by {} % of the projectors' full light")
                             .with(as::share(-change.ambient, as::decimals(2))));
  if (isMoved) return what;
  if (change.scaled > acquisition::RenewalSettings().measuredFrom)
    what.push_back(RELUCENT_MESSAGE("repair.surface-changed",
                                    "{} % of what the cameras see is brighter, darker or of another colour "
                                    "than it was")
                       .with(as::share(change.scaled, as::decimals(1))));
  if (what.empty() && change.wrong > acquisition::RenewalSettings().measuredFrom)
    what.push_back(RELUCENT_MESSAGE("repair.light-elsewhere",
                                    "in {} % of the cameras' pixels light arrives otherwise than it did")
                       .with(as::share(change.wrong, as::decimals(1))));
  return what;
}

image::Image provedPicture(const RepairSettings& settings, const ContentSettings& content) {
  if (!settings.image.empty()) return image::readLinearContent(settings.image);
  std::error_code code;
  if (!content.picture.empty() && fs::is_regular_file(content.picture, code))
    return image::readLinearContent(content.picture);
  return standardImages().front().linear;
}

/// In no view worse; and in one better, or what is photographed is predicted much better: of a lamp that gave
/// way everywhere alike the picture tells nothing.
bool isBetter(const RepairResult& result) {
  const bool isRoomAlone = result.what.size() == 1 && std::abs(result.change.ambient) >= leastRoom;
  bool any = result.errorAfter < betterPrediction * result.errorBefore;
  for (std::size_t view = 0; view < result.after.size(); ++view) {
    const PictureError &now = result.after[view], &then = result.before[view];
    if (now.deltaE > then.deltaE / betterDeltaE || now.psnr < then.psnr - betterPsnr) return false;
    any = any || now.deltaE < betterDeltaE * then.deltaE || now.psnr > then.psnr + betterPsnr ||
          (isRoomAlone && now.deltaE < then.deltaE && now.psnr > then.psnr);
  }
  return any;
}

double secondsOfDevices(const rig::ShotTimes& times) {
  return times.showing + times.capturing;
}

/// What a repair will store, on the disk before it is known whether it will.
class Prepared {
 public:
  /// Keeps for store() what fails: where nothing is stored in the end, nothing has to be written.
  Prepared(const fs::path& calibration, const transport::Acquisition& acquisition,
           const MeasuredCalibration& now, const inverse::WindowSettings& windows) {
    try {
      calibration::prepareAcquisition(acquisition_.emplace(calibration), acquisition);
      prepareWindows(windows_.emplace(calibration), now.venue, windows, now.inverse);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  void store(CalibrationFolder& folder, const std::string& inputs, const transport::Acquisition& acquisition,
             const calibration::StageCost& cost, const calibration::RepairNote& note) const {
    if (failure_) std::rethrow_exception(failure_);
    calibration::storeAcquisition(folder, inputs, acquisition, cost, note, &acquisition_.value());
    keepWindows(folder, windows_.value());
  }

 private:
  std::optional<calibration::PreparedFiles> acquisition_, windows_;
  std::exception_ptr failure_;
};

/// A calibration while it is repaired.
class Repairing {
 public:
  Repairing(const fs::path& path, const RepairSettings& settings, RigSource source, Progress& progress)
      : path_(path), settings_(settings), source_(std::move(source)) {
    const CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::read);
    chosen_ = settingsOf(folder);
    Progress loading =
        progress.part(0.15, RELUCENT_MESSAGE("stage.reading-calibration", "Reading the calibration"));
    const auto stored = calibration::currentResultOf(folder, Stage::acquisition);
    // What is measured anew would be mixed with what is repaired.
    if (!stored) throw notFinished(path);
    measured_ = loadCalibration(folder, former_, loading);
    formerFolder_ = stored->folder.filename().string();
    inputs_ = stored->inputs;
    cost_ = calibration::resultFrom<Stage::acquisition>(*stored).cost.value_or(calibration::StageCost());
    correction_ = fingerprintOfCorrection(folder);
    Progress opening =
        progress.part(0.1, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
    rig_ = &source_.open(settings.rig.value_or(measured_.rig), former_.transport, folder, opening);
  }

  RepairResult run(Progress& progress) {
    Stopwatch watch;
    rig::NoShotLog log;
    rig::ShotTaker shots(*rig_, log, "repair");
    Progress renewing =
        progress.part(0.5, RELUCENT_MESSAGE("stage.looking-for-changes", "Looking for what has changed"));
    acquisition::Renewal renewal =
        acquisition::renew({shots, measured_.linearization, chosen_.acquisition, Patience()}, former_,
                           settings_.renewal, renewing);
    RepairResult result;
    result.change = renewal.change;
    result.what = sentencesOf(renewal.change);
    result.errorThen = former_.verificationError;
    result.errorBefore = renewal.errorBefore;
    result.errorAdapted = renewal.errorAdapted;
    result.errorAfter = renewal.errorAfter;
    result.measured = renewal.measured;
    result.exposures = shots.exposures();
    result.photographing = secondsOfDevices(shots.times());
    if (!result.what.empty()) {
      Progress proving = progress.part(
          0.2, RELUCENT_MESSAGE("stage.photographing-projections", "Photographing the projections"));
      const MeasuredCalibration now = renewed(renewal.acquisition, proving);
      const image::Image shown = provedPicture(settings_, chosen_.content),
                         own = provedPicture({}, chosen_.content);
      calibration::ContentResult predicted = prove(shown, renewal.acquisition, now, result, proving);
      result.end = isBetter(result) ? RepairEnd::repaired : RepairEnd::notBetter;
      result.seconds = watch.seconds();
      if (result.end == RepairEnd::repaired) {
        // What is kept of the content is of its own picture, whichever was photographed.
        if (shown != own) {
          const compensation::Target target = targetOfNow(own, now, result.change);
          predicted = predictedOf(now, target, solved(now, target, proving));
        }
        Progress writing =
            progress.part(0.05, RELUCENT_MESSAGE("stage.writing-results", "Writing the results"));
        writing.report(0.0);
        commit(renewal.acquisition, now, result, predicted);
      }
    }
    result.seconds = watch.seconds();
    progress.report(1.0);
    return result;
  }

 private:
  /// As it will be read, of what the photographs tell. Windows of what has not changed stay.
  MeasuredCalibration renewed(const transport::Acquisition& acquisition, Progress& progress) const {
    MeasuredCalibration now;
    now.rig = measured_.rig;
    now.reductions = measured_.reductions;
    now.linearization = measured_.linearization;
    RenewedVenue renewed = renewedVenueOf(acquisition, chosen_.threshold, measured_.venue);
    now.venue = std::move(renewed.venue);
    Progress inverting = progress.part(
        0.4, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
    now.ridge = measured_.ridge;
    now.inverse = inverse::renewWindows(measured_.inverse, renewed.changed, now.venue.transport,
                                        now.venue.usable, windows(), inverting);
    return now;
  }

  inverse::WindowSettings windows() const {
    inverse::WindowSettings windows = chosen_.windows;
    windows.ridge = measured_.ridge;
    return windows;
  }

  /// Where it stood on the surface.
  ContentSettings moved(const ContentSettings& content, const image::Image& picture,
                        const MeasuredCalibration& now, const acquisition::VenueChange& change) const {
    const double aspect = static_cast<double>(picture.width()) / picture.height();
    return movedContent(content, aspect, measured_.venue, now.venue, change.moved);
  }

  /// A picture as it is wanted where it stood, under the light of now.
  compensation::Target targetOfNow(const image::Image& picture, const MeasuredCalibration& now,
                                   const acquisition::VenueChange& change) const {
    return fitTarget(picture, now.venue, targetOf(moved(chosen_.content, picture, now, change)));
  }

  compensation::Compensation solved(const MeasuredCalibration& by, const compensation::Target& target,
                                    Progress& progress) const {
    compensation::CompensatorSettings solver;
    solver.clustering = chosen_.clustering;
    Progress solving = progress.part(0.2, RELUCENT_MESSAGE("stage.compensating", "Compensating"));
    solving.report(0.0);
    return compensation::Compensator(by.venue, by.inverse, solver)
        .solve(chosen_.content.method, target, solving);
  }

  static calibration::ContentResult predictedOf(const MeasuredCalibration& now,
                                                const compensation::Target& target,
                                                const compensation::Compensation& picture) {
    const compensation::Prediction predicted = compensation::predict(now.venue, target, picture);
    return {predicted.reachable, predicted.meanDeltaE};
  }

  /// The same picture as a show has it by the former T and by the new one, both photographed and compared
  /// with what can be wanted, where it stood, under the light of now. Returns what is predicted of it.
  calibration::ContentResult prove(const image::Image& content, const transport::Acquisition& acquisition,
                                   const MeasuredCalibration& now, RepairResult& result, Progress& progress) {
    compensation::Target target;
    compensation::Compensation renewedPicture, former;
    const auto solvePictures = [&] {
      target = targetOfNow(content, now, result.change);
      renewedPicture = solved(now, target, progress);
      former = solved(measured_, fitTarget(content, measured_.venue, targetOf(chosen_.content)), progress);
    };
    prepared_ = computeWhile(solvePictures,
                             [&] { return std::make_unique<Prepared>(path_, acquisition, now, windows()); });
    ProjectionPhotographs photographs(source_.whole(), now, "repair-proof");
    const Rasters& cameras = now.venue.transport.cameras();
    const auto seen = [&](const compensation::Compensation& picture) {
      const CameraStack radiance = photographs.of(picture.projector, progress).radiance;
      std::vector<PictureError> errors;
      for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
        const compensation::ViewError error = compensation::errorIn(camera, radiance, target, cameras);
        errors.push_back({error.psnrReachable, error.meanDeltaE});
      }
      return errors;
    };
    result.before = seen(former);
    result.after = seen(renewedPicture);
    result.exposures += photographs.exposures();
    result.photographing += secondsOfDevices(photographs.times());
    return predictedOf(now, target, renewedPicture);
  }

  void commit(const transport::Acquisition& renewed, const MeasuredCalibration& now,
              const RepairResult& result, const calibration::ContentResult& predicted) const {
    CalibrationFolder folder = CalibrationFolder::open(path_, CalibrationFolder::Access::write);
    if (fingerprintOfCorrection(folder) != correction_)
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("repair.changed-meanwhile",
                                           "another program changed the calibration while it was repaired"),
                  RELUCENT_ENGLISH_MESSAGE("repair.repair-again", "repair it once more"), path_.string());
    calibration::RepairNote note;
    note.of = formerFolder_;
    note.what = result.what;
    std::size_t least = 0;  // the view that gained least
    for (std::size_t view = 1; view < result.after.size(); ++view)
      if (result.before[view].deltaE - result.after[view].deltaE <
          result.before[least].deltaE - result.after[least].deltaE)
        least = view;
    note.deltaEBefore = result.before[least].deltaE;
    note.deltaEAfter = result.after[least].deltaE;
    note.psnrBefore = result.before[least].psnr;
    note.psnrAfter = result.after[least].psnr;
    note.cost = {result.seconds, renewed.patterns, result.exposures};
    note.contentBefore = contentSections(folder, [](const ContentSettings& content) { return content; });
    note.contentAfter = contentSections(folder, [&](const ContentSettings& content) {
      return moved(content, provedPicture({}, content), now, result.change);
    });
    const auto decided = calibration::resultOf(folder, Stage::content);
    if (decided) {
      note.predictedBefore = calibration::resultFrom<Stage::content>(*decided);
      note.predictedAfter = predicted;
    }
    prepared_->store(folder, inputs_, renewed, cost_, note);
    // Somebody placed it, and it stands there: nobody has to look at it for that.
    if (decided) calibration::storeDecision(folder, predicted);
  }

  fs::path path_;
  const RepairSettings& settings_;
  RigSource source_;
  rig::Rig* rig_ = nullptr;
  CalibrateSettings chosen_;
  MeasuredCalibration measured_;
  transport::Acquisition former_;
  std::string formerFolder_, inputs_, correction_;
  calibration::StageCost cost_;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace

RepairResult repairCalibration(const fs::path& path, const RepairSettings& settings, const fs::path& cache,
                               Progress& progress) {
  return Repairing(path, settings, RigSource(cache), progress).run(progress);
}

RepairResult repairCalibration(const fs::path& path, const RepairSettings& settings, rig::Rig& rig,
                               Progress& progress) {
  return Repairing(path, settings, RigSource(rig), progress).run(progress);
}

UndoneRepair undoRepair(const fs::path& path) {
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
  const auto present = calibration::currentResultOf(folder, Stage::acquisition);
  const auto repair = present ? calibration::resultFrom<Stage::acquisition>(*present).repair : std::nullopt;
  if (!repair)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("repair.nothing-to-undo", "the calibration was not repaired"),
                RELUCENT_ENGLISH_MESSAGE("repair.nothing-to-undo-advice",
                                         "there is nothing to go back to; it is used as it was measured"),
                path.string());
  std::error_code code;
  if (!fs::is_directory(present->folder.parent_path() / repair->of, code))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("repair.former-removed",
                                         "the measurement from before the repair has been removed"),
                RELUCENT_ENGLISH_MESSAGE("repair.former-removed-advice",
                                         "go on with the repaired one, or measure the venue again"),
                path.string());
  const auto content = calibration::resultOf(folder, Stage::content);
  calibration::setRepairAside(folder, *repair);
  // Nobody has placed it since.
  if (content && repair->predictedBefore &&
      calibration::resultFrom<Stage::content>(*content) == repair->predictedAfter)
    calibration::storeDecision(folder, *repair->predictedBefore);
  const auto former = calibration::currentResultOf(folder, Stage::acquisition);
  return {former ? former->stored : std::string()};
}

}  // namespace relucent::pipeline
