// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "cli/arguments.h"
#include "devices/device_address.h"

/// Options that several subcommands share; met inside the parser only.
namespace relucent {

inline CLI::Option* addFolder(CLI::App* sub, std::filesystem::path& folder, const char* what) {
  return sub->add_option("CALIBRATION", folder, what)->required();
}

inline void addCache(CLI::App* sub, std::filesystem::path& cache) {
  cache = defaultCache();
  sub->add_option("--cache", cache, "Folder where simulated venues are kept once they are traced")
      ->type_name("DIR")
      ->capture_default_str();
}

inline CLI::Option* addSize(CLI::App* sub, const char* name, Size& size, const char* what) {
  return sub
      ->add_option_function<std::string>(
          name, [&size](const std::string& text) { size = parseSize(text); }, what)
      ->type_name("WxH");
}

/// Defines the options of `check`. Returns what makes the command once they are read.
std::function<Command()> addCheckOptions(CLI::App* sub);

/// What --camera says: a camera's address or a size. Throws: WrongUsage.
inline void readCamera(const std::string& text, CommandRigSettings& commands, Size& size) {
  if (deviceAddressFrom(text))
    commands.cameraAddress = text;
  else if (text.find(':') != std::string::npos)
    throw WrongUsage(fmt::format("'{}' is no camera: write {}", text, deviceAddressForms));
  else
    size = parseSize(text);
}

/// Defines the options of `calibrate`. Returns what makes the command once they are read.
std::function<Command()> addCalibrateOptions(CLI::App* sub);

/// Defines the options of `bench`. Returns what makes the command once they are read.
std::function<Command()> addBenchOptions(CLI::App* sub);

}  // namespace relucent
