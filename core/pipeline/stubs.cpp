// SPDX-License-Identifier: MIT
// Stands in for what is not built yet, so that everything around it links.
#include "base/error.h"
#include "pipeline/pipeline.h"

namespace relucent {
namespace {
[[noreturn]] void notBuilt() {
  throw Error(ErrorKind::input, "not built yet", "use a later version");
}
}  // namespace

using std::filesystem::path;
CalibrateResult calibrate(const path&, const CalibrateSettings&, const path&, Progress&) {
  notBuilt();
}
CalibrateResult resume(const path&, const path&, Progress&) {
  notBuilt();
}
CompensateResult compensate(const path&, const CompensateSettings&, Progress&) {
  notBuilt();
}
EvaluateResult evaluate(const path&, const EvaluateSettings&, const path&, Progress&) {
  notBuilt();
}
WrittenFiles exportCalibration(const path&, const ExportSettings&, Progress&) {
  notBuilt();
}
WrittenFiles relight(const path&, const RelightSettings&, Progress&) {
  notBuilt();
}
WrittenFiles dual(const path&, const RelightSettings&, Progress&) {
  notBuilt();
}
WrittenFiles report(const path&, const ReportSettings&, const path&, Progress&) {
  notBuilt();
}
BenchResult bench(const std::string&, Progress&) {
  notBuilt();
}

[[gnu::weak]] std::vector<std::string> problems(const LinearizationSettings&) {
  return {};
}
[[gnu::weak]] std::vector<std::string> problems(const AcquisitionSettings&) {
  return {};
}
[[gnu::weak]] std::vector<std::string> problems(const WindowSettings&) {
  return {};
}
[[gnu::weak]] std::vector<std::string> problems(const TargetSettings&) {
  return {};
}

}  // namespace relucent
