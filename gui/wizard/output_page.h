// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QTimer>

#include "jobs/job.h"
#include "output/awake.h"
#include "output/engine_renderer.h"
#include "output/player.h"
#include "wizard/page_model.h"
#include "wizard/session.h"

namespace relucent {

/// A screen that the output can shine on.
struct OutputScreen {
  ScreenIdentity identity;
  QSize size;              // in its own pixels
  bool operators = false;  // the one with this window
};

/// Step 8: the content on the projector, corrected in real time.
class OutputPage : public PageModel {
  Q_OBJECT

 public:
  explicit OutputPage(Session& session, QObject* parent = nullptr);
  ~OutputPage() override;

  QString name() const override { return tr("Output"); }
  QString subtitle() const override {
    return tr("Play corrected content on the projector, and compare it with the original.");
  }
  StepStatus status() const override;
  QString hint() const override;
  Command primary() const override;
  std::vector<Command> secondary() const override;
  std::optional<double> progress() const override;
  void enter() override;
  void finish() override { close(); }

  const std::vector<OutputScreen>& screens() const { return screens_; }
  std::optional<std::size_t> chosen() const { return chosen_; }
  void choose(std::size_t index);

  bool isOpen() const { return player_ != nullptr; }
  bool isBlack() const { return player_ && player_->isBlack(); }
  bool isFrozen() const { return player_ && player_->isFrozen(); }
  bool isCompensated() const { return !player_ || player_->isCompensated(); }
  void setBlack(bool black);
  void setFrozen(bool frozen);
  void setCompensated(bool compensated);
  PlayerStatistics statistics() const { return player_ ? player_->statistics() : PlayerStatistics(); }
  QString engineName() const { return engine_; }
  /// What the projector shows now, as far as this program knows; null while it is closed.
  QImage onProjector() const;
  Size projectorSize() const { return session_.projectorSize(); }

  void open();
  void close();

 private:
  class Tap;
  struct Made;
  void listScreens();
  void opened();

  Session& session_;
  Job job_;
  std::shared_ptr<Made> made_;
  std::shared_ptr<Tap> tap_;
  std::vector<OutputScreen> screens_;
  std::optional<std::size_t> chosen_;
  std::unique_ptr<ProjectorWindow> window_;
  std::unique_ptr<Player> player_;
  std::optional<Awake> awake_;
  QString engine_;
  bool wanted_ = false;  // closed meanwhile, it does not open
  QTimer often_;
};

}  // namespace relucent
