// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "relucent/transport/block_sparse.h"

namespace relucent::acquisition {

/// A value with its variance, for all nine channel pairs.
struct Estimate {
  transport::ColourBlock value = transport::ColourBlock::Zero();
  transport::ColourBlock variance = transport::ColourBlock::Zero();
};

/// Makes measured children agree with their measured parent: the least squares solution of
///   sum of children = parent,
/// each side trusted by its variance. Without it the noise of a row's sum grows with its leaves, and an
/// error that all children share, such as that of e, adds up.
void reconcile(const Estimate& parent, std::span<Estimate> children);

}  // namespace relucent::acquisition
