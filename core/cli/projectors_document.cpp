// SPDX-License-Identifier: MIT
#include "relucent/cli/projectors_document.h"

#include <fmt/format.h>

#include "relucent/base/message.h"

namespace relucent::cli {
namespace {

calibration::Json textOrNull(const std::string& text) {
  return text.empty() ? calibration::Json() : calibration::Json(text);
}

calibration::Json sizeOrNull(const std::optional<Size>& size) {
  return size ? calibration::Json{size->width, size->height} : calibration::Json();
}

calibration::Json signalOf(const pjlink::Report& report) {
  if (!report.signal || report.signal->kind == pjlink::Signal::Kind::unknown) return {};
  return report.signal->kind == pjlink::Signal::Kind::none ? calibration::Json("none")
                                                           : sizeOrNull(report.signal->size);
}

calibration::Json shutterOf(const pjlink::Report& report) {
  if (!report.shutter) return {};
  return report.shutter->picture ? "closed" : "open";
}

calibration::Json toJson(const pjlink::Report& report) {
  calibration::Json lamps = calibration::Json::array(), errors = calibration::Json::array();
  for (const pjlink::Lamp& lamp : report.lamps) lamps.push_back({{"hours", lamp.hours}, {"lit", lamp.lit}});
  for (const pjlink::Trouble& trouble : report.troubles)
    errors.push_back({{"part", nameOf(trouble.part)}, {"level", trouble.isError ? "error" : "warning"}});
  return {{"name", textOrNull(report.name)},
          {"maker", textOrNull(report.maker)},
          {"model", textOrNull(report.model)},
          {"serial", textOrNull(report.serial)},
          {"class", report.protocolClass},
          {"power", report.power ? calibration::Json(nameOf(*report.power)) : calibration::Json()},
          {"shutter", shutterOf(report)},
          {"lamps", std::move(lamps)},
          {"filter_hours", report.filterHours ? calibration::Json(*report.filterHours) : calibration::Json()},
          {"input", textOrNull(report.input)},
          {"input_name", textOrNull(report.inputName)},
          {"signal", signalOf(report)},
          {"own_size", sizeOrNull(report.ownPixels)},
          {"frozen", report.isFrozen},
          {"errors", std::move(errors)}};
}

std::string linesOf(const pjlink::Report& report) {
  std::string text = fmt::format("  {} {} \"{}\", PJLink class {}", report.maker, report.model, report.name,
                                 report.protocolClass);
  if (!report.serial.empty()) text += ", serial number " + report.serial;
  text += fmt::format("\n  power: {}", report.power ? nameOf(*report.power) : "unknown");
  if (report.shutter) text += report.shutter->picture ? ", shutter closed" : ", shutter open";
  for (std::size_t i = 0; i < report.lamps.size(); ++i)
    text += fmt::format("\n  lamp{}: {} h{}", report.lamps.size() > 1 ? fmt::format(" {}", i + 1) : "",
                        report.lamps[i].hours, report.lamps[i].lit ? ", lit" : "");
  if (report.filterHours) text += fmt::format("\n  filter: {} h", *report.filterHours);
  if (!report.input.empty()) {
    text += "\n  input: " + (report.inputName.empty() ? report.input : report.inputName);
    if (report.signal && report.signal->kind == pjlink::Signal::Kind::none) text += ", no signal";
    if (report.signal && report.signal->kind == pjlink::Signal::Kind::size)
      text += fmt::format(", {}x{}", report.signal->size.width, report.signal->size.height);
  }
  if (report.ownPixels)
    text += fmt::format("\n  its own pixels: {}x{}", report.ownPixels->width, report.ownPixels->height);
  return text + "\n";
}

}  // namespace

calibration::Json toJson(const std::vector<pipeline::ProjectorStatus>& statuses) {
  calibration::Json list = calibration::Json::array();
  for (const pipeline::ProjectorStatus& status : statuses) {
    calibration::Json entry{{"address", toString(status.address)}, {"answers", status.report.has_value()}};
    if (status.report)
      entry.update(toJson(*status.report));
    else
      entry["problem"] = english(status.problem);
    calibration::Json remarks = calibration::Json::array();
    for (const Message& remark : status.remarks) remarks.push_back(english(remark));
    entry["remarks"] = std::move(remarks);
    list.push_back(std::move(entry));
  }
  return {{"projectors", std::move(list)}};
}

std::string textOf(const std::vector<pipeline::ProjectorStatus>& statuses) {
  std::string text;
  for (const pipeline::ProjectorStatus& status : statuses) {
    text += toString(status.address) + "\n";
    text += status.report ? linesOf(*status.report) : "  " + englishSentence(status.problem) + "\n";
    for (const Message& remark : status.remarks) text += "  " + englishSentence(remark) + "\n";
  }
  return statuses.empty()
             ? "No projector answers: those of PJLink class 1 cannot be searched, give their addresses.\n"
             : text;
}

}  // namespace relucent::cli
