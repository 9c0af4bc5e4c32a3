// SPDX-License-Identifier: MIT
#include <QDir>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "content/content_address.h"
#include "content/playlist.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

/// Lists without sets are written as the first version, which older programs read.
constexpr int version = 2, versionWithoutSets = 1;

bool isFile(const QString& path) {
  return addressOf(path).kind == ContentAddress::Kind::file;
}

[[noreturn]] void refuse(const QString& file, const Message& what) {
  throw Error(ErrorKind::format, what,
              RELUCENT_ENGLISH_MESSAGE("content.open-with-its-program",
                                       "open it with the program that wrote it, or make a new playlist"),
              file.toStdString());
}

}  // namespace

std::vector<Message> problems(const PlaylistSettings& settings) {
  std::vector<Message> found;
  if (settings.items.isEmpty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("content.playlist-empty", "the playlist is empty"));
  if (!(settings.fadeSeconds >= 0.0 && settings.fadeSeconds <= 60.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("content.cross-fade-too-long", "a cross-fade takes 0 to 60 seconds"));
  for (const PlaylistItem& item : settings.items) {
    if (item.path.isEmpty())
      found.push_back(
          RELUCENT_ENGLISH_MESSAGE("content.item-without-file", "an item of the playlist names no file"));
    if (!(item.seconds > 0.0 && item.seconds <= longestPicture))
      found.push_back(
          RELUCENT_ENGLISH_MESSAGE("content.picture-stands-too-long",
                                   "{}: a picture is shown for more than 0 seconds and at most a day")
              .with(shownPath(item.path).toStdString()));
    if (!(item.picturesPerSecond > 0.0 && item.picturesPerSecond <= 240.0))
      found.push_back(RELUCENT_ENGLISH_MESSAGE("content.film-too-fast",
                                               "{}: a film has more than 0 and at most 240 pictures a second")
                          .with(shownPath(item.path).toStdString()));
  }
  for (const Message& problem : problems(settings.sets)) found.push_back(problem);
  return found;
}

PlaylistSettings readPlaylist(const QString& file) {
  std::string text = readFile(file.toStdString());
  QJsonParseError error;
  QJsonDocument document = QJsonDocument::fromJson(QByteArray::fromStdString(text), &error);
  if (!document.isObject() || !document.object()["items"].isArray())
    refuse(file,
           error.error == QJsonParseError::NoError
               ? RELUCENT_ENGLISH_MESSAGE("content.not-a-playlist", "this is not a playlist")
               : RELUCENT_ENGLISH_MESSAGE("content.not-a-playlist-because", "this is not a playlist ({})")
                     .with(error.errorString().toStdString()));
  QJsonObject object = document.object();
  if (int written = object["version"].toInt(version); written > version)
    refuse(file, RELUCENT_ENGLISH_MESSAGE("content.playlist-of-newer-version",
                                          "a newer version of the program wrote this playlist (format {})")
                     .with(as::label(written)));

  QDir folder = QFileInfo(file).absoluteDir();
  PlaylistSettings settings;
  settings.loop = object["loop"].toBool(settings.loop);
  settings.fadeSeconds = object["fade_seconds"].toDouble(settings.fadeSeconds);
  for (const auto& value : object["items"].toArray()) {
    QJsonObject entry = value.toObject();
    PlaylistItem item;
    if (QString path = entry["path"].toString(); !path.isEmpty())
      item.path = isFile(path) ? QDir::cleanPath(folder.absoluteFilePath(path)) : path;
    item.seconds = entry["seconds"].toDouble(item.seconds);
    item.picturesPerSecond = entry["pictures_per_second"].toDouble(item.picturesPerSecond);
    item.set = entry["set"].toString();
    settings.items.append(item);
  }
  for (const auto& value : object["sets"].toArray()) {
    const QJsonObject entry = value.toObject();
    settings.sets.append(
        {QTime::fromString(entry["from"].toString(), setTimeFormat), entry["set"].toString()});
  }
  if (std::vector<Message> wrong = problems(settings); !wrong.empty()) refuse(file, wrong.front());
  return settings;
}

void savePlaylist(const QString& file, const PlaylistSettings& settings) {
  QDir folder = QFileInfo(file).absoluteDir();
  QJsonArray items, sets;
  bool namesSets = !settings.sets.isEmpty();
  for (const PlaylistItem& item : settings.items) {
    QJsonObject entry{{"path", isFile(item.path) ? folder.relativeFilePath(item.path) : item.path},
                      {"seconds", item.seconds},
                      {"pictures_per_second", item.picturesPerSecond}};
    if (!item.set.isEmpty()) entry["set"] = item.set;
    namesSets = namesSets || !item.set.isEmpty();
    items.append(entry);
  }
  for (const SetTime& time : settings.sets)
    sets.append(QJsonObject{{"from", time.from.toString(setTimeFormat)}, {"set", time.set}});
  QJsonObject object{{"version", namesSets ? version : versionWithoutSets},
                     {"loop", settings.loop},
                     {"fade_seconds", settings.fadeSeconds},
                     {"items", items}};
  if (!sets.isEmpty()) object["sets"] = sets;
  writeFileAtomically(file.toStdString(), QJsonDocument(object).toJson().toStdString());
}

}  // namespace relucent::gui
