// SPDX-License-Identifier: MIT
#include "relucent/venue/silhouettes.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/random.h"

namespace relucent::venue {
namespace {

constexpr std::uint64_t visitorKey = 0x1517;
constexpr double slotSeconds = 5.0;  // one visitor at most begins his way in each
constexpr double longestWay = 25.0;
constexpr double shadowedShare = 2.0 / 3.0;

}  // namespace

bool Silhouette::holds(Size size, Pixel pixel) const {
  const double dx = ((pixel.x + 0.5) / size.width - x) / halfWidth;
  const double dy = ((pixel.y + 0.5) / size.height - y) / halfHeight;
  return dx * dx + dy * dy < 1.0;
}

std::vector<Silhouette> Visitors::at(double seconds) const {
  std::vector<Silhouette> there;
  const auto last = static_cast<std::int64_t>(std::floor(seconds / slotSeconds));
  const auto first = last - static_cast<std::int64_t>((longestWay + settings_.longestStop) / slotSeconds) - 1;
  for (std::int64_t slot = first; slot <= last; ++slot) {
    Random random({settings_.seed, visitorKey, static_cast<std::uint64_t>(slot + (std::int64_t{1} << 40))});
    if (random.uniform() > slotSeconds / settings_.everySeconds) continue;
    const double begins = (static_cast<double>(slot) + random.uniform()) * slotSeconds;
    const double way = 4.0 + (longestWay - 4.0) * random.uniform();
    const double stop = random.uniform() < 0.5 ? settings_.longestStop * random.uniform() : 0.0;
    const double stopsAt = way * (0.2 + 0.6 * random.uniform());
    const bool fromLeft = random.uniform() < 0.5;
    Silhouette body;
    body.halfWidth = 0.03 + 0.07 * random.uniform();
    body.halfHeight = 0.15 + 0.3 * random.uniform();
    body.y = 1.0 - body.halfHeight * (0.6 + 0.5 * random.uniform());
    const bool isLit = random.uniform() < shadowedShare;
    const std::size_t projector = random.below(std::max<std::size_t>(1, settings_.projectors));
    const double offset = 0.4 * (random.uniform() - 0.5), growth = 0.8 + 0.8 * random.uniform();

    double on = seconds - begins;
    if (on < 0.0 || on > way + stop) continue;
    if (on > stopsAt) on = std::max(stopsAt, on - stop);
    const double share = 1.2 * on / way - 0.1;
    body.x = fromLeft ? share : 1.0 - share;
    there.push_back(body);
    if (!isLit) continue;
    Silhouette shadow = body;
    shadow.projector = projector;
    shadow.x += offset;
    shadow.halfWidth *= growth;
    shadow.halfHeight *= growth;
    there.push_back(shadow);
  }
  return there;
}

}  // namespace relucent::venue
