// SPDX-License-Identifier: MIT
// relucent-view-benchmark: how fast the view of T is panned, on the X server and the OpenGL that are there,
// and how long its pictures take. Prints JSON.
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QOpenGLWidget>
#include <QTest>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "relucent/transport/matrix_density.h"
#include "synthetic_transport.h"
#include "views/matrix_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::transport;

namespace {

/// Seconds of the quickest of a few.
template <typename Work>
double quickest(const Work& work) {
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    QElapsedTimer timer;
    timer.start();
    work();
    least = std::min(least, static_cast<double>(timer.nsecsElapsed()) * 1e-9);
  }
  return least;
}

nlohmann::json pictures(const MatrixPictures& matrix) {
  MatrixPart all = matrix.whole();
  auto part = [&](std::size_t share) {
    MatrixPart middle = all;
    middle.firstRow = all.endRow / 2 - all.endRow / (2 * share);
    middle.endRow = middle.firstRow + all.endRow / share;
    middle.firstColumn = all.endColumn / 2 - all.endColumn / (2 * share);
    middle.endColumn = middle.firstColumn + all.endColumn / share;
    return middle;
  };
  nlohmann::json seconds;
  for (std::size_t share : {std::size_t{1}, std::size_t{4}, std::size_t{64}, std::size_t{256}})
    seconds[std::to_string(share)] =
        quickest([&] { matrix.density(part(share), share == 1 ? Size{768, 480} : Size{1024, 768}); });
  return seconds;
}

/// Each step is as far as a hand drags in a frame; the sharper pictures are made meanwhile. What is counted
/// has gone to the screen.
nlohmann::json panned(MatrixView& view, int frames) {
  auto* canvas = view.findChild<QOpenGLWidget*>();
  int shown = 0;
  double slowest = 0.0;
  QEventLoop until;
  QElapsedTimer whole, frame;
  auto step = [&] {
    double angle = 0.05 * shown;
    view.link().look(12.0, {0.45 + 0.05 * std::cos(angle), 0.45 + 0.05 * std::sin(angle)});
  };
  QObject::connect(canvas, &QOpenGLWidget::frameSwapped, &until, [&] {
    slowest = std::max(slowest, 1e-9 * static_cast<double>(frame.nsecsElapsed()));
    frame.start();
    ++shown;
    shown < frames ? step() : until.quit();
  });
  whole.start();
  frame.start();
  step();
  until.exec();
  return {{"width", view.width()},
          {"height", view.height()},
          {"frames_per_second", frames / (1e-9 * static_cast<double>(whole.nsecsElapsed()))},
          {"slowest_frame_seconds", slowest}};
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  CLI::App options(
      "How fast the view of the light transport matrix is panned, and how long its pictures take.");
  int width = 1280, height = 800, frames = 150;
  options.add_option("--width", width, "Of the view, in pixels")->capture_default_str();
  options.add_option("--height", height)->capture_default_str();
  options.add_option("--frames", frames)->check(CLI::Range(2, 100000))->capture_default_str();
  bool panOnly = false;
  options.add_flag("--pan-only", panOnly, "Not the times of single pictures");
  CLI11_PARSE(options, argc, argv);

  benchmarks::SyntheticSettings settings;
  settings.footprint = 6;
  settings.coarseNodes = 32;
  Rasters projectors(settings.projector);
  NodeLayout layout(projectors);
  auto transport = std::make_shared<TransportMatrix>(settings.camera, settings.projector,
                                                     benchmarks::syntheticLeaves(settings, layout));
  nlohmann::json result{{"leaves", transport->storedLeaves()}, {"cores", tbb::info::default_concurrency()}};
  std::shared_ptr<const MatrixPictures> matrix;
  result["prepare_seconds"] = quickest([&] { matrix = std::make_shared<MatrixPictures>(transport); });
  if (!panOnly) result["picture_seconds_by_share_of_a_side"] = pictures(*matrix);

  MatrixView view;
  view.resize(width, height);
  view.show();
  if (!QTest::qWaitForWindowExposed(&view)) return 1;
  view.setMatrix(matrix);
  auto settled = [&] { return view.isSettled(); };
  if (!QTest::qWaitFor(settled, 60000)) return 1;
  view.link().look(12.0, {0.4, 0.4});
  if (!QTest::qWaitFor(settled, 60000)) return 1;

  result["pan"] = panned(view, frames);
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}
