// SPDX-License-Identifier: MIT
#include "wizard/frame/end_question.h"

#include <QStringList>
#include <utility>

namespace relucent::gui {

EndQuestion::EndQuestion(const Session& session, QObject* parent)
    : QObject(parent),
      session_(session),
      end_(new PageCommand(Icon::stop, this)),
      stay_(new PageCommand(Icon::play, this)) {
  connect(end_, &QAction::triggered, this, [this] {
    if (auto work = std::exchange(afterwards_, {})) work();
  });
  connect(stay_, &QAction::triggered, this, [this] { afterwards_ = {}; });
  connect(&session_, &Session::devicesChanged, this, &EndQuestion::withdraw);
  connect(&session_, &Session::showingChanged, this, &EndQuestion::withdraw);
}

/// What it asked about has changed since: an answer would be to something else.
void EndQuestion::withdraw() {
  if (!reason_ || session_.underWay() == asked_) return;
  afterwards_ = {};
  reason_.reset();
}

void EndQuestion::whenNothingEnds(std::function<void()> work,
                                  const std::function<void(const FailureReport&)>& ask) {
  if (!isNeeded()) return work();
  afterwards_ = std::move(work);
  ask(question());
}

FailureReport EndQuestion::question() {
  const UnderWay now = asked_ = session_.underWay();
  reason_ = std::make_unique<QObject>();
  QStringList ends, safe;
  if (now.measurement) {
    ends << tr("%1 in the venue “%2”.").arg(session_.devicesUserName(), session_.name());
    safe << tr("Every photograph is on the disk. Opened again, the venue goes on from there.");
  }
  if (now.show) {
    ends << (session_.isSimulated()
                 ? tr("The show of the venue “%1”.").arg(session_.name())
                 : tr("The show of the venue “%1”: the projector's screen goes dark.").arg(session_.name()));
    safe << tr("Playlist and results are on the disk. Open the output again to play the show again.");
  }
  FailureReport question;
  question.isQuestion = question.endsWork = true;
  question.failure.what = ends.join('\n');
  question.safe = safe.join('\n');
  if (now.measurement && now.show) {
    question.failure.heading = tr("A measurement and a show are under way");
    end_->show(tr("End both"));
    stay_->show(tr("Let both go on"));
  } else if (now.measurement) {
    question.failure.heading = tr("A measurement is under way");
    end_->show(tr("End it for now"));
    stay_->show(tr("Go on measuring"));
  } else {
    question.failure.heading = tr("A show is playing");
    end_->show(tr("End the show"));
    stay_->show(tr("Go on playing"));
  }
  question.reason = reason_.get();
  question.goOn = end_;
  question.resume = stay_;
  return question;
}

}  // namespace relucent::gui
