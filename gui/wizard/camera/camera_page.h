// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>

#include "jobs/job.h"
#include "jobs/latest.h"
#include "relucent/image/photograph_check.h"
#include "relucent/linearization/coverage.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/pipeline/reductions.h"
#include "wizard/devices/camera_finder.h"
#include "wizard/devices/device_page.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// One look through the camera.
struct CameraLook {
  rig::RawFrame frame;
  image::PhotographCheck check;
  double sharpness = 0.0;
  std::optional<std::size_t> exposure{};  // which one of those that were found; none: a check's
};

/// Step 2: framing, focus, and exposures that cover what is bright and what is dark. The projectors show
/// white while the cameras are watched, all of them in turn; focus and light are judged in the one that is
/// shown.
class CameraPage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"camera", "relucent::gui::CameraPage",
                                     QT_TRANSLATE_NOOP("relucent::gui::CameraPage", "Camera")};

  explicit CameraPage(Session& session, QObject* parent = nullptr);
  ~CameraPage() override;

  QString subtitle() const override {
    return tr("Frame the surface, focus, and let the exposures cover its brightest and darkest parts.");
  }
  StepStatus status() const override;
  QString hint() const override;
  PageCommand* primary() const override;
  std::vector<PageCommand*> secondary() const override;
  std::optional<double> progress() const override;
  std::optional<Banner> banner() const override { return overTheShow(); }
  bool hasRemedy() const override { return !needsCamera() && !session_.mayMeasure(); }
  void enter() override;
  void leave() override;
  void finish() override;

  /// A screen of the desktop is the projector, and no camera is chosen for it yet.
  bool needsCamera() const;
  /// What is there to choose from, as it was when it was looked for.
  const devices::CameraList& foundCameras() const { return finder_.cameras(); }
  bool isListing() const { return finder_.isLooking(); }
  void listCameras() { finder_.look(); }
  CameraFinder& finder() { return finder_; }
  /// `size`: of the photographs; none: all that the camera has.
  void chooseCamera(const std::string& address, std::optional<Size> size = std::nullopt);
  /// Who looks for cameras; for tests.
  void setLister(std::function<devices::CameraList()> lister) { finder_.setLister(std::move(lister)); }
  /// How projector and camera work together, where the projector is a screen; none before it was measured.
  const std::optional<pipeline::RigCheck>& check() const { return check_; }

  bool isLooking() const { return job_.isRunning(); }
  QString stage() const { return job_.stage(); }
  /// What is seen: at first what the checks photograph in white light, then one look after the other.
  const std::optional<CameraLook>& look() const { return look(camera()); }
  const std::optional<CameraLook>& look(std::size_t camera) const;
  /// The devices are being checked and exposures found.
  bool isChecking() const { return isLooking() && isChecking_; }
  /// Every check has its verdict, and the live picture goes on.
  bool areChecksDone() const;
  /// Exposures for this venue, longest first; as they were kept where nobody looks; empty until they are
  /// found.
  std::vector<double> exposures() const;
  /// Exposures were found and kept, and the camera is not being looked through since.
  bool isKept() const;
  /// Of what is kept, on projector and camera.
  QStringList keptVerdicts() const;
  /// Nobody can aim it.
  bool isSimulated() const { return session_.isSimulated(); }
  /// Which part of each projector's picture any camera sees; empty before it was looked for.
  const std::vector<linearization::Coverage>& coverage() const { return coverage_; }
  /// What each camera sees of each projector, and where their light falls on each other; nothing before.
  const linearization::RigCoverage& rigCoverage() const { return rigCoverage_; }
  /// The time in which the projector's light changes, where exposures that are no whole multiples of it
  /// flicker, seconds; none: the light is even, or was not checked.
  std::optional<double> flickerPeriod() const;
  /// What exposures are whole multiples of, seconds; 0: any.
  double exposureUnit() const { return session_.settings().linearization.exposureUnit; }
  /// Exposures are looked for again.
  void setExposureUnit(double seconds);
  /// Which of them the camera looks with.
  std::size_t exposure() const { return exposure_; }
  /// While it looks: what is shown afterwards was taken with the exposure that was chosen then.
  bool mayChooseExposure() const { return isLooking(); }
  void chooseExposure(std::size_t index);
  Size projectorSize(std::size_t projector) const { return session_.projectorSize(projector); }
  /// Of the shortest: too bright in every exposure; of the longest: too dark in every one. None before they
  /// have been looked at.
  std::optional<double> tooBrightEverywhere() const { return tooBrightEverywhere(camera()); }
  std::optional<double> tooDarkEverywhere() const { return tooDarkEverywhere(camera()); }
  std::optional<double> tooBrightEverywhere(std::size_t camera) const;
  /// When the exposures were kept, as the rail has it.
  double keptTooBright() const;
  std::optional<double> tooDarkEverywhere(std::size_t camera) const;
  /// What may be made of the camera's pixels; empty before it has been looked at, and where it has no more
  /// than the projection needs.
  const std::vector<pipeline::PixelForecast>& pixelForecasts() const { return pixels_; }
  /// Which of them is wanted.
  reduction::PixelUse pixels() const { return session_.settings().pixels; }
  void choosePixels(const reduction::PixelUse& use);
  /// The focus area, in pixels of the camera that is shown.
  image::Region focusArea() const { return focusArea(camera()); }
  image::Region focusArea(std::size_t camera) const;
  void setFocusArea(const image::Region& area);
  /// In the focus area there is something to judge: most of it is not too bright.
  bool isFocusJudged() const;
  /// Sharpness relative to the best so far, 0 to 1.
  double focus() const { return focus(camera()); }
  double focus(std::size_t camera) const;

 Q_SIGNALS:
  /// It begins to look for cameras, or has.
  void camerasListed();

 protected:
  void updateCommands() override;

 private:
  struct Shared;
  bool mayChooseCamera() const;
  void exchangeCamera(const std::string& address, std::optional<Size> size);
  void goOn();
  void keepLook();
  void keepExposureUnit(double seconds);
  void forget();
  QString whyNoChecks() const;
  void forgetChecks();
  void learnBest();
  void keepPixels(const reduction::PixelUse& use);
  void start();
  void watch(std::size_t camera, const image::Region& area);
  void lookAtCheck();
  bool isChecked() const { return look() && !isChecking_ && !exposures_.seconds.empty(); }
  void takeSharedState();
  void ended();

  /// One camera's.
  struct Watched {
    std::optional<CameraLook> look{};
    std::optional<double> tooBright{}, tooDark{};
    image::Region area{};
    double best = 0.0;
  };
  const Watched& watched(std::size_t camera) const;
  void forgetBest();

  DeviceLease lease_;
  Job job_;
  std::shared_ptr<Shared> shared_;
  std::vector<Watched> cameras_;
  linearization::ExposureChoice exposures_;
  std::size_t exposure_ = 0;
  std::vector<pipeline::PixelForecast> pixels_;
  CameraFinder finder_;
  std::optional<pipeline::RigCheck> check_;
  std::vector<linearization::Coverage> coverage_;
  linearization::RigCoverage rigCoverage_;
  /// Before another was to be chosen: a command that was typed is found by no looking.
  std::optional<pipeline::ScreenRigSettings::Camera> former_;
  bool waitsForConsent_ = false;  // the checks begin once the room is clear
  PageCommand *keep_, *pause_, *again_, *chooseAnother_, *keepFormer_;
  bool isChecking_ = false;
  struct FirstLook {
    std::shared_ptr<Shared> of;
    std::vector<std::optional<CameraLook>> looks;
  };
  Latest<FirstLook> firstLooks_;
  bool goOn_ = false;         // the next step was asked for while looking
  bool startsAgain_ = false;  // once it has ended
};

}  // namespace relucent::gui
