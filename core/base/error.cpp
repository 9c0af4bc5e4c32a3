// SPDX-License-Identifier: MIT
#include "relucent/base/error.h"

namespace relucent {

std::string_view toString(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::input:
      return "input";
    case ErrorKind::format:
      return "format";
    case ErrorKind::disk:
      return "disk";
    case ErrorKind::memory:
      return "memory";
    case ErrorKind::device:
      return "device";
    case ErrorKind::numerics:
      return "numerics";
  }
  return "unknown";
}

Error::Error(ErrorKind kind, Message what, Message advice, std::string context)
    : kind_(kind), what_(std::move(what)), advice_(std::move(advice)), context_(std::move(context)) {
  line_ = english(sentence()) + ".";
}

Message Error::sentence() const {
  const Message whole =
      advice_.empty() ? what_ : RELUCENT_MESSAGE("sentence.with-advice", "{}; {}").with(what_, advice_);
  return context_.empty() ? whole : RELUCENT_MESSAGE("sentence.of-place", "{}: {}").with(context_, whole);
}

Error Error::within(std::string_view context) const {
  std::string joined(context);
  if (!context_.empty()) joined += ": " + context_;
  return Error(kind_, what_, advice_, joined);
}

}  // namespace relucent
