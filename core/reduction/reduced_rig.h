// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "relucent/reduction/reduction.h"

namespace relucent::reduction {

/// A rig's devices as they are measured with: its projectors, and its cameras with smaller photographs, of
/// which they are told what part is looked at (CaptureRequest::part). The devices stay the rig's, which
/// outlives the result. One reduction a camera; none at all: as they are. A photograph of another size than
/// before is Error{input}, which names both. Throws: Error{input} if there are more or fewer cameras, or one
/// delivers another size.
rig::Rig reduced(rig::Rig& rig, const std::vector<Reduction>& reductions);

/// The same cameras, every `stride`-th pixel both ways: samples as they were taken, for what needs no more of
/// them. The devices stay the rig's.
rig::Rig sparse(rig::Rig& rig, std::size_t mostPixels);
/// The same of a picture.
image::Image everyNth(const image::Image& picture, int stride);
/// The stride that this leaves no more than `mostPixels` of.
int strideFor(Size camera, std::size_t mostPixels);

/// The pixels that are left of all cameras, one reduction each.
Rasters reducedRasters(const std::vector<Reduction>& reductions);

}  // namespace relucent::reduction
