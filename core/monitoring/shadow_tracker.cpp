// SPDX-License-Identifier: MIT
#include "relucent/monitoring/shadow_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relucent::monitoring {
namespace {

constexpr double tells = 12.0;       // chi^2 of a cell's light, below which a photograph says nothing of it
constexpr double perCell = 4.0;      // misfit that a blocked cell costs
constexpr double perBorder = 1.5;    // likewise of each two neighbours that differ
constexpr double staysUnless = 6.0;  // a border's cell, if it does not become better by this
constexpr double stillExplained = 0.5;
constexpr double halfThere = 0.5;  // share of light that is neither blocked nor free
constexpr double leastRecognised = 0.4;
constexpr int mostUnrecognised = 10;  // photographs
constexpr int rounds = 12, sweeps = 3;
constexpr std::ptrdiff_t mostlyWithin = 6;     // neighbours, of eight
constexpr double soon = 1.0, leastFirm = 0.5;  // seconds

}  // namespace

ShadowTracker::ShadowTracker(const WatchedVenue& venue, ShadowSettings settings)
    : venue_(venue), settings_(settings), map_(venue) {
  for (std::size_t cell = 0; cell < map_.cells(); ++cell) around_.push_back(map_.around(cell));
  forget();
}

void ShadowTracker::forget() {
  blocked_.assign(map_.cells(), 0);
  filled_.assign(map_.cells(), 0);
  unexplained_.assign(map_.cells(), 0);
  lockedUntil_.assign(map_.cells(), -1e30);
  known_.assign(map_.cells(), -1e30);
  freed_.assign(map_.cells(), -1e30);
  firmUntil_.assign(map_.cells(), -1e30);
  firmness_.assign(map_.cells(), 0.0);
  unrecognised_ = 0;
  choose();
}

bool ShadowTracker::canFill() const {
  for (std::size_t cell = 0; cell < map_.cells(); ++cell)
    if (!map_.samplesOf(cell).empty() && canOthersGive(cell)) return true;
  return false;
}

bool ShadowTracker::canOthersGive(std::size_t cell) const {
  const std::size_t own = map_.projectorOf(cell);
  double others = 0.0, all = 0.0;
  for (const ShadowMap::Link& link : map_.samplesOf(cell)) {
    std::vector<float> arrives(map_.projectors(), 1.0f);
    for (const ShadowMap::Link& one : map_.cellsOf(link.other))
      if (blocked_[one.other] != 0) arrives[map_.projectorOf(one.other)] -= one.share;
    for (std::size_t j = 0; j < map_.projectors(); ++j) {
      const auto light = static_cast<double>(link.share * map_.floodOf(link.other, j));
      all += light;
      if (j != own) others += light * static_cast<double>(arrives[j]);
    }
  }
  return all > 0.0 && others > settings_.others * all;
}

std::vector<std::vector<std::size_t>> ShadowTracker::connected(const BlockedCells& chosen) const {
  std::vector<std::vector<std::size_t>> parts;
  BlockedCells left = chosen;
  for (std::size_t cell = 0; cell < left.size(); ++cell) {
    if (left[cell] == 0) continue;
    std::vector<std::size_t> part{cell};
    left[cell] = 0;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (std::size_t beside : around_[part[next]])
        if (std::exchange(left[beside], 0) != 0) part.push_back(beside);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<ShadowTracker::Hypothesis> ShadowTracker::hypothesesOf(std::size_t projector,
                                                                   const ShadowEvidence& evidence,
                                                                   double seconds) const {
  std::vector<Hypothesis> found;
  BlockedCells less(map_.cells(), 0), more(map_.cells(), 0);
  const ShadowMap::Grid& grid = map_.grids()[projector];
  for (std::size_t cell = grid.first; cell < grid.first + grid.cells.count(); ++cell) {
    if (evidence.informationOf(cell) < tells) continue;
    const bool arrives = evidence.shareOf(cell) > halfThere;
    if (arrives && evidence.blocked()[cell] != 0 && seconds >= firmUntil_[cell]) more[cell] = 1;
    if (!arrives && evidence.blocked()[cell] == 0) less[cell] = 1;
  }
  for (const auto& [chosen, blocked] : {std::pair(&less, true), std::pair(&more, false)})
    for (std::vector<std::size_t>& cells : connected(*chosen)) found.push_back({std::move(cells), blocked});
  return found;
}

/// With what is blocked beside it, since shadows grow.
bool ShadowTracker::isLarge(const Hypothesis& hypothesis, const ShadowEvidence& evidence) const {
  std::size_t cells = hypothesis.cells.size();
  if (cells >= settings_.least) return true;
  for (std::size_t cell : hypothesis.cells)
    for (std::size_t beside : around_[cell]) cells += evidence.blocked()[beside] != 0;
  return cells >= settings_.least;
}

std::vector<std::size_t> ShadowTracker::within(const std::vector<std::size_t>& cells,
                                               const ShadowEvidence& evidence) const {
  std::vector<std::size_t> inner;
  for (std::size_t cell : cells) {
    const auto blocked = std::count_if(around_[cell].begin(), around_[cell].end(),
                                       [&](std::size_t beside) { return evidence.blocked()[beside] != 0; });
    if (blocked >= mostlyWithin) inner.push_back(cell);
  }
  return inner.empty() ? cells : inner;
}

std::vector<std::size_t> ShadowTracker::around(const std::vector<std::size_t>& cells) const {
  BlockedCells distance(map_.cells(), 0);
  std::vector<std::size_t> reached = cells, ring;
  for (std::size_t cell : cells) distance[cell] = 1;
  for (std::uint8_t step = 2; step <= 3; ++step) {
    ring.clear();
    for (std::size_t cell : reached)
      for (std::size_t beside : around_[cell])
        if (std::exchange(distance[beside], distance[beside] == 0 ? step : distance[beside]) == 0)
          ring.push_back(beside);
    reached = ring;
  }
  return ring;
}

bool ShadowTracker::isAsSeen(const Hypothesis& hypothesis, const ShadowEvidence& evidence) const {
  return !hypothesis.blocked ||
         (evidence.explainedOf(within(hypothesis.cells, evidence)) > settings_.explained &&
          evidence.explainedOf(around(hypothesis.cells)) > settings_.explainedAround);
}

std::vector<std::size_t> ShadowTracker::take(const Hypothesis& hypothesis, ShadowEvidence& evidence) const {
  std::vector<std::size_t> changed;
  const auto turn = [&](std::size_t cell, bool blocked) {
    if ((evidence.blocked()[cell] != 0) == blocked) return;
    evidence.set(cell, blocked);
    changed.push_back(cell);
  };
  for (std::size_t cell : hypothesis.cells) turn(cell, hypothesis.blocked);
  if (!hypothesis.blocked) return changed;
  // What was filled in vain was the other one's shadow.
  for (std::size_t cell : hypothesis.cells)
    for (const ShadowMap::Link& link : map_.samplesOf(cell))
      for (const ShadowMap::Link& one : map_.cellsOf(link.other))
        if (map_.projectorOf(one.other) != map_.projectorOf(cell) && filled_[one.other] != 0 &&
            evidence.informationOf(one.other) < tells)
          turn(one.other, false);
  return changed;
}

void ShadowTracker::search(ShadowEvidence& evidence, double seconds) const {
  for (int round = 0; round < rounds; ++round) {
    double best = -settings_.certain;
    Hypothesis chosen;
    for (std::size_t j = 0; j < map_.projectors(); ++j)
      for (const Hypothesis& one : hypothesesOf(j, evidence, seconds)) {
        if (one.blocked && !isLarge(one, evidence)) continue;
        const double before = evidence.misfit();
        const std::vector<std::size_t> changed = take(one, evidence);
        const double cost = perCell * static_cast<double>(one.cells.size()) * (one.blocked ? 1.0 : -1.0);
        const double change = evidence.misfit() - before + cost;
        const bool isSeen = isAsSeen(one, evidence);
        for (std::size_t cell : changed) evidence.set(cell, evidence.blocked()[cell] == 0);
        if (change < best && isSeen) {
          best = change;
          chosen = one;
        }
      }
    if (chosen.cells.empty()) return;
    take(chosen, evidence);
  }
}

void ShadowTracker::followBorders(ShadowEvidence& evidence, double seconds) const {
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t cell = 0; cell < map_.cells(); ++cell) {
      if (evidence.informationOf(cell) < tells) continue;
      const bool isBlocked = evidence.blocked()[cell] != 0;
      if (isBlocked && seconds < firmUntil_[cell]) continue;
      int unlike = 0;
      for (std::size_t beside : around_[cell]) unlike += (evidence.blocked()[beside] != 0) != isBlocked;
      if (unlike == 0) continue;
      const int alike = static_cast<int>(around_[cell].size()) - unlike;
      const double change =
          evidence.changeBy(cell) + perBorder * (alike - unlike) + (isBlocked ? -perCell : perCell);
      if (change < -staysUnless) evidence.set(cell, !isBlocked);
    }
}

void ShadowTracker::freeRemnants(ShadowEvidence& evidence) const {
  for (const std::vector<std::size_t>& part : connected(evidence.blocked())) {
    if (part.size() >= settings_.least) continue;
    const double before = evidence.misfit() + perCell * static_cast<double>(part.size());
    for (std::size_t cell : part) evidence.set(cell, false);
    if (evidence.misfit() - before < settings_.certain) continue;
    for (std::size_t cell : part) evidence.set(cell, true);
  }
}

void ShadowTracker::giveUp(const ShadowEvidence& evidence, double seconds) {
  for (const std::vector<std::size_t>& part : connected(filled_)) {
    const bool isExplained = evidence.explainedOf(within(part, evidence)) > stillExplained;
    int longest = 0;
    for (std::size_t cell : part) {
      unexplained_[cell] = isExplained ? 0 : unexplained_[cell] + 1;
      longest = std::max(longest, unexplained_[cell]);
    }
    if (longest < settings_.patience) continue;
    for (std::size_t cell : part) {
      blocked_[cell] = 0;
      unexplained_[cell] = 0;
      lockedUntil_[cell] = seconds + settings_.given;
      for (std::size_t beside : around_[cell]) lockedUntil_[beside] = seconds + settings_.given;
    }
  }
}

void ShadowTracker::freeUnknown(const ShadowEvidence& evidence, double seconds) {
  for (std::size_t cell = 0; cell < map_.cells(); ++cell) {
    const bool isWithin = std::all_of(around_[cell].begin(), around_[cell].end(),
                                      [&](std::size_t beside) { return filled_[beside] != 0; });
    if (evidence.informationOf(cell) >= tells || blocked_[cell] == 0 || isWithin) known_[cell] = seconds;
    if (seconds - known_[cell] > settings_.unknown && seconds >= firmUntil_[cell]) blocked_[cell] = 0;
    if (seconds < lockedUntil_[cell]) blocked_[cell] = 0;
  }
}

void ShadowTracker::steady(const BlockedCells& before, double seconds) {
  for (std::size_t cell = 0; cell < map_.cells(); ++cell) {
    if (before[cell] != 0 && blocked_[cell] == 0) freed_[cell] = seconds;
    if (before[cell] != 0 || blocked_[cell] == 0) continue;
    const bool isAgain = seconds - freed_[cell] < soon;
    firmness_[cell] = isAgain ? std::clamp(2.0 * firmness_[cell], leastFirm, settings_.firm) : 0.0;
    firmUntil_[cell] = isAgain ? seconds + firmness_[cell] : seconds;
  }
}

bool ShadowTracker::choose() {
  for (std::size_t cell = 0; cell < map_.cells(); ++cell)
    filled_[cell] = blocked_[cell] != 0 && canOthersGive(cell);
  engine::Availability wanted;
  for (std::size_t j = 0; j < map_.projectors(); ++j) {
    const ShadowMap::Grid& grid = map_.grids()[j];
    engine::Availability::Grid shares{grid.side, grid.cells, std::vector<float>(grid.cells.count(), 1.0f)};
    for (std::size_t local = 0; local < grid.cells.count(); ++local) {
      const std::vector<std::size_t>& around = around_[grid.first + local];
      const auto isFilled = [&](std::size_t cell) { return filled_[cell] != 0; };
      if (isFilled(grid.first + local))
        shares.share[local] =
            std::all_of(around.begin(), around.end(), isFilled) ? 0.0f : static_cast<float>(settings_.within);
      else if (std::any_of(around.begin(), around.end(), isFilled))
        shares.share[local] = static_cast<float>(settings_.beside);
    }
    wanted.projectors.push_back(std::move(shares));
  }
  const bool isOther = !(wanted == available_);
  available_ = std::move(wanted);
  return isOther;
}

bool ShadowTracker::look(const Observed& seen, const Moment& moment, const KnownLight& known,
                         double seconds) {
  ShadowEvidence evidence(seen, moment, venue_, map_, known);
  evidence.assume(blocked_);
  search(evidence, seconds);
  followBorders(evidence, seconds);
  freeRemnants(evidence);
  recognised_ = evidence.explained() > leastRecognised;
  if (!recognised_) {
    // Another camera's view, or a lamp that went out: no shadow is known in it.
    if (++unrecognised_ < mostUnrecognised) return false;
    std::fill(blocked_.begin(), blocked_.end(), std::uint8_t{0});
    return choose();
  }
  unrecognised_ = 0;
  const BlockedCells before = std::exchange(blocked_, evidence.blocked());
  giveUp(evidence, seconds);
  freeUnknown(evidence, seconds);
  steady(before, seconds);
  return choose();
}

std::vector<FilledShadow> ShadowTracker::filled() const {
  std::vector<FilledShadow> shadows;
  const Sampling& sampling = venue_.sampling;
  for (const std::vector<std::size_t>& part : connected(filled_)) {
    FilledShadow shadow{map_.projectorOf(part.front()), 0.0, 0.0, part.size()};
    double sum = 0.0;
    for (std::size_t cell : part)
      for (const ShadowMap::Link& link : map_.samplesOf(cell)) {
        const Pixel at = pixelAt(sampling.camera, sampling.pixels[map_.samples()[link.other]]);
        const auto weight = static_cast<double>(link.share);
        shadow.x += weight * (at.x + 0.5) / sampling.camera.width;
        shadow.y += weight * (at.y + 0.5) / sampling.camera.height;
        sum += weight;
      }
    shadow.x /= std::max(sum, 1e-30);
    shadow.y /= std::max(sum, 1e-30);
    shadows.push_back(shadow);
  }
  return shadows;
}

}  // namespace relucent::monitoring
