// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QProcess>
#include <QStringList>
#include <functional>
#include <vector>

namespace relucent::test {

/// A button, a field or a text, as it stands on the screen.
struct SeenPart {
  QString name, text, role, spoken, more;
  bool isButton = false, isEnabled = true, isChecked = false, isDefault = false;
};
struct SeenWindow {
  QString title, name;
  bool blocks = false;  // those behind it cannot be used
  std::vector<SeenPart> parts;
};

/// What somebody before the program reads on its windows, the front one first.
class Seen {
 public:
  Seen() = default;
  explicit Seen(const QJsonObject& answer);

  const std::vector<SeenWindow>& windows() const { return windows_; }
  /// Some text in sight holds these words; of the dialog alone where one stands before all else.
  bool says(const QString& words) const;
  /// By its object's name; one without text where there is none in sight.
  SeenPart part(const QString& name) const;
  SeenPart button(const QString& text) const;
  /// The title of the window that blocks all others; empty: none does.
  QString dialog() const;
  /// For a message: everything that can be read.
  QString text() const;

 private:
  std::vector<SeenWindow> windows_;
};

/// A program in a process of its own, used as a person uses it: see support/hand. It can be killed.
class DrivenProgram {
 public:
  /// `plugins`: the folder that holds generic/ with the hand in it.
  DrivenProgram(const QString& plugins, const QProcessEnvironment& environment);
  ~DrivenProgram();

  /// Before it starts: how long its event loop leaves others waiting is noted
  /// (support/hand/event_loop_watch.h), and what it says on standard error goes to a file.
  void watch(const QString& errors);
  void start(const QString& program, const QStringList& arguments = {});
  void kill();
  /// As a desktop asks that ends.
  void terminate() { process_.terminate(); }
  bool isRunning() const { return process_.state() == QProcess::Running; }
  /// Waits for its end. False: it goes on.
  bool hasEnded(int milliseconds) { return process_.waitForFinished(milliseconds); }
  int exitCode() const { return process_.exitCode(); }

  /// What is shown now; nothing where it does not answer.
  Seen look();
  /// Empty, or why it cannot be done, in words for a test's message.
  QString click(const QString& name);
  QString clickText(const QString& text);
  QString type(const QString& name, const QString& text);
  QString press(const QString& keys);
  /// How much of a widget has a colour, pixels.
  int pixels(const QString& name, const QColor& colour);
  /// A view with a picture in it: not all of one colour.
  bool holdsPicture(const QString& name);
  /// Whatever else the hand knows: {"do": ...}. {"failed": why} where it does not.
  QJsonObject ask(const QJsonObject& wish);

 private:
  QString done(const QJsonObject& wish) { return ask(wish)["failed"].toString(); }

  QProcess process_;
};

}  // namespace relucent::test
