// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_view.h"

#include <QHeaderView>
#include <QPainter>
#include <QTableWidget>
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "views/view_actions.h"
#include "wizard/preview/corner_view.h"
#include "wizard/preview/preview_inspector.h"
#include "wizard/session/method_name.h"

namespace relucent::gui {
namespace {

/// Hatches where the content cannot be reached, and its corners. Finer than the picture, so that lines stay
/// thin.
QImage hatchesOf(const ContentPreview& preview) {
  constexpr int fine = 4;
  Size size = preview.with.size();
  QImage overlay(size.width * fine, size.height * fine, QImage::Format_ARGB32_Premultiplied);
  overlay.fill(Qt::transparent);
  for (int y = 0; y < overlay.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(overlay.scanLine(y));
    for (int x = 0; x < overlay.width(); ++x) {
      std::size_t at = indexOf(size, {x / fine, y / fine});
      if (preview.inside[at] != 0 && preview.reachable[at] == 0 && (x + y) % 8 < 3)
        line[x] = colours(Look::dark).text.rgb();
    }
  }
  QPainter painter(&overlay);
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF corners;
  for (const auto& corner : preview.corners) corners.append(QPointF(corner[0], corner[1]) * fine);
  painter.setPen(QPen(colours(Look::dark).accent, 3.0));
  painter.drawPolygon(corners);
  return overlay;
}

enum Shown { picture, reachable, difference };

/// Nobody has to scroll across: what does not fit is left out, the least important first.
class MethodsTable : public QTableWidget {
 public:
  enum Column { method, note, deltaE, time, psnr, ssim, columns };

  MethodsTable() : QTableWidget(0, columns) {
    horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    horizontalHeader()->setSectionResizeMode(note, QHeaderView::Stretch);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  }
  void fit() {
    int needed = 0;
    for (int column = 0; column < columns; ++column) {
      needed += std::max(sizeHintForColumn(column), horizontalHeader()->sectionSizeHint(column)) + cellMargin;
      if (column >= psnr) setColumnHidden(column, needed > viewport()->width());
    }
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QTableWidget::resizeEvent(event);
    fit();
  }

 private:
  static constexpr int cellMargin = 2;
};

class PreviewStage : public QWidget {
 public:
  explicit PreviewStage(PreviewPage& page) : page_(page) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(space::gap);
    card_ = new Card(PreviewPage::tr("Audience view"));
    card_->setSubtitle(PreviewPage::tr("predicted from the measurement"));
    kind_ = new Segmented(
        {PreviewPage::tr("Picture"), PreviewPage::tr("Reachable light"), PreviewPage::tr("Difference")});
    card_->addAction(kind_);
    views_ = {place_ = new CornerView, new ImageView, new ImageView};
    for (ImageView* view : views_) {
      view->setLink(&link_);
      view->setEmptyText(PreviewPage::tr("Preparing the preview"));
      card_->body()->addWidget(view, 1);
      view->hide();
    }
    views_[picture]->show();
    views_[picture]->setObjectName("preview-view");
    views_[picture]->setAccessibleName(
        PreviewPage::tr("What the audience will see, uncorrected at the left of the divider and "
                        "corrected at the right"));
    views_[reachable]->setAccessibleName(PreviewPage::tr(
        "The brightest light that can be reached; hatched where the content is out of reach"));
    views_[difference]->setAccessibleName(
        PreviewPage::tr("Colour difference between what is wanted and what is predicted"));
    addViewMenu(
        *card_, [this] { return shownView(); },
        [this](const Failure& failure) {
          Q_EMIT page_.failed({failure, PreviewPage::tr("What is measured is safe.")});
        });
    connect(place_, &CornerView::moved, &page_, &PreviewPage::setCorners);
    column->addWidget(card_, 1);
    column->addWidget(tableCard());
    connect(kind_, &Segmented::chosen, this, [this](int index) {
      for (int i = 0; i < 3; ++i) views_[static_cast<std::size_t>(i)]->setVisible(i == index);
    });
    refreshOn(
        page_, this, [this] { refresh(); }, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  }

 private:
  /// What is looked at, and its numbers.
  ShownView shownView() const {
    const auto index = static_cast<std::size_t>(kind_->current());
    std::function<image::Image()> values;
    if (shown_ && index == reachable)
      values = [preview = shown_] { return image::Image(preview->with.size(), 1, preview->reach); };
    if (shown_ && index == difference) values = [preview = shown_] { return preview->deltaE; };
    if (shown_ && index == picture) values = [preview = shown_] { return preview->with; };
    static constexpr std::array units{"camera signal per second", "of white", "CIEDE2000"};
    return {*views_[index], {values, units[index]}};
  }
  /// What the hatches say.
  QString legend() const {
    const double missing = 1.0 - shown_->reachableShare;
    return missing < 0.0005 ? PreviewPage::tr("All of it can be reached")
                            : PreviewPage::tr("Hatched: %1 cannot be reached").arg(percentText(missing));
  }
  Card* tableCard() {
    auto* card = new Card(PreviewPage::tr("Methods"));
    card->setSubtitle(PreviewPage::tr("predicted for this content; click one to use it"));
    table_ = new MethodsTable;
    table_->setObjectName("methods");
    table_->setAccessibleName(PreviewPage::tr("Comparison of methods"));
    table_->setHorizontalHeaderLabels({PreviewPage::tr("Method"), PreviewPage::tr("Notes"),
                                       PreviewPage::tr("Colour error"), PreviewPage::tr("Still picture"),
                                       PreviewPage::tr("PSNR"), PreviewPage::tr("SSIM")});
    table_->horizontalHeaderItem(MethodsTable::time)
        ->setToolTip(
            PreviewPage::tr("How long a still picture takes to be solved, once. Films always play by “All "
                            "bounces, for films” in the quicker show engine: how fast is said at Cluster."));
    table_->horizontalHeaderItem(MethodsTable::psnr)
        ->setToolTip(
            PreviewPage::tr("Of this content, where it can be reached. What Acquire expects is a mean of "
                            "other pictures: the two may differ by some dB."));
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(26);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setShowGrid(false);
    // As high as the methods, the rest is the picture's.
    constexpr int header = 34, rowHeight = 26, methods = 5;
    table_->setFixedHeight(header + methods * rowHeight);
    connect(table_, &QTableWidget::cellClicked, &page_, [this](int row, int) { choose(row); });
    connect(table_, &QTableWidget::cellActivated, &page_, [this](int row, int) { choose(row); });
    card->body()->addWidget(table_);
    return card;
  }
  void choose(int row) {
    if (row < 0 || static_cast<std::size_t>(row) >= page_.table().size()) return;
    pipeline::ContentSettings settings = page_.settings();
    settings.method = page_.table()[static_cast<std::size_t>(row)].method;
    page_.setSettings(settings, PreviewPage::tr("Method"));
  }
  static QString noteOf(compensation::Method method) {
    switch (method) {
      case compensation::Method::mix:
        return PreviewPage::tr("blind to bounces");
      case compensation::Method::clusters:
        return PreviewPage::tr("blind to light between clusters");
      case compensation::Method::refined:
        return PreviewPage::tr("recommended");
      case compensation::Method::optimum:
        return PreviewPage::tr("limit of this venue");
      default:
        return {};
    }
  }
  void fillTable() {
    const std::vector<MethodPreview>& rows = page_.table();
    table_->setRowCount(static_cast<int>(rows.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
      const MethodPreview& method = rows[static_cast<std::size_t>(row)];
      const QString time = method.seconds < 0.001 ? PreviewPage::tr("under 1 ms")
                           : method.seconds < 1.0
                               ? PreviewPage::tr("%1 ms").arg(std::lround(1000.0 * method.seconds))
                               : PreviewPage::tr("%1 s").arg(decimalText(method.seconds, 1));
      QStringList cells{methodName(method.method),
                        noteOf(method.method),
                        isolated(QString::fromUtf8("ΔE %1").arg(decimalText(method.deltaE, 1))),
                        time,
                        PreviewPage::tr("%1 dB").arg(decimalText(method.psnr, 1)),
                        decimalText(method.ssim, 3)};
      bool chosen = method.method == page_.settings().method;
      for (int cell = 0; cell < cells.size(); ++cell) {
        auto* item = new QTableWidgetItem(cells[cell]);
        item->setFont(typeOf(type::body, chosen ? QFont::DemiBold : QFont::Normal));
        if (cell == MethodsTable::note) item->setToolTip(cells[cell]);
        if (cells[cell].isEmpty()) item->setData(Qt::AccessibleTextRole, PreviewPage::tr("no note"));
        table_->setItem(row, cell, item);
      }
      if (chosen) table_->selectRow(row);
    }
    table_->fit();
  }
  void refresh() {
    fillTable();
    place_->setWrong(!page_.problem().isEmpty());
    place_->setCorners(page_.corners());
    const auto& preview = page_.preview();
    if (preview == shown_) return;
    shown_ = preview;
    if (!preview) {
      for (ImageView* view : views_) view->setPicture({});
      return;
    }
    Size size = preview->with.size();
    views_[picture]->setPicture(pictureOf(preview->without, preview->white));
    views_[picture]->setCompared(pictureOf(preview->with, preview->white), PreviewPage::tr("Uncorrected"),
                                 page_.settings().method == compensation::Method::none
                                     ? PreviewPage::tr("Uncorrected, too")
                                     : PreviewPage::tr("Corrected, predicted"));
    ColourScale reach{ColourMap::viridis, 0.02, 4.0, true};
    views_[reachable]->setScale(reach, PreviewPage::tr("of white"), true);
    views_[reachable]->setPicture(mapped(preview->reach, size, reach));
    views_[reachable]->setOverlay(hatchesOf(*preview));
    views_[reachable]->setCaption(legend());
    ColourScale deltaE{ColourMap::cividis, 0.0, 12.0, false};
    views_[difference]->setScale(deltaE, QString::fromUtf8("ΔE₀₀"), false);
    views_[difference]->setPicture(mapped(preview->deltaE.data(), size, deltaE));
    views_[difference]->setReadout([preview](QPoint pixel) {
      const float difference = preview->deltaE.at(pixel.x(), pixel.y(), 0);
      return isolated(QString::fromUtf8("%1: ΔE %2")
                          .arg(placeText(pixel.x(), pixel.y()), numberText(static_cast<double>(difference))));
    });
  }

  PreviewPage& page_;
  ViewLink link_;
  Card* card_;
  Segmented* kind_;
  CornerView* place_;
  std::array<ImageView*, 3> views_{};
  MethodsTable* table_;
  std::shared_ptr<const ContentPreview> shown_;
};

}  // namespace

PageView viewOf(PreviewPage& page) {
  return {new PreviewStage(page), previewInspector(page)};
}

}  // namespace relucent::gui
