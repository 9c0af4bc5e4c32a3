// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/simulated_projector.h"

#include <fmt/format.h>

namespace relucent::rehearsal {

using pjlink::Power;

SimulatedProjector::SimulatedProjector(ProjectorTimes times) : times_(times) {
  comeBack();
}

void SimulatedProjector::comeBack() {
  server_ = std::make_unique<LoopbackServer>(port_, [this](Visitor& visitor) { serve(visitor); });
  port_ = server_->port();
}

void SimulatedProjector::vanish() {
  server_.reset();
}

Power SimulatedProjector::power() {
  const std::lock_guard lock(guard_);
  pass(Clock::now());
  return power_;
}

void SimulatedProjector::cutPower() {
  const std::lock_guard lock(guard_);
  power_ = Power::off;
  isShut_ = false;
}

void SimulatedProjector::setObeys(bool obeys) {
  const std::lock_guard lock(guard_);
  obeys_ = obeys;
}

void SimulatedProjector::setLampHours(int hours) {
  const std::lock_guard lock(guard_);
  lampHours_ = hours;
}

int SimulatedProjector::timesLit() const {
  const std::lock_guard lock(guard_);
  return timesLit_;
}

void SimulatedProjector::pass(Clock::time_point now) {
  if (now < until_) return;
  if (power_ == Power::warming) power_ = Power::on;
  if (power_ == Power::cooling) power_ = Power::off;
}

std::string SimulatedProjector::order(std::string_view parameter, Clock::time_point now) {
  if (parameter != "0" && parameter != "1") return "ERR2";
  if (power_ == Power::warming || power_ == Power::cooling) return "ERR3";
  if (!obeys_) return "OK";
  if (parameter == "1" && power_ == Power::off) {
    power_ = Power::warming;
    until_ = now + times_.warmUp;
    ++timesLit_;
  }
  if (parameter == "0" && power_ == Power::on) {
    power_ = Power::cooling;
    until_ = now + times_.coolDown;
  }
  return "OK";
}

std::string SimulatedProjector::answerTo(std::string_view line, Clock::time_point now) {
  // %1POWR ?
  if (line.size() < 8 || line[0] != '%' || line[6] != ' ') return {};
  const std::string_view command = line.substr(2, 4), parameter = line.substr(7);
  const std::lock_guard lock(guard_);
  pass(now);
  const bool asks = parameter == "?";
  std::string value = "ERR1";
  if (line[1] != '1') {
    // Of class 2 it knows nothing.
  } else if (command == "POWR") {
    value = asks ? std::to_string(static_cast<int>(power_)) : order(parameter, now);
  } else if (command == "AVMT" && !asks) {
    value = power_ == Power::on ? "OK" : "ERR3";
    if (value == "OK" && obeys_) isShut_ = parameter.ends_with('1');
  } else if (asks) {
    if (command == "AVMT") value = isShut_ ? "31" : "30";
    if (command == "CLSS") value = "1";
    if (command == "NAME") value = "Rehearsal";
    if (command == "INF1") value = "Relucent";
    if (command == "INF2") value = "simulated projector";
    if (command == "INPT") value = "31";
    if (command == "ERST") value = "000000";
    if (command == "LAMP") value = fmt::format("{} {}", lampHours_, power_ == Power::on ? 1 : 0);
  }
  return fmt::format("{}={}", line.substr(0, 6), value);
}

void SimulatedProjector::serve(Visitor& visitor) {
  if (!visitor.send("PJLINK 0\r")) return;
  for (std::string received; visitor.receive(received);) {
    for (std::size_t end; (end = received.find('\r')) != std::string::npos; received.erase(0, end + 1)) {
      const std::string answer = answerTo(std::string_view(received).substr(0, end), Clock::now());
      if (answer.empty() || !visitor.send(answer + "\r")) return;
    }
    if (received.size() > pjlink::longestLine) return;
  }
}

}  // namespace relucent::rehearsal
