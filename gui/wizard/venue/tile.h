// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QImage>
#include <optional>

#include "theme/icons.h"

namespace relucent::gui {

/// A large choice: an icon or a picture, a name, and a sentence.
class Tile : public QAbstractButton {
  Q_OBJECT

 public:
  Tile(Icon icon, const QString& name, const QString& sentence, QWidget* parent = nullptr);
  Tile(const QImage& picture, const QString& name, const QString& sentence, QWidget* parent = nullptr);
  void setSentence(const QString& sentence);
  /// Of something that is not there now.
  void setDashed(bool dashed);
  bool isDashed() const { return dashed_; }
  /// Of what is drawn in its own shape: never larger than this, smaller in the same shape where there is less
  /// room, as long as its words have theirs.
  void setLargest(QSize size);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  /// As high as its sentence is long.
  int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void enterEvent(QEnterEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void init(const QString& name, const QString& sentence);
  void paintPicture(QPainter& painter, QRectF area) const;
  /// What stands free at both sides of its words.
  int widthBesideText() const;
  int sentenceHeight(int width) const;
  /// That all its words need.
  int wordsHeight(int width) const;
  std::optional<Icon> icon_;
  QImage picture_;
  QString sentence_;
  QSize largest_;
  bool dashed_ = false;
};

}  // namespace relucent::gui
