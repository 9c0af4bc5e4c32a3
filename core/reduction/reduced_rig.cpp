// SPDX-License-Identifier: MIT
#include "relucent/reduction/reduced_rig.h"

#include <algorithm>
#include <functional>

#include "relucent/base/error.h"

namespace relucent::reduction {
namespace {

class BorrowedProjector : public rig::Projector {
 public:
  explicit BorrowedProjector(rig::Projector& projector) : projector_(projector) {}
  std::string name() const override { return projector_.name(); }
  Size size() const override { return projector_.size(); }
  int bits() const override { return projector_.bits(); }
  void show(const image::Image& encodedDrive) override { projector_.show(encodedDrive); }

 private:
  rig::Projector& projector_;
};

/// A camera whose photographs are made smaller by whatever makes them so.
class SmallerCamera : public rig::Camera {
 public:
  using Smaller = std::function<rig::RawFrame(const rig::RawFrame&)>;
  /// `part`: what this looks at of a photograph; none: all.
  SmallerCamera(rig::Camera& camera, Size from, std::optional<rig::PicturePart> part, Size size,
                Smaller smaller)
      : camera_(camera), from_(from), part_(part), size_(size), smaller_(std::move(smaller)) {}

  std::string name() const override { return camera_.name(); }
  Size size() const override { return size_; }
  rig::ExposureRange exposures() const override { return camera_.exposures(); }
  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    rig::CaptureRequest asked = request;
    asked.part = part_;
    const rig::RawFrame frame = camera_.capture(asked);
    rig::checkFrame(frame, from_, name());
    return smaller_(frame);
  }

 private:
  rig::Camera& camera_;
  Size from_;
  std::optional<rig::PicturePart> part_;
  Size size_;
  Smaller smaller_;
};

rig::Rig borrowed(rig::Rig& rig, const std::function<std::unique_ptr<rig::Camera>(std::size_t)>& cameraOf) {
  rig::Rig result;
  for (const auto& projector : rig.projectors)
    result.projectors.push_back(std::make_unique<BorrowedProjector>(*projector));
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
    result.cameras.push_back(cameraOf(camera));
  return result;
}

[[noreturn]] void failForeign(const Message& what, const std::string& camera) {
  throw Error(ErrorKind::input, what,
              RELUCENT_MESSAGE("reduction.restore-camera-size",
                               "set the camera to the size that it had, or calibrate again"),
              camera);
}

}  // namespace

rig::Rig reduced(rig::Rig& rig, const std::vector<Reduction>& reductions) {
  if (!reductions.empty() && reductions.size() != rig.cameras.size())
    failForeign(
        RELUCENT_ENGLISH_MESSAGE("reduction.other-cameras", "there are {} cameras where {} were calibrated")
            .with(rig.cameras.size(), reductions.size()),
        rig.cameras.empty() ? std::string() : rig.cameras.front()->name());
  return borrowed(rig, [&](std::size_t at) -> std::unique_ptr<rig::Camera> {
    rig::Camera& camera = *rig.cameras[at];
    const Reduction reduction = reductions.empty() ? noReduction(camera.size()) : reductions[at];
    if (camera.size() != reduction.camera)
      failForeign(
          RELUCENT_MESSAGE("reduction.other-size", "the camera delivers {} pixels where {} were calibrated")
              .with(as::size(camera.size()), as::size(reduction.camera)),
          camera.name());
    return std::make_unique<SmallerCamera>(camera, reduction.camera,
                                           rig::PicturePart{reduction.begin, reduction.part},
                                           reduction.size(), Reducer(reduction));
  });
}

image::Image everyNth(const image::Image& picture, int stride) {
  const Size from = picture.size();
  image::Image result({(from.width - 1) / stride + 1, (from.height - 1) / stride + 1}, picture.channels());
  for (std::size_t i = 0; i < result.pixels(); ++i) {
    const Pixel at = pixelAt(result.size(), i);
    std::ranges::copy(picture.pixel(indexOf(from, {at.x * stride, at.y * stride})), result.pixel(i).begin());
  }
  return result;
}

int strideFor(Size camera, std::size_t mostPixels) {
  int stride = 1;
  while (camera.count() / static_cast<std::size_t>(stride * stride) > mostPixels) ++stride;
  return stride;
}

rig::Rig sparse(rig::Rig& rig, std::size_t mostPixels) {
  return borrowed(rig, [&](std::size_t at) -> std::unique_ptr<rig::Camera> {
    rig::Camera& camera = *rig.cameras[at];
    const Size from = camera.size();
    const int stride = strideFor(from, mostPixels);
    const Size size{(from.width - 1) / stride + 1, (from.height - 1) / stride + 1};
    const auto smaller = [stride](const rig::RawFrame& frame) {
      return rig::RawFrame{everyNth(frame.signal, stride), frame.bits, frame.seconds};
    };
    return std::make_unique<SmallerCamera>(camera, from, std::nullopt, size, smaller);
  });
}

Rasters reducedRasters(const std::vector<Reduction>& reductions) {
  std::vector<Size> sizes;
  for (const Reduction& reduction : reductions) sizes.push_back(reduction.size());
  return Rasters(std::move(sizes));
}

}  // namespace relucent::reduction
