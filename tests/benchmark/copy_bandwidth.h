// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::benchmarks {

/// Bytes per second, read and written together, at which `threads` threads copy memory far larger than the
/// caches; the best of several copies. Measured once per number of threads.
double copyBandwidth(int threads);

}  // namespace relucent::benchmarks
