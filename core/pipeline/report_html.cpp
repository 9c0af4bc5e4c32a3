// SPDX-License-Identifier: MIT
#include "relucent/pipeline/report_html.h"

#include <fmt/format.h>

#include <cmath>

#include "relucent/pipeline/report_charts.h"
#include "relucent/pipeline/report_pictures.h"

namespace relucent::pipeline {

std::string section(const std::string& heading, const std::string& lead, const std::string& body) {
  std::string introduction = lead.empty() ? "" : fmt::format("<p class=\"soft\">{}</p>", escaped(lead));
  return fmt::format("<section><h2>{}</h2>{}{}</section>\n", escaped(heading), introduction, body);
}

std::string figure(const image::Image& encoded, const std::string& name, const std::string& caption,
                   const std::string& below) {
  return fmt::format(
      R"(<figure><img src="{}" width="{}" height="{}" alt="{}: {}">{}<figcaption><b>{}</b> {}</figcaption></figure>)",
      pngDataUri(encoded), encoded.width(), encoded.height(), escaped(name), escaped(caption), below,
      escaped(name), escaped(caption));
}

std::string card(const std::string& name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escaped(name), escaped(value));
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, "\u202f");
  return digits;
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.3g} s", seconds);
  return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
}

std::string decibels(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f} dB", value) : "exact";
}

}  // namespace relucent::pipeline
