// SPDX-License-Identifier: MIT
#include "relucent/venue/played_show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "relucent/base/error.h"
#include "relucent/venue/sensor_model.h"
#include "relucent/venue/venue_light.h"

namespace relucent::venue {
namespace {

constexpr std::size_t mostKept = 600;    // pictures, as the camera sees them
constexpr float bodyReflectance = 0.3f;  // of a visitor before the camera, of the mean of what it sees

CameraStack partOf(const CameraStack& all, const VenueLight& light, std::size_t camera) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(3 * light.cameras().offset(camera));
  return CameraStack(
      Stack(begin, begin + static_cast<std::ptrdiff_t>(3 * light.cameras().size(camera).count())));
}

/// Linear light of all projectors, black included.
ProjectorStack lightOf(const std::vector<image::Image>& pictures, const VenueLight& light) {
  ProjectorStack linear;
  for (const image::Image& picture : pictures) {
    const Stack one = light.projectorModel().light(picture);
    linear.insert(linear.end(), one.begin(), one.end());
  }
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] += light.projectorModel().black()[i % 3];
  return linear;
}

float lampOf(const PlayedVenue& now, std::size_t projector, std::size_t channel) {
  return now.lamps.empty() ? 1.0f : now.lamps[projector][channel];
}

/// Of the projectors' light, what reaches a camera past whoever stands in it.
CameraStack shadowed(const std::vector<image::Image>& pictures, const PlayedVenue& now, std::size_t camera) {
  const VenueLight& light = now.venue->light();
  const Rasters& projectors = light.layout().projectors();
  ProjectorStack linear = lightOf(pictures, light);
  for (std::size_t j = 0; j < projectors.devices(); ++j)
    for (std::size_t i = 0; i < projectors.size(j).count(); ++i) {
      const Pixel pixel = pixelAt(projectors.size(j), i);
      const bool isDark = std::any_of(now.inTheWay.begin(), now.inTheWay.end(), [&](const Silhouette& one) {
        return one.projector == j && one.holds(projectors.size(j), pixel);
      });
      for (std::size_t c = 0; c < 3; ++c)
        linear[3 * (projectors.offset(j) + i) + c] *= isDark ? 0.0f : lampOf(now, j, c);
    }
  return partOf(light.fromLight(linear), light, camera);
}

class ShowCamera : public rig::Camera {
 public:
  ShowCamera(PlayedShow show, VenueAt venueAt, std::function<double()> clock, std::size_t camera)
      : show_(std::move(show)), venueAt_(std::move(venueAt)), clock_(std::move(clock)), camera_(camera) {}

  std::string name() const override { return fmt::format("simulated camera {} before a show", camera_ + 1); }
  Size size() const override { return venueAt_(clock_()).venue->settings().camera; }
  rig::ExposureRange exposures() const override { return SensorModel::exposures(); }

  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    const double begins = clock_(), seconds = SensorModel::granted(request.seconds);
    const PlayedVenue now = venueAt_(begins);
    const VenueLight& light = now.venue->light();
    CameraStack radiance(3 * light.cameras().size(camera_).count(), 0.0f);
    const double rate = show_.framesPerSecond;
    const auto first = static_cast<std::int64_t>(std::floor(begins * rate));
    for (std::int64_t frame = first; static_cast<double>(frame) < (begins + seconds) * rate; ++frame) {
      const double from = std::max(begins, static_cast<double>(frame) / rate);
      const double to = std::min(begins + seconds, static_cast<double>(frame + 1) / rate);
      add(seenOf(show_.pictures(frame), now), static_cast<float>((to - from) / seconds), radiance);
    }
    const std::size_t offset = 3 * light.cameras().offset(camera_);
    for (std::size_t i = 0; i < radiance.size(); ++i)
      radiance[i] += (1.0f + now.moreRoomLight) * light.ambient()[offset + i];
    const Size raster = light.cameras().size(camera_);
    coverBodies(now.inTheWay, raster, radiance);
    return SensorModel(light.settings().devices, light.settings().seed, camera_)
        .expose(radiance, raster, request);
  }

 private:
  /// What the camera sees of one projector's picture alone, its lamp as it was.
  struct Seen {
    PlayedPictures pictures;
    std::shared_ptr<const SimulatedVenue> venue;
    std::vector<std::array<CameraStack, 3>> light;  // per projector and channel
  };

  static void add(const CameraStack& light, float weight, CameraStack& sum) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * light[i];
  }

  CameraStack seenOf(const PlayedPictures& pictures, const PlayedVenue& now) {
    const bool isShadowed = std::any_of(now.inTheWay.begin(), now.inTheWay.end(),
                                        [](const Silhouette& one) { return one.projector.has_value(); });
    if (isShadowed) return shadowed(*pictures, now, camera_);
    const Seen& seen = kept(pictures, now);
    CameraStack sum(seen.light.front().front().size(), 0.0f);
    for (std::size_t j = 0; j < seen.light.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c) add(seen.light[j][c], lampOf(now, j, c), sum);
    return sum;
  }

  const Seen& kept(const PlayedPictures& pictures, const PlayedVenue& now) {
    for (const Seen& seen : seen_)
      if (seen.pictures == pictures && seen.venue == now.venue) return seen;
    const VenueLight& light = now.venue->light();
    const Rasters& projectors = light.layout().projectors();
    const ProjectorStack linear = lightOf(*pictures, light);
    Seen seen{pictures, now.venue, {}};
    for (std::size_t j = 0; j < projectors.devices(); ++j) {
      std::array<CameraStack, 3> channels;
      for (std::size_t c = 0; c < 3; ++c) {
        ProjectorStack alone(linear.size(), 0.0f);
        for (std::size_t i = 0; i < projectors.size(j).count(); ++i) {
          const std::size_t at = 3 * (projectors.offset(j) + i) + c;
          alone[at] = linear[at];
        }
        channels[c] = partOf(light.fromLight(alone), light, camera_);
      }
      seen.light.push_back(std::move(channels));
    }
    if (seen_.size() == mostKept) seen_.pop_front();
    return seen_.emplace_back(std::move(seen));
  }

  static void coverBodies(const std::vector<Silhouette>& inTheWay, Size raster, CameraStack& radiance) {
    double mean = 0.0;
    for (float value : radiance) mean += value / static_cast<double>(radiance.size());
    for (const Silhouette& body : inTheWay) {
      if (body.projector) continue;
      for (std::size_t i = 0; i < raster.count(); ++i)
        if (body.holds(raster, pixelAt(raster, i)))
          for (std::size_t c = 0; c < 3; ++c)
            radiance[3 * i + c] = bodyReflectance * static_cast<float>(mean);
    }
  }

  PlayedShow show_;
  VenueAt venueAt_;
  std::function<double()> clock_;
  std::size_t camera_;
  std::deque<Seen> seen_;
};

}  // namespace

std::unique_ptr<rig::Camera> cameraBeforeShow(PlayedShow show, VenueAt venueAt, std::function<double()> clock,
                                              std::size_t camera) {
  return std::make_unique<ShowCamera>(std::move(show), std::move(venueAt), std::move(clock), camera);
}

CameraStack trueLight(const std::vector<image::Image>& pictures, const PlayedVenue& now, std::size_t camera) {
  const VenueLight& light = now.venue->light();
  CameraStack radiance = shadowed(pictures, now, camera);
  const std::size_t offset = 3 * light.cameras().offset(camera);
  for (std::size_t i = 0; i < radiance.size(); ++i)
    radiance[i] += (1.0f + now.moreRoomLight) * light.ambient()[offset + i];
  return radiance;
}

}  // namespace relucent::venue
