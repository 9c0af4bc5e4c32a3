// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/pipeline/rig_settings.h"

namespace relucent::cli {

/// Cameras as the command line names them, one after the other: by addresses, or by commands.
struct CameraChoices {
  std::vector<std::string> addresses, commands;
  std::vector<Size> sizes;             // --camera WxH: of photographs by commands, or of a venue's camera
  std::vector<Size> sizesOfAddressed;  // --camera-size

  /// What --camera says: a camera's address or a size. Throws: WrongUsage if it is neither.
  void read(const std::string& text);
  /// In their order.  Contract: there are addresses or commands.
  /// Throws: WrongUsage if sizes are given, but neither one for each nor one for all.
  std::vector<pipeline::CommandRigSettings::Camera> chosen() const;
};

/// The size of each device: those given, or the one that is given for all.
/// Throws: WrongUsage if there are neither as many as devices nor one.
std::vector<Size> onePerDevice(const std::vector<Size>& sizes, std::size_t devices, const char* option);

}  // namespace relucent::cli
