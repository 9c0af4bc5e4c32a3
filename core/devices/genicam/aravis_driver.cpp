// SPDX-License-Identifier: MIT
#include <mutex>
#include <utility>

#include "relucent/base/message.h"
#include "relucent/devices/genicam/aravis.h"

namespace relucent::devices {
namespace {

using std::chrono::microseconds;

/// Frames that may be under way while one is looked at.
constexpr int buffers = 4;

/// Aravis keeps one list of cameras for the whole program.
std::mutex& listLock() {
  static std::mutex lock;
  return lock;
}

bool isNetworkAddress(const std::string& name) {
  return g_hostname_is_ip_address(name.c_str()) != FALSE;
}

/// Contract: listLock() is held.
std::optional<unsigned int> placeInList(const std::string& wanted) {
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i) {
    const std::array names{textOf(arv_get_device_serial_nbr(i)), textOf(arv_get_device_id(i)),
                           textOf(arv_get_device_physical_id(i)), textOf(arv_get_device_address(i))};
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return i;
  }
  return std::nullopt;
}

/// Aravis' own name for the camera that is meant; empty if none answers.
std::string identityOf(const std::string& wanted) {
  if (isNetworkAddress(wanted)) return wanted;
  std::lock_guard guard(listLock());
  arv_update_device_list();
  const std::optional<unsigned int> camera = placeInList(wanted);
  return camera ? textOf(arv_get_device_id(*camera)) : std::string();
}

Message reasonOf(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return {};
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return RELUCENT_MESSAGE("device.parts-lost-on-the-way", "parts of the photograph were lost on the way");
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return RELUCENT_MESSAGE("device.photograph-larger-than-announced",
                              "the photograph is larger than the camera announced");
    default:
      return RELUCENT_MESSAGE("device.photograph-not-finished", "the photograph was not finished");
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
    setup_ = setUp(camera_.get(), name(), settings_, traits);
    listen();
    return traits;
  }

  void disconnect() noexcept override {
    stop();
    camera_.reset();
  }

  double setExposure(double seconds) override {
    AravisFailure failure(name());
    arv_camera_set_exposure_time(camera_.get(), seconds * 1e6, failure);
    failure.check("exposure time");
    const double held = arv_camera_get_exposure_time(camera_.get(), failure);
    failure.check("exposure time");
    return held * 1e-6;
  }

  std::optional<rig::PicturePart> look(const rig::PicturePart& part) override {
    const rig::PicturePart whole{setup_.begin, setup_.sensor};
    rig::PicturePart delivered = partOfSensor(camera_.get(), name(), setup_, part);
    stop();
    if (!setPartOfSensor(camera_.get(), name(), delivered)) {
      if (!setPartOfSensor(camera_.get(), name(), whole))
        throw CameraLost(
            RELUCENT_MESSAGE("device.part-of-sensor-lost",
                             "the camera does not go back to the part of the sensor that it had"));
      delivered = whole;
    }
    listen();
    const int cell = sensorSize({1, 1}, setup_.format).width;
    return rig::PicturePart{
        {(delivered.begin.x - whole.begin.x) / cell, (delivered.begin.y - whole.begin.y) / cell},
        photographSize(delivered.size, setup_.format)};
  }

  void trigger() override {
    if (!setup_.triggered) return;
    AravisFailure failure(name());
    arv_camera_software_trigger(camera_.get(), failure);
    failure.check("software trigger");
  }

  std::optional<DriverFrame> next(microseconds time) override {
    const auto limit = static_cast<guint64>(std::max<std::int64_t>(1, time.count()));
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_.get(), limit);
    if (buffer == nullptr) return std::nullopt;
    DriverFrame frame = copyOf(buffer);
    const bool foreign =
        frame.damage.empty() && arv_buffer_get_image_pixel_format(buffer) != setup_.pixelFormat;
    arv_stream_push_buffer(stream_.get(), buffer);
    if (foreign)
      throw CameraLost(RELUCENT_MESSAGE("device.pixel-format-lost",
                                        "the camera has forgotten the pixel format that it was set to"));
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
    if (identity.empty())
      throw CameraLost(RELUCENT_MESSAGE("device.no-genicam-camera-answers", "no GenICam camera '{}' answers")
                           .with(settings_.camera));
    AravisFailure failure(name());
    camera_.reset(arv_camera_new(identity.c_str(), failure));
    failure.check("connecting");
    if (!camera_)
      throw CameraLost(RELUCENT_MESSAGE("device.no-genicam-camera-answers", "no GenICam camera '{}' answers")
                           .with(settings_.camera));
    ArvDevice* device = arv_camera_get_device(camera_.get());
    if (arv_camera_is_gv_device(camera_.get()) != FALSE &&
        !arv_gv_device_is_controller(ARV_GV_DEVICE(device)))
      throw CameraLost(
          RELUCENT_MESSAGE("device.another-program-holds-camera", "another program holds the camera"),
          RELUCENT_MESSAGE("device.close-other-program",
                           "close the other program, a camera viewer or a second Relucent perhaps"));
  }

  /// A stream of its own for every listening: what was sent to the one before never comes out of this one.
  void listen() {
    AravisFailure failure(name());
    if (arv_camera_is_gv_device(camera_.get()) != FALSE) {
      arv_camera_gv_set_stream_options(camera_.get(), ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
      if (settings_.packetSize > 0) {
        arv_camera_gv_set_packet_size(camera_.get(), settings_.packetSize, failure);
        failure.check("packet size");
      } else {
        AravisFailure ignored(name());  // cameras that cannot try it out keep their own
        arv_camera_gv_auto_packet_size(camera_.get(), ignored);
      }
    }
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, failure));
    failure.check("stream");
    if (!stream_)
      throw CameraLost(RELUCENT_MESSAGE("device.camera-sends-no-stream", "the camera sends no stream"));
    const guint payload = arv_camera_get_payload(camera_.get(), failure);
    failure.check("size of a photograph");
    // The library's own choice, one photograph, loses packets of small ones. The system grants what it can.
    const int room = std::max(1 << 20, static_cast<int>(std::min<guint>(payload, 1 << 29)) * 2);
    // Nor is a photograph given up a tenth of a second after its last packet: no other is under way, and on a
    // busy machine both ends of the cable pause for longer.
    constexpr guint retention = 500'000;  // microseconds
    if (ARV_IS_GV_STREAM(stream_.get()))
      g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
                   room, "frame-retention", retention, nullptr);
    for (int i = 0; i < buffers; ++i) arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
    arv_camera_start_acquisition(camera_.get(), failure);
    failure.check("start");
    if (ARV_IS_GV_STREAM(stream_.get()) && setup_.triggered) primeSocketBuffer();
  }

  /// The library gives a stream its room only after the first packet, too late for what the network has of
  /// the rest of that photograph: as each repetition begins a stream of its own, all of them would lose
  /// parts.
  void primeSocketBuffer() {
    constexpr microseconds patience(1'000'000);
    AravisFailure failure(name());
    double shortest = 0.0, longest = 0.0;
    arv_camera_get_exposure_time_bounds(camera_.get(), &shortest, &longest, failure);
    failure.check("exposure time");
    setExposure(1e-6 * shortest);
    trigger();
    next(patience);
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
    frame.frame.format = setup_.format;
    std::size_t bytes = 0;
    const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &bytes));
    if (data != nullptr) frame.frame.bytes.assign(data, data + bytes);
    return frame;
  }

  GenicamSettings settings_;
  OwnedObject<ArvCamera> camera_;
  OwnedObject<ArvStream> stream_;
  AravisSetup setup_;
};

}  // namespace

std::vector<GenicamCamera> findGenicamCameras() {
  std::lock_guard guard(listLock());
  arv_update_device_list();
  std::vector<GenicamCamera> found;
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i)
    found.push_back({textOf(arv_get_device_serial_nbr(i)),
                     textOf(arv_get_device_vendor(i)) + " " + textOf(arv_get_device_model(i)),
                     textOf(arv_get_device_protocol(i)), textOf(arv_get_device_address(i))});
  return found;
}

std::vector<std::string> genicamDevices(const std::vector<std::string>& cameras) {
  std::lock_guard guard(listLock());
  arv_update_device_list();
  std::vector<std::string> devices;
  for (const std::string& camera : cameras) {
    // A network address is a camera whatever the list says: that holds one camera of a serial number.
    const std::optional<unsigned int> place = isNetworkAddress(camera) ? std::nullopt : placeInList(camera);
    const std::string address = place ? textOf(arv_get_device_address(*place)) : std::string();
    const std::string serial = place ? textOf(arv_get_device_serial_nbr(*place)) : std::string();
    devices.push_back(isNetworkAddress(address) ? address : serial.empty() ? camera : serial);
  }
  return devices;
}

std::unique_ptr<CameraDriver> makeGenicamDriver(const GenicamSettings& settings) {
  require(problems(settings).empty(), "{}", fmt::join(problems(settings), "; "));
  return std::make_unique<AravisDriver>(settings);
}

}  // namespace relucent::devices
