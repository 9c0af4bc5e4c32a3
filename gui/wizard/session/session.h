// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "jobs/failure.h"
#include "jobs/latest.h"
#include "jobs/live_rig.h"
#include "jobs/patient_camera.h"
#include "output/venue_use.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/check.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/kept_photographs.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/warm_up.h"
#include "relucent/venue/surprises.h"
#include "wizard/session/device_lease.h"
#include "wizard/session/step_name.h"

namespace relucent::gui {

/// How patiently real devices are checked.
struct CheckPatience {
  int mostFrames = 30;   // of the projector, until any picture is out
  int photographs = 24;  // of each flat field
};

/// The devices of the open calibration. Opened by the first work that needs them, used by one work at a time.
class SessionDevices {
 public:
  SessionDevices(pipeline::RigSettings settings, std::filesystem::path cache, std::shared_ptr<LiveRig> live,
                 pipeline::ScreenOpener screens, CheckPatience patience,
                 std::shared_ptr<venue::Surprises> surprises, pipeline::ProjectorWarmUp warmUp)
      : settings_(std::move(settings)),
        cache_(std::move(cache)),
        live_(std::move(live)),
        screens_(std::move(screens)),
        patience_(patience),
        surprises_(std::move(surprises)),
        warmUp_(std::move(warmUp)) {}

  /// Called on a worker's thread. Projectors on the network are switched on, and their light is waited for
  /// until it is steady, once while they are open. A camera must be seen to see a projector's screen before
  /// it is used, and each projector to be seen by one; where a camera sees none, other screens light up too,
  /// to tell which one it sees: see other_screens.h. Throws: as openRig(), ProjectorWarmUp and requireSeen();
  /// ScreenNotSeen.
  rig::Rig& open(Progress& progress);
  /// The same before anybody knows what the camera sees: for a first look through it.
  rig::Rig& openUnproved(Progress& progress);
  /// A first look through the camera of an open screen: white, at the exposures that are tried until one
  /// suits.
  void lookFirst(const Progress& progress);
  /// Of open screens: how long a picture takes, of several the slowest one's, waited for from now on, and how
  /// steady their light is. Called on a worker's thread.  Throws: as measureLatency() and checkLight().
  pipeline::RigCheck check(Progress& progress);
  /// Whether check() has something to say.
  bool hasScreen() const { return std::holds_alternative<pipeline::ScreenRigSettings>(settings_); }
  /// As it was measured earlier, seconds.
  void setLatency(double seconds);
  /// Photographs are waited for, or no longer. From any thread.
  CameraPatience& patience() const { return *waiting_; }
  /// Leaves the projector's screen to others until the next pattern.
  void rest();
  LiveRig& live() const { return *live_; }
  /// For whoever asks later: devices that are kept for it would stay in use.
  std::shared_ptr<LiveRig> sharedLive() const { return live_; }

 private:
  std::shared_ptr<devices::ScreenControl> screen() const;
  double unmeasuredLatency() const;
  rig::Rig& opened(Progress& progress);
  void prove(Progress& progress);
  void proveEach(const std::vector<rig::Projector*>& others, Progress& progress);
  pipeline::RigCheck checkOne(std::size_t projector, Progress& progress);

  pipeline::RigSettings settings_;
  std::filesystem::path cache_;
  std::shared_ptr<LiveRig> live_;
  std::shared_ptr<CameraPatience> waiting_ = std::make_shared<CameraPatience>();
  pipeline::ScreenOpener screens_;
  CheckPatience patience_;
  std::shared_ptr<venue::Surprises> surprises_;  // of simulated devices; nullptr: none
  pipeline::ProjectorWarmUp warmUp_;
  bool isWarm_ = false;
  std::mutex guard_;
  std::optional<pipeline::OpenedRig> opened_;
  devices::ScreenProof proof_;
  std::vector<std::size_t> watching_;  // per projector: the camera that was seen to see it
  // Held for an instant only: the interface asks for it while a worker opens the devices.
  mutable std::mutex screenGuard_;
  std::shared_ptr<devices::ScreenControl> screen_;
  std::optional<double> latency_;
};

/// What of the room's light was seen when it was checked last.
struct RoomLight {
  double share = 0.0;  // of the projectors' full light
  bool isSteady = true;
  bool operator==(const RoomLight&) const = default;
};

/// What a step uses the devices for.
enum class DeviceWork {
  brief,       // begun again in no time, in the dark
  light,       // the same with light on the projectors
  measurement  // minutes to hours, with light
};

/// What is under way with a calibration and would end with it.
struct UnderWay {
  bool measurement = false, show = false;
  bool isNothing() const { return !measurement && !show; }
  bool operator==(const UnderWay&) const = default;
};

/// The calibration that the wizard works on, as it is on disk, and what of it is in memory. The folder is
/// locked only while something is read or written, so that a show can read it beside the wizard.
class Session : public QObject {
  Q_OBJECT

 public:
  /// `cache`: folder of traced venues.
  explicit Session(std::filesystem::path cache, QObject* parent = nullptr);

  bool isOpen() const { return !path_.empty(); }
  const std::filesystem::path& path() const { return path_; }
  /// The folder's name.
  QString name() const;
  const std::filesystem::path& cache() const { return cache_; }

  /// Throws: as CalibrationFolder::open() and beginCalibration(); the session is then as it was.
  void open(const std::filesystem::path& path);
  /// `surprises`: what happens to simulated devices; opened again, the calibration still has them.
  void begin(const std::filesystem::path& path, const pipeline::CalibrateSettings& settings,
             const venue::SurpriseSettings& surprises = {});
  /// nullptr: none.
  const venue::Surprises* surprises() const { return surprises_.get(); }
  /// What somebody was asked for before measuring again is done; see venue::Surprises.
  void putRight();
  void close();

  const pipeline::CalibrateSettings& settings() const { return settings_; }
  calibration::StageProgress progress(calibration::Stage stage) const {
    return stages_[static_cast<std::size_t>(stage)].progress;
  }
  /// What a step left behind, perhaps stale.
  const std::optional<calibration::StageResult>& result(calibration::Stage stage) const {
    return stages_[static_cast<std::size_t>(stage)].result;
  }
  /// What that result says.
  template <calibration::Stage stage>
  const std::optional<calibration::ResultOf<stage>>& figures() const {
    return std::get<static_cast<std::size_t>(stage)>(figures_);
  }
  bool isSimulated() const;
  /// Devices that shine into a room.
  bool hasLight() const;
  /// The projectors are screens of the desktop; nullptr: they are not.
  const pipeline::ScreenRigSettings* screenRig() const {
    return std::get_if<pipeline::ScreenRigSettings>(&settings_.rig);
  }
  /// The same as if that projector's were the only one; none: there is no such screen.
  std::optional<pipeline::ScreenRigSettings> screenOf(std::size_t projector) const;
  /// How many there are, as they were measured; before that, as the rig is described.
  std::size_t projectors() const;
  std::size_t cameras() const;
  /// As a rig is described; only its measurement tells how many a recording has.
  static std::size_t projectorsOf(const pipeline::RigSettings& rig);
  static std::size_t camerasOf(const pipeline::RigSettings& rig);
  Size projectorSize(std::size_t projector = 0) const;
  /// What people call them; empty: by their numbers.
  QString projectorName(std::size_t projector) const;
  QString cameraName(std::size_t camera) const;
  Rasters projectorRasters() const;
  /// Photographs of a stage in the journal: what an interrupted measurement has already.
  int photographsKept(calibration::Stage stage) const;
  /// Those taken since its result was stored: of a measurement that was begun again and has not ended.
  int photographsSince(calibration::Stage stage) const;
  /// A fingerprint of all that a picture on the projectors follows from; see pipeline/proof_record.h.
  const std::string& shownFrom() const { return shownFrom_; }
  /// The same without how content is shown.
  const std::string& correction() const { return correction_; }
  /// Side of the finest blocks if acquisition was stopped and kept, projector pixels; 0: nothing is missing.
  int stoppedAt() const;
  /// What had changed when acquisition ended, so that it was; none: nothing.
  std::optional<transport::FoundChange> foundChange() const;
  /// By somebody or by a change: it can be gone on with.
  bool wasEndedEarly() const { return stoppedAt() > 0 || foundChange().has_value(); }
  /// dB that are expected of corrected pictures where they will be no better than uncorrected; see
  /// transport::isPoor(). None: they will be.
  std::optional<double> poorQuality() const;
  /// The share of the view that acquisition left out, where that is more than a tenth: what is shown there
  /// stays as it is. None: it is less.
  std::optional<double> leftOut() const;
  /// Of leftOut(): most of it is too bright for every exposure of the camera.
  bool isOverexposed() const;
  /// It may be used, but nobody should be content with it.
  bool isDoubtful() const { return poorQuality() || leftOut(); }

  /// The calibration's sets (pipeline/sets.h); none, too, where they cannot be read.
  const pipeline::TargetSets& sets() const { return sets_; }
  /// Why they cannot; none: they can.
  const std::optional<Failure>& setsFailure() const { return setsFailure_; }
  /// By the functions of pipeline/sets.h. Throws: as they do.
  void changeSets(const std::function<void(calibration::CalibrationFolder&)>& how) { change(how); }
  /// Throws: Error{disk}.
  void changeSettings(const pipeline::CalibrateSettings& settings);
  /// Keeps what somebody decided at a stage. Throws: Error{disk}.
  template <typename Decision>
  void decide(const Decision& decision) {
    change([&](calibration::CalibrationFolder& folder) { calibration::storeDecision(folder, decision); });
  }
  /// Which photographs stay once all is measured; nothing becomes stale. Throws: Error{disk}.
  void keepPhotographs(pipeline::KeptPhotographs kept);
  pipeline::KeptPhotographs keptPhotographs() const { return keptPhotographs_; }
  /// Those that the light transport follows from are gone: other settings photograph everything again.
  bool werePhotographsRemoved() const { return photographsRemoved_; }
  /// Other pixels of the cameras: what was measured with those of before is out of date. Throws: Error{disk}.
  void changePixels(const reduction::PixelUse& use);
  /// Other devices, before anything is measured. Throws: as changeRig().
  void changeRig(const pipeline::RigSettings& rig);
  /// So that another venue can have them: the next work opens them again. Nothing while somebody uses them.
  void letGoOfDevices();
  /// The projector is another screen from now on; nothing that was measured becomes stale.
  /// Of `screen` its first one is that projector's. Contract: screenRig(). Throws: as
  /// pipeline::changeScreen().
  void changeScreen(const pipeline::ScreenRigSettings& screen, std::size_t projector = 0);
  /// The devices are reached by other commands from now on; nothing that was measured becomes stale. Whoever
  /// types a command agrees to it. Throws: as pipeline::changeCommands().
  void changeCommands(const std::vector<std::string>& commands);
  /// As which screen a projector was measured; see screenRig() for what it is now.
  pipeline::ScreenRigSettings::Display measuredDisplay(std::size_t projector = 0) const;
  /// Something was measured that belongs to these devices.
  bool isMeasured() const { return result(calibration::Stage::linearization).has_value(); }
  void setPatience(const CheckPatience& patience) { patience_ = patience; }
  /// A stage has a result from before it was measured again: pipeline/measured_again.h.
  bool hasEarlier(calibration::Stage stage) const {
    return stages_[static_cast<std::size_t>(stage)].hasEarlier;
  }
  /// It has, and is being measured again.
  bool mayReturnToEarlier(calibration::Stage stage) const {
    return stages_[static_cast<std::size_t>(stage)].mayReturn;
  }
  /// See pipeline/measured_again.h. Throws: Error{disk}.
  void returnToEarlier(calibration::Stage stage);
  /// Looks at the folder again, after some work wrote into it.
  void reload();
  /// The same for whoever cannot fail any more, as his work has ended: what cannot be read now, since another
  /// program is writing or the disk is gone, stays as it was. Returns why.
  std::optional<Failure> readAgain();

  std::shared_ptr<SessionDevices> devices() const { return devices_; }
  LiveRig& live() const { return *live_; }

  /// Which measurement of the light transport is used: another one has another name. Empty: there is none.
  std::string measurement() const;
  /// What acquisition measured, with all of T; none until it has been read, and from when it is measured anew
  /// until that is read.
  std::shared_ptr<const transport::Acquisition> acquisition() const { return acquisition_; }
  /// Reads it on another thread, once; acquisitionChanged() tells.
  void wantAcquisition();
  /// Why it could not be read; none while it may still be.
  const std::optional<Failure>& acquisitionFailure() const { return readFailure_; }

  /// Patterns a second at most that real projectors show; 0: as quickly as they can.
  void setFlashLimit(int changesPerSecond);
  int flashLimit() const { return flashLimit_; }
  /// Patterns a second that need nobody's consent.
  static constexpr int audienceLimit = 3;
  /// Somebody has said that the room is clear and everyone in it knows. Never remembered: said for each
  /// opening, and anew once nothing has used the devices for a while, in which others may have come in.
  bool isRoomClear() const { return roomClear_; }
  void setRoomClear(bool clear);
  void setConsentTime(std::chrono::milliseconds time) { consent_.setInterval(time); }
  /// Measuring may flash real light, more than three times a second, only after a consent.
  bool needsConsent() const { return isOpen() && hasLight() && flashLimit_ == 0; }
  bool mayMeasure() const { return !needsConsent() || roomClear_; }

  /// A projector's screen is unplugged, and work waits for it.
  bool isScreenMissing() const { return !missingScreens_.empty(); }
  /// The first one whose screen is; none: none is missing, or it is no projector's of the venue.
  std::optional<std::size_t> projectorWithoutScreen() const;

  /// A photograph does not come.
  bool isCameraSilent() const { return silentCamera_.has_value(); }
  /// The first camera whose photograph does not come.
  std::optional<std::size_t> silentCamera() const { return silentCamera_; }
  /// Why, as far as its driver knows, in a sentence; empty: nobody knows.
  QString cameraFailure() const { return cameraFailure_; }
  /// Work that waits for a device: the projector's screen or the camera.
  bool isDeviceLost() const { return isScreenMissing() || isCameraSilent(); }
  /// Nobody waits any longer for a camera that does not answer: the measurement ends with what is there.
  void giveUpCamera();

  /// Since the calibration was opened; none before it was measured.
  const std::optional<RoomLight>& roomLight() const { return roomLight_; }
  void setRoomLight(const std::optional<RoomLight>& light);

  /// Devices, and the light transport while it is rewritten, are used by one step at a time; none: by nobody.
  const std::optional<StepName>& devicesUser() const { return devicesUser_; }
  bool areDevicesFree() const { return !devicesUser_; }
  /// In the language of the moment; empty: nobody uses them.
  QString devicesUserName() const { return devicesUser_ ? devicesUser_->text() : QString(); }
  /// For `step`, until the lease ends. Contract: areDevicesFree().
  ///   whenUnclear  pauses or ends work that flashes light: called when mayMeasure() turns false meanwhile
  DeviceLease leaseDevices(const StepName& step, DeviceWork work = DeviceWork::brief,
                           std::function<void()> whenUnclear = {});
  /// Light of a step stands on the projectors, before whatever else does.
  bool isProjecting() const { return devicesUser_ && deviceWork_ != DeviceWork::brief; }
  /// Work under way that takes long and is not to be ended by the way.
  bool isMeasuring() const { return devicesUser_ && deviceWork_ == DeviceWork::measurement; }
  /// A show plays on the projectors' screens.
  void setShowing(bool showing);
  /// `relucent show` plays this venue beside the wizard, on this computer, or another one on its screens.
  bool isShownElsewhere() const { return otherShow_.has_value(); }
  bool isAnotherVenueShown() const { return otherShow_ && otherShow_->way == VenueUse::Way::screen; }
  /// Asks that show to end, which it does in its own time. Throws: Error{input} if this may not.
  void endOtherShow();
  /// It was asked, and may still do so.
  bool isOtherShowEnding() const { return otherShow_ && ending_.isActive(); }
  /// What another calibration, or the end of the program, would end: not without a question.
  UnderWay underWay() const { return {isMeasuring(), isShowing_}; }
  /// Why a step can keep no settings now, in a sentence: work of another step has the calibration. Empty: it
  /// can.
  QString whyLocked(const StepName& step) const;
  /// Why the devices cannot be used now, a sentence; empty: they can.
  QString whyInUse() const {
    return areDevicesFree() ? QString() : tr("The devices are in use at %1.").arg(devicesUserName());
  }
  /// Why nothing is measured now that shows patterns; empty: it may be.
  QString whyNoPatterns() const { return mayMeasure() ? QString() : tr("Confirm that the room is clear."); }

 Q_SIGNALS:
  /// Another calibration, or none.
  void opened();
  /// Settings, devices chosen, results, and how far each step is.
  void stepsChanged();
  /// acquisition(), or why it cannot be read.
  void acquisitionChanged();
  /// Who uses the devices, whether they may be used, whether a screen is missed, and whether a show plays.
  void devicesChanged();
  void roomLightChanged();
  /// A show begins or ends.
  void showingChanged();

 private:
  friend class DeviceLease;
  struct StageState {
    calibration::StageProgress progress = calibration::StageProgress::open;
    std::optional<calibration::StageResult> result;
    bool mayReturn = false, hasEarlier = false;
  };
  void look(const calibration::CalibrationFolder& folder);
  void tellSteps();
  /// Writes into the calibration and looks at it again.
  void change(const std::function<void(calibration::CalibrationFolder&)>& write);
  void agreeToTyped(std::vector<std::string> commands) const;
  /// As change(), with the devices closed meanwhile and opened again.
  void changeDevices(const std::function<void(calibration::CalibrationFolder&)>& write);
  /// Throws: Error{input} if another wizard has it.
  void hold(const std::filesystem::path& venue);
  /// What of this venue another program's show has.
  struct OtherShow {
    std::filesystem::path what;
    VenueUse::Way way = VenueUse::Way::show;
    bool operator==(const OtherShow&) const = default;
  };
  std::optional<OtherShow> otherShow() const;
  void lookForShow();
  void leaveDevicesToShow();
  void adopt(calibration::CalibrationFolder given);
  void slowDown();
  void consentChanged();
  void makeDevices();
  void keepSurprises(const std::filesystem::path& path);
  void takeBackDevices();
  void listenForCamera();
  std::unique_ptr<devices::ScreenProjector> openScreen(const pipeline::ScreenRigSettings& settings);

  std::filesystem::path path_, cache_;
  std::optional<VenueUse> use_;  // of the one that is open
  pipeline::CalibrateSettings settings_;
  pipeline::KeptPhotographs keptPhotographs_ = pipeline::KeptPhotographs::everything;
  bool photographsRemoved_ = false;
  std::string shownFrom_, correction_;
  pipeline::TargetSets sets_;
  std::optional<Failure> setsFailure_;
  std::vector<pipeline::ScreenRigSettings::Display> measuredDisplays_;
  std::array<StageState, calibration::stageCount> stages_;
  calibration::StageResults figures_;
  std::shared_ptr<LiveRig> live_;
  std::shared_ptr<venue::Surprises> surprises_;
  std::shared_ptr<SessionDevices> devices_;
  std::shared_ptr<const transport::Acquisition> acquisition_;
  std::string acquired_;  // the measurement that `acquisition_` is or will be
  std::optional<Failure> readFailure_;
  std::optional<StepName> devicesUser_;
  DeviceWork deviceWork_ = DeviceWork::brief;
  std::function<void()> whenUnclear_;  // of who uses them; empty: nothing of that flashes
  bool isShowing_ = false;
  std::optional<OtherShow> otherShow_;
  int flashLimit_ = 0;
  QTimer consent_;  // runs while the room is said to be clear and nothing is done there
  bool roomClear_ = false;
  std::set<std::string> missingScreens_;  // by connector
  std::optional<std::size_t> silentCamera_;
  QString cameraFailure_;
  QTimer silence_;  // runs while somebody uses the devices
  QTimer shows_;    // other programs' are looked for
  QTimer ending_;   // runs while another program's show has time to end
  std::optional<RoomLight> roomLight_;
  CheckPatience patience_;
  struct Read {
    std::string measurement;
    std::shared_ptr<const transport::Acquisition> acquisition;
  };
  Latest<Read> reading_;
};

/// What the job of a measuring stage needs, without the session: it runs on another thread.
struct SessionWork {
  std::filesystem::path path;
  std::shared_ptr<SessionDevices> devices;
};
inline SessionWork workOf(const Session& session) {
  return {session.path(), session.devices()};
}

}  // namespace relucent::gui
