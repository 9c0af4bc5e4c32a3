// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "base/error.h"
#include "core/engine/engine_scenes.h"
#include "engine/cpu_backend.h"
#include "engine/opengl/gl_context.h"
#include "engine/opengl/opengl_backend.h"

namespace relucent::synthetic {

/// Every test of test_backends runs on each of the back ends, on those that the machine has.
struct NamedBackend {
  std::string name;
  std::function<std::unique_ptr<EngineBackend>(const EngineVenue&)> make;
};

inline const std::vector<NamedBackend>& backends() {
  static const std::vector<NamedBackend> all = [] {
    std::vector<NamedBackend> list;
    for (const EngineKernels& kernels : engineKernels())
      list.push_back({kernels.instructions, [&kernels](const EngineVenue& engine) {
                        return std::make_unique<CpuBackend>(engine, &kernels);
                      }});
    list.push_back({"OpenGL", [](const EngineVenue& engine) {
                      return std::make_unique<OpenGlBackend>(
                          engine, std::make_unique<GlContext>(GlContext::Device::any));
                    }});
    return list;
  }();
  return all;
}

/// Why a back end cannot run here, empty if it can.
inline QString missing(const QString& backend) {
  static const QString openGl = [] {
    try {
      GlContext context(GlContext::Device::any);
      return QString();
    } catch (const Error& error) {
      return QString(error.what());
    }
  }();
  return backend == "OpenGL" ? openGl : QString();
}

inline std::unique_ptr<EngineBackend> backendOf(const QString& name, const EngineVenue& engine) {
  for (const NamedBackend& backend : backends())
    if (name == QString::fromStdString(backend.name)) return backend.make(engine);
  return nullptr;
}

inline void everyBackend() {
  QTest::addColumn<QString>("backend");
  for (const NamedBackend& backend : backends())
    QTest::newRow(backend.name.c_str()) << QString::fromStdString(backend.name);
}

inline void everyBackendInEveryScene() {
  QTest::addColumn<QString>("backend");
  QTest::addColumn<QString>("scene");
  for (const NamedBackend& backend : backends())
    for (const std::string& scene : engineSceneNames())
      QTest::addRow("%s, %s", backend.name.c_str(), scene.c_str())
          << QString::fromStdString(backend.name) << QString::fromStdString(scene);
}

inline ContentFrame frameOf(const Image& linear) {
  return {linear.data().data(), linear.size(), 12 * static_cast<std::size_t>(linear.width()),
          ContentFrame::Format::linearFloat};
}

/// Skips the row of a back end that cannot run here, and says why.
#define SKIP_WHERE_MISSING(backend)      \
  if (!missing(backend).isEmpty()) {     \
    QSKIP(qPrintable(missing(backend))); \
  }

/// Undithered, so that a value has one right code.
inline EngineSettings plain() {
  EngineSettings settings;
  settings.dither = Dither::none;
  return settings;
}

inline std::vector<std::uint32_t> rendered(EngineBackend& backend, const EngineVenue& engine,
                                           const ContentFrame& frame, const FrameRequest& request,
                                           FrameReport* report = nullptr) {
  EngineContent content = prepareContent(engine, frame.size);
  backend.setContent(content);
  std::vector<std::uint32_t> words(engine.brightest.size());
  FrameReport ignored;
  if (!backend.render(frame, request, words, report != nullptr ? *report : ignored)) words.clear();
  return words;
}

inline int codeOf(std::uint32_t word, std::size_t channel, int bits = 8) {
  return static_cast<int>(word >> (static_cast<unsigned>(bits) * channel) & ((1u << bits) - 1u));
}

/// The largest difference between 8-bit words and linear drive under a linear response, in codes.
inline double mostCodesApart(const std::vector<std::uint32_t>& words, const Stack& projector) {
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
