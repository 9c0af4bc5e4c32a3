// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <map>
#include <memory>
#include <tuple>

#include "relucent/base/error.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/devices/recording/recording_files.h"
#include "relucent/image/exr.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

/// What all devices of one replay share.
struct Recording {
  fs::path folder;
  RecordedDevices devices;
  /// By camera, what was shown and the exposure asked for.
  using Key = std::tuple<std::size_t, std::vector<std::string>, double>;
  std::map<Key, std::vector<RecordedPhotograph>> photographs;
  std::vector<std::string> shown;

  const RecordedPhotograph* find(std::size_t camera, const rig::CaptureRequest& request) const {
    const auto candidates = photographs.find({camera, shown, request.seconds});
    if (candidates == photographs.end()) return nullptr;
    auto distance = [&](const RecordedPhotograph& one) {
      return std::tuple(one.shot.stage != request.shot.stage, std::abs(one.shot.number - request.shot.number),
                        std::abs(one.exposure - request.exposure));
    };
    const RecordedPhotograph* nearest = nullptr;
    // The last of equals: a shot that was taken again counts, not the one that was doubted.
    for (const RecordedPhotograph& one : candidates->second)
      if (nearest == nullptr || distance(one) <= distance(*nearest)) nearest = &one;
    return nearest;
  }
};

class ReplayedProjector : public rig::Projector {
 public:
  ReplayedProjector(std::shared_ptr<Recording> recording, std::size_t index)
      : recording_(std::move(recording)), index_(index) {}

  std::string name() const override { return device().name; }
  Size size() const override { return device().size; }
  int bits() const override { return device().bits; }
  void show(const image::Image& encodedDrive) override {
    require(encodedDrive.size() == size() && encodedDrive.channels() == 3,
            "a picture of {}x{} pixels for a projector of {}x{}", encodedDrive.width(), encodedDrive.height(),
            size().width, size().height);
    recording_->shown[index_] = patternFingerprint(encodedDrive);
  }

 private:
  const RecordedDevices::Projector& device() const { return recording_->devices.projectors[index_]; }
  std::shared_ptr<Recording> recording_;
  std::size_t index_;
};

class ReplayedCamera : public rig::Camera {
 public:
  ReplayedCamera(std::shared_ptr<const Recording> recording, std::size_t index)
      : recording_(std::move(recording)), index_(index) {}

  std::string name() const override { return device().name; }
  Size size() const override { return device().size; }
  rig::ExposureRange exposures() const override { return {device().shortest, device().longest}; }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    const RecordedPhotograph* found = recording_->find(index_, request);
    if (found == nullptr)
      throw Error(
          ErrorKind::input,
          RELUCENT_ENGLISH_MESSAGE("device.photograph-not-recorded",
                                   "the recording has no photograph of {} {} with {} s: other patterns were "
                                   "shown or other exposures taken")
              .with(request.shot.stage, request.shot.number, as::seconds(request.seconds, as::digits(4))),
          RELUCENT_ENGLISH_MESSAGE(
              "device.use-recorded-settings",
              "use the settings that it was recorded with, or photograph the venue again"),
          recording_->folder.string());
    return {image::readRgbExr(recording_->folder / "photographs" / found->file, size()), found->bits,
            found->seconds};
  }

 private:
  const RecordedDevices::Camera& device() const { return recording_->devices.cameras[index_]; }
  std::shared_ptr<const Recording> recording_;
  std::size_t index_;
};

}  // namespace

rig::Rig replayed(const fs::path& folder) {
  auto recording = std::make_shared<Recording>();
  recording->folder = folder;
  recording->devices = readRecordedDevices(folder);
  for (RecordedPhotograph& one : readPhotographs(folder)) {
    Recording::Key key{one.camera, one.patterns, one.asked};
    recording->photographs[std::move(key)].push_back(std::move(one));
  }
  recording->shown.resize(recording->devices.projectors.size());

  rig::Rig rig;
  for (std::size_t i = 0; i < recording->devices.projectors.size(); ++i)
    rig.projectors.push_back(std::make_unique<ReplayedProjector>(recording, i));
  for (std::size_t i = 0; i < recording->devices.cameras.size(); ++i)
    rig.cameras.push_back(std::make_unique<ReplayedCamera>(recording, i));
  return rig;
}

}  // namespace relucent::devices
