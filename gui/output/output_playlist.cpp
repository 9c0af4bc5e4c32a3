// SPDX-License-Identifier: MIT
#include "output/output_playlist.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include "content/content_address.h"
#include "content/video.h"
#include "output/default_picture.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

constexpr const char* demonstration = "demonstration.png";  // the copy that a calibration keeps

QString picturePath(const QString& picture) {
  return picture.isEmpty() ? defaultPicture() : picture;
}

}  // namespace

void OutputPlaylist::open(const QString& folder, const QString& picture) {
  folder_ = folder;
  settings_ = {};
  settings_.items = {{picturePath(picture)}};
  edited_ = false;
  if (!folder.isEmpty() && QFileInfo::exists(file())) {
    try {
      settings_ = readPlaylist(file());
      edited_ = true;
    } catch (const Error& error) {
      Q_EMIT unreadable(QString::fromUtf8(error.what()));
    }
  }
  Q_EMIT changed();
}

void OutputPlaylist::prefer(const QString& picture) {
  QString path = picturePath(picture);
  auto plays = [&](const PlaylistItem& item) { return item.path == path; };
  if (std::any_of(settings_.items.begin(), settings_.items.end(), plays)) return;
  if (!edited_) settings_.items.clear();
  settings_.items.prepend({path});
  Q_EMIT changed();
}

PlaylistSettings OutputPlaylist::withAdded(const QStringList& files) const {
  PlaylistSettings result = settings_;
  for (const QString& path : files)
    if (!path.isEmpty()) result.items.append({path});
  return result;
}

PlaylistSettings OutputPlaylist::without(qsizetype index) const {
  PlaylistSettings result = settings_;
  if (index >= 0 && index < result.items.size()) result.items.removeAt(index);
  return result;
}

PlaylistSettings OutputPlaylist::withMoved(qsizetype index, qsizetype by) const {
  PlaylistSettings result = settings_;
  qsizetype to = index + by;
  if (index >= 0 && index < result.items.size() && to >= 0 && to < result.items.size())
    result.items.move(index, to);
  return result;
}

void OutputPlaylist::set(const PlaylistSettings& settings) {
  settings_ = settings;
  edited_ = true;
  Q_EMIT changed();
  if (!isEmpty()) save();
}

void OutputPlaylist::save() const {
  PlaylistSettings kept = settings_;
  for (PlaylistItem& item : kept.items) {
    if (item.path != defaultPicture()) continue;
    const QString copy = QDir(folder_).filePath(demonstration);
    if (!QFileInfo::exists(copy)) {
      QFile own(defaultPicture());
      require(own.open(QIODevice::ReadOnly), "the program's own picture is missing");
      writeFileAtomically(copy.toStdString(), own.readAll().toStdString());
    }
    item.path = copy;
  }
  savePlaylist(file(), kept);
}

bool OutputPlaylist::isDemonstration(const QString& path) {
  const QFileInfo file(path);
  return path == defaultPicture() ||
         ((file.fileName() == demonstration || file.fileName() == demonstrationCopy) &&
          file.size() == QFileInfo(defaultPicture()).size());
}

QString OutputPlaylist::nameOf(const QString& path) {
  if (isDemonstration(path)) return tr("Demonstration picture");
  if (addressOf(path).kind != ContentAddress::Kind::file) return shownPath(path);
  return QFileInfo(path).fileName();
}

bool OutputPlaylist::isStill(const PlaylistItem& item) {
  return addressOf(item.path).kind == ContentAddress::Kind::file && !isVideo(item.path) &&
         !QFileInfo(item.path).isDir();
}

bool OutputPlaylist::standsForSeconds(const PlaylistItem& item) {
  return isStill(item) || addressOf(item.path).kind != ContentAddress::Kind::file;
}

}  // namespace relucent::gui
