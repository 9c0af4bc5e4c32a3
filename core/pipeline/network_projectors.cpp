// SPDX-License-Identifier: MIT
#include "relucent/pipeline/network_projectors.h"

#include <algorithm>
#include <charconv>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/enum_json.h"
#include "relucent/calibration/json.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"

namespace relucent::pipeline {
namespace {

/// In a manifest's settings. No fingerprint knows it.
constexpr const char* section = "network_projectors";
constexpr int version = 1;

std::vector<std::string> numbers(std::size_t count) {
  std::vector<std::string> labels;
  for (std::size_t i = 1; i <= count; ++i) labels.push_back(std::to_string(i));
  return labels;
}

struct Labels {
  std::vector<std::string> operator()(const venue::VenueSettings& settings) const {
    for (const venue::VenueDescription& venue : venue::venues())
      if (venue.name == settings.name) return numbers(static_cast<std::size_t>(venue.projectors));
    return {};
  }
  std::vector<std::string> operator()(const CommandRigSettings& settings) const {
    return numbers(projectorsOf(settings).size());
  }
  std::vector<std::string> operator()(const ScreenRigSettings& settings) const {
    const std::vector<ScreenRigSettings::Screen> screens = screensOf(settings);
    std::vector<std::string> labels = numbers(screens.size());
    for (std::size_t i = 0; i < screens.size(); ++i)
      if (!screens[i].name.empty()) labels[i] = screens[i].name;
    return labels;
  }
  std::vector<std::string> operator()(const ReplayRigSettings&) const { return {}; }
  std::vector<std::string> operator()(const ImportedRigSettings&) const { return {}; }
};

[[noreturn]] void failForeign(const calibration::CalibrationFolder& folder, const std::string& why) {
  throw Error(ErrorKind::format,
              RELUCENT_MESSAGE("calibration.network-unreadable",
                               "the addresses of the projectors on the network cannot be read ({})")
                  .with(why),
              RELUCENT_MESSAGE("calibration.give-addresses-again", "give the projectors' addresses again"),
              folder.path().string());
}

std::map<std::size_t, std::string> passwordsOf(const calibration::CalibrationFolder& folder) {
  std::map<std::size_t, std::string> passwords;
  const std::filesystem::path file = folder.path() / passwordFile;
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return passwords;
  std::string text;
  try {
    text = readFile(file);
  } catch (const Error&) {
    return passwords;  // somebody else's: the projector will say that it asks for one
  }
  const calibration::Json read = parsedJson<calibration::Json>(text);
  for (const auto& [number, password] : read.at("passwords").items())
    passwords[std::stoul(number) - 1] = password.get<std::string>();
  return passwords;
}

void keepPasswords(const calibration::CalibrationFolder& folder, const NetworkProjectors& projectors) {
  calibration::Json passwords = calibration::Json::object();
  for (const auto& [projector, address] : projectors.addresses)
    if (!address.password.empty()) passwords[std::to_string(projector + 1)] = address.password;
  const std::filesystem::path file = folder.path() / passwordFile;
  if (passwords.empty()) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return;
  }
  const calibration::Json document{{"version", version}, {"passwords", std::move(passwords)}};
  writePrivateFileAtomically(file, document.dump(1) + "\n");
}

}  // namespace

std::vector<std::string> projectorLabels(const RigSettings& rig) {
  return std::visit(Labels(), rig);
}

std::optional<std::size_t> projectorNamed(const RigSettings& rig, std::string_view text) {
  const std::vector<std::string> labels = projectorLabels(rig);
  if (const auto found = std::ranges::find(labels, text); found != labels.end())
    return static_cast<std::size_t>(found - labels.begin());
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, number);
  constexpr std::size_t most = 64;  // where nobody knows how many there are
  const bool isNumber = error == std::errc() && after == end;
  if (!isNumber || number < 1 || number > (labels.empty() ? most : labels.size())) return std::nullopt;
  return number - 1;
}

void addAddress(NetworkProjectors& projectors, const RigSettings& rig, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string host = equals == std::string::npos ? text : text.substr(equals + 1);
  const std::optional<pjlink::Address> address = pjlink::addressFrom(host);
  if (!address)
    throw Error(ErrorKind::usage,
                RELUCENT_ENGLISH_MESSAGE("pjlink.no-address", "'{}' is no address of a projector").with(host),
                RELUCENT_ENGLISH_MESSAGE("pjlink.write-address", "write HOST or HOST:PORT, as 192.168.1.50"));
  const std::vector<std::string> labels = projectorLabels(rig);
  if (equals == std::string::npos && labels.size() > 1)
    throw Error(ErrorKind::usage,
                RELUCENT_ENGLISH_MESSAGE("pjlink.which-projector", "'{}' may be any of {} projectors")
                    .with(text, labels.size()),
                RELUCENT_ENGLISH_MESSAGE("pjlink.write-number", "say which: 1={}").with(text));
  const std::string name = equals == std::string::npos ? "1" : text.substr(0, equals);
  const std::optional<std::size_t> projector = projectorNamed(rig, name);
  if (!projector)
    throw Error(
        ErrorKind::usage,
        RELUCENT_ENGLISH_MESSAGE("pjlink.no-such-projector", "there is no projector '{}'").with(name),
        RELUCENT_ENGLISH_MESSAGE("pjlink.name-by-number", "name projectors by their numbers, from 1"));
  // Its password stays.
  const auto before = projectors.addresses.find(*projector);
  pjlink::Address changed = *address;
  if (before != projectors.addresses.end()) changed.password = before->second.password;
  projectors.addresses[*projector] = std::move(changed);
}

std::vector<Message> problems(const NetworkProjectors& projectors, const RigSettings& rig) {
  std::vector<Message> found;
  const std::size_t count = projectorLabels(rig).size();
  std::map<std::pair<std::string, int>, std::size_t> places;
  for (const auto& [projector, address] : projectors.addresses) {
    if (count > 0 && projector >= count)
      found.push_back(RELUCENT_MESSAGE("pjlink.more-than-projectors",
                                       "projector {} on the network is none of the {} that there are")
                          .with(as::label(projector + 1), count));
    const auto [place, isNew] = places.try_emplace({address.host, address.port}, projector);
    if (!isNew)
      found.push_back(
          RELUCENT_MESSAGE("pjlink.address-twice", "projectors {} and {} have the same address, {}")
              .with(as::label(place->second + 1), as::label(projector + 1), toString(address)));
  }
  return found;
}

NetworkProjectors networkProjectorsOf(const calibration::CalibrationFolder& folder) {
  NetworkProjectors projectors;
  const calibration::Json& settings = folder.settings();
  if (!settings.contains(section)) return projectors;
  try {
    const calibration::Json& kept = settings.at(section);
    // Of a later version: what this one knows of it.
    projectors.warmUp = valueNamed<WarmUp>(kept.value("warm_up", std::string())).value_or(WarmUp::steady);
    const std::map<std::size_t, std::string> passwords = passwordsOf(folder);
    for (const calibration::Json& one : kept.at("projectors")) {
      const auto projector = one.at("projector").get<std::size_t>() - 1;
      pjlink::Address address{one.at("host").get<std::string>(), one.value("port", pjlink::standardPort)};
      if (pjlink::addressFrom(toString(address)) != address) failForeign(folder, address.host);
      if (const auto password = passwords.find(projector); password != passwords.end())
        address.password = password->second;
      projectors.addresses[projector] = std::move(address);
    }
  } catch (const nlohmann::json::exception& cause) {
    failForeign(folder, cause.what());
  } catch (const std::logic_error& cause) {  // a number that is none
    failForeign(folder, cause.what());
  }
  return projectors;
}

void keepNetworkProjectors(calibration::CalibrationFolder& folder, const NetworkProjectors& projectors) {
  keepPasswords(folder, projectors);
  calibration::Json settings = folder.settings();
  if (projectors == NetworkProjectors()) {
    if (settings.erase(section) > 0) folder.setSettings(std::move(settings));
    return;
  }
  calibration::Json list = calibration::Json::array();
  for (const auto& [projector, address] : projectors.addresses)
    list.push_back({{"projector", projector + 1}, {"host", address.host}, {"port", address.port}});
  settings[section] = {{"version", version},
                       {"warm_up", std::string(nameOf(projectors.warmUp))},
                       {"projectors", std::move(list)}};
  folder.setSettings(std::move(settings));
}

std::string passwordFrom(const std::filesystem::path& file) {
  std::string text = readFile(file);
  text.resize(std::min(text.find_first_of("\r\n"), text.size()));
  if (text.empty())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("pjlink.password-file-empty", "there is no password in this file"),
        RELUCENT_ENGLISH_MESSAGE("pjlink.write-password", "write the PJLink password into its first line"),
        file.string());
  return text;
}

}  // namespace relucent::pipeline
