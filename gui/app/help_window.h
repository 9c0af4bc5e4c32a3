// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QTextBrowser>

#include "app/guide.h"

namespace relucent {

/// The guide in a language ("de"), each page that it lacks in English, in the order of the steps; then what
/// belongs to no step, last about the program and whose work it is made with.
QList<HelpPage> helpPages(const QString& language);

/// A page as it is read: from the side of its language, room between paragraphs, pictures no wider than there
/// is room for.
class HelpText : public QTextBrowser {
  Q_OBJECT

 public:
  explicit HelpText(QWidget* parent = nullptr) : QTextBrowser(parent) {}
  void show(const HelpPage& page);

 protected:
  QVariant loadResource(int type, const QUrl& name) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void spread();
  HelpPage page_;
  int width_ = 0;  // that pictures were made for
};

/// The user's guide beside the program: pages at the left, what they say at the right, and a search through
/// all of them.
class HelpWindow : public QDialog {
  Q_OBJECT

 public:
  /// `language`: "de".
  explicit HelpWindow(const QString& language, QWidget* parent = nullptr);
  /// Of a step, from 0.
  void showPage(int index);
  /// In the place of a guide in another language, at the page that it showed.
  void replace(const HelpWindow& before);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void search(const QString& words);
  void fill();
  void follow(const QUrl& link);
  QList<HelpPage> pages_;
  QLineEdit* search_;
  QListWidget* list_;
  HelpText* text_;
};

}  // namespace relucent
