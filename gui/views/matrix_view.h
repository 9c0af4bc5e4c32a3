// SPDX-License-Identifier: MIT
#pragma once

#include <QTimer>
#include <memory>

#include "jobs/latest.h"
#include "relucent/image/image.h"
#include "relucent/transport/matrix_density.h"
#include "views/colour_map.h"
#include "views/plane_view.h"

namespace relucent::gui {

class PlaneScene;

/// A view of T, from the whole matrix to single entries: rows are camera pixels, columns projector pixels,
/// colours the mean light of the entries in a screen's pixel on a logarithmic scale. The view moves at once
/// with the present picture; a sharper one of the visible part is computed on another thread and replaces it:
/// first, and while the view moves, an estimate from some of the rows, then the exact one. The pick is
/// (column, row); a lens in a corner shows its surroundings. Without OpenGL a sentence is shown instead.
class MatrixView : public PlaneView {
  Q_OBJECT

 public:
  explicit MatrixView(QWidget* parent = nullptr);
  ~MatrixView() override;

  /// None: nullptr.
  void setMatrix(std::shared_ptr<const transport::MatrixPictures> matrix);
  /// No sharper or exact picture is pending.
  bool isSettled() const { return !asking_.isBusy() && !wanted_; }

  /// The visible entries.
  transport::MatrixPart seen() const;
  /// Light of one entry: of that camera pixel from that projector pixel, however much a cell of the picture
  /// holds. None: there is no matrix.
  std::optional<float> valueAt(QPoint entry) const;
  /// The values of the visible part of that picture. One channel; empty until they are exact.
  image::Image values() const;
  const ColourScale& scale() const { return scale_; }

 protected:
  QSize planeSize() const override;
  bool keepsAspect() const override { return false; }
  QRectF frame() const override;
  std::vector<QRectF> keptFree() const override;
  void arrange() override;
  void paintOver(QPainter& painter) override;

 private:
  /// A picture of a part of T.
  struct Picture {
    std::shared_ptr<const transport::MatrixDensity> density;
    std::vector<float> means;
    QImage image;
  };
  struct Answer {
    std::shared_ptr<const transport::MatrixPictures> of;
    Picture whole, detail, lens;
    ColourScale scale;
    bool exact = false, exactWhole = false;
  };
  /// The visible part of the plane in entries, with fractions.
  QRectF looked() const;
  QRectF barArea() const;
  transport::MatrixPart partFor(const QRectF& looked, Size& cells) const;
  bool isSharp() const;
  /// Contents and position of the lens; none without a visible pick, or when single entries are visible.
  std::optional<transport::MatrixPart> lensPart() const;
  QRectF lensFrame() const;
  bool hasLens() const;
  void want();
  void take(Answer answer);
  static Picture pictureOf(const transport::MatrixPictures& matrix, const transport::MatrixPart& part,
                           Size cells, std::size_t step = 1);
  QRectF targetOf(const transport::MatrixPart& part) const;
  void paintAxes(QPainter& painter) const;
  void paintCross(QPainter& painter) const;
  void paintLens(QPainter& painter) const;

  std::unique_ptr<PlaneScene> plane_;
  std::shared_ptr<const transport::MatrixPictures> matrix_;
  Answer shown_;
  ColourScale scale_{ColourMap::viridis, 1e-5, 1e-1, true};
  bool wanted_ = false;
  QRectF lookedBefore_;
  QTimer still_;  // runs while the view moves
  Latest<Answer> asking_;
};

}  // namespace relucent::gui
