// SPDX-License-Identifier: MIT
#include "app/help_window.h"

#include <QDesktopServices>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QScreen>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextList>
#include <QVBoxLayout>
#include <utility>

#include "app/versions.h"
#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent::gui {

QList<HelpPage> helpPages(const QString& language) {
  QList<HelpPage> pages = guidePages(":/help", language);
  // In the program's language, with licences in English.
  pages.append({"about", aboutText().section('\n', 0, 0).remove('#').trimmed(), aboutText(), {}});
  return pages;
}

namespace {

/// As the program looks now: a page in the other theme would be the brightest or the darkest thing on the
/// screen.
QImage themedPicture(const QString& file) {
  const bool isDark = Theme::instance().look() == Look::dark;
  const QImage dark = isDark ? QImage(":/help/pictures/dark/" + file) : QImage();
  return dark.isNull() ? QImage(":/help/pictures/" + file) : dark;
}

}  // namespace

HelpText::HelpText(QWidget* parent) : QTextBrowser(parent) {
  connect(&Theme::instance(), &Theme::changed, this, &HelpText::showAgain);
}

/// At the place that is being read.
void HelpText::showAgain() {
  if (page_.text.isEmpty()) return;
  const int place = verticalScrollBar()->value();
  show(page_);
  verticalScrollBar()->setValue(place);
}

void HelpText::show(const HelpPage& page) {
  page_ = page;
  // A page that is being written may need a bar to scroll, which makes it narrower: it is written once more,
  // but not within itself.
  if (std::exchange(isWriting_, true)) return;
  constexpr int most = 2;
  for (int times = 0; times < most && (times == 0 || width_ != viewport()->width()); ++times) {
    width_ = viewport()->width();
    // Qt would write all that has no letters of its own in those of the heading in which the cursor stands.
    clear();
    setCurrentCharFormat({});
    setMarkdown(page_.text);
    spread();
  }
  isWriting_ = false;
}

/// The side to read from, and room between paragraphs, which Markdown comes without. A paragraph's first word
/// does not tell the side: it may be a name or a key.
void HelpText::spread() {
  QTextCursor cursor(document());
  for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
    QTextBlockFormat format = block.blockFormat();
    format.setLayoutDirection(page_.direction());
    format.setBottomMargin(block.textList() != nullptr ? space::tight : space::small);
    // A picture's line is as high as the picture.
    if (!block.text().contains(QChar::ObjectReplacementCharacter))
      format.setLineHeight(130.0, QTextBlockFormat::ProportionalHeight);
    cursor.setPosition(block.position());
    cursor.setBlockFormat(format);
  }
}

QVariant HelpText::loadResource(int type, const QUrl& name) {
  if (type != QTextDocument::ImageResource) return QTextBrowser::loadResource(type, name);
  QImage picture = themedPicture(name.fileName());
  int most = width_ - static_cast<int>(2.0 * document()->documentMargin());
  if (picture.isNull() || most <= 0) return picture;
  auto pixels = static_cast<int>(most * devicePixelRatioF());
  if (picture.width() > pixels) picture = picture.scaledToWidth(pixels, Qt::SmoothTransformation);
  // One that has fewer pixels than the screen has there is no wider for that.
  if (picture.width() > most) picture.setDevicePixelRatio(static_cast<double>(picture.width()) / most);
  return picture;
}

void HelpText::resizeEvent(QResizeEvent* event) {
  QTextBrowser::resizeEvent(event);
  if (!isWriting_ && width_ != viewport()->width()) showAgain();
}

HelpWindow::HelpWindow(const QString& language, QWidget* parent)
    : QDialog(parent), pages_(helpPages(language)) {
  setWindowTitle(tr("Help"));
  setObjectName("help");
  constexpr int titleBar = 40;
  resize(QSize(900, 640).boundedTo(screen()->availableSize() - QSize(0, titleBar)));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(space::page, space::page, space::page, space::page);
  row->setSpacing(space::gap);
  auto* left = new QVBoxLayout;
  search_ = new QLineEdit;
  search_->setObjectName("help-search");
  search_->setPlaceholderText(tr("Search the guide"));
  search_->setAccessibleName(tr("Search the guide"));
  search_->setClearButtonEnabled(true);
  list_ = new QListWidget;
  list_->setObjectName("help-pages");
  list_->setAccessibleName(tr("Pages of the guide"));
  left->addWidget(search_);
  left->addWidget(list_, 1);
  row->addLayout(left);
  text_ = new HelpText;
  text_->setObjectName("help-text");
  text_->setAccessibleName(tr("The page"));
  text_->setOpenLinks(false);
  row->addWidget(text_, 1);
  connect(search_, &QLineEdit::textChanged, this, &HelpWindow::search);
  connect(list_, &QListWidget::currentRowChanged, this, &HelpWindow::fill);
  connect(text_, &QTextBrowser::anchorClicked, this, &HelpWindow::follow);
  search({});
  // The widest title in one line, beside the bar that scrolls.
  int bar = list_->verticalScrollBar()->sizeHint().width();
  int width = std::max(230, list_->sizeHintForColumn(0) + 2 * list_->frameWidth() + bar);
  for (QWidget* widget : std::initializer_list<QWidget*>{search_, list_}) widget->setFixedWidth(width);
}

void HelpWindow::showPage(int index) {
  search_->clear();
  if (index >= 0 && index < list_->count()) list_->setCurrentRow(index);
}

void HelpWindow::replace(const HelpWindow& before) {
  setGeometry(before.geometry());
  const QListWidgetItem* shown = before.list_->currentItem();
  for (int i = 0; shown != nullptr && i < pages_.size(); ++i)
    if (pages_[i].id == shown->data(Qt::UserRole).toString()) showPage(i);
}

/// Pages that hold all the words, in any order.
void HelpWindow::search(const QString& words) {
  QStringList wanted = words.split(' ', Qt::SkipEmptyParts);
  QString before = list_->currentItem() ? list_->currentItem()->data(Qt::UserRole).toString() : QString();
  list_->clear();
  for (const HelpPage& page : pages_) {
    auto holds = [&](const QString& word) { return page.text.contains(word, Qt::CaseInsensitive); };
    if (!std::all_of(wanted.begin(), wanted.end(), holds)) continue;
    auto* item = new QListWidgetItem(page.title, list_);
    item->setData(Qt::UserRole, page.id);
    if (page.id == before) list_->setCurrentItem(item);
  }
  if (list_->currentRow() < 0 && list_->count() > 0) list_->setCurrentRow(0);
  // As a page: where the text becomes wider, it is written again, and the page of before must not come back.
  if (list_->count() == 0) text_->show({{}, {}, tr("No page holds these words."), {}});
  fill();
}

void HelpWindow::fill() {
  if (list_->currentItem() == nullptr) return;
  QString id = list_->currentItem()->data(Qt::UserRole).toString();
  for (const HelpPage& page : pages_)
    if (page.id == id) text_->show(page);
  QStringList wanted = search_->text().split(' ', Qt::SkipEmptyParts);
  // The place that was looked for, marked and in sight.
  text_->moveCursor(QTextCursor::Start);
  if (!wanted.isEmpty()) text_->find(wanted.first());
}

/// To another page of the guide, or out into the world.
void HelpWindow::follow(const QUrl& link) {
  for (int i = 0; i < pages_.size(); ++i)
    if (link.isRelative() && link.path() == pages_[i].id + ".md") return showPage(i);
  QDesktopServices::openUrl(link);
}

void HelpWindow::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Find)) return search_->setFocus();
  QDialog::keyPressEvent(event);
}

}  // namespace relucent::gui
