// SPDX-License-Identifier: MIT
// A room to try the program in by hand, see README.md.
#include <fmt/format.h>

#include <QGuiApplication>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "gui/wizard/gige_room.h"
#include "relucent/base/error.h"
#include "relucent/cli/change_options.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

using venue::FaultKind;
const std::map<std::string, FaultKind> happenings{{"bump", FaultKind::shiftedCamera},
                                                  {"light", FaultKind::ambient},
                                                  {"hand", FaultKind::hand},
                                                  {"flicker", FaultKind::flicker},
                                                  {"cover", FaultKind::coveredLens}};

/// Obeys lines until one says otherwise; what a line came to is printed.
class Lines {
 public:
  explicit Lines(Room& room) : room_(room) {}

  bool obey(const std::string& line) {
    std::istringstream words(line);
    std::string what, how;
    words >> what >> how;
    if (what == "quit") return false;
    if (!what.empty()) fmt::print("{}\n", told(what, how));
    std::fflush(stdout);
    return true;
  }

 private:
  std::string told(const std::string& what, const std::string& how) {
    if (const auto found = happenings.find(what); found != happenings.end())
      return happen(found->second, how);
    if (what == "camera" || what == "projector") return plug(what == "camera", how);
    if (what == "look") return fmt::format("{} photographs", room_.photographs());
    if (what == "restore") return change({});
    if (what == "change") return changeBy(how);
    return fmt::format("'{}' is nothing that happens here, see tests/gui/room/README.md", what);
  }

  std::string happen(FaultKind kind, const std::string& how) {
    venue::DeviceFault fault;
    fault.kind = kind;
    std::istringstream number(how);
    if (!(number >> fault.amount)) return "how much? 0 ends it";
    if (kind == FaultKind::hand) {
      constexpr double from = 0.4, to = 0.6;  // the middle
      fault.x0 = fault.y0 = from;
      fault.x1 = fault.y1 = to;
    }
    room_.happen(fault);
    return "so it is";
  }

  std::string plug(bool isCamera, const std::string& how) {
    if (how != "on" && how != "off") return "on or off?";
    const bool isOn = how == "on";
    if (!isCamera)
      switchScreen(isOn);
    else if (isOn)
      room_.camera().plug();
    else
      room_.camera().unplug();
    return "so it is";
  }

  std::string changeBy(const std::string& how) {
    CLI::App parser;
    venue::Changes changes = changes_;
    cli::addChanges(&parser, changes);
    try {
      parser.parse("--change " + how);
    } catch (const std::exception& wrong) {
      return wrong.what();
    }
    return change(changes);
  }

  std::string change(const venue::Changes& changes) {
    room_.change(changes);
    changes_ = changes;
    return "so it is";
  }

  Room& room_;
  venue::Changes changes_;
};

}  // namespace

int main(int argc, char** argv) {
  QGuiApplication application(argc, argv);
  CLI::App options("A room to try the program in: a venue behind a screen and a GigE Vision camera");
  pipeline::CalibrateSettings settings = simulatedSettings();
  auto venue = std::get<venue::VenueSettings>(settings.rig);
  std::string cache = (std::filesystem::temp_directory_path() / "relucent-room").string();
  options.add_option("--venue", venue.name, "a simulated venue's name");
  options.add_option("--seed", venue.seed, "of its devices' noise");
  options.add_option("--cache", cache, "folder for what is traced");
  CLI11_PARSE(options, argc, argv);
  try {
    bool isGiven = false;
    RoomDevices devices;
    devices.framesPerSecond = qEnvironmentVariableIntValue("PROJECTOR_RATE", &isGiven);
    if (!isGiven) devices.framesPerSecond = 60.0;  // as tests/support/with-two-screens has it
    Room room(venue, cache, devices);
    if (!room.isRunning()) {
      fmt::print(stderr, "room: the port of GigE Vision is taken, or there is no loopback network\n");
      return 1;
    }
    fmt::print("ready\n");
    std::fflush(stdout);
    Lines lines(room);
    for (std::string line; std::getline(std::cin, line) && lines.obey(line);) continue;
  } catch (const Error& error) {
    fmt::print(stderr, "room: {}\n", error.what());
    return 1;
  }
  return 0;
}
