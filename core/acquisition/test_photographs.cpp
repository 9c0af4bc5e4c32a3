// SPDX-License-Identifier: MIT
#include "relucent/acquisition/test_photographs.h"

#include <utility>

namespace relucent::acquisition {

sentinels::Interruptible<Verification> TestPhotographs::compared(const transport::TransportMatrix& transport,
                                                                 const CameraMask& rows, Progress& progress) {
  std::size_t next = 0;
  const LightSource light =
      [&](const ProjectorStack& pattern,
          const std::vector<photography::Demand>& demands) -> sentinels::Interruptible<SeenLight> {
    const std::size_t number = next++;
    if (number == light_.size()) {
      auto seen = context_.watch.lightOfRandom(pattern, demands, progress);
      if (!seen) return seen.interruption();
      patterns_.push_back(pattern);
      light_.push_back(std::make_shared<const hdr::LampLight>(*std::move(seen)));
    }
    return light_[number];
  };
  return verify({transport, context_.watch.black().radiance, context_.scheme.tolerable}, light,
                {settings_, rows, first_}, progress);
}

}  // namespace relucent::acquisition
