// SPDX-License-Identifier: MIT
#include "views/plane_scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTexture.h>

#include <optional>
#include <utility>

#include "relucent/base/error.h"
#include "theme/tokens.h"
#include "views/vtk_image.h"
#include "views/vtk_view.h"

namespace relucent::gui {

/// A rectangle with a picture on it.
struct PlaneScene::Layer {
  QImage picture;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> places;  // of the corners in the picture
  vtkNew<vtkPolyData> rectangle;
  vtkNew<vtkTexture> texture;
  vtkNew<vtkActor> actor;

  explicit Layer(double height) {
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(4);
    for (vtkIdType i = 0; i < 4; ++i) points->SetPoint(i, 0.0, 0.0, height);
    places->SetNumberOfComponents(2);
    places->SetNumberOfTuples(4);
    places->Fill(0.0);
    vtkNew<vtkCellArray> cells;
    vtkIdType corners[] = {0, 1, 2, 3};
    cells->InsertNextCell(4, corners);
    rectangle->SetPoints(points);
    rectangle->SetPolys(cells);
    rectangle->GetPointData()->SetTCoords(places);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(rectangle);
    actor->SetMapper(mapper);
    actor->SetTexture(texture);
    actor->GetProperty()->LightingOff();
    actor->VisibilityOff();
    texture->RepeatOff();
    height_ = height;
  }
  void corner(vtkIdType i, QPointF place, QPointF share) {
    points->SetPoint(i, place.x(), place.y(), height_);
    float pair[] = {static_cast<float>(share.x()), static_cast<float>(share.y())};
    places->SetTypedTuple(i, pair);
  }
  double height_ = 0.0;
};

struct PlaneScene::Parts {
  std::vector<std::unique_ptr<Layer>> layers;
  vtkNew<vtkScalarBarActor> bar;
  vtkNew<vtkCamera> camera;
  vtkNew<vtkLookupTable> colours;
  QSize size{1, 1};
  bool shown = true;
  std::optional<ColourMap> barMap;
};

PlaneScene::PlaneScene(VtkView& view) : view_(view), parts_(std::make_unique<Parts>()) {
  const QColor& ground = colours(Look::dark).picture;
  view.renderer().SetBackground(ground.redF(), ground.greenF(), ground.blueF());
  parts_->colours->SetNumberOfTableValues(256);
  vtkScalarBarActor* bar = parts_->bar;
  bar->SetLookupTable(parts_->colours);
  bar->SetMaximumNumberOfColors(256);
  // Words are Qt's, in the program's type and the user's language.
  bar->DrawTickLabelsOff();
  bar->DrawAnnotationsOff();
  bar->SetNumberOfLabels(0);
  bar->SetTitle("");
  bar->SetBarRatio(1.0);
  bar->SetTextPad(0);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->VisibilityOff();
  view.renderer().AddActor2D(bar);
  view.renderer().SetActiveCamera(parts_->camera);
}

PlaneScene::~PlaneScene() = default;

int PlaneScene::addLayer() {
  parts_->layers.push_back(std::make_unique<Layer>(static_cast<double>(parts_->layers.size())));
  view_.renderer().AddActor(parts_->layers.back()->actor);
  return static_cast<int>(parts_->layers.size()) - 1;
}

void PlaneScene::setPicture(int number, const QImage& picture) {
  Layer& layer = *parts_->layers.at(static_cast<std::size_t>(number));
  if (layer.picture.cacheKey() == picture.cacheKey()) return;
  layer.picture = picture;
  if (picture.isNull()) return;
  layer.texture->SetInputData(vtkImageOf(picture));
  // Else VTK looks for itself, at every pixel.
  layer.actor->SetForceOpaque(!picture.hasAlphaChannel());
  layer.actor->SetForceTranslucent(picture.hasAlphaChannel());
}

const QImage& PlaneScene::picture(int layer) const {
  return parts_->layers.at(static_cast<std::size_t>(layer))->picture;
}

void PlaneScene::place(int number, const QRectF& target, const QRectF& frame, double brightness,
                       bool smooth) {
  Layer& layer = *parts_->layers.at(static_cast<std::size_t>(number));
  QRectF seen = target & frame;
  layer.actor->SetVisibility(parts_->shown && !layer.picture.isNull() && !seen.isEmpty());
  if (seen.isEmpty()) return;
  // VTK counts from below.
  auto set = [&](vtkIdType i, QPointF place) {
    layer.corner(
        i, {place.x(), parts_->size.height() - place.y()},
        {(place.x() - target.left()) / target.width(), 1.0 - (place.y() - target.top()) / target.height()});
  };
  set(0, seen.bottomLeft());
  set(1, seen.bottomRight());
  set(2, seen.topRight());
  set(3, seen.topLeft());
  layer.points->Modified();
  layer.places->Modified();
  layer.rectangle->Modified();
  layer.actor->GetProperty()->SetColor(brightness, brightness, brightness);
  layer.texture->SetInterpolate(smooth);
}

void PlaneScene::setShown(bool shown) {
  parts_->shown = shown;
  if (shown) return view_.renderer().SetActiveCamera(parts_->camera);
  for (auto& layer : parts_->layers) layer->actor->VisibilityOff();
}

void PlaneScene::placeBar(const QRectF& bar, const ColourScale& scale) {
  parts_->bar->SetVisibility(!bar.isEmpty());
  if (bar.isEmpty()) return;
  // VTK makes everything again when any of it is said again.
  if (std::exchange(parts_->barMap, scale.map) != scale.map)
    for (int i = 0; i < 256; ++i) {
      QColor colour = qtColourAt(scale.map, i / 255.0);
      parts_->colours->SetTableValue(i, colour.redF(), colour.greenF(), colour.blueF(), 1.0);
    }
  double width = parts_->size.width(), height = parts_->size.height();
  parts_->bar->SetPosition(bar.left() / width, 1.0 - bar.bottom() / height);
  parts_->bar->SetWidth(bar.width() / width);
  parts_->bar->SetHeight(bar.height() / height);
}

void PlaneScene::fill(QSize size) {
  parts_->size = size.expandedTo({1, 1});
  double x = parts_->size.width() / 2.0, y = parts_->size.height() / 2.0;
  vtkCamera* camera = parts_->camera;
  camera->ParallelProjectionOn();
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetFocalPoint(x, y, 0.0);
  camera->SetPosition(x, y, 100.0);
  camera->SetParallelScale(y);
  camera->SetClippingRange(1.0, 200.0);
}

}  // namespace relucent::gui
