// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/base/progress.h"
#include "relucent/image/image.h"
#include "relucent/transport/draft.h"

namespace relucent::pipeline {

/// What may be expected of a venue that is being measured.
struct Outlook {
  int blocks = 1;        // side of the finest blocks shown so far, projector pixels
  double now = 0.0;      // dB, see transport::ExpectedQuality
  double whole = 0.0;    // dB
  image::Image picture;  // compensated, as the first camera is expected to see it; encoded to be looked at
};

/// The standard images, compensated with the draft by *refined* and windows of the usual ridge:
///   now    the PSNR by T itself. Blocks cannot show detail, and what a projector pixel's neighbours and the
///          walls add cannot be taken away: both are in T.
///   whole  the same by expectedTransport().
///   PSNR = -10 log10(mean |T p - r|^2 / white^2 + error^2 mean |T p|^2 / white^2),
/// the error that of patterns that were predicted before they were used; of `whole`, the one asked for. What
/// blocks hide of a picture within the pixels of a coarse draft is added: its variance in them, less that in
/// the pixels of the venue's camera. None: nothing is lit well enough to hold a picture.
/// Source: core/acquisition/README.md, which also says how near it comes.  Throws: Cancelled.
std::optional<Outlook> outlookOf(const transport::Draft& draft, Progress& progress);

}  // namespace relucent::pipeline
