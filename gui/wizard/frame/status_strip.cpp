// SPDX-License-Identifier: MIT
#include "wizard/frame/status_strip.h"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLocale>
#include <algorithm>
#include <utility>

#include "jobs/free_space.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/patient_shot_log.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/session/device_label.h"
#include "wizard/session/missing_screen.h"

namespace relucent::gui {
namespace {

constexpr int namesFrom = 1100;  // logical pixels of width

/// As wide as its text, and narrower where there is no room.
class Fact : public ElidedLabel {
 public:
  Fact() { setRole(this, "note"); }
  QSize sizeHint() const override {
    return {fontMetrics().horizontalAdvance(accessibleName()) + 2, ElidedLabel::sizeHint().height()};
  }
  QSize minimumSizeHint() const override {
    return {std::min(least, sizeHint().width()), ElidedLabel::minimumSizeHint().height()};
  }

 private:
  static constexpr int least = 40;
};

/// Of a calibration: when anything of it was. Invalid: nothing is there.
QDateTime lastWritten(const std::filesystem::path& calibration) {
  return QFileInfo(
             QString::fromStdString((calibration / calibration::CalibrationFolder::manifestName).string()))
      .lastModified();
}

}  // namespace

StatusStrip::StatusStrip(Session& session, QWidget* parent) : QFrame(parent), session_(session) {
  setRole(this, "strip");
  setFixedHeight(space::statusStrip);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 0, space::page, 0);
  row->setSpacing(8);
  auto part = [&](Icon icon, const QString& name) {
    auto* group = new QWidget;
    auto* within = new QHBoxLayout(group);
    within->setContentsMargins(0, 0, 18, 0);
    within->setSpacing(8);
    within->addWidget(new IconLabel(icon, secondaryColour, 16));
    QLabel* title = labelOf(name, "strong");
    title->setWordWrap(false);
    names_.push_back(title);
    within->addWidget(title);
    auto* value = new Fact;
    within->addWidget(value);
    row->addWidget(group);
    return value;
  };
  projector_ = part(Icon::projector, tr("Projector"));
  camera_ = part(Icon::camera, tr("Camera"));
  disk_ = part(Icon::disk, tr("Disk"));
  roomLight_ = part(Icon::sun, tr("Room light"));
  roomLight_->setObjectName("room-light");
  projector_->setObjectName("strip-projector");
  camera_->setObjectName("strip-camera");
  disk_->setObjectName("strip-disk");
  room_ = roomLight_->parentWidget();
  row->addStretch(1);
  row->addWidget(saved_ = new Fact);
  saved_->setObjectName("strip-saved");
  often_.setInterval(5000);
  connect(&often_, &QTimer::timeout, this, &StatusStrip::refresh);
  for (auto signal :
       {&Session::opened, &Session::stepsChanged, &Session::devicesChanged, &Session::roomLightChanged})
    connect(&session_, signal, this, &StatusStrip::refresh);
  connect(qApp, &QGuiApplication::screenAdded, this, &StatusStrip::refresh);
  connect(qApp, &QGuiApplication::screenRemoved, this, &StatusStrip::refresh);
  often_.start();
  said_.setSingleShot(true);
  connect(&said_, &QTimer::timeout, this, [this] {
    setRole(saved_, "note");
    refresh();
  });
  refresh();
}

void StatusStrip::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  for (QLabel* name : names_) name->setVisible(width() >= namesFrom);
}

void StatusStrip::say(const QString& sentence) {
  constexpr int seconds = 8;
  said_.start(1000 * seconds);
  saved_->setWhole(sentence);
  setRole(saved_, "strong");
}

bool StatusStrip::isScreenThere() const {
  return missingScreen(session_).isEmpty();
}

/// Amber where measuring pauses for want of room.
void StatusStrip::showDisk(const QString& folder) {
  const auto bytes = freeBytesAt(folder);
  setRole(disk_, static_cast<std::uint64_t>(bytes) < calibration::PatientShotLog::spare ? "amber" : "note");
  disk_->setWhole(tr("%1 free").arg(bytesText(bytes)));
}

/// Its size, and what it is; that it is not there where nobody waits for it, either.
QString StatusStrip::projectorText() const {
  const QString missing = missingScreen(session_);
  const auto projectors = static_cast<int>(session_.projectors());
  Size size = session_.projectorSize();
  QString kind = session_.isSimulated() ? tr("simulated") : tr("by script");
  if (const pipeline::ScreenRigSettings* screen = session_.screenRig(); screen != nullptr && projectors == 1)
    kind = QString::fromStdString(screen->display.connector);
  else if (screen != nullptr)
    kind = tr("%n screen(s)", nullptr, projectors);
  if (!missing.isEmpty()) kind = tr("%1, unplugged").arg(missing);
  if (projectors == 1 || session_.screenRig() != nullptr)
    return QString("%1, %2").arg(sizeText(size.width, size.height), kind);
  return tr("%n with %1, %2", "projectors and their pixels", projectors)
      .arg(sizeText(size.width, size.height), kind);
}

void StatusStrip::showRoomLight() {
  const std::optional<RoomLight>& light = session_.roomLight();
  room_->setVisible(session_.isOpen() && light.has_value());
  if (!light) return;
  QString share = percentText(light->share);
  roomLight_->setWhole(light->isSteady ? tr("%1 of full light, steady").arg(share)
                                       : tr("%1 of full light, changed").arg(share));
  setRole(roomLight_, light->isSteady ? "note" : "amber");
}

void StatusStrip::refresh() {
  showRoomLight();
  if (!session_.isOpen()) {
    // What is chosen for a new venue is not in use yet.
    projector_->setWhole(tr("none in use"));
    camera_->setWhole(tr("none in use"));
    showDisk(QDir::homePath());
    if (!said_.isActive()) saved_->setWhole({});
    return;
  }
  // The room that a text needs depends on its role.
  setRole(projector_, isScreenThere() ? "note" : "amber");
  projector_->setWhole(projectorText());
  QString kind = session_.isSimulated() ? tr("simulated") : tr("by script");
  if (const pipeline::ScreenRigSettings* screen = session_.screenRig())
    kind = screen->cameraAddress.empty() ? tr("none chosen") : QString::fromStdString(screen->cameraAddress);
  if (const auto cameras = static_cast<int>(session_.cameras()); cameras > 1)
    kind = session_.isSimulated() ? tr("%n, simulated", "cameras", cameras)
                                  : tr("%n camera(s)", nullptr, cameras);
  // Of several, the one that is.
  const std::optional<std::size_t> silent = session_.silentCamera();
  const QString asked = silent && session_.cameras() > 1 ? cameraLabel(session_, *silent) : kind;
  setRole(camera_, silent ? "amber" : "note");
  camera_->setWhole(silent                      ? tr("%1, silent").arg(asked)
                    : session_.areDevicesFree() ? kind
                                                : tr("%1, in use").arg(kind));
  showDisk(QString::fromStdString(session_.path().string()));
  QDateTime when = lastWritten(session_.path());
  // While it is measured, every photograph is.
  const int photographs = session_.live().photographs();
  if (std::exchange(photographs_, photographs) != photographs && session_.isMeasuring())
    lastPhotograph_ = QDateTime::currentDateTime();
  if (!session_.isMeasuring()) lastPhotograph_ = {};
  if (lastPhotograph_.isValid()) when = lastPhotograph_;
  if (said_.isActive()) return;
  saved_->setWhole(
      when.isValid() ? tr("Saved %1").arg(QLocale().toString(when.toLocalTime().time(), QLocale::ShortFormat))
                     : QString());
}

}  // namespace relucent::gui
