// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QSize>
#include <QString>
#include <functional>
#include <vector>

#include "content/canvas.h"
#include "content/content_source.h"

namespace relucent {

/// What is asked of a frame beside its content.
struct RenderRequest {
  bool compensated = true;      // false: the content in its place, nothing corrected
  bool thorough = false;        // as well as can be, whatever it takes: for a picture that stands
  double seconds = 1.0 / 60.0;  // that there are for it otherwise

  bool operator==(const RenderRequest&) const = default;
};

/// Asked now and then while a picture is made that stands: true once it stands no longer.
using Outdated = std::function<bool()>;

/// What all projectors show, and what came of it.
struct RenderedFrame {
  std::vector<QImage> drives;  // one a projector, of its size
  double clipped = 0.0;        // share of drive values that the projectors' limits cut off
  int steps = 0;               // of refinement
  double seconds = 0.0;
  bool settled = true;  // false: the same content would look a little different the next time
};

/// Turns content into what projectors show. Used by one thread at a time.
class FrameRenderer {
 public:
  virtual ~FrameRenderer() = default;
  /// The projectors' sizes in pixels.
  virtual std::vector<QSize> projectors() const = 0;
  /// The size that content must have.
  virtual Canvas canvas() const = 0;
  /// What it runs on, for people.
  virtual QString name() const = 0;
  /// What is rendered thoroughly and is `outdated` may end soon, no better than in haste.
  /// Throws: Error{device} if there is nothing left that could render.
  virtual RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                               const Outdated& outdated) = 0;
  /// From another thread: as if what is being rendered thoroughly were outdated.
  virtual void interrupt() {}
};

}  // namespace relucent
