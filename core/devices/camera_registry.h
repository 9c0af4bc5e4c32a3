// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/camera_address.h"
#include "relucent/devices/camera_kind.h"

namespace relucent::devices {

/// Whether this build can speak to a kind of camera.
struct CameraSupport {
  std::string kind;  // "genicam"
  bool available = false;
  Message sentence;  // what it is, or what is missing
};

struct CameraList {
  std::vector<CameraSupport> support;
  std::vector<ListedCamera> cameras;
};

/// The kinds of cameras that the program knows, in the order in which they are listed.
class CameraRegistry {
 public:
  /// Throws: std::logic_error if two kinds have one prefix, or one has none or cannot be opened.
  explicit CameraRegistry(std::vector<CameraKind> kinds);

  const std::vector<CameraKind>& kinds() const { return kinds_; }
  /// None if there is no such kind.
  const CameraKind* find(std::string_view prefix) const;

  /// None unless the text begins with a kind and a colon, and names a place.
  std::optional<CameraAddress> addressFrom(std::string_view text) const;
  /// The same for whoever needs one. Throws: Error{usage} if there is none.
  CameraAddress requiredAddress(const std::string& text) const;
  /// Why there is no such address, or can be no camera at it; see CameraKind::problems.
  std::vector<Message> problems(const std::string& text) const;
  /// "genicam:SERIAL, gphoto2:MODEL, ... or command:CMD", for sentences.
  std::string addressForms() const;
  /// A line a kind with its form and its help, for help texts.
  std::string help() const;

  /// The camera at an address, ready for use. Throws: as CameraKind::open; std::logic_error for a kind that
  /// is not here, which addressFrom() never gives.
  std::unique_ptr<rig::Camera> open(const CameraAddress& address, const CameraWishes& wishes) const;
  /// Which device each address is, "genicam:192.168.1.20": equal texts for one that is given in two ways, by
  /// its serial number and by its network address. May take a second for the network.
  std::vector<std::string> devicesAt(const std::vector<CameraAddress>& addresses) const;
  /// Looks for cameras of all kinds and opens each of them for a moment to learn what it can do and what is
  /// wrong with it. Takes a second for the network and up to some seconds for a camera that does not answer.
  CameraList list() const;

 private:
  std::vector<CameraKind> kinds_;
};

/// The kinds that core/devices/CMakeLists.txt names.
const CameraRegistry& cameraRegistry();

}  // namespace relucent::devices
