// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include "content/playlist.h"
#include "relucent/base/message.h"

namespace relucent::gui {

/// What the output plays, kept in the calibration's folder. Until somebody edits it, it is the picture that
/// Preview was left with.
class OutputPlaylist : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// The list of another calibration. `picture`: of Preview. A list that cannot be read is told by
  /// unreadable() and begun again; the file stays until the list is edited.
  void open(const QString& folder, const QString& picture);
  /// Preview was left with another picture: it is played, first if it was not in the list.
  void prefer(const QString& picture);

  const PlaylistSettings& settings() const { return settings_; }
  /// Sentences of what stands against playing; empty: nothing.
  std::vector<Message> problems() const { return gui::problems(settings_); }
  bool isEmpty() const { return settings_.items.isEmpty(); }
  /// Where it is kept.
  QString file() const { return folder_ + "/show.playlist"; }

  /// Each gives the list as it would be; nothing changes before set().
  PlaylistSettings withAdded(const QStringList& files) const;
  PlaylistSettings without(qsizetype index) const;
  /// `by`: -1 up, 1 down. The same if there is no such place.
  PlaylistSettings withMoved(qsizetype index, qsizetype by) const;

  /// Replaces and keeps it. Throws: Error{disk}; the list is changed all the same.
  void set(const PlaylistSettings& settings);
  /// Writes it with all that it needs: the product's own picture lies within the program.
  /// Throws: Error{disk}.
  void save() const;

  /// The name of an item's file, or what else it is, for people.
  static QString nameOf(const QString& path);
  /// The program's own picture, or a copy of it.
  static bool isDemonstration(const QString& path);
  /// A picture that stands, which can be photographed and compared.
  static bool isStill(const PlaylistItem& item);
  /// It stands for its own seconds, as pictures and what is live do; a film plays to its end.
  static bool standsForSeconds(const PlaylistItem& item);

 Q_SIGNALS:
  void changed();
  void unreadable(const QString& sentence);

 private:
  QString folder_;
  PlaylistSettings settings_;
  bool edited_ = false;
};

}  // namespace relucent::gui
