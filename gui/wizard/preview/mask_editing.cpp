// SPDX-License-Identifier: MIT
#include "wizard/preview/mask_editing.h"

#include "text/message_text.h"

namespace relucent::gui {

std::optional<std::size_t> MaskEditing::chosen() const {
  return chosen_ && *chosen_ < masks().size() ? chosen_ : std::nullopt;
}

void MaskEditing::choose(std::optional<std::size_t> mask) {
  if (mask == chosen() && !drawing_) return;
  chosen_ = mask;
  drawing_ = false;
  problem_.clear();
  Q_EMIT changed();
}

compensation::Outline MaskEditing::outline() const {
  return chosen() && !drawing_ ? masks()[*chosen()].outline : next_.outline;
}

double MaskEditing::feather() const {
  return chosen() && !drawing_ ? masks()[*chosen()].feather : next_.feather;
}

void MaskEditing::draw() {
  chosen_.reset();
  drawing_ = true;
  problem_.clear();
  Q_EMIT changed();
}

void MaskEditing::cancel() {
  if (!drawing_) return;
  drawing_ = false;
  problem_.clear();
  Q_EMIT changed();
}

void MaskEditing::refuse(const Message& problem) {
  problem_ = tr("This is no mask: %1.").arg(text(problem));
  Q_EMIT changed();
}

void MaskEditing::add(std::size_t camera, const Points& points) {
  drawing_ = false;
  const compensation::Mask mask{camera, next_.outline, points, next_.feather};
  if (const Message problem = outlineProblem(mask); !problem.empty()) return refuse(problem);
  problem_.clear();
  pipeline::ContentSettings after = settings_;
  after.masks.push_back(mask);
  chosen_ = after.masks.size() - 1;
  change_(after, tr("New mask"));
  Q_EMIT changed();
}

bool MaskEditing::change(std::size_t mask, const compensation::Mask& to, const QString& what) {
  if (mask >= masks().size()) return false;
  if (const Message problem = outlineProblem(to); !problem.empty()) {
    refuse(problem);
    return false;
  }
  problem_.clear();
  if (to != masks()[mask]) {
    pipeline::ContentSettings after = settings_;
    after.masks[mask] = to;
    change_(after, what);
  }
  Q_EMIT changed();
  return true;
}

void MaskEditing::setPoints(std::size_t mask, const Points& points) {
  if (mask >= masks().size()) return;
  compensation::Mask to = masks()[mask];
  to.points = points;
  change(mask, to, tr("Outline of a mask"));
}

void MaskEditing::setOutline(compensation::Outline outline) {
  if (!chosen() || drawing_) {
    next_.outline = outline;
    Q_EMIT changed();
    return;
  }
  compensation::Mask to = masks()[*chosen()];
  to.outline = outline;
  if (change(*chosen(), to, tr("Outline of a mask"))) next_.outline = outline;
}

void MaskEditing::setFeather(double feather) {
  next_.feather = feather;
  if (!chosen() || drawing_) {
    Q_EMIT changed();
    return;
  }
  compensation::Mask to = masks()[*chosen()];
  to.feather = feather;
  change(*chosen(), to, tr("Feather of a mask"));
}

void MaskEditing::remove(std::size_t mask) {
  if (mask >= masks().size()) return;
  pipeline::ContentSettings after = settings_;
  after.masks.erase(after.masks.begin() + static_cast<std::ptrdiff_t>(mask));
  chosen_.reset();
  problem_.clear();
  change_(after, tr("Removed mask"));
  Q_EMIT changed();
}

void MaskEditing::removeChosen() {
  if (chosen()) remove(*chosen());
}

}  // namespace relucent::gui
