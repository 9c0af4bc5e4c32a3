// SPDX-License-Identifier: MIT
#include "wizard/camera/checks_view.h"

#include <QLocale>
#include <QPainter>
#include <algorithm>

#include "text/message_text.h"
#include "theme/accessible_role.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/camera/camera_page.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

using Kind = Remark::Kind;

/// A projector's picture in cells: those that the camera sees are filled.
class CoverageMap : public QWidget {
 public:
  CoverageMap() {
    setObjectName("coverage-map");
    setAccessibleRole(this, QAccessible::Graphic);
  }
  void show(const linearization::Coverage& coverage, Size picture) {
    coverage_ = coverage;
    constexpr int widest = 220;
    setFixedHeight(picture.width > 0 ? widest * picture.height / picture.width : 0);
    setAccessibleName(CameraPage::tr("The projector's picture: the camera sees %1 of it")
                          .arg(percentText(coverage.share())));
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    if (coverage_.cells.count() == 0) return;
    QPainter painter(this);
    painter.setPen(Qt::NoPen);
    const double wide = width() / static_cast<double>(coverage_.cells.width);
    const double high = height() / static_cast<double>(coverage_.cells.height);
    for (std::size_t i = 0; i < coverage_.seen.size(); ++i) {
      const Pixel cell = pixelAt(coverage_.cells, i);
      const QRectF place(cell.x * wide, cell.y * high, wide - 1.0, high - 1.0);
      // What is not seen has another pattern too, for those who do not tell the colours apart.
      painter.fillRect(
          place, coverage_.seen[i] != 0 ? QBrush(colours().good) : QBrush(colours().amber, Qt::BDiagPattern));
    }
  }

 private:
  linearization::Coverage coverage_;
};

/// Whether cells are missing elsewhere than at the edges that are missed.
bool isMissingWithin(const linearization::Coverage& coverage, bool left, bool right, bool top, bool bottom) {
  for (std::size_t i = 0; i < coverage.seen.size(); ++i) {
    const Pixel cell = pixelAt(coverage.cells, i);
    const bool isAtEdge = (left && cell.x == 0) || (right && cell.x + 1 == coverage.cells.width) ||
                          (top && cell.y == 0) || (bottom && cell.y + 1 == coverage.cells.height);
    if (coverage.seen[i] == 0 && !isAtEdge) return true;
  }
  return false;
}

}  // namespace

QString missingText(const linearization::Coverage& coverage, bool isSimulated) {
  constexpr double most = 0.5;  // of an edge's cells
  QStringList edges;
  const bool left = coverage.missingLeft() > most, right = coverage.missingRight() > most,
             top = coverage.missingTop() > most, bottom = coverage.missingBottom() > most;
  if (left) edges << CameraPage::tr("at the left");
  if (right) edges << CameraPage::tr("at the right");
  if (top) edges << CameraPage::tr("at the top");
  if (bottom) edges << CameraPage::tr("at the bottom");
  if (edges.isEmpty())
    return CameraPage::tr("Missing are places within it: in shadow, or too dark for the camera.");
  if (isMissingWithin(coverage, left, right, top, bottom)) edges << CameraPage::tr("places within it");
  if (isSimulated)
    return CameraPage::tr(
               "Missing: %1. A simulated camera stays where it stands: go on, what it does not see "
               "is left as it is.")
        .arg(QLocale().createSeparatedList(edges));
  return CameraPage::tr("Missing: %1. Aim the camera there, or move it back.")
      .arg(QLocale().createSeparatedList(edges));
}

namespace {

/// How much of the picture is seen, and where it is not.
QWidget* coveragePart(CameraPage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* sees = new Remark;
  auto* map = new CoverageMap;
  sees->setObjectName("coverage");
  rows->addWidget(sees);
  rows->addWidget(map);
  auto refresh = [&model, part, sees, map] {
    const std::vector<linearization::Coverage>& all = model.coverage();
    part->setVisible(!all.empty());
    if (all.empty()) return;
    const auto least = std::ranges::min_element(all, {}, &linearization::Coverage::share);
    const auto projector = static_cast<std::size_t>(least - all.begin());
    constexpr double enough = 0.98;
    const QString share = percentText(least->share());
    const bool isEnough = least->share() >= enough;
    const QString sentence =
        all.size() == 1 ? CameraPage::tr("%1 of the projector's picture is seen").arg(share)
        : isEnough      ? CameraPage::tr("%1 of every picture is seen").arg(share)
                   : CameraPage::tr("%1 of projector %2's picture is seen").arg(share).arg(projector + 1);
    sees->show(isEnough ? Kind::good : Kind::warning, sentence,
               isEnough ? QString() : missingText(*least, model.isSimulated()));
    map->setVisible(!isEnough);
    map->show(*least, model.projectorSize(projector));
  };
  refreshOn(model, part, refresh, &CameraPage::settingsChanged, &CameraPage::resultChanged);
  return part;
}

/// That exposures flicker, with what ends it; or that they no longer do.
QWidget* flickerPart(CameraPage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* remark = new Remark;
  QPushButton* fix = buttonOf({});
  fix->setObjectName("whole-periods");
  rows->addWidget(remark);
  rows->addWidget(fix);
  QObject::connect(fix, &QPushButton::clicked, &model, [&model] {
    model.setExposureUnit(model.exposureUnit() > 0.0 ? 0.0 : model.flickerPeriod().value_or(0.0));
  });
  auto refresh = [&model, part, remark, fix] {
    const std::optional<double> period = model.flickerPeriod();
    const double unit = model.exposureUnit();
    part->setVisible(period || unit > 0.0);
    if (unit > 0.0) {
      remark->show(Kind::good, CameraPage::tr("Every exposure is a multiple of %1").arg(exposureText(unit)),
                   CameraPage::tr("The projector's light changes as quickly as that: each photograph has all "
                                  "of it."));
      fix->setText(CameraPage::tr("Allow any exposure"));
    } else if (period) {
      remark->show(Kind::warning,
                   CameraPage::tr("Exposures shorter than %1 flicker").arg(exposureText(*period)),
                   CameraPage::tr("The projector's light changes within that time."));
      fix->setText(CameraPage::tr("Use multiples of %1").arg(exposureText(*period)));
    }
  };
  refreshOn(model, part, refresh, &CameraPage::settingsChanged, &CameraPage::resultChanged);
  return part;
}

void judge(Remark* verdict, const std::optional<double>& share, const QString& good, const QString& bad,
           const QString& advice) {
  verdict->setVisible(share.has_value());
  if (!share) return;
  if (*share > 0.02)
    verdict->show(Kind::warning, bad.arg(percentText(*share)), advice);
  else
    verdict->show(
        Kind::good, good,
        *share < 0.0005
            ? CameraPage::tr("All of the view, by one exposure or another.")
            : CameraPage::tr("All but %1 of the view, by one exposure or another.").arg(percentText(*share)));
}

/// Whether the camera sees the projector at all, as far as somebody looks or has looked.
void showWhetherSeen(CameraPage& model, Remark* sees) {
  if (model.needsCamera()) return sees->show(Kind::watch, CameraPage::tr("No camera is chosen yet"), {});
  if (model.isKept() && model.status().state == StepState::doubtful)
    return sees->show(
        Kind::warning, CameraPage::tr("Checked before"),
        CameraPage::tr("%1 of full light was too bright in every exposure. “Check again” looks through "
                       "the camera.")
            .arg(percentText(model.keptTooBright())));
  if (model.isKept())
    return sees->show(Kind::good, CameraPage::tr("Checked before"),
                      CameraPage::tr("These exposures are kept. “Check again” looks through the camera."));
  if (!model.exposures().empty())
    return sees->show(Kind::good, CameraPage::tr("The camera sees the projector"),
                      CameraPage::tr("White and black differ as they should."));
  if (model.isLooking()) return sees->show(Kind::watch, CameraPage::tr("Checks under way"), {});
  sees->show(Kind::watch, CameraPage::tr("Not checked yet"), {});
}

/// How the devices work together, a line each.
QString verdictLines(const CameraPage& model) {
  if (!model.check()) return model.keptVerdicts().join('\n');
  QStringList lines;
  for (const devices::CheckVerdict& verdict : pipeline::verdictsOf(*model.check()))
    lines << text(devices::messageOf(verdict));
  return lines.join('\n');
}

}  // namespace

QWidget* checksPart(CameraPage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(labelOf(CameraPage::tr("Checks"), "section"));
  auto* sees = new Remark;
  auto* bright = new Remark;
  auto* dark = new Remark;
  auto* together = labelOf({}, "note");
  together->setObjectName("device-verdicts");
  rows->addWidget(sees);
  rows->addWidget(together);
  rows->addWidget(coveragePart(model));
  rows->addWidget(flickerPart(model));
  rows->addWidget(bright);
  rows->addWidget(dark);
  auto refresh = [&model, sees, bright, dark, together] {
    const QString lines = verdictLines(model);
    together->setText(lines);
    together->setVisible(!lines.isEmpty());
    showWhetherSeen(model, sees);
    judge(bright, model.tooBrightEverywhere(), CameraPage::tr("Bright parts are covered"),
          CameraPage::tr("%1 is too bright in every exposure"),
          CameraPage::tr("Close the lens a little, or shade lamps in the view."));
    judge(dark, model.tooDarkEverywhere(), CameraPage::tr("Dark parts are covered"),
          CameraPage::tr("%1 is too dark in every exposure"),
          CameraPage::tr("The projector may not reach there. Where it should, open the lens."));
  };
  refreshOn(model, part, refresh, &CameraPage::settingsChanged, &CameraPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
