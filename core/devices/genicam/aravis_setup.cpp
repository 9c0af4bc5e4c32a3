// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "relucent/base/message.h"
#include "relucent/devices/genicam/aravis.h"

namespace relucent::devices {
namespace {

class Setup {
 public:
  Setup(ArvCamera* camera, std::string name, const GenicamSettings& settings)
      : camera_(camera), name_(std::move(name)), settings_(settings) {}

  AravisSetup run(CameraTraits& traits) {
    AravisFailure failure(name_);
    const std::string vendor = textOf(arv_camera_get_vendor_name(camera_, failure));
    traits.model = fmt::format("{} {}", vendor, textOf(arv_camera_get_model_name(camera_, failure)));
    chooseFormat(traits);
    chooseRegion(traits);
    disableAutomaticFunctions();
    chooseGain(traits);
    chooseTrigger(traits);
    double shortest = 0.0, longest = 0.0;
    arv_camera_get_exposure_time_bounds(camera_, &shortest, &longest, failure);
    failure.check("range of exposures");
    traits.exposures = {shortest * 1e-6, longest * 1e-6};
    return setup_;
  }

 private:
  void chooseFormat(CameraTraits& traits) {
    AravisFailure failure(name_);
    guint count = 0;
    const std::unique_ptr<const char*, FreeMemory> names(
        arv_camera_dup_available_pixel_formats_as_strings(camera_, &count, failure));
    failure.check("pixel formats");
    std::vector<std::string> available;
    for (guint i = 0; i < count; ++i) available.push_back(textOf(names.get()[i]));

    const bool any = settings_.format.empty();
    const std::optional<SensorFormat> format =
        any ? bestFormat(available) : sensorFormatFromName(settings_.format);
    const bool offered =
        any || std::find(available.begin(), available.end(), settings_.format) != available.end();
    if (!format || !offered)
      throw Error(ErrorKind::device,
                  any ? RELUCENT_MESSAGE("device.no-readable-pixel-format",
                                         "none of the camera's pixel formats can be read")
                      : RELUCENT_MESSAGE("device.pixel-format-not-offered",
                                         "the camera has no pixel format {} that can be read")
                            .with(settings_.format),
                  RELUCENT_MESSAGE("device.choose-readable-pixel-format",
                                   "it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read")
                      .with(fmt::to_string(fmt::join(available, ", "))),
                  name_);
    arv_camera_set_pixel_format_from_string(camera_, nameOf(*format).c_str(), failure);
    failure.check("pixel format " + nameOf(*format));
    setup_.format = traits.format = *format;
    setup_.pixelFormat = arv_camera_get_pixel_format(camera_, failure);
    failure.check("pixel format");
    if (format->layout == SensorLayout::mono)
      traits.remarks.push_back(RELUCENT_MESSAGE(
          "device.sees-no-colours", "sees no colours: brightness can be compensated, colours cannot"));
  }

  void chooseRegion(CameraTraits& traits) {
    AravisFailure failure(name_);
    gint sensorWidth = 0, sensorHeight = 0;
    arv_camera_get_sensor_size(camera_, &sensorWidth, &sensorHeight, failure);
    failure.check("size of the sensor");
    const Size sensor{sensorWidth, sensorHeight};
    const Size wanted = settings_.photograph ? sensorSize(*settings_.photograph, setup_.format) : sensor;
    if (wanted.width > sensor.width || wanted.height > sensor.height)
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.photograph-exceeds-sensor", "{} pixels are wanted and the camera has {}")
              .with(as::size(*settings_.photograph), as::size(photographSize(sensor, setup_.format))),
          RELUCENT_MESSAGE("device.ask-for-fewer-pixels", "ask for that or less"), name_);
    // An even corner keeps the colour filter's order.
    arv_camera_set_region(camera_, (sensor.width - wanted.width) / 4 * 2,
                          (sensor.height - wanted.height) / 4 * 2, wanted.width, wanted.height, failure);
    failure.check("part of the sensor");
    gint x = 0, y = 0, width = 0, height = 0;
    arv_camera_get_region(camera_, &x, &y, &width, &height, failure);
    failure.check("part of the sensor");
    setup_.begin = {x, y};
    setup_.sensor = {width, height};
    traits.size = photographSize({width, height}, setup_.format);
    if (settings_.photograph && traits.size != *settings_.photograph)
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("device.photograph-size-refused", "{} pixels are wanted and the camera gives {}")
              .with(as::size(*settings_.photograph), as::size(traits.size)),
          RELUCENT_MESSAGE("device.ask-for-given-size", "ask for the size that it gives"), name_);
  }

  /// Throws: Error{device} if the camera goes on deciding something by itself.
  void disableAutomaticFunctions() {
    for (const char* automatic : {"ExposureAuto", "GainAuto", "BalanceWhiteAuto", "BlackLevelAuto"}) {
      AravisFailure failure(name_);
      if (arv_camera_is_feature_available(camera_, automatic, failure) == FALSE) continue;
      arv_camera_set_string(camera_, automatic, "Off", failure);
      const bool refused = failure.happened();
      const std::string held = refused ? "On" : textOf(arv_camera_get_string(camera_, automatic, failure));
      if (refused || held != "Off")
        throw Error(
            ErrorKind::device,
            RELUCENT_MESSAGE("device.automatic-function-stays", "{} cannot be switched off").with(automatic),
            RELUCENT_MESSAGE("device.switch-off-with-makers-program",
                             "switch it off with the camera maker's program, or use another camera"),
            name_);
    }
    // Missing on many cameras; where they are, they only get in the way.
    for (const char* hindrance : {"AcquisitionFrameRateEnable", "GammaEnable"}) {
      AravisFailure ignored(name_);
      if (arv_camera_is_feature_available(camera_, hindrance, ignored) != FALSE)
        arv_camera_set_boolean(camera_, hindrance, FALSE, ignored);
    }
  }

  void chooseGain(CameraTraits& traits) {
    AravisFailure failure(name_);
    if (arv_camera_is_gain_available(camera_, failure) == FALSE) return;
    double lowest = 0.0, highest = 0.0;
    arv_camera_get_gain_bounds(camera_, &lowest, &highest, failure);
    failure.check("range of gains");
    const double wanted = settings_.gain.value_or(lowest);
    if (wanted < lowest || wanted > highest)
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("device.gain-out-of-range", "a gain of {} is wanted").with(wanted),
                  RELUCENT_MESSAGE("device.choose-gain-in-range", "choose a gain from {} to {}")
                      .with(lowest, highest),
                  name_);
    arv_camera_set_gain(camera_, wanted, failure);
    failure.check("gain");
    traits.gain = arv_camera_get_gain(camera_, failure);
    failure.check("gain");
    if (std::abs(traits.gain - wanted) > 0.01 * std::max(1.0, highest - lowest))
      traits.remarks.push_back(
          RELUCENT_MESSAGE("device.gain-refused", "was asked for a gain of {} but uses {}")
              .with(as::number(wanted, as::digits(4)), as::number(traits.gain, as::digits(4))));
  }

  void chooseTrigger(CameraTraits& traits) {
    AravisFailure failure(name_);
    arv_camera_set_acquisition_mode(camera_, ARV_ACQUISITION_MODE_CONTINUOUS, failure);
    failure.check("acquisition mode");
    setup_.triggered = arv_camera_is_software_trigger_supported(camera_, failure) != FALSE;
    if (setup_.triggered)
      arv_camera_set_trigger(camera_, "Software", failure);
    else
      arv_camera_clear_triggers(camera_, failure);
    failure.check("software trigger");
    traits.triggered = setup_.triggered;
    if (!setup_.triggered)
      traits.remarks.push_back(
          RELUCENT_MESSAGE("device.no-software-trigger",
                           "has no software trigger: each photograph may wait for one more exposure"));
  }

  ArvCamera* camera_;
  std::string name_;
  const GenicamSettings& settings_;
  AravisSetup setup_;
};

/// Along one axis: from `begin` on, `length` long, on steps of both, within [0, limit).
void alignOutward(int& begin, int& length, int beginStep, int lengthStep, int least, int limit) {
  const int end = begin + length;
  begin = begin / beginStep * beginStep;
  length = std::max(end - begin, least);
  length = (length + lengthStep - 1) / lengthStep * lengthStep;
  // Beside the sensor's end it begins earlier; where that does not fit the steps either, all is delivered.
  if (begin + length > limit) begin = std::max(0, limit - length) / beginStep * beginStep;
  if (begin + length > limit || begin + length < end) {
    begin = 0;
    length = limit;
  }
}

}  // namespace

rig::PicturePart partOfSensor(ArvCamera* camera, const std::string& name, const AravisSetup& setup,
                              const rig::PicturePart& part) {
  const int cell = sensorSize({1, 1}, setup.format).width;
  rig::PicturePart wanted{{cell * part.begin.x, cell * part.begin.y}, sensorSize(part.size, setup.format)};
  AravisFailure failure(name);
  const auto step = [&](gint (*increment)(ArvCamera*, GError**)) {
    AravisFailure ignored(name);  // cameras that do not say step by one
    return std::lcm(std::max(1, increment(camera, ignored)), cell);
  };
  const auto least = [&](void (*bounds)(ArvCamera*, gint*, gint*, GError**)) {
    gint from = 1, to = 1;
    bounds(camera, &from, &to, failure);
    failure.check("part of the sensor");
    return std::max(1, from);
  };
  // Within the photograph: its own corner lies where the camera could put it.
  alignOutward(wanted.begin.x, wanted.size.width, step(arv_camera_get_x_offset_increment),
               step(arv_camera_get_width_increment), least(arv_camera_get_width_bounds), setup.sensor.width);
  alignOutward(wanted.begin.y, wanted.size.height, step(arv_camera_get_y_offset_increment),
               step(arv_camera_get_height_increment), least(arv_camera_get_height_bounds),
               setup.sensor.height);
  return {{setup.begin.x + wanted.begin.x, setup.begin.y + wanted.begin.y}, wanted.size};
}

bool setPartOfSensor(ArvCamera* camera, const std::string& name, const rig::PicturePart& part) {
  AravisFailure failure(name);
  const auto isRefused = [&] {
    if (!failure.happened()) return false;
    try {
      failure.check("part of the sensor");
    } catch (const CameraLost&) {
      throw;
    } catch (const Error&) {
      return true;  // the camera goes on as it was
    }
    return false;
  };
  arv_camera_set_region(camera, part.begin.x, part.begin.y, part.size.width, part.size.height, failure);
  if (isRefused()) return false;
  gint x = 0, y = 0, width = 0, height = 0;
  arv_camera_get_region(camera, &x, &y, &width, &height, failure);
  if (isRefused()) return false;
  return rig::PicturePart{{x, y}, {width, height}} == part;
}

AravisSetup setUp(ArvCamera* camera, const std::string& name, const GenicamSettings& settings,
                  CameraTraits& traits) {
  return Setup(camera, name, settings).run(traits);
}

}  // namespace relucent::devices
