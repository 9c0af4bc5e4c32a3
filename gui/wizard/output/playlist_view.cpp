// SPDX-License-Identifier: MIT
#include "wizard/output/playlist_view.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QSlider>
#include <QUrl>
#include <algorithm>
#include <cmath>

#include "content/content_address.h"
#include "relucent/base/message.h"
#include "text/message_text.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/content_files.h"
#include "wizard/frame/page_view.h"
#include "wizard/output/output_page.h"
#include "wizard/output/screen_menu.h"
#include "wizard/output/stream_dialog.h"

namespace relucent::gui {

QStringList draggedFiles(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.append(url.toLocalFile());
  return files;
}

namespace {

QString skippedText(const Message& why) {
  return OutputPage::tr("Skipped: %1").arg(fullSentence(why));
}

}  // namespace

PlaylistView::PlaylistView(OutputPage& page, QWidget* parent) : QListWidget(parent), page_(page) {
  setObjectName("playlist");
  setAccessibleName(OutputPage::tr("Playlist"));
  setAccessibleDescription(
      OutputPage::tr("Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here."));
  setDragDropMode(DragDrop);
  setDefaultDropAction(Qt::MoveAction);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setTextElideMode(Qt::ElideMiddle);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  for (auto signal : {&OutputPage::settingsChanged, &OutputPage::progressChanged})
    connect(&page_, signal, this, &PlaylistView::refresh);
  connect(&Theme::instance(), &Theme::changed, this, [this] {
    clear();
    refresh();
  });
  refresh();
}

QSize PlaylistView::sizeHint() const {
  constexpr int least = 2, most = 5, row = 32;
  return {200, row * std::clamp(count(), least, most) + 4};
}

void PlaylistView::refresh() {
  const QList<PlaylistItem>& items = page_.playlist().settings().items;
  int row = currentRow();
  if (count() != items.size()) updateGeometry();
  while (count() > items.size()) delete takeItem(count() - 1);
  while (count() < items.size()) addItem(new QListWidgetItem);
  qsizetype playing = page_.showsChart() ? -1 : page_.projection().playing();
  const std::vector<Playlist::Skipped> skipped = page_.projection().skipped();
  for (int i = 0; i < count(); ++i) {
    QString name = OutputPlaylist::nameOf(items[i].path);
    QListWidgetItem* entry = item(i);
    const auto wrong = std::ranges::find(skipped, i, &Playlist::Skipped::index);
    const bool isSkipped = wrong != skipped.end();
    bool plays = i == playing, still = OutputPlaylist::isStill(items[i]);
    // Painting an icon is not for nothing: only where it changes.
    const Icon icon = isSkipped ? Icon::warning : plays ? Icon::play : still ? Icon::picture : Icon::film;
    if (entry->text() == name && entry->data(Qt::UserRole) == static_cast<int>(icon)) continue;
    entry->setText(name);
    entry->setData(Qt::UserRole, static_cast<int>(icon));
    const QString path = shownPath(items[i].path);
    entry->setToolTip(plainToolTip(isSkipped ? path + '\n' + skippedText(wrong->why) : path));
    entry->setIcon(iconOf(icon, isSkipped ? colours().amber
                                : plays   ? colours().accent
                                          : colours().secondary));
    entry->setData(Qt::AccessibleTextRole, isSkipped ? OutputPage::tr("%1, skipped").arg(name)
                                           : plays   ? OutputPage::tr("%1, playing").arg(name)
                                                     : name);
    entry->setFont(typeOf(type::body, plays ? QFont::DemiBold : QFont::Normal));
  }
  if (count() > 0) setCurrentRow(std::clamp(row, 0, count() - 1));
}

void PlaylistView::moveRow(int by) {
  int to = currentRow() + by;
  if (currentRow() < 0 || to < 0 || to >= count()) return;
  page_.moveItem(currentRow(), by);
  setCurrentRow(to);
}

void PlaylistView::keyPressEvent(QKeyEvent* event) {
  bool moves = event->modifiers().testFlag(Qt::ControlModifier);
  if (moves && event->key() == Qt::Key_Up) return moveRow(-1);
  if (moves && event->key() == Qt::Key_Down) return moveRow(1);
  if (event->key() == Qt::Key_Delete) return page_.removeItem(currentRow());
  QListWidget::keyPressEvent(event);
}

void PlaylistView::dragEnterEvent(QDragEnterEvent* event) {
  if (event->source() == this || !draggedFiles(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void PlaylistView::dragMoveEvent(QDragMoveEvent* event) {
  event->acceptProposedAction();
}

void PlaylistView::dropEvent(QDropEvent* event) {
  if (event->source() == this) {
    QModelIndex under = indexAt(event->position().toPoint());
    int to = under.isValid() ? under.row() : count() - 1;
    moveRow(to - currentRow());
    // The row is moved already: nothing is left for the drag to remove.
    event->setDropAction(Qt::CopyAction);
    event->accept();
    return;
  }
  page_.addFiles(draggedFiles(*event->mimeData()));
  event->acceptProposedAction();
}

namespace {

constexpr double shortestPicture = 0.1;  // seconds, as shown with one digit

/// How the streams that play are doing; empty: well, or there are none.
QString troubleText(const std::vector<LiveState>& streams) {
  QStringList lines;
  for (const LiveState& stream : streams) {
    if (stream.phase == LiveState::Phase::connecting)
      lines << OutputPage::tr("Connecting to %1").arg(isolated(stream.address));
    else if (stream.phase == LiveState::Phase::asking)
      lines << OutputPage::tr("Choose in the desktop's dialog what to show as %1")
                   .arg(isolated(stream.address));
    else if (stream.phase == LiveState::Phase::lost)
      lines << OutputPage::tr("Lost: %1. %2").arg(isolated(stream.address), fullSentence(stream.problem));
  }
  return lines.join('\n');
}

/// Of the picture that is chosen in the list.
QDoubleSpinBox* secondsBox() {
  auto* box = new QDoubleSpinBox;
  box->setObjectName("picture-seconds");
  box->setAccessibleName(OutputPage::tr("Seconds that the chosen picture stands"));
  box->setDecimals(1);
  box->setRange(shortestPicture, longestPicture);
  box->setSuffix(OutputPage::tr(" s"));
  box->setKeyboardTracking(false);  // what is half typed is no time yet
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  auto* field = box->findChild<QLineEdit*>();
  leaveUndoToThePage(box, field);
  QObject::connect(box, &QDoubleSpinBox::editingFinished, field, [field] { field->setModified(false); });
  return box;
}

void askForStream(OutputPage& page, QWidget* parent) {
  auto* dialog = new StreamDialog(parent->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  QObject::connect(dialog, &StreamDialog::chosen, &page,
                   [&page](const QString& path) { page.addFiles({path}); });
  dialog->show();
}

}  // namespace

QWidget* playlistPart(OutputPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* list = new PlaylistView(page);
  column->addWidget(list);

  auto* row = new QHBoxLayout;
  row->setSpacing(space::tight);
  QPushButton* add = buttonOf(OutputPage::tr("Add"));
  add->setObjectName("playlist-add");
  add->setAccessibleName(OutputPage::tr("Add files to the playlist"));
  row->addWidget(add);
  QToolButton* up = toolOf(Icon::up, OutputPage::tr("Move up"));
  QToolButton* down = toolOf(Icon::down, OutputPage::tr("Move down"));
  QToolButton* remove = toolOf(Icon::remove, OutputPage::tr("Remove from the playlist"));
  up->setObjectName("playlist-up");
  down->setObjectName("playlist-down");
  remove->setObjectName("playlist-remove");
  for (QToolButton* button : {up, down, remove}) row->addWidget(button);
  row->addStretch(1);
  auto* repeat = new QCheckBox(OutputPage::tr("Repeat"));
  repeat->setObjectName("repeat");
  row->addWidget(repeat);
  column->addLayout(row);
  // Near what it is said of, as further down it would not be seen; below the buttons, as it comes and goes.
  QLabel* skipped = labelOf({}, "amber");
  skipped->setObjectName("skipped");
  column->addWidget(skipped);
  QLabel* trouble = labelOf({}, "amber");
  trouble->setObjectName("streams");
  column->addWidget(trouble);
  QPushButton* stream = buttonOf(OutputPage::tr("Add a stream"));
  stream->setObjectName("playlist-stream");
  stream->setToolTip(OutputPage::tr("A live picture from the network, as cameras and encoders send it."));
  column->addWidget(stream);
  QPushButton* screen = buttonOf(OutputPage::tr("Add a screen or window"));
  screen->setObjectName("playlist-screen");
  screen->setToolTip(OutputPage::tr("The live picture of a screen of this computer, or of a window on it."));
  screen->setMenu(screenMenu(page, screen));
  column->addWidget(screen);
  auto* timeRow = new QHBoxLayout;
  QLabel* timeLabel = labelOf(OutputPage::tr("Picture stands for"));
  auto* time = secondsBox();
  timeLabel->setBuddy(time);
  timeRow->addWidget(timeLabel, 1);
  timeRow->addWidget(time);
  column->addLayout(timeRow);
  auto* fadeRow = new ValueRow(OutputPage::tr("Cross-fade"));
  auto* fade = new QSlider(Qt::Horizontal);
  fade->setObjectName("fade");
  fade->setAccessibleName(OutputPage::tr("Cross-fade, tenths of a second"));
  fade->setRange(0, 50);
  column->addWidget(fadeRow);
  column->addWidget(fade);

  QObject::connect(add, &QPushButton::clicked, &page, [&page, part] {
    page.addFiles(askForFiles(part, OutputPage::tr("Add pictures or films"), ContentFiles::picturesAndFilms));
  });
  QObject::connect(stream, &QPushButton::clicked, &page, [&page, part] { askForStream(page, part); });
  auto move = [&page, list](int by) {
    int to = list->currentRow() + by;
    page.moveItem(list->currentRow(), by);
    if (to >= 0 && to < list->count()) list->setCurrentRow(to);
  };
  QObject::connect(up, &QToolButton::clicked, &page, [move] { move(-1); });
  QObject::connect(down, &QToolButton::clicked, &page, [move] { move(1); });
  QObject::connect(remove, &QToolButton::clicked, &page,
                   [&page, list] { page.removeItem(list->currentRow()); });
  QObject::connect(repeat, &QCheckBox::toggled, &page, &OutputPage::setRepeat);
  QObject::connect(fade, &QSlider::valueChanged, &page, [&page](int tenths) { page.setFade(tenths / 10.0); });
  QObject::connect(time, &QDoubleSpinBox::valueChanged, &page,
                   [&page, list](double seconds) { page.setPictureSeconds(list->currentRow(), seconds); });
  auto refresh = [=, &page] {
    const PlaylistSettings& settings = page.playlist().settings();
    QSignalBlocker quietRepeat(repeat), quietFade(fade), quietTime(time);
    repeat->setChecked(settings.loop);
    fade->setValue(static_cast<int>(std::lround(10.0 * settings.fadeSeconds)));
    fadeRow->setValue(OutputPage::tr("%1 s").arg(numberText(settings.fadeSeconds)));
    bool several = settings.items.size() > 1;
    for (QToolButton* button : {up, down})
      setPossible(button, several ? QString() : OutputPage::tr("There is nothing else on the list."));
    for (QWidget* widget : std::initializer_list<QWidget*>{fade, fadeRow, timeLabel, time})
      widget->setVisible(several);
    const int chosen = list->currentRow();
    const bool stands = chosen >= 0 && chosen < settings.items.size() &&
                        OutputPlaylist::standsForSeconds(settings.items[chosen]);
    setPossible(time, stands ? QString() : OutputPage::tr("A film plays to its end."));
    const bool isTyped = time->findChild<QLineEdit*>()->isModified();
    if (stands && !(time->hasFocus() && isTyped)) time->setValue(settings.items[chosen].seconds);
    setPossible(remove, settings.items.isEmpty() ? OutputPage::tr("The playlist is empty.") : QString());
    const std::vector<Playlist::Skipped> wrong = page.projection().skipped();
    skipped->setVisible(!wrong.empty());
    const QString streams = troubleText(page.projection().live());
    trouble->setVisible(!streams.isEmpty());
    trouble->setText(streams);
    if (!wrong.empty()) skipped->setText(skippedText(wrong.back().why));
  };
  refreshOn(page, part, refresh, &OutputPage::settingsChanged, &OutputPage::progressChanged);
  QObject::connect(list, &QListWidget::currentRowChanged, part, refresh);
  return part;
}

}  // namespace relucent::gui
