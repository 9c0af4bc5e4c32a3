// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/listed_camera.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

/// What whoever opens a camera wants of it.
struct CameraWishes {
  std::optional<Size> size;                 // of photographs; none: all that the camera has
  rig::ExposureRange exposures{1e-3, 4.0};  // of cameras that cannot be asked for theirs
  int ofSeveral = 0;                        // 1, 2, ...: tells apart cameras that have no name of their own
};

/// One kind of camera: all that the rest of the program knows about it.
struct CameraKind {
  std::string prefix;     // "genicam": what stands before the colon in its addresses
  std::string place;      // "SERIAL": what stands behind it, for sentences
  std::string help;       // what a place may be, one line for help texts
  Message support;        // what cameras these are; of a kind that is not built in: what this build lacks
  bool isBuiltIn = true;  // false: open() throws Error{device} with advice, and there is nothing to list

  /// The camera at a place, ready for use. Throws: Error{device} if it is not there or cannot be used;
  /// Error{usage} if there can be no such place.
  std::function<std::unique_ptr<rig::Camera>(const std::string& place, const CameraWishes& wishes)> open;
  /// Cameras that answer now, each opened for a moment. Empty: such cameras cannot be looked for.
  std::function<std::vector<ListedCamera>()> list = {};
  /// Of several places, which device each is: equal texts, for people to read, where one can be given in
  /// more than one way. Of a camera that does not answer its place. Empty: each place is a device.
  std::function<std::vector<std::string>(const std::vector<std::string>& places)> devices = {};
  /// What keeps a text, which may be empty, from being a place, told without asking a device. Empty: any text
  /// but an empty one may be a place.
  std::function<std::vector<Message>(const std::string& place)> problems = {};
};

}  // namespace relucent::devices
