// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "pipeline/acquisition_bench.h"
#include "pipeline/inverse_bench.h"
#include "pipeline/pipeline.h"
#include "pipeline/prove.h"

namespace relucent {

/// What a command found, as people read it; --json prints toJson() instead.
std::string textOf(const CalibrateResult& result);
std::string textOf(const WrittenFiles& result);
std::string textOf(const VerifyResult& result);
std::string textOf(const ProveResult& result);
std::string textOf(const ImportResult& result);
std::string textOf(const CompensateResult& result);
std::string textOf(const EvaluateResult& result);
std::string textOf(const SeparateResult& result);
std::string textOf(const DifferenceResult& result);
std::string textOf(const BenchResult& result);
std::string textOf(const InverseBenchResult& result);
std::string textOf(const AcquisitionBenchResult& result);

}  // namespace relucent
