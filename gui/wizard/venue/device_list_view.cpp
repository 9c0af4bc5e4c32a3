// SPDX-License-Identifier: MIT
#include "wizard/venue/device_list_view.h"

#include <QLineEdit>
#include <QToolButton>
#include <functional>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/venue_page.h"

namespace relucent::gui {
namespace {

/// A line whose focus tells.
class NameLine : public QLineEdit {
 public:
  std::function<void()> reached;

 protected:
  void focusInEvent(QFocusEvent* event) override {
    QLineEdit::focusInEvent(event);
    if (reached) reached();
  }
};

class DeviceRow : public QWidget {
 public:
  explicit DeviceRow(const QString& objectName) {
    setObjectName(objectName);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    auto* line = new QHBoxLayout;
    column->addLayout(line);
    line->addWidget(name = new NameLine, 1);
    line->addWidget(remove = toolOf(Icon::remove, {}));
    column->addWidget(facts = elidedLabel("note"));
  }
  NameLine* name;
  QToolButton* remove;
  ElidedLabel* facts;
};

/// Rows that are kept while their number stays: nobody loses the focus in a name that he types.
class DeviceRows : public QWidget {
 public:
  DeviceRows(QString objectName, std::function<void(std::size_t, DeviceRow&)> connectRow)
      : objectName_(std::move(objectName)), connectRow_(std::move(connectRow)) {
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(0, 0, 0, 0);
  }
  void setCount(std::size_t count) {
    while (rows_.size() > count) {
      rows_.back()->hide();
      rows_.back()->deleteLater();
      rows_.pop_back();
    }
    while (rows_.size() < count) {
      auto* row = new DeviceRow(QString("%1-%2").arg(objectName_).arg(rows_.size() + 1));
      connectRow_(rows_.size(), *row);
      column_->addWidget(row);
      rows_.push_back(row);
    }
  }
  DeviceRow& row(std::size_t index) { return *rows_[index]; }

 private:
  QString objectName_;
  std::function<void(std::size_t, DeviceRow&)> connectRow_;
  QVBoxLayout* column_;
  std::vector<DeviceRow*> rows_;
};

void showName(DeviceRow& row, const std::string& name, const QString& usual, const QString& remove) {
  if (!row.name->hasFocus()) row.name->setText(QString::fromStdString(name));
  row.name->setPlaceholderText(usual);
  row.name->setAccessibleName(VenuePage::tr("Name of %1").arg(usual));
  row.remove->setAccessibleName(remove);
  row.remove->setToolTip(remove);
}

}  // namespace

QWidget* projectorList(VenuePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(VenuePage::tr("Projectors"), "section"));
  QLabel* none = labelOf(VenuePage::tr("None chosen yet."), "note");
  column->addWidget(none);
  auto* rows = new DeviceRows("venue-projector", [&model](std::size_t index, DeviceRow& row) {
    row.name->reached = [&model, index] { model.selectProjector(index); };
    QObject::connect(row.name, &QLineEdit::textEdited, &model,
                     [&model, index](const QString& name) { model.nameProjector(index, name); });
    QObject::connect(row.remove, &QToolButton::clicked, &model,
                     [&model, index] { model.removeProjector(index); });
  });
  column->addWidget(rows);
  auto* add = new ActionButton(VenuePage::tr("Add a projector"));
  add->setObjectName("add-projector");
  QObject::connect(add, &QPushButton::clicked, &model, &VenuePage::addProjector);
  column->addWidget(add);
  auto refresh = [&model, none, rows, add] {
    const auto screens = model.projectors();
    none->setVisible(screens.empty());
    add->setVisible(!screens.empty());
    add->setWhyNot(model.mayAddProjector() ? QString() : VenuePage::tr("No other screen is plugged in."));
    rows->setCount(screens.size());
    for (std::size_t i = 0; i < screens.size(); ++i) {
      DeviceRow& row = rows->row(i);
      const QString usual = VenuePage::tr("Projector %1").arg(i + 1);
      showName(row, screens[i].name, usual, VenuePage::tr("Remove projector %1").arg(i + 1));
      const QString connector = QString::fromStdString(screens[i].display.connector);
      const QString size = sizeText(screens[i].projector.width, screens[i].projector.height);
      const bool isThere = model.isPluggedIn(screens[i]);
      const QString screen = isThere ? VenuePage::tr("%1, %2").arg(connector, size)
                                     : VenuePage::tr("%1, %2, unplugged").arg(connector, size);
      const bool isSelected = screens.size() > 1 && i == model.projector();
      row.facts->setWhole(isSelected ? VenuePage::tr("%1: choose its screen").arg(screen) : screen);
      setRole(row.facts, !isThere ? "amber" : isSelected ? "strong" : "note");
      row.remove->setVisible(screens.size() > 1);
    }
  };
  refreshOn(model, part, refresh, &VenuePage::settingsChanged);
  return part;
}

QWidget* cameraList(VenuePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(VenuePage::tr("Cameras"), "section"));
  auto* rows = new DeviceRows("venue-camera", [&model](std::size_t index, DeviceRow& row) {
    QObject::connect(row.name, &QLineEdit::textEdited, &model,
                     [&model, index](const QString& name) { model.nameCamera(index, name); });
    QObject::connect(row.remove, &QToolButton::clicked, &model, [&model, index] {
      if (index < model.cameras().size()) model.removeCamera(model.cameras()[index].address);
    });
  });
  column->addWidget(rows);
  QLabel* note = labelOf({}, "note");
  note->setObjectName("cameras-note");
  column->addWidget(note);
  auto refresh = [&model, rows, note] {
    const auto cameras = model.cameras();
    rows->setCount(cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const QString usual = VenuePage::tr("Camera %1").arg(i + 1);
      showName(rows->row(i), cameras[i].name, usual, VenuePage::tr("Remove camera %1").arg(i + 1));
      rows->row(i).facts->setWhole(QString::fromStdString(cameras[i].address));
    }
    note->setVisible(cameras.size() != 1);
    note->setText(cameras.empty() ? VenuePage::tr("Add one from the list, or choose it at the next step.")
                                  : VenuePage::tr("Content is placed in the view of the first one."));
  };
  refreshOn(model, part, refresh, &VenuePage::settingsChanged);
  return part;
}

}  // namespace relucent::gui
