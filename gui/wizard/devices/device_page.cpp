// SPDX-License-Identifier: MIT
#include "wizard/devices/device_page.h"

#include "wizard/session/missing_screen.h"

namespace relucent::gui {

DevicePage::DevicePage(const StepName& step, Session& session, QObject* parent)
    : PageModel(step, parent), session_(session) {
  endShow_ = addCommand(Icon::stop, [this] { askToEndShow(); });
  endShowNow_ = addCommand(Icon::stop, [this] {
    endingShow_.reset();
    try {
      session_.endOtherShow();
    } catch (...) {
      Q_EMIT failed({failureOf(std::current_exception()), tr("The show plays on.")});
    }
  });
  letItPlay_ = addCommand(Icon::play, [this] { endingShow_.reset(); });
  connect(&session_, &Session::opened, this, [this] { projector_ = camera_ = 0; });
  connect(&session_, &Session::devicesChanged, this, [this] {
    if (!session_.isShownElsewhere()) endingShow_.reset();  // and the question goes with what it is about
  });
}

void DevicePage::updateCommands() {
  const bool isEnding = session_.isOtherShowEnding();
  endShow_->show(isEnding ? tr("It is ending") : tr("End that show"), !isEnding);
  endShowNow_->show(tr("End the show"));
  letItPlay_->show(tr("Let it play"));
}

void DevicePage::askToEndShow() {
  endingShow_ = std::make_unique<QObject>();
  FailureReport question;
  question.isQuestion = question.endsWork = true;
  question.failure.heading = tr("A show is playing");
  question.failure.what =
      session_.isAnotherVenueShown()
          ? tr("The show that another program plays of another venue: the projector's screen goes dark.")
          : tr("The show that another program plays of this venue: the projector's screen goes dark.");
  question.safe = tr("Venue and playlist stay. An installed show starts again at the next log-in.");
  question.goOn = endShowNow_;
  question.resume = letItPlay_;
  question.reason = endingShow_.get();
  Q_EMIT failed(question);
}

std::optional<Banner> DevicePage::besideAnotherShow() const {
  if (!session_.isShownElsewhere()) return std::nullopt;
  return Banner{
      Banner::Kind::amber,
      session_.isAnotherVenueShown() ? tr("Another program plays a show of another venue on this projector")
                                     : tr("Another program plays a show of this venue"),
      !missingScreen(session_).isEmpty()
          ? tr("The projector's screen is unplugged. Plug it in again: the show comes back by itself.")
          : tr("Its pictures shine on the projector whatever is shown from here, and may come between "
               "patterns "
               "that are measured."),
      endShow_};
}

void DevicePage::showProjector(std::size_t projector) {
  if (projector == projector_ || projector >= projectors()) return;
  projector_ = projector;
  projectorChanged();
  tellSettings();
}

void DevicePage::showCamera(std::size_t camera) {
  if (camera == camera_ || camera >= cameras()) return;
  camera_ = camera;
  cameraChanged();
  tellSettings();
}

std::optional<Banner> DevicePage::overTheShow() const {
  // What is simulated is measured without a screen.
  if (!session_.isSimulated())
    if (auto beside = besideAnotherShow()) return beside;
  if (!session_.underWay().show || session_.isSimulated() || !session_.areDevicesFree()) return std::nullopt;
  return Banner{Banner::Kind::information, tr("A show is playing"),
                tr("What is begun here shines in its place. The show is seen again once it has ended.")};
}

}  // namespace relucent::gui
