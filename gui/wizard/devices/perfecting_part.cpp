// SPDX-License-Identifier: MIT
#include "wizard/devices/perfecting_part.h"

#include <QDateTime>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "output/output_playlist.h"
#include "text/message_text.h"
#include "text/written_times.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

/// Camera after camera; with as many decimals as tell one from the other.
QString figures(const std::vector<pipeline::PictureError>& views,
                const std::vector<pipeline::PictureError>& others) {
  const auto textsOf = [](const std::vector<pipeline::PictureError>& all, int decimals) {
    QStringList errors;
    for (const pipeline::PictureError& view : all) errors << decimalText(view.deltaE, decimals);
    return errors;
  };
  const bool areAlike = textsOf(views, 1) == textsOf(others, 1);
  return isolated(QString::fromUtf8("ΔE %1").arg(textsOf(views, areAlike ? 2 : 1).join(", ")));
}

QString nameOf(const QString& picture) {
  return isolated(OutputPlaylist::nameOf(picture));
}

QString dateText(const std::string& iso) {
  const QDateTime when = timeWritten(iso).toLocalTime();
  return QLocale().toString(when, QLocale::ShortFormat);
}

/// What a try came to that changed nothing.
QString vainText(const pipeline::PerfectedImage& outcome) {
  if (!outcome.failure.empty()) return fullSentence(outcome.failure);
  if (outcome.end == pipeline::PerfectingEnd::disturbed)
    return Perfecting::tr("%1 The picture is shown as before. Try again.")
        .arg(fullSentence(outcome.disturbance));
  return Perfecting::tr("The photographs found nothing better. The picture is shown as before.");
}

/// The same of the picture that is shown; empty: it was another one, it was perfected, or none was tried.
QString vainText(const Perfecting& perfecting) {
  const auto& outcome = perfecting.outcome();
  if (!outcome || outcome->kept || !perfecting.isOfShown()) return {};
  return vainText(*outcome);
}

/// What became of the picture that was tried while another one plays by now; empty: it is that one.
QString elsewhereText(const Perfecting& perfecting) {
  const auto& outcome = perfecting.outcome();
  if (!outcome || perfecting.isOfShown()) return {};
  const QString result = outcome->kept ? Perfecting::tr("perfected, %1 before, %2 now.")
                                             .arg(figures(outcome->before.views, outcome->after.views),
                                                  figures(outcome->after.views, outcome->before.views))
                                       : vainText(*outcome);
  return Perfecting::tr("Tried last, %1: %2").arg(nameOf(perfecting.tried()), result);
}

void showState(Remark& remark, const Perfecting& perfecting) {
  const QString vain = vainText(perfecting);
  if (perfecting.isRunning()) {
    const QString taken =
        Perfecting::tr("Picture: %1").arg(nameOf(perfecting.tried())) + '\n' +
        Perfecting::tr("%n photograph(s) by now. Keep the room as it is.", nullptr, perfecting.photographs());
    return remark.show(
        Remark::Kind::watch, Perfecting::tr("The picture is being perfected"),
        perfecting.isSlow()
            ? taken + '\n' + Perfecting::tr("Slowly, as the room is not said to be clear: nothing flashes.")
            : taken);
  }
  const QString elsewhere = elsewhereText(perfecting);
  // Of a list that plays, which one is meant.
  const auto withElsewhere = [&](const QString& meaning) {
    QStringList lines{Perfecting::tr("Picture: %1").arg(nameOf(perfecting.picture())), meaning};
    if (perfecting.picture().isEmpty()) lines.removeFirst();
    if (!elsewhere.isEmpty()) lines << elsewhere;
    return lines.join('\n');
  };
  if (const auto& known = perfecting.known()) {
    const QString better =
        Perfecting::tr("%1: %2 before, %3 now, by %n photograph(s).", nullptr, known->figures.photographs)
            .arg(dateText(known->perfected), figures(known->figures.before, known->figures.after),
                 figures(known->figures.after, known->figures.before));
    return remark.show(Remark::Kind::good, Perfecting::tr("This picture is perfected"),
                       withElsewhere(vain.isEmpty() ? better : better + '\n' + vain));
  }
  if (!vain.isEmpty())
    return remark.show(perfecting.outcome()->end == pipeline::PerfectingEnd::disturbed ||
                               !perfecting.outcome()->failure.empty()
                           ? Remark::Kind::warning
                           : Remark::Kind::good,
                       Perfecting::tr("The picture is as it was"), vain);
  if (perfecting.wasBefore())
    return remark.show(Remark::Kind::watch, Perfecting::tr("Not perfected since it changed"),
                       withElsewhere(Perfecting::tr("It was perfected for an earlier measurement, for "
                                                    "another set, with other light or masks, or placed "
                                                    "otherwise. That is kept, and is of no use now: "
                                                    "perfect it once more.")));
  remark.show(Remark::Kind::watch, Perfecting::tr("Not perfected"),
              withElsewhere(Perfecting::tr(
                  "A picture that stands can be corrected by photographs of itself, some eight of them. It "
                  "is kept for this venue, placed as it is now.")));
}

}  // namespace

QWidget* perfectingPart(DevicePage& page, Perfecting& perfecting, const PerfectingActions& actions) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(Perfecting::tr("Perfect a picture"), "section"));
  auto* state = new Remark;
  state->setObjectName("perfect-remark");
  state->keepRoom();  // from picture to picture of a list that plays
  column->addWidget(state);
  auto* perfect = new ActionButton(Icon::camera, Perfecting::tr("Perfect this picture"));
  perfect->setObjectName("perfect");
  column->addWidget(perfect);
  QPushButton* stop = buttonOf(Perfecting::tr("Stop and keep the best"));
  stop->setObjectName("perfect-stop");
  column->addWidget(stop);
  QPushButton* forget = buttonOf(Perfecting::tr("Show it as before"));
  forget->setObjectName("perfect-forget");
  forget->setToolTip(Perfecting::tr("What the photographs corrected is dropped."));
  column->addWidget(forget);
  QObject::connect(perfect, &QPushButton::clicked, &perfecting, actions.start);
  QObject::connect(stop, &QPushButton::clicked, &perfecting, &Perfecting::stopAndKeep);
  QObject::connect(forget, &QPushButton::clicked, &perfecting, &Perfecting::forget);
  auto refresh = [=, &perfecting] {
    showState(*state, perfecting);
    perfect->setVisible(!perfecting.isRunning());
    perfect->setText(perfecting.known() ? Perfecting::tr("Perfect it again")
                                        : Perfecting::tr("Perfect this picture"));
    perfect->setWhyNot(actions.whyNot());
    stop->setVisible(perfecting.isRunning());
    const bool isKnown = perfecting.known().has_value() && !perfecting.isRunning();
    QSizePolicy place = forget->sizePolicy();
    place.setRetainSizeWhenHidden(isKnown || place.retainSizeWhenHidden());
    forget->setSizePolicy(place);
    forget->setVisible(isKnown);
  };
  refreshOn(page, part, refresh, &DevicePage::statusChanged, &DevicePage::settingsChanged,
            &DevicePage::resultChanged);
  QObject::connect(&perfecting, &Perfecting::changed, part, refresh);
  QObject::connect(&perfecting, &Perfecting::progressed, part, refresh);
  QObject::connect(&Theme::instance(), &Theme::changed, part, refresh);
  return part;
}

}  // namespace relucent::gui
