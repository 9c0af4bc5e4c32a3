// SPDX-License-Identifier: MIT
// The inner loops compile for every processor, and once more for those with AVX2 and FMA. Which one runs is
// chosen while the program runs.
#include "relucent/engine/engine_kernels.h"

#include <cstring>
#include <limits>

#include "relucent/compensation/step_preconditioner.h"
#include "relucent/compensation/target.h"

namespace relucent::engine {
namespace {

namespace baseline {
#define RELUCENT_LANES 4
#define RELUCENT_KERNEL [[gnu::always_inline]] inline
#define RELUCENT_FUNCTION
#include "relucent/engine/kernel_loops.h"
#undef RELUCENT_LANES
#undef RELUCENT_KERNEL
#undef RELUCENT_FUNCTION
}  // namespace baseline

#ifdef __x86_64__
namespace avx2 {
#define RELUCENT_LANES 8
#define RELUCENT_KERNEL [[gnu::always_inline, gnu::target("avx2,fma")]] inline
#define RELUCENT_FUNCTION [[gnu::target("avx2,fma")]]
#include "relucent/engine/kernel_loops.h"
#undef RELUCENT_LANES
#undef RELUCENT_KERNEL
#undef RELUCENT_FUNCTION
}  // namespace avx2

#endif

}  // namespace

std::span<const EngineKernels> engineKernels() {
#ifdef __x86_64__
  static const EngineKernels all[] = {baseline::kernelsFor("baseline"), avx2::kernelsFor("AVX2, FMA")};
  static const bool newer = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {all, newer ? 2u : 1u};
#else
  static const EngineKernels all[] = {baseline::kernelsFor("baseline")};
  return all;
#endif
}

}  // namespace relucent::engine
