// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/canvas.h"
#include "content/content_source.h"
#include "output/drive_picture.h"
#include "relucent/compensation/viewer.h"
#include "relucent/engine/availability.h"

namespace relucent::gui {

/// For whom a frame is: a viewer at a place, in the units of the cameras' positions, who counts beside whom
/// the content is otherwise for.
struct FrameViewer {
  compensation::Position position{};
  double presence = 1.0;  // 0: not at all, 1: he alone

  bool operator==(const FrameViewer&) const = default;
};

/// What a renderer needs for frames of one set of its calibration (pipeline/sets.h), made by
/// FrameRenderer::prepare().
struct PreparedSet {
  std::string name;       // empty: the one that was in use, whatever its name
  std::string shownFrom;  // of pipeline::fingerprintOfShown(); empty: nobody knows
  virtual ~PreparedSet() = default;
};

/// Options of a frame besides its content.
struct RenderRequest {
  bool compensated = true;              // false: only placed, not corrected
  bool thorough = false;                // as well as possible, without a time limit: for still pictures
  double seconds = 1.0 / 60.0;          // that there are for it otherwise
  double brightness = 1.0;              // of white, relative to the calibration's
  std::optional<FrameViewer> viewer{};  // none: as the calibration's content has it
  /// With another one, what the calibration keeps of the picture is looked for again.
  std::uint64_t edition = 0;
  /// What somebody leaves of the projectors' light; none: all.
  std::shared_ptr<const engine::Availability> available{};
  /// As which set of the calibration it is shown; none: as the last frame was.
  std::shared_ptr<PreparedSet> set{};

  bool operator==(const RenderRequest&) const = default;
};

/// Called repeatedly while a still picture is computed; true once it is no longer needed.
using Outdated = std::function<bool()>;

/// The pictures of all projectors, with statistics.
struct RenderedFrame {
  std::vector<DrivePicture> drives;  // one a projector, of its size
  double clipped = 0.0;              // share of drive values that were clipped
  int steps = 0;                     // of refinement
  double seconds = 0.0;
  bool settled = true;     // false: rendering the same content again would differ slightly
  bool perfected = false;  // as photographs of it corrected it, see PerfectedPictures
};

/// Computes the projectors' pictures from content. Used by one thread at a time, but for what says otherwise.
class FrameRenderer {
 public:
  virtual ~FrameRenderer() = default;
  /// The projectors' sizes in pixels.
  virtual std::vector<QSize> projectors() const = 0;
  /// The required size of content.
  virtual Canvas canvas() const = 0;
  /// Name of the device, for display.
  virtual QString name() const = 0;
  /// Where all cameras stand, for RenderRequest::viewer; empty: not known, or there is only one.
  virtual std::vector<compensation::Position> cameras() const { return {}; }
  /// A thorough rendering that becomes `outdated` may end early with the result of a fast one.
  /// Throws: Error{device} if no device is left.
  virtual RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                               const Outdated& outdated) = 0;
  /// Prepares frames of another set for RenderRequest::set, on any thread while frames are rendered; takes
  /// seconds, and time of frames only where nothing else is left. Empty: the set in use.
  /// Throws: as pipeline::openWithSet(); what preparing content throws.
  virtual std::shared_ptr<PreparedSet> prepare(const std::string& set) = 0;
  /// From another thread: makes the present thorough rendering outdated.
  virtual void interrupt() {}
};

}  // namespace relucent::gui
