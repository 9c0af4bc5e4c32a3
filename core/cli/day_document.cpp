// SPDX-License-Identifier: MIT
#include "relucent/cli/day_document.h"

#include <fmt/format.h>

namespace relucent::cli {
namespace {

using Json = calibration::Json;

Json documentOf(const rehearsal::RehearsedDay& day) {
  Json happened = Json::array();
  for (const rehearsal::Happened& one : day.happened)
    happened.push_back({{"what", nameOf(one.what)},
                        {"missed", one.missed.empty() ? Json() : Json(one.missed)},
                        {"seconds", one.seconds}});
  return {{"day", day.number},
          {"happened", std::move(happened)},
          {"unexpected", day.unexpected},
          {"night", day.night},
          {"resident_bytes", day.use.residentBytes},
          {"own_bytes", day.use.ownBytes},
          {"handles", day.use.handles},
          {"threads", day.use.threads},
          {"process", day.process},
          {"log_bytes", day.logBytes},
          {"calibration_bytes", day.calibrationBytes}};
}

double inMegabytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

std::string lineOfDay(const rehearsal::RehearsedDay& day) {
  std::string happened, wrong;
  for (const rehearsal::Happened& one : day.happened) {
    happened += fmt::format("{}{}", happened.empty() ? "" : ", ", nameOf(one.what));
    if (!one.missed.empty()) wrong += fmt::format("\n          {}: {}", nameOf(one.what), one.missed);
  }
  for (const std::string& warning : day.unexpected) wrong += "\n          not expected: " + warning;
  return fmt::format("day {:3}   {:.1f} MB, {} handles, {} threads, log {} kB: {}; night: {}{}\n", day.number,
                     inMegabytes(day.use.residentBytes), day.use.handles, day.use.threads,
                     day.logBytes / 1024, happened, day.night, wrong);
}

}  // namespace

Json toJson(const rehearsal::DaysResult& result) {
  Json days = Json::array(), bounds = Json::array();
  for (const rehearsal::RehearsedDay& day : result.days) days.push_back(documentOf(day));
  for (const rehearsal::Bound& bound : result.bounds)
    bounds.push_back({{"what", nameOf(bound.what)},
                      {"found", bound.found ? Json(*bound.found) : Json()},
                      {"most", bound.most},
                      {"held", bound.isHeld()}});
  return {{"days", std::move(days)},
          {"bounds", std::move(bounds)},
          {"held", allHeld(result)},
          {"out", result.out.empty() ? Json() : Json(result.out.string())},
          {"seconds", result.seconds}};
}

std::string textOf(const rehearsal::DaysResult& result) {
  std::string text;
  for (const rehearsal::RehearsedDay& day : result.days) text += lineOfDay(day);
  for (const rehearsal::Bound& bound : result.bounds)
    text += fmt::format("{:12} {} of at most {:.6g}{}: {}\n", nameOf(bound.what),
                        bound.found ? fmt::format("{:.6g}", *bound.found) : "not told by so few days",
                        bound.most, bound.isHeld() ? "" : ", EXCEEDED", descriptionOf(bound.what));
  text += allHeld(result) ? "All bounds held.\n" : "Not all bounds held.\n";
  if (!result.out.empty()) text += fmt::format("Log and calibration: {}\n", result.out.string());
  return text;
}

}  // namespace relucent::cli
