// SPDX-License-Identifier: MIT
#include "relucent/pjlink/projector.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/terminal_text.h"

namespace relucent::pjlink {
namespace {

/// Asks one thing after the other and notes what was answered by something else.
class Asking {
 public:
  Asking(Session& session, Report& report) : session_(session), report_(report) {}

  /// `read`: std::optional<Value>(std::string_view). None: it does not tell, or nothing that can be read.
  template <typename Read>
  auto operator()(std::string_view command, Read read, std::string_view parameter = "?",
                  int protocolClass = 1) -> decltype(read(std::string_view())) {
    const std::optional<Answer> answer = session_.ask(command, parameter, protocolClass);
    if (answer && answer->refusal) return {};
    auto value = answer ? read(answer->value) : decltype(read(std::string_view()))();
    if (!value) report_.unclear.emplace_back(command);
    return value;
  }

 private:
  Session& session_;
  Report& report_;
};

/// A name as a projector gives it, for logs and pages.
std::optional<std::string> textFrom(std::string_view value) {
  return forLogLine(std::string(value));
}

Obedience obedienceOf(Session& session, const std::optional<Answer>& answer) {
  if (!answer) return Obedience::notNow;
  if (!answer->refusal) return answer->value == "OK" ? Obedience::done : Obedience::notNow;
  switch (*answer->refusal) {
    case Refusal::undefined:
    case Refusal::outOfParameter:
      return Obedience::cannot;
    case Refusal::unavailable:
      return Obedience::notNow;
    case Refusal::failure:
      break;
  }
  throw Error(ErrorKind::device,
              RELUCENT_MESSAGE("pjlink.own-failure", "the projector at {} reports a failure of its own")
                  .with(toString(session.address())),
              RELUCENT_MESSAGE("pjlink.look-at-projector", "look at its lamps and its menu"));
}

Message partOf(Part part) {
  switch (part) {
    case Part::fan:
      return RELUCENT_MESSAGE("pjlink.part-fan", "fan");
    case Part::lamp:
      return RELUCENT_MESSAGE("pjlink.part-lamp", "lamp");
    case Part::temperature:
      return RELUCENT_MESSAGE("pjlink.part-temperature", "temperature");
    case Part::cover:
      return RELUCENT_MESSAGE("pjlink.part-cover", "cover open");
    case Part::filter:
      return RELUCENT_MESSAGE("pjlink.part-filter", "filter");
    case Part::other:
      break;
  }
  return RELUCENT_MESSAGE("pjlink.part-other", "something else");
}

}  // namespace

Report look(Session& session) {
  Report report;
  Asking ask(session, report);
  const auto number = [](std::string_view value) { return numberFrom(value); };
  report.power = ask("POWR", powerFrom);
  if (const auto known = ask("CLSS", number); known && *known >= 1) report.protocolClass = *known;
  report.name = ask("NAME", textFrom).value_or("");
  report.maker = ask("INF1", textFrom).value_or("");
  report.model = ask("INF2", textFrom).value_or("");
  report.lamps = ask("LAMP", lampsFrom).value_or(std::vector<Lamp>());
  report.troubles = ask("ERST", troublesFrom).value_or(std::vector<Trouble>());
  report.shutter = ask("AVMT", shutterFrom);
  report.input = ask("INPT", inputFrom).value_or("");
  if (report.protocolClass < 2) return report;
  // Their inputs have more numbers, which class 1 cannot name.
  if (report.input.empty()) report.input = ask("INPT", inputFrom, "?", 2).value_or("");
  report.serial = ask("SNUM", textFrom, "?", 2).value_or("");
  if (!report.input.empty()) report.inputName = ask("INNM", textFrom, "?" + report.input, 2).value_or("");
  report.signal = ask("IRES", signalFrom, "?", 2);
  if (const auto own = ask("RRES", signalFrom, "?", 2); own && own->kind == Signal::Kind::size)
    report.ownPixels = own->size;
  report.filterHours = ask("FILT", number, "?", 2);
  report.isFrozen = ask("FREZ", number, "?", 2) == 1;
  return report;
}

Obedience switchPower(Session& session, bool on) {
  return obedienceOf(session, session.ask("POWR", on ? "1" : "0"));
}

Obedience closeShutter(Session& session, bool closed) {
  const Obedience alone = obedienceOf(session, session.ask("AVMT", closed ? "11" : "10"));
  // Some know picture and sound together only.
  return alone == Obedience::cannot ? obedienceOf(session, session.ask("AVMT", closed ? "31" : "30")) : alone;
}

std::vector<Message> troublesOf(const Report& report, const std::string& label) {
  std::vector<Message> sentences;
  for (const Trouble& trouble : report.troubles)
    sentences.push_back(trouble.isError
                            ? RELUCENT_MESSAGE("pjlink.reports-error", "projector {} reports an error: {}")
                                  .with(label, partOf(trouble.part))
                            : RELUCENT_MESSAGE("pjlink.reports-warning", "projector {} warns: {}")
                                  .with(label, partOf(trouble.part)));
  return sentences;
}

std::vector<Message> harmfulSettings(const Report& report, const std::string& label,
                                     const std::optional<Size>& sent) {
  std::vector<Message> sentences;
  if (report.isFrozen)
    sentences.push_back(
        RELUCENT_MESSAGE("pjlink.frozen", "projector {} freezes its picture: end that in its menu")
            .with(label));
  if (report.power != Power::on || !report.signal) return sentences;
  if (report.signal->kind == Signal::Kind::none)
    sentences.push_back(
        RELUCENT_MESSAGE("pjlink.no-signal",
                         "projector {} has no signal at its input {}: choose the input of this computer")
            .with(label, report.inputName.empty() ? report.input : report.inputName));
  if (report.signal->kind != Signal::Kind::size) return sentences;
  if (report.ownPixels && *report.ownPixels != report.signal->size)
    sentences.push_back(
        RELUCENT_MESSAGE("pjlink.not-native",
                         "projector {} receives {} pixels and has {}: it scales the picture, which blurs the "
                         "compensation; send it its own size")
            .with(label, as::size(report.signal->size), as::size(*report.ownPixels)));
  if (sent && *sent != report.signal->size)
    sentences.push_back(
        RELUCENT_MESSAGE(
            "pjlink.other-signal",
            "projector {} receives {} pixels where {} are sent: something between scales the picture, or it "
            "shows another input")
            .with(label, as::size(report.signal->size), as::size(*sent)));
  return sentences;
}

}  // namespace relucent::pjlink
