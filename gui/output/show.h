// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <vector>

#include "output/awake.h"
#include "output/player.h"
#include "output/show_log.h"
#include "output/show_settings.h"

namespace relucent {

/// A show that runs by itself: opens the displays, plays, writes a log and a health file, and begins again
/// after a failure.
class Show : public QObject {
  Q_OBJECT

 public:
  using MakeRenderer = std::function<std::unique_ptr<FrameRenderer>()>;
  /// `make` is called again after a failure. Throws: Error as `make` and displaysFor() do, the first time.
  Show(ShowSettings settings, MakeRenderer make, QObject* parent = nullptr);
  ~Show() override;

  void start();
  /// Black, windows gone, the last word in log and health file.
  void stop();
  Player& player() { return *player_; }

 private:
  void open();
  void tryAgain(const QString& sentence);
  void tellHealth(const char* state);

  ShowSettings settings_;
  MakeRenderer make_;
  ShowLog log_;
  Awake awake_;
  std::vector<std::unique_ptr<ProjectorWindow>> windows_;
  std::shared_ptr<Playlist> content_;
  std::unique_ptr<Player> player_;
  QString renderer_;
  QTimer health_, again_;
  int failures_ = 0;
  qsizetype toldSkipped_ = 0;
  const char* state_ = "starting";
};

}  // namespace relucent
