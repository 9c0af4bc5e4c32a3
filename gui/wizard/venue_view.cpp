// SPDX-License-Identifier: MIT
#include <QComboBox>
#include <QFileDialog>
#include <QGuiApplication>
#include <QLineEdit>
#include <QPainter>
#include <QScreen>
#include <QScrollArea>
#include <QShortcut>
#include <QSpinBox>
#include <QStackedWidget>
#include <QToolButton>
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/page_view.h"
#include "wizard/tile.h"
#include "wizard/venue_page.h"

namespace relucent {
namespace {

class RecentRow : public QFrame {
 public:
  RecentRow(VenuePage& model, const RecentVenue& venue) {
    setRole(this, "card");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(16, 10, 12, 10);
    row->addWidget(new IconLabel(venue.simulated ? Icon::play : Icon::projector, secondaryColour, 24));
    row->addSpacing(8);
    auto* texts = new QVBoxLayout;
    texts->setSpacing(2);
    texts->addWidget(labelOf(venue.name, "strong"));
    QString when = QLocale().toString(venue.opened, QLocale::ShortFormat);
    texts->addWidget(labelOf(venue.simulated ? VenuePage::tr("Rehearsal. Opened %1").arg(when)
                                             : VenuePage::tr("Opened %1").arg(when),
                             "note"));
    row->addLayout(texts, 1);
    QLabel* state = labelOf(venue.state, "information");
    state->setWordWrap(false);
    row->addWidget(state);
    row->addSpacing(8);
    QPushButton* open = buttonOf(VenuePage::tr("Open"));
    open->setAccessibleName(VenuePage::tr("Open %1").arg(venue.name));
    QObject::connect(open, &QPushButton::clicked, &model,
                     [&model, folder = venue.folder] { model.open(folder); });
    row->addWidget(open);
  }
};

void chooseFolder(VenuePage& model, QWidget* parent) {
  QString folder = QFileDialog::getExistingDirectory(parent, VenuePage::tr("Open a venue"), model.folder());
  if (!folder.isEmpty()) model.open(folder);
}

class StartStage : public QWidget {
 public:
  explicit StartStage(VenuePage& model) : model_(model) {
    auto* all = new QVBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(space::gap);
    auto* tiles = new QHBoxLayout;
    tiles->setSpacing(space::gap);
    auto* rehearse = new Tile(Icon::play, VenuePage::tr("Rehearse"),
                              VenuePage::tr("Learn every step in a simulated venue. No devices needed."));
    auto* open = new Tile(Icon::folder, VenuePage::tr("Open a venue"),
                          VenuePage::tr("Continue where you stopped, or change the content."));
    auto* create =
        new Tile(Icon::plus, VenuePage::tr("New venue"),
                 VenuePage::tr("Measure a surface with a projector and a camera that programs of yours "
                               "drive."));
    rehearse->setObjectName("rehearse");
    for (Tile* tile : {rehearse, open, create}) tiles->addWidget(tile);
    all->addLayout(tiles);
    QObject::connect(create, &Tile::clicked, &model, [&model] { model.setMode(VenuePage::Mode::script); });
    QObject::connect(open, &Tile::clicked, &model, [this] { chooseFolder(model_, this); });
    QObject::connect(rehearse, &Tile::clicked, &model,
                     [&model] { model.setMode(VenuePage::Mode::rehearse); });
    connect(new QShortcut(QKeySequence::New, this), &QShortcut::activated, create, &Tile::click);
    connect(new QShortcut(QKeySequence::Open, this), &QShortcut::activated, open, &Tile::click);
    all->addWidget(labelOf(VenuePage::tr("Recent"), "heading"));
    recent_ = new Card;
    all->addWidget(recent_, 1);
    connect(&model, &VenuePage::changed, this, [this] { refresh(); });
    fill();
  }

 private:
  void refresh() {
    if (isVisible()) fill();
  }
  void showEvent(QShowEvent*) override { fill(); }
  void fill() {
    QList<RecentVenue> venues = model_.recent();
    QStringList now;
    for (const RecentVenue& venue : venues) now << venue.folder + venue.state;
    if (now == shown_ && recent_->body()->count() > 0) return;
    shown_ = now;
    while (QLayoutItem* item = recent_->body()->takeAt(0)) {
      delete item->widget();
      delete item;
    }
    if (venues.isEmpty()) return fillEmpty();
    for (const RecentVenue& venue : venues.first(std::min<qsizetype>(5, venues.size())))
      recent_->body()->addWidget(new RecentRow(model_, venue));
    recent_->body()->addStretch(1);
  }
  void fillEmpty() {
    auto* middle = new QWidget;
    auto* column = new QVBoxLayout(middle);
    column->addStretch(1);
    column->addWidget(new IconLabel(Icon::house, secondaryColour, 48), 0, Qt::AlignHCenter);
    for (auto [text, role] :
         {std::pair(VenuePage::tr("No venues yet"), "heading"),
          std::pair(VenuePage::tr("The venues that you measure are listed here, newest first."), "secondary"),
          std::pair(VenuePage::tr("A first rehearsal takes a few minutes."), "secondary")}) {
      QLabel* label = labelOf(text, role);
      label->setAlignment(Qt::AlignHCenter);
      column->addWidget(label);
    }
    QPushButton* rehearse = buttonOf(VenuePage::tr("Rehearse in a simulated venue"));
    connect(rehearse, &QPushButton::clicked, &model_, [this] { model_.setMode(VenuePage::Mode::rehearse); });
    column->addSpacing(8);
    column->addWidget(rehearse, 0, Qt::AlignHCenter);
    column->addStretch(1);
    recent_->body()->addWidget(middle);
  }

  VenuePage& model_;
  Card* recent_;
  QStringList shown_;
};

QWidget* rehearseStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* grid = new QGridLayout(stage);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(space::gap);
  auto* group = new QButtonGroup(stage);
  for (std::size_t i = 0; i < model.venues().size(); ++i) {
    const RehearsalVenue& venue = model.venues()[i];
    auto* tile = new Tile(QImage(venue.picture), venue.name, venue.sentence);
    tile->setObjectName("venue-" + QString::fromStdString(venue.id));
    tile->setCheckable(true);
    tile->setChecked(i == model.venue());
    group->addButton(tile, static_cast<int>(i));
    grid->addWidget(tile, static_cast<int>(i) / 3, static_cast<int>(i) % 3);
  }
  QObject::connect(group, &QButtonGroup::idClicked, &model,
                   [&model](int id) { model.chooseVenue(static_cast<std::size_t>(id)); });
  return stage;
}

/// Name, folder, and what it will take: the same for every kind of new venue.
class KeepingPart : public QWidget {
 public:
  explicit KeepingPart(VenuePage& model) : model_(model) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(labelOf(VenuePage::tr("This venue"), "section"));
    column->addWidget(labelOf(VenuePage::tr("Name"), "note"));
    name_ = new QLineEdit;
    name_->setObjectName("venue-name");
    name_->setAccessibleName(VenuePage::tr("Name of the venue"));
    column->addWidget(name_);
    column->addWidget(labelOf(VenuePage::tr("Folder"), "note"));
    auto* row = new QHBoxLayout;
    folder_ = new QLineEdit;
    folder_->setAccessibleName(VenuePage::tr("Folder that holds the venue"));
    row->addWidget(folder_, 1);
    auto* browse = new QToolButton;
    auto paint = [browse] { browse->setIcon(iconOf(Icon::folder, colours().text)); };
    connect(&Theme::instance(), &Theme::changed, browse, paint);
    paint();
    browse->setAccessibleName(VenuePage::tr("Choose a folder"));
    row->addWidget(browse);
    column->addLayout(row);
    column->addSpacing(8);
    column->addWidget(lineOf());
    column->addWidget(labelOf(VenuePage::tr("Expected"), "section"));
    column->addWidget(patterns_ = new ValueRow(VenuePage::tr("Patterns")));
    column->addWidget(disk_ = new ValueRow(VenuePage::tr("Disk")));
    column->addWidget(free_ = new ValueRow(VenuePage::tr("Free there")));
    connect(name_, &QLineEdit::textEdited, &model, &VenuePage::setVenueName);
    connect(folder_, &QLineEdit::editingFinished, &model, [this] { model_.setFolder(folder_->text()); });
    connect(browse, &QToolButton::clicked, this, [this] {
      QString chosen =
          QFileDialog::getExistingDirectory(this, VenuePage::tr("Choose a folder"), model_.folder());
      if (!chosen.isEmpty()) model_.setFolder(chosen);
    });
    connect(&model, &VenuePage::changed, this, [this] { refresh(); });
    refresh();
  }

 private:
  void refresh() {
    if (name_->text() != model_.venueName()) name_->setText(model_.venueName());
    if (!folder_->hasFocus()) folder_->setText(model_.folder());
    WorkLeft work = model_.expected();
    patterns_->setValue(VenuePage::tr("about %1").arg(countText(static_cast<std::uint64_t>(work.shots))));
    disk_->setValue(bytesText(work.diskBytes));
    free_->setValue(bytesText(model_.freeBytes()), model_.freeBytes() < work.diskBytes ? "error" : "strong");
  }

  VenuePage& model_;
  QLineEdit *name_, *folder_;
  ValueRow *patterns_, *disk_, *free_;
};

QWidget* rehearseInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("Simulated devices"), "section"));
  column->addWidget(labelOf(VenuePage::tr("Projector"), "note"));
  auto* sizes = new QComboBox;
  sizes->setObjectName("rehearsal-size");
  sizes->setAccessibleName(VenuePage::tr("Pixels of the simulated projector"));
  for (const RehearsalSize& size : model.sizes()) sizes->addItem(size.text);
  sizes->setCurrentIndex(static_cast<int>(model.size()));
  QObject::connect(sizes, &QComboBox::activated, &model,
                   [&model](int index) { model.chooseSize(static_cast<std::size_t>(index)); });
  column->addWidget(sizes);
  column->addWidget(
      labelOf(VenuePage::tr("More pixels show finer detail and take longer. The first time, the light "
                            "of the venue is traced; later it is remembered."),
              "note"));
  column->addWidget(lineOf());
  column->addWidget(new KeepingPart(model));
  column->addStretch(1);
  return card;
}

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
    for (QScreen* screen : QGuiApplication::screens()) {
      QSize size = screen->size() * screen->devicePixelRatio();
      bool operators = screen == QGuiApplication::primaryScreen();
      auto* tile = new Tile(operators ? Icon::monitor : Icon::projector,
                            operators ? VenuePage::tr("This computer") : screen->name(),
                            VenuePage::tr("%1 × %2, %3 Hz")
                                .arg(size.width())
                                .arg(size.height())
                                .arg(std::lround(screen->refreshRate())));
      tile->setEnabled(!operators);
      tile->setCheckable(true);
      tile->setAutoExclusive(true);
      connect(tile, &Tile::clicked, &model_, [this, size] {
        CommandRigSettings script = model_.script();
        script.projector = {size.width(), size.height()};
        model_.setScript(script);
      });
      row_->addWidget(tile);
    }
  }
  VenuePage& model_;
  QHBoxLayout* row_;
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

QWidget* scriptStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* screens = new Card(VenuePage::tr("Screens"));
  screens->setSubtitle(
      VenuePage::tr("Choose the one that shines on the surface. Its pixels are the projector's."));
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
  column->addWidget(new KeepingPart(model));
  column->addStretch(1);
  return card;
}

}  // namespace

PageView viewOf(VenuePage& model) {
  auto* stages = new QStackedWidget;
  auto* inspectors = new QStackedWidget;
  for (QWidget* stage :
       {static_cast<QWidget*>(new StartStage(model)), rehearseStage(model), scriptStage(model)})
    stages->addWidget(stage);
  for (QWidget* inspector : {new QWidget, rehearseInspector(model), scriptInspector(model)})
    inspectors->addWidget(inspector);
  auto refresh = [&model, stages, inspectors] {
    int mode = static_cast<int>(model.mode());
    stages->setCurrentIndex(mode);
    inspectors->setCurrentIndex(mode);
  };
  QObject::connect(&model, &VenuePage::changed, stages, refresh);
  refresh();
  return {stages, inspectors};
}

}  // namespace relucent
