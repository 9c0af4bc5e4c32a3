// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_choice_view.h"

#include "relucent/base/message.h"
#include "text/message_text.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/camera/camera_page.h"

namespace relucent::gui {
namespace {

QString traitsText(const devices::CameraTraits& traits) {
  return CameraPage::tr("%1 pixels, %n bit(s), exposures %2 to %3", nullptr, traits.format.bits)
      .arg(sizeText(traits.size.width, traits.size.height), exposureText(traits.exposures.shortest),
           exposureText(traits.exposures.longest));
}

class CameraRow : public QFrame {
 public:
  CameraRow(CameraPage& model, const devices::ListedCamera& camera) {
    setRole(this, "card");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(16, 10, 12, 10);
    row->addWidget(new IconLabel(camera.usable ? Icon::camera : Icon::warning, secondaryColour, 24));
    row->addSpacing(8);
    auto* texts = new QVBoxLayout;
    texts->setSpacing(2);
    const QString name = text(camera.model);
    texts->addWidget(labelOf(name, "strong"));
    texts->addWidget(labelOf(QString::fromStdString(camera.address), "note"));
    if (camera.usable) {
      texts->addWidget(labelOf(traitsText(camera.traits), "note"));
      for (const Message& remark : camera.traits.remarks)
        texts->addWidget(labelOf(fullSentence(remark), "note"));
    } else {
      texts->addWidget(
          labelOf(CameraPage::tr("Cannot be used: %1").arg(fullSentence(camera.problem)), "note"));
    }
    row->addLayout(texts, 1);
    QPushButton* choose = buttonOf(CameraPage::tr("Choose"));
    choose->setAccessibleName(CameraPage::tr("Choose %1").arg(name));
    choose->setEnabled(camera.usable);
    QObject::connect(choose, &QPushButton::clicked, &model,
                     [&model, address = camera.address] { model.chooseCamera(address); });
    row->addWidget(choose);
  }
};

class CameraChoice : public Card {
 public:
  explicit CameraChoice(CameraPage& model) : Card(CameraPage::tr("Cameras")), model_(model) {
    setSubtitle(CameraPage::tr("Choose the one that looks at the surface."));
    again_ = buttonOf(CameraPage::tr("Look again"));
    addAction(again_);
    connect(again_, &QPushButton::clicked, &model, &CameraPage::listCameras);
    connect(&model, &CameraPage::camerasListed, this, [this] { fill(); });
    fill();
  }

 private:
  void fill() {
    again_->setEnabled(!model_.isListing());
    while (QLayoutItem* item = body()->takeAt(0)) {
      delete item->widget();
      delete item;
    }
    const devices::CameraList& devices = model_.cameras();
    for (const devices::ListedCamera& camera : devices.cameras)
      body()->addWidget(new CameraRow(model_, camera));
    if (devices.cameras.empty())
      body()->addWidget(labelOf(model_.isListing()
                                    ? CameraPage::tr("Looking for cameras")
                                    : CameraPage::tr("No camera answers. Check its cable and its power."),
                                "secondary"));
    for (const devices::CameraSupport& kind : devices.support)
      if (!kind.available) body()->addWidget(labelOf(fullSentence(kind.sentence), "note"));
    static_cast<QBoxLayout*>(body())->addStretch(1);
  }

  CameraPage& model_;
  QPushButton* again_;
};

}  // namespace

QWidget* cameraChoice(CameraPage& model) {
  return new CameraChoice(model);
}

}  // namespace relucent::gui
