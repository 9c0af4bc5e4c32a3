// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "pipeline/acquisition_bench.h"
#include "pipeline/bench.h"
#include "pipeline/calibrate.h"
#include "pipeline/compensate.h"
#include "pipeline/difference.h"
#include "pipeline/evaluate.h"
#include "pipeline/import.h"
#include "pipeline/inverse_bench.h"
#include "pipeline/prove.h"
#include "pipeline/separate.h"
#include "pipeline/verify.h"
#include "pipeline/written_files.h"

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
