// SPDX-License-Identifier: MIT
#include "support/driven_program.h"

#include <QColor>
#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>

namespace relucent::test {
namespace {

constexpr int longestAnswer = 20'000;  // milliseconds: a program that does not answer for so long hangs
constexpr double mostOfOneColour = 0.9;

SeenPart partFrom(const QJsonObject& json) {
  SeenPart part;
  part.name = json["name"].toString();
  part.text = json["text"].toString();
  part.role = json["role"].toString();
  part.spoken = json["spoken"].toString();
  part.more = json["more"].toString();
  part.isButton = json["kind"].toString() == "button";
  part.isEnabled = json["enabled"].toBool(true);
  part.isChecked = json["checked"].toBool();
  part.isDefault = json["default"].toBool();
  return part;
}

}  // namespace

Seen::Seen(const QJsonObject& answer) {
  for (const QJsonValue& value : answer["windows"].toArray()) {
    const QJsonObject json = value.toObject();
    SeenWindow window{json["title"].toString(), json["name"].toString(), json["blocks"].toBool(), {}};
    for (const QJsonValue& part : json["parts"].toArray()) window.parts.push_back(partFrom(part.toObject()));
    windows_.push_back(std::move(window));
  }
}

bool Seen::says(const QString& words) const {
  for (const SeenWindow& window : windows_) {
    for (const SeenPart& part : window.parts)
      if (part.text.contains(words)) return true;
    if (window.blocks) break;
  }
  return false;
}

SeenPart Seen::part(const QString& name) const {
  for (const SeenWindow& window : windows_)
    for (const SeenPart& part : window.parts)
      if (part.name == name) return part;
  return {};
}

SeenPart Seen::button(const QString& text) const {
  for (const SeenWindow& window : windows_)
    for (const SeenPart& part : window.parts)
      if (part.isButton && part.text == text) return part;
  return {};
}

QString Seen::dialog() const {
  return !windows_.empty() && windows_.front().blocks ? windows_.front().title : QString();
}

QString Seen::text() const {
  QStringList lines;
  for (const SeenWindow& window : windows_) {
    lines << QString("[%1]").arg(window.title);
    for (const SeenPart& part : window.parts) {
      QString line = part.spoken.isEmpty() ? part.text : part.spoken;
      if (!part.more.isEmpty()) line += ": " + part.more;
      if (part.isButton) line = '(' + line + (part.isEnabled ? ")" : ", disabled)");
      if (!line.isEmpty()) lines << "  " + line;
    }
  }
  return lines.isEmpty() ? QString("(nothing: the program does not answer)") : lines.join('\n');
}

DrivenProgram::DrivenProgram(const QString& plugins, const QProcessEnvironment& environment) {
  QProcessEnvironment with = environment;
  with.insert("QT_QPA_GENERIC_PLUGINS", "hand");
  with.insert("QT_PLUGIN_PATH", plugins);
  process_.setProcessEnvironment(with);
  process_.setProcessChannelMode(QProcess::ForwardedErrorChannel);
}

DrivenProgram::~DrivenProgram() {
  kill();
}

void DrivenProgram::watch(const QString& errors) {
  QProcessEnvironment with = process_.processEnvironment();
  with.insert("QT_QPA_GENERIC_PLUGINS", "hand:watch");
  process_.setProcessEnvironment(with);
  process_.setProcessChannelMode(QProcess::SeparateChannels);
  process_.setStandardErrorFile(errors, QIODevice::Append);
}

void DrivenProgram::start(const QString& program, const QStringList& arguments) {
  process_.start(program, arguments);
  process_.waitForStarted();
}

void DrivenProgram::kill() {
  if (!isRunning()) return;
  process_.kill();
  process_.waitForFinished();
}

QJsonObject DrivenProgram::ask(const QJsonObject& wish) {
  if (!isRunning()) return {{"failed", "the program does not run"}};
  process_.write(QJsonDocument(wish).toJson(QJsonDocument::Compact) + '\n');
  QElapsedTimer since;
  since.start();
  while (!process_.canReadLine()) {
    const qint64 left = longestAnswer - since.elapsed();
    if (left <= 0 || !process_.waitForReadyRead(static_cast<int>(left)))
      return {{"failed", isRunning() ? "the program does not answer" : "the program has ended"}};
  }
  return QJsonDocument::fromJson(process_.readLine()).object();
}

Seen DrivenProgram::look() {
  return Seen(ask({{"do", "look"}}));
}

QString DrivenProgram::click(const QString& name) {
  return done({{"do", "click"}, {"name", name}});
}

QString DrivenProgram::clickText(const QString& text) {
  return done({{"do", "click"}, {"text", text}});
}

QString DrivenProgram::type(const QString& name, const QString& text) {
  return done({{"do", "type"}, {"name", name}, {"typed", text}});
}

QString DrivenProgram::press(const QString& keys) {
  return done({{"do", "keys"}, {"keys", keys}});
}

int DrivenProgram::pixels(const QString& name, const QColor& colour) {
  return ask({{"do", "colour"}, {"name", name}, {"colour", colour.name()}})["pixels"].toInt();
}

bool DrivenProgram::holdsPicture(const QString& name) {
  const QJsonObject answer = ask({{"do", "picture"}, {"name", name}});
  return answer.contains("commonest") && answer["commonest"].toDouble() < mostOfOneColour;
}

}  // namespace relucent::test
