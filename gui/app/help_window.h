// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QTextBrowser>

namespace relucent {

/// A page of the user's guide.
struct HelpPage {
  QString id;     // of the file: "03-linearize"
  QString title;  // its heading
  QString text;   // Markdown
};

/// The guide in the user's language, else in English, in the order of the steps.
QList<HelpPage> helpPages(const QString& language);

/// The user's guide beside the program: pages at the left, what they say at the right, and a search through
/// all of them.
class HelpWindow : public QDialog {
  Q_OBJECT

 public:
  explicit HelpWindow(QWidget* parent = nullptr);
  /// Of a step, from 0.
  void showPage(int index);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void search(const QString& words);
  void fill();
  void spread();
  QList<HelpPage> pages_;
  QLineEdit* search_;
  QListWidget* list_;
  QTextBrowser* text_;
};

}  // namespace relucent
