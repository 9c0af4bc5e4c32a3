// SPDX-License-Identifier: MIT
#include "content/stream_address.h"

#include <QRegularExpression>
#include <QStringList>
#include <optional>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

const QString holdMark = "#hold=";

/// An address taken apart as FFmpeg does it: the user is all up to the last "@" of what stands before the
/// path.
struct Parts {
  QString scheme, host, port, path;
  bool hasUser = false, hasQuery = false;
};

std::optional<Parts> partsOf(const QString& url) {
  static const QRegularExpression form(R"(^([A-Za-z][A-Za-z0-9+.-]*)://([^/?#]*)([^?#]*)(\?[^#]*)?(#.*)?$)",
                                       QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression place(R"(^(?:\[([0-9A-Fa-f:.%]+)\]|([^\[\]:@\s]*))(?::([0-9]{1,5}))?$)");
  const QRegularExpressionMatch whole = form.match(url);
  if (!whole.hasMatch()) return std::nullopt;
  const QString authority = whole.captured(2);
  const qsizetype user = authority.lastIndexOf('@');
  const QRegularExpressionMatch where = place.match(authority.mid(user + 1));
  if (!where.hasMatch()) return std::nullopt;
  Parts parts{whole.captured(1).toLower(), where.captured(1) + where.captured(2), where.captured(3),
              whole.captured(3)};
  parts.hasUser = user > 0;
  parts.hasQuery = !whole.captured(4).isEmpty();
  if (!parts.port.isEmpty() && (parts.port.toInt() < 1 || parts.port.toInt() > 65535)) return std::nullopt;
  return parts;
}

/// Without the choice behind it.
QString urlIn(const QString& which) {
  const qsizetype mark = which.lastIndexOf(holdMark);
  return mark < 0 ? which : which.left(mark);
}

const QStringList& schemes() {
  static const QStringList known{"rtsp", "rtsps", "srt", "rtp", "udp", "http", "https", "rtmp", "rtmps"};
  return known;
}

/// Of those that nobody has to be called for.
bool mayListen(const QString& scheme) {
  return scheme == "srt" || scheme == "rtp" || scheme == "udp";
}

}  // namespace

StreamAddress streamAddressFrom(const QString& which) {
  StreamAddress address;
  address.url = urlIn(which);
  if (const QString hold = which.mid(address.url.size()); !hold.isEmpty() && hold != "#hold=last") {
    if (hold != "#hold=black")
      throw Error(ErrorKind::input,
                  RELUCENT_MESSAGE("stream.unknown-hold", "the stream's address ends in an unknown choice"),
                  RELUCENT_MESSAGE("stream.write-hold", "write #hold=last or #hold=black"),
                  shownStream(which).toStdString());
    address.hold = StreamAddress::Hold::black;
  }
  const qsizetype colon = address.url.indexOf("://");
  if (colon < 0 || !schemes().contains(address.url.left(colon).toLower()))
    throw Error(ErrorKind::input, RELUCENT_MESSAGE("stream.unknown-scheme", "this is no address of a stream"),
                RELUCENT_MESSAGE("stream.write-scheme", "let it begin with one of {}")
                    .with((schemes().join("://, ") + "://").toStdString()),
                shownStream(which).toStdString());
  const std::optional<Parts> parts = partsOf(address.url);
  const bool isMissing = parts && (mayListen(parts->scheme) ? parts->port.isEmpty() : parts->host.isEmpty());
  if (!parts || isMissing)
    throw Error(ErrorKind::input,
                RELUCENT_MESSAGE("stream.address-incomplete",
                                 "in a stream's address the host or its port is missing or wrong"),
                RELUCENT_MESSAGE("stream.write-address",
                                 "write it like {}, and in user names and passwords % and two digits for "
                                 "signs like @, : and /")
                    .with("rtsp://user:password@192.168.1.70:554/live"),
                shownStream(which).toStdString());
  address.host = parts->host;
  return address;
}

QString shownStream(const QString& which) {
  const QString url = urlIn(which), more = QString::fromUtf8("\u2026");
  const std::optional<Parts> parts = partsOf(url);
  if (!parts) {
    const qsizetype colon = url.indexOf("://");
    return (colon < 0 || !schemes().contains(url.left(colon).toLower()) ? QString() : url.left(colon + 3)) +
           more;
  }
  const bool isNumber = parts->host.contains(':');
  QString shown = parts->scheme + "://" + (isNumber ? '[' + parts->host + ']' : parts->host);
  if (!parts->port.isEmpty()) shown += ':' + parts->port;
  // A password with a "/" in it ends up here.
  shown += parts->path.contains('@') ? '/' + more : parts->path;
  return parts->hasQuery ? shown + '?' + more : shown;
}

}  // namespace relucent::gui
