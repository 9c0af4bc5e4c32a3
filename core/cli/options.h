// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "relucent/base/enum_names.h"
#include "relucent/cli/arguments.h"
#include "relucent/reduction/pixel_use.h"

/// Options that several subcommands share; met inside the parser only.
namespace relucent::cli {

inline CLI::Option* addFolder(CLI::App* sub, std::filesystem::path& folder, const char* what) {
  return sub->add_option("CALIBRATION", folder, what)->required();
}

inline void addCache(CLI::App* sub, std::filesystem::path& cache) {
  cache = defaultCache();
  sub->add_option("--cache", cache, "Folder where traced simulated venues are cached")
      ->type_name("DIR")
      ->capture_default_str();
}

inline CLI::Option* addSize(CLI::App* sub, const char* name, Size& size, const char* what) {
  return sub
      ->add_option_function<std::string>(
          name, [&size](const std::string& text) { size = parseSize(text); }, what)
      ->type_name("WxH");
}

/// An option that may be given several times, one value each; `use` is called for each, in their order.
inline CLI::Option* addRepeated(CLI::App* sub, const char* name, std::function<void(const std::string&)> use,
                                const char* what) {
  return sub
      ->add_option_function<std::vector<std::string>>(
          name,
          [use = std::move(use)](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) use(text);
          },
          what)
      ->allow_extra_args(false);
}

inline CLI::Option* addSizes(CLI::App* sub, const char* name, std::vector<Size>& sizes, const char* what) {
  return addRepeated(
             sub, name, [&sizes](const std::string& text) { sizes.push_back(parseSize(text)); }, what)
      ->type_name("WxH");
}

/// The names of an enumeration as help lists them: "fista (accelerated projected gradient), ...".
template <NamedEnum Enum>
std::string listOfNames() {
  std::string list;
  for (const EnumName<Enum>& entry : enumEntries<Enum>()) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", entry.name);
    if (!entry.description.empty()) list += fmt::format(" ({})", entry.description);
  }
  return list;
}

/// An option that takes one of an enumeration's names, and nothing else.
template <NamedEnum Enum>
CLI::Option* addNamed(CLI::App* sub, const char* option, const std::string& what,
                      std::function<void(Enum)> use) {
  return sub
      ->add_option_function<std::string>(
          option, [use](const std::string& name) { use(parsedName<Enum>(name, ErrorKind::usage)); }, what)
      ->check(CLI::IsMember(allNames<Enum>()));
}
template <NamedEnum Enum>
CLI::Option* addNamed(CLI::App* sub, const char* option, const std::string& what, Enum& value) {
  return addNamed<Enum>(sub, option, what, [&value](Enum chosen) { value = chosen; })
      ->default_str(std::string(nameOf(value)));
}
/// The same for one that may be given several times.
template <NamedEnum Enum>
CLI::Option* addNamed(CLI::App* sub, const char* option, const std::string& what, std::vector<Enum>& values) {
  return sub
      ->add_option_function<std::vector<std::string>>(
          option,
          [&values](const std::vector<std::string>& names) {
            values.clear();
            for (const std::string& name : names) values.push_back(parsedName<Enum>(name, ErrorKind::usage));
          },
          what)
      ->check(CLI::IsMember(allNames<Enum>()));
}

/// Stills that a show has: --content, --canvas as it scales them, --photographs of each. `what` is done to
/// them. Returns the first.
inline CLI::Option* addStills(CLI::App* sub, std::vector<std::filesystem::path>& content,
                              compensation::ContentCanvas& canvas, int& photographs,
                              const std::string& what) {
  canvas.size = {1920, 1080};  // as a show's
  CLI::Option* option =
      sub->add_option("--content", content,
                      "A picture, a folder of pictures or a playlist, of which the stills " + what +
                          "; may be given several times")
          ->type_name("FILE");
  addSize(sub, "--canvas", canvas.size, "Size to which the show scales content")->default_str("1920x1080");
  sub->add_option("--photographs", photographs, "Photographs of a picture, at most, before the last two")
      ->type_name("COUNT")
      ->capture_default_str();
  return option;
}

/// What to do where the disk is full: --full-disk.
inline void addFullDisk(CLI::App* sub, FullDiskAction& action) {
  addNamed(sub, "--full-disk", "Where the disk is full: " + listOfNames<FullDiskAction>(), action)
      ->type_name("ACTION");
}

inline CLI::Option* addPixelUse(CLI::App* sub, reduction::PixelUse& use) {
  return sub
      ->add_option_function<std::string>(
          "--camera-pixels",
          [&use](const std::string& text) {
            const std::optional<reduction::PixelUse> read = reduction::pixelUseFrom(text);
            if (!read)
              throw WrongUsage(
                  fmt::format("'{}' is no choice of camera pixels: write auto, all or 1/N, N from 1 to {}",
                              text, reduction::mostBin));
            use = *read;
          },
          "Pixels of the camera to use: auto (about as many of what is lit as the projector has), all, or "
          "1/N (of what is lit, NxN become one)")
      ->type_name("auto|all|1/N")
      ->default_str(reduction::toString(use));
}

/// Each defines the options of one subcommand and returns what makes its command once they are read.
std::function<Command()> addDevicesOptions(CLI::App* sub);
std::function<Command()> addCheckOptions(CLI::App* sub);
std::function<Command()> addCalibrateOptions(CLI::App* sub);
std::function<Command()> addResumeOptions(CLI::App* sub);
std::function<Command()> addVerifyOptions(CLI::App* sub);
std::function<Command()> addProveOptions(CLI::App* sub);
std::function<Command()> addPerfectOptions(CLI::App* sub);
std::function<Command()> addRepairOptions(CLI::App* sub);
std::function<Command()> addNightOptions(CLI::App* sub);
std::function<Command()> addRehearseOptions(CLI::App* sub);
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
std::function<Command()> addTidyOptions(CLI::App* sub);
std::function<Command()> addMasksOptions(CLI::App* sub);
std::function<Command()> addSetsOptions(CLI::App* sub);
/// --set: in place of the options of `others`, which say the same one by one.
CLI::Option* addSet(CLI::App* sub, std::string& set, const char* what,
                    const std::vector<CLI::Option*>& others = {});
/// --mask and --masks: what the command line says of masks, none if nothing.
void addMasks(CLI::App* sub, std::optional<std::vector<compensation::Mask>>& masks, const char* otherwise);
std::function<Command()> addProjectorsOptions(CLI::App* sub);
std::function<Command()> addBenchOptions(CLI::App* sub);

}  // namespace relucent::cli
