// SPDX-License-Identifier: MIT
#pragma once

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusVirtualObject>
#include <QHash>
#include <QImage>
#include <QProcess>
#include <QStringList>
#include <memory>
#include <vector>

namespace relucent::test {

/// A source of pictures, a node of PipeWire, as compositors are one. Each call of show() sends one picture.
class PictureNode {
 public:
  enum class Order { bgrx, bgra, rgbx, rgba };
  /// What it claims of its pictures beside the truth.
  enum class Lie { none, shortData, longLines, backwardLines, beyondEnd, strangeFormat };

  /// `unheard`: so many times it sends nothing when both sides are joined.
  PictureNode(const QImage& picture, Order order, Lie lie = Lie::none, int unheard = 0);
  ~PictureNode();
  /// Its number, once PipeWire knows it.
  quint32 number() const;
  /// Of another size: the format is agreed on anew.
  void show(const QImage& picture);
  void show(const QImage& picture, Order order);
  /// As a change of size whose picture was sent before the other side was ready.
  void showUnheard(const QImage& picture);
  void tell(Lie lie);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The desktop's end of the ScreenCast portal: what a person in its dialog would say, and which node is
/// shown. Behind it stands the real xdg-desktop-portal, which it starts.
class DesktopDouble : public QDBusVirtualObject {
 public:
  enum class Answer {
    gives,
    refuses,
    fails,
    waits,  // until it is asked otherwise, or no longer
  };
  DesktopDouble();
  ~DesktopDouble() override;

  Answer answer = Answer::gives;
  bool takesChoicesAgain = true;  // without a question
  bool remembers = true;
  quint32 node = 0;
  int questions = 0;         // asked in its dialog
  int withdrawn = 0;         // of these, closed without an answer
  std::vector<uint> wanted;  // kinds of sources: 1 screens, 2 windows

  /// As somebody does who ends it in the desktop.
  void endAll();

  QString introspect(const QString& path) const override;
  bool handleMessage(const QDBusMessage& message, const QDBusConnection& connection) override;

 private:
  QDBusConnection bus_;
  QProcess portal_;
  QStringList sessions_;
  QHash<QString, bool> restored_;      // by session
  QHash<QString, QDBusMessage> open_;  // dialogs, by request
};

}  // namespace relucent::test
