// SPDX-License-Identifier: MIT
#include "relucent/monitoring/judgement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

constexpr double stays = 0.7;       // of a limit: what was told stays until it is below this
constexpr double alike = 0.2;       // visitors who follow each other take unlike shares of the light
constexpr double whileMoved = 3.0;  // times as much must a lamp fade: a view that moved fits less well
constexpr double certain = 2.5;     // deviations by which something must be beyond what may be wrong of it

void addTo(Lasting& lasting, Reference& reference, double seconds, double value, double deviation) {
  reference.add(seconds, value, deviation);
  lasting.add(seconds, value - reference.value(), deviation);
}

}  // namespace

std::vector<Message> problems(const MonitorSettings& settings) {
  std::vector<Message> found;
  if (!(settings.shift > 0.0) || !(settings.fade > 0.0) || !(settings.shadow > 0.0) ||
      !(settings.dark > settings.fade) || settings.dark >= 1.0 || settings.shadow >= 1.0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("monitoring.bad-limits",
                                             "limits must be above 0, those of light below 1, and that of "
                                             "dark above that of fading"));
  return found;
}

Judgement::Judgement(std::size_t projectors, Size cells, const MonitorSettings& settings)
    : cells_(cells),
      settings_(settings),
      gain_(3 * projectors, Lasting(settings.ofGain)),
      total_(projectors, Lasting(settings.ofGain)),
      cell_(cells.count(), Lasting(settings.ofCell)),
      gainReference_(gain_.size(), Reference(settings.reference)),
      totalReference_(total_.size(), Reference(settings.reference)),
      x_(settings.ofShift),
      y_(settings.ofShift),
      turn_(settings.ofShift),
      unrecognised_(settings.ofRecognition) {
  require(problems(settings).empty(), "settings of a monitor that have problems");
}

std::vector<double> Judgement::gains() const {
  std::vector<double> gains;
  for (std::size_t k = 0; k < gain_.size(); ++k)
    gains.push_back(std::max(0.0, 1.0 + gainReference_[k].value() + gain_[k].median().value_or(0.0)));
  return gains;
}

void Judgement::add(const Look& look, double seconds) {
  if (look.use == Look::Use::saturated) return;
  const LightFit& light = look.light;
  const bool isUnrecognised = look.use == Look::Use::unrecognised;
  if (light.light > settings_.lit) unrecognised_.add(seconds, isUnrecognised ? 1.0 : 0.0, 0.0);
  if (!isUnrecognised) {
    for (std::size_t j = 0; j < total_.size(); ++j) {
      const double misled = settings_.misled * (1.0 - light.recognisedOf[j]);
      addTo(total_[j], totalReference_[j], seconds, light.total[j] - 1.0,
            std::hypot(light.totalDeviation[j], misled));
      for (std::size_t k = 3 * j; k < 3 * j + 3; ++k)
        addTo(gain_[k], gainReference_[k], seconds, light.gain[k] - 1.0,
              std::hypot(light.deviation[k], misled));
    }
    for (std::size_t c = 0; c < cell_.size(); ++c)
      cell_[c].add(seconds, std::clamp(light.cells[c].share - 1.0, -1.0, 1.0), light.cells[c].deviation);
    if (light.light > settings_.lit) {
      x_.add(seconds, look.shift.x, look.shift.deviation);
      y_.add(seconds, look.shift.y, look.shift.deviation);
      turn_.add(seconds, look.shift.turn, look.shift.deviation);
    }
  }
  decide(seconds);
}

bool Judgement::was(FindingKind kind, std::optional<std::size_t> projector,
                    std::optional<std::size_t> channel, const std::vector<Finding>& before) const {
  return std::any_of(before.begin(), before.end(), [&](const Finding& one) {
    return one.kind == kind && one.projector == projector && one.channel == channel;
  });
}

void Judgement::add(Finding finding, const std::vector<Finding>& before, double seconds) {
  finding.since = seconds;
  for (const Finding& one : before)
    if (one.kind == finding.kind && one.projector == finding.projector && one.channel == finding.channel)
      finding.since = one.since;
  findings_.push_back(finding);
}

void Judgement::decide(double seconds) {
  const std::vector<Finding> before = std::exchange(findings_, {});
  if (const auto median = unrecognised_.median(); median && *median > 0.5 && unrecognised_.holds(1.0, 1))
    add({FindingKind::unrecognised}, before, seconds);

  const bool isSteady = !isAnyDark() && addMovement(before, seconds);
  const bool isDark = addLamps(isSteady, before, seconds);
  if (!isDark && (isSteady || was(FindingKind::shadowed, {}, {}, before))) addShadows(before, seconds);
}

bool Judgement::isAnyDark() const {
  return std::any_of(total_.begin(), total_.end(),
                     [&](const Lasting& one) { return -one.median().value_or(0.0) > settings_.dark; });
}

bool Judgement::addLamps(bool isSteady, const std::vector<Finding>& before, double seconds) {
  const auto lost = [](const Lasting& one) { return -one.median().value_or(0.0); };
  bool isDark = false;
  for (std::size_t j = 0; j < total_.size(); ++j) {
    const auto passes = [&](const Lasting& one, std::optional<std::size_t> channel, double allLost) {
      const bool wasTold = was(FindingKind::faded, j, channel, before);
      const double limit = (wasTold ? stays : isSteady ? 1.0 : whileMoved) * settings_.fade;
      // What calibration has wrong may be as much again as the reference takes for that.
      const double wrong = wasTold ? 0.0 : settings_.reference.most;
      return one.median() && lost(one) > allLost + limit && lost(one) > wrong + certain * one.deviation() &&
             one.holds(limit, -1);
    };
    const double all = lost(total_[j]);
    if (total_[j].median() && all > settings_.dark) {
      isDark = true;
      // Not long enough yet: half a minute ago it may have been as bright as ever.
      if (total_[j].holds(settings_.dark, -1)) add({FindingKind::dark, j, {}, all}, before, seconds);
      continue;
    }
    if (passes(total_[j], {}, 0.0)) add({FindingKind::faded, j, {}, all}, before, seconds);
    // What all channels lost is no channel's.
    double least = 1.0;
    for (std::size_t k = 0; k < 3; ++k) least = std::clamp(lost(gain_[3 * j + k]), 0.0, least);
    for (std::size_t k = 0; k < 3; ++k)
      if (passes(gain_[3 * j + k], k, least))
        add({FindingKind::faded, j, k, lost(gain_[3 * j + k])}, before, seconds);
  }
  return isDark;
}

bool Judgement::addMovement(const std::vector<Finding>& before, double seconds) {
  if (!x_.median() || !y_.median() || !turn_.median()) return true;
  const double x = *x_.median(), y = *y_.median(), turn = *turn_.median();
  const double limit = (was(FindingKind::moved, {}, {}, before) ? stays : 1.0) * settings_.shift;
  const double moved = std::max(std::hypot(x, y), std::abs(turn));
  // Of a movement askew each direction has its part.
  const double part = std::min(limit, moved / std::numbers::sqrt2);
  const bool lasts = x_.holds(part, x < 0.0 ? -1 : 1) || y_.holds(part, y < 0.0 ? -1 : 1) ||
                     turn_.holds(limit, turn < 0.0 ? -1 : 1);
  if (moved > limit && moved > certain * x_.deviation() && lasts)
    add({FindingKind::moved, {}, {}, moved, x, y}, before, seconds);
  return moved < 0.5 * settings_.shift;
}

void Judgement::addShadows(const std::vector<Finding>& before, double seconds) {
  const bool wasTold = was(FindingKind::shadowed, {}, {}, before);
  // Where visitors stand in most of the view, light is missing that comes back.
  if (!wasTold && unrecognised_.shareBeyond(0.5, 1) > 0.0) return;
  const double limit = (wasTold ? stays : 1.0) * settings_.shadow;
  std::vector<double> missing(cell_.size(), 0.0);
  for (std::size_t c = 0; c < cell_.size(); ++c)
    if (const auto median = cell_[c].median(); median && -*median > limit &&
                                               -*median > certain * cell_[c].deviation() &&
                                               cell_[c].holds(limit, -1) && cell_[c].keeps(alike))
      missing[c] = -*median;
  // Two neighbours, or one that misses half as much again.
  double sum = 0.0, x = 0.0, y = 0.0, weight = 0.0;
  for (std::size_t c = 0; c < cell_.size(); ++c) {
    if (missing[c] == 0.0) continue;
    const Pixel at = pixelAt(cells_, c);
    bool hasNeighbour = false;
    for (const Pixel& step : {Pixel{1, 0}, Pixel{-1, 0}, Pixel{0, 1}, Pixel{0, -1}}) {
      const Pixel to{at.x + step.x, at.y + step.y};
      if (to.x >= 0 && to.y >= 0 && to.x < cells_.width && to.y < cells_.height)
        hasNeighbour = hasNeighbour || missing[indexOf(cells_, to)] > 0.0;
    }
    if (!hasNeighbour && missing[c] < 1.5 * limit) continue;
    sum += missing[c] * missing[c];
    x += missing[c] * (at.x + 0.5) / cells_.width;
    y += missing[c] * (at.y + 0.5) / cells_.height;
    weight += missing[c];
  }
  if (weight > 0.0)
    add({FindingKind::shadowed, {}, {}, sum / weight, x / weight, y / weight}, before, seconds);
}

double Judgement::informed() const {
  double told = 0.0, all = 0.0;
  for (const std::vector<Lasting>* some : {&total_, &cell_})
    for (const Lasting& one : *some) {
      told += one.median().has_value();
      all += 1.0;
    }
  told += x_.median().has_value();
  return told / (all + 1.0);
}

void Judgement::forget() {
  for (std::vector<Lasting>* some : {&gain_, &total_, &cell_})
    for (Lasting& one : *some) one.forget();
  for (Lasting* one : {&x_, &y_, &turn_, &unrecognised_}) one->forget();
}

}  // namespace relucent::monitoring
