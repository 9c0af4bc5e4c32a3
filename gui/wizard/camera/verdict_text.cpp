// SPDX-License-Identifier: MIT
#include "wizard/camera/verdict_text.h"

#include <QCoreApplication>

#include "views/number_text.h"

namespace relucent {
namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(CheckVerdict)
};

constexpr QChar narrowSpace(0x202F);

QString percent(double share, int decimals) {
  return isolated(decimalText(100.0 * share, decimals) + narrowSpace + '%');
}

QString milliseconds(double seconds, int decimals) {
  return isolated(decimalText(1000.0 * seconds, decimals) + narrowSpace + "ms");
}

}  // namespace

QString verdictText(const CheckVerdict& verdict) {
  const QString screen = QString::fromStdString(verdict.screen), frame = milliseconds(verdict.frame, 2);
  switch (verdict.finding) {
    case Finding::screenSeen:
      return Words::tr("The camera sees %1: %2 of its view follow the test pattern.")
          .arg(screen, percent(verdict.share, 0));
    case Finding::screenMirrored:
      return Words::tr(
          "The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off "
          "in the projector's menu.");
    case Finding::picturesLate:
      return Words::tr(
          "Pictures come late, by %n photograph(s): the latency has to be measured and waited for.", nullptr,
          verdict.count);
    case Finding::otherScreenSeen:
      return Words::tr("The camera sees %1 and not %2.").arg(QString::fromStdString(verdict.instead), screen);
    case Finding::screenNotSeen:
      return Words::tr("The camera does not see %1.").arg(screen);
    case Finding::pictureOut:
      return Words::tr("A picture is out %n frame(s) after it is sent: %1 are waited for.", nullptr,
                       verdict.count)
          .arg(milliseconds(verdict.seconds, 0));
    case Finding::whiteChanges:
      return Words::tr(
                 "White changes by %1 from photograph to photograph: expose whole frames of the projector, "
                 "multiples of %2, and switch its dynamic brightness off.")
          .arg(percent(verdict.share, 1), frame);
    case Finding::lightUnsteady:
      return Words::tr(
                 "The light changes by %1 between exposures of whole frames: let the lamp warm up, and "
                 "switch dynamic brightness and lamps in the room off.")
          .arg(percent(verdict.share, 1));
    case Finding::noBriefExposure:
      return Words::tr(
          "The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame "
          "cannot be told.");
    case Finding::lampFlickers:
      return Words::tr("The lamp flickers within a frame, by %1 in %2: expose whole frames, multiples of %3.")
          .arg(percent(verdict.share, 0), milliseconds(verdict.seconds, 1), frame);
    case Finding::colourWheel:
      return Words::tr(
                 "The colours come one after the other, as through a colour wheel (%1 in %2): expose whole "
                 "frames, multiples of %3.")
          .arg(percent(verdict.share, 0), milliseconds(verdict.seconds, 1), frame);
    case Finding::rollingShutter:
      return Words::tr(
                 "The camera exposes its rows one after the other (rolling shutter): brief exposures have "
                 "bands of %1. Expose whole frames, multiples of %2.")
          .arg(percent(verdict.share, 0), frame);
    case Finding::dithering:
      return Words::tr(
                 "The projector mixes greys in time, pixel by pixel (%1): expose several whole frames, and "
                 "switch its smoothing and 3D modes off.")
          .arg(percent(verdict.share, 0));
    case Finding::lightEven:
      return Words::tr("The light is even: no flicker, colour wheel, bands or dithering is seen.");
  }
  return {};
}

}  // namespace relucent
