// SPDX-License-Identifier: MIT
#pragma once

#include <QGenericPlugin>
#include <QJsonObject>
#include <QSocketNotifier>
#include <QWidget>

namespace relucent::test {

/// Somebody who sits before a program of Qt's: sees what its windows show, and moves mouse and keys. Loaded
/// by the program itself ($QT_QPA_GENERIC_PLUGINS=hand), which knows nothing of it; told what to do by lines
/// of JSON on standard input, answered by one each on standard output. See support/driven_program.h.
class Hand : public QObject {
  Q_OBJECT

 public:
  Hand();

 private:
  void read();
  QJsonObject answer(const QJsonObject& wish);

  QSocketNotifier input_;
  QByteArray pending_;
};

class HandPlugin : public QGenericPlugin {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "hand.json")

 public:
  QObject* create(const QString& key, const QString& specification) override;
};

}  // namespace relucent::test
