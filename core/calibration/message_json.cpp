// SPDX-License-Identifier: MIT
#include "relucent/calibration/message_json.h"

#include <algorithm>
#include <optional>

namespace relucent {

using calibration::Json;

namespace {

struct ToJson {
  Json operator()(const Argument::Count& count) const { return {{"count", count.value}}; }
  Json operator()(const Argument::Label& label) const { return {{"label", label.value}}; }
  Json operator()(const Argument::Quantity& quantity) const {
    const bool hasUnit = quantity.unit != Unit::none;
    Json json{{hasUnit ? std::string(toString(quantity.unit)) : "number", quantity.value}};
    if (quantity.digits.kind == Digits::Kind::decimals) json["decimals"] = quantity.digits.count;
    if (quantity.digits.kind == Digits::Kind::significant) json["significant"] = quantity.digits.count;
    return json;
  }
  Json operator()(const Size& size) const { return {{"size", Json::array({size.width, size.height})}}; }
  Json operator()(const Argument::Text& text) const { return {{"text", text.value}}; }
  Json operator()(const Argument::File& file) const { return {{"file", file.path}}; }
  Json operator()(const Argument::Sentence& sentence) const { return {{"message", *sentence.message}}; }
};

/// As many as a number has, whatever a stranger's file asks for.
int countFrom(const Json& json) {
  constexpr int most = 17;
  return std::clamp(json.get<int>(), 0, most);
}

Digits digitsFrom(const Json& json) {
  if (json.contains("decimals")) return as::decimals(countFrom(json.at("decimals")));
  if (json.contains("significant")) return as::digits(std::max(1, countFrom(json.at("significant"))));
  return {};
}

/// None: a kind of a later version.
std::optional<Argument> argumentFrom(const Json& json) {
  const auto first = json.items().begin();
  if (!json.is_object() || json.empty()) return std::nullopt;
  const std::string& kind = first.key();
  const Json& value = first.value();
  if (kind == "count") return as::count(value.get<std::int64_t>());
  if (kind == "label") return as::label(value.get<std::int64_t>());
  if (kind == "size") return as::size(value.at(0).get<int>(), value.at(1).get<int>());
  if (kind == "text") return Argument(value.get<std::string>());
  if (kind == "file") return as::file(value.get<std::string>());
  if (kind == "message") return Argument(value.get<Message>());
  if (kind == "number") return as::number(value.get<double>(), digitsFrom(json));
  if (const std::optional<Unit> unit = unitNamed(kind))
    return as::quantity(value.get<double>(), *unit, digitsFrom(json));
  return std::nullopt;
}

std::optional<Message> messageFrom(const Json& json) {
  std::vector<Argument> arguments;
  for (const Json& each : json.at("arguments")) {
    std::optional<Argument> argument = argumentFrom(each);
    if (!argument) return std::nullopt;
    arguments.push_back(*std::move(argument));
  }
  auto pattern = json.at("pattern").get<std::string>();
  if (detail::gapsOf(pattern) != arguments.size()) return std::nullopt;
  return Message(json.at("id").get<std::string>(), std::move(pattern), json.value("singular", std::string()),
                 std::move(arguments));
}

}  // namespace

void to_json(Json& json, const Message& message) {
  if (message.id().empty()) {
    json = english(message);
    return;
  }
  Json arguments = Json::array();
  for (const Argument& argument : message.arguments())
    arguments.push_back(std::visit(ToJson(), argument.value()));
  json = Json{{"id", message.id()}, {"pattern", message.pattern()}};
  if (!message.singular().empty()) json["singular"] = message.singular();
  json["arguments"] = std::move(arguments);
  json["english"] = english(message);
}

void from_json(const Json& json, Message& message) {
  if (json.is_string())
    message = json.get<std::string>().empty() ? Message() : Message::plain(json.get<std::string>());
  else
    message = messageFrom(json).value_or(Message::plain(json.at("english").get<std::string>()));
}

}  // namespace relucent
