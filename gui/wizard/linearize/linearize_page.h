// SPDX-License-Identifier: MIT
#pragma once

#include "jobs/job.h"
#include "jobs/room_question.h"
#include "wizard/devices/device_page.h"

namespace relucent::gui {

/// Step 3: the light of every level of the projector, measured and fitted.
class LinearizePage : public DevicePage {
  Q_OBJECT

 public:
  static constexpr StepName stepName{"linearize", "relucent::gui::LinearizePage",
                                     QT_TRANSLATE_NOOP("relucent::gui::LinearizePage", "Linearize")};

  using Ramps = std::array<std::map<double, double>, 3>;

  explicit LinearizePage(Session& session, QObject* parent = nullptr);
  ~LinearizePage() override { finish(); }

  QString subtitle() const override {
    return tr("Measure how much light each step of the projector's three colours really gives.");
  }
  StepStatus status() const override;
  QString hint() const override;
  bool hasRemedy() const override { return !session_.mayMeasure(); }
  PageCommand* primary() const override;
  std::vector<PageCommand*> secondary() const override;
  std::optional<double> progress() const override;
  std::optional<Banner> banner() const override;
  QString whyLocked() const override;
  void finish() override;

  bool isMeasuring() const { return job_.isRunning(); }
  /// What has been measured, perhaps with other settings; none before.
  const std::optional<linearization::Linearization>& result() const { return result_; }
  /// The shown projector's response; nullptr: not measured yet.
  const linearization::ProjectorResponse* response() const;
  /// Points of its ramps while they are measured, drive -> share of full light.
  Ramps ramps() const { return session_.live().ramps(projector()); }
  LivePictures pictures() const { return session_.live().pictures(projector(), camera()); }
  /// Taken by all cameras since this measurement began; neither other steps' nor those read from the disk.
  int photographs() const;
  /// Seconds that the measurement took; none before.
  std::optional<double> seconds() const;

  int levels() const { return session_.settings().linearization.levels; }
  void setLevels(int levels);
  /// Those that were chosen when the response was measured, seconds; before that, those kept at Camera.
  std::vector<double> exposures() const;
  /// Light under black projectors, the room's included, as a share of the surface's in full light, when the
  /// response was measured; none before.
  std::optional<double> blackShare() const;
  /// The colours of a projector do not add up: going on is allowed, and is recorded.
  bool addsUp() const;
  /// By how much white differs from its colours, relative, and a level from its curve, of full light; of the
  /// worst projector, 0 where unknown.
  double worstAdditivity() const;
  double worstResidual() const;
  /// So little that no projector's picture mode is why: photographs were spoilt.
  bool isSpoilt() const;

 protected:
  void updateCommands() override;

 private:
  void keepLevels(int levels);
  void measure(bool again);
  void returnToEarlier();
  void look();
  void ended();

  bool isStale() const;

  PageCommand *next_, *measure_, *stop_, *again_, *return_, *retry_, *goOn_;
  DeviceLease lease_;
  RoomQuestion room_;
  Job job_;  // ends before what its work uses
  std::optional<linearization::Linearization> result_;
  std::string shown_;  // when the result was stored that is in result_
  bool wasDark_ = false;
  int begunAt_ = 0;  // photographs of this step by then
};

/// How far the level that is farthest off lies from the curve, of full light; 0 where that was not recorded.
double largestResidual(const linearization::ProjectorResponse& response);

}  // namespace relucent::gui
