// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "relucent/image/image.h"

namespace relucent::test {

/// What shines from one output of an X server, read over a connection of its own: any thread may look. An
/// output that is switched off shines not at all.
class ScreenLight {
 public:
  /// `connector`: "DUMMY1".
  explicit ScreenLight(std::string connector);
  ~ScreenLight();

  /// Drive values in the middle `size` of the output; black where there is nothing.
  image::Image look(Size size) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent::test
