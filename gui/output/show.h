// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <vector>

#include "desktop/awake.h"
#include "output/held_key.h"
#include "output/machine_clock.h"
#include "output/played_set.h"
#include "output/player.h"
#include "output/show_log.h"
#include "output/show_nights.h"
#include "output/show_photography.h"
#include "output/show_projectors.h"
#include "output/show_settings.h"
#include "output/show_streams.h"
#include "output/show_watch.h"
#include "output/venue_use.h"
#include "relucent/base/message.h"
#include "remote/remote_control.h"
#include "remote/status_server.h"

namespace relucent::gui {

/// As health.json names it.
enum class ShowState { starting, playing, resting, photographing, failed, stopped };
inline constexpr EnumName<ShowState> showStateNames[]{
    {ShowState::starting, "starting"}, {ShowState::playing, "playing"},
    {ShowState::resting, "resting"},   {ShowState::photographing, "photographing"},
    {ShowState::failed, "failed"},     {ShowState::stopped, "stopped"}};
constexpr EnumNames<ShowState> namesOf(ShowState) {
  return {"state of a show", showStateNames};
}

/// An unattended show: opens the displays, plays during its hours and shows black outside them, writes a log
/// and a health file, and starts again after a failure. After a suspend content continues where it was. Is
/// controlled by OSC where it is asked to. At night, where it is asked to, it has its venue tended
/// (pipeline/night.h) and goes on with what came of it.
class Show : public QObject, private RemoteActions {
  Q_OBJECT

 public:
  /// `warn` accepts sentences for the log, on any thread, during the renderer's lifetime. `set`: of the
  /// calibration, by which it begins; empty: the one in use.
  using MakeRenderer = std::function<std::unique_ptr<FrameRenderer>(
      const std::function<void(const QString&)>& warn, const std::string& set)>;
  /// `make` is called again after a failure. Throws: as `make` and displaysFor(), the first time.
  /// `photography`: who photographs for it; nullptr: the devices of its calibration. `watch`: whose camera
  /// watches it, if the settings say that one does; nullptr: the calibration's.
  Show(ShowSettings settings, MakeRenderer make, MachineClock clock = {}, QObject* parent = nullptr,
       std::unique_ptr<ShowPhotography> photography = nullptr, std::unique_ptr<WatchSource> watch = nullptr);
  ~Show() override;

  void start();
  /// Shows black, closes the windows, and completes log and health file.
  void stop();
  Player& player() { return *player_; }
  /// Where remote controls are listened to; none: nowhere, or the place is taken.
  std::optional<NetworkPlace> osc() const;
  /// Where the status page is shown; likewise.
  std::optional<NetworkPlace> status() const;
  /// Checks the clock and the displays, and writes the health file. Called automatically every ten seconds.
  void look();
  /// So long Esc has to be held at a projector's window to end it.
  static constexpr std::chrono::milliseconds endsAfter{2000};

 Q_SIGNALS:
  /// Somebody at the machine wants it to end.
  void endWanted();

 private:
  void open();
  void play();
  void rest();
  void wakeDisplays();
  void noteUse();
  bool isTime() const;
  void tryAgain(const relucent::Message& sentence);
  void writeHealth(ShowState state);
  /// Again with every look while a place is taken.
  void listen();
  void listenToControls();
  void showStatus();
  void tellControl();
  /// Projectors that are in standby have no display: without them nothing can be opened.
  void openOrWait();
  void tellProjectors();
  pjlink::Wanted wishes();
  QJsonObject health() const;

  RemoteState state() const override;
  void setPaused(bool paused) override;
  void setBlack(bool black) override;
  void setCompensated(bool compensated) override;
  void setBrightness(double brightness) override;
  void setChart(std::optional<TestChart> chart) override;
  void playItem(qsizetype index) override;
  Message useSet(const QString& name) override;
  Message moveViewer(const compensation::Position& position) override;
  Message check() override;
  Message perfect() override;
  Message whyNoPhotographs() const;
  /// Leaves the projectors to whoever photographs.
  void makeWay();
  /// What the clock asks for of the nights.
  void tend();
  void leaveOutNight(const Message& why);
  void nightEnded(const QString& verdict, const QString& sentence);
  /// What has become of the calibration: pictures that were perfected, and, where the picture may be gone for
  /// a moment (`whole`), another correction.
  void takeUp(bool whole);
  /// Goes on as before until that set is prepared. Nothing happens if it plays.
  void wish(const std::string& set);
  /// What the time of the day, and what the item that plays, ask for of sets.
  void followTime();
  void followItem();
  void setShown(const std::string& name, const std::string& shownFrom);
  void setFailed(const std::string& name, const relucent::Message& sentence);
  void tellSet(const QString& verdict, const QString& sentence);
  void beginWatch(std::unique_ptr<WatchSource> source);
  void tellWatch();
  void tellStreams();
  void tellSkipped(const std::vector<Message>& skipped);
  void photographed(const QString& work, const QString& verdict, const QString& sentence);

  ShowSettings settings_;
  MakeRenderer make_;
  MachineClock clock_;
  std::chrono::nanoseconds slept_;
  ShowLog log_;
  Awake awake_;
  std::vector<std::unique_ptr<ProjectorWindow>> windows_;
  std::shared_ptr<Playlist> content_;
  std::unique_ptr<Player> player_;
  QString renderer_;
  HeldKey escape_{Qt::Key_Escape, endsAfter};
  std::optional<VenueUse> use_;
  std::optional<VenueUse> nightUse_;  // while a night is under way
  std::vector<VenueUse> screens_;
  QTimer health_, again_, streamsLooked_;
  int failures_ = 0;
  std::vector<Message> toldSkipped_;  // that stand in the log
  ShowState state_ = ShowState::starting;
  std::unique_ptr<OscServer> server_;
  std::unique_ptr<RemoteControl> control_;
  std::unique_ptr<StatusServer> page_;
  QString whyNoOsc_, whyNoPage_;
  ProjectorWishes wishes_;
  ShowPhotographs photographs_;
  std::optional<ShowNights> nights_;  // none: nobody wants them
  Message brokenOff_;                 // why the night under way has to end
  PlayedSet playing_;
  std::string wantedSet_;                       // to be shown; empty: the one in use
  std::optional<QString> scheduledSet_;         // by the time; none: no time says any
  qsizetype followedItem_ = -1;                 // whose set was asked for
  std::string playsPerfected_;                  // what of the calibration is shown
  std::unique_ptr<ProjectorWatch> projectors_;  // nullptr: none is on the network
  std::shared_ptr<PlayedTap> played_;
  std::unique_ptr<ShowWatch> watch_;  // nullptr: nobody watches
  StreamTeller streams_;
  bool isFilling_ = false;  // a shadow, as of the last word
};

}  // namespace relucent::gui
