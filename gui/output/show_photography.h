// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>

#include "content/canvas.h"
#include "jobs/job.h"
#include "relucent/base/message.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/verify.h"

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
  virtual pipeline::PerfectedImage perfect(const std::filesystem::path& picture, const Canvas& canvas,
                                           Progress& progress) = 0;
};

/// By the devices that a calibration names. Pictures change three times a second at most: an audience may be
/// there.
std::unique_ptr<ShowPhotography> photographyOf(const std::filesystem::path& calibration,
                                               const std::filesystem::path& cache);

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
  void perfect(const std::filesystem::path& picture, const Canvas& canvas);
  /// Waits; ended() does not follow.
  void cancel();

 Q_SIGNALS:
  /// `work`: "check" or "perfect".
  void progressed(const QString& work, double fraction, const QString& stage);
  /// `verdict` of a check: as relucent-cli verify has it; of a picture: "better", "as_before". Either:
  /// "failed".
  void ended(const QString& work, const QString& verdict, const QString& sentence);

 private:
  struct Found {
    QString verdict;
    Message sentence;
  };
  void start(const QString& work, std::function<Found(Progress&)> job);
  void finished();

  std::shared_ptr<ShowPhotography> photography_;
  QString work_;
  std::shared_ptr<Found> found_;
  Job job_;  // last: it uses the others
};

}  // namespace relucent::gui
