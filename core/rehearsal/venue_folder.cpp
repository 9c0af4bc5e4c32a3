// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/venue_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/kept_photographs.h"
#include "relucent/pipeline/network_projectors.h"
#include "relucent/pipeline/night_record.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::rehearsal {
namespace {

namespace fs = std::filesystem;
using calibration::CalibrationFolder;
using calibration::Json;

constexpr Size canvas{64, 48};
// Real ones: within the time that a day takes, content goes round again and again.
constexpr double stillSeconds = 0.6, streamSeconds = 0.9;

/// Contrast in all colours, so that there is something to perfect.
image::Image picture(float phase) {
  image::Image encoded(canvas, 3);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      for (int c = 0; c < 3; ++c)
        encoded.at(x, y, c) =
            0.2f + 0.6f * std::abs(std::sin(0.1f * static_cast<float>(x + (c + 1) * y) + phase));
  return encoded;
}

const venue::VenueSettings& simulatedVenueOf(const pipeline::CalibrateSettings& settings,
                                             const fs::path& path) {
  const auto* venue = std::get_if<venue::VenueSettings>(&settings.rig);
  if (venue == nullptr)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("rehearsal.real-devices",
                                 "this calibration has real devices, and days are rehearsed in simulated "
                                 "venues"),
        RELUCENT_ENGLISH_MESSAGE("rehearsal.calibrate-simulated",
                                 "make one for it: relucent-cli calibrate day --venue corner"),
        path.string());
  return *venue;
}

}  // namespace

VenueFolder::VenueFolder(const DaysSettings& settings)
    : root_(fs::absolute(settings.out)), calibration_(root_ / "calibration") {
  {
    const auto folder = CalibrationFolder::open(settings.calibration, CalibrationFolder::Access::read);
    if (!pipeline::isComplete(folder))
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("rehearsal.not-finished", "the calibration is not finished"),
                  RELUCENT_ENGLISH_MESSAGE("rehearsal.finish-first", "finish it with resume, then rehearse"),
                  settings.calibration.string());
    const venue::VenueSettings venue = simulatedVenueOf(pipeline::settingsOf(folder), settings.calibration);
    projector_ = venue.projector;
    const auto known = std::ranges::find(venue::venues(), venue.name, &venue::VenueDescription::name);
    if (known != venue::venues().end()) projectors_ = static_cast<std::size_t>(known->projectors);
  }
  std::error_code code;
  if (fs::exists(calibration_, code))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("rehearsal.folder-in-use", "there is a rehearsal in this folder already"),
        RELUCENT_ENGLISH_MESSAGE("rehearsal.choose-other-folder",
                                 "remove it, or choose another folder with --out"),
        root_.string());
  createFolder(root_);
  fs::copy(settings.calibration, calibration_, fs::copy_options::recursive, code);
  if (!code) fs::remove(calibration_ / pipeline::nightsName, code);
  if (!code) {
    createFolder(root_ / "cache");
    // The traced venue: else the show would trace it once more.
    if (!settings.cache.empty())
      fs::create_directory_symlink(fs::absolute(settings.cache), root_ / "cache" / "relucent", code);
  }
  if (code)
    throw Error(ErrorKind::disk,
                RELUCENT_ENGLISH_MESSAGE("rehearsal.cannot-copy", "the calibration cannot be copied ({})")
                    .with(code.message()),
                RELUCENT_ENGLISH_MESSAGE("rehearsal.check-folder",
                                         "check that there is room, or choose another folder with --out"),
                root_.string());
  createFolder(root_ / "runtime");
  fs::permissions(root_ / "runtime", fs::perms::owner_all, code);
  writeStill();
  writeScreens();
}

void VenueFolder::tellProjectors(const std::vector<pjlink::Address>& addresses) const {
  CalibrationFolder folder = CalibrationFolder::open(calibration_, CalibrationFolder::Access::write);
  pipeline::NetworkProjectors projectors;
  for (std::size_t number = 0; number < addresses.size(); ++number)
    projectors.addresses[number] = addresses[number];
  pipeline::keepNetworkProjectors(folder, projectors);
}

void VenueFolder::writePlaylist(const std::string& stream) const {
  Json items = Json::array();
  items.push_back({{"path", still().string()}, {"seconds", stillSeconds}});
  items.push_back({{"path", "stream:" + stream}, {"seconds", streamSeconds}});
  const Json playlist{{"version", 1}, {"fade_seconds", 0.0}, {"loop", true}, {"items", items}};
  writeFileAtomically(root_ / "day.playlist", playlist.dump(2));
}

void VenueFolder::writeTime(ShowTime from, ShowTime until, double speed) const {
  writeFileAtomically(root_ / "time", fmt::format("{} {} {:.3f}\n", textOf(from), textOf(until), speed));
}

void VenueFolder::writeStill() const {
  image::writePng(still(), picture(0.0f), 8);
}

void VenueFolder::removeStill() const {
  std::error_code code;
  fs::remove(still(), code);
}

void VenueFolder::spoilStill() const {
  writeFileAtomically(still(), "half of a copy");
}

void VenueFolder::writeScreens() const {
  const auto screen = [](const std::string& name, int x, const Size& size) {
    return Json{{"name", name}, {"x", x}, {"y", 0}, {"width", size.width}, {"height", size.height}};
  };
  constexpr Size operators{1366, 768};
  Json screens = Json::array();
  screens.push_back(screen("OPERATOR", 0, operators));
  for (std::size_t number = 0; number < projectors_; ++number)
    screens.push_back(screen(fmt::format("PROJECTOR{}", number + 1),
                             operators.width + static_cast<int>(number) * projector_.width, projector_));
  const Json desktop{{"screens", screens}};
  writeFileAtomically(root_ / "screens.json", desktop.dump(2));
}

ShowCommand VenueFolder::command(const DaysSettings& settings) const {
  ShowCommand command;
  command.program = settings.program;
  command.log = log();
  command.arguments = {calibration_.string(),
                       "--content",
                       (root_ / "day.playlist").string(),
                       "--canvas",
                       fmt::format("{}x{}", canvas.width, canvas.height),
                       "--schedule",
                       fmt::format("{:02}:00-{:02}:00", opens.count(), closes.count()),
                       "--night",
                       fmt::format("{:02}:00", nightAt.count()),
                       "--alarm",
                       "echo {sentence} >>'" + alarms().string() + "'",
                       "--switch-projectors",
                       "--backend",
                       "cpu",
                       "--log",
                       log().string(),
                       "--rehearse-time",
                       (root_ / "time").string()};
  command.environment = {"TZ=UTC", "XDG_CACHE_HOME=" + (root_ / "cache").string(),
                         "XDG_CONFIG_HOME=" + (root_ / "config").string()};
  if (!settings.onScreens) {
    command.environment.push_back("QT_QPA_PLATFORM=offscreen:configfile=" +
                                  (root_ / "screens.json").string());
    command.environment.push_back("XDG_RUNTIME_DIR=" + (root_ / "runtime").string());
  }
  return command;
}

std::uint64_t bytesIn(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code code;
  for (fs::recursive_directory_iterator one(folder, code), end; !code && one != end; one.increment(code)) {
    // What is replaced this very moment is counted the next time.
    std::error_code gone;
    const std::uint64_t size = one->is_regular_file(gone) ? one->file_size(gone) : 0;
    if (!gone) bytes += size;
  }
  return bytes;
}

}  // namespace relucent::rehearsal
