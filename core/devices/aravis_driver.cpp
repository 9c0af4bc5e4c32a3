// SPDX-License-Identifier: MIT
// The only file that knows Aravis.
#include <arv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/error.h"
#include "devices/genicam_driver.h"

namespace relucent {
namespace {

using std::chrono::microseconds;

/// Frames that may be under way while one is looked at.
constexpr int buffers = 4;

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
struct Free {
  void operator()(gpointer memory) const { g_free(memory); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, Unref>;

/// Aravis keeps one list of cameras for the whole program.
std::mutex& listLock() {
  static std::mutex lock;
  return lock;
}

std::string text(const char* from) {
  return from == nullptr ? std::string() : std::string(from);
}

/// Receives a GError: `arv_something(..., failure)`, then failure.check().
class Failure {
 public:
  explicit Failure(std::string camera) : camera_(std::move(camera)) {}
  ~Failure() { g_clear_error(&error_); }
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;

  operator GError**() {
    g_clear_error(&error_);
    return &error_;
  }
  bool happened() const { return error_ != nullptr; }

  /// Throws: CameraLost if the camera does not answer or obeys somebody else, Error{device} for all the rest.
  void check(const std::string& deed) const {
    if (error_ == nullptr) return;
    if (isLoss())
      throw CameraLost(fmt::format("the camera no longer answers ({}: {})", deed, error_->message));
    throw Error(ErrorKind::device, fmt::format("the camera refuses ({}: {})", deed, error_->message),
                "switch it off and on, load its default settings with its maker's program, and try again",
                camera_);
  }

 private:
  bool isLoss() const {
    if (error_->domain != ARV_DEVICE_ERROR) return false;
    constexpr std::array lost{ARV_DEVICE_ERROR_NOT_CONNECTED,  ARV_DEVICE_ERROR_TIMEOUT,
                              ARV_DEVICE_ERROR_TRANSFER_ERROR, ARV_DEVICE_ERROR_NOT_FOUND,
                              ARV_DEVICE_ERROR_NOT_CONTROLLER, ARV_DEVICE_ERROR_PROTOCOL_ERROR};
    return std::find(lost.begin(), lost.end(), error_->code) != lost.end();
  }

  std::string camera_;
  GError* error_ = nullptr;
};

bool isNetworkAddress(const std::string& name) {
  return g_hostname_is_ip_address(name.c_str()) != FALSE;
}

/// Aravis' own name for the camera that is meant; empty if none answers.
std::string identityOf(const std::string& wanted) {
  if (isNetworkAddress(wanted)) return wanted;
  std::lock_guard guard(listLock());
  arv_update_device_list();
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i) {
    const std::array names{text(arv_get_device_serial_nbr(i)), text(arv_get_device_id(i)),
                           text(arv_get_device_physical_id(i)), text(arv_get_device_address(i))};
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return text(arv_get_device_id(i));
  }
  return {};
}

std::string reasonOf(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return {};
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "parts of the photograph were lost on the way";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "the photograph is larger than the camera announced";
    default:
      return "the photograph was not finished";
  }
}

class AravisDriver : public CameraDriver {
 public:
  explicit AravisDriver(GenicamSettings settings) : settings_(std::move(settings)) {}
  ~AravisDriver() override { AravisDriver::disconnect(); }

  std::string name() const override { return "genicam:" + settings_.camera; }

  CameraTraits connect() override {
    disconnect();
    open();
    CameraTraits traits;
    Failure failure(name());
    traits.model = text(arv_camera_get_vendor_name(camera_.get(), failure));
    traits.model += " " + text(arv_camera_get_model_name(camera_.get(), failure));
    chooseFormat(traits);
    chooseRegion(traits);
    switchAutomaticsOff();
    chooseGain(traits);
    chooseTrigger(traits);
    double shortest = 0.0, longest = 0.0;
    arv_camera_get_exposure_time_bounds(camera_.get(), &shortest, &longest, failure);
    failure.check("range of exposures");
    traits.exposures = {shortest * 1e-6, longest * 1e-6};
    listen();
    return traits;
  }

  void disconnect() noexcept override {
    stop();
    camera_.reset();
  }

  double setExposure(double seconds) override {
    Failure failure(name());
    arv_camera_set_exposure_time(camera_.get(), seconds * 1e6, failure);
    failure.check("exposure time");
    const double held = arv_camera_get_exposure_time(camera_.get(), failure);
    failure.check("exposure time");
    return held * 1e-6;
  }

  void trigger() override {
    if (!triggered_) return;
    Failure failure(name());
    arv_camera_software_trigger(camera_.get(), failure);
    failure.check("software trigger");
  }

  std::optional<DriverFrame> next(microseconds time) override {
    const auto limit = static_cast<guint64>(std::max<std::int64_t>(1, time.count()));
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_.get(), limit);
    if (buffer == nullptr) return std::nullopt;
    DriverFrame frame = copyOf(buffer);
    const bool foreign = frame.damage.empty() && arv_buffer_get_image_pixel_format(buffer) != pixelFormat_;
    arv_stream_push_buffer(stream_.get(), buffer);
    if (foreign) throw CameraLost("the camera has forgotten the pixel format that it was set to");
    return frame;
  }

  void restart() override {
    stop();
    listen();
  }

  microseconds now() const override { return microseconds(g_get_real_time()); }
  void wait(microseconds time) override { g_usleep(static_cast<gulong>(time.count())); }

 private:
  void open() {
    const std::string identity = identityOf(settings_.camera);
    if (identity.empty()) throw CameraLost(fmt::format("no GenICam camera '{}' answers", settings_.camera));
    Failure failure(name());
    camera_.reset(arv_camera_new(identity.c_str(), failure));
    failure.check("connecting");
    if (!camera_) throw CameraLost(fmt::format("no GenICam camera '{}' answers", settings_.camera));
    ArvDevice* device = arv_camera_get_device(camera_.get());
    if (arv_camera_is_gv_device(camera_.get()) != FALSE &&
        !arv_gv_device_is_controller(ARV_GV_DEVICE(device)))
      throw CameraLost("another program holds the camera");
  }

  void chooseFormat(CameraTraits& traits) {
    Failure failure(name());
    guint count = 0;
    const std::unique_ptr<const char*, Free> names(
        arv_camera_dup_available_pixel_formats_as_strings(camera_.get(), &count, failure));
    failure.check("pixel formats");
    std::vector<std::string> available;
    for (guint i = 0; i < count; ++i) available.push_back(text(names.get()[i]));

    const bool any = settings_.format.empty();
    const std::optional<SensorFormat> format =
        any ? bestFormat(available) : sensorFormatFromName(settings_.format);
    const bool offered =
        any || std::find(available.begin(), available.end(), settings_.format) != available.end();
    if (!format || !offered)
      throw Error(ErrorKind::device,
                  any ? std::string("none of the camera's pixel formats can be read")
                      : fmt::format("the camera has no pixel format {} that can be read", settings_.format),
                  fmt::format("it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read",
                              fmt::join(available, ", ")),
                  name());
    arv_camera_set_pixel_format_from_string(camera_.get(), nameOf(*format).c_str(), failure);
    failure.check("pixel format " + nameOf(*format));
    format_ = traits.format = *format;
    pixelFormat_ = arv_camera_get_pixel_format(camera_.get(), failure);
    failure.check("pixel format");
    if (format->layout == SensorLayout::mono)
      traits.remarks.push_back("sees no colours: brightness can be compensated, colours cannot");
  }

  void chooseRegion(CameraTraits& traits) {
    Failure failure(name());
    gint sensorWidth = 0, sensorHeight = 0;
    arv_camera_get_sensor_size(camera_.get(), &sensorWidth, &sensorHeight, failure);
    failure.check("size of the sensor");
    const Size sensor{sensorWidth, sensorHeight};
    const Size wanted = settings_.photograph ? sensorSize(*settings_.photograph, format_) : sensor;
    if (wanted.width > sensor.width || wanted.height > sensor.height)
      throw Error(ErrorKind::device,
                  fmt::format("{}x{} pixels are wanted and the camera has {}x{}", settings_.photograph->width,
                              settings_.photograph->height, photographSize(sensor, format_).width,
                              photographSize(sensor, format_).height),
                  "ask for that or less", name());
    // An even corner keeps the colour filter's order.
    arv_camera_set_region(camera_.get(), (sensor.width - wanted.width) / 4 * 2,
                          (sensor.height - wanted.height) / 4 * 2, wanted.width, wanted.height, failure);
    failure.check("part of the sensor");
    gint x = 0, y = 0, width = 0, height = 0;
    arv_camera_get_region(camera_.get(), &x, &y, &width, &height, failure);
    failure.check("part of the sensor");
    traits.size = photographSize({width, height}, format_);
    if (settings_.photograph && traits.size != *settings_.photograph)
      throw Error(
          ErrorKind::device,
          fmt::format("{}x{} pixels are wanted and the camera gives {}x{}", settings_.photograph->width,
                      settings_.photograph->height, traits.size.width, traits.size.height),
          "ask for the size that it gives", name());
  }

  /// Throws: Error{device} if the camera goes on deciding something by itself.
  void switchAutomaticsOff() {
    for (const char* automatic : {"ExposureAuto", "GainAuto", "BalanceWhiteAuto", "BlackLevelAuto"}) {
      Failure failure(name());
      if (arv_camera_is_feature_available(camera_.get(), automatic, failure) == FALSE) continue;
      arv_camera_set_string(camera_.get(), automatic, "Off", failure);
      const bool refused = failure.happened();
      const std::string held =
          refused ? "On" : text(arv_camera_get_string(camera_.get(), automatic, failure));
      if (refused || held != "Off")
        throw Error(ErrorKind::device, fmt::format("{} cannot be switched off", automatic),
                    "switch it off with the camera maker's program, or use another camera", name());
    }
    // Missing on many cameras; where they are, they only get in the way.
    for (const char* hindrance : {"AcquisitionFrameRateEnable", "GammaEnable"}) {
      Failure ignored(name());
      if (arv_camera_is_feature_available(camera_.get(), hindrance, ignored) != FALSE)
        arv_camera_set_boolean(camera_.get(), hindrance, FALSE, ignored);
    }
  }

  void chooseGain(CameraTraits& traits) {
    Failure failure(name());
    if (arv_camera_is_gain_available(camera_.get(), failure) == FALSE) return;
    double lowest = 0.0, highest = 0.0;
    arv_camera_get_gain_bounds(camera_.get(), &lowest, &highest, failure);
    failure.check("range of gains");
    const double wanted = settings_.gain.value_or(lowest);
    if (wanted < lowest || wanted > highest)
      throw Error(ErrorKind::device, fmt::format("a gain of {} is wanted", wanted),
                  fmt::format("the camera can do {} to {}", lowest, highest), name());
    arv_camera_set_gain(camera_.get(), wanted, failure);
    failure.check("gain");
    traits.gain = arv_camera_get_gain(camera_.get(), failure);
    failure.check("gain");
    if (std::abs(traits.gain - wanted) > 0.01 * std::max(1.0, highest - lowest))
      traits.remarks.push_back(
          fmt::format("was asked for a gain of {:.4g} and keeps to {:.4g}", wanted, traits.gain));
  }

  void chooseTrigger(CameraTraits& traits) {
    Failure failure(name());
    arv_camera_set_acquisition_mode(camera_.get(), ARV_ACQUISITION_MODE_CONTINUOUS, failure);
    failure.check("acquisition mode");
    triggered_ = arv_camera_is_software_trigger_supported(camera_.get(), failure) != FALSE;
    if (triggered_)
      arv_camera_set_trigger(camera_.get(), "Software", failure);
    else
      arv_camera_clear_triggers(camera_.get(), failure);
    failure.check("software trigger");
    traits.triggered = triggered_;
    if (!triggered_)
      traits.remarks.push_back("has no software trigger: each photograph may wait for one more exposure");
  }

  /// A stream of its own for every listening: what was sent to the one before never comes out of this one.
  void listen() {
    Failure failure(name());
    if (arv_camera_is_gv_device(camera_.get()) != FALSE) {
      arv_camera_gv_set_stream_options(camera_.get(), ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
      if (settings_.packetSize > 0) {
        arv_camera_gv_set_packet_size(camera_.get(), settings_.packetSize, failure);
        failure.check("packet size");
      } else {
        Failure ignored(name());  // cameras that cannot try it out keep their own
        arv_camera_gv_auto_packet_size(camera_.get(), ignored);
      }
    }
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, failure));
    failure.check("stream");
    if (!stream_) throw CameraLost("the camera sends no stream");
    const guint payload = arv_camera_get_payload(camera_.get(), failure);
    failure.check("size of a photograph");
    // The library's own choice, one photograph, loses packets of small ones. The system grants what it can.
    const int room = std::max(1 << 20, static_cast<int>(std::min<guint>(payload, 1 << 29)) * 2);
    if (ARV_IS_GV_STREAM(stream_.get()))
      g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
                   room, nullptr);
    for (int i = 0; i < buffers; ++i) arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
    arv_camera_start_acquisition(camera_.get(), failure);
    failure.check("start");
  }

  void stop() noexcept {
    if (camera_ && stream_) {
      GError* ignored = nullptr;
      arv_camera_stop_acquisition(camera_.get(), &ignored);
      g_clear_error(&ignored);
    }
    stream_.reset();
  }

  DriverFrame copyOf(ArvBuffer* buffer) const {
    DriverFrame frame;
    frame.id = arv_buffer_get_frame_id(buffer);
    frame.arrived = microseconds(arv_buffer_get_system_timestamp(buffer) / 1000);
    frame.damage = reasonOf(arv_buffer_get_status(buffer));
    if (!frame.damage.empty()) return frame;
    frame.frame.size = {arv_buffer_get_image_width(buffer), arv_buffer_get_image_height(buffer)};
    frame.frame.format = format_;
    std::size_t bytes = 0;
    const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &bytes));
    if (data != nullptr) frame.frame.bytes.assign(data, data + bytes);
    return frame;
  }

  GenicamSettings settings_;
  Owned<ArvCamera> camera_;
  Owned<ArvStream> stream_;
  SensorFormat format_;
  ArvPixelFormat pixelFormat_ = 0;
  bool triggered_ = false;
};

}  // namespace

bool hasGenicam() {
  return true;
}

std::vector<GenicamCamera> findGenicamCameras() {
  std::lock_guard guard(listLock());
  arv_update_device_list();
  std::vector<GenicamCamera> found;
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i)
    found.push_back({text(arv_get_device_serial_nbr(i)),
                     text(arv_get_device_vendor(i)) + " " + text(arv_get_device_model(i)),
                     text(arv_get_device_protocol(i)), text(arv_get_device_address(i))});
  return found;
}

std::unique_ptr<CameraDriver> makeGenicamDriver(const GenicamSettings& settings) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  return std::make_unique<AravisDriver>(settings);
}

}  // namespace relucent
