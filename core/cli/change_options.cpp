// SPDX-License-Identifier: MIT
#include "relucent/cli/change_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "relucent/cli/arguments.h"
#include "relucent/cli/options.h"

namespace relucent::cli {
namespace {

using Values = std::vector<double>;

/// One kind of change: what its values are, and what they do.
struct ChangeKind {
  const char* name;
  const char* values;
  std::size_t least, most;
  void (*use)(const Values& values, venue::Changes& changes);
};

venue::Turned turnedBy(const Values& values) {
  // A device's number, from 1 on; what is no such number stays none.
  const double device = values.size() > 3 ? values[3] : 1.0;
  if (!(device >= 1.0 && device <= 64.0)) throw WrongUsage("devices are numbered from 1 on");
  return {static_cast<std::size_t>(device) - 1, values[0], values[1], values[2]};
}

const std::array kinds{
    ChangeKind{"camera", "X,Y,DEGREES[,NUMBER]: its picture moves by so many pixels and turns", 3, 4,
               [](const Values& v, venue::Changes& c) { c.cameras.push_back(turnedBy(v)); }},
    ChangeKind{"projector", "X,Y,DEGREES[,NUMBER]", 3, 4,
               [](const Values& v, venue::Changes& c) { c.projectors.push_back(turnedBy(v)); }},
    ChangeKind{"lamps", "RED,GREEN,BLUE: what is left of their light", 3, 3,
               [](const Values& v, venue::Changes& c) { c.lamps = {v[0], v[1], v[2]}; }},
    ChangeKind{"filter", "RED,GREEN,BLUE: what it lets through to the cameras", 3, 3,
               [](const Values& v, venue::Changes& c) { c.filter = {v[0], v[1], v[2]}; }},
    ChangeKind{"dust", "SHARE: of light that it takes", 1, 1,
               [](const Values& v, venue::Changes& c) { c.dust = v[0]; }},
    ChangeKind{"ambient", "SHARE: room light, as --ambient of calibrate", 1, 1,
               [](const Values& v, venue::Changes& c) { c.ambient = v[0]; }},
    ChangeKind{"painted", "X,Y,RADIUS: metres around a place in the first camera's picture, as shares of it",
               3, 3, [](const Values& v, venue::Changes& c) { c.painted.push_back({{v[0], v[1]}, v[2]}); }},
    ChangeKind{"moved", "X,Y,DISTANCE: what is seen there, metres to the right", 3, 3,
               [](const Values& v, venue::Changes& c) { c.moved.push_back({{v[0], v[1]}, v[2]}); }},
    ChangeKind{"added", "X,Y,DIAMETER: a ball, metres", 3, 3,
               [](const Values& v, venue::Changes& c) { c.added.push_back({{v[0], v[1]}, v[2]}); }}};

Values valuesOf(std::string_view text, const std::string& whole) {
  Values values;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    double value = 0.0;
    const auto [end, wrong] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (wrong != std::errc() || end != part.data() + part.size())
      throw WrongUsage(fmt::format("'{}' in --change {} is no number", part, whole));
    values.push_back(value);
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

void read(const std::string& text, venue::Changes& changes) {
  const std::size_t colon = text.find(':');
  std::vector<std::string> names;
  for (const ChangeKind& kind : kinds) {
    names.emplace_back(kind.name);
    if (text.substr(0, colon) != kind.name) continue;
    const Values values =
        colon == std::string::npos ? Values() : valuesOf(std::string_view(text).substr(colon + 1), text);
    if (values.size() < kind.least || values.size() > kind.most)
      throw WrongUsage(fmt::format("--change {} is written {}:{}", text, kind.name, kind.values));
    kind.use(values, changes);
    return;
  }
  throw WrongUsage(fmt::format("'{}' is no change; there are {}", text, fmt::join(names, ", ")));
}

}  // namespace

void addChanges(CLI::App* sub, venue::Changes& changes) {
  std::string what = "What has become of the simulated venue since, to rehearse; may be given several times:";
  for (const ChangeKind& kind : kinds) what += fmt::format("\n  {}:{}", kind.name, kind.values);
  addRepeated(
      sub, "--change", [&changes](const std::string& text) { read(text, changes); }, what.c_str())
      ->type_name("KIND:VALUES");
}

}  // namespace relucent::cli
