// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "content/canvas.h"
#include "jobs/job.h"
#include "output/camera_use.h"
#include "relucent/base/message.h"
#include "relucent/pipeline/night.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/verify.h"
#include "relucent/pjlink/waiting.h"

namespace relucent::gui {

/// What a show can have photographed: by the camera of its calibration, with the projectors' screens to
/// itself.
class ShowPhotography {
 public:
  virtual ~ShowPhotography() = default;
  /// Why nothing can be photographed; empty: it can.
  virtual Message whyNot() const = 0;
  /// Each opens the devices and closes them again; on a worker's thread.
  /// Throws: as openRig(), verifyCalibration(), perfectPictures().
  virtual pipeline::VerifyResult check(Progress& progress) = 0;
  /// `set`: as which set of the calibration it is shown; empty: the one in use.
  virtual pipeline::PerfectedImage perfect(const std::filesystem::path& picture, const Canvas& canvas,
                                           const std::string& set, Progress& progress) = 0;
  /// `switchesOn`: projectors that are on the network; their light is waited for. What cannot be done is an
  /// alarm of the night, devices that cannot be opened as well.
  /// Throws: Error{disk} if not even the history can be written; Cancelled.
  virtual pipeline::NightRecord tend(const pipeline::NightSettings& work, bool switchesOn,
                                     Progress& progress) = 0;
};

/// By the devices that a calibration names. Pictures change three times a second at most, at night too: an
/// audience, or whoever cleans, may be there.
/// `waiting`: how projectors are waited for at night.
std::unique_ptr<ShowPhotography> photographyOf(const std::filesystem::path& calibration,
                                               const std::filesystem::path& cache,
                                               pjlink::Waiting waiting = {});

/// Photographs on another thread, and tells what comes of it.
class ShowPhotographs : public QObject {
  Q_OBJECT

 public:
  explicit ShowPhotographs(std::unique_ptr<ShowPhotography> photography, QObject* parent = nullptr);

  bool isRunning() const { return job_.isRunning(); }
  /// Why nothing can be photographed now; empty: it can.
  Message whyNot() const;
  /// Contract: whyNot() is empty.
  void check();
  void perfect(const std::filesystem::path& picture, const Canvas& canvas, const std::string& set);
  void tend(const pipeline::NightSettings& work, bool switchesOn);
  /// Before any of them, on its thread, a camera is waited for that somebody else lets go of.
  void waitFor(std::shared_ptr<CameraUse> camera) { camera_ = std::move(camera); }
  /// What is under way ends at once, and ended() follows.
  void breakOff() { job_.cancel(); }
  /// Waits; ended() does not follow.
  void cancel();

 Q_SIGNALS:
  /// `work`: "check", "perfect" or "night".
  void progressed(const QString& work, double fraction, const QString& stage);
  /// `verdict` of a check: as relucent-cli verify has it; of a picture: "better", "as_before"; of a night:
  /// "well", "alarm". Each: "failed".
  void ended(const QString& work, const QString& verdict, const QString& sentence);

 private:
  struct Found {
    QString verdict;
    Message sentence;
  };
  void start(const QString& work, std::function<Found(Progress&)> job);
  void finished();

  std::shared_ptr<ShowPhotography> photography_;
  std::shared_ptr<CameraUse> camera_;  // nullptr: nobody else has it
  QString work_;
  std::shared_ptr<Found> found_;
  Job job_;  // last: it uses the others
};

}  // namespace relucent::gui
