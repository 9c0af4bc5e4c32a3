// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QTextBrowser>

#include "app/guide.h"

namespace relucent::gui {

/// The guide in a language ("de"), missing pages in English, in the order of the steps; then pages that
/// belong to no step, the last one about the program and the libraries that it uses.
QList<HelpPage> helpPages(const QString& language);

/// Displays a page: with the direction of its language, spacing between paragraphs, and pictures in the
/// program's theme, scaled to the available width.
class HelpText : public QTextBrowser {
  Q_OBJECT

 public:
  explicit HelpText(QWidget* parent = nullptr);
  void show(const HelpPage& page);

 protected:
  QVariant loadResource(int type, const QUrl& name) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void spread();
  void showAgain();
  HelpPage page_;
  int width_ = 0;           // width that pictures were scaled to
  bool isWriting_ = false;  // the page into the document
};

/// The window of the user's guide: list of pages at the left, the page at the right, and a search over all of
/// them.
class HelpWindow : public QDialog {
  Q_OBJECT

 public:
  /// `language`: "de".
  explicit HelpWindow(const QString& language, QWidget* parent = nullptr);
  /// Of a step, from 0.
  void showPage(int index);
  /// Replaces a guide in another language, at the page that it showed.
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

}  // namespace relucent::gui
