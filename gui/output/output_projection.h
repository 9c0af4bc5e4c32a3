// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QTimer>
#include <deque>

#include "content/playlist.h"
#include "desktop/awake.h"
#include "jobs/job.h"
#include "jobs/latest.h"
#include "output/engine_renderer.h"
#include "output/player.h"
#include "relucent/base/message.h"

namespace relucent::gui {

class OutputTap;

/// What plays on the projectors' screens: engine, windows and player, from opening to closing, and what of it
/// the operator sees meanwhile. A projector without a screen plays for the operator alone.
class OutputProjection : public QObject {
  Q_OBJECT

 public:
  struct Wanted {
    std::filesystem::path calibration;
    PlaylistSettings list;
    compensation::Fit fit = compensation::Fit::fit;
    std::vector<std::optional<ScreenIdentity>> screens;  // one a projector; none: it plays unseen
    /// As it begins: with which item of the list, black, with figures over the picture.
    struct Beginning {
      qsizetype item = 0;
      bool isBlack = false, hasOverlay = false;
    } beginning{};
  };

  explicit OutputProjection(QObject* parent = nullptr);
  ~OutputProjection() override;

  /// A canvas of the first picture's shape, so that it lies where Preview has put it; films have the usual
  /// one.
  static Canvas canvasFor(const PlaylistSettings& list, compensation::Fit fit);

  /// Prepares the engine on another thread, then shines. Contract: not open, not opening; the list has items.
  void open(const Wanted& wanted);
  void close();
  bool isOpening() const { return job_.isRunning(); }
  bool isOpen() const { return player_ != nullptr; }
  /// Of the preparation.
  QString stage() const { return job_.stage(); }
  std::optional<double> fraction() const { return job_.fraction(); }

  /// As another set of the calibration has it, once that is prepared; until then as before.
  void useSet(const std::string& name) {
    if (player_) player_->useSet(name);
  }
  /// Another list from the next frame on, from its beginning.
  void setList(const PlaylistSettings& list);
  /// The same list, edited: the item that plays is not interrupted for another one, if it is still there.
  void changeList(const PlaylistSettings& list);
  bool isBlack() const { return player_ && player_->isBlack(); }
  bool isFrozen() const { return player_ && player_->isFrozen(); }
  bool isCompensated() const { return !player_ || player_->isCompensated(); }
  /// Figures over the picture, on the projectors too.
  bool hasOverlay() const { return player_ && player_->hasOverlay(); }
  /// A test chart in place of the playlist.
  bool showsChart() const { return player_ && player_->chart().has_value(); }
  void setBlack(bool black);
  void setFrozen(bool frozen);
  void setOverlay(bool overlay);
  /// The first one, another one, then the playlist again.
  void nextChart();
  /// The playlist again.
  void endChart();
  void setCompensated(bool compensated);

  PlayerStatistics statistics() const { return player_ ? player_->statistics() : PlayerStatistics(); }
  /// Frame times of the last minute, milliseconds, twice a second; the newest last.
  const std::deque<double>& frameTimes() const { return frameTimes_; }
  /// What computes it, and that windows are drawn without OpenGL if one is.
  QString engineName() const { return engine_; }
  const Canvas& canvas() const { return canvas_; }
  /// Which item plays; -1: none.
  qsizetype playing() const;
  /// What of the list could not be read, the newest last.
  std::vector<Playlist::Skipped> skipped() const;
  /// What of it may be lost and come back, and how that is.
  std::vector<LiveState> live() const;

  /// What a projector shows now, as far as this program knows; null while it is closed.
  QImage onProjector(std::size_t projector = 0) const;
  /// Which projector's picture the operator sees; the first one's to begin with.
  void mirrorProjector(std::size_t projector);
  /// The operator looks at that picture in so many pixels of `view`; empty: no longer there. One view counts,
  /// the last that asked.
  void watch(const QObject* view, QSize within);
  /// That picture, no larger than wanted, renewed a few times a second and without a share in the show's
  /// work: it is scaled on another thread. Null while the projection is closed.
  const QImage& mirror() const { return mirror_; }

 Q_SIGNALS:
  /// Opened, closed or switched.
  void changed();
  /// How far the preparation is; and what plays and how it goes, twice a second.
  void progressed();
  /// A new mirror().
  void mirrored();
  void failed(const gui::Failure& failure);
  /// The set that was wanted cannot be had: that of before plays on.
  void setRefused();

 private:
  struct Made;
  void opened();
  void play();
  void sample();
  void reflect();

  Job job_;
  std::shared_ptr<Made> made_;
  std::shared_ptr<OutputTap> tap_;
  std::vector<std::optional<ScreenIdentity>> screens_;
  bool wanted_ = false;  // closed meanwhile, it does not open
  std::shared_ptr<Playlist> content_;
  Canvas canvas_;
  std::vector<std::unique_ptr<ProjectorWindow>> windows_;
  std::unique_ptr<Player> player_;
  std::optional<Awake> awake_;
  QString engine_;
  QTimer sampling_, reflecting_;
  std::deque<double> frameTimes_;
  std::size_t mirrored_ = 0;  // projector
  QSize within_;
  const QObject* view_ = nullptr;  // that asked for it; may be gone
  qint64 reflected_ = 0;           // which picture, and how, is in the mirror
  QImage mirror_;
  Latest<QImage> scaling_;
};

}  // namespace relucent::gui
