// SPDX-License-Identifier: MIT
#include <array>
#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

/// What an action is told besides the calibration.
struct Names {
  std::size_t count;
  const char* what;
};
constexpr std::array<Names, 5> namesOfActions{{{0, "no name"},
                                               {1, "the name of a set"},
                                               {1, "the name of a set"},
                                               {2, "the name of a set, and its new one"},
                                               {1, "the name of a set"}}};

}  // namespace

CLI::Option* addSet(CLI::App* sub, std::string& set, const char* what,
                    const std::vector<CLI::Option*>& others) {
  CLI::Option* option = sub->add_option_function<std::string>(
                               "--set",
                               [&set](const std::string& name) {
                                 if (name.empty()) throw WrongUsage("--set needs the name of a set");
                                 set = name;
                               },
                               what)
                            ->type_name("NAME");
  for (CLI::Option* other : others) option->excludes(other);
  return option;
}

std::function<Command()> addSetsOptions(CLI::App* sub) {
  auto command = std::make_shared<Sets>();
  addFolder(sub, command->calibration, "Folder of the calibration");
  sub->add_option_function<std::string>(
         "ACTION",
         [command](const std::string& name) {
           command->action = parsedName<SetAction>(name, ErrorKind::usage);
         },
         "list, save NAME, use NAME, rename NAME NEW, or remove NAME")
      ->check(CLI::IsMember(allNames<SetAction>()))
      ->default_str("list");
  sub->add_option("NAME", command->names, "Of the set; of rename: and its new one")->expected(0, 2);
  sub->footer(
      "A set is what is shown and how: picture, place, brightness, method, masks. One is in use: what is\n"
      "changed in Preview or by masks is changed in it, and commands without --set work with it. save gives\n"
      "what is in use another name and goes on with that one. relucent show --set, --set-at and OSC switch.");
  return [command] {
    const Names& names = namesOfActions[static_cast<std::size_t>(command->action)];
    if (command->names.size() != names.count)
      throw WrongUsage(fmt::format("sets {} takes {}", nameOf(command->action), names.what));
    return Command(*command);
  };
}

}  // namespace relucent::cli
