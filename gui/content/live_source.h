// SPDX-License-Identifier: MIT
#pragma once

#include "content/content_source.h"

namespace relucent::gui {

/// The live picture of something. It has no end, and stands as long as content time does.
class LiveSource : public ContentSource {
 public:
  ContentPicture at(ContentTime time) final {
    if (!asked_ || *asked_ != time) picture_ = newest();
    asked_ = time;
    return picture_;
  }
  std::optional<ContentTime> length() const final { return std::nullopt; }

 protected:
  /// What there is to see now. The same number as long as it has not changed.
  virtual ContentPicture newest() = 0;

 private:
  std::optional<ContentTime> asked_;
  ContentPicture picture_;
};

}  // namespace relucent::gui
