// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <optional>

#include "relucent/pipeline/content_settings.h"

namespace relucent::gui {

/// The masks of a content: which one is chosen, and whether one is being drawn. What is changed becomes a
/// change of the content's settings, which can be undone; what cannot be a mask is refused with a sentence,
/// and nothing changes.
class MaskEditing : public QObject {
  Q_OBJECT

 public:
  using Points = std::vector<std::array<double, 2>>;
  /// Takes settings over under a name, in the list of what can be undone.
  using Change = std::function<void(const pipeline::ContentSettings&, const QString& what)>;

  MaskEditing(const pipeline::ContentSettings& settings, Change change, QObject* parent)
      : QObject(parent), settings_(settings), change_(std::move(change)) {}

  const std::vector<compensation::Mask>& masks() const { return settings_.masks; }
  /// Its number among all masks; none is chosen.
  std::optional<std::size_t> chosen() const;
  void choose(std::optional<std::size_t> mask);
  /// What the next mask is made of, or the chosen one is.
  compensation::Outline outline() const;
  double feather() const;

  bool isDrawing() const { return drawing_; }
  void draw();
  void cancel();
  /// The outline that was being drawn.
  void add(std::size_t camera, const Points& points);

  void setPoints(std::size_t mask, const Points& points);
  void setOutline(compensation::Outline outline);
  void setFeather(double feather);
  void remove(std::size_t mask);
  void removeChosen();

  /// Why the last outline cannot be; empty: it can.
  const QString& problem() const { return problem_; }

 Q_SIGNALS:
  void changed();

 private:
  /// Whether it is taken.
  bool change(std::size_t mask, const compensation::Mask& to, const QString& what);
  void refuse(const Message& problem);

  const pipeline::ContentSettings& settings_;
  Change change_;
  std::optional<std::size_t> chosen_;
  compensation::Mask next_;  // its outline and feather
  bool drawing_ = false;
  QString problem_;
};

}  // namespace relucent::gui
