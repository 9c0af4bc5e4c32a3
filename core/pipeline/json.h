// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/json.h"

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
#include "venue/venue.h"

namespace relucent {

/// The documents of the command line: snake_case keys, numbers without units. What is not finite is null.
/// verify: {"verdict", "sentence", "error", "error_then", "error_by_block": {"1", "2", "4", "8"},
///   "error_without_lamp", "changed_share", "lamp", "ambient", "patterns", "exposures", "seconds", "files"}.
/// prove: {"method", "before": {"psnr_predicted", "psnr_measured", "delta_e_predicted", "delta_e_measured",
///   "surprise"}, "after": the same, "reachable", "exposures", "seconds", "files"}.
Json toJson(const CalibrateResult& result);
Json toJson(const VerifyResult& result);
Json toJson(const ImportResult& result);
Json toJson(const CompensateResult& result);
Json toJson(const ProveResult& result);
Json toJson(const EvaluateResult& result);
Json toJson(const WrittenFiles& result);
Json toJson(const SeparateResult& result);
Json toJson(const DifferenceResult& result);
Json toJson(const BenchResult& result);
Json toJson(const InverseBenchResult& result);
Json toJson(const AcquisitionBenchResult& result);
Json toJson(const std::vector<VenueDescription>& venues);

}  // namespace relucent
