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

/// What --camera says: a camera's address or a size. Throws: WrongUsage.
inline void readCamera(const std::string& text, CommandRigSettings& commands, Size& size) {
  if (deviceAddressFrom(text))
    commands.cameraAddress = text;
  else if (text.find(':') != std::string::npos)
    throw WrongUsage(fmt::format("'{}' is no camera: write {}", text, deviceAddressForms));
  else
    size = parseSize(text);
}

/// Each defines the options of one subcommand and returns what makes its command once they are read.
std::function<Command()> addDevicesOptions(CLI::App* sub);
std::function<Command()> addCheckOptions(CLI::App* sub);
std::function<Command()> addCalibrateOptions(CLI::App* sub);
std::function<Command()> addResumeOptions(CLI::App* sub);
std::function<Command()> addVerifyOptions(CLI::App* sub);
std::function<Command()> addProveOptions(CLI::App* sub);
std::function<Command()> addImportOptions(CLI::App* sub);
std::function<Command()> addPlanOptions(CLI::App* sub);
std::function<Command()> addCompensateOptions(CLI::App* sub);
std::function<Command()> addEvaluateOptions(CLI::App* sub);
std::function<Command()> addExportOptions(CLI::App* sub);
std::function<Command()> addRelightOptions(CLI::App* sub);
std::function<Command()> addDualOptions(CLI::App* sub);
std::function<Command()> addSeparateOptions(CLI::App* sub);
std::function<Command()> addDifferenceOptions(CLI::App* sub);
std::function<Command()> addReportOptions(CLI::App* sub);
std::function<Command()> addBenchOptions(CLI::App* sub);

}  // namespace relucent
