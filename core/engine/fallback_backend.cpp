// SPDX-License-Identifier: MIT
#include "relucent/engine/fallback_backend.h"

#include <exception>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/engine/agreement.h"
#include "relucent/engine/cpu_backend.h"
#include "relucent/engine/opengl/gl_context.h"
#include "relucent/engine/opengl/opengl_backend.h"

namespace relucent::engine {
namespace {

/// The host's context, if it is on the same device; else null.
std::unique_ptr<GlContext> sharedContext(const MakeGlHost& make, const GlContext& chosen) {
  std::unique_ptr<GlHost> host = make ? make() : nullptr;
  if (!host) return nullptr;
  try {
    auto shared = std::make_unique<GlContext>(std::move(host), GlContext::Device::any);
    return shared->renderer() == chosen.renderer() ? std::move(shared) : nullptr;
  } catch (const Error&) {
    return nullptr;  // the windows' system has less than the card can
  }
}

}  // namespace

FallbackBackend::FallbackBackend(std::unique_ptr<EngineBackend> first, Make makeOther, Notify notify,
                                 Prove prove)
    : backend_(std::move(first)),
      makeOther_(std::move(makeOther)),
      notify_(std::move(notify)),
      prove_(std::move(prove)) {
  require(backend_ != nullptr && makeOther_ != nullptr, "a fallback needs two back ends");
}

void FallbackBackend::goOver(const Message& why) {
  const std::string before(backend_->name());
  backend_ = std::exchange(makeOther_, nullptr)();
  if (content_ != nullptr) backend_->setContent(*content_);
  if (notify_)
    notify_(RELUCENT_ENGLISH_MESSAGE("engine.going-on-with-another", "{}: {}; going on with {}")
                .with(before, why, backend_->name()));
}

void FallbackBackend::setContent(const EngineContent& content) {
  content_ = &content;
  change([&content](EngineBackend& backend) { backend.setContent(content); });
  if (makeOther_ && prove_) proveFirst(content);
}

void FallbackBackend::proveFirst(const EngineContent& content) {
  const Prove prove = std::exchange(prove_, nullptr);
  const std::unique_ptr<EngineBackend> other = makeOther_();
  other->setContent(content);
  if (!prove(*backend_, *other, content))
    return goOver(RELUCENT_ENGLISH_MESSAGE(
        "engine.wrong-pictures", "its pictures are not those of the processor, a fault of the driver"));
  // What was shown for the proof is nothing to go on from.
  change([&content](EngineBackend& backend) { backend.setContent(content); });
}

void FallbackBackend::contentFollowed() {
  change([](EngineBackend& backend) { backend.contentFollowed(); });
}

void FallbackBackend::availabilityFollowed() {
  change([](EngineBackend& backend) { backend.availabilityFollowed(); });
}

void FallbackBackend::startFrom(std::span<const float> projector) {
  change([projector](EngineBackend& backend) { backend.startFrom(projector); });
}

template <typename Change>
void FallbackBackend::change(const Change& change) {
  if (!makeOther_) return change(*backend_);
  try {
    change(*backend_);
  } catch (const Error& error) {
    goOver(error.summary());
  }
}

bool FallbackBackend::render(const ContentFrame& frame, const FrameRequest& request,
                             std::span<std::uint32_t> words, FrameReport& report) noexcept {
  if (backend_->render(frame, request, words, report)) return true;
  if (!makeOther_) return false;
  try {
    goOver(RELUCENT_ENGLISH_MESSAGE("engine.device-was-lost", "the device was lost"));
    return backend_->render(frame, request, words, report);
  } catch (const std::exception&) {
    return false;
  }
}

bool FallbackBackend::renderToTextures(const ContentFrame& frame, const FrameRequest& request,
                                       std::span<const std::uint32_t> textures,
                                       FrameReport& report) noexcept {
  if (backend_->renderToTextures(frame, request, textures, report)) return true;
  if (!makeOther_) return false;
  try {
    goOver(RELUCENT_ENGLISH_MESSAGE("engine.device-was-lost", "the device was lost"));
  } catch (const std::exception&) {
    // Nor will render() find another.
  }
  return false;
}

std::unique_ptr<EngineBackend> makeBackend(const EngineVenue& engine, BackendChoice choice,
                                           const FallbackBackend::Notify& notify, const MakeGlHost& host) {
  auto cpu = [&engine]() -> std::unique_ptr<EngineBackend> { return std::make_unique<CpuBackend>(engine); };
  if (choice == BackendChoice::cpu) return cpu();

  std::unique_ptr<GlContext> context;
  const bool automatic = choice == BackendChoice::automatic;
  try {
    context = std::make_unique<GlContext>(automatic ? GlContext::Device::graphics : GlContext::Device::any);
  } catch (const Error&) {
    if (!automatic) throw;
    return cpu();
  }
  if (auto shared = sharedContext(host, *context)) context = std::move(shared);
  try {
    auto openGl = std::make_unique<OpenGlBackend>(engine, std::move(context));
    return std::make_unique<FallbackBackend>(
        std::move(openGl), cpu, notify,
        [&engine](EngineBackend& first, EngineBackend& other, const EngineContent& content) {
          return agree(first, other, engine, content);
        });
  } catch (const Error& error) {
    if (!automatic) throw;
    if (notify) notify(error.sentence());
    return cpu();
  }
}

}  // namespace relucent::engine
