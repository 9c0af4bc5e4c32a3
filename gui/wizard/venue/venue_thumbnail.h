// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QString>

#include "wizard/session/session.h"

namespace relucent::gui {

/// Keeps a small picture of the surface in full light in the venue's folder, once it is measured: the list of
/// venues shows it. Where it cannot be written, there is none.
void keepThumbnail(const Session& session);

/// The small picture of a venue; null where there is none.
QImage thumbnailOf(const QString& folder);

}  // namespace relucent::gui
