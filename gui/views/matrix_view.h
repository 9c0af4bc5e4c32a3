// SPDX-License-Identifier: MIT
#pragma once

#include <QTimer>
#include <memory>

#include "image/image.h"
#include "jobs/latest.h"
#include "transport/matrix_density.h"
#include "views/colour_map.h"
#include "views/plane_view.h"

namespace relucent {

class PlaneScene;

/// T from all of it to single entries: rows are camera pixels, columns projector pixels, colours the mean
/// light of the entries in a screen's pixel on a logarithmic scale. Whatever is moved is seen at once, in the
/// picture that is there; a sharper one of what is looked at is made on another thread and takes its place:
/// while the view moves, and first, an estimate from some of the rows, then the exact one. The pick is
/// (column, row); a lens in a corner shows what is round it. Where there is no OpenGL a sentence says so.
class MatrixView : public PlaneView {
  Q_OBJECT

 public:
  explicit MatrixView(QWidget* parent = nullptr);
  ~MatrixView() override;

  /// None: nullptr.
  void setMatrix(std::shared_ptr<const MatrixPictures> matrix);
  /// No sharper or exact picture is to come.
  bool isSettled() const { return !asking_.isBusy() && !wanted_; }

  /// The entries that are seen.
  MatrixPart seen() const;
  /// Mean light of the entries in the finest picture's cell over a column and row; none where nothing is
  /// known yet.
  std::optional<float> valueAt(QPoint entry) const;
  /// That picture's numbers, of what is seen. One channel; empty until they are exact.
  Image values() const;
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
    std::shared_ptr<const MatrixDensity> density;
    std::vector<float> means;
    QImage image;
  };
  struct Answer {
    std::shared_ptr<const MatrixPictures> of;
    Picture whole, detail, lens;
    ColourScale scale;
    bool exact = false, exactWhole = false;
  };
  /// Entries of the plane that are seen, in shares of pixels.
  QRectF looked() const;
  QRectF barArea() const;
  MatrixPart partFor(const QRectF& looked, Size& cells) const;
  bool isSharp() const;
  /// What the lens shows, and where it lies; none without a pick in sight or among single entries.
  std::optional<MatrixPart> lensPart() const;
  QRectF lensFrame() const;
  bool hasLens() const;
  void want();
  void take(Answer answer);
  static Picture pictureOf(const MatrixPictures& matrix, const MatrixPart& part, Size cells,
                           std::size_t step = 1);
  QRectF targetOf(const MatrixPart& part) const;
  const Picture* finestAt(QPoint entry) const;
  void paintAxes(QPainter& painter) const;
  void paintCross(QPainter& painter) const;
  void paintLens(QPainter& painter) const;

  std::unique_ptr<PlaneScene> plane_;
  std::shared_ptr<const MatrixPictures> matrix_;
  Answer shown_;
  ColourScale scale_{ColourMap::viridis, 1e-5, 1e-1, true};
  bool wanted_ = false;
  QRectF lookedBefore_;
  QTimer still_;  // runs while the view moves
  Latest<Answer> asking_;
};

}  // namespace relucent
