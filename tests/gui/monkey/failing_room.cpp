// SPDX-License-Identifier: MIT
#include "gui/monkey/failing_room.h"

namespace relucent::gui {
namespace {

constexpr std::uint64_t nearlyFull = 2 << 20;
constexpr float darkest = 0.02f;

}  // namespace

FailingRoom::FailingRoom(const std::filesystem::path& cache, test::SmallDisk& disk)
    : disk_(disk), room_(std::get<venue::VenueSettings>(simulatedSettings().rig), cache) {}

bool FailingRoom::isBright() const {
  const image::Image light = screen_.look(wantedSizes().projector);
  return std::ranges::any_of(light.data(), [](float value) { return value > darkest; });
}

double FailingRoom::sinceChange() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - changed_).count();
}

QString FailingRoom::plugScreen(bool on) {
  switchScreen(on);
  isScreenPlugged_ = on;
  return on ? "plugs the screen" : "unplugs the screen";
}

QString FailingRoom::plugCamera(bool on) {
  if (on)
    room_.camera().plug();
  else
    room_.camera().unplug();
  isCameraPlugged_ = on;
  return on ? "plugs the camera" : "unplugs the camera";
}

QString FailingRoom::bump(double pixels) {
  room_.bump(pixels);
  isBumped_ = pixels != 0.0;
  return isBumped_ ? QString("bumps the camera by %1 px").arg(pixels) : "puts the camera back";
}

QString FailingRoom::fillDisk(bool full) {
  if (full)
    disk_.fillUpTo(nearlyFull);
  else
    disk_.makeRoom();
  isDiskFull_ = full;
  return full ? "fills the disk" : "makes room on the disk";
}

QString FailingRoom::change(std::mt19937& random) {
  changed_ = std::chrono::steady_clock::now();
  // What failed is mended more readily than something else fails besides.
  if (random() % 4 != 0) {
    if (!isScreenPlugged_) return plugScreen(true);
    if (!isCameraPlugged_) return plugCamera(true);
    if (isDiskFull_) return fillDisk(false);
    if (isBumped_) return bump(0.0);
  }
  switch (random() % 8) {
    case 0:
    case 1:
    case 2:
      return plugScreen(!isScreenPlugged_);
    case 3:
    case 4:
      return plugCamera(!isCameraPlugged_);
    case 5:
      if (disk_.isMounted()) return fillDisk(!isDiskFull_);
      [[fallthrough]];
    default:
      return bump(isBumped_ ? 0.0 : 3.0);
  }
}

void FailingRoom::putRight() {
  if (!isScreenPlugged_) plugScreen(true);
  if (!isCameraPlugged_) plugCamera(true);
  if (isBumped_) bump(0.0);
  if (isDiskFull_) fillDisk(false);
  changed_ = std::chrono::steady_clock::now();
}

}  // namespace relucent::gui
