// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>
#include <functional>
#include <memory>

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Asked before something ends what is under way: a measurement, a show, or both.
class EndQuestion : public QObject {
  Q_DECLARE_TR_FUNCTIONS(EndQuestion)

 public:
  explicit EndQuestion(const Session& session, QObject* parent = nullptr);

  bool isNeeded() const { return !session_.underWay().isNothing(); }
  /// Does it at once where nothing ends by it; else `ask` shows the question, and it is done once somebody
  /// has agreed. What ends by itself meanwhile needs no answer: the question goes, and nothing is done.
  void whenNothingEnds(std::function<void()> work, const std::function<void(const FailureReport&)>& ask);

 private:
  FailureReport question();
  void withdraw();

  const Session& session_;
  UnderWay asked_;
  std::unique_ptr<QObject> reason_;
  std::function<void()> afterwards_;  // what somebody is asked to agree to
  PageCommand *end_, *stay_;
};

}  // namespace relucent::gui
