// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/engine/engine_scenes.h"
#include "relucent/base/error.h"
#include "relucent/engine/cpu_backend.h"
#include "relucent/engine/opengl/gl_context.h"
#include "relucent/engine/opengl/opengl_backend.h"
#include "support/sanitized.h"

namespace relucent::synthetic {

/// Every test of test_backends runs on each of the back ends, on those that the machine has.
struct NamedBackend {
  std::string name;
  std::function<std::unique_ptr<engine::EngineBackend>(const engine::EngineVenue&)> make;
};

inline const std::vector<NamedBackend>& backends() {
  static const std::vector<NamedBackend> all = [] {
    std::vector<NamedBackend> list;
    for (const engine::EngineKernels& kernels : engine::engineKernels())
      list.push_back({kernels.instructions, [&kernels](const engine::EngineVenue& engine) {
                        return std::make_unique<engine::CpuBackend>(engine, &kernels);
                      }});
    list.push_back({"OpenGL", [](const engine::EngineVenue& engine) {
                      return std::make_unique<engine::OpenGlBackend>(
                          engine, std::make_unique<engine::GlContext>(engine::GlContext::Device::any));
                    }});
    return list;
  }();
  return all;
}

/// Why a back end cannot run here, empty if it can.
inline QString missing(const QString& backend) {
  static const QString openGl = [] {
    try {
      engine::GlContext context(engine::GlContext::Device::any);
      return QString();
    } catch (const Error& error) {
      return QString(error.what());
    }
  }();
  return backend == "OpenGL" ? openGl : QString();
}

inline std::unique_ptr<engine::EngineBackend> backendOf(const QString& name,
                                                        const engine::EngineVenue& engine) {
  for (const NamedBackend& backend : backends())
    if (name == QString::fromStdString(backend.name)) return backend.make(engine);
  return nullptr;
}

inline void everyBackend() {
  QTest::addColumn<QString>("backend");
  for (const NamedBackend& backend : backends())
    QTest::newRow(backend.name.c_str()) << QString::fromStdString(backend.name);
}

/// Under the address sanitizer, which takes ten times as long, each scene in one of them, in turn.
inline void everyBackendInEveryScene() {
  QTest::addColumn<QString>("backend");
  QTest::addColumn<QString>("scene");
  const std::size_t step = isSanitized ? backends().size() : 1;
  for (std::size_t backend = 0; backend < backends().size(); ++backend)
    for (std::size_t scene = backend % step; scene < engineSceneNames().size(); scene += step)
      QTest::addRow("%s, %s", backends()[backend].name.c_str(), engineSceneNames()[scene].c_str())
          << QString::fromStdString(backends()[backend].name)
          << QString::fromStdString(engineSceneNames()[scene]);
}

inline engine::ContentFrame frameOf(const image::Image& linear) {
  return {linear.data().data(), linear.size(), 12 * static_cast<std::size_t>(linear.width()),
          engine::ContentFrame::Format::linearFloat};
}

/// Skips the row of a back end that cannot run here, and says why.
#define SKIP_WHERE_MISSING(backend)      \
  if (!missing(backend).isEmpty()) {     \
    QSKIP(qPrintable(missing(backend))); \
  }

/// Undithered, so that a value has one right code.
inline engine::EngineSettings plain(const EngineScene& scene = {}) {
  engine::EngineSettings settings;
  settings.target = scene.target;
  settings.dither = engine::Dither::none;
  return settings;
}

/// The same with all of T that codes can hold.
inline engine::EngineSettings exact(const EngineScene& scene = {}) {
  engine::EngineSettings settings = plain(scene);
  settings.packing.tolerance = 0.0f;
  return settings;
}

inline std::vector<std::uint32_t> rendered(engine::EngineBackend& backend, const engine::EngineVenue& engine,
                                           const engine::ContentFrame& frame,
                                           const engine::FrameRequest& request,
                                           engine::FrameReport* report = nullptr) {
  engine::EngineContent content = engine::prepareContent(engine, frame.size);
  backend.setContent(content);
  std::vector<std::uint32_t> words(engine.brightest.size());
  engine::FrameReport ignored;
  if (!backend.render(frame, request, words, report != nullptr ? *report : ignored)) words.clear();
  return words;
}

inline int codeOf(std::uint32_t word, std::size_t channel, int bits = 8) {
  return static_cast<int>(word >> (static_cast<unsigned>(bits) * channel) & ((1u << bits) - 1u));
}

/// The largest difference between 8-bit words and linear drive under a linear response, in codes.
inline double mostCodesApart(const std::vector<std::uint32_t>& words, const ProjectorStack& projector) {
  double most = 0.0;
  for (std::size_t i = 0; i < projector.size(); ++i)
    most = std::max(most, std::abs(codeOf(words[i / 3], i % 3) - 255.0 * static_cast<double>(projector[i])));
  return most;
}

inline int mostApart(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, int bits = 8) {
  if (a.size() != b.size()) return 1 << bits;
  int most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      most = std::max(most, std::abs(codeOf(a[i], c, bits) - codeOf(b[i], c, bits)));
  return most;
}

}  // namespace relucent::synthetic
