// SPDX-License-Identifier: MIT
#include "relucent/devices/command/command_camera.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/devices/command/shell_command.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"

namespace relucent::devices {
namespace fs = std::filesystem;
namespace {

constexpr const char* stem = "photograph";

/// Best first, for programs that write two files at once.
constexpr std::array<std::string_view, 6> extensions{"exr", "tif", "tiff", "png", "jpg", "jpeg"};

/// How good the kind of a file is: its place in `extensions`, or none at all.
std::size_t rankOf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (!extension.empty()) extension.erase(0, 1);
  return static_cast<std::size_t>(std::find(extensions.begin(), extensions.end(), extension) -
                                  extensions.begin());
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (!entry.is_directory(code)) files.push_back(entry.path());
  return files;
}

/// Throws: Error{disk} if an old photograph cannot be removed: it could be taken for the new one.
void clear(const fs::path& folder) {
  for (const fs::path& file : filesIn(folder)) {
    std::error_code code;
    if (!fs::remove(file, code) && code)
      throw Error(
          ErrorKind::disk,
          RELUCENT_MESSAGE("device.cannot-remove-file", "cannot remove the file ({})").with(code.message()),
          RELUCENT_MESSAGE("device.remove-file-by-hand", "remove it by hand, then try again"), file.string());
  }
}

/// The picture that the command wrote, whichever extension it chose; empty if there is none.
fs::path pictureIn(const fs::path& folder) {
  fs::path best;
  for (const fs::path& file : filesIn(folder)) {
    const bool ours = file.filename().string().starts_with(std::string(stem) + ".");
    if (!ours || rankOf(file) == extensions.size()) continue;
    if (best.empty() || std::pair(rankOf(file), file) < std::pair(rankOf(best), best)) best = file;
  }
  return best;
}

/// What the command wrote instead of `wanted`.
Message missed(const std::vector<fs::path>& files, const std::string& wanted) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  std::sort(names.begin(), names.end());
  if (names.empty())
    return RELUCENT_MESSAGE("device.command-wrote-nothing",
                            "the command ended well but wrote nothing, not {}")
        .with(wanted);
  return RELUCENT_MESSAGE("device.command-wrote-something-else",
                          "the command ended well but wrote {}, not {}")
      .with(fmt::to_string(fmt::join(names, ", ")), wanted);
}

}  // namespace

std::vector<Message> problemsOfCameraCommand(const std::string& command) {
  if (command.empty())
    return {RELUCENT_MESSAGE("device.camera-command-empty", "the camera's command is empty")};
  std::vector<Message> found;
  for (const char* placeholder : {"{exposure}", "{output}"})
    if (command.find(placeholder) == std::string::npos)
      found.push_back(
          RELUCENT_MESSAGE("device.camera-command-lacks", "the camera's command does not contain {}")
              .with(placeholder));
  return found;
}

std::vector<Message> problems(const CommandCameraSettings& settings) {
  std::vector<Message> found = problemsOfCameraCommand(settings.command);
  if (settings.size && settings.size->empty())
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.camera-size-empty", "a camera of {} pixels is impossible")
            .with(as::size(*settings.size)));
  if (rankOf(fs::path("x." + settings.extension)) == extensions.size())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.photograph-extension-unsupported",
                                             "photographs are read as {}, not as {}")
                        .with(fmt::to_string(fmt::join(extensions, ", ")), settings.extension));
  if (!(settings.exposures.shortest > 0.0) || !std::isfinite(settings.exposures.longest) ||
      !(settings.exposures.longest >= settings.exposures.shortest))
    found.push_back(
        RELUCENT_MESSAGE("device.exposure-range-invalid",
                         "the shortest exposure must be above zero and no longer than the longest"));
  if (settings.attempts < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.camera-command-attempts-not-positive",
                                             "the camera's command needs at least one attempt"));
  if (settings.timeout.count() <= 0)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.camera-command-timeout-not-positive",
                                 "the time allowed to the camera's command must be above 0 seconds"));
  return found;
}

CommandCamera::CommandCamera(CommandCameraSettings settings) : settings_(std::move(settings)) {
  require(problems(settings_).empty(), "{}", fmt::join(problems(settings_), "; "));
  requireConsent(settings_.command);
  size_ = settings_.size ? *settings_.size
                         : photograph({{"size", 0}, 0, settings_.exposures.shortest}).signal.size();
}

rig::RawFrame CommandCamera::capture(const rig::CaptureRequest& request) {
  for (int attempt = 1; attempt < settings_.attempts; ++attempt) {
    try {
      return checkedPhotograph(request);
    } catch (const Error&) {
      // What is still wrong the last time is told.
    }
  }
  return checkedPhotograph(request);
}

rig::RawFrame CommandCamera::checkedPhotograph(const rig::CaptureRequest& request) {
  rig::RawFrame frame = photograph(request);
  if (frame.signal.size() != size_)
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("device.photograph-size-unexpected",
                                 "the photograph has {} pixels where {} were announced")
                    .with(as::size(frame.signal.width(), frame.signal.height()), as::size(size_)),
                RELUCENT_MESSAGE(
                    "device.write-announced-size",
                    "let the command write that size, or begin again with the size that the camera delivers"),
                name());
  rig::checkFrame(frame, size_, name());
  return frame;
}

rig::RawFrame CommandCamera::photograph(const rig::CaptureRequest& request) {
  const fs::path output = folder_.path() / (std::string(stem) + "." + settings_.extension);
  clear(folder_.path());

  const std::string command = substituted(
      settings_.command,
      {{"exposure", fmt::format("{}", request.seconds)},
       {"output", output.string()},
       {"shot", fmt::format("{}-{}-{}", request.shot.stage, request.shot.number, request.exposure)}});
  runShellCommand(
      command, settings_.timeout + std::chrono::milliseconds(std::llround(request.seconds * 1000.0)), name());

  const fs::path picture = pictureIn(folder_.path());
  if (picture.empty())
    throw Error(
        ErrorKind::device, missed(filesIn(folder_.path()), output.filename().string()),
        RELUCENT_MESSAGE("device.write-photograph-to-output", "let it write the photograph to {output}: {}")
            .with(command),
        name());
  try {
    image::Picture taken = image::readPicture(picture);
    return {std::move(taken.encoded), taken.bits, request.seconds};
  } catch (const Error& error) {
    throw error.within(name());
  }
}

}  // namespace relucent::devices
