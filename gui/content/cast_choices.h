// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QStringList>

namespace relucent::gui {

// What was chosen in the desktop's dialogs, as the desktop's own tokens, by the path of the content for which
// it was asked: screen:1. In the user's settings, so that a show finds what was chosen in the wizard. From
// any thread and process.

/// Empty: nothing yet.
QString castChoice(const QString& path);
/// In place of that of before, which is spent; empty: this desktop remembers nothing.
void keepCastChoice(const QString& path, const QString& token);

/// A path for which nothing was chosen, so that it is asked: kind, and the first free number. `kind`:
/// "screen:" or "window:"; `taken`: paths that are in use.
QString unusedCast(const QString& kind, const QStringList& taken);

}  // namespace relucent::gui
