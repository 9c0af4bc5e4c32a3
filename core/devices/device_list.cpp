// SPDX-License-Identifier: MIT
#include "devices/device_list.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "devices/device_address.h"
#include "devices/genicam_driver.h"
#include "devices/gphoto_driver.h"
#include "devices/video_driver.h"

namespace relucent {
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

std::string videoModel(const fs::path& path) {
  std::error_code code;
  std::ifstream file("/sys/class/video4linux/" + fs::canonical(path, code).filename().string() + "/name");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "video device" : name;
}

void addStillCameras(DeviceList& list) {
  const std::vector<GphotoCamera> cameras = makeGphotoPort()->list();
  const std::vector<std::string> places = gphotoPlaces(cameras);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    GphotoCameraSettings settings;
    settings.camera = places[i];
    list.cameras.push_back(judged(
        "gphoto2:" + settings.camera, cameras[i].model,
        [&] { return makeGphotoDriver(makeGphotoPort(), settings); }, gphotoPatience()));
  }
}

}  // namespace

ListedCamera judged(std::string address, std::string model,
                    const std::function<std::unique_ptr<CameraDriver>()>& open,
                    const DrivenCameraSettings& settings) {
  ListedCamera camera{std::move(address), std::move(model), false};
  try {
    camera.traits = DrivenCamera(open(), settings).traits();
    camera.usable = true;
  } catch (const Error& error) {
    camera.problem = error.summary() + "; " + error.advice();
  }
  return camera;
}

DeviceList listDevices() {
  DeviceList list;
  list.support = {
      {"genicam", hasGenicam(),
       hasGenicam()
           ? "GigE Vision and USB3 Vision cameras"
           : "GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build "
             "again"},
      {"gphoto2", hasGphoto(),
       hasGphoto()
           ? "DSLR and mirrorless cameras with raw files"
           : "DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev "
             "and libraw-dev and build again"},
      {"v4l2", true, "webcams with manual exposure"},
      {"command", true, "anything that a program of yours can drive"}};
  for (const GenicamCamera& found : findGenicamCameras()) {
    GenicamSettings settings;
    settings.camera = found.serial.empty() ? found.address : found.serial;
    list.cameras.push_back(
        judged("genicam:" + settings.camera, found.model, [&] { return makeGenicamDriver(settings); }, {}));
  }
  if (hasGphoto()) addStillCameras(list);
  for (const fs::path& path : videoDevices()) {
    const std::string address = "v4l2:" + path.string();
    list.cameras.push_back(judged(
        address, videoModel(path),
        [&] { return makeVideoDriver(openCvVideoSource(path.string()), address, std::nullopt); },
        videoPatience()));
  }
  return list;
}

}  // namespace relucent
