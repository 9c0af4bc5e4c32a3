// SPDX-License-Identifier: MIT
#pragma once

#include <QMutex>

#include "image/photograph_check.h"
#include "jobs/job.h"
#include "linearization/exposure_choice.h"
#include "wizard/page_model.h"
#include "wizard/session.h"

namespace relucent {

/// One look through the camera.
struct CameraLook {
  RawFrame frame;
  PhotographCheck check;
  double sharpness = 0.0;
};

/// Step 2: framing, focus, and exposures that cover what is bright and what is dark. The projector shows
/// white while the camera is watched.
class CameraPage : public PageModel {
  Q_OBJECT

 public:
  explicit CameraPage(Session& session, QObject* parent = nullptr);
  ~CameraPage() override;

  QString name() const override { return tr("Camera"); }
  QString subtitle() const override {
    return tr("Frame the surface, focus, and let the exposures cover its brightest and darkest parts.");
  }
  StepStatus status() const override;
  QString hint() const override;
  Command primary() const override;
  std::vector<Command> secondary() const override;
  void enter() override;
  void leave() override { finish(); }
  void finish() override;

  bool isLooking() const { return job_.isRunning(); }
  QString stage() const { return job_.stage(); }
  const std::optional<CameraLook>& look() const { return look_; }
  /// Exposures for this venue, longest first; empty until they are found.
  const std::vector<double>& exposures() const { return exposures_.seconds; }
  /// Which of them the camera looks with.
  std::size_t exposure() const { return exposure_; }
  void chooseExposure(std::size_t index);
  /// Of the shortest: too bright in every exposure; of the longest: too dark in every one. None before they
  /// have been looked at.
  std::optional<double> tooBrightEverywhere() const { return tooBright_; }
  std::optional<double> tooDarkEverywhere() const { return tooDark_; }
  /// The focus area, in pixels of the camera.
  Region focusArea() const { return area_; }
  void setFocusArea(const Region& area);
  /// Sharpness relative to the best so far, 0 to 1.
  double focus() const { return best_ > 0.0 && look_ ? look_->sharpness / best_ : 0.0; }

 private:
  struct Shared;
  void start();
  void watch(const Region& area);
  void takeNews();
  void ended();

  Session& session_;
  Job job_;
  std::shared_ptr<Shared> shared_;
  std::optional<CameraLook> look_;
  ExposureChoice exposures_;
  std::size_t exposure_ = 0;
  std::optional<double> tooBright_, tooDark_;
  Region area_;
  double best_ = 0.0;
  bool goOn_ = false;  // the next step was asked for while looking
};

}  // namespace relucent
