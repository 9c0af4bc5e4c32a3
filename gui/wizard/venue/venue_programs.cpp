// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_programs.h"

#include "relucent/base/error.h"
#include "relucent/pipeline/command_devices.h"
#include "text/message_text.h"

namespace relucent::gui {

VenuePrograms::VenuePrograms(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &Session::opened, this, &VenuePrograms::forget);
}

std::vector<std::string> VenuePrograms::used() const {
  return session_.isOpen() ? pipeline::commandsOf(session_.settings().rig) : std::vector<std::string>();
}

std::size_t VenuePrograms::projectors() const {
  return pipeline::projectorCommandsOf(session_.settings().rig);
}

void VenuePrograms::type(std::size_t program, const std::string& command) {
  if (program >= typed_.size()) return;
  typed_[program] = command;
  Q_EMIT changed();
}

void VenuePrograms::forget() {
  typed_ = used();
}

QString VenuePrograms::problem() const {
  pipeline::CalibrateSettings settings = session_.settings();
  settings.rig = pipeline::withCommands(settings.rig, typed_);
  const std::vector<Message> found = problems(settings);
  return found.empty() ? QString() : fullSentence(found.front());
}

void VenuePrograms::apply() {
  require(isChangeable() && typed_.size() == used().size(), "there is no program to change");
  session_.changeCommands(typed_);
  forget();
}

}  // namespace relucent::gui
