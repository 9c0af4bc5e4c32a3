// SPDX-License-Identifier: MIT
#include "relucent/cli/devices_document.h"

#include <fmt/format.h>

#include "relucent/base/message.h"

namespace relucent::cli {

calibration::Json toJson(const devices::CameraList& devices) {
  calibration::Json support = calibration::Json::array();
  for (const devices::CameraSupport& kind : devices.support)
    support.push_back(
        {{"kind", kind.kind}, {"available", kind.available}, {"sentence", english(kind.sentence)}});
  calibration::Json cameras = calibration::Json::array();
  for (const devices::ListedCamera& camera : devices.cameras) {
    calibration::Json entry = {
        {"address", camera.address}, {"model", english(camera.model)}, {"usable", camera.usable}};
    const devices::CameraTraits& traits = camera.traits;
    calibration::Json remarks = calibration::Json::array();
    for (const Message& remark : traits.remarks) remarks.push_back(english(remark));
    if (camera.usable)
      entry.update({{"size", {traits.size.width, traits.size.height}},
                    {"format", nameOf(traits.format)},
                    {"bits", traits.format.bits},
                    {"exposures", {traits.exposures.shortest, traits.exposures.longest}},
                    {"gain", traits.gain},
                    {"software_trigger", traits.triggered},
                    {"remarks", std::move(remarks)}});
    else
      entry["problem"] = english(camera.problem);
    cameras.push_back(std::move(entry));
  }
  return {{"support", std::move(support)}, {"cameras", std::move(cameras)}};
}

std::string textOf(const devices::CameraList& devices) {
  std::string text;
  for (const devices::ListedCamera& camera : devices.cameras) {
    const devices::CameraTraits& traits = camera.traits;
    text += fmt::format("{}  {}\n", camera.address, camera.model);
    if (!camera.usable) {
      text += fmt::format("  cannot be used: {}\n", camera.problem);
      continue;
    }
    text += fmt::format("  {}x{} pixels of {} bits ({}), exposures {:.3g} s to {:.3g} s\n", traits.size.width,
                        traits.size.height, traits.format.bits, nameOf(traits.format),
                        traits.exposures.shortest, traits.exposures.longest);
    for (const Message& remark : traits.remarks) text += fmt::format("  {}\n", remark);
  }
  if (devices.cameras.empty()) text += "No cameras answer.\n";
  text += "\nKinds of cameras:\n";
  for (const devices::CameraSupport& kind : devices.support)
    text += fmt::format("  {:<8} {} {}\n", kind.kind, kind.available ? "  " : "no", kind.sentence);
  return text;
}

calibration::Json toJson(const pipeline::RigCheck& check) {
  calibration::Json verdicts = calibration::Json::array();
  calibration::Json ids = calibration::Json::array();  // for programs: sentences are reworded at times
  for (const devices::CheckVerdict& verdict : pipeline::verdictsOf(check)) {
    const Message message = devices::messageOf(verdict);
    verdicts.push_back(english(message));
    ids.push_back(message.id());
  }
  return {{"latency_frames", check.latency.frames},
          {"latency_seconds", check.latency.seconds},
          {"step", check.latency.step},
          {"flicker", check.latency.flicker},
          {"screen",
           {{"seen", check.proof.isSeen},
            {"share", check.proof.sight.share},
            {"late", check.proof.sight.late},
            {"mirrored", check.proof.sight.mirrored}}},
          {"light",
           {{"unsteady", check.light.unsteady},
            {"brief_exposure", check.light.brief},
            {"flicker", check.light.flicker},
            {"colours", check.light.colours},
            {"bands", check.light.bands},
            {"dither", check.light.dither}}},
          {"verdicts", std::move(verdicts)},
          {"verdict_ids", std::move(ids)}};
}

std::string textOf(const pipeline::RigCheck& check) {
  std::string text;
  for (const devices::CheckVerdict& verdict : pipeline::verdictsOf(check))
    text += english(devices::messageOf(verdict)) + "\n";
  return text + fmt::format("Calibrate with --latency {:.3g}\n", check.latency.seconds);
}

}  // namespace relucent::cli
