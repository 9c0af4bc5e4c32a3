// SPDX-License-Identifier: MIT
#include "base/error.h"
#include "base/file.h"
#include "devices/recording.h"
#include "devices/recording_files.h"
#include "image/exr.h"
#include "image/picture_files.h"
#include "rig/watched_rig.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

class Recorder : public RigWatcher {
 public:
  Recorder(fs::path folder, RecordedDevices devices)
      : folder_(std::move(folder)), devices_(std::move(devices)), patterns_(devices_.projectors.size()) {
    begin();
    createFolder(folder_ / "photographs");
    createFolder(folder_ / "patterns");
  }

  void shown(std::size_t index, const Image& encodedDrive) override {
    patterns_[index] = patternFingerprint(encodedDrive);
    const fs::path file = folder_ / "patterns" / (patterns_[index] + ".png");
    std::error_code code;
    if (fs::exists(file, code)) return;
    const int bits = devices_.projectors[index].bits > 8 ? 16 : 8;
    writeFileAtomically(file, encodePng(encodedDrive, bits));
  }

  void photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) override {
    RecordedPhotograph photograph{index,      request.shot, request.exposure, request.seconds, frame.seconds,
                                  frame.bits, {},           patterns_};
    photograph.file = fmt::format("{:06}.exr", count_++);
    writeExr(folder_ / "photographs" / photograph.file, frame.signal, ExrType::floatType);
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
                    RELUCENT_ENGLISH_MESSAGE("device.folder-holds-recording-other-devices",
                                             "the folder holds a recording of other devices"),
                    RELUCENT_ENGLISH_MESSAGE("device.record-into-new-folder", "record into a new folder"),
                    folder_.string());
      // Files that no line names are written over.
      count_ = readPhotographs(folder_).size();
    } else if (!fs::is_empty(folder_, code)) {
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("device.folder-recording-holds-other-things",
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

Rig recorded(Rig rig, const fs::path& folder) {
  RecordedDevices devices = devicesOf(rig);
  return watched(std::move(rig), std::make_shared<Recorder>(folder, std::move(devices)));
}

}  // namespace relucent
