// SPDX-License-Identifier: MIT
#include "cli/devices_document.h"

#include <fmt/format.h>

#include "base/message.h"

namespace relucent {

Json toJson(const CameraList& devices) {
  Json support = Json::array();
  for (const CameraSupport& kind : devices.support)
    support.push_back(
        {{"kind", kind.kind}, {"available", kind.available}, {"sentence", english(kind.sentence)}});
  Json cameras = Json::array();
  for (const ListedCamera& camera : devices.cameras) {
    Json entry = {{"address", camera.address}, {"model", english(camera.model)}, {"usable", camera.usable}};
    const CameraTraits& traits = camera.traits;
    Json remarks = Json::array();
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

std::string textOf(const CameraList& devices) {
  std::string text;
  for (const ListedCamera& camera : devices.cameras) {
    const CameraTraits& traits = camera.traits;
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
  for (const CameraSupport& kind : devices.support)
    text += fmt::format("  {:<8} {} {}\n", kind.kind, kind.available ? "  " : "no", kind.sentence);
  return text;
}

Json toJson(const RigCheck& check) {
  Json verdicts = Json::array();
  for (const CheckVerdict& verdict : verdictsOf(check)) verdicts.push_back(english(messageOf(verdict)));
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
          {"verdicts", std::move(verdicts)}};
}

std::string textOf(const RigCheck& check) {
  std::string text;
  for (const CheckVerdict& verdict : verdictsOf(check)) text += english(messageOf(verdict)) + "\n";
  return text + fmt::format("Calibrate with --latency {:.3g}\n", check.latency.seconds);
}

}  // namespace relucent
