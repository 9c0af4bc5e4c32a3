// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QMenu>
#include <QString>
#include <QStringList>

namespace relucent::gui {

class OutputPage;

/// A screen or window that can be played live.
struct ScreenOffer {
  QString text;
  QString path;               // of a playlist item
  bool isProjectors = false;  // what plays would show itself
};
/// Under X those that there are, by name; under Wayland one of each, which the desktop's dialog asks for when
/// it plays. Without the windows of this program.
///   taken       paths that are in the list already
///   projectors  connectors of the screens that it plays on
QList<ScreenOffer> screenOffers(const QStringList& taken, const QStringList& projectors = {});

/// Adds one of them to the playlist.
QMenu* screenMenu(OutputPage& page, QWidget* parent);

}  // namespace relucent::gui
