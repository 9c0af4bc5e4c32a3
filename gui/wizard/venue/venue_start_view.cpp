// SPDX-License-Identifier: MIT
#include <QFileDialog>
#include <QMenu>
#include <QShortcut>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/rename_dialog.h"
#include "wizard/venue/tidy_dialog.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

class RecentRow : public QFrame {
 public:
  RecentRow(VenuePage& model, const RecentVenue& venue) {
    setRole(this, "card");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(16, 10, 12, 10);
    row->addWidget(pictureOf(venue));
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
    row->addWidget(tidyButton(model, venue));
    row->addWidget(moreButton(model, venue));
    const bool isOpen = model.isOpenNow(venue);
    QPushButton* open = buttonOf(isOpen                ? VenuePage::tr("Is open")
                                 : venue.isInterrupted ? VenuePage::tr("Resume")
                                                       : VenuePage::tr("Open"));
    setPossible(open, isOpen ? VenuePage::tr("Is open") : QString());
    open->setAccessibleName(
        (venue.isInterrupted ? VenuePage::tr("Resume %1") : VenuePage::tr("Open %1")).arg(venue.name));
    QObject::connect(open, &QPushButton::clicked, &model,
                     [&model, folder = venue.folder] { model.open(folder); });
    row->addWidget(open_ = open);
  }
  /// What opens it.
  QPushButton* open() const { return open_; }

 private:
  /// The surface, or what kind of venue it is.
  static QWidget* pictureOf(const RecentVenue& venue) {
    constexpr QSize room(64, 44);
    auto* picture = new QLabel;
    picture->setFixedSize(room);
    picture->setAlignment(Qt::AlignCenter);
    if (venue.picture.isNull()) {
      auto* centre = new QHBoxLayout(picture);
      centre->setContentsMargins(0, 0, 0, 0);
      centre->addWidget(new IconLabel(venue.simulated ? Icon::play : Icon::projector, secondaryColour, 24), 0,
                        Qt::AlignCenter);
      return picture;
    }
    const qreal ratio = picture->devicePixelRatioF();
    QPixmap shown =
        QPixmap::fromImage(venue.picture.scaled(room * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation));
    shown.setDevicePixelRatio(ratio);
    picture->setPixmap(shown);
    return picture;
  }
  QPushButton* open_ = nullptr;

  /// What is seldom done to a venue; on a right click, too.
  QPushButton* moreButton(VenuePage& model, const RecentVenue& venue) {
    QPushButton* more = buttonOf(VenuePage::tr("More"), "flat");
    more->setObjectName("more");
    more->setAccessibleName(VenuePage::tr("More for %1").arg(venue.name));
    auto* menu = new QMenu(more);
    more->setMenu(menu);
    const auto add = [menu](const char* name, const QString& text, const QString& problem) {
      QAction* action = menu->addAction(text);
      action->setObjectName(name);
      action->setEnabled(problem.isEmpty());
      return action;
    };
    // Looked at when it is wanted: a show may have been installed since.
    connect(menu, &QMenu::aboutToShow, this, [this, add, menu, &model, venue] {
      menu->clear();
      connect(add("rename", VenuePage::tr("Rename…"), model.keeping().whyNotRenamed(venue)),
              &QAction::triggered, &model, [this, &model, venue] {
                auto* dialog = new RenameDialog(venue, window());
                dialog->setAttribute(Qt::WA_DeleteOnClose);
                connect(dialog, &RenameDialog::chosen, &model,
                        [&model, venue](const QString& name) { model.rename(venue, name); });
                dialog->open();
              });
      connect(add("remove", VenuePage::tr("Remove…"), model.keeping().whyNotRemoved(venue)),
              &QAction::triggered, &model, [&model, venue] { model.askToRemove(venue); });
      // In sight, once for what has the same reason.
      QStringList reasons{model.keeping().whyNotRenamed(venue), model.keeping().whyNotRemoved(venue)};
      reasons.removeDuplicates();
      reasons.removeAll(QString());
      for (const QString& reason : reasons) {
        QAction* line = menu->addAction(reason);
        line->setObjectName("reason");
        line->setEnabled(false);
      }
    });
    setContextMenuPolicy(Qt::CustomContextMenu);
    connect(this, &QWidget::customContextMenuRequested, menu,
            [this, menu](const QPoint& place) { menu->popup(mapToGlobal(place)); });
    return more;
  }
  QPushButton* tidyButton(VenuePage& model, const RecentVenue& venue) {
    QPushButton* tidy = buttonOf(VenuePage::tr("Free space…"), "flat");
    tidy->setObjectName("tidy");
    tidy->setAccessibleName(VenuePage::tr("Free the disk of what %1 does not need").arg(venue.name));
    const QString problem = model.tidyProblem();
    setPossible(tidy, problem);  // said once, above the list
    tidy->setToolTip(plainToolTip(problem.isEmpty() ? tidy->accessibleName() : problem));
    connect(tidy, &QPushButton::clicked, &model, [this, &model, venue] {
      auto* dialog = new TidyDialog(model.tidy(venue), window());
      dialog->setAttribute(Qt::WA_DeleteOnClose);
      dialog->open();
    });
    return tidy;
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
                 VenuePage::tr("Measure a surface with a projector and a camera at this computer."));
    auto* script = new Tile(Icon::settings, VenuePage::tr("New venue by script"),
                            VenuePage::tr("Projector and camera are driven by programs of yours."));
    rehearse->setObjectName("rehearse");
    create->setObjectName("new-venue");
    for (Tile* tile : {rehearse, open, create, script}) tiles->addWidget(tile);
    all->addLayout(tiles);
    QObject::connect(create, &Tile::clicked, &model, [&model] { model.setMode(VenuePage::Mode::devices); });
    QObject::connect(script, &Tile::clicked, &model, [&model] { model.setMode(VenuePage::Mode::script); });
    QObject::connect(open, &Tile::clicked, &model, [this] { chooseFolder(model_, this); });
    QObject::connect(rehearse, &Tile::clicked, &model,
                     [&model] { model.setMode(VenuePage::Mode::rehearse); });
    connect(new QShortcut(QKeySequence::New, this), &QShortcut::activated, create, &Tile::click);
    connect(new QShortcut(QKeySequence::Open, this), &QShortcut::activated, open, &Tile::click);
    auto* heading = new QHBoxLayout;
    heading->setSpacing(space::gap);
    QLabel* title = labelOf(VenuePage::tr("Recent"), "heading");
    title->setWordWrap(false);
    heading->addWidget(title);
    heading->addWidget(whyNotTidied_ = labelOf({}, "note"), 1);
    whyNotTidied_->setObjectName("why-not-tidied");
    all->addLayout(heading);
    recent_ = new Card;
    all->addWidget(recent_, 1);
    connect(&model, &VenuePage::statusChanged, this, [this] { refresh(); });
    fill();
  }

 private:
  void refresh() {
    if (isVisible()) fill();
  }
  void showEvent(QShowEvent*) override { fill(); }
  void fill() {
    QList<RecentVenue> venues = model_.recent();
    QStringList now{model_.tidyProblem()};
    whyNotTidied_->setText(venues.isEmpty() ? QString() : now.front());
    for (const RecentVenue& venue : venues)
      now << venue.folder + venue.state + (model_.isOpenNow(venue) ? "*" : "") +
                 (venue.picture.isNull() ? "" : "+");
    if (now == shown_ && recent_->body()->count() > 0) return;
    shown_ = now;
    const bool hadFocus = recent_->isAncestorOf(window()->focusWidget());
    while (QLayoutItem* item = recent_->body()->takeAt(0)) {
      delete item->widget();
      delete item;
    }
    if (venues.isEmpty()) return fillEmpty();
    const QList<RecentVenue> shown = venues.first(std::min<qsizetype>(5, venues.size()));
    for (const RecentVenue& venue : shown) {
      auto* row = new RecentRow(model_, venue);
      recent_->body()->addWidget(row);
      // Mostly one goes on where one was last.
      if (&venue == &shown.first() && !model_.session().isOpen()) beginHere(row->open());
    }
    recent_->body()->addStretch(1);
    if (hadFocus) focusFirst(recent_);
  }
  void fillEmpty() {
    auto* middle = new QWidget;
    auto* column = new QVBoxLayout(middle);
    column->addStretch(1);
    column->addWidget(new IconLabel(Icon::house, secondaryColour, 48), 0, Qt::AlignHCenter);
    for (const auto& [text, role] :
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
  QLabel* whyNotTidied_;
  QStringList shown_;
};

}  // namespace

QWidget* startStage(VenuePage& model) {
  return new StartStage(model);
}

}  // namespace relucent::gui
