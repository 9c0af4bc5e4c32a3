// SPDX-License-Identifier: MIT
#include <QGuiApplication>
#include <QLineEdit>
#include <QScreen>
#include <QShortcut>
#include <QSpinBox>
#include <cmath>

#include "output/screen_identity.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/flash_consent.h"
#include "wizard/identify_overlay.h"
#include "wizard/page_view.h"
#include "wizard/tile.h"
#include "wizard/venue_page.h"
#include "wizard/venue_parts.h"

namespace relucent {
namespace {

/// A button for each screen of the desktop, with its size.
class ScreenList : public QWidget {
 public:
  explicit ScreenList(VenuePage& model) : model_(model) {
    row_ = new QHBoxLayout(this);
    row_->setSpacing(space::gap);
    connect(qApp, &QGuiApplication::screenAdded, this, [this] { fill(); });
    connect(qApp, &QGuiApplication::screenRemoved, this, [this] { fill(); });
    fill();
  }

 private:
  void fill() {
    while (QLayoutItem* item = row_->takeAt(0)) {
      delete item->widget();
      delete item;
    }
    for (QScreen* screen : QGuiApplication::screens()) row_->addWidget(tileOf(*screen));
    if (!chosen_ || findScreen(*chosen_) != nullptr) return;
    auto* gone = new Tile(Icon::warning, title_, VenuePage::tr("Unplugged. Plug it in or choose another."));
    gone->setDashed(true);
    gone->setEnabled(false);
    row_->addWidget(gone);
  }
  Tile* tileOf(const QScreen& screen) {
    QSize size = nativeSize(screen);
    bool operators = &screen == QGuiApplication::primaryScreen();
    auto* tile = new Tile(operators ? Icon::monitor : Icon::projector,
                          operators ? VenuePage::tr("This computer") : screenTitle(screen),
                          VenuePage::tr("%1, %2 × %3, %4 Hz")
                              .arg(screen.name())
                              .arg(size.width())
                              .arg(size.height())
                              .arg(std::lround(screen.refreshRate())));
    tile->setObjectName("venue-screen-" + screen.name());
    tile->setEnabled(!operators);
    tile->setCheckable(true);
    tile->setAutoExclusive(true);
    auto tell = [tile, size](bool chosen) {
      QString name = chosen ? VenuePage::tr("%1, %2 by %3, chosen") : VenuePage::tr("%1, %2 by %3");
      tile->setAccessibleName(name.arg(tile->text()).arg(size.width()).arg(size.height()));
    };
    connect(tile, &Tile::toggled, tile, tell);
    tile->setChecked(chosen_ && *chosen_ == identityOf(screen));
    tell(tile->isChecked());
    connect(tile, &Tile::clicked, &model_, [this, size, tile, identity = identityOf(screen)] {
      chosen_ = identity;
      title_ = tile->text();
      CommandRigSettings script = model_.script();
      script.projector = {size.width(), size.height()};
      model_.setScript(script);
      dropGone();
    });
    return tile;
  }
  /// Another was chosen: nobody waits for the one that went.
  void dropGone() {
    for (Tile* tile : findChildren<Tile*>())
      if (tile->isDashed()) tile->deleteLater();
  }

  VenuePage& model_;
  QHBoxLayout* row_;
  std::optional<ScreenIdentity> chosen_;
  QString title_;  // of the chosen one
};

QLineEdit* commandLine(VenuePage& model, QVBoxLayout* column, const QString& name, const QString& example,
                       std::string CommandRigSettings::*part) {
  column->addWidget(labelOf(name, "note"));
  auto* line = new QLineEdit(QString::fromStdString(model.script().*part));
  line->setPlaceholderText(example);
  line->setAccessibleName(name);
  QObject::connect(line, &QLineEdit::textEdited, &model, [&model, part](const QString& text) {
    CommandRigSettings script = model.script();
    script.*part = text.toStdString();
    model.setScript(script);
  });
  column->addWidget(line);
  return line;
}

QWidget* consent(VenuePage& model) {
  auto* part = new FlashConsent;
  QObject::connect(part, &FlashConsent::given, &model, &VenuePage::setRoomClear);
  auto refresh = [part, &model] { part->show(model.needsConsent(), model.isRoomClear(), std::nullopt); };
  QObject::connect(&model, &VenuePage::changed, part, refresh);
  refresh();
  return part;
}

}  // namespace

QWidget* scriptStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* screens = new Card(VenuePage::tr("Screens"));
  screens->setSubtitle(
      VenuePage::tr("Choose the one that shines on the surface. Its pixels are the projector's."));
  QPushButton* identify = buttonOf(VenuePage::tr("Identify screens"));
  identify->setObjectName("identify");
  identify->setToolTip(VenuePage::tr("I"));
  screens->addAction(identify);
  auto* overlay = new IdentifyOverlay(stage);
  QObject::connect(identify, &QPushButton::clicked, overlay, &IdentifyOverlay::show);
  auto* key = new QShortcut(QKeySequence(Qt::Key_I), screens);
  key->setContext(Qt::WidgetWithChildrenShortcut);
  QObject::connect(key, &QShortcut::activated, overlay, &IdentifyOverlay::show);
  QObject::connect(new QShortcut(QKeySequence(Qt::Key_Escape), stage), &QShortcut::activated, overlay,
                   &IdentifyOverlay::hide);
  screens->body()->addWidget(new ScreenList(model));
  column->addWidget(screens, 1);
  auto* programs = new Card(VenuePage::tr("Programs"));
  programs->setSubtitle(VenuePage::tr("Any projector and any camera that a command can drive"));
  commandLine(model, programs->body(),
              VenuePage::tr("Shows the file {image} and returns when the light is out"),
              "show-on-projector {image}", &CommandRigSettings::projectorCommand);
  commandLine(
      model, programs->body(),
      VenuePage::tr("Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF"),
      "photograph --seconds {exposure} --to {output}", &CommandRigSettings::cameraCommand);
  programs->body()->addStretch(1);
  column->addWidget(programs, 1);
  return stage;
}

QWidget* scriptInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("Projector's pixels"), "section"));
  auto* row = new QHBoxLayout;
  for (int Size::*side : {&Size::width, &Size::height}) {
    auto* box = new QSpinBox;
    box->setRange(8, 8192);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setValue(model.script().projector.*side);
    box->setAccessibleName(side == &Size::width ? VenuePage::tr("Width") : VenuePage::tr("Height"));
    QObject::connect(box, &QSpinBox::valueChanged, &model, [&model, side](int value) {
      CommandRigSettings script = model.script();
      if (script.projector.*side == value) return;
      script.projector.*side = value;
      model.setScript(script);
    });
    QObject::connect(&model, &VenuePage::changed, box, [&model, box, side] {
      QSignalBlocker quiet(box);
      box->setValue(model.script().projector.*side);
    });
    row->addWidget(box);
  }
  column->addLayout(row);
  column->addWidget(lineOf());
  column->addWidget(keepingPart(model));
  column->addWidget(consent(model));
  column->addStretch(1);
  return card;
}

}  // namespace relucent
