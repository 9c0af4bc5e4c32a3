// SPDX-License-Identifier: MIT
#include "wizard/devices/device_selector.h"

#include "wizard/session/device_label.h"

namespace relucent::gui {

DeviceSelector::DeviceSelector(Kind kind, DevicePage& page, QWidget* parent)
    : QComboBox(parent), kind_(kind), page_(page) {
  bool projector = kind == Kind::projector;
  setObjectName(projector ? "shown-projector" : "shown-camera");
  setAccessibleName(projector ? tr("Projector that is shown") : tr("Camera that is shown"));
  connect(this, &QComboBox::activated, &page_, [this, projector](int index) {
    auto device = static_cast<std::size_t>(index);
    projector ? page_.showProjector(device) : page_.showCamera(device);
  });
  for (auto signal : {&PageModel::settingsChanged, &PageModel::resultChanged})
    connect(&page_, signal, this, &DeviceSelector::refresh);
  refresh();
}

void DeviceSelector::refresh() {
  std::size_t devices = kind_ == Kind::projector ? page_.projectors() : page_.cameras();
  QStringList names, shown;
  for (std::size_t device = 0; device < devices; ++device)
    names << (kind_ == Kind::projector ? projectorLabel(page_.session(), device)
                                       : cameraLabel(page_.session(), device));
  for (int i = 0; i < count(); ++i) shown << itemText(i);
  if (shown != names) {
    clear();
    addItems(names);
  }
  setCurrentIndex(static_cast<int>(kind_ == Kind::projector ? page_.projector() : page_.camera()));
  setVisible(devices > 1);
}

}  // namespace relucent::gui
