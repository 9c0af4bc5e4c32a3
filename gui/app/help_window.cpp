// SPDX-License-Identifier: MIT
#include "app/help_window.h"

#include <QDir>
#include <QFile>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLocale>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextList>
#include <QVBoxLayout>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent {

QList<HelpPage> helpPages(const QString& language) {
  QDir folder(":/help/" + language);
  if (!folder.exists()) folder.setPath(":/help/en");
  QList<HelpPage> pages;
  for (const QString& name : folder.entryList({"*.md"}, QDir::Files, QDir::Name)) {
    QFile file(folder.filePath(name));
    if (!file.open(QIODevice::ReadOnly)) continue;
    QString text = QString::fromUtf8(file.readAll());
    QString title = text.section('\n', 0, 0);
    pages.append({name.section('.', 0, 0), title.remove('#').trimmed(), text});
  }
  return pages;
}

HelpWindow::HelpWindow(QWidget* parent)
    : QDialog(parent), pages_(helpPages(QLocale().name().section('_', 0, 0))) {
  setWindowTitle(tr("Help"));
  setObjectName("help");
  resize(900, 640);
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
  for (QWidget* widget : std::initializer_list<QWidget*>{search_, list_}) widget->setFixedWidth(230);
  row->addLayout(left);
  text_ = new QTextBrowser;
  text_->setObjectName("help-text");
  text_->setAccessibleName(tr("The page"));
  text_->setOpenExternalLinks(true);
  row->addWidget(text_, 1);
  connect(search_, &QLineEdit::textChanged, this, &HelpWindow::search);
  connect(list_, &QListWidget::currentRowChanged, this, &HelpWindow::fill);
  search({});
}

void HelpWindow::showPage(int index) {
  search_->clear();
  if (index >= 0 && index < list_->count()) list_->setCurrentRow(index);
}

/// Room between paragraphs, which Markdown comes without.
void HelpWindow::spread() {
  QTextCursor cursor(text_->document());
  for (QTextBlock block = text_->document()->begin(); block.isValid(); block = block.next()) {
    QTextBlockFormat format = block.blockFormat();
    format.setBottomMargin(block.textList() != nullptr ? space::tight : space::small);
    format.setLineHeight(130.0, QTextBlockFormat::ProportionalHeight);
    cursor.setPosition(block.position());
    cursor.setBlockFormat(format);
  }
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
  if (list_->count() == 0) text_->setPlainText(tr("No page holds these words."));
  fill();
}

void HelpWindow::fill() {
  if (list_->currentItem() == nullptr) return;
  QString id = list_->currentItem()->data(Qt::UserRole).toString();
  for (const HelpPage& page : pages_)
    if (page.id == id) text_->setMarkdown(page.text);
  spread();
  QStringList wanted = search_->text().split(' ', Qt::SkipEmptyParts);
  // The place that was looked for, marked and in sight.
  text_->moveCursor(QTextCursor::Start);
  if (!wanted.isEmpty()) text_->find(wanted.first());
}

void HelpWindow::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Find)) return search_->setFocus();
  QDialog::keyPressEvent(event);
}

}  // namespace relucent
