// SPDX-License-Identifier: MIT
// The real-time engine against the machine's copy bandwidth. Needs neither Qt nor a display, so it can be
// carried to another machine alone.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/engine/bench/engine_bench.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::inverse;
using namespace relucent::linearization;
using namespace relucent::transport;

namespace {

/// "1024x768".
bool parse(const std::string& text, Size& size) {
  return std::sscanf(text.c_str(), "%dx%d", &size.width, &size.height) == 2;
}

void addSize(CLI::App& app, const char* option, Size& size, const char* help) {
  app.add_option_function<std::string>(
      option,
      [option, &size](const std::string& text) {
        if (!parse(text, size)) throw CLI::ValidationError(option, "is written like 1024x768");
      },
      help);
}

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string ratiosOf(const EngineBenchLine& line) {
  std::string ratios;
  for (const EngineBenchRatio& ratio : line.timesAsFastAs)
    ratios += fmt::format("{}\"{}\":{:.2f}", ratios.empty() ? "" : ",", ratio.reference, ratio.times);
  return ratios.empty() ? ratios : fmt::format(",\"times_as_fast_as\":{{{}}}", ratios);
}

/// As `relucent-cli bench engine --json` prints it.
void print(const EngineBenchResult& result) {
  fmt::print(
      "{{\"machine\":{{\"processor\":\"{}\",\"device\":\"{}\",\"threads\":{},\"copy_bytes_per_second\":{:.4g}"
      "}},"
      "\"benchmarks\":[\n",
      processorName(), result.device, result.threads, result.copyBytesPerSecond);
  for (std::size_t i = 0; i < result.lines.size(); ++i) {
    const EngineBenchLine& line = result.lines[i];
    fmt::print(
        "{{\"name\":\"{}\",\"seconds\":{:.6f},\"best\":{:.6f},\"bytes\":{:.4g},\"share_of_copy\":{:.3f}{}}}{}"
        "\n",
        line.name, line.seconds, line.best, line.bytes, line.shareOfCopy, ratiosOf(line),
        i + 1 < result.lines.size() ? "," : "]");
  }
  std::string notes;
  for (const Message& note : result.notes) notes += fmt::format("{}\"{}\"", notes.empty() ? "" : ",", note);
  fmt::print("{}}}\n", notes.empty() ? "" : fmt::format(",\"notes\":[{}]", notes));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the real-time engine and prints JSON.");
  EngineBenchSettings settings;
  bool noReferences = false;
  app.add_option_function<std::string>(
         "--backend",
         [&settings](const std::string& name) {
           settings.backend = parsedName<BackendChoice>(name, ErrorKind::usage);
         },
         "What it runs on")
      ->check(CLI::IsMember(allNames<BackendChoice>()));
  addSize(app, "--projector", settings.projector, "WxH");
  addSize(app, "--camera", settings.camera, "WxH");
  addSize(app, "--content", settings.content, "WxH");
  app.add_option("--patch", settings.patchSide, "Side of T's patches in camera pixels");
  app.add_option_function<std::string>(
         "--clipping",
         [&settings](const std::string& name) {
           settings.clipping = parsedName<Clipping>(name, ErrorKind::usage);
         },
         "Colours of which a place cannot show one channel")
      ->check(CLI::IsMember(allNames<Clipping>()));
  app.add_option("--transport", settings.transport,
                 "A calibration's transport.npz instead of the synthetic one");
  app.add_flag("--one-thread", settings.oneThread,
               "Seconds of one core instead of those on the wall: for machines that others use too");
  app.add_flag("--no-references", noReferences, "Without the pipeline's own products, Eigen's and SciPy's");
  CLI11_PARSE(app, argc, argv);
  settings.references = !noReferences;
  if (auto wrong = problems(settings); !wrong.empty()) {
    fmt::print(stderr, "relucent-engine-benchmark: {}\n", fmt::join(wrong, "; "));
    return 2;
  }
  try {
    Progress silent;
    print(benchEngine(settings, silent));
  } catch (const std::exception& error) {
    fmt::print(stderr, "relucent-engine-benchmark: {}\n", error.what());
    return 1;
  }
}
