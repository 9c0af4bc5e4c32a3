// SPDX-License-Identifier: MIT
// A show as it is controlled and watched from outside.
#include <QTimer>

#include "output/output_playlist.h"
#include "output/show.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/sets.h"

namespace relucent::gui {

void Show::listen() {
  listenToControls();
  showStatus();
}

void Show::showStatus() {
  if (!settings_.status || page_) return;
  try {
    page_ = std::make_unique<StatusServer>(*settings_.status, [this] { return health(); });
  } catch (const Error& error) {
    const QString why = error.what();
    if (why != whyNoPage_) log_.warn(why);
    whyNoPage_ = why;
    return;
  }
  log_.tell("status page at http://" + textOf(page_->place()) + "/");
}

std::optional<NetworkPlace> Show::status() const {
  return page_ ? std::optional(page_->place()) : std::nullopt;
}

void Show::listenToControls() {
  if (!settings_.osc || server_) return;
  try {
    server_ = std::make_unique<OscServer>(*settings_.osc);
  } catch (const Error& error) {
    const QString why = error.what();
    if (why != whyNoOsc_) log_.warn(why);
    whyNoOsc_ = why;
    return;
  }
  RemoteActions& actions = *this;
  control_ = std::make_unique<RemoteControl>(*server_, actions, settings_.oscFeedback);
  const auto warn = [this](const QString& sentence) { log_.warn(sentence); };
  connect(server_.get(), &OscServer::warned, this, warn);
  connect(control_.get(), &RemoteControl::warned, this, warn);
  log_.tell("listening to OSC at " + textOf(server_->place()));
}

std::optional<NetworkPlace> Show::osc() const {
  return server_ ? std::optional(server_->place()) : std::nullopt;
}

void Show::tellControl() {
  if (control_) control_->report();
}

RemoteState Show::state() const {
  RemoteState state;
  state.items = settings_.content.items.size();
  state.set = QString::fromStdString(playing_.name);
  if (content_) state.item = content_->status().playing;
  if (!player_) return state;
  state.paused = player_->isPlaying() && player_->isFrozen();
  state.black = player_->isBlack();
  state.compensated = player_->isCompensated();
  state.brightness = player_->brightness();
  state.chart = player_->chart();
  return state;
}

void Show::setPaused(bool paused) {
  // Outside its hours it stands still anyhow.
  if (player_ && player_->isPlaying()) player_->setFrozen(paused);
}

void Show::setBlack(bool black) {
  if (player_) player_->setBlack(black);
  tellProjectors();
  writeHealth(state_);
}

void Show::setCompensated(bool compensated) {
  if (player_) player_->setCompensated(compensated);
}

void Show::setBrightness(double brightness) {
  if (player_) player_->setBrightness(brightness);
}

void Show::setChart(std::optional<TestChart> chart) {
  if (player_) player_->setChart(chart);
}

void Show::playItem(qsizetype index) {
  if (content_) content_->playItem(index);
}

Message Show::moveViewer(const compensation::Position& position) {
  if (!player_ || !player_->canFollowViewers())
    return RELUCENT_ENGLISH_MESSAGE("show.camera-positions-unknown",
                                    "where the cameras stand is not known, or there is only one: give the "
                                    "position of every camera with --camera-position");
  if (!player_->moveViewer(position))
    return RELUCENT_ENGLISH_MESSAGE("show.viewer-not-finite", "the viewer's position must be finite numbers");
  // He has what there is at the border; somebody should know.
  return compensation::farFromCameras(player_->cameras(), position);
}

Message Show::whyNoPhotographs() const {
  if (state_ != ShowState::playing)
    return RELUCENT_ENGLISH_MESSAGE("show.not-playing", "the show does not play now: try again when it does");
  if (player_->isBlack())
    return RELUCENT_ENGLISH_MESSAGE("show.is-black", "the picture is black now: end that, and try again");
  return photographs_.whyNot();
}

void Show::makeWay() {
  if (player_) player_->stop();
  for (const auto& window : windows_) window->stop();
  writeHealth(ShowState::photographing);
}

Message Show::check() {
  if (const Message why = whyNoPhotographs(); !why.empty()) return why;
  log_.tell("checking the calibration by photographs");
  makeWay();
  photographs_.check();
  return {};
}

Message Show::perfect() {
  if (const Message why = whyNoPhotographs(); !why.empty()) return why;
  const qsizetype item = content_->status().playing;
  if (item < 0) return RELUCENT_ENGLISH_MESSAGE("remote.nothing-plays", "there is nothing to play");
  const QString path = settings_.content.items[item].path;
  if (!OutputPlaylist::isStill(settings_.content.items[item]))
    return RELUCENT_ENGLISH_MESSAGE("show.no-still-plays", "what plays now is no still picture");
  log_.tell("perfecting " + path + " by photographs");
  makeWay();
  photographs_.perfect(path.toStdString(), settings_.canvas, playing_.opened);
  return {};
}

Message Show::useSet(const QString& name) {
  const std::string wanted = name.toStdString();
  try {
    pipeline::openWithSet(settings_.calibration, wanted);
  } catch (const Error& error) {
    return error.sentence();
  }
  if (wanted == playing_.name) {
    // After the answer that it has begun.
    QTimer::singleShot(0, this, [this, name] { tellSet("shown", name); });
  }
  wish(wanted);
  return {};
}

void Show::tellSet(const QString& verdict, const QString& sentence) {
  if (control_) control_->announce("/set", "done", {verdict, sentence});
}

}  // namespace relucent::gui
