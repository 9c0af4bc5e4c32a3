// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/show_health.h"

#include <fmt/format.h>

#include <cstdio>

#include "relucent/base/error.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/json.h"

namespace relucent::rehearsal {

using calibration::Json;

std::optional<ShowTime> showTimeFrom(const std::string& text) {
  using namespace std::chrono;
  int y = 0, hour = 0, minute = 0, second = 0;
  unsigned m = 0, d = 0;
  if (std::sscanf(text.c_str(), "%4d-%2u-%2uT%2d:%2d:%2d", &y, &m, &d, &hour, &minute, &second) != 6)
    return std::nullopt;
  const year_month_day date{year(y), month(m), day(d)};
  if (!date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 60)
    return std::nullopt;
  return sys_days(date) + hours(hour) + minutes(minute) + seconds(second);
}

std::string textOf(ShowTime time) {
  using namespace std::chrono;
  const auto days = floor<std::chrono::days>(time);
  const year_month_day date(days);
  const hh_mm_ss clock(time - days);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

ShowHealth showHealthFrom(std::string_view text) {
  try {
    const Json json = parsedJson<Json>(text);
    ShowHealth health;
    const std::optional<ShowTime> updated = showTimeFrom(json.at("updated").get<std::string>());
    if (!updated)
      throw Error(ErrorKind::format,
                  RELUCENT_ENGLISH_MESSAGE("rehearsal.health-without-time",
                                           "the health file of the show has no time"),
                  {});
    health.updated = *updated;
    health.state = json.at("state").get<std::string>();
    health.item = json.at("item").get<int>();
    health.skipped = json.at("skipped").get<int>();
    health.alarm = json.value("alarm", std::string());
    const Json projectors = json.value("projectors", Json::array()),
               streams = json.value("streams", Json::array());
    for (const Json& projector : projectors) health.power.push_back(projector.value("power", std::string()));
    for (const Json& stream : streams) health.streams.push_back(stream.at("state").get<std::string>());
    if (json.contains("night")) health.night = showTimeFrom(json.at("night").value("when", std::string()));
    return health;
  } catch (const Json::exception& cause) {
    throw Error(ErrorKind::format,
                RELUCENT_ENGLISH_MESSAGE("rehearsal.health-unreadable",
                                         "the health file of the show cannot be read ({})")
                    .with(cause.what()),
                {});
  }
}

}  // namespace relucent::rehearsal
