// SPDX-License-Identifier: MIT
#include "wizard/linearize/linearize_view.h"

#include <QComboBox>
#include <algorithm>
#include <cmath>

#include "relucent/base/message.h"
#include "text/message_text.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/line_chart.h"
#include "views/number_text.h"
#include "wizard/devices/device_selector.h"
#include "wizard/devices/flash_consent.h"

namespace relucent::gui {
namespace {

struct Channel {
  const char* name;
  const char* style;
  charts::Marker marker;
};
constexpr std::array<Channel, 3> channels{
    {{QT_TRANSLATE_NOOP("relucent::gui::LinearizePage", "Red"), "red", charts::Marker::circle},
     {QT_TRANSLATE_NOOP("relucent::gui::LinearizePage", "Green"), "green", charts::Marker::square},
     {QT_TRANSLATE_NOOP("relucent::gui::LinearizePage", "Blue"), "blue", charts::Marker::triangle}}};
constexpr double codes = 255.0, percent = 100.0;

charts::Curve curveOf(const Channel& channel) {
  return {LinearizePage::tr(channel.name).toStdString(), channel.style, channel.marker};
}

std::vector<charts::Curve> fitted(const linearization::ProjectorResponse& response) {
  std::vector<charts::Curve> curves;
  for (std::size_t c = 0; c < 3; ++c) {
    charts::Curve curve = curveOf(channels[c]);
    const hdr::ResponseCurve& fit = response.channels[c];
    for (int i = 0; i <= 256; ++i) curve.line.push_back({codes * i / 256.0, percent * fit(i / 256.0)});
    for (std::size_t i = 0; i < fit.x().size(); ++i)
      curve.points.push_back({codes * fit.x()[i], percent * fit.y()[i]});
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<charts::Curve> measured(const LinearizePage::Ramps& ramps) {
  std::vector<charts::Curve> curves;
  for (std::size_t c = 0; c < 3; ++c) {
    charts::Curve curve = curveOf(channels[c]);
    for (auto [drive, light] : ramps[c]) curve.points.push_back({codes * drive, percent * light});
    curve.line = curve.points;
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Of every level, light less the curve.
std::vector<charts::Curve> residuals(const linearization::ProjectorResponse& response) {
  std::vector<charts::Curve> curves;
  for (std::size_t c = 0; c < 3; ++c) {
    charts::Curve curve{{}, channels[c].style, channels[c].marker};  // the legend is the response's
    for (const auto [drive, light] : response.residuals[c])
      curve.points.push_back({codes * drive, percent * light});
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// A round figure that is no less, so that the axis has few digits.
double roundedUp(double percents) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(percents, 1e-3))));
  for (double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= percents) return digit * decade;
  return 10.0 * decade;
}

/// How far the photographs are from the curve that was fitted; hidden where that was not recorded.
QWidget* residualCard(LinearizePage& model) {
  auto* card = new Card(LinearizePage::tr("Off the curve"));
  card->setToolTip(
      LinearizePage::tr("Residuals: what was photographed, less the curve that was fitted to it."));
  const auto level = axisOf(0.0, codes, LinearizePage::tr("Level sent to the projector"));
  const QString title = LinearizePage::tr("Off the curve, % of full");
  auto* chart = new LineChart(level, axisOf(-1.0, 1.0, title));
  chart->setObjectName("residual-chart");
  chart->setAccessibleName(LinearizePage::tr("How far each level's light is from the fitted curve"));
  card->body()->addWidget(chart, 1);
  auto refresh = [&model, card, chart, level, title] {
    const linearization::ProjectorResponse* known = model.isMeasuring() ? nullptr : model.response();
    const bool isShown = known != nullptr && !known->residuals[0].empty();
    card->setVisible(isShown);
    if (!isShown) return;
    const double most = largestResidual(*known);
    const double high = roundedUp(percent * most);
    chart->setAxes(level, axisOf(-high, high, title));
    chart->setCurves(residuals(*known));
    const QString within = LinearizePage::tr("within ±%1").arg(percentText(most));
    card->setSubtitle(within);
    chart->setAccessibleDescription(within);
  };
  refreshOn(model, card, refresh, &LinearizePage::settingsChanged, &LinearizePage::resultChanged,
            &LinearizePage::progressChanged);
  return card;
}

QWidget* liveCards(LinearizePage& model) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(space::gap);
  auto* sent = new Card(LinearizePage::tr("Sent to the projector"));
  auto* seen = new Card(LinearizePage::tr("Seen by the camera"));
  auto* pattern = new ImageView;
  auto* photograph = new ImageView;
  pattern->setAccessibleName(LinearizePage::tr("Pattern that the projector shows"));
  photograph->setAccessibleName(LinearizePage::tr("Last photograph"));
  for (ImageView* view : {pattern, photograph})
    view->setEmptyText(LinearizePage::tr("Appears when measuring begins."));
  sent->body()->addWidget(pattern, 1);
  seen->body()->addWidget(photograph, 1);
  sent->addAction(new DeviceSelector(DeviceSelector::Kind::projector, model, sent));
  seen->addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, seen));
  layout->addWidget(sent, 1);
  layout->addWidget(seen, 1);
  auto refresh = [&model, row, pattern, photograph, seen] {
    // The residuals have this place once they are known.
    const bool hasResiduals = model.response() != nullptr && !model.response()->residuals[0].empty();
    row->setVisible(model.isMeasuring() || !hasResiduals);
    if (!model.isMeasuring()) return;
    LivePictures live = model.pictures();
    if (live.pattern.empty() || live.frame.signal.empty()) return;
    pattern->setPicture(encodedPictureOf(live.pattern));
    photograph->setPicture(pictureOf(live.frame.signal, 1.0f));
    const QString exposure = exposureText(live.frame.seconds);
    const int number = model.photographs();
    seen->setSubtitle(number == 0 ? exposure
                                  : LinearizePage::tr("%1, photograph %2")
                                        .arg(exposure, countText(static_cast<std::uint64_t>(number))));
  };
  refreshOn(model, row, refresh, &LinearizePage::settingsChanged, &LinearizePage::resultChanged,
            &LinearizePage::progressChanged);
  // What another venue's camera saw last stays with that venue.
  QObject::connect(&model.session(), &Session::opened, row, [pattern, photograph, seen] {
    pattern->setPicture({});
    photograph->setPicture({});
    seen->setSubtitle({});
  });
  return row;
}

QWidget* stageOf(LinearizePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* response = new Card(LinearizePage::tr("Response of the projector"));
  auto* chart = new LineChart(axisOf(0.0, codes, LinearizePage::tr("Level sent to the projector")),
                              axisOf(0.0, percent, LinearizePage::tr("Light, % of full")));
  chart->setObjectName("response-chart");
  chart->setAccessibleName(LinearizePage::tr("Light of every level, three colours"));
  response->addAction(new DeviceSelector(DeviceSelector::Kind::projector, model, response));
  response->body()->addWidget(chart, 1);
  column->addWidget(response, 3);
  column->addWidget(residualCard(model), 2);
  column->addWidget(liveCards(model), 2);
  auto refresh = [&model, response, chart] {
    if (model.isMeasuring()) {
      chart->setCurves(measured(model.ramps()));
      response->setSubtitle(LinearizePage::tr("as it is measured"));
    } else if (const linearization::ProjectorResponse* known = model.response()) {
      chart->setCurves(fitted(*known));
      response->setSubtitle(
          LinearizePage::tr("%n level(s) a colour, drift removed", nullptr, model.levels()));
    } else {
      chart->setCurves({});
      response->setSubtitle(LinearizePage::tr("not measured yet"));
    }
  };
  refreshOn(model, stage, refresh, &LinearizePage::settingsChanged, &LinearizePage::resultChanged,
            &LinearizePage::progressChanged);
  return stage;
}

/// What is left where nothing is projected; hidden until it was seen.
QWidget* blackPart(LinearizePage& model) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* black = new ValueRow(LinearizePage::tr("Black level"));
  auto* contrast = new ValueRow(LinearizePage::tr("Contrast"));
  black->setObjectName("black-level");
  column->addWidget(black);
  column->addWidget(contrast);
  auto refresh = [&model, part, black, contrast] {
    // While it is measured anew, what is known is of before.
    const std::optional<double> share =
        model.isMeasuring() || model.isSpoilt() ? std::nullopt : model.blackShare();
    part->setVisible(share.has_value());
    if (!share) return;
    black->setValue(LinearizePage::tr("%1 of full light").arg(percentText(*share)));
    contrast->setValue(*share > 0.0 ? isolated(QString("%1 : 1").arg(
                                          countText(static_cast<std::uint64_t>(std::lround(1.0 / *share)))))
                                    : QString::fromUtf8("–"));
  };
  refreshOn(model, part, refresh, &LinearizePage::resultChanged);
  return part;
}

QWidget* inspectorOf(LinearizePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(consentWidget(model));
  column->addWidget(labelOf(LinearizePage::tr("Result"), "section"));
  auto* adds = new Remark;
  auto* linear = new Remark;
  auto* rises = new Remark;
  for (Remark* verdict : {adds, linear, rises}) column->addWidget(verdict);
  auto* findings = new Note(Note::Kind::amber);
  linear->setObjectName("linear-camera");
  rises->setObjectName("rising-curves");
  findings->setObjectName("findings");
  column->addWidget(findings);
  column->addWidget(lineOf());
  column->addWidget(labelOf(LinearizePage::tr("Exposures"), "section"));
  auto* exposures = new ValueRow(LinearizePage::tr("Chosen for this venue"));
  exposures->setObjectName("exposures");
  column->addWidget(exposures);
  column->addWidget(blackPart(model));
  column->addWidget(lineOf());
  column->addWidget(labelOf(LinearizePage::tr("Measure with"), "section"));
  auto* row = new QHBoxLayout;
  row->addWidget(labelOf(LinearizePage::tr("Levels a colour"), "secondary"), 1);
  auto* levels = new QComboBox;
  levels->setObjectName("levels");
  levels->setAccessibleName(LinearizePage::tr("Levels a colour"));
  for (int count : {9, 17, 33, 65}) levels->addItem(QString::number(count), count);
  row->addWidget(levels);
  column->addLayout(row);
  column->addWidget(labelOf(
      LinearizePage::tr("One test pattern shows many levels side by side, so few patterns are enough."),
      "note"));
  QLabel* locked = labelOf({}, "note");
  locked->setObjectName("why-locked");
  column->addWidget(locked);
  column->addStretch(1);
  QObject::connect(levels, &QComboBox::activated, &model,
                   [&model, levels] { model.setLevels(levels->currentData().toInt()); });

  auto refresh = [&model, adds, linear, rises, findings, exposures, levels, locked] {
    using Kind = Remark::Kind;
    levels->setCurrentIndex(levels->findData(model.levels()));
    const QString why = model.whyLocked();
    setPossible(levels, why);
    locked->setText(why);
    locked->setVisible(!why.isEmpty());
    QStringList times;
    for (double seconds : model.exposures()) times << exposureText(seconds);
    exposures->setValue(times.isEmpty() ? QString::fromUtf8("–") : times.join(", "));
    const bool known = model.result() && !model.isMeasuring();
    // Of photographs that contradict each other nothing follows, for camera and projector neither.
    const bool isTrusted = known && !model.isSpoilt();
    linear->setVisible(isTrusted);
    rises->setVisible(isTrusted);
    findings->setVisible(isTrusted && !model.result()->findings.empty());
    if (!known) {
      adds->show(Kind::watch,
                 model.isMeasuring() ? LinearizePage::tr("Measuring") : LinearizePage::tr("Not measured yet"),
                 LinearizePage::tr(
                     "Whether the colours add up, the camera is linear and every level is brighter than the "
                     "one below is told when all levels are measured."));
      return;
    }
    if (!isTrusted) {
      adds->show(Kind::warning, LinearizePage::tr("The photographs contradict each other"),
                 LinearizePage::tr("White differs by %1 from its colours, and levels by up to %2 from their "
                                   "curve: no picture mode does that. Something covered the lens or the "
                                   "picture, or the light changed. Nothing else is told from these "
                                   "photographs; measure again.")
                     .arg(percentText(model.worstAdditivity()), percentText(model.worstResidual())));
      return;
    }
    const linearization::Linearization& result = *model.result();
    const QString worst = percentText(model.worstAdditivity());
    if (model.addsUp())
      adds->show(Kind::good, LinearizePage::tr("The colours add up"),
                 LinearizePage::tr("Red, green and blue together give white within %1.").arg(worst));
    else
      adds->show(
          Kind::warning, LinearizePage::tr("The colours do not add up"),
          LinearizePage::tr("White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in "
                            "the projector's menu, then measure again.")
              .arg(worst));
    const bool identity =
        model.camera() < result.cameras.size() && result.cameras[model.camera()].response[1].isIdentity();
    linear->show(Kind::good,
                 identity ? LinearizePage::tr("The camera is linear")
                          : LinearizePage::tr("The camera's curve is known"),
                 identity ? LinearizePage::tr("Doubling the exposure doubles the signal.")
                          : LinearizePage::tr("Its photographs are brought back to linear light."));
    rises->show(Kind::good, LinearizePage::tr("Curves rise everywhere"),
                LinearizePage::tr("No level is darker than the one below it."));
    QStringList sentences;
    for (const Message& finding : result.findings) sentences << fullSentence(finding);
    findings->setText(LinearizePage::tr("Found while measuring"), sentences.join("\n\n"));
  };
  refreshOn(model, card, refresh, &LinearizePage::settingsChanged, &LinearizePage::resultChanged);
  return card;
}

}  // namespace

PageView viewOf(LinearizePage& model) {
  return {stageOf(model), inspectorOf(model)};
}

}  // namespace relucent::gui
