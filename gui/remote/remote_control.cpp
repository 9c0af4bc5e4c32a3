// SPDX-License-Identifier: MIT
#include "remote/remote_control.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

using Arguments = std::vector<OscArgument>;

constexpr double mostBrightness = 1.5;

Message takes(const char* range) {
  return RELUCENT_ENGLISH_MESSAGE("remote.wrong-argument", "it takes {}").with(range);
}

std::optional<double> numberAt(const Arguments& arguments, std::size_t place) {
  const auto* number = std::get_if<double>(&arguments[place]);
  return number != nullptr && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

/// A switch: 0 or 1, as controllers send them.
template <void (RemoteActions::*set)(bool)>
Message switched(RemoteActions& actions, const Arguments& arguments) {
  const std::optional<double> value = numberAt(arguments, 0);
  if (value != 0.0 && value != 1.0) return takes("0 or 1");
  (actions.*set)(*value != 0.0);
  return {};
}

template <bool paused>
Message play(RemoteActions& actions, const Arguments&) {
  actions.setPaused(paused);
  return {};
}

Message next(RemoteActions& actions, const Arguments&) {
  const RemoteState state = actions.state();
  if (state.items == 0) return RELUCENT_ENGLISH_MESSAGE("remote.nothing-plays", "there is nothing to play");
  actions.playItem((state.item + 1) % state.items);
  return {};
}

Message playItem(RemoteActions& actions, const Arguments& arguments) {
  const std::optional<double> number = numberAt(arguments, 0);
  const qsizetype items = actions.state().items;
  if (!number || *number != std::trunc(*number) || *number < 1.0 || *number > static_cast<double>(items))
    return RELUCENT_ENGLISH_MESSAGE("remote.no-such-item", "it takes the number of an item, 1 to {}")
        .with(as::label(static_cast<std::size_t>(items)));
  actions.playItem(static_cast<qsizetype>(*number) - 1);
  return {};
}

Message setBrightness(RemoteActions& actions, const Arguments& arguments) {
  const std::optional<double> value = numberAt(arguments, 0);
  if (!value || *value < 0.0 || *value > mostBrightness) return takes("a number from 0 to 1.5");
  actions.setBrightness(*value);
  return {};
}

Message setChart(RemoteActions& actions, const Arguments& arguments) {
  const auto* name = std::get_if<QString>(&arguments[0]);
  const std::optional<TestChart> chart = name != nullptr ? testChartFromName(*name) : std::nullopt;
  if (!chart && (name == nullptr || *name != "none")) {
    QStringList known;
    for (TestChart one : allTestCharts) known.append(testChartName(one));
    return RELUCENT_ENGLISH_MESSAGE("remote.no-such-chart", "it takes one of {} or none")
        .with(known.join(", ").toStdString());
  }
  actions.setChart(chart);
  return {};
}

Message useSet(RemoteActions& actions, const Arguments& arguments) {
  const auto* name = std::get_if<QString>(&arguments[0]);
  if (name == nullptr || name->isEmpty()) return takes("the name of a set");
  return actions.useSet(*name);
}

Message moveViewer(RemoteActions& actions, const Arguments& arguments) {
  compensation::Position position{};
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::optional<double> value = numberAt(arguments, k);
    if (!value) return takes("two or three finite numbers");
    position[k] = *value;
  }
  return actions.moveViewer(position);
}

template <Message (RemoteActions::*begin)()>
Message photograph(RemoteActions& actions, const Arguments&) {
  return (actions.*begin)();
}

constexpr auto one = [](bool value) { return Arguments{value ? 1.0 : 0.0}; };

constexpr RemoteInput onOff{RemoteInput::Kind::onOff};

constexpr std::array commands{
    RemoteCommand{"/play", "", "Content goes on.", 0, 0, play<false>, nullptr},
    RemoteCommand{"/pause", "", "Picture and content stand still.", 0, 0, play<true>, nullptr},
    RemoteCommand{"/freeze", "0 or 1", "The same as one switch.", 1, 1, switched<&RemoteActions::setPaused>,
                  [](const RemoteState& state) { return one(state.paused); }, onOff},
    RemoteCommand{"/next", "", "The next item of the playlist, after the last one the first.", 0, 0, next,
                  nullptr},
    RemoteCommand{"/item",
                  "its number, from 1",
                  "An item of the playlist.",
                  1,
                  1,
                  playItem,
                  [](const RemoteState& state) { return Arguments{static_cast<double>(state.item + 1)}; },
                  {RemoteInput::Kind::whole, 1.0}},
    RemoteCommand{"/brightness",
                  "0 to 1.5",
                  "Brightness of white, relative to the calibration's.",
                  1,
                  1,
                  setBrightness,
                  [](const RemoteState& state) { return Arguments{state.brightness}; },
                  {RemoteInput::Kind::range, 0.0, mostBrightness}},
    RemoteCommand{"/compensation", "0 or 1", "Compensation off and on.", 1, 1,
                  switched<&RemoteActions::setCompensated>,
                  [](const RemoteState& state) { return one(state.compensated); }, onOff},
    RemoteCommand{"/black", "0 or 1", "Black instead of the picture; content goes on meanwhile.", 1, 1,
                  switched<&RemoteActions::setBlack>,
                  [](const RemoteState& state) { return one(state.black); }, onOff},
    RemoteCommand{"/chart",
                  "a chart's name, or none",
                  "A test chart instead of the content.",
                  1,
                  1,
                  setChart,
                  [](const RemoteState& state) {
                    return Arguments{state.chart ? testChartName(*state.chart) : QString("none")};
                  },
                  {RemoteInput::Kind::chart}},
    RemoteCommand{"/set",
                  "a set's name",
                  "Content as that set of the calibration has it; the picture goes on as it is until that is "
                  "prepared, some seconds.",
                  1,
                  1,
                  useSet,
                  [](const RemoteState& state) { return Arguments{state.set}; },
                  {RemoteInput::Kind::name},
                  true},
    RemoteCommand{"/viewer",
                  "x y, or x y z",
                  "Where the viewer stands, in the units of the cameras' positions; without a word for two "
                  "seconds he is no longer there.",
                  2,
                  3,
                  moveViewer,
                  nullptr,
                  {RemoteInput::Kind::place, -5.0, 5.0}},
    RemoteCommand{"/check",
                  "",
                  "Photographs test patterns: is the calibration still valid? Takes a minute or more.",
                  0,
                  0,
                  photograph<&RemoteActions::check>,
                  nullptr,
                  {},
                  true},
    RemoteCommand{"/perfect",
                  "",
                  "Corrects the still picture that plays by photographs of itself. Takes a minute or more.",
                  0,
                  0,
                  photograph<&RemoteActions::perfect>,
                  nullptr,
                  {},
                  true},
};

/// What a controller's button sends: whether it was pressed, or let go of.
std::optional<bool> pressOf(const Arguments& arguments) {
  if (arguments.size() != 1) return {};
  const std::optional<double> value = numberAt(arguments, 0);
  return value == 0.0 || value == 1.0 ? std::optional(*value == 1.0) : std::nullopt;
}

const RemoteCommand* commandAt(const QString& address) {
  const auto found = std::ranges::find_if(
      commands, [&](const RemoteCommand& command) { return address == command.address; });
  return found != commands.end() ? &*found : nullptr;
}

}  // namespace

std::span<const RemoteCommand> remoteCommands() {
  return commands;
}

RemoteControl::RemoteControl(OscServer& server, RemoteActions& actions, std::optional<NetworkPlace> feedback,
                             QObject* parent)
    : QObject(parent),
      server_(server),
      actions_(actions),
      feedback_(std::move(feedback)),
      reported_(commands.size()),
      minute_(server.now()) {
  connect(&server, &OscServer::received, this, &RemoteControl::obey);
  report();
}

void RemoteControl::report() {
  if (!feedback_) return;
  const RemoteState state = actions_.state();
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (commands[i].value == nullptr) continue;
    std::vector<OscArgument> value = commands[i].value(state);
    if (value == reported_[i]) continue;
    server_.send({commands[i].address, value}, *feedback_);
    reported_[i] = std::move(value);
  }
}

void RemoteControl::announce(const QString& address, const QString& what,
                             const std::vector<OscArgument>& arguments) {
  const OscMessage message{address + '/' + what, arguments};
  const auto asker = askers_.find(address);
  if (asker != askers_.end()) server_.send(message, asker->second);
  if (feedback_ && (asker == askers_.end() || !(asker->second == *feedback_)))
    server_.send(message, *feedback_);
}

bool RemoteControl::isNew(const QString& kind) {
  const OscServer::Time now = server_.now();
  if (now - minute_ >= std::chrono::minutes(1)) {
    minute_ = now;
    told_.clear();
  }
  return told_.size() < mostSentences && told_.insert(kind).second;
}

void RemoteControl::refuse(const OscMessage& message, const NetworkPlace& from, const QString& kind,
                           const QString& sentence) {
  const QString address = message.address.left(100);
  const bool told = isNew(address + ' ' + kind);
  if (told) Q_EMIT warned("OSC message " + address + ": " + sentence);
  if (told || message.address != "/viewer") server_.send({"/error", {address, sentence}}, from);
}

void RemoteControl::obey(const OscMessage& message, const NetworkPlace& from) {
  const RemoteCommand* command = commandAt(message.address);
  if (command == nullptr) return refuse(message, from, "address", "there is no such address");
  const std::optional<bool> press = command->most == 0 ? pressOf(message.arguments) : std::nullopt;
  if (press == false) return;
  const Arguments& arguments = press ? Arguments() : message.arguments;
  const std::size_t given = arguments.size();
  const bool asks = given == 0 && command->least > 0 && command->value != nullptr;
  if (!asks) {
    if (given < command->least || given > command->most)
      return refuse(message, from, "arguments",
                    QString("it takes %1")
                        .arg(command->most > 0 ? command->arguments : "no arguments, or a button's 0 or 1"));
    if (const Message why = command->run(actions_, arguments); !why.empty())
      return refuse(message, from, QString::fromStdString(why.id()),
                    QString::fromStdString(englishSentence(why)));
  }
  if (command->isLong && !asks) {
    askers_[command->address] = from;
    announce(command->address, "begun", {});
  }
  if (command->value != nullptr) server_.send({command->address, command->value(actions_.state())}, from);
  report();
}

}  // namespace relucent::gui
