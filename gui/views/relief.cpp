// SPDX-License-Identifier: MIT
#include "views/relief.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "views/vtk_image.h"
#include "views/vtk_view.h"

namespace relucent::gui {
namespace {

constexpr int mostPoints = 200;  // along the longer side: software rendering turns it smoothly
constexpr double height = 0.16;  // of the longer side

/// The mean of those values of a cell that are numbers; NaN where none is.
float meanOf(const image::Image& map, int x0, int y0, int step) {
  double sum = 0.0;
  int count = 0;
  for (int y = y0; y < std::min(y0 + step, map.height()); ++y)
    for (int x = x0; x < std::min(x0 + step, map.width()); ++x)
      if (float value = map.at(x, y, 0); std::isfinite(value)) {
        sum += static_cast<double>(value);
        ++count;
      }
  return count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN();
}

/// Neighbours weigh in, once and again: single pixels would stand as spikes and hide what lies behind them.
/// Where there is no value there is none afterwards.
void smooth(image::Image& heights) {
  constexpr int passes = 2;
  constexpr float weights[] = {1.0f, 2.0f, 1.0f};
  for (int pass = 0; pass < passes; ++pass) {
    image::Image before = heights;
    for (int y = 0; y < heights.height(); ++y)
      for (int x = 0; x < heights.width(); ++x) {
        if (std::isnan(before.at(x, y, 0))) continue;
        float sum = 0.0f, weight = 0.0f;
        for (int j = std::max(0, y - 1); j <= std::min(y + 1, heights.height() - 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(x + 1, heights.width() - 1); ++i) {
            if (std::isnan(before.at(i, j, 0))) continue;
            float share = weights[j - y + 1] * weights[i - x + 1];
            sum += share * before.at(i, j, 0);
            weight += share;
          }
        heights.at(x, y, 0) = sum / weight;
      }
  }
}

vtkSmartPointer<vtkPolyData> groundOf(const image::Image& map, const ColourScale& scale) {
  int step = std::max(1, (std::max(map.width(), map.height()) + mostPoints - 1) / mostPoints);
  int columns = (map.width() + step - 1) / step, rows = (map.height() + step - 1) / step;
  double up = height * std::max(map.width(), map.height());
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  image::Image heights({columns, rows}, 1);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      heights.at(i, j, 0) =
          static_cast<float>(scale.place(static_cast<double>(meanOf(map, i * step, j * step, step))));
  smooth(heights);
  std::vector<std::uint8_t> known;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      auto place = static_cast<double>(heights.at(i, j, 0));
      known.push_back(!std::isnan(place));
      double x = (i + 0.5) * step, y = (j + 0.5) * step;
      points->InsertNextPoint(x, map.height() - y, known.back() != 0 ? up * place : 0.0);
      float share[] = {static_cast<float>(x / map.width()), static_cast<float>(1.0 - y / map.height())};
      places->InsertNextTypedTuple(share);
    }
  vtkNew<vtkCellArray> cells;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      vtkIdType first = static_cast<vtkIdType>(j) * columns + i;
      vtkIdType corners[] = {first + columns, first + columns + 1, first + 1, first};
      if (std::all_of(std::begin(corners), std::end(corners),
                      [&](vtkIdType corner) { return known[static_cast<std::size_t>(corner)] != 0; }))
        cells->InsertNextCell(4, corners);
    }
  auto ground = vtkSmartPointer<vtkPolyData>::New();
  ground->SetPoints(points);
  ground->SetPolys(cells);
  ground->GetPointData()->SetTCoords(places);
  return ground;
}

}  // namespace

struct Relief::Parts {
  /// Turns by the mouse; VTK's own letter keys, as "stereo", would only surprise.
  class TurningStyle : public vtkInteractorStyleTrackballCamera {
   public:
    static TurningStyle* New() {
      auto* style = new TurningStyle;
      style->InitializeObjectBase();
      return style;
    }
    void OnChar() override {}
  };

  vtkNew<vtkActor> actor;
  vtkNew<vtkPolyDataNormals> normals;
  vtkNew<vtkTexture> texture;
  vtkNew<vtkCamera> camera;
  vtkNew<TurningStyle> style;
  bool placed = false;
};

Relief::Relief(VtkView& view) : view_(view), parts_(std::make_unique<Parts>()) {
  parts_->normals->SplittingOff();
  parts_->normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(parts_->normals->GetOutputPort());
  parts_->texture->InterpolateOn();
  parts_->actor->SetMapper(mapper);
  parts_->actor->SetTexture(parts_->texture);
  parts_->actor->GetProperty()->SetAmbient(0.35);
  parts_->actor->GetProperty()->SetDiffuse(0.75);
  parts_->actor->VisibilityOff();
  view.renderer().AddActor(parts_->actor);
}

Relief::~Relief() = default;

void Relief::set(const image::Image& map, const ColourScale& scale, const QImage& picture) {
  require(map.channels() == 1 && !picture.isNull(), "a map of {} channels", map.channels());
  parts_->normals->SetInputData(groundOf(map, scale));
  parts_->texture->SetInputData(vtkImageOf(picture));
}

void Relief::setShown(bool shown, double beside) {
  parts_->actor->SetVisibility(shown);
  view_.interactor().SetInteractorStyle(shown ? parts_->style.Get() : nullptr);
  if (!shown) return;
  view_.renderer().SetActiveCamera(parts_->camera);
  parts_->camera->SetWindowCenter(beside, 0.0);
  if (!std::exchange(parts_->placed, true)) reset();
}

void Relief::turn(double right, double up) {
  parts_->camera->Azimuth(-right);
  parts_->camera->Elevation(up);
  parts_->camera->OrthogonalizeViewUp();
  view_.renderer().ResetCameraClippingRange();
  view_.redraw();
}

void Relief::approach(double factor) {
  parts_->camera->Dolly(factor);
  view_.renderer().ResetCameraClippingRange();
  view_.redraw();
}

void Relief::reset() {
  parts_->camera->SetFocalPoint(0.0, 0.0, 0.0);
  parts_->camera->SetPosition(0.0, -1.0, 1.3);
  parts_->camera->SetViewUp(0.0, 0.0, 1.0);
  view_.renderer().ResetCamera();
  parts_->camera->Dolly(1.1);
  view_.renderer().ResetCameraClippingRange();
  view_.redraw();
}

}  // namespace relucent::gui
