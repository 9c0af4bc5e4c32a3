// SPDX-License-Identifier: MIT
#pragma once

#include <QGenericPlugin>
#include <QJsonObject>
#include <QSocketNotifier>
#include <QWidget>
#include <memory>

#include "support/hand/event_loop_watch.h"
#include "support/hand/usable_widgets.h"

namespace relucent::test {

/// Somebody who sits before a program of Qt's: sees what its windows show, and moves mouse and keys. Loaded
/// by the program itself ($QT_QPA_GENERIC_PLUGINS=hand, or hand:watch), which knows nothing of it; told what
/// to do by lines of JSON on standard input, answered by one each on standard output. See
/// support/driven_program.h.
class Hand : public QObject {
  Q_OBJECT

 public:
  /// `watches`: it also notes how long the program leaves it waiting.
  explicit Hand(bool watches);

 private:
  void read();
  QJsonObject answer(const QJsonObject& wish);

  QSocketNotifier input_;
  QByteArray pending_;
  UsableWidgets usable_;
  std::unique_ptr<EventLoopWatch> watch_;
};

class HandPlugin : public QGenericPlugin {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "hand.json")

 public:
  QObject* create(const QString& key, const QString& specification) override;
};

}  // namespace relucent::test
