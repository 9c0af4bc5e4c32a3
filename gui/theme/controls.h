// SPDX-License-Identifier: MIT
#pragma once

#include <QButtonGroup>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSet>
#include <QToolButton>
#include <QVBoxLayout>

#include "theme/icons.h"

class QComboBox;

namespace relucent::gui {

/// An icon that follows the theme. Decoration only: text beside it says the same.
class IconLabel : public QWidget {
  Q_OBJECT

 public:
  using Role = const QColor& (*)();
  IconLabel(Icon icon, Role colour, int side = 20, QWidget* parent = nullptr);
  void setIcon(Icon icon, Role colour);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Icon icon_;
  Role colour_;
};
const QColor& textColour();
const QColor& secondaryColour();
const QColor& goodColour();
const QColor& amberColour();
const QColor& errorColour();
const QColor& informationColour();
const QColor& accentColour();

/// Of a text with whatever in it that somebody typed: shown as it is.
QString plainToolTip(const QString& text);

/// A label with a role of the style sheet; wraps. Shows its text as it is: users' words are no rich text.
QLabel* labelOf(const QString& text, const char* role = "", QWidget* parent = nullptr);
/// A single line; text that does not fit ends in an ellipsis and is shown in full as a tooltip.
class ElidedLabel : public QLabel {
  Q_OBJECT

 public:
  explicit ElidedLabel(QWidget* parent = nullptr);
  void setWhole(const QString& text);
  /// Of a text that does not fit, no fewer letters than these: they would say nothing.
  void setLeastLetters(int letters) { leastLetters_ = letters; }

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void elide();
  QString whole_;
  int leastLetters_ = 0;
};
/// A label that takes the available width.
ElidedLabel* elidedLabel(const char* role);

/// A thin line between groups.
QFrame* lineOf();

/// A bordered area with a title, a subtitle and small actions at its right.
class Card : public QFrame {
  Q_OBJECT

 public:
  explicit Card(const QString& title = {}, QWidget* parent = nullptr);
  void setSubtitle(const QString& text);
  void addAction(QWidget* action);
  QVBoxLayout* body() { return body_; }

 private:
  QLabel* title_ = nullptr;
  ElidedLabel* subtitle_ = nullptr;
  QHBoxLayout* header_ = nullptr;
  QVBoxLayout* body_ = nullptr;
};

/// "Light   98.6 %": what and how much.
class ValueRow : public QWidget {
  Q_OBJECT

 public:
  explicit ValueRow(const QString& name, QWidget* parent = nullptr);
  /// `role` of the value: "strong", "good", "amber", "error".
  void setValue(const QString& value, const char* role = "strong");

 private:
  QLabel* value_;
};

/// A finding: a tick, a warning or a failure, with a sentence and its meaning.
class Remark : public QWidget {
  Q_OBJECT

 public:
  enum class Kind { good, watch, warning, failed };
  explicit Remark(QWidget* parent = nullptr);
  void show(Kind kind, const QString& sentence, const QString& meaning);
  /// From now on what is below keeps its place when less is said: there is as much room as was taken at this
  /// width.
  void keepRoom() { keepsRoom_ = true; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  IconLabel* icon_;
  QLabel *sentence_, *meaning_;
  bool keepsRoom_ = false;
};

/// A coloured box with a sentence and its consequence.
class Note : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { information, amber, error };
  explicit Note(Kind kind, QWidget* parent = nullptr);
  void setText(const QString& sentence, const QString& more = {});

 private:
  QLabel *sentence_, *more_;
};

/// A choice of one of a few, side by side, or stacked if there is no room.
class Segmented : public QWidget {
  Q_OBJECT

 public:
  explicit Segmented(const QStringList& texts, QWidget* parent = nullptr);
  int current() const { return group_.checkedId(); }
  /// Emits no signal.
  void setCurrent(int index);
  /// What is not offered is not there to be chosen.
  void setOffered(int index, bool offered);
  /// Where there is no room for a row it is a list that opens, as high as one line, and not a stack. `name`:
  /// of what is chosen, for those who do not see it.
  void foldIntoList(const QString& name);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 Q_SIGNALS:
  void chosen(int index);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QList<QAbstractButton*> offered() const;
  void arrange();
  void fillList();
  QButtonGroup group_;
  QSet<int> withheld_;
  QComboBox* list_ = nullptr;  // nullptr: it is stacked instead
};

/// A choice of one of a few, stacked: a name, a sentence, and the cost at the right.
class Choice : public QPushButton {
  Q_OBJECT

 public:
  Choice(const QString& name, const QString& sentence, QWidget* parent = nullptr);
  void setSentence(const QString& text);
  void setRemark(const QString& text);

 private:
  QLabel *sentence_, *remark_;
};

/// A small button with an icon that follows the theme; `name` is its accessible name and its tooltip.
QToolButton* toolOf(Icon icon, const QString& name, QWidget* parent = nullptr);

/// A button with a role of the style sheet.
QPushButton* buttonOf(const QString& text, const char* role = "", QWidget* parent = nullptr);

}  // namespace relucent::gui
