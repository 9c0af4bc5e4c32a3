// SPDX-License-Identifier: MIT
#include "remote/controller_template.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>

#include "gui/remote/noted_actions.h"
#include "remote/remote_control.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

const NetworkPlace show{QHostAddress::LocalHost, 7700};

QList<QJsonObject> widgets() {
  const QByteArray text = controllerTemplate(ControllerFormat::openStageControl, show);
  const QJsonObject session = QJsonDocument::fromJson(text).object();
  QList<QJsonObject> all;
  for (const QJsonValue& widget : session["content"].toObject()["widgets"].toArray())
    all.append(widget.toObject());
  return all;
}

/// What Open Stage Control sends for a widget, at its ends, by the reference of its widgets.
QList<std::vector<OscArgument>> sentBy(const QJsonObject& widget) {
  const QString type = widget["type"].toString();
  const auto ends = [&](const char* name) {
    const QJsonObject range = widget[name].toObject();
    return QList<double>{range["min"].toDouble(), range["max"].toDouble()};
  };
  QList<std::vector<OscArgument>> sent;
  if (type == "button" && widget["mode"] == "momentary") sent.append(std::vector<OscArgument>{});
  if (type == "button" && widget["mode"] == "toggle")
    sent << std::vector<OscArgument>{widget["on"].toDouble()}
         << std::vector<OscArgument>{widget["off"].toDouble()};
  if (type == "fader")
    for (double end : ends("range")) sent.append({OscArgument(end)});
  if (type == "input")
    sent.append({widget["numeric"].toBool() ? OscArgument(1.0) : OscArgument(QString("night"))});
  if (type == "dropdown")
    for (const QJsonValue& value : widget["values"].toArray()) sent.append({OscArgument(value.toString())});
  if (type == "xy")
    for (double x : ends("rangeX"))
      for (double y : ends("rangeY")) sent.append({OscArgument(x), OscArgument(y)});
  return sent;
}

}  // namespace

class TestControllerTemplate : public QObject {
  Q_OBJECT

 private slots:
  void aSessionHasEveryAddressOnce() {
    const QJsonObject session =
        QJsonDocument::fromJson(controllerTemplate(ControllerFormat::openStageControl, show)).object();
    QCOMPARE(session["createdWith"].toString(), QString("Open Stage Control"));
    QCOMPARE(session["type"].toString(), QString("session"));
    QCOMPARE(session["content"].toObject()["type"].toString(), QString("root"));
    QStringList there, wanted, ids;
    for (const QJsonObject& widget : widgets()) {
      there << widget["address"].toString();
      ids << widget["id"].toString();
      QCOMPARE(widget["target"].toString(), QString("127.0.0.1:7700"));
    }
    for (const RemoteCommand& command : remoteCommands()) wanted << command.address;
    QCOMPARE(there, wanted);
    ids.removeDuplicates();
    QCOMPARE(ids.size(), wanted.size());
  }

  /// Law: nothing that a widget can send is refused.
  void whatWidgetsSendIsCarriedOut_data() {
    QTest::addColumn<QJsonObject>("widget");
    for (const QJsonObject& widget : widgets())
      QTest::newRow(qPrintable(widget["address"].toString())) << widget;
  }
  void whatWidgetsSendIsCarriedOut() {
    QFETCH(QJsonObject, widget);
    OscServer server({QHostAddress::LocalHost, 0});
    NotedActions actions;
    RemoteControl control(server, actions, std::nullopt);
    QSignalSpy warned(&control, &RemoteControl::warned);
    const QList<std::vector<OscArgument>> all = sentBy(widget);
    QVERIFY(!all.isEmpty());
    for (const std::vector<OscArgument>& arguments : all) {
      Q_EMIT server.received({widget["address"].toString(), arguments}, {QHostAddress::LocalHost, 9});
      QVERIFY2(warned.isEmpty(), qPrintable(warned.isEmpty() ? QString() : warned[0][0].toString()));
      const QString tags = widget["typeTags"].toString();
      QCOMPARE(tags.size(), static_cast<qsizetype>(arguments.size()));
      for (std::size_t i = 0; i < arguments.size(); ++i)
        QCOMPARE(std::holds_alternative<QString>(arguments[i]), tags[static_cast<qsizetype>(i)] == 's');
    }
  }

  void aTableHasALineForEach() {
    const QString text = QString::fromUtf8(controllerTemplate(ControllerFormat::csv, show));
    QVERIFY(text.endsWith("\n"));
    const QStringList lines = text.trimmed().split("\n");
    QCOMPARE(lines.size(), static_cast<qsizetype>(remoteCommands().size()) + 1);
    for (const RemoteCommand& command : remoteCommands())
      QCOMPARE(lines.filter(QString(command.address) + ',').size(), 1);
    QCOMPARE(lines.filter("/brightness,").first(),
             QString("/brightness,f,0,1.5,,\"Brightness of white, relative to the calibration's.\""));
    QCOMPARE(lines.filter("/play,").first(), QString("/play,,,,,Content goes on."));
    QVERIFY(lines.filter("/item,").first().startsWith("/item,i,1,,,"));
    QVERIFY(lines.filter("/set,").first().startsWith("/set,s,,,,"));
    QVERIFY(lines.filter("/chart,").first().startsWith("/chart,s,,,none grid "));
  }
};

QTEST_GUILESS_MAIN(TestControllerTemplate)
#include "test_controller_template.moc"
