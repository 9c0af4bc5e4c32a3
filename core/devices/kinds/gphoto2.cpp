// SPDX-License-Identifier: MIT
#include <algorithm>

#include "relucent/base/message.h"
#include "relucent/devices/camera_kind.h"
#include "relucent/devices/gphoto/gphoto_driver.h"

namespace relucent::devices {
namespace {

std::unique_ptr<rig::Camera> openGphoto(const std::string& place, const CameraWishes& wishes) {
  GphotoCameraSettings settings;
  settings.camera = place;
  settings.photograph = wishes.size;
  return std::make_unique<DrivenCamera>(makeGphotoDriver(makeGphotoPort(), settings), gphotoPatience());
}

std::vector<ListedCamera> listGphoto() {
  const std::vector<GphotoCamera> found = makeGphotoPort()->list();
  const std::vector<std::string> places = gphotoPlaces(found);
  std::vector<ListedCamera> cameras;
  for (std::size_t i = 0; i < found.size(); ++i) {
    GphotoCameraSettings settings;
    settings.camera = places[i];
    cameras.push_back(judged(
        "gphoto2:" + settings.camera, Message::plain(found[i].model),
        [&] { return makeGphotoDriver(makeGphotoPort(), settings); }, gphotoPatience()));
  }
  return cameras;
}

/// By the ports that they are plugged in at.
std::vector<std::string> gphotoDevices(const std::vector<std::string>& places) {
  const std::vector<GphotoCamera> found = makeGphotoPort()->list();
  std::vector<std::string> devices;
  for (const std::string& place : places) {
    const auto camera = std::ranges::find_if(
        found, [&place](const GphotoCamera& other) { return isSameModel(other.model, place); });
    devices.push_back(camera == found.end() ? place : camera->port);
  }
  return devices;
}

}  // namespace

CameraKind gphoto2Kind() {
  return {.prefix = "gphoto2",
          .place = "MODEL",
          .help = "DSLR or mirrorless camera; also the port it is plugged in at",
          .support =
              RELUCENT_ENGLISH_MESSAGE("device.gphoto-cameras", "DSLR and mirrorless cameras with raw files"),
          .open = openGphoto,
          .list = listGphoto,
          .devices = gphotoDevices};
}

}  // namespace relucent::devices
