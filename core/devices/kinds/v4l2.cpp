// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "relucent/base/message.h"
#include "relucent/devices/camera_kind.h"
#include "relucent/devices/video/video_driver.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// Paths that stay the same when a device is plugged in elsewhere, and plain ones for devices without.
std::vector<fs::path> videoDevices() {
  std::vector<fs::path> paths;
  std::set<fs::path> named;
  std::error_code code;
  for (const fs::path& link : entriesOf("/dev/v4l/by-id"))
    // Of the several devices of one webcam the first has the pictures, the others what belongs to them.
    if (link.filename().string().ends_with("-index0")) {
      paths.push_back(link);
      named.insert(fs::canonical(link, code));
    }
  for (const fs::path& device : entriesOf("/dev")) {
    const std::string name = device.filename().string();
    std::ifstream index("/sys/class/video4linux/" + name + "/index");
    int place = 0;
    if (name.starts_with("video") && !named.contains(device) && !(index >> place && place > 0))
      paths.push_back(device);
  }
  return paths;
}

Message videoModel(const fs::path& path) {
  std::error_code code;
  std::ifstream file("/sys/class/video4linux/" + fs::canonical(path, code).filename().string() + "/name");
  std::string name;
  std::getline(file, name);
  return name.empty() ? RELUCENT_MESSAGE("device.video-device", "video device") : Message::plain(name);
}

std::unique_ptr<CameraDriver> driverFor(const std::string& path, std::optional<Size> size) {
  return makeVideoDriver(openCvVideoSource(path), "v4l2:" + path, size);
}

std::unique_ptr<rig::Camera> openVideo(const std::string& place, const CameraWishes& wishes) {
  return std::make_unique<DrivenCamera>(driverFor(place, wishes.size), videoPatience());
}

std::vector<ListedCamera> listVideo() {
  std::vector<ListedCamera> cameras;
  for (const fs::path& path : videoDevices())
    cameras.push_back(judged(
        "v4l2:" + path.string(), videoModel(path), [&] { return driverFor(path.string(), std::nullopt); },
        videoPatience()));
  return cameras;
}

/// Links are other names for what they lead to.
std::vector<std::string> videoDevicesAt(const std::vector<std::string>& places) {
  std::vector<std::string> devices;
  for (const std::string& place : places) {
    std::error_code code;
    const fs::path device = fs::canonical(place, code);
    devices.push_back(code ? place : device.string());
  }
  return devices;
}

}  // namespace

CameraKind v4l2Kind() {
  return {.prefix = "v4l2",
          .place = "PATH",
          .help = "a webcam with manual exposure, /dev/v4l/by-id/...",
          .support = RELUCENT_ENGLISH_MESSAGE("device.webcams", "webcams with manual exposure"),
          .open = openVideo,
          .list = listVideo,
          .devices = videoDevicesAt};
}

}  // namespace relucent::devices
