// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/tbb.h"

namespace relucent {

/// Sorts on all cores. Contract: `less` is a total order; then the result does not depend on the number of
/// threads.
template <typename Items, typename Less>
void parallelSort(Items& items, const Less& less) {
  tbb::parallel_sort(items.begin(), items.end(), less);
}

}  // namespace relucent
