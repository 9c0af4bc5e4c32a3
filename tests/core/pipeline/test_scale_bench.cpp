// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "relucent/pipeline/scale_bench.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

/// Stages that take `factor * pixels^power` seconds.
ScaleBenchRun runOf(Size projector, Size camera, const std::vector<std::pair<std::string, double>>& powers) {
  ScaleBenchRun run;
  run.sizes = {projector, camera};
  const auto pixels = static_cast<double>(projector.count() + camera.count());
  for (const auto& [name, power] : powers) run.stages.push_back({name, 3e-6 * std::pow(pixels, power), 0, 0});
  return run;
}

}  // namespace

class TestScaleBench : public QObject {
  Q_OBJECT

 private slots:
  void growthIsThePowerOfPixels() {
    const ScaleBenchRun small = runOf({64, 48}, {40, 30}, {{"linear", 1.0}, {"quadratic", 2.0}});
    const ScaleBenchRun large =
        runOf({256, 100}, {90, 70}, {{"constant", 0.0}, {"linear", 1.0}, {"quadratic", 2.0}});
    const std::vector<double> growth = growthOf(small, large);
    QCOMPARE(growth.size(), std::size_t{3});
    QVERIFY(std::isnan(growth[0]));
    QVERIFY(std::abs(growth[1] - 1.0) < 1e-9);
    QVERIFY(std::abs(growth[2] - 2.0) < 1e-9);
  }

  /// Every stage is there at every size, with figures that larger devices make larger.
  void stagesAreMeasured() {
    const QTemporaryDir cache;
    Progress quiet;
    ScaleBenchSettings settings;
    settings.sizes = {{{64, 48}, {40, 30}}, {{96, 64}, {64, 48}}};
    if (isSanitized) settings.sizes = {{{40, 30}, {28, 21}}, {{64, 48}, {40, 30}}};
    settings.pathsPerPixel = 4;
    int after = 0;
    settings.after.push_back({"after", [&](const fs::path& calibration, const fs::path&, Progress&) {
                                after += fs::exists(calibration / "calibration.relucent") ? 1 : 0;
                              }});
    const ScaleBenchResult result = benchScale(settings, cache.path().toStdString(), quiet);
    QCOMPARE(after, 2);
    QCOMPARE(result.runs.size(), std::size_t{2});
    for (const ScaleBenchRun& run : result.runs) {
      std::vector<std::string> names;
      for (const ScaleStage& stage : run.stages) {
        names.push_back(stage.name);
        QVERIFY(stage.memoryBytes > 1'000'000 && stage.seconds >= 0.0 && stage.processorSeconds > 0.0);
      }
      QCOMPARE(names, (std::vector<std::string>{"venue", "linearization", "acquisition", "inverse", "still",
                                                "evaluation", "after"}));
      QVERIFY(run.exposures > 50 && run.secondsToStill > 0.0 && run.refined > run.windows - 3.0);
      QVERIFY(run.used == run.sizes.camera);
    }
    const ScaleBenchRun &small = result.runs[0], &large = result.runs[1];
    QVERIFY(large.leaves > small.leaves && large.forecastBytes > small.forecastBytes);
    QVERIFY(large.photographBytes > small.photographBytes && large.resultBytes > small.resultBytes);
  }

  void impossibleSizesAreToldBefore() {
    ScaleBenchSettings settings;
    settings.sizes = {{{64, 48}, {40, 30}}, {{5000, 48}, {40, 30}}};
    QCOMPARE(problems(settings).size(), std::size_t{1});
  }
};

QTEST_GUILESS_MAIN(TestScaleBench)
#include "test_scale_bench.moc"
