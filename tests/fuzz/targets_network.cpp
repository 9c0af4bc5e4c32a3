// SPDX-License-Identifier: MIT
// What projectors on the network answer.
#include "fuzz/targets.h"
#include "relucent/pjlink/protocol.h"

namespace relucent::fuzz {
namespace {

std::vector<std::string> answerSeeds() {
  return {"PJLINK 0",
          "PJLINK 1 498e4a67",
          "PJLINK 2 0123456789abcdef",
          "PJLINK ERRA",
          "%1POWR=1",
          "%1POWR=ERR3",
          "%1AVMT=31",
          "%1ERST=010200",
          "%1LAMP=12345 1 0 0",
          "%2INPT=31",
          "%2IRES=1920x1080",
          "%2FILT=1234",
          "%2ACKN=01:23:45:67:89:ab",
          "%2LKUP=01:23:45:67:89:ab",
          "%1CLSS=2",
          "%2SVER=1.0"};
}

void fuzzAnswers(Bytes input) {
  const std::string_view line = textOf(input);
  pjlink::greetingFrom(line);
  pjlink::isAnswer(line);
  pjlink::isWrongPassword(line);
  pjlink::foundFrom(line);
  std::string value(line.substr(line.find('=') == std::string_view::npos ? 0 : line.find('=') + 1));
  for (const std::string_view command : {"POWR", "AVMT", "ERST", "LAMP", "INPT", "IRES", "FILT", "CLSS"})
    if (const auto answer = pjlink::answerFrom(line, command)) value = answer->value;
  pjlink::powerFrom(value);
  pjlink::shutterFrom(value);
  pjlink::troublesFrom(value);
  pjlink::lampsFrom(value);
  pjlink::inputFrom(value);
  pjlink::signalFrom(value);
  pjlink::numberFrom(value);
}

}  // namespace

std::vector<FuzzTarget> networkTargets() {
  return {{"projectors' answers",
           fuzzAnswers,
           answerSeeds,
           Form::bytes,
           5000,
           {"PJLINK", "%1", "%2", "=", "ERR1", "ERRA", "LAMP", "99999999999", " 1", "x", "-", "*", "\r"}}};
}

}  // namespace relucent::fuzz
