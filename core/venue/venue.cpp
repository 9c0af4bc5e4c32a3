// SPDX-License-Identifier: MIT
#include "relucent/venue/venue.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/venue/scenes.h"
#include "relucent/venue/simulated_devices.h"
#include "relucent/venue/transport_cache.h"
#include "relucent/venue/venue_light.h"

namespace relucent::venue {
namespace {

constexpr int smallestSide = 16, largestSide = 4096;
/// The flood image's bright parts reach full scale in 1/60 s.
constexpr double brightSignalPerSecond = 60.0;
/// To be raised when anything changes what is traced: scenes, materials, tracer.
constexpr int traceVersion = 1;

void checkSize(const char* device, Size size, std::vector<Message>& found) {
  auto impossible = [](int side) { return side < smallestSide || side > largestSide; };
  if (impossible(size.width) || impossible(size.height))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("venue.device-size-out-of-range",
                                 "a simulated {} of {} pixels is not possible: each side must be {} to {}")
            .with(device, as::size(size), smallestSide, largestSide));
}

void checkRange(const char* name, double value, double low, double high, std::vector<Message>& found) {
  if (!(value >= low && value <= high))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("venue.setting-out-of-range", "{} is {}, not between {} and {}")
                        .with(name, value, low, high));
}

void add(const SeenPlace& place, Fingerprint& fingerprint) {
  fingerprint.add(place.x).add(place.y);
}

void add(const Changes& changes, Fingerprint& fingerprint) {
  for (const auto* devices : {&changes.cameras, &changes.projectors}) {
    fingerprint.add(devices->size());
    for (const Turned& turned : *devices)
      fingerprint.add(turned.device).add(turned.x).add(turned.y).add(turned.degrees);
  }
  for (const auto* shares : {&changes.lamps, &changes.filter})
    for (double share : *shares) fingerprint.add(share);
  fingerprint.add(changes.dust).add(changes.painted.size()).add(changes.moved.size());
  for (const Painted& painted : changes.painted) {
    add(painted.place, fingerprint);
    fingerprint.add(painted.radius);
    for (double share : painted.colour) fingerprint.add(share);
  }
  for (const Moved& moved : changes.moved) {
    add(moved.place, fingerprint);
    fingerprint.add(moved.distance);
  }
  for (const Added& added : changes.added) {
    add(added.place, fingerprint);
    fingerprint.add(added.diameter);
  }
}

std::string traceFingerprint(const VenueSettings& settings) {
  Fingerprint fingerprint;
  fingerprint.add(settings.name)
      .add(traceVersion)
      .add(settings.projector.width)
      .add(settings.projector.height)
      .add(settings.camera.width)
      .add(settings.camera.height)
      .add(settings.pathsPerPixel)
      .add(settings.devices.vignetting);
  if (settings.changes.ofTransport()) add(settings.changes, fingerprint);
  return fingerprint.hex();
}

/// What `trace` gives, or gave before.
template <typename Trace>
TracedTransport tracedOrCached(const VenueSettings& settings, const std::string& name, std::size_t nodes,
                               std::size_t cameraPixels, const std::filesystem::path& cache,
                               Progress& progress, const Trace& trace) {
  std::string fingerprint = traceFingerprint(settings);
  std::filesystem::path file = cache / fmt::format("{}-{}.venue", name, fingerprint.substr(0, 12));
  if (!cache.empty()) {
    createFolder(cache);
    if (auto kept = readTracedTransport(file, fingerprint, nodes, cameraPixels)) {
      progress.report(1.0);
      return *std::move(kept);
    }
  }
  TracerSettings tracer;
  tracer.pathsPerPixel = settings.pathsPerPixel;
  Progress part =
      progress.part(1.0, RELUCENT_MESSAGE("stage.tracing-simulated-venue", "tracing the simulated venue"));
  TracedTransport traced = trace(tracer, part);
  if (!cache.empty()) writeTracedTransport(file, fingerprint, traced);
  return traced;
}

Scene sceneOf(const VenueSettings& settings) {
  Scene scene = buildScene(settings);
  apply(settings.changes, scene);
  return scene;
}

/// The light before and after what has changed, in the same units and under the same room light.
std::shared_ptr<const VenueLight> changedLightOf(const VenueSettings& settings, const VenueLight& before,
                                                 const std::filesystem::path& cache, Progress& progress) {
  TracedTransport traced =
      tracedOrCached(settings, settings.name + "-changed", before.layout().count(), before.cameras().count(),
                     cache, progress, [&](const TracerSettings& tracer, Progress& part) {
                       return traceInUnitsOf(buildScene(settings), before.transport().floodlight(),
                                             sceneOf(settings), tracer, part);
                     });
  return std::make_shared<VenueLight>(settings, before.layout(), before.cameras(), std::move(traced),
                                      before.roomLight());
}

std::shared_ptr<const VenueLight> lightOf(const VenueSettings& asked, const std::filesystem::path& cache,
                                          Progress& progress) {
  VenueSettings settings = asked;
  settings.changes = {};
  settings.devices.ambient = asked.changes.ambient.value_or(settings.devices.ambient);
  std::vector<Message> found = problems(asked);
  if (!found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("venue.change-setting", "change the setting, then try again"),
                "simulated venue");
  Scene scene = buildScene(settings);
  std::vector<Size> sizes(scene.projectors.size(), settings.projector);
  transport::NodeLayout layout{Rasters(sizes)};
  Rasters cameras(std::vector<Size>(scene.cameras.size(), settings.camera));
  TracedTransport traced = tracedOrCached(settings, settings.name, layout.count(), cameras.count(), cache,
                                          progress, [&](const TracerSettings& tracer, Progress& part) {
                                            return traceTransport(scene, tracer, brightSignalPerSecond, part);
                                          });
  auto light =
      std::make_shared<VenueLight>(settings, std::move(layout), std::move(cameras), std::move(traced));
  if (!asked.changes.ofTransport()) return light;
  return changedLightOf(asked, *light, cache, progress);
}

}  // namespace

std::vector<Message> problems(const VenueSettings& settings) {
  std::vector<Message> found;
  auto named = [&](const VenueDescription& venue) { return venue.name == settings.name; };
  const auto venue = std::find_if(venues().begin(), venues().end(), named);
  if (venue == venues().end()) {
    std::string names;
    for (const VenueDescription& each : venues()) names += (names.empty() ? "" : ", ") + each.name;
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("venue.unknown", "there is no simulated venue \"{}\"; there are {}")
            .with(settings.name, names));
  }
  checkSize("projector", settings.projector, found);
  checkSize("camera", settings.camera, found);
  checkRange("the number of paths per pixel", settings.pathsPerPixel, 1, 65536, found);
  const DeviceModelSettings& devices = settings.devices;
  checkRange("the projector's bits", devices.projectorBits, 1, 16, found);
  checkRange("the camera's bits", devices.cameraBits, 4, 16, found);
  checkRange("the projector's contrast", devices.contrast, 1.0, 1e9, found);
  checkRange("the projector's gamma", devices.gamma, 0.2, 5.0, found);
  checkRange("the projector's vignetting", devices.vignetting, 0.0, 0.95, found);
  checkRange("the camera's full well", devices.fullWell, 1.0, 1e9, found);
  checkRange("the camera's read noise", devices.readElectrons, 0.0, 1e6, found);
  checkRange("the ambient light", devices.ambient, 0.0, 1e3, found);
  checkRange("the lamp's drift", devices.drift, -1.0, 1.0, found);
  checkRange("the lamp's flicker", devices.flicker, 0.0, 0.5, found);
  checkRange("the camera's gamma", devices.cameraGamma, 0.2, 5.0, found);
  for (Message& problem : problems(settings.changes)) found.push_back(std::move(problem));
  if (venue == venues().end()) return found;
  const auto checkDevices = [&](const std::vector<Turned>& turned, int count) {
    for (const Turned& one : turned)
      checkRange("the number of a device that is turned", static_cast<double>(one.device) + 1.0, 1, count,
                 found);
  };
  checkDevices(settings.changes.cameras, venue->cameras);
  checkDevices(settings.changes.projectors, venue->projectors);
  return found;
}

SimulatedVenue::SimulatedVenue(const VenueSettings& settings, const std::filesystem::path& cache,
                               Progress& progress)
    : light_(lightOf(settings, cache, progress)), cache_(cache) {}

SimulatedVenue::SimulatedVenue(std::shared_ptr<const VenueLight> light, std::filesystem::path cache)
    : light_(std::move(light)), cache_(std::move(cache)) {}

SimulatedVenue::~SimulatedVenue() = default;

const VenueSettings& SimulatedVenue::settings() const {
  return light_->settings();
}

rig::Rig SimulatedVenue::rig() const {
  return simulatedRig(light_);
}

rig::Rig SimulatedVenue::rig(std::shared_ptr<const FaultSchedule> faults) const {
  return rig([faults = std::move(faults)](const rig::ShotId& shot) { return faults->during(shot); });
}

rig::Rig SimulatedVenue::rig(FaultsDuring faults) const {
  return simulatedRig(light_, std::move(faults));
}

const transport::TransportMatrix& SimulatedVenue::trueTransport() const {
  return light_->transport();
}

const CameraStack& SimulatedVenue::trueBlack() const {
  return light_->black();
}

CameraStack SimulatedVenue::trueRadiance(const std::vector<image::Image>& encodedDrive) const {
  CameraStack radiance = light_->fromProjectors(encodedDrive);
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] += light_->ambient()[i];
  return radiance;
}

std::optional<SimulatedVenue> SimulatedVenue::fromHiddenPlaces(Progress& progress) const {
  const VenueSettings& settings = this->settings();
  const Scene scene = sceneOf(settings);
  if (scene.hidden.empty()) return std::nullopt;
  Scene fromThere = scene;
  fromThere.cameras = scene.hidden;
  Rasters cameras(std::vector<Size>(scene.hidden.size(), settings.camera));
  TracedTransport traced = tracedOrCached(
      settings, settings.name + "-hidden", light_->layout().count(), cameras.count(), cache_, progress,
      [&](const TracerSettings& tracer, Progress& part) {
        return traceInUnitsOf(scene, light_->transport().floodlight(), fromThere, tracer, part);
      });
  return SimulatedVenue(std::make_shared<VenueLight>(settings, light_->layout(), std::move(cameras),
                                                     std::move(traced), light_->roomLight()),
                        cache_);
}

}  // namespace relucent::venue
