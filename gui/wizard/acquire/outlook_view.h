// SPDX-License-Identifier: MIT
#pragma once

#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {

/// Of the pictures beside it, too: what stands in them before there are any is read whole.
constexpr int leastPictureHeight = 155;

/// "31 dB, good".
QString qualityText(double decibels);
/// What dB means, a sentence or two.
QString qualityMeaning();

/// A picture as it would be compensated if measuring stopped now; only while it measures.
QWidget* outlookCard(AcquirePage& model);
/// What is expected now, and once all is measured.
QWidget* outlookPart(AcquirePage& model);

}  // namespace relucent::gui
