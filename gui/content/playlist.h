// SPDX-License-Identifier: MIT
#pragma once

#include <QFuture>
#include <QList>
#include <QMutex>
#include <QString>
#include <QStringList>
#include <memory>
#include <optional>
#include <vector>

#include "content/canvas.h"
#include "content/content_source.h"
#include "content/outcome.h"
#include "content/set_times.h"
#include "relucent/base/message.h"

namespace relucent::gui {

inline constexpr double longestPicture = 86400.0;  // that a picture stands, seconds

/// One item of a playlist.
struct PlaylistItem {
  QString path;           // a picture, a film, a folder of numbered pictures, or a chart, see ContentAddress
  double seconds = 10.0;  // duration of a still picture
  double picturesPerSecond = 25.0;  // of a folder
  QString set{};  // of the calibration, as which it and all after it are shown; empty: as before

  bool operator==(const PlaylistItem&) const = default;
};

struct PlaylistSettings {
  QList<PlaylistItem> items;
  double fadeSeconds = 1.0;  // of the cross-fade from one to the next; at most half of the shorter one
  bool loop = true;
  QList<SetTime> sets{};  // as which set of the calibration all is shown when; none: as the one in use

  bool operator==(const PlaylistSettings&) const = default;
};
/// What is wrong with the settings.
std::vector<Message> problems(const PlaylistSettings& settings);

/// A playlist's file, JSON; paths in it are relative to its folder.
/// Throws: Error{disk}; Error{format} if it is invalid, or written by a newer version.
PlaylistSettings readPlaylist(const QString& file);
/// Atomic. Throws: Error{disk}.
void savePlaylist(const QString& file, const PlaylistSettings& settings);

/// Opens an item's source. Throws: as the sources.
std::unique_ptr<ContentSource> openContent(const PlaylistItem& item, const Canvas& canvas,
                                           Attendance attendance = Attendance::attended);

/// Plays items one after the other, with cross-fades, in a loop. The next item is opened on another thread as
/// soon as one begins; if it is not ready in time, or somebody has to choose what it is, the present one
/// stays longer. Unreadable items are reported, skipped, and tried again in the next round; so are streams
/// that give no picture in time.
class Playlist : public ContentSource {
 public:
  /// `first`: the item that it begins with; the first one where there is none of that number.  Throws:
  /// Error{input} for wrong settings.
  Playlist(PlaylistSettings settings, Canvas canvas, Attendance attendance = Attendance::attended,
           qsizetype first = 0);
  ~Playlist() override;

  /// They stay as they are. May be called from any thread.
  const PlaylistSettings& settings() const { return settings_; }
  /// An empty image while no item can be read.
  ContentPicture at(ContentTime time) override;
  std::optional<ContentTime> length() const override { return std::nullopt; }

  /// An item that could not be read when it was its turn.
  struct Skipped {
    qsizetype index = -1;
    Message why;
  };
  struct Status {
    qsizetype playing = -1;         // which item; -1 before the first
    std::vector<Skipped> skipped;   // each item that cannot be read now, the newest last
    std::vector<LiveState> live{};  // what may be lost: of the playing item, and of the next one
  };
  /// Another item, from 0, with the usual fade as soon as it is ready. May be called from any thread.
  /// Contract: it is one of the list's.
  void playItem(qsizetype index);

  /// State after the last frame. May be called from any thread.
  Status status() const;

 private:
  struct Playing {
    qsizetype index = -1;
    std::shared_ptr<ContentSource> source;
    ContentTime begin{0};  // of the next one, once it is ready
  };

  ContentPicture pictureAt(ContentTime time);
  ContentTime lengthOf(const Playing& item) const;
  ContentTime fadeBetween(const Playing& item, const Playing& next) const;
  void begin(ContentTime now);
  void openNext(qsizetype after);
  void open(qsizetype index);
  void openWanted();
  bool nextIsReady(ContentTime now);
  void skip(const Message& sentence);
  void forgive(qsizetype index);
  ContentPicture frameOf(const Playing& item, ContentTime time);

  PlaylistSettings settings_;
  Canvas canvas_;
  Attendance attendance_;
  Playing current_, next_;
  QFuture<Outcome<std::shared_ptr<ContentSource>>> opening_;
  qsizetype openingIndex_ = -1;
  Playing opened_;      // and not ready to be the next one
  bool jumps_ = false;  // the next one need not wait for the present one's end
  bool ended_ = false;
  bool isFresh_ = true;  // it has not begun
  ContentTime last_{0};
  ContentTime tryAgain_{0};  // after nothing could be read
  std::vector<Skipped> skipped_;
  mutable QMutex statusGuard_;
  Status status_;
  std::vector<std::shared_ptr<ContentSource>> live_;  // of status_, guarded too
  std::optional<qsizetype> wanted_;                   // of playItem(), guarded too
};

}  // namespace relucent::gui
