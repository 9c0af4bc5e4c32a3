// SPDX-License-Identifier: MIT
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/recording/recording.h"
#include "relucent/devices/recording/recording_files.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/rig/watched_rig.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

class Recorder : public rig::RigWatcher {
 public:
  Recorder(fs::path folder, RecordedDevices devices)
      : folder_(std::move(folder)), devices_(std::move(devices)), patterns_(devices_.projectors.size()) {
    begin();
    createFolder(folder_ / "photographs");
    createFolder(folder_ / "patterns");
  }

  void shown(std::size_t index, const image::Image& encodedDrive) override {
    patterns_[index] = patternFingerprint(encodedDrive);
    const fs::path file = folder_ / "patterns" / (patterns_[index] + ".png");
    std::error_code code;
    if (fs::exists(file, code)) return;
    const int bits = devices_.projectors[index].bits > 8 ? 16 : 8;
    writeFileAtomically(file, image::encodePng(encodedDrive, bits));
  }

  void photographed(std::size_t index, const rig::CaptureRequest& request,
                    const rig::RawFrame& frame) override {
    RecordedPhotograph photograph{index,      request.shot, request.exposure, request.seconds, frame.seconds,
                                  frame.bits, {},           patterns_};
    photograph.file = fmt::format("{:06}.exr", count_++);
    image::writeExr(folder_ / "photographs" / photograph.file, frame.signal, image::ExrType::floatType);
    appendPhotograph(folder_, photograph);
  }

 private:
  /// Throws: Error{input} if the folder holds something else.
  void begin() {
    std::error_code code;
    createFolder(folder_);
    if (fs::exists(folder_ / "recording.json", code)) {
      if (readRecordedDevices(folder_) != devices_)
        throw Error(ErrorKind::input,
                    RELUCENT_ENGLISH_MESSAGE("device.recording-of-other-devices",
                                             "the folder holds a recording of other devices"),
                    RELUCENT_ENGLISH_MESSAGE("device.record-into-new-folder", "record into a new folder"),
                    folder_.string());
      // Files that no line names are written over.
      count_ = readPhotographs(folder_).size();
    } else if (!fs::is_empty(folder_, code)) {
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("device.recording-folder-not-empty",
                                           "the folder for the recording holds other things"),
                  RELUCENT_ENGLISH_MESSAGE("device.record-into-new-folder", "record into a new folder"),
                  folder_.string());
    } else {
      writeRecordedDevices(folder_, devices_);
    }
  }

  fs::path folder_;
  RecordedDevices devices_;
  std::vector<std::string> patterns_;
  std::size_t count_ = 0;
};

}  // namespace

rig::Rig recorded(rig::Rig rig, const fs::path& folder) {
  RecordedDevices devices = devicesOf(rig);
  return rig::watched(std::move(rig), std::make_shared<Recorder>(folder, std::move(devices)));
}

}  // namespace relucent::devices
