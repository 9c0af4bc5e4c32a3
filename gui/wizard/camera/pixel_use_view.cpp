// SPDX-License-Identifier: MIT
#include "wizard/camera/pixel_use_view.h"

#include <QComboBox>

#include "relucent/base/time_left.h"
#include "text/message_text.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

QString nameOf(const pipeline::PixelForecast& forecast) {
  using Use = reduction::PixelUse::Kind;
  const QString size = sizeText(forecast.used.width, forecast.used.height);
  switch (forecast.use.kind) {
    case Use::automatic:
      return CameraPage::tr("As many as needed: %1").arg(size);
    case Use::all:
      return CameraPage::tr("All: %1").arg(size);
    case Use::binned:
      break;
  }
  const QString bin = sizeText(forecast.use.bin, forecast.use.bin);
  return CameraPage::tr("%1 become one: %2").arg(bin, size);
}

class PixelUseView : public QWidget {
 public:
  explicit PixelUseView(CameraPage& model) : model_(model) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->addWidget(lineOf());
    rows->addWidget(labelOf(CameraPage::tr("Camera pixels"), "section"));
    box_ = new QComboBox;
    box_->setObjectName("camera-pixels");
    box_->setAccessibleName(CameraPage::tr("Camera pixels that are used"));
    rows->addWidget(box_);
    memory_ = new ValueRow(CameraPage::tr("Memory"));
    disk_ = new ValueRow(CameraPage::tr("Disk"));
    time_ = new ValueRow(CameraPage::tr("Time"));
    for (ValueRow* row : {memory_, disk_, time_}) rows->addWidget(row);
    rows->addWidget(labelOf(CameraPage::tr("More camera pixels than projector pixels show nothing more. The "
                                           "photographs that prove the result stay as large as they are."),
                            "note"));
    QObject::connect(box_, &QComboBox::activated, &model, [&model](int index) {
      model.choosePixels(model.pixelForecasts()[static_cast<std::size_t>(index)].use);
    });
    refreshOn(model, this, [this] { refresh(); }, &CameraPage::settingsChanged, &CameraPage::resultChanged);
  }

 private:
  void refresh() {
    const std::vector<pipeline::PixelForecast>& forecasts = model_.pixelForecasts();
    setVisible(!forecasts.empty());
    QStringList names;
    int current = -1;
    for (const pipeline::PixelForecast& forecast : forecasts) {
      if (forecast.use == model_.pixels()) current = static_cast<int>(names.size());
      names << nameOf(forecast);
    }
    QStringList shown;
    for (int i = 0; i < box_->count(); ++i) shown << box_->itemText(i);
    if (shown != names) {
      box_->clear();
      box_->addItems(names);
    }
    box_->setCurrentIndex(current);  // -1: chosen elsewhere
    const bool known = current >= 0;
    const WorkLeft work = known ? forecasts[static_cast<std::size_t>(current)].work : WorkLeft();
    const QString none = QString::fromUtf8("–");
    memory_->setValue(known ? bytesText(work.memoryBytes) : none);
    disk_->setValue(known ? bytesText(work.diskBytes) : none);
    time_->setValue(known ? text(expectedDuration(work.seconds)) : none);
  }

  CameraPage& model_;
  QComboBox* box_;
  ValueRow *memory_, *disk_, *time_;
};

}  // namespace

QWidget* pixelUseView(CameraPage& model) {
  return new PixelUseView(model);
}

}  // namespace relucent::gui
