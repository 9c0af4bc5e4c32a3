// SPDX-License-Identifier: MIT
// relucent-page-benchmark CALIBRATION: how long a calibration takes to open, and how long Threshold and
// Cluster take to follow their sliders. The folder is only read. Prints JSON.
#include <CLI/CLI.hpp>
#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTemporaryDir>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "wizard/cluster/cluster_page.h"
#include "wizard/threshold/threshold_page.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::gui;

namespace {

/// Seconds until a page says that something is so.
template <typename Condition>
double until(PageModel& page, const Condition& condition) {
  QElapsedTimer timer;
  timer.start();
  QEventLoop waiting;
  auto connection = QObject::connect(&page, &PageModel::resultChanged, &waiting, [&] {
    if (condition()) waiting.quit();
  });
  auto failing = QObject::connect(&page, &PageModel::failed, &waiting, [](const FailureReport& report) {
    std::fprintf(stderr, "%s\n", qPrintable(report.failure.what));
    std::exit(1);
  });
  if (!condition()) waiting.exec();
  QObject::disconnect(connection);
  QObject::disconnect(failing);
  return 1e-9 * static_cast<double>(timer.nsecsElapsed());
}

nlohmann::json thresholds(ThresholdPage& page) {
  nlohmann::json seconds;
  seconds["until_it_can_be_cut"] = until(page, [&] { return page.whole() && page.kept() && page.matrix(); });
  // Keeps nearly all of the light.
  const double cut = transport::cutKeeping(page.whole()->histogram, 0.995);
  for (double share : {0.5, 2.0}) {
    auto matrix = page.matrix();
    auto energy = page.kept()->energyKept;
    page.setAbsolute(share * cut);
    double picture = until(page, [&] { return page.matrix() != matrix; });
    double exact = until(page, [&] { return page.kept()->energyKept != energy && page.isExact(); });
    seconds["cuts"].push_back({{"matrix", picture}, {"exact", picture + exact}});
  }
  page.setAbsolute(0.0);
  until(page, [&] { return page.kept()->energyKept == 1.0; });
  return seconds;
}

nlohmann::json clusters(ClusterPage& page) {
  nlohmann::json seconds;
  page.enter();
  seconds["until_it_can_be_grouped"] = until(page, [&] { return page.isReady(); });
  seconds["first"] = until(page, [&] { return page.result() && !page.isComputing(); });
  for (double radius : {6.0, 12.0}) {
    ClusteringSettings settings = page.settings();
    settings.patchRadius = radius;
    auto before = page.result();
    page.setSettings(settings);
    double first = until(page, [&] { return page.result() != before; });
    double exact = until(page, [&] { return !page.isComputing(); });
    seconds["sliders"].push_back({{"first", first}, {"exact", first + exact}});
  }
  return seconds;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  CLI::App options("How long a calibration takes to open, and how quickly sliders are followed.");
  std::string folder;
  options.add_option("calibration", folder, "A measured calibration")->required();
  CLI11_PARSE(options, argc, argv);

  QTemporaryDir cache;
  Session session(cache.path().toStdString());
  ThresholdPage threshold(session);
  ClusterPage cluster(session);
  nlohmann::json result;
  QElapsedTimer opening;
  opening.start();
  session.open(folder);
  result["open_seconds"] = 1e-9 * static_cast<double>(opening.nsecsElapsed());
  threshold.enter();
  result["read_seconds"] = until(threshold, [&] { return session.acquisition() != nullptr; });
  result["threshold_seconds"] = thresholds(threshold);
  result["cluster_seconds"] = clusters(cluster);
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}
