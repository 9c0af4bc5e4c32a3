// SPDX-License-Identifier: MIT
#include "support/hand/hand.h"

#include <unistd.h>

#include <QAbstractButton>
#include <QApplication>
#include <QCheckBox>
#include <QJsonArray>
#include <QJsonDocument>
#include <QTimer>
#include <QWindow>
#include <QtTest>

#include "support/hand/seen_widgets.h"
#include "support/hand/window_faults.h"

namespace relucent::test {
namespace {

constexpr int input = STDIN_FILENO, output = STDOUT_FILENO;

QJsonObject refusal(const QString& why) {
  return {{"failed", why}};
}

/// It is a button with these words on it, or one of that name with more on it.
bool says(const QWidget& widget, const QString& words) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  return button != nullptr && (button->text() == words || button->accessibleName() == words);
}

/// The widget of that name, or the button with that text, from the front window to the back: what is in sight
/// is meant where pages share names. To be `used`, it must not stand behind a window that blocks it.
QWidget* find(const QJsonObject& wish, bool used) {
  QWidget* hidden = nullptr;
  for (QWidget* window : windowsFromTheFront()) {
    for (QWidget* widget : window->findChildren<QWidget*>()) {
      if (widget->window() != window || !widget->isVisible()) continue;
      const bool isMeant = wish.contains("name") ? widget->objectName() == wish["name"].toString()
                                                 : says(*widget, wish["text"].toString());
      if (!isMeant) continue;
      if (isInSight(*widget)) return widget;
      hidden = widget;
    }
    if (used && window->isModal()) break;
  }
  return hidden;
}

/// By the window system's way, which other windows may block.  Empty, or why it cannot be done.
QString press(QWidget& widget, QPoint where) {
  scrollTo(widget);
  if (!widget.isEnabled()) return QString("%1 is not enabled").arg(widget.objectName());
  if (!widget.visibleRegion().contains(where)) return QString("%1 is not in sight").arg(widget.objectName());
  QWindow* window = widget.window()->windowHandle();
  window->requestActivate();  // as a window manager does, of which there is none
  QTest::mouseClick(window, Qt::LeftButton, {}, widget.mapTo(widget.window(), where));
  return {};
}

/// Its middle; of a wide box with a tick, the tick.
QPoint placeToPress(const QWidget& widget) {
  const QRect area = widget.rect();
  const bool hasTick = qobject_cast<const QCheckBox*>(&widget) != nullptr;
  return hasTick ? QPoint(area.height() / 2, area.center().y()) : area.center();
}

void type(QWidget& window, const QString& text) {
  for (const QChar letter : text) QTest::keyClick(window.windowHandle(), letter.toLatin1());
}

QJsonObject pressKeys(const QString& keys) {
  const QWidgetList windows = windowsFromTheFront();
  if (windows.isEmpty()) return refusal("there is no window");
  const QKeySequence sequence(keys);
  QTest::keySequence(windows.front()->windowHandle(), sequence);
  return {};
}

/// The main window, by its frame. What it does may begin a loop of its own.
QJsonObject changeWindow(const QJsonObject& wish) {
  for (QWidget* window : windowsFromTheFront()) {
    if (!window->inherits("QMainWindow")) continue;
    QTimer::singleShot(0, window, [window, wish] {
      if (wish["do"].toString() == "close")
        window->close();
      else
        window->resize(wish["width"].toInt(), wish["height"].toInt());
    });
    return {};
  }
  return refusal("there is no window");
}

}  // namespace

Hand::Hand(bool watches)
    : input_(input, QSocketNotifier::Read), watch_(watches ? std::make_unique<EventLoopWatch>() : nullptr) {
  connect(&input_, &QSocketNotifier::activated, this, &Hand::read);
}

void Hand::read() {
  char bytes[4096];
  const ssize_t count = ::read(input, bytes, sizeof bytes);
  if (count <= 0) return input_.setEnabled(false);
  pending_.append(bytes, count);
  for (qsizetype end = pending_.indexOf('\n'); end >= 0; end = pending_.indexOf('\n')) {
    const QByteArray line = pending_.left(end);
    pending_.remove(0, end + 1);
    const QByteArray reply =
        QJsonDocument(answer(QJsonDocument::fromJson(line).object())).toJson(QJsonDocument::Compact) + '\n';
    for (qsizetype sent = 0; sent < reply.size();) {
      const ssize_t more =
          ::write(output, reply.constData() + sent, static_cast<std::size_t>(reply.size() - sent));
      if (more <= 0) return;
      sent += more;
    }
  }
}

QJsonObject Hand::answer(const QJsonObject& wish) {
  const QString what = wish["do"].toString();
  if (what == "look") return allInSight();
  if (what == "survey")
    return {{"usable", usable_.survey()},
            {"faults", QJsonArray::fromStringList(windowFaults())},
            {"progress", progressInSight()},
            {"loop", watch_ ? watch_->report() : QJsonObject()}};
  if (what == "use") return {{"failed", usable_.use(wish)}};
  if (what == "resize" || what == "close") return changeWindow(wish);
  if (what == "shortcut") {
    QTimer::singleShot(0, this, [keys = wish["keys"].toString()] { pressKeys(keys); });
    return {};
  }
  if (what == "keys") return pressKeys(wish["keys"].toString());
  QWidget* widget = find(wish, what == "click" || what == "type");
  if (widget == nullptr)
    return refusal(QString("there is no %1").arg(wish[wish.contains("name") ? "name" : "text"].toString()));
  if (what == "colour") return {{"pixels", pixelsOf(*widget, QColor(wish["colour"].toString()))}};
  if (what == "picture") return {{"commonest", isInSight(*widget) ? commonestShare(*widget) : 1.0}};
  if (what == "click" || what == "type") {
    if (const QString why = press(*widget, placeToPress(*widget)); !why.isEmpty()) return refusal(why);
    if (what == "click") return {};
    pressKeys("Ctrl+A");
    type(*widget->window(), wish["typed"].toString());
    return {};
  }
  return refusal("nobody knows how to " + what);
}

QObject* HandPlugin::create(const QString&, const QString& specification) {
  return new Hand(specification == "watch");
}

}  // namespace relucent::test
