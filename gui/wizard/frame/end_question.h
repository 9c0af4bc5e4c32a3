// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Asked before something ends the measurement that is under way.  `end`, `stay`: the answers.
inline FailureReport endQuestion(const Session& session, PageCommand* end, PageCommand* stay) {
  const auto words = [](const char* english) { return QCoreApplication::translate("EndQuestion", english); };
  FailureReport question;
  question.failure.heading = words(QT_TRANSLATE_NOOP("EndQuestion", "A measurement is under way"));
  question.failure.what = words(QT_TRANSLATE_NOOP("EndQuestion", "%1 in the venue “%2”."))
                              .arg(session.devicesUserName(), session.name());
  question.safe = words(QT_TRANSLATE_NOOP(
      "EndQuestion", "Every photograph is on the disk. Opened again, the venue goes on from there."));
  end->show(words(QT_TRANSLATE_NOOP("EndQuestion", "End it for now")));
  stay->show(words(QT_TRANSLATE_NOOP("EndQuestion", "Go on measuring")));
  question.goOn = end;
  question.resume = stay;
  question.isQuestion = true;
  return question;
}

}  // namespace relucent::gui
