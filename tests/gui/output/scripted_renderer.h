// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <thread>

#include "output/frame_renderer.h"
#include "output/screen_identity.h"
#include "relucent/base/error.h"

namespace relucent::gui {

inline const ScreenIdentity projector{"DUMMY1", "", "", ""};
inline constexpr QSize projectorSize{1024, 768};

/// The content as it is, or its negative where it is not to be compensated.
class ScriptedRenderer : public FrameRenderer {
 public:
  std::vector<QSize> projectors() const override { return {projectorSize}; }
  Canvas canvas() const override { return {projectorSize, compensation::Fit::fill}; }
  QString name() const override { return "scripted"; }
  std::vector<compensation::Position> cameras() const override { return positions; }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                       const Outdated& outdated) override {
    ++rendered;
    thorough = request.thorough;
    presence = request.viewer ? request.viewer->presence : 0.0;
    viewerX = request.viewer ? request.viewer->position[0] : 0.0;
    brightness = request.brightness;
    edition = request.edition;
    if (request.set) set = request.set->name;
    if (endless && thorough) {
      while (!outdated() && !interrupted) std::this_thread::yield();
      interrupted = false;
    }
    if (broken)
      throw Error(ErrorKind::device, Message::plain("the graphics card is gone"),
                  Message::plain("start again"));
    QImage drive = content.image.copy();
    if (!request.compensated) drive.invertPixels();
    return {{drive}, 0.25, 2, 0.001, !restless};
  }
  /// One that is called "gone" cannot be had.
  std::shared_ptr<PreparedSet> prepare(const std::string& name) override {
    while (holdsPreparing) std::this_thread::yield();
    ++prepared;
    if (name == "gone")
      throw Error(ErrorKind::input, Message::plain("there is no set 'gone'"),
                  Message::plain("choose another"));
    auto made = std::make_shared<PreparedSet>();
    made->name = name;
    return made;
  }
  void interrupt() override { interrupted = true; }
  std::atomic<int> prepared{0};
  std::string set;  // of the last frame that was asked for by one; while none is computed
  std::atomic<bool> holdsPreparing{false};
  std::atomic<int> rendered{0};
  std::atomic<bool> broken{false}, thorough{false}, restless{false}, interrupted{false};
  std::vector<compensation::Position> positions;                     // of cameras; before a player has it
  std::atomic<double> presence{0.0}, viewerX{0.0}, brightness{0.0};  // of the last frame
  std::atomic<std::uint64_t> edition{0};
  std::atomic<bool> endless{false};  // pictures that stand, until somebody wants them no longer
};

}  // namespace relucent::gui
