// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_photographs.h"

namespace relucent::linearization {

ShownLevels shownLevels(const MosaicPhotographs& photographs) {
  ShownLevels shown{{}, photographs.what};
  for (std::size_t p = 0; p < photographs.drives.size(); ++p) {
    const std::vector<double>& all = photographs.drives[p];
    std::vector<bool> used(all.size() + 1, false);
    used.back() = true;
    for (const MosaicShot& shot : photographs.what)
      for (std::size_t level : shot.level[p]) used[level] = true;
    std::vector<std::size_t> place(used.size(), 0);
    std::vector<double>& drives = shown.drives.emplace_back();
    for (std::size_t level = 1; level < used.size(); ++level) {
      if (!used[level]) continue;
      drives.push_back(all[level - 1]);
      place[level] = drives.size();
    }
    for (MosaicShot& shot : shown.what)
      for (std::size_t& level : shot.level[p]) level = place[level];
  }
  return shown;
}

}  // namespace relucent::linearization
