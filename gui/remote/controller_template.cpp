// SPDX-License-Identifier: MIT
#include "remote/controller_template.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "remote/remote_control.h"

namespace relucent::gui {
namespace {

/// Of one argument each.
const char* typeTagsOf(const RemoteCommand& command) {
  switch (command.input.kind) {
    case RemoteInput::Kind::none:
      return "";
    case RemoteInput::Kind::onOff:
    case RemoteInput::Kind::whole:
      return "i";
    case RemoteInput::Kind::range:
      return "f";
    case RemoteInput::Kind::chart:
    case RemoteInput::Kind::name:
      return "s";
    case RemoteInput::Kind::place:
      return "ff";
  }
  return "";
}

QStringList chartChoices() {
  QStringList names{"none"};
  for (TestChart chart : allTestCharts) names.append(testChartName(chart));
  return names;
}

QJsonObject rangeOf(const RemoteInput& input) {
  return {{"min", input.least}, {"max", input.most}};
}

QJsonObject widgetOf(const RemoteCommand& command, const QString& target) {
  const QString name = QString(command.address).mid(1);
  QJsonObject widget{{"id", name},
                     {"comments", command.what},
                     {"expand", true},
                     {"target", target},
                     {"address", command.address},
                     {"typeTags", typeTagsOf(command)},
                     {"html", name},
                     {"decimals", 2}};
  switch (command.input.kind) {
    case RemoteInput::Kind::none:
      widget["type"] = "button";
      widget["mode"] = "momentary";  // an address without a value
      break;
    case RemoteInput::Kind::onOff:
      widget["type"] = "button";
      widget["mode"] = "toggle";
      widget["on"] = 1;
      widget["off"] = 0;
      break;
    case RemoteInput::Kind::range:
      widget["type"] = "fader";
      widget["horizontal"] = true;
      widget["range"] = rangeOf(command.input);
      break;
    case RemoteInput::Kind::whole:
      widget["type"] = "input";
      widget["numeric"] = true;  // and no default, which may be sent when the session is opened
      break;
    case RemoteInput::Kind::name:
      widget["type"] = "input";
      break;
    case RemoteInput::Kind::chart:
      widget["type"] = "dropdown";
      widget["values"] = QJsonArray::fromStringList(chartChoices());
      break;
    case RemoteInput::Kind::place:
      widget["type"] = "xy";
      widget["rangeX"] = widget["rangeY"] = rangeOf(command.input);
      break;
  }
  // A button says its name by itself.
  if (widget["type"] == "button") widget.remove("html");
  return widget;
}

QByteArray openStageControlSession(const QString& target) {
  QJsonArray widgets;
  for (const RemoteCommand& command : remoteCommands()) widgets.append(widgetOf(command, target));
  const QJsonObject root{{"type", "root"}, {"id", "root"}, {"layout", "vertical"}, {"widgets", widgets}};
  // Of the oldest version whose sessions need no conversion.
  return QJsonDocument(QJsonObject{{"createdWith", "Open Stage Control"},
                                   {"version", "1.25.0"},
                                   {"type", "session"},
                                   {"content", root}})
      .toJson();
}

QString csvField(const QString& text) {
  return text.contains(',') || text.contains('"') ? '"' + QString(text).replace("\"", "\"\"") + '"' : text;
}

QByteArray csvTable() {
  QStringList lines{"address,type_tags,least,most,choices,what"};
  for (const RemoteCommand& command : remoteCommands()) {
    const RemoteInput& input = command.input;
    const bool hasLeast = input.kind != RemoteInput::Kind::none && input.kind != RemoteInput::Kind::chart &&
                          input.kind != RemoteInput::Kind::name;
    // How many items there are, the show knows.
    const bool hasMost = hasLeast && input.kind != RemoteInput::Kind::whole;
    lines.append(QStringList{
        command.address, typeTagsOf(command), hasLeast ? QString::number(input.least) : QString(),
        hasMost ? QString::number(input.most) : QString(),
        input.kind == RemoteInput::Kind::chart ? chartChoices().join(' ') : QString(), csvField(command.what)}
                     .join(','));
  }
  return lines.join('\n').toUtf8() + '\n';
}

}  // namespace

QByteArray controllerTemplate(ControllerFormat format, const NetworkPlace& show) {
  return format == ControllerFormat::csv ? csvTable() : openStageControlSession(textOf(show));
}

}  // namespace relucent::gui
