// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/compensation/mask.h"
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
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/tidy.h"
#include "relucent/pipeline/verify.h"
#include "relucent/pipeline/written_files.h"

namespace relucent::cli {

/// What a command found, as people read it; --json prints toJson() instead.
std::string textOf(const pipeline::CalibrateResult& result);
std::string textOf(const pipeline::WrittenFiles& result);
std::string textOf(const pipeline::VerifyResult& result);
std::string textOf(const pipeline::RepairResult& result);
std::string textOf(const pipeline::UndoneRepair& result);
std::string textOf(const pipeline::NightRecord& night);
std::string textOf(const std::vector<pipeline::NightRecord>& nights);
std::string textOf(const pipeline::ProveResult& result);
std::string textOf(const pipeline::PerfectResult& result);
std::string textOf(const pipeline::ForgottenPictures& result);
std::string textOf(const pipeline::ImportResult& result);
std::string textOf(const pipeline::CompensateResult& result);
std::string textOf(const pipeline::EvaluateResult& result);
std::string textOf(const pipeline::SeparateResult& result);
std::string textOf(const pipeline::DifferenceResult& result);
std::string textOf(const pipeline::TidyResult& result);
std::string textOf(const std::vector<compensation::Mask>& masks);
std::string textOf(const pipeline::TargetSets& sets);
std::string textOf(const pipeline::BenchResult& result);
std::string textOf(const pipeline::InverseBenchResult& result);
std::string textOf(const pipeline::AcquisitionBenchResult& result);
std::string textOf(const pipeline::ScaleBenchResult& result);

}  // namespace relucent::cli
