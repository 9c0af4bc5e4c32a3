// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QCoreApplication>
#include <QJsonObject>

namespace relucent::gui {

/// A show's facts as a page for people: HTML without scripts that loads itself again every ten seconds.
/// Whatever a fact says is text there.
class StatusPage {
  Q_DECLARE_TR_FUNCTIONS(relucent::gui::StatusPage)

 public:
  static QByteArray html(const QJsonObject& health);
};

/// An answer of HTTP/1.0.
struct HttpAnswer {
  int status = 200;
  QByteArray type, body;
};
/// What is answered to the head of a request, for a computer of that name: the page at /, the same facts at
/// /health.json. Only GET and HEAD, and only by a number, "localhost" or its own name: a page of somebody
/// else's in a browser of this computer learns nothing by calling it otherwise.
HttpAnswer statusAnswer(const QByteArray& head, const QString& computer, const QJsonObject& health);
/// As bytes; without its body for HEAD.
QByteArray httpBytes(const HttpAnswer& answer, bool withBody);

}  // namespace relucent::gui
