// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "jobs/job.h"
#include "jobs/latest.h"
#include "output/surface_pictures.h"
#include "wizard/devices/device_page.h"
#include "wizard/devices/on_measurement.h"
#include "wizard/devices/perfecting.h"
#include "wizard/preview/content_preview.h"
#include "wizard/preview/mask_editing.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// What Preview compares; `optimum` last, it takes longest.
inline constexpr std::array comparedMethods{compensation::Method::none, compensation::Method::mix,
                                            compensation::Method::clusters, compensation::Method::refined,
                                            compensation::Method::optimum};

/// Step 7: content in its place, before it is projected. It lies in the first camera's view, in others on the
/// surface or in a place of its own; what all projectors give together is shown, as the chosen camera sees
/// it.
class PreviewPage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"preview", "relucent::gui::PreviewPage",
                                     QT_TRANSLATE_NOOP("relucent::gui::PreviewPage", "Preview")};

  explicit PreviewPage(Session& session, QObject* parent = nullptr);
  ~PreviewPage() override { finish(); }

  QString subtitle() const override {
    return tr(
        "Place the content in the camera's view and see what the audience will see before you project it.");
  }
  StepStatus status() const override;
  QString hint() const override;
  std::optional<Banner> banner() const override;
  QString whyLocked() const override { return session_.whyLocked(step()); }
  PageCommand* primary() const override { return accept_; }
  std::vector<PageCommand*> secondary() const override;
  std::optional<double> progress() const override;
  bool isChanged() const override;
  void enter() override;
  void leave() override;
  void finish() override;

  bool isReady() const { return engine_ != nullptr; }
  const pipeline::ContentSettings& settings() const { return settings_; }
  /// `what`: changed, in the list of what can be undone.
  void setSettings(const pipeline::ContentSettings& settings, const QString& what = tr("Content"));
  /// Where the content lies in the shown camera's view. Corners that cross over are refused: problem() says
  /// so. In a view where it lies on the surface there are none.
  void setCorners(const compensation::Corners& corners);
  /// In the largest upright rectangle that can be reached.
  void placeAutomatically();
  bool isPlacedByHand() const;
  /// The corners as they are, chosen or found; none before the first prediction.
  std::optional<compensation::Corners> corners() const;

  /// What a camera's view asks for.
  compensation::ViewSettings view(std::size_t camera) const;
  void setView(std::size_t camera, const compensation::ViewSettings& view, const QString& what);
  /// Where the cameras stand in the plan, metres: to the right of the surface's middle, and away from it. As
  /// somebody placed them, or all round the surface as long as nobody has.
  std::vector<compensation::Position> cameraPositions() const;
  bool areCamerasPlaced() const;
  void placeCamera(std::size_t camera, const compensation::Position& position);
  /// For whom the picture is; none: for everybody who looks from the cameras.
  const std::optional<compensation::Position>& viewer() const { return settings_.viewer; }
  void setViewer(const std::optional<compensation::Position>& viewer);
  /// He walks from the first camera to the last: 0 to cameras() - 1; whole numbers are cameras' places.
  void setViewerOnPath(double place);
  /// The nearest place of that path; 0 if there is no viewer.
  double viewerOnPath() const;
  /// How much each view counts for him; empty: there is none.
  std::vector<double> viewerShares() const;
  /// What stands against the last place that was asked for; empty: nothing.
  const QString& problem() const { return problem_; }
  /// Sets of the calibration. What was changed here is kept in the one in use before another one is; a new
  /// one has it alone.
  const pipeline::TargetSets& sets() const { return session_.sets(); }
  /// Much of the view is left out of the measurement: what is not corrected there may well be lit.
  bool isMuchLeftOut() const { return session_.leftOut().has_value(); }
  void useSet(const std::string& name);
  void saveSet(const std::string& name);
  void renameSet(const std::string& to);
  /// That in use, which then is the content without a name, or the first other one.
  void removeSet();
  /// Why they cannot be changed now; empty: they can.
  QString whyNoSets() const;
  /// Read on another thread. Tells failed() if it is no picture; the one before stays.
  void choosePicture(const QString& file);
  QString pictureName() const;
  const std::shared_ptr<const ContentPreview>& preview() const { return preview_; }
  /// Where the views of preview() contradict each other; null: of one view, or not worked out yet.
  const std::shared_ptr<const compensation::Contradiction>& contradiction() const { return contradiction_; }
  /// One row a method that has been tried with this content, in the order of the methods.
  const std::vector<MethodPreview>& table() const { return table_; }
  /// That of the method in use; none yet.
  std::optional<MethodPreview> chosenRow() const;
  /// dB that Acquire expected, of its own three pictures; none if nobody worked it out.
  std::optional<double> expectedOfOthers() const;
  bool isComputing() const { return computing_.isBusy(); }

  /// The picture is on the surface, from shine() until stopShining() or until the page is left.
  bool isShining() const { return surface_.isShining(); }
  /// As the method corrects it, or uncorrected for comparison.
  bool shinesCorrected() const { return shinesCorrected_; }
  void shine();
  void stopShining() { surface_.stop(); }
  void setShinesCorrected(bool corrected);
  /// Accepts the placement, and corrects the picture in it by photographs of itself.
  void perfect();
  QString whyNotPerfect() const;
  Perfecting& perfecting() { return perfecting_; }
  MaskEditing& masks() { return masks_; }
  /// Why it cannot shine now; empty: it can, or does.
  QString whyNotShining() const;

 protected:
  void updateCommands() override;
  bool mayKeep() const override { return !isComputing() && problem_.isEmpty() && DevicePage::mayKeep(); }
  void keepChange() override { keepPlacement(); }
  void cameraChanged() override { masks_.cancel(); }

 private:
  /// And for what.
  using Predicted = std::pair<pipeline::ContentSettings, std::shared_ptr<const ContentPreview>>;
  using Contradicting =
      std::pair<std::shared_ptr<const ContentPreview>, std::shared_ptr<const compensation::Contradiction>>;

  void prepare();
  void prepared();
  QString whyNoPreview() const;
  void adopt(const pipeline::ContentSettings& settings);
  void adoptContent(const std::string& picture, std::shared_ptr<const image::Image> content);
  void refuse(const Failure& failure);
  void compute();
  void compareNext();
  void findContradiction(const pipeline::ContentSettings& settings);
  void forgetTable();
  void accept();
  void changeSets(const std::function<void(calibration::CalibrationFolder&)>& how);
  void followSet();
  void followContent();
  void takeOver();
  void keepIn(calibration::CalibrationFolder& folder) const;
  void acceptSet();
  bool keepPlacement();
  void lookAtPicture();
  const std::vector<QImage>& sent() const;
  void surfaceChanged();
  QString borrowedScreens() const;

  pipeline::ContentSettings placedSettings() const;

  PageCommand *accept_, *goOnMeasuring_, *shine_, *compare_;
  DeviceLease lease_;
  Job job_;
  pipeline::ContentSettings settings_;
  pipeline::ContentSettings stored_;  // as the calibration had it when it was looked at last
  std::shared_ptr<const image::Image> content_;
  std::string contentOf_;  // where it was read
  QString problem_;
  std::shared_ptr<PreviewEngine> made_;  // by the job, taken when it ends
  std::shared_ptr<const PreviewEngine> engine_;
  std::string preparedFor_;
  std::shared_ptr<const ContentPreview> preview_;
  std::vector<MethodPreview> table_;
  int round_ = 0;  // of comparisons: answers of earlier ones are dropped
  Latest<Predicted> computing_;
  std::shared_ptr<const compensation::Contradiction> contradiction_;
  Latest<Contradicting> contradicting_;
  Latest<std::pair<int, MethodPreview>> comparing_;
  Latest<std::pair<std::string, std::shared_ptr<const image::Image>>> reading_;
  bool looked_ = false;      // now
  std::string set_;          // that the settings are of
  bool isOtherSet_ = false;  // and nobody has seen yet what it gives
  bool shinesCorrected_ = true;
  SurfacePictures surface_;
  Perfecting perfecting_;
  MaskEditing masks_;
};

}  // namespace relucent::gui
