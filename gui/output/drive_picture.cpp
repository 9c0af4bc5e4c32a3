// SPDX-License-Identifier: MIT
#include "output/drive_picture.h"

#include <QOpenGLExtraFunctions>
#include <algorithm>
#include <atomic>

#include "output/shared_gl.h"

namespace relucent::gui {
namespace {

/// A window's context may still read the picture that it showed last.
constexpr std::size_t fewestSets = 4;

qint64 nextNumber() {
  // Below those of pictures in memory, which begin at 2^32.
  static std::atomic<std::uint32_t> last{0};
  return 1 + static_cast<qint64>(last++);
}

}  // namespace

CardPicture::CardPicture(QSize size) : size_(size) {
  if (SharedGl* shared = SharedGl::existing())
    shared->run([this](QOpenGLContext& context) {
      QOpenGLFunctions& gl = *context.functions();
      while (gl.glGetError() != GL_NO_ERROR) {
      }
      gl.glGenTextures(1, &texture_);
      gl.glBindTexture(GL_TEXTURE_2D, texture_);
      for (GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
      for (GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl.glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
      QImage black(size_, QImage::Format_RGBA8888);
      black.fill(Qt::black);
      gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.width(), size_.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      black.constBits());
      gl.glBindTexture(GL_TEXTURE_2D, 0);
      if (gl.glGetError() != GL_NO_ERROR) {
        gl.glDeleteTextures(1, &texture_);
        texture_ = 0;
      }
      gl.glFinish();
    });
  renew();
}

CardPicture::~CardPicture() {
  if (texture_ != 0)
    SharedGl::existing()->run(
        [this](QOpenGLContext& context) { context.functions()->glDeleteTextures(1, &texture_); });
}

void CardPicture::renew() {
  number_ = nextNumber();
}

QImage CardPicture::read() const {
  QImage image;
  if (texture_ == 0) return image;
  SharedGl::existing()->run([&](QOpenGLContext& context) {
    QOpenGLFunctions& gl = *context.functions();
    GLuint target = 0;
    gl.glGenFramebuffers(1, &target);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, target);
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) {
      image = QImage(size_, QImage::Format_RGBX8888);
      gl.glReadPixels(0, 0, size_.width(), size_.height(), GL_RGBA, GL_UNSIGNED_BYTE, image.bits());
    }
    gl.glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.glDeleteFramebuffers(1, &target);
  });
  return image;
}

std::vector<std::shared_ptr<CardPicture>> CardPictures::next() {
  const auto isFree = [](const std::vector<std::shared_ptr<CardPicture>>& set) {
    return std::ranges::all_of(set, [](const auto& picture) { return picture.use_count() == 1; });
  };
  auto free = sets_.size() < fewestSets ? sets_.end() : std::ranges::find_if(sets_, isFree);
  if (free == sets_.end()) {
    std::vector<std::shared_ptr<CardPicture>> set;
    for (const QSize& size : sizes_) set.push_back(std::make_shared<CardPicture>(size));
    if (std::ranges::any_of(set, [](const auto& picture) { return picture->texture() == 0; })) return {};
    sets_.push_back(std::move(set));
  } else {
    std::rotate(free, free + 1, sets_.end());
  }
  for (const auto& picture : sets_.back()) picture->renew();
  return sets_.back();
}

}  // namespace relucent::gui
