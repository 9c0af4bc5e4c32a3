// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "relucent/base/enum_names.h"
#include "relucent/base/message.h"
#include "relucent/engine/backend.h"
#include "relucent/engine/gl_host.h"

namespace relucent::engine {

/// Which back end frames run on.
enum class BackendChoice {
  automatic,  // a graphics card if there is one, else the processor
  cpu,
  openGl,  // also a software renderer
};
inline constexpr EnumName<BackendChoice> backendNames[]{
    {BackendChoice::automatic, "automatic"}, {BackendChoice::cpu, "cpu"}, {BackendChoice::openGl, "opengl"}};
constexpr EnumNames<BackendChoice> namesOf(BackendChoice) {
  return {"back end", backendNames};
}

/// A back end that switches to another one when its device is lost: the frame in which that happens is
/// rendered again by the other, so none is missing. It never switches back, because a device that was lost
/// once is unreliable.
class FallbackBackend : public EngineBackend {
 public:
  /// Makes the other back end when it is first needed.
  using Make = std::function<std::unique_ptr<EngineBackend>()>;
  /// Called once, on the rendering thread, with a sentence that says what happened.
  using Notify = std::function<void(const Message&)>;
  /// Whether the first back end makes the pictures that the other makes. Both have the content.
  using Prove = std::function<bool(EngineBackend& first, EngineBackend& other, const EngineContent& content)>;

  /// `prove`: asked once, with the first content; where it says no, the other takes over. None: not asked.
  FallbackBackend(std::unique_ptr<EngineBackend> first, Make makeOther, Notify notify, Prove prove = {});

  std::string_view name() const override { return backend_->name(); }
  /// Also switches if the device cannot hold the content, or its pictures are proven wrong. Throws: as the
  /// other back end.
  void setContent(const EngineContent& content) override;
  /// The other back end has nothing that was projected last.
  void contentFollowed() override;
  void availabilityFollowed() override;
  void startFrom(std::span<const float> projector) override;
  /// False only if the other one is lost too.
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override;
  bool sharesTextures() const override { return backend_->sharesTextures(); }
  /// False, too, where it has switched: sharesTextures() may have changed.
  bool renderToTextures(const ContentFrame& frame, const FrameRequest& request,
                        std::span<const std::uint32_t> textures, FrameReport& report) noexcept override;

 private:
  void goOver(const Message& why);
  void proveFirst(const EngineContent& content);
  /// Switches if the device cannot.
  template <typename Change>
  void change(const Change& change);

  std::unique_ptr<EngineBackend> backend_;
  Make makeOther_;  // empty once it was used
  Notify notify_;
  Prove prove_;  // empty once it was asked
  const EngineContent* content_ = nullptr;
};

/// The selected back end, with the processor as fallback for a graphics card, which must agree() with it:
/// drivers are at fault at times. `notify` is also called with the reason why an existing graphics card
/// cannot be used. `host`: a context that shares its textures with windows; it is taken where it is on the
/// device that would be chosen without. `engine` must outlive it. Throws: Error{device} if OpenGL was asked
/// for and there is none.
std::unique_ptr<EngineBackend> makeBackend(const EngineVenue& engine, BackendChoice choice,
                                           const FallbackBackend::Notify& notify,
                                           const MakeGlHost& host = {});

}  // namespace relucent::engine
