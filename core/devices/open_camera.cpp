// SPDX-License-Identifier: MIT
#include "devices/open_camera.h"

#include "base/error.h"
#include "devices/command_camera.h"
#include "devices/driven_camera.h"
#include "devices/genicam_driver.h"
#include "devices/gphoto_driver.h"
#include "devices/video_driver.h"

namespace relucent {
namespace {

std::unique_ptr<Camera> openCommand(const std::string& command, const CameraWishes& wishes) {
  CommandCameraSettings settings;
  settings.command = command;
  settings.size = wishes.size;
  settings.exposures = wishes.exposures;
  const std::vector<std::string> found = problems(settings);
  if (!found.empty())
    throw Error(ErrorKind::usage, found.front(), "write it so: command:./photograph {exposure} {output}");
  return std::make_unique<CommandCamera>(std::move(settings));
}

}  // namespace

std::unique_ptr<Camera> openCamera(const DeviceAddress& address, const CameraWishes& wishes) {
  switch (address.kind) {
    case DeviceAddress::Kind::genicam: {
      GenicamSettings settings;
      settings.camera = address.place;
      settings.photograph = wishes.size;
      return std::make_unique<DrivenCamera>(makeGenicamDriver(settings));
    }
    case DeviceAddress::Kind::gphoto2: {
      GphotoCameraSettings settings;
      settings.camera = address.place;
      settings.photograph = wishes.size;
      return std::make_unique<DrivenCamera>(makeGphotoDriver(makeGphotoPort(), settings), gphotoPatience());
    }
    case DeviceAddress::Kind::v4l2:
      return std::make_unique<DrivenCamera>(
          makeVideoDriver(openCvVideoSource(address.place), toString(address), wishes.size), videoPatience());
    case DeviceAddress::Kind::command:
      break;
  }
  return openCommand(address.place, wishes);
}

}  // namespace relucent
