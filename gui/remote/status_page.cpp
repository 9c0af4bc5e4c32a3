// SPDX-License-Identifier: MIT
#include "remote/status_page.h"

#include <QHostAddress>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLocale>
#include <algorithm>
#include <array>
#include <utility>

namespace relucent::gui {
namespace {

struct FactName {
  const char* key;
  const char* text;
};
/// What the facts of health.json are called. One that is not here is called by its key.
constexpr std::array factNames{
    FactName{"alarm", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Alarm")},
    FactName{"state", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "State")},
    FactName{"updated", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Updated")},
    FactName{"renderer", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Computed on")},
    FactName{"black", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Black")},
    FactName{"paused", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Frozen")},
    FactName{"compensated", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Corrected")},
    FactName{"brightness", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Brightness")},
    FactName{"chart", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Test chart")},
    FactName{"frames", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Frames")},
    FactName{"late", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Late frames")},
    FactName{"frames_per_second", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Frames per second")},
    FactName{"frame_milliseconds", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Time per frame (ms)")},
    FactName{"viewer_milliseconds",
             QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Delay behind the viewer (ms)")},
    FactName{"clipped", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Clipped share")},
    FactName{"steps", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Steps")},
    FactName{"perfected", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Perfected")},
    FactName{"set", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Set")},
    FactName{"item", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Item")},
    FactName{"skipped", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Items skipped")},
    FactName{"failures", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Failures")},
    FactName{"peak_memory_bytes", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Most memory used (bytes)")},
    FactName{"night", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Last night")},
    FactName{"when", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "When")},
    FactName{"outcome", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Outcome")},
    FactName{"pictures_perfected", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Pictures perfected")},
    FactName{"delta_e", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Colour error (ΔE)")},
    FactName{"delta_e_predicted",
             QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Predicted colour error (ΔE)")},
    FactName{"untold", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Nobody was told")},
    FactName{"next", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Next night")},
    FactName{"displays", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Displays")},
    FactName{"connector", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Connector")},
    FactName{"shining", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Shining")},
    FactName{"drawn_by", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Drawn by")},
    FactName{"live_milliseconds",
             QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Delay of the live picture (ms)")},
    FactName{"streams", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Streams")},
    FactName{"losses", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Losses")},
    FactName{"size", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Pixels")},
    FactName{"sender_milliseconds",
             QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Time from the sender, by its clock (ms)")},
    FactName{"projectors", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Projectors")},
    FactName{"projector", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Projector")},
    FactName{"address", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Address")},
    FactName{"answers", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Answers")},
    FactName{"problem", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Problem")},
    FactName{"name", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Name")},
    FactName{"model", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Model")},
    FactName{"power", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Power")},
    FactName{"shutter", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Shutter")},
    FactName{"lamp_hours", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Lamp hours")},
    FactName{"filter_hours", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Filter hours")},
    FactName{"input", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Input")},
    FactName{"signal", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Signal")},
    FactName{"own_size", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Own pixels")},
    FactName{"watch", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Watched by camera")},
    FactName{"photographs", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Photographs")},
    FactName{"used", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Photographs used")},
    FactName{"informed", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Share that can be told")},
    FactName{"milliseconds", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Time per photograph (ms)")},
    FactName{"findings", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "What has changed")},
    FactName{"kind", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Kind")},
    FactName{"amount", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "How much")},
    FactName{"what", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "What happened")},
    FactName{"advice", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "What to do")},
    FactName{"remarks", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "Remarks")},
};

/// What health.json says that something is; of a show, its streams and its watch.
constexpr std::array stateNames{
    FactName{"starting", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "starting")},
    FactName{"playing", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "playing")},
    FactName{"resting", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "resting until its hours")},
    FactName{"photographing", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "photographing")},
    FactName{"failed", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "failed")},
    FactName{"stopped", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "stopped")},
    FactName{"connecting", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "connecting")},
    FactName{"asking", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "asking whether it may")},
    FactName{"lost", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "lost")},
    FactName{"opening", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "opening")},
    FactName{"watching", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "watching")},
    FactName{"paused", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "paused")},
    FactName{"no camera", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "no camera")},
    FactName{"no calibration", QT_TRANSLATE_NOOP("relucent::gui::StatusPage", "no calibration")},
};

QString nameOfState(const QString& state) {
  for (const FactName& name : stateNames)
    if (state == name.key) return StatusPage::tr(name.text);
  return state;
}

/// In a word: who plays black, or stands still, says so first.
QString summaryOf(const QJsonObject& health) {
  const QString state = health.value("state").toString();
  if (state != "playing") return nameOfState(state);
  const QJsonArray displays = health.value("displays").toArray();
  if (!displays.isEmpty() && std::ranges::none_of(displays, [](const QJsonValue& display) {
        return display.toObject().value("shining").toBool(true);
      }))
    return StatusPage::tr("playing, but no display shows it");
  if (health.value("black").toBool()) return StatusPage::tr("black, until somebody ends it");
  if (health.contains("chart")) return StatusPage::tr("test chart");
  if (health.value("paused").toBool()) return StatusPage::tr("frozen, until somebody ends it");
  return nameOfState(state);
}

constexpr const char* pageStyle =
    "body{font-family:sans-serif;margin:2em;max-width:50em;color:#222;background:#fff}"
    "table{border-collapse:collapse;width:100%}"
    "th,td{text-align:start;vertical-align:top;padding:.3em .6em;border-bottom:1px solid #ccc}"
    "th{font-weight:normal;color:#555;width:14em}"
    ".alarm{padding:.6em;border:2px solid #a32b20;color:#a32b20}";

QString nameOfFact(const QString& key) {
  for (const FactName& fact : factNames)
    if (key == fact.key) return StatusPage::tr(fact.text);
  return key;
}

QString table(const QJsonObject& facts);

QString shown(const QJsonValue& value) {
  if (value.isObject()) return table(value.toObject());
  if (value.isArray()) {
    QStringList parts;
    for (const auto& part : value.toArray()) parts.append(shown(part));
    const bool isBlocks = !value.toArray().isEmpty() && value.toArray().first().isObject();
    return parts.join(isBlocks ? QString() : QString(", "));
  }
  if (value.isBool()) return value.toBool() ? StatusPage::tr("yes") : StatusPage::tr("no");
  if (value.isDouble()) {
    const double number = value.toDouble();
    const auto whole = static_cast<qint64>(number);
    return static_cast<double>(whole) == number ? QLocale().toString(whole)
                                                : QLocale().toString(number, 'g', 4);
  }
  if (value.isNull()) return QString::fromUtf8("\u2013");
  return value.toString().toHtmlEscaped();
}

QString table(const QJsonObject& facts) {
  QStringList keys;
  for (const FactName& fact : factNames)
    if (facts.contains(fact.key)) keys.append(fact.key);
  for (const QString& key : facts.keys())
    if (!keys.contains(key)) keys.append(key);
  QString rows;
  for (const QString& key : keys)
    rows += "<tr><th scope=\"row\">" + nameOfFact(key).toHtmlEscaped() + "</th><td>" +
            (key == "state" ? nameOfState(facts.value(key).toString()).toHtmlEscaped()
                            : shown(facts.value(key))) +
            "</td></tr>";
  return "<table>" + rows + "</table>";
}

/// Before everything else: somebody has to look.
QString alarmOf(const QJsonObject& health) {
  if (!health.contains("alarm")) return {};
  return "<p role=\"alert\" class=\"alarm\"><strong>" +
         StatusPage::tr("Somebody has to look").toHtmlEscaped() + "</strong> " +
         health.value("alarm").toString().toHtmlEscaped() + "</p>";
}

HttpAnswer refused(int status, const char* why) {
  return {status, "text/plain; charset=utf-8", QByteArray(why) + "\n"};
}

/// The name in a Host line, without its port.
QString hostIn(const QByteArray& head) {
  for (const QByteArray& line : head.split('\n')) {
    if (!line.toLower().startsWith("host:")) continue;
    QString host = QString::fromLatin1(line.mid(5)).trimmed();
    if (host.startsWith('[')) return host.mid(1, host.indexOf(']') - 1);
    if (const qsizetype colon = host.indexOf(':'); colon >= 0) host.truncate(colon);
    return host;
  }
  return {};
}

bool mayBeCalled(const QString& host, const QString& computer) {
  const QString name = host.toLower(), own = computer.toLower();
  return name.isEmpty() || name == "localhost" || !QHostAddress(name).isNull() || name == own ||
         name == own + ".local";
}

}  // namespace

QByteArray StatusPage::html(const QJsonObject& health) {
  const QString language = QLocale().bcp47Name().toHtmlEscaped();
  const QString direction = QLocale().textDirection() == Qt::RightToLeft ? "rtl" : "ltr";
  const QString title = tr("Relucent: %1").arg(summaryOf(health)).toHtmlEscaped();
  return ("<!DOCTYPE html>\n<html lang=\"" + language + "\" dir=\"" + direction +
          "\"><head><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"10\">"
          "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
          title + "</title><style>" + pageStyle + "</style></head><body><h1>" + title + "</h1>" +
          alarmOf(health) + table(health) + "</body></html>\n")
      .toUtf8();
}

HttpAnswer statusAnswer(const QByteArray& head, const QString& computer, const QJsonObject& health) {
  const QList<QByteArray> words = head.split('\n').first().trimmed().split(' ');
  if (words.size() != 3 || !words[2].startsWith("HTTP/1.")) return refused(400, "this is no request of HTTP");
  if (words[0] != "GET" && words[0] != "HEAD") return refused(405, "this page can only be read");
  if (!mayBeCalled(hostIn(head), computer))
    return refused(403, "call this computer by its number or its own name");
  const QByteArray path = words[1].split('?').first();
  if (path == "/health.json") return {200, "application/json", QJsonDocument(health).toJson()};
  if (path == "/") return {200, "text/html; charset=utf-8", StatusPage::html(health)};
  return refused(404, "there are / and /health.json");
}

QByteArray httpBytes(const HttpAnswer& answer, bool withBody) {
  const char* phrase = answer.status == 200 ? "OK" : "Refused";
  return "HTTP/1.0 " + QByteArray::number(answer.status) + " " + phrase + "\r\nContent-Type: " + answer.type +
         "\r\nContent-Length: " + QByteArray::number(answer.body.size()) +
         "\r\nConnection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
         "Referrer-Policy: no-referrer\r\n"
         "Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'; frame-ancestors "
         "'none'\r\n" +
         (answer.status == 405 ? QByteArray("Allow: GET, HEAD\r\n") : QByteArray()) + "\r\n" +
         (withBody ? answer.body : QByteArray());
}

}  // namespace relucent::gui
