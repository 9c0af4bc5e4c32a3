// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/acquisition/measured_transport.h"
#include "relucent/acquisition/settings.h"
#include "relucent/acquisition/tree_context.h"

namespace relucent::acquisition {

/// Measures T from dense patterns of random colours, level after level from some 48 blocks to single pixels:
///  1. as many patterns as give nearly every camera pixel two equations for each of its leaves of that level,
///     whatever they show, lit in all projectors at once; exposures as exposureCycle() says;
///  2. every camera pixel's row is solved and what the fit says about it learnt, then solved again;
///  3. leaves that matter are divided for the next level, those that do not are joined;
///  4. at the finest level eight patterns more at a time, which are predicted before they are used, until the
///     prediction is as fine as asked for beyond its noise, gets no better, or patterns run out.
/// `references`: whose usable camera pixels are measured; those of the context, or some of them.
/// `rootsOnly`: no patterns, T is what the floods say. Stop and keep, or an interruption: T is what the
/// levels before say. Source: core/multiplexing/README.md.  Throws: as Watch::check().
[[nodiscard]] std::optional<sentinels::Interruption> measureMultiplexed(
    MeasuredTransport& measured, const TreeContext& context, const photography::References& references,
    const photography::Photographer& photographer, const AcquisitionSettings& settings, bool rootsOnly,
    Progress& progress);

}  // namespace relucent::acquisition
