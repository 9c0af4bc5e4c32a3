// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <string>

#include "relucent/base/error.h"

namespace relucent {

/// The sentence of the Error that `action` throws; empty if it throws none, and plain words if it is of
/// another kind.
template <typename Action>
std::string sentenceOf(const Action& action, ErrorKind kind) {
  try {
    action();
  } catch (const Error& error) {
    if (error.kind() == kind) return error.what();
    return "wrong kind, " + std::string(toString(error.kind())) + ": " + error.what();
  }
  return {};
}

/// Whether a sentence holds a part; says both if not.
inline bool mentions(const std::string& sentence, const std::string& part) {
  if (sentence.find(part) != std::string::npos) return true;
  qWarning("'%s' is not in '%s'", part.c_str(), sentence.c_str());
  return false;
}

}  // namespace relucent
