// SPDX-License-Identifier: MIT
#include <QButtonGroup>
#include <QComboBox>
#include <QGridLayout>
#include <algorithm>
#include <vector>

#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

using venue::Surprise;

QString textOf(Surprise surprise) {
  switch (surprise) {
    case Surprise::bump:
      return VenuePage::tr("Somebody bumps the camera");
    case Surprise::roomLight:
      return VenuePage::tr("A light is switched on");
    case Surprise::unplugged:
      return VenuePage::tr("The camera's cable comes out");
  }
  return {};
}

/// What happens while the rehearsal measures.
QWidget* surprisesPart(VenuePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(VenuePage::tr("Surprises"), "section"));
  for (Surprise surprise : allValues<Surprise>()) {
    auto* tick = new Tick(textOf(surprise));
    const std::string_view name = nameOf(surprise);
    tick->setObjectName(
        QString("surprise-%1").arg(QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()))));
    column->addWidget(tick);
    QObject::connect(tick, &Tick::toggled, &model,
                     [&model, surprise](bool wanted) { model.setSurprise(surprise, wanted); });
    refreshOn(
        model, tick, [&model, tick, surprise] { tick->setChecked(model.hasSurprise(surprise)); },
        &VenuePage::settingsChanged);
  }
  column->addWidget(
      labelOf(VenuePage::tr("Each comes once while Acquire measures, at a moment that nobody knows. Practise "
                            "what the wizard says, before it happens in front of a client."),
              "note"));
  return part;
}

/// As many tiles beside each other as have room, so that nobody has to scroll across.
class TileGrid : public QWidget {
 public:
  TileGrid() : grid_(new QGridLayout(this)) {
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setSpacing(space::gap);
    grid_->setSizeConstraint(QLayout::SetNoConstraint);
  }
  void add(QWidget* tile) {
    tiles_.push_back(tile);
    arrange(mostAcross);
  }
  /// Of one below the other.
  QSize minimumSizeHint() const override { return {widthOf(1), grid_->totalMinimumSize().height()}; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QWidget::resizeEvent(event);
    int across = mostAcross;
    while (across > 1 && widthOf(across) > width()) --across;
    if (across != across_) arrange(across);
    // All equally wide, whatever their words would like.
    for (int column = 0; column < mostAcross; ++column)
      grid_->setColumnMinimumWidth(column,
                                   column < across ? (width() - (across - 1) * space::gap) / across : 0);
  }

 private:
  static constexpr int mostAcross = 4;

  /// All are equally wide.
  int widthOf(int across) const {
    int widest = 0;
    for (const QWidget* tile : tiles_) widest = std::max(widest, tile->minimumSizeHint().width());
    return across * widest + (across - 1) * space::gap;
  }
  void arrange(int across) {
    across_ = across;
    for (QWidget* tile : tiles_) grid_->removeWidget(tile);
    for (int column = 0; column < mostAcross; ++column) grid_->setColumnStretch(column, column < across);
    for (int i = 0; i < static_cast<int>(tiles_.size()); ++i)
      grid_->addWidget(tiles_[static_cast<std::size_t>(i)], i / across, i % across);
  }

  QGridLayout* grid_;
  std::vector<QWidget*> tiles_;
  int across_ = mostAcross;
};

}  // namespace

QWidget* rehearseStage(VenuePage& model) {
  auto* stage = new TileGrid;
  auto* group = new QButtonGroup(stage);
  for (std::size_t i = 0; i < model.venues().size(); ++i) {
    const RehearsalVenue& venue = model.venues()[i];
    auto* tile = new Tile(QImage(venue.picture), VenuePage::tr(venue.name), VenuePage::tr(venue.sentence));
    tile->setObjectName("venue-" + QString::fromStdString(venue.id));
    tile->setCheckable(true);
    tile->setChecked(i == model.venue());
    group->addButton(tile, static_cast<int>(i));
    stage->add(tile);
  }
  const auto refresh = [&model, group] {
    for (std::size_t i = 0; i < model.venues().size(); ++i) {
      const RehearsalVenue& venue = model.venues()[i];
      static_cast<Tile*>(group->button(static_cast<int>(i)))
          ->setSentence(VenuePage::tr(venue.sentence) + '\n' + model.effortOf(venue));
    }
  };
  refreshOn(model, stage, refresh, &VenuePage::settingsChanged);
  QObject::connect(group, &QButtonGroup::idClicked, &model,
                   [&model](int id) { model.chooseVenue(static_cast<std::size_t>(id)); });
  return stage;
}

QWidget* rehearseInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("Simulated devices"), "section"));
  column->addWidget(labelOf(VenuePage::tr("Projector"), "note"));
  auto* sizes = new QComboBox;
  sizes->setObjectName("rehearsal-size");
  sizes->setAccessibleName(VenuePage::tr("Pixels of the simulated projector"));
  for (const RehearsalSize& size : model.sizes()) sizes->addItem(VenuePage::nameOf(size));
  sizes->setCurrentIndex(static_cast<int>(model.size()));
  QObject::connect(sizes, &QComboBox::activated, &model,
                   [&model](int index) { model.chooseSize(static_cast<std::size_t>(index)); });
  column->addWidget(sizes);
  column->addWidget(
      labelOf(VenuePage::tr("More pixels show finer detail and take longer. The first time, the light "
                            "of the venue is traced; later it is remembered."),
              "note"));
  column->addWidget(lineOf());
  column->addWidget(surprisesPart(model));
  column->addWidget(lineOf());
  column->addWidget(keepingPart(model));
  column->addStretch(1);
  return card;
}

}  // namespace relucent::gui
