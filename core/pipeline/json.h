// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/json.h"

#include "relucent/pipeline/acquisition_bench.h"
#include "relucent/pipeline/bench.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/difference.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/import.h"
#include "relucent/pipeline/inverse_bench.h"
#include "relucent/pipeline/night.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/repair.h"
#include "relucent/pipeline/scale_bench.h"
#include "relucent/pipeline/separate.h"
#include "relucent/pipeline/tidy.h"
#include "relucent/pipeline/verify.h"
#include "relucent/pipeline/written_files.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

/// The documents of the command line: snake_case keys, numbers without units. What is not finite is null.
/// verify: {"verdict", "sentence", "error", "error_then", "error_by_block": {"1", "2", "4", "8"},
///   "error_without_lamp", "changed_share", "lamp", "ambient", "patterns", "exposures", "seconds", "files"}.
/// prove: {"method", "before": {"psnr_predicted", "psnr_measured", "delta_e_predicted", "delta_e_measured",
///   "surprise"}, "after": the same, "reachable", "exposures", "seconds", "files"}.
calibration::Json toJson(const CalibrateResult& result);
calibration::Json toJson(const VerifyResult& result);
calibration::Json toJson(const ImportResult& result);
calibration::Json toJson(const CompensateResult& result);
calibration::Json toJson(const ProveResult& result);
calibration::Json toJson(const PerfectResult& result);
calibration::Json toJson(const ForgottenPictures& result);
calibration::Json toJson(const RepairResult& result);
calibration::Json toJson(const UndoneRepair& result);
calibration::Json toJson(const NightRecord& night);
calibration::Json toJson(const std::vector<NightRecord>& nights);
calibration::Json toJson(const EvaluateResult& result);
calibration::Json toJson(const WrittenFiles& result);
calibration::Json toJson(const SeparateResult& result);
calibration::Json toJson(const DifferenceResult& result);
/// {"calibrations": [{"folder", "complete", "freed", then "photographs", "results", "leftovers",
/// "compressed",
///   "kept", each {"files", "bytes"}}], "freed", "dry_run"}: bytes; of compressed files those saved.
calibration::Json toJson(const TidyResult& result);
calibration::Json toJson(const BenchResult& result);
calibration::Json toJson(const InverseBenchResult& result);
calibration::Json toJson(const AcquisitionBenchResult& result);
calibration::Json toJson(const ScaleBenchResult& result);
calibration::Json toJson(const std::vector<venue::VenueDescription>& venues);

}  // namespace relucent::pipeline
