// SPDX-License-Identifier: MIT
#pragma once

#include <QListWidget>

namespace relucent::gui {

class OutputPage;

/// What plays, in order. Delete removes, Ctrl+Up and Ctrl+Down move; rows are dragged, and files dropped in.
class PlaylistView : public QListWidget {
  Q_OBJECT

 public:
  explicit PlaylistView(OutputPage& page, QWidget* parent = nullptr);
  /// As high as its items, up to a few.
  QSize sizeHint() const override;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void refresh();
  void moveRow(int by);
  OutputPage& page_;
};

/// Paths of the files that are dragged.
QStringList draggedFiles(const QMimeData& data);

/// The list with its buttons, repeat and cross-fade.
QWidget* playlistPart(OutputPage& page);

}  // namespace relucent::gui
