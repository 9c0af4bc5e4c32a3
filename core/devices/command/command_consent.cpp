// SPDX-License-Identifier: MIT
#include "relucent/devices/command/command_consent.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>

#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

/// One line of the file. A program that is found from the folder of work is another one elsewhere.
std::string keyOf(const std::string& command) {
  std::string key = command;
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    const bool isRelative = word.find('/') != std::string::npos && word.front() != '/';
    if (!isRelative) continue;
    key += "\nin " + fs::current_path().string();
    break;
  }
  std::string line;
  for (char letter : key) line += letter == '\n' ? "\\n" : letter == '\\' ? "\\\\" : std::string(1, letter);
  return line;
}

/// The whole program's.
class Consent {
 public:
  void ask(std::optional<ConsentSettings> settings) {
    const std::lock_guard lock(guard_);
    settings_ = std::move(settings);
    given_.clear();
  }

  bool isGiven(const std::string& command) {
    const std::lock_guard lock(guard_);
    if (!settings_) return true;
    const std::string key = keyOf(command);
    if (given_.contains(key)) return true;
    given_.merge(kept());
    return given_.contains(key);
  }
  bool isNamed(const std::string& command) {
    const std::lock_guard lock(guard_);
    return settings_ && settings_->isNamed && settings_->isNamed(command);
  }
  Message remedy() {
    const std::lock_guard lock(guard_);
    return settings_ ? settings_->remedy : Message();
  }

  void give(const std::vector<std::string>& commands) {
    const std::lock_guard lock(guard_);
    if (!settings_) return;
    given_.merge(kept());
    const std::size_t before = given_.size();
    for (const std::string& command : commands) given_.insert(keyOf(command));
    if (given_.size() == before || settings_->file.empty()) return;
    std::string text;
    for (const std::string& line : given_) text += line + '\n';
    createFolder(settings_->file.parent_path());
    writePrivateFileAtomically(settings_->file, text);
  }

 private:
  /// What another program of the same user wrote counts as well.
  std::set<std::string> kept() const {
    std::error_code code;
    if (settings_->file.empty() || !fs::exists(settings_->file, code)) return {};
    std::istringstream lines(readFile(settings_->file));
    std::set<std::string> kept;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) kept.insert(line);
    return kept;
  }

  std::mutex guard_;
  std::optional<ConsentSettings> settings_;
  std::set<std::string> given_;  // lines
};

Consent& consent() {
  static Consent only;
  return only;
}

}  // namespace

void askForConsent(ConsentSettings settings) {
  consent().ask(std::move(settings));
}

void askForNoConsent() {
  consent().ask(std::nullopt);
}

fs::path usualConsentFile() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return fs::path(data) / "relucent" / "commands";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".local" / "share" / "relucent" / "commands";
  return {};
}

bool isNamedBy(const std::vector<std::string>& arguments, const std::string& command) {
  return std::any_of(arguments.begin(), arguments.end(), [&command](const std::string& argument) {
    if (!argument.ends_with(command)) return false;
    const std::size_t before = argument.size() - command.size();
    return before == 0 || argument[before - 1] == '=' || argument[before - 1] == ':';
  });
}

std::vector<std::string> withoutConsent(const std::vector<std::string>& commands) {
  std::vector<std::string> lacking;
  for (const std::string& command : commands)
    if (!consent().isGiven(command) && !consent().isNamed(command) &&
        std::find(lacking.begin(), lacking.end(), command) == lacking.end())
      lacking.push_back(command);
  return lacking;
}

void giveConsent(const std::vector<std::string>& commands) {
  consent().give(commands);
}

void requireConsent(const std::string& command) {
  if (consent().isGiven(command)) return;
  if (!consent().isNamed(command))
    throw Error(
        ErrorKind::usage,
        RELUCENT_MESSAGE("device.command-without-consent",
                         "the calibration runs a program to which nobody at this computer has agreed: {}")
            .with(command),
        consent().remedy());
  try {
    consent().give({command});
  } catch (const Error&) {
    // Whoever names it the next time is asked again, which is no reason not to measure now.
  }
}

}  // namespace relucent::devices
