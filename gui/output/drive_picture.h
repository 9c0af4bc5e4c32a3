// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QSize>
#include <cstdint>
#include <memory>
#include <vector>

namespace relucent::gui {

/// A picture on the graphics card: a texture of SharedGl, RGBA8, rows from the top.
class CardPicture {
 public:
  /// Black. On any thread; `texture()` is 0 if the card has no room.
  explicit CardPicture(QSize size);
  ~CardPicture();
  CardPicture(const CardPicture&) = delete;
  CardPicture& operator=(const CardPicture&) = delete;

  std::uint32_t texture() const { return texture_; }
  QSize size() const { return size_; }
  /// Another one each time that it was drawn anew.
  qint64 number() const { return number_; }
  /// Before it is drawn anew.
  void renew();
  /// From the card: slow. Null if that is lost.
  QImage read() const;

 private:
  QSize size_;
  std::uint32_t texture_ = 0;
  qint64 number_ = 0;
};

/// What a projector is sent: a picture in memory, or one on the graphics card. Null: nothing.
class DrivePicture {
 public:
  DrivePicture() = default;
  DrivePicture(QImage image) : image_(std::move(image)) {}  // NOLINT(google-explicit-constructor): is one
  explicit DrivePicture(std::shared_ptr<const CardPicture> card) : card_(std::move(card)) {}

  bool isNull() const { return card_ == nullptr && image_.isNull(); }
  QSize size() const { return card_ ? card_->size() : image_.size(); }
  /// Positive; equal for pictures that are known to be the same. 0 for null.
  qint64 key() const { return card_ ? card_->number() : image_.cacheKey(); }
  /// Null: it is in memory.
  const CardPicture* card() const { return card_.get(); }
  /// In memory; from the card that takes a while.
  QImage image() const { return card_ ? card_->read() : image_; }

 private:
  QImage image_;
  std::shared_ptr<const CardPicture> card_;
};

/// Pictures for one projector after the other, used again when nobody shows them any more.
class CardPictures {
 public:
  explicit CardPictures(std::vector<QSize> sizes) : sizes_(std::move(sizes)) {}
  /// One for each projector, to be drawn on; empty if the card has no room.
  std::vector<std::shared_ptr<CardPicture>> next();

 private:
  std::vector<QSize> sizes_;
  std::vector<std::vector<std::shared_ptr<CardPicture>>> sets_;  // the one used longest ago first
};

}  // namespace relucent::gui
