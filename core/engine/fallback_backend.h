// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "engine/backend.h"

namespace relucent {

/// Which back end frames run on.
enum class BackendChoice {
  automatic,  // a graphics card if there is one, else the processor
  cpu,
  openGl,  // also where the processor only pretends to be a graphics card
};
/// As people write them: automatic, cpu, opengl.
const std::map<std::string, BackendChoice>& backendChoices();

/// A back end that goes over to another one when it is lost: the frame in which that happens is rendered once
/// more by the other, so none is missing. It never goes back: a device that was lost once is not to be
/// trusted with a show.
class FallbackBackend : public EngineBackend {
 public:
  /// Makes the other back end, when it is needed and not before.
  using Make = std::function<std::unique_ptr<EngineBackend>()>;
  /// Hears once, by the thread that renders, in a sentence what happened.
  using Told = std::function<void(const std::string&)>;

  FallbackBackend(std::unique_ptr<EngineBackend> first, Make makeOther, Told told);

  std::string_view name() const override { return backend_->name(); }
  /// Goes over too if the device cannot take the content. Throws: as the other back end.
  void setContent(const EngineContent& content) override;
  /// False only if the other one is lost too.
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override;

 private:
  void goOver(const std::string& why);

  std::unique_ptr<EngineBackend> backend_;
  Make makeOther_;  // empty once it was used
  Told told_;
  const EngineContent* content_ = nullptr;
};

/// The back end that was chosen, with the processor behind it should a graphics card be lost. `told` also
/// hears why a graphics card that is there cannot be used. `engine` must outlive it.
/// Throws: Error{device} if OpenGL was asked for and there is none.
std::unique_ptr<EngineBackend> makeBackend(const EngineVenue& engine, BackendChoice choice,
                                           const FallbackBackend::Told& told);

}  // namespace relucent
