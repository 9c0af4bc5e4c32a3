// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "content/canvas.h"
#include "output/frame_renderer.h"
#include "output/perfected_pictures.h"
#include "output/still_solver.h"
#include "relucent/base/progress.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/engine/adaptive_range.h"
#include "relucent/engine/availability.h"
#include "relucent/engine/engine_plan.h"
#include "relucent/engine/fallback_backend.h"
#include "relucent/engine/followed_brightness.h"
#include "relucent/engine/step_budget.h"
#include "relucent/engine/view_follower.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::gui {

/// What is rendered, and by what.
struct RendererSettings {
  std::filesystem::path calibration;
  Canvas canvas;
  /// One white that goes with the content, and its offset, see AdaptiveRange; instead of `brightness`.
  bool adaptiveRange = false;
  /// How bright white is where; none: as the calibration's content has it.
  std::optional<compensation::Brightness> brightness{};
  engine::BackendChoice backend = engine::BackendChoice::automatic;
  /// Where the cameras stand; empty: as the calibration's content has it.
  std::vector<compensation::Position> cameras{};
  /// Whether frames are made without light that somebody stands in, RenderRequest::available.
  bool fillsShadows = false;
  /// As which set of the calibration content is shown at first; empty: the one in use.
  std::string set{};
};

/// The real-time engine over a calibration.
class EngineRenderer : public FrameRenderer {
 public:
  /// Reads a finished calibration and prepares everything; takes seconds. Placement, brightness and black
  /// level are those stored for the calibration's content, or a set of it; its method applies to still
  /// pictures, see StillSolver; pictures that were perfected are shown so. `notify` is called on the
  /// rendering thread, when a graphics card is lost or unusable and the processor takes over, or a perfected
  /// picture cannot be read. `host`: of SharedGl; with it pictures stay on the graphics card where they are
  /// computed there. Throws: as loadCalibration(), prepareVenue() and prepareContent(); Error{input} if the
  /// positions are not as many as the cameras.
  EngineRenderer(const RendererSettings& settings, Progress& progress,
                 const engine::FallbackBackend::Notify& notify = {}, const engine::MakeGlHost& host = {});

  std::vector<QSize> projectors() const override;
  Canvas canvas() const override { return settings_.canvas; }
  QString name() const override;
  std::vector<compensation::Position> cameras() const override { return cameras_; }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                       const Outdated& outdated) override;
  /// What another set needs besides what was measured, which all share: twice that, for as long as both are
  /// there. Where the calibration was measured again since, nothing of it that was perfected is shown.
  std::shared_ptr<PreparedSet> prepare(const std::string& set) override;
  void interrupt() override;

 private:
  /// All that depends on the target, and what frames by it have come to.
  struct Set : PreparedSet {
    engine::EngineContent content;
    std::optional<engine::AdaptiveRange> range;
    std::optional<engine::FollowedBrightness> whites;  // none: white is even
    std::optional<PerfectedPictures> perfected;        // none: white is not as it was for them
    std::unique_ptr<StillSolver> still;                // none: still pictures use the engine's steps
    std::vector<double> home;                          // weights of the views as the calibration has them
    std::vector<double> rest;                          // for whom its content is when nobody is followed
    std::optional<engine::ViewFollower> follower;
    std::optional<FrameViewer> followed;
    std::optional<engine::AvailabilityFollower> shadows;  // none: nobody asks for shadows to be filled
    std::shared_ptr<const engine::Availability> available;
  };
  /// What follows from the calibration's manifest: nobody keeps others from it while content is prepared.
  struct Chosen {
    pipeline::CalibrateSettings settings;
    std::string shownFrom, correctedFrom;
  };
  static Chosen chosenIn(const calibration::CalibrationFolder& folder);
  std::shared_ptr<Set> setOf(const Chosen& chosen) const;
  engine::EngineSettings settingsOf(const pipeline::ContentSettings& content) const;
  /// The set that a frame is wanted by, from now on.
  void take(const std::shared_ptr<PreparedSet>& wanted);
  /// By the graphics card where it shares its textures, else through memory. Throws: Error{device}.
  std::vector<DrivePicture> computed(const engine::ContentFrame& frame, const engine::FrameRequest& request,
                                     engine::FrameReport& report);
  struct Solved {
    const compensation::Compensation* solved = nullptr;  // nullptr: it is outdated
    bool isPerfected = false;
  };
  Solved solve(const ContentPicture& content, const RenderRequest& request, const Outdated& outdated);
  /// Whether that is the last one, and frames of shadows start from it.
  bool isSolved(const ContentPicture& content, const RenderRequest& request) const;
  /// A still picture as well as possible; none: it is outdated, or the engine's.
  std::optional<RenderedFrame> thorough(const ContentPicture& content, const RenderRequest& request,
                                        const Outdated& outdated);
  RenderedFrame framed(const ContentPicture& content, const RenderRequest& request);
  RenderedFrame encoded(const compensation::Compensation& solved, double seconds);
  /// How bright white is where in this frame. Whether the same frame would have the same light again.
  bool lightFor(const engine::ContentFrame& frame, engine::FrameRequest& request);
  /// Views of `words_`, one per projector.
  std::vector<DrivePicture> drives() const;
  int stepsFor(const RenderRequest& request);
  /// Weights of the views for that viewer; empty: as the calibration has them.
  std::vector<double> weightsFor(const std::optional<FrameViewer>& viewer) const;
  void follow(const std::optional<FrameViewer>& viewer);
  /// Goes on towards the light that arrives. Whether it is less than all.
  bool followShadows(const RenderRequest& request);

  RendererSettings settings_;
  engine::FallbackBackend::Notify notify_;
  pipeline::MeasuredCalibration calibration_;
  std::string correctedFrom_;  // of pipeline::fingerprintOfCorrection()
  std::optional<engine::EngineVenue> venue_;
  std::shared_ptr<Set> set_, before_;  // `before_`: until the next frame, so that no other thread frees it
  std::mutex guard_;                   // of set_, for interrupt()
  std::unique_ptr<engine::EngineBackend> backend_;
  std::chrono::steady_clock::time_point lightAsked_{};  // when range or whites were
  std::vector<std::uint32_t> words_;
  CardPictures cards_{{}};
  std::optional<engine::StepBudget> budget_;
  double budgetSeconds_ = 0.0;  // refresh time of the budget

  std::vector<compensation::Position> cameras_;  // empty: nobody can be followed
  std::chrono::steady_clock::time_point shadowsAsked_{};
  // The last still as well as possible, which shadowed frames of it start from.
  ProjectorStack solved_;
  std::uint64_t solvedNumber_ = 0;
  RenderRequest solvedFor_;
  // What the back end has projected last, to go on from.
  std::uint64_t number_ = 0;
  RenderRequest last_;
};

}  // namespace relucent::gui
