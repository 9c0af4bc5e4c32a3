// SPDX-License-Identifier: MIT
// What stands on command lines and in dialogs: sizes, addresses, times.
#include "fuzz/targets.h"
#include "relucent/cli/arguments.h"
#include "relucent/cli/device_choices.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/shutter_speed.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pjlink/address.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/rehearsal/show_health.h"

namespace relucent::fuzz {
namespace {

std::vector<std::string> commandSeeds() {
  return {"calibrate\nvenue\n--venue\ncorner\n--projector\n64x48\n--camera\n64x48\n--camera-pixels\n1/2",
          "calibrate\nvenue\n--camera\ngenicam:1\n--camera-size\n640x480\n--projector-command\nshow {image}",
          "calibrate\nvenue\n--acquisition\nfast\n--levels\n5\n--mask\n1:0.1,0.1,0.5,0.5,0.2,0.9",
          "compensate\nvenue\n--image\na.png\n--method\nrefined\n--out\nb\n--corners\n0,0,1,0,1,1,0,1",
          "repair\nvenue\n--change\npainted:0.4,0.5,0.15\n--change\nturned:camera,1,2,3",
          "verify\nvenue\n--change\nmoved:0.1,0.2,0.3\n--json",
          "evaluate\nvenue\n--viewer\n0.1,0.2\n--rival\nradiometric\n--view-weights\n1,2",
          "night\nvenue\n--content\na.playlist\n--alarm\nmail\n--history",
          "projectors\nvenue\n--pjlink\n1=192.168.1.20:4352\n--search\n--warm-up\nsteady",
          "plan\nfolder\n--projector\n1024x768\n--random\n8",
          "bench\nscale\n--sizes\n1024x768/640x480",
          "export\nvenue\n--mpcdi\na.mpcdi\n--canvas\n1920x1080",
          "tidy\nvenue\n--dry-run\n--keep\nresults",
          "sets\nvenue\nsave\nMorning",
          "rehearse-day\n--days\n3\n--day-seconds\n30",
          "import\nvenue\n--patterns\na\n--photographs\nb\n--hold-out\n5"};
}
void fuzzCommandLine(Bytes input) {
  std::vector<std::string> arguments(1);
  for (const char letter : textOf(input)) {
    if (letter == '\n')
      arguments.emplace_back();
    else if (letter != '\0')
      arguments.back() += letter;
  }
  if (arguments.size() > 100) arguments.resize(100);
  cli::parseArguments(arguments);
}

std::vector<std::string> wordSeeds() {
  return {"256x192",
          "1920X1080",
          "192.168.1.20:4352",
          "[fe80::1%eth0]:4352",
          "projector.local",
          "1=host:80",
          "genicam:40012345",
          "gphoto2:Canon EOS 80D",
          "v4l2:/dev/video0",
          "1/125",
          "0,5",
          "1.3s",
          "30\"",
          "0\"5",
          "1/1,5",
          "Bulb",
          "lit:2",
          "all",
          "1/4",
          "2026-11-26T22:00:00Z",
          "Morning",
          "auto",
          "lit"};
}
void fuzzWords(Bytes input) {
  const std::string word(textOf(input));
  pjlink::addressFrom(word);
  devices::cameraRegistry().addressFrom(word);
  devices::secondsFromShutter(word);
  devices::isBulb(word);
  const devices::ShutterList list({word, "1/125", "2", "bulb"});
  list.nearest(0.1);
  list.needsBulb(100.0);
  reduction::pixelUseFrom(word);
  rehearsal::showTimeFrom(word);
  pipeline::problemOfSetName(word);
  pipeline::projectorNamed(pipeline::CommandRigSettings{}, word);
  const auto mayRefuse = [](const auto& read) {
    try {
      read();
    } catch (const Error&) {
    } catch (const cli::WrongUsage&) {
    }
  };
  mayRefuse([&] { cli::parseSize(word); });
  mayRefuse([&] { cli::CameraChoices().read(word); });
  mayRefuse([&] {
    pipeline::NetworkProjectors projectors;
    pipeline::addAddress(projectors, pipeline::CommandRigSettings{}, word);
  });
}

}  // namespace

std::vector<FuzzTarget> wordTargets() {
  const std::vector<std::string> options{
      "--projector", "--camera", "--json",   "--help",      "--version", "--change",      "--mask",
      "--content",   "--out",    "\n",       "=",           "painted:",  "turned:",       "--set",
      "--method",    "-1",       "--canvas", "--exposures", "--levels",  "--acquisition", "--camera-pixels",
      "--day",       "1/0",      "--ridge",  "nan"};
  return {{"command line", fuzzCommandLine, commandSeeds, Form::bytes, 60, options},
          {"words",
           fuzzWords,
           wordSeeds,
           Form::bytes,
           4000,
           {"x", ":", "=", "/", "[", "]", "%", "\"", "s", ",", ".", "bulb", "genicam:", "1e999", "65536"}}};
}

}  // namespace relucent::fuzz
