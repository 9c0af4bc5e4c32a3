// SPDX-License-Identifier: MIT
#include "wizard/preview/methods_card.h"

#include <QHeaderView>
#include <QTableWidget>
#include <algorithm>
#include <cmath>

#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/session/method_name.h"

namespace relucent::gui {
namespace {

QString decibelsText(double decibels) {
  return PreviewPage::tr("%1 dB").arg(decimalText(decibels, 1));
}

QString colourErrorText(double deltaE) {
  return isolated(QString::fromUtf8("ΔE %1").arg(decimalText(deltaE, 1)));
}

QString secondsText(double seconds) {
  return seconds < 0.001 ? PreviewPage::tr("under 1 ms")
         : seconds < 1.0 ? PreviewPage::tr("%1 ms").arg(std::lround(1000.0 * seconds))
                         : PreviewPage::tr("%1 s").arg(decimalText(seconds, 1));
}

/// What is seen is weighed as an eye does, which more decibels need not follow.
QString weighedNote() {
  return PreviewPage::tr("errors weighed as an eye does");
}

}  // namespace

/// Nobody has to scroll across: what does not fit is left out, the least important first.
class MethodsTable : public QTableWidget {
 public:
  enum Column { method, note, deltaE, time, psnr, ssim, columns };

  MethodsTable() : QTableWidget(0, columns) {
    horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    horizontalHeader()->setSectionResizeMode(note, QHeaderView::Stretch);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setTabKeyNavigation(false);  // Tab leads out of it, arrows from row to row
  }
  /// As for all that may come to stand there, so that no column goes while rows come.
  void fit() {
    int needed = 0;
    // The heading of a column that is hidden has no width.
    for (int column = psnr; column < columns; ++column) setColumnHidden(column, false);
    for (int column = 0; column < columns; ++column) {
      needed += std::max(widestOf(column), horizontalHeader()->sectionSizeHint(column)) + cellMargin;
      if (column >= psnr) setColumnHidden(column, needed > viewport()->width());
    }
  }
  /// Where reading goes from right to left, selectRow() selects nothing.
  void chooseRow(int row) {
    chosen_ = row;
    selectionModel()->setCurrentIndex(model()->index(row, method),
                                      QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QTableWidget::resizeEvent(event);
    fit();
  }
  /// Rows that were only looked at are not those in use.
  void focusOutEvent(QFocusEvent* event) override {
    QTableWidget::focusOutEvent(event);
    chooseRow(chosen_);
  }

 private:
  int widestOf(int column) const {
    const QFontMetrics metrics(typeOf(type::body, QFont::DemiBold));
    const int padding = 2 * (style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, this) + 1);
    int widest = sizeHintForColumn(column);
    for (const QString& text : textsOf(static_cast<Column>(column)))
      widest = std::max(widest, metrics.horizontalAdvance(text) + padding);
    return widest;
  }
  static QStringList textsOf(Column column) {
    QStringList texts;
    switch (column) {
      case method:
        for (compensation::Method each : comparedMethods) texts << methodName(each);
        break;
      case note:
        for (compensation::Method each : comparedMethods) texts << noteOf(each, {});
        texts << weighedNote();
        break;
      case deltaE:
        return {colourErrorText(88.8)};
      case time:
        return {secondsText(0.0), secondsText(0.888), secondsText(88.8)};
      case psnr:
        return {decibelsText(88.8)};
      default:
        return {decimalText(0.888, 3)};
    }
    return texts;
  }

  static constexpr int cellMargin = 2;
  int chosen_ = -1;
};

QString noteOf(compensation::Method method, const std::vector<MethodPreview>& rows) {
  const auto own = std::ranges::find(rows, method, &MethodPreview::method);
  const auto isBetterThanOwn = [own](const MethodPreview& row) { return row.psnr > own->psnr; };
  switch (method) {
    case compensation::Method::mix:
      return PreviewPage::tr("blind to bounces");
    case compensation::Method::clusters:
      return PreviewPage::tr("blind to light between clusters");
    case compensation::Method::refined:
      return PreviewPage::tr("recommended");
    case compensation::Method::optimum:
      return own != rows.end() && std::ranges::any_of(rows, isBetterThanOwn)
                 ? weighedNote()
                 : PreviewPage::tr("limit of this venue");
    default:
      return {};
  }
}

MethodsCard::MethodsCard(PreviewPage& page, QWidget* parent)
    : Card(PreviewPage::tr("Methods"), parent), page_(page) {
  setObjectName("methods-card");
  table_ = new MethodsTable;
  table_->setObjectName("methods");
  table_->setAccessibleName(PreviewPage::tr("Comparison of methods"));
  table_->setHorizontalHeaderLabels({PreviewPage::tr("Method"), PreviewPage::tr("Notes"),
                                     PreviewPage::tr("Colour error"), PreviewPage::tr("Still picture"),
                                     PreviewPage::tr("Quality"), PreviewPage::tr("Detail kept")});
  table_->horizontalHeaderItem(MethodsTable::time)
      ->setToolTip(
          PreviewPage::tr("How long a still picture takes to be solved, once. Films always play by “All "
                          "bounces, for films” in the quicker show engine: how fast is said at Cluster."));
  table_->horizontalHeaderItem(MethodsTable::psnr)
      ->setToolTip(
          PreviewPage::tr("Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.") + ' ' +
          PreviewPage::tr("Of this content, where it can be reached. What Acquire expects is a mean of "
                          "other pictures: the two may differ by some dB."));
  table_->horizontalHeaderItem(MethodsTable::ssim)
      ->setToolTip(PreviewPage::tr("Structural similarity, SSIM: 1 is all of it."));
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(26);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setShowGrid(false);
  // As high as the methods, the rest is the picture's.
  constexpr int header = 34, rowHeight = 26;
  table_->setFixedHeight(header + static_cast<int>(comparedMethods.size()) * rowHeight);
  connect(table_, &QTableWidget::cellClicked, &page_, [this](int row, int) { choose(row); });
  connect(table_, &QTableWidget::cellActivated, &page_, [this](int row, int) { choose(row); });
  body()->addWidget(table_);
  addAction(unfold_ = buttonOf({}));
  unfold_->setObjectName("compare-methods");
  connect(unfold_, &QPushButton::clicked, this, [this] {
    unfolded_ = !unfolded_;
    arrange();
  });
  refreshOn(page_, this, [this] { refresh(); }, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
}

void MethodsCard::setFoldable(bool foldable) {
  if (std::exchange(foldable_, foldable) != foldable) arrange();
}

void MethodsCard::arrange() {
  unfold_->setVisible(foldable_);
  unfold_->setText(isFolded() ? PreviewPage::tr("Compare") : PreviewPage::tr("Hide"));
  table_->setVisible(!isFolded());
  setSubtitle(isFolded() ? chosenText() : PreviewPage::tr("predicted for this content; click one to use it"));
}

/// The method in use, and how well it does.
QString MethodsCard::chosenText() const {
  const QString name = methodName(page_.settings().method);
  const std::optional<MethodPreview> row = page_.chosenRow();
  return row ? QString("%1: %2").arg(name, decibelsText(row->psnr)) : name;
}

void MethodsCard::choose(int row) {
  if (row < 0 || static_cast<std::size_t>(row) >= page_.table().size()) return;
  pipeline::ContentSettings settings = page_.settings();
  settings.method = page_.table()[static_cast<std::size_t>(row)].method;
  page_.setSettings(settings, PreviewPage::tr("Method"));
}

void MethodsCard::refresh() {
  const std::vector<MethodPreview>& rows = page_.table();
  table_->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const MethodPreview& method = rows[static_cast<std::size_t>(row)];
    QStringList cells{methodName(method.method),      noteOf(method.method, rows),
                      colourErrorText(method.deltaE), secondsText(method.seconds),
                      decibelsText(method.psnr),      decimalText(method.ssim, 3)};
    bool chosen = method.method == page_.settings().method;
    for (int cell = 0; cell < cells.size(); ++cell) {
      auto* item = new QTableWidgetItem(cells[cell]);
      item->setFont(typeOf(type::body, chosen ? QFont::DemiBold : QFont::Normal));
      if (cell == MethodsTable::note) item->setToolTip(cells[cell]);
      if (cells[cell].isEmpty()) item->setData(Qt::AccessibleTextRole, PreviewPage::tr("no note"));
      table_->setItem(row, cell, item);
    }
    if (chosen) table_->chooseRow(row);
  }
  table_->fit();
  arrange();
}

}  // namespace relucent::gui
