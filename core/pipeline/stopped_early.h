// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/base/message.h"
#include "relucent/transport/expected_quality.h"

namespace relucent::pipeline {

/// Says of a measurement that was stopped and kept what is reached and what more photographs bring.
/// `blocks`: side of the finest, projector pixels. `expected`: none where nobody worked it out.
Message stoppedEarly(int blocks, const std::optional<transport::ExpectedQuality>& expected);

/// Says of a measurement by which pictures will be no better than uncorrected (transport::isPoor()) what to
/// do; none: it is not one.
std::optional<Message> poorQuality(const std::optional<transport::ExpectedQuality>& expected);

}  // namespace relucent::pipeline
