// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QObject>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "output/camera_use.h"
#include "output/drive_picture.h"
#include "relucent/base/enum_names.h"
#include "relucent/base/progress.h"
#include "relucent/monitoring/monitor.h"
#include "relucent/monitoring/shadow_tracker.h"
#include "relucent/pipeline/watched_calibration.h"

namespace relucent::gui {

/// Frames as they go to the windows, for who looks at photographs of them: the last one always, and all of a
/// moment while somebody asks. Pictures are shared, not copied.
class PlayedTap {
 public:
  struct Sent {
    double seconds = 0.0;  // of the steady clock
    std::vector<DrivePicture> drives;
  };
  /// By whoever renders.
  void put(const std::vector<DrivePicture>& drives);
  /// All frames are kept from now on, the present one too, of many the newest.
  void begin();
  /// What was sent since, the oldest first; it goes on being kept.
  std::vector<Sent> sentSoFar();
  /// What was sent since, the oldest first; empty: nothing has been sent yet.
  std::vector<Sent> end();

 private:
  std::mutex guard_;
  bool keeps_ = false;
  Sent last_;
  std::vector<Sent> sent_;
};

/// What a watching camera is opened by, on the watching thread.
class WatchSource {
 public:
  virtual ~WatchSource() = default;
  /// At first, and after ShowWatch::readAgain(). Throws: as pipeline::readWatchedVenue().
  virtual pipeline::WatchingCamera read(Progress& progress) = 0;
  /// Again after every failure of the camera, and when the picture is there again. Throws: as
  /// pipeline::openCamera().
  virtual void open(pipeline::WatchingCamera& watching) = 0;
};
std::unique_ptr<WatchSource> watchSourceOf(const std::filesystem::path& calibration,
                                           const pipeline::WatchSettings& settings);

/// As health.json names it.
enum class WatchState { opening, watching, paused, noCamera, noCalibration };
inline constexpr EnumName<WatchState> watchStateNames[]{{WatchState::opening, "opening"},
                                                        {WatchState::watching, "watching"},
                                                        {WatchState::paused, "paused"},
                                                        {WatchState::noCamera, "no camera"},
                                                        {WatchState::noCalibration, "no calibration"}};
constexpr EnumNames<WatchState> namesOf(WatchState) {
  return {"state of the watch", watchStateNames};
}

/// What is known.
struct WatchStatus {
  WatchState state = WatchState::opening;
  Message problem;  // of camera or calibration
  int photographs = 0, used = 0;
  double informed = 0.0;      // share of what can be told that recent photographs tell
  double milliseconds = 0.0;  // of work, of the last photograph
  std::vector<monitoring::Finding> findings;
  bool fillsShadows = false;
  std::vector<monitoring::FilledShadow> filled;
  std::shared_ptr<const engine::Availability> available;  // what is to be projected; nullptr: all
};

/// When, and by which clock what lasts is told from what does not.
struct WatchPace {
  std::chrono::milliseconds between{2000};  // photographs
  std::chrono::milliseconds before{250};    // frames that may be what a photograph shows
  std::chrono::milliseconds again{5000};    // after a failure of the camera, doubled up to a minute
  std::function<double()> clock{};          // seconds, on the watching thread; empty: the steady clock
  /// Photographs as quickly as the camera gives them, for shadows; of these some for what lasts.
  bool fillsShadows = false;
  std::chrono::milliseconds betweenShadows{10};
};

/// Watches a show by a camera that stays (core/monitoring), on a thread of its own. Whatever becomes of the
/// camera is told, and never reaches the show.
class ShowWatch : public QObject {
  Q_OBJECT

 public:
  ShowWatch(std::unique_ptr<WatchSource> source, std::shared_ptr<PlayedTap> tap, WatchPace pace = {},
            QObject* parent = nullptr);
  /// Waits for what is under way: a photograph.
  ~ShowWatch() override;

  /// Whether the windows show what is played: not while they are black, or covered by figures.
  void setPlaying(bool playing);
  /// The calibration has changed.
  void readAgain();
  /// Which it has while the windows show what is played, and soon lets go of otherwise.
  const std::shared_ptr<CameraUse>& camera() const { return camera_; }
  const WatchStatus& status() const { return status_; }

 Q_SIGNALS:
  /// It lasts.
  void found(const relucent::monitoring::Finding& finding);
  /// It is as it was measured again.
  void over(const relucent::monitoring::Finding& finding);
  /// Other shadows are filled than before: WatchStatus::available.
  void shadowsChanged();
  /// No shadow can be filled in this venue.
  void cannotFill(const relucent::Message& sentence);
  /// The camera or the calibration cannot be used; once while that lasts.
  void failed(const relucent::Message& sentence);
  void changed();

 private:
  class Watcher;
  void take(const WatchStatus& status);

  WatchStatus status_;
  std::shared_ptr<CameraUse> camera_ = std::make_shared<CameraUse>();
  std::unique_ptr<Watcher> watcher_;  // last: it uses the others
};

/// As health.json has it.
QJsonObject toJson(const WatchStatus& status);

}  // namespace relucent::gui
