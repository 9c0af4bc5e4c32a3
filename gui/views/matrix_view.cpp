// SPDX-License-Identifier: MIT
#include "views/matrix_view.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "views/colour_bar.h"
#include "views/matrix_cells.h"
#include "views/number_text.h"
#include "views/plane_scene.h"
#include "views/raster_axis.h"
#include "views/vtk_view.h"

namespace relucent::gui {
namespace {

constexpr double rowsWidth = 52.0, columnsHeight = 34.0, barWidth = 64.0, margin = 8.0, titleHeight = 18.0;
constexpr double around = 0.3;        // of what is seen, on each side, so that a short pan needs nothing new
constexpr double decades = 4.0;       // that colours tell apart
constexpr double lensShare = 0.4;     // of the frame's shorter side
constexpr double lensPower = 4.0;     // more than the view round it
constexpr double entryPixels = 48.0;  // of a single entry at the highest magnification

constexpr int stillAfter = 150;         // milliseconds without a move
constexpr std::size_t sampledRows = 8;  // of a cell, for an estimate

enum MatrixLayer { wholeLayer, detailLayer, lensLayer };

/// From the brightest cell some decades down. In half decades, so that the colours stay while one pans.
ColourScale scaleOf(const std::vector<float>& means) {
  float most = 0.0f;
  for (float value : means) most = std::max(most, value);
  double high =
      most > 0.0f ? std::pow(10.0, std::ceil(2.0 * std::log10(static_cast<double>(most))) / 2.0) : 1.0;
  return {ColourMap::viridis, high * std::pow(10.0, -decades), high, true};
}

}  // namespace

MatrixView::MatrixView(QWidget* parent)
    : PlaneView(parent),
      asking_([this](Answer answer) { take(std::move(answer)); },
              [this](const Failure& failure) { setEmptyText(failure.what); }) {
  useVtk();
  plane_ = std::make_unique<PlaneScene>(*vtk());
  for (MatrixLayer layer : {wholeLayer, detailLayer, lensLayer})
    require(plane_->addLayer() == layer, "layers");
  still_.setSingleShot(true);
  still_.setInterval(stillAfter);
  connect(&still_, &QTimer::timeout, this, [this] { want(); });
  setReadout([this](QPoint entry) {
    if (!QRect(QPoint(), planeSize()).contains(entry)) return QString();
    QString place =
        tr("camera %1\nprojector %2")
            .arg(pixelText(matrix_->transport().cameras(), static_cast<std::size_t>(entry.y())),
                 pixelText(matrix_->transport().projectors(), static_cast<std::size_t>(entry.x())));
    std::optional<float> value = valueAt(entry);
    return value ? tr("%1\n%2").arg(place, numberText(static_cast<double>(*value))) : place;
  });
}

MatrixView::~MatrixView() = default;

void MatrixView::setMatrix(std::shared_ptr<const transport::MatrixPictures> matrix) {
  bool other = !matrix || !matrix_ || &matrix->transport() != &matrix_->transport();
  matrix_ = std::move(matrix);
  if (other) {
    shown_ = {};
    plane_->setPicture(wholeLayer, {});
    plane_->setPicture(detailLayer, {});
    plane_->setPicture(lensLayer, {});
  }
  if (matrix_ && other) {
    QSize plane = planeSize();
    double most = entryPixels * std::max(plane.width() / 200.0, plane.height() / 200.0);
    link().setMostZoom(std::max(4.0, most));
    link().look(1.0, {0.5, 0.5});
  }
  refresh();
}

QSize MatrixView::planeSize() const {
  if (!matrix_) return {};
  transport::MatrixPart all = matrix_->whole();
  return {static_cast<int>(all.columns()), static_cast<int>(all.rows())};
}

QRectF MatrixView::frame() const {
  return QRectF(rect()).adjusted(rowsWidth, margin, -barWidth - margin, -columnsHeight);
}

QRectF MatrixView::barArea() const {
  // The axes' title may be as wide as the view.
  return QRectF(frame().right() + margin, 0, barWidth, height() - titleHeight);
}

QRectF MatrixView::looked() const {
  QRectF area = frame();
  QPointF from = pictureFromWidget(area.topLeft()), to = pictureFromWidget(area.bottomRight());
  return QRectF(from, to) & QRectF(QPointF(), QSizeF(planeSize()));
}

transport::MatrixPart MatrixView::seen() const {
  QRectF part = looked();
  return {
      static_cast<std::size_t>(std::floor(part.top())), static_cast<std::size_t>(std::ceil(part.bottom())),
      static_cast<std::size_t>(std::floor(part.left())), static_cast<std::size_t>(std::ceil(part.right()))};
}

/// What to make a picture of, so that `looked` and what is round it are sharp.
transport::MatrixPart MatrixView::partFor(const QRectF& part, Size& cells) const {
  double ratio = devicePixelRatioF();
  QRectF wide = part.adjusted(-around * part.width(), -around * part.height(), around * part.width(),
                              around * part.height()) &
                QRectF(QPointF(), QSizeF(planeSize()));
  transport::MatrixPart found;
  transport::MatrixPart all = matrix_->whole();
  const Rasters &projectors = matrix_->transport().projectors(), &cameras = matrix_->transport().cameras();
  fitCells(wide.left(), wide.right(), all.columns(),
           entriesOfACell(part.width(), ratio * frame().width(), projectors.size(0).width), found.firstColumn,
           found.endColumn, cells.width);
  fitCells(wide.top(), wide.bottom(), all.rows(),
           entriesOfACell(part.height(), ratio * frame().height(), cameras.size(0).width), found.firstRow,
           found.endRow, cells.height);
  return found;
}

/// The picture that is there is as sharp as the screen and reaches as far as one sees.
bool MatrixView::isSharp() const {
  if (shown_.of != matrix_ || !shown_.detail.density) return false;
  const transport::MatrixDensity& have = *shown_.detail.density;
  QRectF part = looked();
  Size cells;
  transport::MatrixPart wanted = partFor(part, cells);
  auto length = [](std::size_t entries, int count) { return static_cast<double>(entries) / count; };
  bool fine = length(have.part.columns(), have.cells.width) <= 1.01 * length(wanted.columns(), cells.width) &&
              length(have.part.rows(), have.cells.height) <= 1.01 * length(wanted.rows(), cells.height);
  QRectF reach(QPointF(have.part.firstColumn, have.part.firstRow),
               QPointF(have.part.endColumn, have.part.endRow));
  // At the far border a cell's length may not come out even; what is left there is less than a pixel.
  double slackX = length(wanted.columns(), cells.width), slackY = length(wanted.rows(), cells.height);
  return fine && reach.adjusted(-slackX, -slackY, slackX, slackY).contains(part);
}

QRectF MatrixView::lensFrame() const {
  QRectF area = frame();
  double side = lensShare * std::min(area.width(), area.height());
  double gap = margin;
  QRectF right(area.right() - side - gap, area.top() + gap, side, side);
  QRectF left(area.left() + gap, area.bottom() - side - gap, side, side);
  QPointF pick = widgetFromPicture(QPointF(link().pick().value_or(QPoint())));
  // T is a band from upper left to lower right; beside it there is room.
  return right.adjusted(-gap, -gap, gap, gap).contains(pick) ? left : right;
}

std::vector<QRectF> MatrixView::keptFree() const {
  return hasLens() ? std::vector{lensFrame()} : std::vector<QRectF>();
}

std::optional<transport::MatrixPart> MatrixView::lensPart() const {
  std::optional<QPoint> pick = link().pick();
  if (!pick || !matrix_ || !looked().contains(QPointF(*pick) + QPointF(0.5, 0.5))) return std::nullopt;
  QRectF lens = lensFrame();
  QSizeF scale = fit() * link().zoom();
  QRectF part(0.0, 0.0, lens.width() / (scale.width() * lensPower),
              lens.height() / (scale.height() * lensPower));
  if (part.width() < 16.0 || part.height() < 16.0) return std::nullopt;
  part.moveCenter(QPointF(*pick));
  QSize plane = planeSize();
  part.moveLeft(std::clamp(part.left(), 0.0, std::max(0.0, plane.width() - part.width())));
  part.moveTop(std::clamp(part.top(), 0.0, std::max(0.0, plane.height() - part.height())));
  part &= QRectF(QPointF(), QSizeF(plane));
  return transport::MatrixPart{static_cast<std::size_t>(part.top()), static_cast<std::size_t>(part.bottom()),
                               static_cast<std::size_t>(part.left()), static_cast<std::size_t>(part.right())};
}

bool MatrixView::hasLens() const {
  return shown_.lens.density && lensPart() == shown_.lens.density->part;
}

MatrixView::Picture MatrixView::pictureOf(const transport::MatrixPictures& matrix,
                                          const transport::MatrixPart& part, Size cells, std::size_t step) {
  Picture picture;
  picture.density = std::make_shared<transport::MatrixDensity>(
      matrix.density(part, cells, transport::MatrixPictures::Of::light, step));
  picture.means = picture.density->means();
  return picture;
}

void MatrixView::want() {
  if (!matrix_ || !vtk()->works() || frame().isEmpty() || !isVisible()) return;
  std::optional<transport::MatrixPart> lens = lensPart();
  bool lensDone = shown_.of == matrix_ && (!lens || hasLens());
  bool sharp = isSharp();
  wanted_ = !sharp || !lensDone || !shown_.exact;
  if (!wanted_ || (sharp && lensDone && still_.isActive())) return;
  Size cells;
  transport::MatrixPart part = partFor(looked(), cells);
  // What is there already only lacks the other rows.
  std::size_t rows = part.rows() / static_cast<std::size_t>(cells.height);
  std::size_t step = sharp && !still_.isActive() ? 1 : std::max<std::size_t>(1, rows / sampledRows);
  bool reuse = shown_.of == matrix_ && (step > 1 || shown_.exactWhole);
  Picture whole = reuse ? shown_.whole : Picture();
  // An estimate's highest value is not one to change all colours for.
  std::optional<ColourScale> scale;
  if (step > 1 && shown_.of && matrix_ && &shown_.of->transport() == &matrix_->transport()) scale = scale_;
  int side = static_cast<int>(lensFrame().width() * devicePixelRatioF());
  asking_.ask([matrix = matrix_, part, cells, whole, lens, side, step, scale,
               exactWhole = reuse ? shown_.exactWhole : step == 1] {
    Answer answer{matrix, whole, pictureOf(*matrix, part, cells, step), {}, {}, step == 1, exactWhole};
    if (lens)
      answer.lens = pictureOf(*matrix, *lens,
                              {std::clamp(side, 1, static_cast<int>(lens->columns())),
                               std::clamp(side, 1, static_cast<int>(lens->rows()))});
    transport::MatrixPart all = matrix->whole();
    if (!answer.whole.density) {
      Size coarse{matrix->transport().projectors().size(0).height,
                  static_cast<int>(std::min<std::size_t>(all.rows(), 256))};
      answer.whole = pictureOf(*matrix, all, coarse, std::max<std::size_t>(1, step));
    }
    answer.scale = scale ? *scale : scaleOf(answer.detail.means);
    for (Picture* picture : {&answer.whole, &answer.detail, &answer.lens})
      if (picture->density) picture->image = mapped(picture->means, picture->density->cells, answer.scale);
    return answer;
  });
}

void MatrixView::take(Answer answer) {
  if (answer.of != matrix_ && (!matrix_ || &answer.of->transport() != &matrix_->transport())) return;
  scale_ = answer.scale;
  shown_ = std::move(answer);
  plane_->setPicture(wholeLayer, shown_.whole.image);
  plane_->setPicture(detailLayer, shown_.detail.image);
  plane_->setPicture(lensLayer, shown_.lens.image);
  refresh();
}

QRectF MatrixView::targetOf(const transport::MatrixPart& part) const {
  return QRectF(widgetFromPicture(QPointF(part.firstColumn, part.firstRow)),
                widgetFromPicture(QPointF(part.endColumn, part.endRow)));
}

void MatrixView::arrange() {
  plane_->fill(size());
  plane_->setShown(matrix_ != nullptr);
  if (QRectF now = matrix_ ? looked() : QRectF(); std::exchange(lookedBefore_, now) != now) still_.start();
  if (shown_.of && matrix_) {
    // What lies below cannot be seen, and drawing it takes as long.
    bool covered = targetOf(shown_.detail.density->part).contains(frame());
    for (auto [layer, picture] :
         {std::pair(wholeLayer, &shown_.whole), std::pair(detailLayer, &shown_.detail)}) {
      QRectF target = targetOf(picture->density->part);
      bool large = target.width() >= picture->density->cells.width &&
                   target.height() >= picture->density->cells.height;
      plane_->place(layer, layer == wholeLayer && covered ? QRectF() : target, frame(), 1.0, !large);
    }
  }
  QRectF lens = hasLens() ? lensFrame() : QRectF();
  plane_->place(lensLayer, lens, lens, 1.0, true);
  plane_->placeBar(matrix_ ? colourBarIn(barArea()) : QRectF(), scale_);
  want();
}

std::optional<float> MatrixView::valueAt(QPoint entry) const {
  if (!matrix_) return std::nullopt;
  const auto row = static_cast<std::size_t>(entry.y()), column = static_cast<std::size_t>(entry.x());
  return matrix_->density({row, row + 1, column, column + 1}, {1, 1}).sums.front();
}

image::Image MatrixView::values() const {
  if (!shown_.detail.density || !shown_.exact) return {};
  const transport::MatrixDensity& density = *shown_.detail.density;
  transport::MatrixPart wanted = seen();
  std::size_t firstRow = std::max(wanted.firstRow, density.part.firstRow);
  std::size_t firstColumn = std::max(wanted.firstColumn, density.part.firstColumn);
  std::size_t endRow = std::min(wanted.endRow, density.part.endRow);
  std::size_t endColumn = std::min(wanted.endColumn, density.part.endColumn);
  if (firstRow >= endRow || firstColumn >= endColumn) return {};
  Pixel first = density.cellOf(firstRow, firstColumn), last = density.cellOf(endRow - 1, endColumn - 1);
  image::Image image({last.x - first.x + 1, last.y - first.y + 1}, 1);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.at(x, y, 0) = shown_.detail.means[indexOf(density.cells, {first.x + x, first.y + y})];
  return image;
}

}  // namespace relucent::gui
