// SPDX-License-Identifier: MIT
#include "relucent/devices/camera_registry.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace {

std::string formOf(const CameraKind& kind) {
  return kind.prefix + ":" + kind.place;
}

}  // namespace

std::string toString(const CameraAddress& address) {
  return address.kind + ":" + address.place;
}

CameraRegistry::CameraRegistry(std::vector<CameraKind> kinds) : kinds_(std::move(kinds)) {
  for (const CameraKind& kind : kinds_) {
    require(!kind.prefix.empty() && kind.open, "a camera kind '{}' that cannot be opened", kind.prefix);
    require(find(kind.prefix) == &kind, "two camera kinds '{}'", kind.prefix);
  }
}

const CameraKind* CameraRegistry::find(std::string_view prefix) const {
  const auto found =
      std::ranges::find_if(kinds_, [&](const CameraKind& kind) { return kind.prefix == prefix; });
  return found == kinds_.end() ? nullptr : &*found;
}

std::optional<CameraAddress> CameraRegistry::addressFrom(std::string_view text) const {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon + 1 == text.size()) return std::nullopt;
  const CameraKind* kind = find(text.substr(0, colon));
  if (kind == nullptr) return std::nullopt;
  return CameraAddress{kind->prefix, std::string(text.substr(colon + 1))};
}

CameraAddress CameraRegistry::requiredAddress(const std::string& text) const {
  if (const std::optional<CameraAddress> address = addressFrom(text)) return *address;
  throw Error(ErrorKind::usage,
              RELUCENT_ENGLISH_MESSAGE("device.not-a-camera", "'{}' is not a camera").with(text),
              RELUCENT_ENGLISH_MESSAGE("device.write-camera-address", "write {}").with(addressForms()));
}

std::vector<Message> CameraRegistry::problems(const std::string& text) const {
  const std::size_t colon = text.find(':');
  const CameraKind* kind = colon == std::string::npos ? nullptr : find(text.substr(0, colon));
  if (kind != nullptr && kind->problems) return kind->problems(text.substr(colon + 1));
  if (addressFrom(text)) return {};
  return {RELUCENT_ENGLISH_MESSAGE("device.camera-address-invalid", "'{}' is not a camera: write {}")
              .with(text, addressForms())};
}

std::string CameraRegistry::addressForms() const {
  std::string forms;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (i > 0) forms += i + 1 < kinds_.size() ? ", " : " or ";
    forms += formOf(kinds_[i]);
  }
  return forms;
}

std::string CameraRegistry::help() const {
  std::size_t width = 0;
  for (const CameraKind& kind : kinds_) width = std::max(width, formOf(kind).size());
  std::string lines;
  for (const CameraKind& kind : kinds_)
    lines += fmt::format("{}  {:<{}}  {}", lines.empty() ? "" : "\n", formOf(kind), width, kind.help);
  return lines;
}

std::unique_ptr<rig::Camera> CameraRegistry::open(const CameraAddress& address,
                                                  const CameraWishes& wishes) const {
  const CameraKind* kind = find(address.kind);
  require(kind != nullptr, "no camera kind '{}'", address.kind);
  return kind->open(address.place, wishes);
}

std::vector<std::string> CameraRegistry::devicesAt(const std::vector<CameraAddress>& addresses) const {
  std::vector<std::string> devices(addresses.size());
  for (const CameraKind& kind : kinds_) {
    std::vector<std::string> places;
    for (const CameraAddress& address : addresses)
      if (address.kind == kind.prefix) places.push_back(address.place);
    if (kind.devices && !places.empty()) places = kind.devices(places);
    auto place = places.begin();
    for (std::size_t i = 0; i < addresses.size(); ++i)
      if (addresses[i].kind == kind.prefix) devices[i] = toString({kind.prefix, *place++});
  }
  return devices;
}

CameraList CameraRegistry::list() const {
  CameraList found;
  for (const CameraKind& kind : kinds_) {
    found.support.push_back({kind.prefix, kind.isBuiltIn, kind.support});
    if (!kind.list) continue;
    for (ListedCamera& camera : kind.list()) found.cameras.push_back(std::move(camera));
  }
  return found;
}

}  // namespace relucent::devices
